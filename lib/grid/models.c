#include "grid/models.h"

#include "aggregate/model.h"
#include "packard/model.h"
#include "reiter/model.h"

static const snow_model_operations *const models[] = {
    &snow_reiter_operations,
    &snow_packard_operations,
    &snow_aggregate_operations,
};

enum { MODELS = sizeof models / sizeof models[0] };

size_t snow_model_count(void)
{
    return MODELS;
}

const char *snow_model_name(size_t index, snow_model *model)
{
    if (index >= MODELS)
        return NULL;
    if (model != NULL)
        *model = models[index]->model;
    return models[index]->name;
}

const snow_model_operations *snow_models_find(uint32_t model)
{
    for (size_t i = 0; i < MODELS; i++)
        if ((uint32_t)models[i]->model == model)
            return models[i];
    return NULL;
}
