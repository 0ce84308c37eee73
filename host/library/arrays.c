/* The state as arrays: the device's own where it works in host memory, else read back; and what follows from it. */
#include "library_internal.h"
#include "../base/memory.h"
#include "../solver/effects/fracture/fracture.h"
#include "../solver/core/live_arrays.h"
#include <stdio.h>
#include <string.h>

typedef enum derived { REFERENCE, POSITION, STRAIN, STRESS, DAMAGE, N_DERIVED } derived;
static const struct {
    const char *name, *unit;
    int32_t width;
} derivations[N_DERIVED] = {[REFERENCE] = {"reference", "m", 3},
                            [POSITION] = {"position", "m", 3},
                            [STRAIN] = {"strain", "-", 6},
                            [STRESS] = {"stress", "Pa", 6},
                            [DAMAGE] = {"damage", "-", 1}};

int breccia_run_parts(const breccia_run *run)
{
    return run ? run->assembly.n : 0;
}

int breccia_run_array_names(const breccia_run *run, int part, int most, const char **names)
{
    brc_live_array live[BRC_LIVE_ARRAYS_MOST];
    int n = 0;
    if (!run || part < 0 || part >= run->assembly.n) return 0;
    const int n_live = brc_simulation_live_arrays(run->assembly.part[part], live);
    for (int k = 0; k < n_live; ++k, ++n)
        if (n < most) names[n] = live[k].name;
    for (int k = 0; k < N_DERIVED; ++k) {
        if (k == DAMAGE && !brc_simulation_has_fracture(run->assembly.part[part])) continue;
        if (n < most) names[n] = derivations[k].name;
        ++n;
    }
    return n;
}

/* Memory of the run for a copy of `bytes` bytes, the same whenever the array is asked for. */
static brc_status room_for(breccia_run *run, const char *name, int part, int64_t bytes, void **out)
{
    for (int k = 0; k < run->n_copies; ++k)
        if (run->copies[k].part == part && strcmp(run->copies[k].name, name) == 0) {
            *out = run->copies[k].data;
            return BRC_OK;
        }
    if (run->n_copies == BRC_LIBRARY_COPIES)
        return BRC_FAIL(run->context, BRC_INTERNAL, "more than %d arrays were worked out", BRC_LIBRARY_COPIES);
    brc_copy *fresh = &run->copies[run->n_copies];
    BRC_TRY(brc_memory_allocate(run->context, &fresh->data, bytes, 1, "array for a caller"));
    snprintf(fresh->name, sizeof fresh->name, "%s", name);
    fresh->part = part;
    ++run->n_copies;
    *out = fresh->data;
    return BRC_OK;
}

static brc_status show_live(breccia_run *run, int part, const brc_live_array *live, breccia_array *out)
{
    brc_simulation *s = run->assembly.part[part];
    const int bytes_each = brc_precision_state_bytes(brc_device_get_precision(brc_simulation_device(s)));
    *out = (breccia_array){.name = live->name,
                           .unit = live->unit,
                           .precision = bytes_each,
                           .width = live->width,
                           .data = brc_buffer_host(live->buffer),
                           .is_live = true};
    out->n_rows = brc_simulation_rows(s, &out->element);
    if (out->data) return brc_simulation_wait(s);
    const int64_t bytes = out->n_rows * live->width * bytes_each;
    out->is_live = false;
    BRC_TRY(room_for(run, live->name, part, bytes, &out->data));
    return brc_buffer_read(live->buffer, 0, out->data, bytes);
}

