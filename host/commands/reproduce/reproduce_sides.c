/* The largest mean load of two sides along a run. */
#include "operators.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

typedef struct sides {
    brc_context *context;
    brc_watched watched;
    int32_t of[2]; /* sensors */
    double scale[2];
    bool is_last; /* in the last stage */
    double largest;
} sides;

static brc_status create(brc_context *context, void **out)
{
    sides *s = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &s, 1, "load of two sides"));
    s->context = context;
    s->largest = -INFINITY;
    *out = s;
    return BRC_OK;
}

static void release(void *self)
{
    sides *s = self;
    if (!s) return;
    brc_watched_close(&s->watched);
    brc_memory_free(s);
}

static brc_status prepare(sides *s, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    int n = 0;
    for (int32_t k = 0; k < scene->n_measures && n < 2; ++k) {
        const brc_measure *m = &scene->measures[k];
        if (m->kind != BRC_MEASURE_PEAK) continue;
        if (m->area_set[0] || m->stage[0] || m->window[1] > 0)
            return BRC_FAIL(s->context, BRC_BAD_INPUT,
                            "`with: sides` expects peaks of the last stage as a whole, by a scale alone; measure %s "
                            "has an area, a stage or a window",
                            m->name);
        s->of[n] = brc_watched_find(scene, m->y); /* the reader has checked the name */
        s->scale[n++] = m->scale;
    }
    if (n < 2)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "`with: sides` expects a scene with two measures of kind peak, one for each side; there are %d",
                        n);
    return brc_watched_open(s->context, &s->watched, simulation);
}

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    sides *s = self;
    s->is_last = stage == brc_simulation_scene(simulation)->n_stages - 1;
    return s->watched.sensors ? BRC_OK : prepare(s, simulation);
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    sides *s = self;
    if (!s->is_last) return BRC_OK;
    BRC_TRY(brc_watched_read(&s->watched, simulation));
    s->largest =
        fmax(s->largest, (s->scale[0] * s->watched.value[s->of[0]] + s->scale[1] * s->watched.value[s->of[1]]) / 2);
    return BRC_OK;
}

static brc_observer observer(void *self)
{
    return (brc_observer){.self = self, .stage_begin = stage_begin, .sample = sample};
}

static brc_status values(const brc_campaign *campaign, const void *self, brc_outcome *outcome)
{
    (void)campaign;
    brc_outcome_add(outcome, "both_sides", "-", ((const sides *)self)->largest, NAN);
    return BRC_OK;
}

/* At every sample of the last stage the mean of the sensors of the scene's first two measures of kind peak, each times
 * its scale. BRC_BAD_INPUT: it has not two, or they divide by an area, or look at another stage or a window.
 * both_sides: the largest of these means, in the unit that the scales give; waves that run to and fro between the
 * sides after breaks raise one while they lower the other. */
const brc_operator brc_operator_sides = {
    .name = "sides", .create = create, .observer = observer, .values = values, .release = release};
