/* What a figure depends on: the processor. */
#ifndef BENCH_MACHINE_H
#define BENCH_MACHINE_H

#include <stddef.h>
#include <stdint.h>

int32_t machine_processors(void);

/* Bytes of the last-level cache; a guess of 32 MiB where the system does not tell. */
size_t machine_last_cache(void);

/* The processor's name where the system tells it, else its architecture. */
void machine_processor_name(char *name, size_t size);

#endif
