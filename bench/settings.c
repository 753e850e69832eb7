#include "settings.h"

#include "arguments.h"
#include "machine.h"

#include <string.h>

const char settings_help[] =
    "  --engine LIST      of plain, auto, rows, reference, quad\n"
    "  --precision LIST   of double, single\n"
    "  --symmetry LIST    of auto, none: fold the scene, or compute every cell\n"
    "  --tolerance LIST   numbers from 0 to 1: changes up to which pieces of the plane stand still\n"
    "  --isa LIST         of auto, baseline, avx2, avx512, or all that run here\n";

bool settings_take(setting_lists *words, int option, const char *text)
{
    switch (option) {
    case SETTING_ENGINE: words->engines = text; return true;
    case SETTING_PRECISION: words->precisions = text; return true;
    case SETTING_SYMMETRY: words->symmetries = text; return true;
    case SETTING_TOLERANCE: words->tolerances = text; return true;
    case SETTING_ISA: words->isas = text; return true;
    default: return false;
    }
}

const char settings_heading[] = "engine    precision  symmetry  tolerance  isa      threads";

static void add_way(variant_list *list, const variant *way)
{
    if (list->count == MOST_VARIANTS)
        arguments_fail("more than %d variants", MOST_VARIANTS);
    list->ways[list->count++] = *way;
}

static void set_precision(variant *way, const char *word)
{
    if (strcmp(word, "double") != 0 && strcmp(word, "single") != 0)
        arguments_fail("there is no precision '%s'", word);
    way->precision = word[0] == 's' ? SNOW_REITER_PRECISION_SINGLE : SNOW_REITER_PRECISION_DOUBLE;
}

static void set_symmetry(variant *way, const char *word)
{
    if (strcmp(word, "auto") != 0 && strcmp(word, "none") != 0)
        arguments_fail("symmetry is auto or none, not '%s'", word);
    way->symmetry = word[0] == 'n' ? SNOW_REITER_SYMMETRY_NONE : SNOW_REITER_SYMMETRY_AUTO;
}

static void set_tolerance(variant *way, const char *word)
{
    way->tolerance = arguments_number("--tolerance", word, 0.0, 1.0);
}

static const snow_isa all_isas[] = {SNOW_ISA_AUTO, SNOW_ISA_BASELINE, SNOW_ISA_AVX2, SNOW_ISA_AVX512};

static void set_isa(variant *way, const char *word)
{
    for (size_t i = 0; i < sizeof all_isas / sizeof all_isas[0]; i++) {
        if (strcmp(snow_isa_name(all_isas[i]), word) != 0)
            continue;
        if (!snow_isa_available(all_isas[i]))
            arguments_fail("instruction set %s cannot be used here", word);
        way->isa = all_isas[i];
        return;
    }
    arguments_fail("there is no instruction set '%s'", word);
}

static void set_threads(variant *way, const char *word)
{
    way->threads = (int32_t)arguments_integer("--threads", word, 0, MOST_THREADS);
    if (way->threads == 0)
        way->threads = machine_processors();
}

/* Puts in the place of each variant that knows the setting one for each of the words. */
static void widen(variant_list *list, bool (*knows)(const variant *way), const char *words,
                  void (*set)(variant *way, const char *word))
{
    variant_list narrow = *list;
    list->count = 0;
    for (size_t i = 0; i < narrow.count; i++) {
        if (!knows(&narrow.ways[i])) {
            add_way(list, &narrow.ways[i]);
            continue;
        }
        const char *rest = words;
        for (char word[32]; arguments_next_word(&rest, word, sizeof word);) {
            variant way = narrow.ways[i];
            set(&way, word);
            add_way(list, &way);
        }
    }
}

static void list_available_isas(char *words, size_t size)
{
    size_t length = 0;
    for (size_t i = 1; i < sizeof all_isas / sizeof all_isas[0]; i++)
        if (snow_isa_available(all_isas[i]))
            length += (size_t)snprintf(words + length, size - length, "%s,", snow_isa_name(all_isas[i]));
}

void settings_add(variant_list *list, const setting_lists *words)
{
    char isas[64];
    list_available_isas(isas, sizeof isas);
    variant_list added = {0};
    const char *engines = words->engines;
    for (char word[32]; arguments_next_word(&engines, word, sizeof word);) {
        variant way;
        if (!variant_find(word, &way))
            arguments_fail("there is no engine '%s'", word);
        add_way(&added, &way);
    }
    widen(&added, variant_has_precisions, words->precisions, set_precision);
    widen(&added, variant_has_settings, words->symmetries, set_symmetry);
    widen(&added, variant_has_settings, words->tolerances, set_tolerance);
    widen(&added, variant_has_settings, strcmp(words->isas, "all") == 0 ? isas : words->isas, set_isa);
    widen(&added, variant_has_settings, words->threads, set_threads);
    if (added.count == 0)
        arguments_fail("no engine, or no value of a setting, is left to measure");
    for (size_t i = 0; i < added.count; i++)
        add_way(list, &added.ways[i]);
}

/* The settings in words. */
typedef struct labels {
    const char *precision, *symmetry, *isa;
    char tolerance[16];
    char threads[16];
} labels;

static labels labels_of(const variant *way)
{
    labels words = {.precision = "-", .symmetry = "-", .isa = "-", .tolerance = "-", .threads = "1"};
    if (variant_has_precisions(way))
        words.precision = way->precision == SNOW_REITER_PRECISION_SINGLE ? "single" : "double";
    if (!variant_has_settings(way))
        return words;
    words.symmetry = way->symmetry == SNOW_REITER_SYMMETRY_NONE ? "none" : "auto";
    words.isa = snow_isa_name(way->isa);
    snprintf(words.tolerance, sizeof words.tolerance, "%g", way->tolerance);
    snprintf(words.threads, sizeof words.threads, "%d", (int)way->threads);
    return words;
}

void settings_print(FILE *report, const variant *way)
{
    labels words = labels_of(way);
    fprintf(report, "%-9s %-10s %-9s %-10s %-8s %7s", way->name, words.precision, words.symmetry, words.tolerance,
            words.isa, words.threads);
}

void settings_write(FILE *csv, const variant *way)
{
    labels words = labels_of(way);
    fprintf(csv, "%s,%s,%s,%s,%s,%s,", way->name, words.precision, words.symmetry, words.tolerance, words.isa,
            words.threads);
}
