#include "common/output.h"

#include "common/message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void output_complain(const output *self)
{
    complain("%s: %s", self->name, errno ? strerror(errno) : "writing failed");
}

static bool fail(output *self)
{
    output_complain(self);
    output_discard(self);
    return false;
}

/* A device or a pipe cannot be replaced by a file. */
static bool is_written_in_place(const char *name)
{
    struct stat status;
    return stat(name, &status) == 0 && !S_ISREG(status.st_mode);
}

/* The file behind a symbolic link is replaced, not the link. */
static char *place_of(const char *name)
{
    char *place = realpath(name, NULL);
    return place ? place : strdup(name);
}

static char *name_beside(const char *place)
{
    size_t size = strlen(place) + 32;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%s.%ld.part", place, (long)getpid());
    return name;
}

/* Asks for the right to write before the work is done, not after. */
static bool may_replace(const char *place)
{
    return access(place, F_OK) != 0 || access(place, W_OK) == 0;
}

bool output_open(output *self, const char *name)
{
    *self = (output){.name = name};
    if (name == NULL)
        return true;
    errno = 0;
    if (is_written_in_place(name)) {
        self->file = fopen(name, "wb");
        return self->file ? true : fail(self);
    }
    self->final = place_of(name);
    char *temporary = self->final && may_replace(self->final) ? name_beside(self->final) : NULL;
    if (temporary == NULL)
        return fail(self);
    int descriptor = open(temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0) {
        free(temporary);
        return fail(self);
    }
    self->temporary = temporary;
    self->file = fdopen(descriptor, "wb");
    return self->file ? true : fail(self);
}

bool output_open_both(output *first, const char *first_name, output *second, const char *second_name)
{
    if (!output_open(first, first_name))
        return false;
    if (output_open(second, second_name))
        return true;
    output_discard(first);
    return false;
}

bool output_commit(output *self)
{
    if (self->file == NULL)
        return true;
    errno = 0;
    if (ferror(self->file) || fflush(self->file) != 0 || (self->temporary && fsync(fileno(self->file)) != 0))
        return fail(self);
    FILE *file = self->file;
    self->file = NULL;
    if (fclose(file) != 0 || (self->temporary && rename(self->temporary, self->final) != 0))
        return fail(self);
    free(self->temporary);
    self->temporary = NULL;
    output_discard(self);
    return true;
}

void output_discard(output *self)
{
    if (self->file)
        fclose(self->file);
    if (self->temporary)
        unlink(self->temporary);
    free(self->temporary);
    free(self->final);
    *self = (output){.name = self->name};
}
