/* What the maps of plane and space share. */
#ifndef SNOW_AGGREGATE_MATTER_H
#define SNOW_AGGREGATE_MATTER_H

#include "aggregate/exits.h"

#include <stdatomic.h>
#include <stdint.h>

/* What is on a site, as bits. */
enum { SNOW_MATTER_FILLED = 1, SNOW_MATTER_OBSTACLE = 2 };

/* The answer of a map where it ends: no class, but a place in the table of classes. */
enum { SNOW_MAP_BEYOND = SNOW_EXIT_CLASSES };

/* One thread at a time changes a map while others read it (ahead.h): each number
   is old or new, and what is behind an address is complete. */
#define SNOW_MAP_GET(object) atomic_load_explicit(&(object), memory_order_relaxed)
#define SNOW_MAP_PUT(object, value) atomic_store_explicit(&(object), value, memory_order_relaxed)
#define SNOW_MAP_GET_ADDRESS(object) atomic_load_explicit(&(object), memory_order_acquire)
#define SNOW_MAP_PUT_ADDRESS(object, value) atomic_store_explicit(&(object), value, memory_order_release)

#endif
