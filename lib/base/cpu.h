/* Which instruction sets this processor runs. */
#ifndef SNOW_BASE_CPU_H
#define SNOW_BASE_CPU_H

#include <snowgrowth/options.h>

/* The best set that this build and this processor share. */
snow_isa snow_cpu_best(void);

/* Processors that are online, at least 1. */
int snow_cpu_count(void);

#endif
