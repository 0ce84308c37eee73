/* The free end of a bar, sample by sample. */
#include "reproduce_wave.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

struct brc_wave {
    brc_context *context;
    brc_watched watched;
    int32_t end;   /* sensor */
    const brc_load *load;
    double amplitude, travel; /* [m], T [s] */
    int64_t n;
    double squares_off, squares; /* [m^2] */
    double peak, peak_exact;     /* [m] */
};

brc_status brc_wave_create(brc_context *context, brc_wave **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "wave of a run"));
    (*out)->context = context;
    return BRC_OK;
}

void brc_wave_free(brc_wave **wave)
{
    if (!wave || !*wave) return;
    brc_watched_close(&(*wave)->watched);
    brc_memory_free(*wave);
    *wave = NULL;
}

static brc_status prepare(brc_wave *w, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_stage *stage = &scene->stages[0];
    w->end = brc_watched_find(scene, "end");
    if (w->end == scene->n_sensors || scene->bodies[0].shape.kind != BRC_SHAPE_BOX || stage->n_loads < 1 || stage->loads[0].table.n < 2)
        return BRC_FAIL(w->context, BRC_BAD_INPUT, "`with: wave` expects a box, a sensor named end, and a first load with a table");
    w->load = &stage->loads[0];
    const brc_material *m = &scene->materials[scene->bodies[0].material];
    const int along = scene->sensors[w->end].component;
    const double shear = m->young / (2 * (1 + m->poisson));
    const double modulus = along == 0 ? 2 * shear * (1 - m->poisson) / (1 - 2 * m->poisson) : shear;
    const brc_domain *d = brc_simulation_domain(simulation);
    const double density = m->density * (d->radius ? d->quality.volume_fraction : 1); /* packed spheres weigh what their own volumes do */
    w->amplitude = w->load->value[along];
    w->travel = scene->bodies[0].shape.size[0] / sqrt(modulus / density);
    return brc_watched_open(w->context, &w->watched, simulation);
}

/* a(t), at rest before the stage. */
static double driven(const brc_wave *w, double t) { return t > 0 ? w->amplitude * brc_table_value(&w->load->table, t) : 0; }

static brc_status sample(void *self, brc_simulation *simulation)
{
    brc_wave *w = self;
    if (!w->watched.sensors) BRC_TRY(prepare(w, simulation));
    BRC_TRY(brc_watched_read(&w->watched, simulation));
    const double t = brc_simulation_time(simulation), u = w->watched.value[w->end];
    double exact = 0, sign = 2;
    for (double late = w->travel; late < t; late += 2 * w->travel, sign = -sign) exact += sign * driven(w, t - late);
    w->squares_off += (u - exact) * (u - exact);
    w->squares += exact * exact;
    w->peak = fmax(w->peak, fabs(u));
    w->peak_exact = fmax(w->peak_exact, fabs(exact));
    ++w->n;
    return BRC_OK;
}

brc_observer brc_wave_observer(brc_wave *wave) { return (brc_observer){.self = wave, .sample = sample}; }

brc_status brc_wave_values(const brc_wave *w, brc_outcome *outcome)
{
    if (!(w->squares > 0)) return BRC_FAIL(w->context, BRC_BAD_INPUT, "run %s: no wave came to the end x+; let it run longer than it travels", outcome->run->name);
    brc_outcome_add(outcome, "wave_error", "-", sqrt(w->squares_off / w->squares), 0);
    brc_outcome_add(outcome, "wave_peak", "-", w->peak / w->peak_exact, 1);
    return BRC_OK;
}
