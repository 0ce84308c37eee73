/* The largest mean load of two sides along a run. */
#include "reproduce_sides.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

struct brc_sides {
    brc_context *context;
    brc_watched watched;
    int32_t of[2];    /* sensors */
    double scale[2];
    bool is_last;     /* in the last stage */
    double largest;
};

brc_status brc_sides_create(brc_context *context, brc_sides **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "load of two sides"));
    (*out)->context = context;
    (*out)->largest = -INFINITY;
    return BRC_OK;
}

void brc_sides_free(brc_sides **sides)
{
    if (!sides || !*sides) return;
    brc_watched_close(&(*sides)->watched);
    brc_memory_free(*sides);
    *sides = NULL;
}

static brc_status prepare(brc_sides *s, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    int n = 0;
    for (int32_t k = 0; k < scene->n_measures && n < 2; ++k) {
        const brc_measure *m = &scene->measures[k];
        if (m->kind != BRC_MEASURE_PEAK) continue;
        if (m->area_set[0] || m->stage[0] || m->window[1] > 0)
            return BRC_FAIL(s->context, BRC_BAD_INPUT, "`with: sides` expects peaks of the last stage as a whole, by a scale alone; measure %s has an area, a stage or a window", m->name);
        s->of[n] = brc_watched_find(scene, m->y); /* the reader has checked the name */
        s->scale[n++] = m->scale;
    }
    if (n < 2) return BRC_FAIL(s->context, BRC_BAD_INPUT, "`with: sides` expects a scene with two measures of kind peak, one for each side; there are %d", n);
    return brc_watched_open(s->context, &s->watched, simulation);
}

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    brc_sides *s = self;
    s->is_last = stage == brc_simulation_scene(simulation)->n_stages - 1;
    return s->watched.sensors ? BRC_OK : prepare(s, simulation);
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    brc_sides *s = self;
    if (!s->is_last) return BRC_OK;
    BRC_TRY(brc_watched_read(&s->watched, simulation));
    s->largest = fmax(s->largest, (s->scale[0] * s->watched.value[s->of[0]] + s->scale[1] * s->watched.value[s->of[1]]) / 2);
    return BRC_OK;
}

brc_observer brc_sides_observer(brc_sides *sides) { return (brc_observer){.self = sides, .stage_begin = stage_begin, .sample = sample}; }

void brc_sides_values(const brc_sides *sides, brc_outcome *outcome) { brc_outcome_add(outcome, "both_sides", "-", sides->largest, NAN); }
