/**
 * @file render.h
 * @brief Pictures of a grid, as pixels in the caller's memory.
 *
 * Each cell is drawn as the regular hexagon that it is, with no distortion;
 * writing the pixels to a file is the caller's.
 */
#ifndef SNOWGROWTH_RENDER_H
#define SNOWGROWTH_RENDER_H

#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief How values become colours. */
typedef enum snow_palette {
    SNOW_PALETTE_PAPER = 1, /**< The paper's greys: vapour in the darker half, 0 black; ice in the lighter half, reversed, 1 white. */
    SNOW_PALETTE_FROST = 2, /**< White to blue ice on a night sky that brightens with the vapour. */
    SNOW_PALETTE_INK = 3,   /**< Dark blue ice on white, for print. */
    SNOW_PALETTE_AGE = 4,   /**< Ice by its freeze step, from dark violet (first) over red to light yellow (last); needs recorded freeze steps. */
    SNOW_PALETTE_PHASE = 5  /**< Ice by its freeze step modulo 16, round a circle of colours; needs recorded freeze steps. */
} snow_palette;

/** @brief Layout of a pixel. */
typedef enum snow_pixel {
    SNOW_PIXEL_GREY = 1, /**< One byte: luminance. */
    SNOW_PIXEL_RGB = 2,  /**< Three bytes: red, green, blue (sRGB). */
    SNOW_PIXEL_RGBA = 3  /**< Four bytes: red, green, blue, alpha (not premultiplied). */
} snow_pixel;

/**
 * @brief What is drawn, and how.
 *
 * Write the defaults with snow_view_init(), then call snow_view_fit() or set
 * the frame yourself. The plane is that of grid.h: x to the right, y down,
 * lattice spacing 1, the origin cell at (0, 0).
 */
typedef struct snow_view {
    size_t struct_size;   /**< Set by snow_view_init(). */
    int32_t width;        /**< Pixels in a row, 1 to 65,535; 512 by default. */
    int32_t height;       /**< Rows, 1 to 65,535; 512 by default. */
    double scale;         /**< Pixels per lattice spacing, 2^−10 to 2^10; 1 by default. */
    double centre_x;      /**< Where the middle of the picture lies in the plane; 0 by default. */
    double centre_y;      /**< Likewise. */
    snow_palette palette; /**< SNOW_PALETTE_PAPER by default. */
    snow_pixel pixel;     /**< SNOW_PIXEL_RGB by default. */
    int32_t samples;      /**< Samples per pixel along each side, 1 to 8; more smooth the edges; 2 by default. */
    int32_t transparent;  /**< 1: whatever is not ice is transparent (only with SNOW_PIXEL_RGBA); 0 by default. */
} snow_view;

/**
 * @brief Writes the default view.
 * @param view where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_view) as the caller was compiled.
 */
SNOW_API void snow_view_init(snow_view *view, size_t struct_size);

/**
 * @brief Frames the whole interior of a grid.
 * @param grid the grid.
 * @param side the longer side of the picture in pixels, 1 to 65,535; 0: one
 *        pixel per lattice spacing.
 * @param view initialised; width, height, scale and centre are set.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL; ::SNOW_ERROR_RANGE when side is out of
 *         range, or 0 and the grid is wider than 65,535 cells, or when the
 *         scale would leave its range; ::SNOW_ERROR_UNSUPPORTED when cells are no
 *         hexagons.
 */
SNOW_API snow_status snow_view_fit(const snow_grid *grid, int32_t side, snow_view *view);

/**
 * @brief Draws a grid into the caller's memory, row after row from the top,
 * without padding.
 * @param grid the grid.
 * @param view what and how.
 * @param pixels receives width * height pixels; NULL: only the size is wanted.
 * @param capacity bytes that pixels holds.
 * @param size receives the bytes of the picture, also when the buffer is too
 *        small; may be NULL unless pixels is.
 * @return ::SNOW_OK, ::SNOW_ERROR_NULL, ::SNOW_ERROR_STRUCT_SIZE,
 *         ::SNOW_ERROR_STRUCT_TAIL, ::SNOW_ERROR_ENUM, ::SNOW_ERROR_RANGE,
 *         ::SNOW_ERROR_NOT_FINITE; ::SNOW_ERROR_BUFFER when capacity is too
 *         small, nothing is drawn; ::SNOW_ERROR_NOT_RECORDED for
 *         ::SNOW_PALETTE_AGE and ::SNOW_PALETTE_PHASE without freeze steps;
 *         ::SNOW_ERROR_UNSUPPORTED when cells are no hexagons. Cost: samples² look-ups a
 *         pixel, and a few reads a cell; no memory is asked for.
 */
SNOW_API snow_status snow_render(const snow_grid *grid, const snow_view *view, void *pixels, size_t capacity,
                                 size_t *size);

#ifdef __cplusplus
}
#endif

#endif
