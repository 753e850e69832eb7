/**
 * @file options.h
 * @brief What every grid can be given beside its model: memory, threads,
 * instruction set.
 *
 * No option changes a bit of any result.
 */
#ifndef SNOWGROWTH_OPTIONS_H
#define SNOWGROWTH_OPTIONS_H

#include <snowgrowth/export.h>
#include <snowgrowth/status.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @brief Instruction sets that a kernel is compiled for. */
typedef enum snow_isa {
    SNOW_ISA_AUTO = 0,     /**< The best that the processor has. */
    SNOW_ISA_BASELINE = 1, /**< What every processor of the architecture has (SSE2 on x86-64, NEON on aarch64). */
    SNOW_ISA_AVX2 = 2,     /**< x86-64 with AVX2. */
    SNOW_ISA_AVX512 = 3    /**< x86-64 with AVX-512 F, VL and DQ. */
} snow_isa;

/**
 * @brief Whether an instruction set can be forced here.
 * @param isa the instruction set.
 * @return 1 when this build has it and this processor runs it, else 0.
 */
SNOW_API int snow_isa_available(snow_isa isa);

/**
 * @brief The name of an instruction set ("auto", "baseline", "avx2", "avx512").
 * @param isa the instruction set.
 * @return A constant string that the library owns; NULL for an unknown value.
 */
SNOW_API const char *snow_isa_name(snow_isa isa);

/**
 * @brief Gives memory to the library.
 * @param context the caller's own pointer.
 * @param size bytes wanted, greater than zero.
 * @return Memory aligned as malloc() aligns it, or NULL when there is none.
 */
typedef void *(*snow_allocate)(void *context, size_t size);

/**
 * @brief Takes memory back.
 * @param context the caller's own pointer.
 * @param block what ::snow_allocate returned; never NULL.
 */
typedef void (*snow_release)(void *context, void *block);

/**
 * @brief One task of a parallel loop.
 * @param argument the pointer that the library handed to the loop.
 * @param index which task, from 0.
 */
typedef void (*snow_task)(void *argument, size_t index);

/**
 * @brief A caller's own parallel loop, used in place of the library's threads.
 *
 * Calls task(argument, i) exactly once for each i < count, in any order and on
 * any threads, and returns when all calls have returned.
 *
 * @param context the caller's own pointer.
 * @param count number of tasks, at least 1.
 * @param task the task.
 * @param argument to be handed to each task.
 */
typedef void (*snow_parallel_for)(void *context, size_t count, snow_task task, void *argument);

/**
 * @brief Options of a grid, whatever its model.
 *
 * Write the defaults with snow_options_init(), then change what you need. A
 * NULL pointer in place of the options means the defaults.
 */
typedef struct snow_options {
    size_t struct_size;             /**< Set by snow_options_init(). */
    snow_allocate allocate;         /**< Every byte of the grid comes from here; NULL: malloc(). */
    snow_release release;           /**< Given if and only if allocate is; NULL: free(). */
    void *allocator_context;        /**< Handed to allocate and release. */
    uint64_t memory_limit;          /**< Bytes that the grid may hold at once; 0: no limit. */
    int32_t threads;                /**< Threads that share a step: 1 (default) to 1024; 0: one per processor. */
    snow_isa isa;                   /**< SNOW_ISA_AUTO (default), or forced. */
    snow_parallel_for parallel_for; /**< Runs the tasks of a step, a few for each of `threads`, in place of our threads; NULL: ours. */
    void *parallel_context;         /**< Handed to parallel_for. */
} snow_options;

/**
 * @brief Writes the default options.
 * @param options where to; nothing happens when it is NULL.
 * @param struct_size sizeof(snow_options) as the caller was compiled.
 */
SNOW_API void snow_options_init(snow_options *options, size_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
