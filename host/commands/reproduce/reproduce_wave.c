/* The free end of a bar, sample by sample. */
#include "operators.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

typedef struct wave {
    brc_context *context;
    brc_watched watched;
    int32_t end; /* sensor */
    const brc_load *load;
    double amplitude, travel; /* [m], T [s] */
    int64_t n;
    double squares_off, squares; /* [m^2] */
    double peak, peak_exact;     /* [m] */
} wave;

static brc_status create(brc_context *context, void **out)
{
    wave *w = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &w, 1, "wave of a run"));
    w->context = context;
    *out = w;
    return BRC_OK;
}

static void release(void *self)
{
    wave *w = self;
    if (!w) return;
    brc_watched_close(&w->watched);
    brc_memory_free(w);
}

static brc_status prepare(wave *w, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_stage *stage = &scene->stages[0];
    w->end = brc_watched_find(scene, "end");
    if (w->end == scene->n_sensors || scene->bodies[0].shape.kind != BRC_SHAPE_BOX || stage->n_loads < 1 ||
        stage->loads[0].table.n < 2)
        return BRC_FAIL(w->context, BRC_BAD_INPUT,
                        "`with: wave` expects a box, a sensor named end, and a first load with a table");
    w->load = &stage->loads[0];
    const brc_material *m = &scene->materials[scene->bodies[0].material];
    const int along = scene->sensors[w->end].component;
    const double shear = m->young / (2 * (1 + m->poisson));
    const double modulus = along == 0 ? 2 * shear * (1 - m->poisson) / (1 - 2 * m->poisson) : shear;
    w->amplitude = w->load->value[along];
    w->travel = scene->bodies[0].shape.size[0] / sqrt(modulus / m->density);
    return brc_watched_open(w->context, &w->watched, simulation);
}

/* a(t), at rest before the stage. */
static double driven(const wave *w, double t)
{
    return t > 0 ? w->amplitude * brc_table_value(&w->load->table, t) : 0;
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    wave *w = self;
    if (!w->watched.sensors) BRC_TRY(prepare(w, simulation));
    BRC_TRY(brc_watched_read(&w->watched, simulation));
    const double t = brc_simulation_time(simulation), u = w->watched.value[w->end];
    double exact = 0, sign = 2;
    for (double late = w->travel; late < t; late += 2 * w->travel, sign = -sign)
        exact += sign * driven(w, t - late);
    w->squares_off += (u - exact) * (u - exact);
    w->squares += exact * exact;
    w->peak = fmax(w->peak, fabs(u));
    w->peak_exact = fmax(w->peak_exact, fabs(exact));
    ++w->n;
    return BRC_OK;
}

static brc_observer observer(void *self)
{
    return (brc_observer){.self = self, .sample = sample};
}

static brc_status values(const brc_campaign *campaign, const void *self, brc_outcome *outcome)
{
    const wave *w = self;
    (void)campaign;
    if (!(w->squares > 0))
        return BRC_FAIL(w->context, BRC_BAD_INPUT,
                        "run %s: no wave came to the end x+; let it run longer than it travels", outcome->run->name);
    brc_outcome_add(outcome, "wave_error", "-", sqrt(w->squares_off / w->squares), 0);
    brc_outcome_add(outcome, "wave_peak", "-", w->peak / w->peak_exact, 1);
    return BRC_OK;
}

/* The wave operator: a box whose end x- moves by the first load of the stage, u(t) = a(t) e, and whose end x+ is free.
 * Its mean displacement, the scene's sensor `end`, is held against 2 [a(t - T) - a(t - 3 T) + a(t - 5 T) - ...], T =
 * length / speed, at every sample. The speed is that of plane waves in a bar of the body's own mass, so the loads must
 * keep the bar plane: sides that slide for a pressure wave (e along x), sides held in their normal's other directions
 * for a shear wave (e across x). wave_error: root of the mean square of the difference over that of the solution;
 * wave_peak: largest displacement over the solution's. BRC_BAD_INPUT: no such scene. */
const brc_operator brc_operator_wave = {
    .name = "wave", .create = create, .observer = observer, .values = values, .release = release};
