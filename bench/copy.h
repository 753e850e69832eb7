/* How fast the machine copies memory: the yardstick of a kernel that only reads and writes its field once. */
#ifndef BENCH_COPY_H
#define BENCH_COPY_H

#include <stdint.h>

/*
 * Bytes a second that so many threads copy together; bytes that are read and bytes that are written both count. The
 * best of several passes over arrays of four times the last-level cache, as the STREAM benchmark (J. D. McCalpin,
 * https://www.cs.virginia.edu/stream/) asks. 0: no memory or no threads.
 */
double copy_bandwidth(int32_t threads);

#endif
