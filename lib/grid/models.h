/* The registry: every model of the library, a line each in models.c. */
#ifndef SNOW_GRID_MODELS_H
#define SNOW_GRID_MODELS_H

#include "base/model.h"

/* NULL when there is no such model. */
const snow_model_operations *snow_models_find(uint32_t model);

#endif