static brc_status derive(breccia_run *run, int part, derived what, breccia_array *out)
{
    brc_simulation *s = run->assembly.part[part];
    const brc_domain *d = brc_simulation_domain(s);
    *out = (breccia_array){.name = derivations[what].name,
                           .unit = derivations[what].unit,
                           .precision = sizeof(double),
                           .n_rows = d->n_elements,
                           .width = derivations[what].width};
    if (what == REFERENCE) {
        out->data = d->position;
        out->is_live = true;
        return BRC_OK;
    }
    BRC_TRY(room_for(run, out->name, part, d->n_elements * out->width * (int64_t)sizeof(double), &out->data));
    double *to = out->data;
    switch (what) {
    case STRAIN: return brc_simulation_strain_stress(s, to, NULL, NULL);
    case STRESS: return brc_simulation_strain_stress(s, NULL, NULL, to);
    case DAMAGE: return brc_simulation_damage(s, to);
    default: break;
    }
    BRC_TRY(brc_simulation_displacement(s, to));
    for (int64_t k = 0; k < 3 * d->n_elements; ++k)
        to[k] += d->position[k];
    return BRC_OK;
}

static brc_status find(breccia_run *run, const char *name, int part, breccia_array *out)
{
    brc_live_array live[BRC_LIVE_ARRAYS_MOST];
    if (part < 0 || part >= run->assembly.n)
        return run->assembly.n == 0
                   ? BRC_FAIL(run->context, BRC_BAD_INPUT,
                              "the state is not there: arrays are inside callbacks and between steps")
                   : BRC_FAIL(run->context, BRC_BAD_INPUT, "part %d of %d; count from 0", part, (int)run->assembly.n);
    const int n = brc_simulation_live_arrays(run->assembly.part[part], live);
    for (int k = 0; k < n; ++k)
        if (strcmp(live[k].name, name) == 0) return show_live(run, part, &live[k], out);
    for (int k = 0; k < N_DERIVED; ++k)
        if (strcmp(derivations[k].name, name) == 0) return derive(run, part, (derived)k, out);
    return BRC_FAIL(run->context, BRC_BAD_INPUT,
                    "there is no array '%s' in this run; breccia_run_array_names lists those that are", name);
}

breccia_status breccia_run_array(breccia_run *run, const char *name, int part, breccia_array *out)
{
    *out = (breccia_array){0};
    return run ? brc_public_status(find(run, name, part, out)) : BRECCIA_NO_MEMORY;
}

static brc_status count_bonds(const brc_assembly *a, int64_t *n_bonds, int64_t *n_broken)
{
    *n_bonds = brc_assembly_first_bond(a, a->n);
    *n_broken = 0;
    for (int32_t k = 0; k < a->n; ++k) {
        int64_t broken;
        BRC_TRY(brc_simulation_broken(a->part[k], &broken));
        *n_broken += broken;
    }
    return BRC_OK;
}

breccia_status breccia_run_bonds(breccia_run *run, int64_t *n_bonds, int64_t *n_broken)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->assembly.n == 0) return BRECCIA_BAD_INPUT;
    return brc_public_status(count_bonds(&run->assembly, n_bonds, n_broken));
}

/* ---- sensors ---- */

static const brc_sensor *sensor_of(const breccia_run *run, int sensor)
{
    return run && run->assembly.n > 0 && sensor >= 0 && sensor < run->assembly.scene->n_sensors
               ? &run->assembly.scene->sensors[sensor]
               : NULL;
}

int breccia_run_sensor_count(const breccia_run *run)
{
    return run && run->assembly.n > 0 ? run->assembly.scene->n_sensors : 0;
}

const char *breccia_run_sensor_name(const breccia_run *run, int sensor)
{
    const brc_sensor *s = sensor_of(run, sensor);
    return s ? s->name : NULL;
}

const char *breccia_run_sensor_unit(const breccia_run *run, int sensor)
{
    const brc_sensor *s = sensor_of(run, sensor);
    return s ? brc_sensor_unit(s) : NULL;
}

static brc_status read_sensors(breccia_run *run, double *value)
{
    if (!run->sensors) BRC_TRY(brc_assembly_sensors_create(run->context, &run->assembly, &run->sensors));
    return brc_assembly_sensors_evaluate(run->sensors, value);
}

breccia_status breccia_run_read_sensors(breccia_run *run, double *value)
{
    if (!run) return BRECCIA_NO_MEMORY;
    if (run->assembly.n == 0) return BRECCIA_BAD_INPUT;
    return brc_public_status(read_sensors(run, value));
}
