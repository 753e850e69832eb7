/*
 * A second plain reading of Reiter's paper, in long double on a dense array.
 * It shares nothing with the library but the scene, so that an error of
 * understanding in one of the two shows.
 */
#ifndef TESTS_SUPPORT_PAPER_H
#define TESTS_SUPPORT_PAPER_H

#include <snowgrowth/snowgrowth.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct paper paper;

/* Knows β, γ, α, domain, seeds and fields; not noise, clusters or stop rules. */
paper *paper_new(const snow_reiter_params *params);
void paper_delete(paper *model);

void paper_step(paper *model, int64_t steps);

/* Cells next to the interior can be asked as well. */
bool paper_inside(const paper *model, int32_t q, int32_t r);
bool paper_is_ice(const paper *model, int32_t q, int32_t r);
long double paper_value(const paper *model, int32_t q, int32_t r);

#endif
