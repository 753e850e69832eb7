/* Runs a fuzz target over files, or over all files of a folder: the committed corpus, or one finding. It needs no
   fuzzer, so every compiler and every sanitizer can run it. */
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int runs;

static bool replay_file(const char *name)
{
    static uint8_t bytes[1 << 20];
    FILE *file = fopen(name, "rb");
    size_t size = file != NULL ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file == NULL || ferror(file)) {
        perror(name);
        return false;
    }
    fclose(file);
    uint8_t *exact = malloc(size + 1);
    if (exact == NULL)
        return false;
    memcpy(exact, bytes, size);
    (void)LLVMFuzzerTestOneInput(exact, size);
    free(exact);
    runs++;
    return true;
}

static bool replay_folder(const char *name, DIR *folder)
{
    bool sound = true;
    for (const struct dirent *entry; sound && (entry = readdir(folder)) != NULL;) {
        char path[4096];
        if (entry->d_name[0] != '.')
            sound = snprintf(path, sizeof path, "%s/%s", name, entry->d_name) < (int)sizeof path && replay_file(path);
    }
    return sound;
}

static bool replay(const char *name)
{
    DIR *folder = opendir(name);
    if (folder == NULL)
        return replay_file(name);
    bool sound = replay_folder(name, folder);
    closedir(folder);
    return sound;
}

int main(int argc, char **argv)
{
    bool sound = argc > 1;
    for (int i = 1; i < argc && sound; i++)
        sound = replay(argv[i]);
    printf("%d inputs\n", runs);
    return sound && runs > 0 ? 0 : 1;
}
