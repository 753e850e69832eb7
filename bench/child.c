#define _DEFAULT_SOURCE
#include "child.h"
#include "timing.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

/* Keeps the end of what comes through a pipe. */
static void read_end(int from, char *answer)
{
    size_t held = 0;
    for (;;) {
        if (held == CHILD_ANSWER - 1) {
            held /= 2;
            memmove(answer, answer + CHILD_ANSWER - 1 - held, held);
        }
        ssize_t got = read(from, answer + held, CHILD_ANSWER - 1 - held);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        held += (size_t)got;
    }
    answer[held] = '\0';
}

static _Noreturn void be_child(child_work work, const void *argument, const int pipe_ends[2])
{
    close(pipe_ends[0]);
    dup2(pipe_ends[1], STDOUT_FILENO);
    close(pipe_ends[1]);
    int status = work(argument);
    fflush(stdout);
    _exit(status);
}

static double seconds_of(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

bool child_run(child_work work, const void *argument, child_report *report)
{
    int pipe_ends[2];
    double start = timing_now();
    fflush(stdout);
    if (pipe(pipe_ends) != 0)
        return false;
    pid_t child = fork();
    if (child == 0)
        be_child(work, argument, pipe_ends);
    close(pipe_ends[1]);
    if (child > 0)
        read_end(pipe_ends[0], report->answer);
    close(pipe_ends[0]);
    int status = -1;
    struct rusage usage;
    if (child < 0 || wait4(child, &status, 0, &usage) != child)
        return false;
    report->elapsed = timing_now() - start;
    report->seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
#ifdef __APPLE__
    report->peak = (uint64_t)usage.ru_maxrss;
#else
    report->peak = (uint64_t)usage.ru_maxrss * 1024;
#endif
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int child_exec(const void *arguments)
{
    char *const *words = arguments;
    int nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0)
        dup2(nothing, STDERR_FILENO);
    execvp(words[0], words);
    return 127;
}
