/**
 * @file snowgrowth.h
 * @brief Everything: include this one.
 */
#ifndef SNOWGROWTH_SNOWGROWTH_H
#define SNOWGROWTH_SNOWGROWTH_H

#include <snowgrowth/aggregate.h>
#include <snowgrowth/export.h>
#include <snowgrowth/grid.h>
#include <snowgrowth/measure.h>
#include <snowgrowth/options.h>
#include <snowgrowth/packard.h>
#include <snowgrowth/reiter.h>
#include <snowgrowth/render.h>
#include <snowgrowth/status.h>
#include <snowgrowth/sweep.h>
#include <snowgrowth/version.h>

#endif
