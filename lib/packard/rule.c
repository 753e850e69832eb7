/* Rules as text, both ways. */
#include "base/structs.h"
#include "packard/model.h"

#include <string.h>

enum { DIGITS = 7, ALL_DIGITS = 0x7F, LONGEST = 64 };

/* The text in lower case, without spaces around it. */
static snow_status normalise(const char *text, char word[LONGEST])
{
    while (*text == ' ' || *text == '\t')
        text++;
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r\n", text[length - 1]) != NULL)
        length--;
    if (length == 0 || length >= LONGEST)
        return SNOW_ERROR_PACKARD_RULE;
    for (size_t i = 0; i < length; i++)
        word[i] = (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] - 'A' + 'a' : text[i]);
    word[length] = '\0';
    return SNOW_OK;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t count_digits(const char *text)
{
    size_t count = 0;
    while (is_digit(text[count]))
        count++;
    return count;
}

/* d0 to d6, each 0 or 1. */
static snow_status read_digits(const char *word, uint32_t *rule)
{
    if (strlen(word) != DIGITS)
        return SNOW_ERROR_PACKARD_RULE_LENGTH;
    *rule = 0;
    for (int k = 0; k < DIGITS; k++) {
        if (word[k] != '0' && word[k] != '1')
            return SNOW_ERROR_PACKARD_RULE_DIGIT;
        *rule |= (uint32_t)(word[k] - '0') << k;
    }
    return SNOW_OK;
}

/* Numbers of neighbours, in any order. */
static snow_status read_numbers(const char **text, uint32_t *numbers)
{
    const char *next = *text;
    *numbers = 0;
    for (; is_digit(*next); next++) {
        if (*next > '6')
            return SNOW_ERROR_PACKARD_RULE_DIGIT;
        *numbers |= UINT32_C(1) << (*next - '0');
    }
    *text = next;
    return SNOW_OK;
}

/* "0123456/135": what survives, then what is born. */
static snow_status read_plain(const char **text, uint32_t *born, uint32_t *kept)
{
    snow_status status = read_numbers(text, kept);
    if (status != SNOW_OK)
        return status;
    if (*(*text)++ != '/')
        return SNOW_ERROR_PACKARD_RULE;
    return read_numbers(text, born);
}

/* "b135/s0123456", in either order, with or without the stroke. */
static snow_status read_named(const char **text, uint32_t *born, uint32_t *kept)
{
    bool seen[2] = {false, false};
    while (**text == 'b' || **text == 's') {
        int which = *(*text)++ == 's';
        if (seen[which])
            return SNOW_ERROR_PACKARD_RULE;
        seen[which] = true;
        snow_status status = read_numbers(text, which == 1 ? kept : born);
        if (status != SNOW_OK)
            return status;
        if (**text == '/' && !(seen[0] && seen[1]))
            (*text)++;
    }
    return seen[0] ? SNOW_OK : SNOW_ERROR_PACKARD_RULE;
}

/* What is born and what survives, then the lattice. */
static snow_status read_births(const char *text, uint32_t *rule)
{
    uint32_t kept = 0;
    bool named = *text == 'b' || *text == 's';
    snow_status status = named ? read_named(&text, rule, &kept) : read_plain(&text, rule, &kept);
    if (status != SNOW_OK)
        return status;
    if (*text == '\0')
        return SNOW_ERROR_PACKARD_RULE_LATTICE;
    if (strcmp(text, "h") != 0)
        return SNOW_ERROR_PACKARD_RULE;
    return kept == ALL_DIGITS ? SNOW_OK : SNOW_ERROR_PACKARD_RULE_MELTS;
}

/* A side, which stays 0 when it is too long. */
static int32_t read_side(const char **text)
{
    int64_t side = 0;
    for (; is_digit(**text); (*text)++)
        side = side <= INT32_MAX / 10 ? 10 * side + (**text - '0') : INT64_C(1) << 40;
    return side <= INT32_MAX ? (int32_t)side : 0;
}

/* "t20,13", "p20". */
static snow_status read_universe(const char *text, snow_packard_params *params)
{
    if (*text != 't' && *text != 'p')
        return SNOW_ERROR_PACKARD_RULE_DOMAIN;
    params->domain = *text++ == 't' ? SNOW_PACKARD_TORUS : SNOW_PACKARD_RHOMBUS;
    params->width = params->height = read_side(&text);
    if (*text == ',') {
        text++;
        params->height = read_side(&text);
    }
    if (*text != '\0')
        return SNOW_ERROR_PACKARD_RULE_DOMAIN;
    return snow_packard_is_side(params->width) && snow_packard_is_side(params->height) ? SNOW_OK
                                                                                      : SNOW_ERROR_PACKARD_SIDES;
}

snow_status snow_packard_rule_read(const char *text, snow_packard_params *params)
{
    char word[LONGEST];
    snow_status status = normalise(text, word);
    if (status != SNOW_OK)
        return status;
    char *universe = strchr(word, ':');
    if (universe != NULL)
        *universe++ = '\0';
    bool digits = word[0] != '\0' && word[count_digits(word)] == '\0';
    status = digits ? read_digits(word, &params->rule) : read_births(word, &params->rule);
    if (status == SNOW_OK && universe != NULL)
        status = read_universe(universe, params);
    return status;
}

snow_status snow_packard_params_rule(snow_packard_params *caller, const char *text)
{
    if (caller == NULL || text == NULL)
        return SNOW_ERROR_NULL;
    snow_packard_params params;
    snow_status status = snow_struct_take(&params, sizeof params, caller);
    if (status != SNOW_OK)
        return status;
    status = snow_packard_rule_read(text, &params);
    if (status == SNOW_OK)
        snow_struct_write(caller, &params, sizeof params);
    return status;
}

snow_status snow_packard_rule_text(uint32_t rule, snow_packard_notation notation, char *text, size_t capacity)
{
    if (text == NULL)
        return SNOW_ERROR_NULL;
    if (notation < SNOW_PACKARD_DIGITS || notation > SNOW_PACKARD_BIRTHS)
        return SNOW_ERROR_ENUM;
    if (rule >= PACKARD_RULES)
        return SNOW_ERROR_RANGE;
    char written[SNOW_PACKARD_RULE_SIZE];
    size_t length = 0;
    if (notation == SNOW_PACKARD_BIRTHS)
        written[length++] = 'B';
    for (int k = 0; k < DIGITS; k++) {
        bool one = (rule >> k & 1) != 0;
        if (notation == SNOW_PACKARD_DIGITS)
            written[length++] = one ? '1' : '0';
        else if (one)
            written[length++] = (char)('0' + k);
    }
    const char *rest = notation == SNOW_PACKARD_BIRTHS ? "/S0123456H" : "";
    memcpy(written + length, rest, strlen(rest) + 1);
    length += strlen(rest) + 1;
    if (capacity < length)
        return SNOW_ERROR_BUFFER;
    memcpy(text, written, length);
    return SNOW_OK;
}
