#include "crack_sensors.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

struct brc_crack_sensors {
    brc_context *context;
    const brc_domain *domain;
    double *mass;      /* [n_elements] [kg] */
    int32_t *fragment; /* [n_elements] */
    double *sum;       /* [n_elements] masses of fragments [kg] */
    int64_t n_counted; /* broken bonds that the fragments below belong to; -1: not counted yet */
    int64_t n_fragments;
    double largest; /* share of the mass [-] */
};

brc_status brc_crack_sensors_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                    brc_crack_sensors **out)
{
    const int64_t n = domain->n_elements;
    brc_crack_sensors *s = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s, 1, "sensors of cracks"));
    *s = (brc_crack_sensors){.context = context, .domain = domain, .n_counted = -1};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->mass, n, "sensors of cracks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->fragment, n, "sensors of cracks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &s->sum, n, "sensors of cracks"));
    for (int64_t e = 0; e < n; ++e) {
        const int32_t b = domain->body[e] < scene->n_bodies ? domain->body[e] : 0;
        s->mass[e] =
            domain->volume[e] * scene->materials[brc_body_material(&scene->bodies[b], domain->region[e])].density;
    }
cleanup:
    if (status != BRC_OK) brc_crack_sensors_free(&s);
    *out = s;
    return status;
}

void brc_crack_sensors_free(brc_crack_sensors **sensors)
{
    if (!sensors || !*sensors) return;
    brc_memory_free((*sensors)->mass);
    brc_memory_free((*sensors)->fragment);
    brc_memory_free((*sensors)->sum);
    brc_memory_free(*sensors);
    *sensors = NULL;
}

/* Broken bonds never heal: as many are the same ones. */
static brc_status count_fragments(brc_crack_sensors *s, brc_simulation *simulation)
{
    int64_t n_broken;
    double all = 0;
    BRC_TRY(brc_simulation_broken(simulation, &n_broken));
    if (n_broken == s->n_counted) return BRC_OK;
    BRC_TRY(brc_simulation_fragments(simulation, s->fragment, &s->n_fragments));
    memset(s->sum, 0, (size_t)s->n_fragments * sizeof *s->sum);
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        s->sum[s->fragment[e]] += s->mass[e];
    s->largest = 0;
    for (int64_t i = 0; i < s->n_fragments; ++i) {
        all += s->sum[i];
        s->largest = fmax(s->largest, s->sum[i]);
    }
    s->largest /= all;
    s->n_counted = n_broken;
    return BRC_OK;
}

static brc_status sum_area(brc_simulation *simulation, double *value)
{
    const brc_break *broken;
    int64_t n;
    BRC_TRY(brc_simulation_breaks(simulation, &n, &broken));
    *value = 0;
    for (int64_t k = 0; k < n; ++k)
        *value += broken[k].area;
    return BRC_OK;
}

static brc_status find_tip(brc_simulation *simulation, const brc_sensor *sensor, double *value)
{
    const brc_break *broken;
    int64_t n;
    const double *a = sensor->axis, length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    BRC_TRY(brc_simulation_breaks(simulation, &n, &broken));
    *value = 0;
    for (int64_t k = 0; k < n; ++k) {
        double along = 0;
        for (int c = 0; c < 3; ++c)
            along += (broken[k].position[c] - sensor->point[c]) * a[c] / length;
        *value = k == 0 ? along : fmax(*value, along);
    }
    return BRC_OK;
}

brc_status brc_crack_sensors_read(brc_crack_sensors *s, brc_simulation *simulation, const brc_sensor *sensor,
                                  double *value)
{
    int64_t n;
    if (sensor->kind == BRC_SENSOR_CRACK_TIP) return find_tip(simulation, sensor, value);
    if (strcmp(sensor->term, "crack_area") == 0) return sum_area(simulation, value);
    if (strcmp(sensor->term, "failure_ratio") == 0) return brc_simulation_failure_ratio(simulation, value);
    if (strcmp(sensor->term, "broken") == 0) {
        BRC_TRY(brc_simulation_broken(simulation, &n));
        *value = (double)n;
        return BRC_OK;
    }
    BRC_TRY(count_fragments(s, simulation));
    *value = strcmp(sensor->term, "fragments") == 0 ? (double)s->n_fragments : s->largest;
    return BRC_OK;
}
