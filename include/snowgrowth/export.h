/**
 * @file export.h
 * @brief How public names are exported. No other header of the library needs
 * to be read to understand this one.
 */
#ifndef SNOWGROWTH_EXPORT_H
#define SNOWGROWTH_EXPORT_H

/**
 * @brief Marks every public function.
 *
 * Define SNOW_STATIC before including a header when you link the static
 * library on Windows; elsewhere it makes no difference.
 */
#if defined(_WIN32) && !defined(SNOW_STATIC)
#ifdef SNOW_BUILDING
#define SNOW_API __declspec(dllexport)
#else
#define SNOW_API __declspec(dllimport)
#endif
#elif defined(__GNUC__) && !defined(_WIN32)
#define SNOW_API __attribute__((visibility("default")))
#else
#define SNOW_API
#endif

#endif
