#include "common/progress.h"

#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static atomic_int cancelled;
static bool terminal;
static bool shown;
static double shown_at;

static void ask_for_end(int signal_number)
{
    (void)signal_number;
    atomic_store(&cancelled, 1);
}

void progress_start(void)
{
    struct sigaction action = {.sa_handler = ask_for_end, .sa_flags = (int)SA_RESETHAND | SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    terminal = isatty(STDERR_FILENO) == 1;
}

bool progress_cancelled(void)
{
    return atomic_load(&cancelled) != 0;
}

double progress_clock(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void progress_show(const char *format, ...)
{
    if (!terminal || progress_clock() < shown_at + 0.1)
        return;
    va_list arguments;
    fprintf(stderr, "\r\033[K%s: ", message_program_name());
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fflush(stderr);
    shown = true;
    shown_at = progress_clock();
}

void progress_clear(void)
{
    if (shown)
        fputs("\r\033[K", stderr);
    shown = false;
}

int progress_of_run(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)context;
    (void)grid;
    progress_show("step %lld, %llu cells of ice, tip at %.0f", (long long)summary->steps,
                  (unsigned long long)summary->frozen, summary->tip_radius);
    return progress_cancelled();
}

int progress_of_panel(void *context, const snow_grid *grid, const snow_summary *summary)
{
    (void)context;
    (void)grid;
    (void)summary;
    return progress_cancelled();
}
