/**
 * @file version.h
 * @brief The version of the headers, and of the library that runs.
 *
 * Versions follow semantic versioning. Within one major version the ABI only
 * grows; doc/versioning.md says what that promises.
 */
#ifndef SNOWGROWTH_VERSION_H
#define SNOWGROWTH_VERSION_H

#include <snowgrowth/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief Major version of these headers. */
#define SNOW_VERSION_MAJOR 0
/** @brief Minor version of these headers. */
#define SNOW_VERSION_MINOR 1
/** @brief Patch version of these headers. */
#define SNOW_VERSION_PATCH 0
/** @brief Version of these headers as text. */
#define SNOW_VERSION_TEXT "0.1.0"

/**
 * @brief One number for a version; later versions compare greater.
 *
 * Minor and patch versions stay below 1000.
 */
#define SNOW_VERSION_NUMBER(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))

/** @brief Version of these headers as one number. */
#define SNOW_VERSION SNOW_VERSION_NUMBER(SNOW_VERSION_MAJOR, SNOW_VERSION_MINOR, SNOW_VERSION_PATCH)

/**
 * @brief The version of the library that runs, as one number.
 * @return SNOW_VERSION of the headers that the library was built with; compare
 *         it with your own SNOW_VERSION to learn whether you run on an older one.
 */
SNOW_API int snow_version(void);

/**
 * @brief The version of the library that runs, as text ("0.1.0").
 * @return A constant string that the library owns; never NULL.
 */
SNOW_API const char *snow_version_text(void);

#ifdef __cplusplus
}
#endif

#endif
