/* Takes the library at run time, by dlopen(), as a scripting language would; grows a crystal on several threads, and
   lets the library go. A thread that was left behind would then run code that is no longer there. */
#include <snowgrowth/snowgrowth.h>

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* The functions that are called, each by the name and type that the header gives it. */
typedef struct functions {
    int (*version)(void);
    const char *(*strerror_of)(snow_status status);
    void (*options_init)(snow_options *options, size_t struct_size);
    void (*params_init)(snow_reiter_params *params, size_t struct_size);
    snow_status (*create)(const snow_reiter_params *params, const snow_options *options, snow_grid **grid);
    snow_status (*step)(snow_grid *grid, int64_t steps);
    snow_status (*frozen)(const snow_grid *grid, uint64_t *cells);
    void (*destroy)(snow_grid *grid);
} functions;

/* ISO C has no cast from an object pointer to a function's; POSIX promises that the bytes are the same. */
static int find(void *library, const char *name, void *function)
{
    void *symbol = dlsym(library, name);
    if (symbol == NULL) {
        fprintf(stderr, "plugin: no %s\n", name);
        return 0;
    }
    memcpy(function, &symbol, sizeof symbol);
    return 1;
}

static int find_all(void *library, functions *snow)
{
    return find(library, "snow_version", &snow->version) && find(library, "snow_strerror", &snow->strerror_of) &&
           find(library, "snow_options_init", &snow->options_init) &&
           find(library, "snow_reiter_params_init", &snow->params_init) &&
           find(library, "snow_reiter_create", &snow->create) && find(library, "snow_step", &snow->step) &&
           find(library, "snow_frozen", &snow->frozen) && find(library, "snow_destroy", &snow->destroy);
}

static snow_status grow(const functions *snow, uint64_t *frozen)
{
    snow_options options;
    snow_reiter_params params;
    snow_grid *grid = NULL;
    snow->options_init(&options, sizeof options);
    snow->params_init(&params, sizeof params);
    options.threads = 4;
    params.radius = 100;
    snow_status status = snow->create(&params, &options, &grid);
    if (status == SNOW_OK)
        status = snow->step(grid, 2011);
    if (status == SNOW_OK)
        status = snow->frozen(grid, frozen);
    snow->destroy(grid);
    return status;
}

int main(int argc, char **argv)
{
    functions snow;
    uint64_t frozen = 0;
    void *library = argc == 2 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (library == NULL) {
        fprintf(stderr, "plugin: %s\n", argc == 2 ? dlerror() : "usage: plugin LIBRARY");
        return 1;
    }
    if (!find_all(library, &snow))
        return 1;
    snow_status status = grow(&snow, &frozen);
    printf("%s, %lu cells\n", snow.strerror_of(status), (unsigned long)frozen);
    int same = snow.version() == SNOW_VERSION && status == SNOW_OK && frozen == 7975;
    return !(dlclose(library) == 0 && dlopen(argv[1], RTLD_NOW | RTLD_NOLOAD) == NULL && same);
}
