/* Work done in a process of its own, so that its time and memory are its alone, and another program's can be compared. */
#ifndef BENCH_CHILD_H
#define BENCH_CHILD_H

#include <stdbool.h>
#include <stdint.h>

enum { CHILD_ANSWER = 4096 };

typedef struct child_report {
    double seconds; /* of processor time, the system's included */
    double elapsed; /* seconds by the clock */
    uint64_t peak;  /* greatest resident memory, in bytes */
    char answer[CHILD_ANSWER]; /* the last of what it wrote to its standard output */
} child_report;

/* The work; writes its answer to standard output. Returns the exit status. */
typedef int (*child_work)(const void *argument);

/* False when there could be no child, or it did not end with status 0. */
bool child_run(child_work work, const void *argument, child_report *report);

/* A child_work: becomes another program. The argument is its argument vector. */
int child_exec(const void *arguments);

#endif
