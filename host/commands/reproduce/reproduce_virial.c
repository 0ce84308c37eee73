/* Mean virial stress of elements against the stress of the sample, as NAH19 eq. 9. */
#include "operators.h"
#include "../../base/memory.h"
#include "../../output/sensors/sphere_box.h"
#include <math.h>

enum { LEVELS = 3 };
/* Diameters from the walls within which elements are not inside: every level-2 neighbourhood of the rest is whole. */
#define RIM 2.0

/* The sample: which way it is pulled, and by what. */
typedef struct sample {
    int axis;
    double stress; /* force over section [Pa] */
    uint8_t *kind; /* [n_elements] 0: loaded or without bonds, 1: near a wall, 2: inside; owned */
} sample;

static brc_status find_pull(brc_context *context, brc_simulation *simulation, const brc_case_run *run, sample *out)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_domain *d = brc_simulation_domain(simulation);
    const brc_stage *stage = &scene->stages[scene->n_stages - 1];
    double force[3], section = NAN;
    int32_t set = -1;
    out->axis = -1;
    for (int c = 0; c < 3 && stage->n_loads == 2; ++c)
        if (stage->loads[0].component[c] && stage->loads[1].component[c]) out->axis = c;
    if (out->axis >= 0) set = brc_domain_find_set(d, stage->loads[1].set);
    if (set >= 0 && d->radius) section = brc_sphere_box_section(d, set);
    if (scene->n_bodies != 1 || !isfinite(section))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "run %s: `with: virial` expects one box of spheres and in the last stage two loads that pull walls apart",
            run->name);
    BRC_TRY(brc_simulation_reaction(simulation, set, force));
    out->stress = force[out->axis] / section;
    return BRC_OK;
}

static brc_status sort_elements(brc_context *context, brc_simulation *simulation, sample *out)
{
    const brc_domain *d = brc_simulation_domain(simulation);
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_stage *stage = &scene->stages[scene->n_stages - 1];
    const double rim = RIM * brc_sphere_mean_diameter(d);
    BRC_TRY(BRC_ALLOCATE(context, &out->kind, d->n_elements, "elements of a sample"));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = d->position + 3 * e;
        out->kind[e] = 2;
        for (int c = 0; c < 3; ++c)
            if (x[c] - d->bounds[0][c] < rim || d->bounds[1][c] - x[c] < rim) out->kind[e] = 1;
        if (!brc_sphere_is_bonded(d, e)) out->kind[e] = 0;
    }
    for (int l = 0; l < stage->n_loads; ++l) {
        const brc_set *set = &d->sets[brc_domain_find_set(d, stage->loads[l].set)];
        for (int64_t k = 0; k < set->n_members; ++k)
            out->kind[set->members[k]] = 0;
    }
    return BRC_OK;
}

/* Mean over the elements of at least this kind, and standard deviation. */
static double mean_of(const brc_domain *d, const sample *s, const double *stress, int least, double *deviation)
{
    double sum = 0, square = 0;
    int64_t n = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (s->kind[e] >= least) sum += stress[6 * e + s->axis], ++n;
    const double mean = sum / (double)n;
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (s->kind[e] >= least) square += (stress[6 * e + s->axis] - mean) * (stress[6 * e + s->axis] - mean);
    *deviation = sqrt(square / (double)n);
    return mean;
}

static brc_status finished(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    const brc_domain *d = brc_simulation_domain(simulation);
    double *stress = NULL;
    sample s = {0};
    brc_status status = BRC_OK;
    BRC_TRY(find_pull(context, simulation, outcome->run, &s));
    BRC_TRY_OR(cleanup, sort_elements(context, simulation, &s));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &stress, 6 * d->n_elements, "virial stresses"));
    for (int level = 0; level < LEVELS; ++level) {
        char name[3][BRC_NAME];
        double deviation;
        snprintf(name[0], BRC_NAME, "level_%d", level);
        snprintf(name[1], BRC_NAME, "inside_%d", level);
        snprintf(name[2], BRC_NAME, "scatter_%d", level);
        BRC_TRY_OR(cleanup, brc_simulation_virial_stress(simulation, level, stress));
        brc_outcome_add(outcome, name[0], "-", mean_of(d, &s, stress, 1, &deviation) / s.stress - 1, 0);
        const double inside = mean_of(d, &s, stress, 2, &deviation);
        brc_outcome_add(outcome, name[1], "-", inside / s.stress - 1, 0);
        brc_outcome_add(outcome, name[2], "-", deviation / inside, NAN);
    }
cleanup:
    brc_memory_free(s.kind);
    brc_memory_free(stress);
    return status;
}

/* The virial operator, at the end of a run, for levels 0, 1, 2: level_K, mean of the normal stress along the pull over
 * the bonded elements that are not loaded, over force / section, minus 1; inside_K, the same over those more than two
 * mean diameters away from the walls; scatter_K, how those differ from each other (standard deviation over mean).
 * BRC_BAD_INPUT: not one box of spheres pulled along an axis by two loads in its last stage. */
const brc_operator brc_operator_virial = {.name = "virial", .finished = finished};
