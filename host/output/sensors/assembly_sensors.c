/* Sensors over the parts of a scene. */
#include "assembly_sensors.h"
#include "sensors.h"
#include "../../base/memory.h"
#include <math.h>

struct brc_assembly_sensors {
    brc_assembly *assembly;
    brc_sensors **part; /* [n] */
    double *mass;       /* [n] [kg] */
    double *value;      /* of one part */
    bool *seen;         /* [n_sensors] some part gave its value */
};

brc_status brc_assembly_sensors_create(brc_context *context, brc_assembly *assembly, brc_assembly_sensors **out)
{
    brc_assembly_sensors *s = NULL;
    brc_status status = BRC_OK, first = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s, 1, "sensors"));
    s->assembly = assembly;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->part, assembly->n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->mass, assembly->n, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->value, assembly->scene->n_sensors, "sensors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->seen, assembly->scene->n_sensors, "sensors"));
    for (int32_t k = 0; k < assembly->n; ++k) {
        const brc_domain *domain = brc_simulation_domain(assembly->part[k]);
        const brc_scene *scene = assembly->split ? assembly->split->part[k].scene : assembly->scene;
        const brc_status one = brc_sensors_create(context, scene, domain, &s->part[k]);
        if (one != BRC_OK) first = one;
        if (assembly->split) s->mass[k] = brc_split_mass(&assembly->split->part[k], domain);
    }
    status = first;
cleanup:
    if (status != BRC_OK) brc_assembly_sensors_free(&s);
    *out = s;
    return status;
}

void brc_assembly_sensors_free(brc_assembly_sensors **sensors)
{
    if (!sensors || !*sensors) return;
    brc_assembly_sensors *s = *sensors;
    for (int32_t k = 0; s->part && k < s->assembly->n; ++k)
        brc_sensors_free(&s->part[k]);
    brc_memory_free(s->part);
    brc_memory_free(s->mass);
    brc_memory_free(s->value);
    brc_memory_free(s->seen);
    brc_memory_free(s);
    *sensors = NULL;
}

static double combine(brc_combine how, double before, double value)
{
    switch (how) {
    case BRC_COMBINE_SUM: return before + value;
    case BRC_COMBINE_LARGEST:
    case BRC_COMBINE_LARGEST_MASS: return fmax(before, value);
    case BRC_COMBINE_NONE:
    case BRC_COMBINE_WHOLE: break;
    }
    return value;
}

static brc_status add_part(brc_assembly_sensors *s, int32_t k, double mass_of_all, double *value)
{
    const brc_scene_part *part = &s->assembly->split->part[k];
    BRC_TRY(brc_sensors_evaluate(s->part[k], s->assembly->part[k], s->value));
    for (int32_t i = 0; i < part->scene->n_sensors; ++i) {
        const int32_t whole = part->sensor[i];
        const brc_combine how = brc_split_combine(&part->scene->sensors[i]);
        const double now = how == BRC_COMBINE_LARGEST_MASS ? s->value[i] * s->mass[k] / mass_of_all : s->value[i];
        value[whole] = s->seen[whole] ? combine(how, value[whole], now) : now;
        s->seen[whole] = true;
    }
    return BRC_OK;
}

brc_status brc_assembly_sensors_evaluate(brc_assembly_sensors *s, double *value)
{
    const brc_assembly *a = s->assembly;
    if (!a->split) return brc_sensors_evaluate(s->part[0], a->part[0], value);
    double mass = 0;
    brc_ledger ledger;
    for (int32_t k = 0; k < a->n; ++k)
        mass += s->mass[k];
    for (int32_t i = 0; i < a->scene->n_sensors; ++i)
        s->seen[i] = false;
    for (int32_t k = 0; k < a->n; ++k)
        BRC_TRY(add_part(s, k, mass, value));
    BRC_TRY(brc_assembly_ledger(s->assembly, &ledger));
    for (int32_t i = 0; i < a->scene->n_sensors; ++i) {
        const brc_sensor *sensor = &a->scene->sensors[i];
        if (sensor->kind == BRC_SENSOR_ENERGY) value[i] = brc_ledger_term(&ledger, sensor->term);
        if (sensor->kind == BRC_SENSOR_MODE) value[i] = brc_assembly_mode(a, sensor->index) / (2 * M_PI);
    }
    return BRC_OK;
}
