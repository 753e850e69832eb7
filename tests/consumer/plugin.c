/* Takes the library at run time, by dlopen(), as a scripting language would. */
#include <snowgrowth/snowgrowth.h>

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* ISO C has no cast from an object pointer to a function's; POSIX promises that the bytes are the same. */
static int find(void *library, const char *name, void *function, size_t size)
{
    void *symbol = dlsym(library, name);
    if (symbol == NULL || size != sizeof symbol)
        return 0;
    memcpy(function, &symbol, size);
    return 1;
}

int main(int argc, char **argv)
{
    void *library = argc == 2 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (library == NULL) {
        fprintf(stderr, "plugin: %s\n", argc == 2 ? dlerror() : "usage: plugin LIBRARY");
        return 1;
    }
    int (*version)(void) = NULL;
    const char *(*strerror_of)(snow_status) = NULL;
    if (!find(library, "snow_version", &version, sizeof version)
        || !find(library, "snow_strerror", &strerror_of, sizeof strerror_of)) {
        fprintf(stderr, "plugin: a public function is missing\n");
        return 1;
    }
    printf("%s\n", strerror_of(SNOW_OK));
    return !(version() == SNOW_VERSION && dlclose(library) == 0);
}
