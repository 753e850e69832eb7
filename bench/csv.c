#include "csv.h"

#include "arguments.h"
#include "machine.h"

#include <snowgrowth/snowgrowth.h>

#include <errno.h>
#include <string.h>

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

FILE *csv_open(const char *path, const char *columns, int argument_count, char *const *arguments, const char *date)
{
    if (path == NULL)
        return NULL;
    FILE *csv = fopen(path, "a");
    if (csv == NULL)
        arguments_fail("%s: %s", path, strerror(errno));
    fseek(csv, 0, SEEK_END);
    if (ftell(csv) == 0)
        fprintf(csv, "%s\n", columns);
    char processor[256];
    machine_processor_name(processor, sizeof processor);
    fprintf(csv, "# command: %s", base_name(arguments[0]));
    for (int i = 1; i < argument_count; i++)
        fprintf(csv, " %s", arguments[i]);
    fprintf(csv, "\n");
    if (date != NULL)
        fprintf(csv, "# date: %s\n", date);
    fprintf(csv, "# processor: %s, %d online, last-level cache %zu KiB\n", processor, (int)machine_processors(),
            machine_last_cache() / 1024);
    fprintf(csv, "# build: snowgrowth %s, %s, %s\n", snow_version_text(), BENCH_COMPILER, BENCH_FLAGS);
    return csv;
}

bool csv_close(FILE *csv)
{
    if (csv == NULL)
        return true;
    bool written = ferror(csv) == 0;
    return fclose(csv) == 0 && written;
}
