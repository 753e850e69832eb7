#include <snowgrowth/version.h>

int snow_version(void)
{
    return SNOW_VERSION;
}

const char *snow_version_text(void)
{
    return SNOW_VERSION_TEXT;
}
