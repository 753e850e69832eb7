/* Rules as text: whatever is taken can be written, and reads the same again. */
#include "fuzz.h"

#include <string.h>

static void check_spelling(const snow_packard_params *params, snow_packard_notation notation)
{
    char text[SNOW_PACKARD_RULE_SIZE];
    snow_packard_params again;
    snow_packard_params_init(&again, sizeof again);
    REQUIRE(snow_packard_rule_text(params->rule, notation, text, sizeof text) == SNOW_OK);
    REQUIRE(snow_packard_params_rule(&again, text) == SNOW_OK && again.rule == params->rule);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[256];
    size_t length = size < sizeof text - 1 ? size : sizeof text - 1;
    if (length > 0)
        memcpy(text, data, length);
    text[length] = '\0';
    snow_packard_params params, before;
    snow_packard_params_init(&params, sizeof params);
    before = params;
    if (snow_packard_params_rule(&params, text) != SNOW_OK) {
        REQUIRE(memcmp(&params, &before, sizeof params) == 0);
        return 0;
    }
    REQUIRE(params.rule < 128 && params.width >= 1 && params.height >= 1);
    check_spelling(&params, SNOW_PACKARD_DIGITS);
    check_spelling(&params, SNOW_PACKARD_BIRTHS);
    return 0;
}
