#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <string.h>

brc_status brc_watched_open(brc_context *context, brc_watched *w, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    BRC_TRY(BRC_ALLOCATE(context, &w->value, scene->n_sensors, "sensors of a run"));
    return brc_sensors_create(context, scene, brc_simulation_domain(simulation), &w->sensors);
}

brc_status brc_watched_read(brc_watched *w, brc_simulation *simulation)
{
    return brc_sensors_evaluate(w->sensors, simulation, w->value);
}

void brc_watched_close(brc_watched *w)
{
    brc_sensors_free(&w->sensors);
    brc_memory_free(w->value);
    w->value = NULL;
}

int32_t brc_watched_find(const brc_scene *scene, const char *name)
{
    int32_t k = 0;
    while (k < scene->n_sensors && strcmp(scene->sensors[k].name, name) != 0)
        ++k;
    return k;
}
