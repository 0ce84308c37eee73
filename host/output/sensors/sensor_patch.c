#include "sensor_patch.h"
#include "sphere_box.h"
#include "../../base/memory.h"
#include <math.h>

const double *brc_sensor_patch_point(const brc_domain *d, const brc_sensor_patch *p, int64_t k, double *weight)
{
    const int64_t m = p->members ? p->members[k] : k;
    if (!p->faces) {
        *weight = d->radius ? brc_sphere_is_bonded(d, m) : d->volume[m];
        return d->position + 3 * m;
    }
    const double *s = d->free_area_vector + 3 * m;
    *weight = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    return d->free_centroid + 3 * m;
}

const double *brc_sensor_patch_displacement(const brc_sensor_patch *p, const double *displacement, int64_t k)
{
    if (p->faces) return p->u + 3 * k;
    return displacement + 3 * (p->members ? (int64_t)p->members[k] : k);
}

/* Weights and means of a patch whose members are known. */
static brc_status measure(brc_context *context, const brc_domain *d, brc_sensor_patch *p)
{
    for (int64_t k = 0; k < p->n; ++k) {
        double weight;
        const double *x = brc_sensor_patch_point(d, p, k, &weight);
        p->weight += weight;
        for (int c = 0; c < 3; ++c) {
            p->mean_position[c] += weight * x[c];
            if (p->faces) p->mean_normal[c] += d->free_area_vector[3 * (int64_t)p->members[k] + c];
        }
    }
    if (!(p->weight > 0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "sensors: no element of \"%s\" has a bond; name another set",
                        p->set >= 0 ? d->sets[p->set].name : "all");
    for (int c = 0; c < 3; ++c)
        p->mean_position[c] /= p->weight;
    return p->faces ? BRC_ALLOCATE(context, &p->u, 3 * p->n, "displacement of sensor faces") : BRC_OK;
}

brc_status brc_sensor_patch_of_set(brc_context *context, const brc_domain *d, int32_t set, brc_sensor_patch *out)
{
    *out = (brc_sensor_patch){.set = set};
    out->faces = set >= 0 && d->sets[set].kind == BRC_SET_FACES;
    out->n = set >= 0 ? d->sets[set].n_members : d->n_elements;
    out->members = set >= 0 ? d->sets[set].members : NULL;
    return measure(context, d, out);
}

brc_status brc_sensor_patch_of_faces(brc_context *context, const brc_domain *d, int64_t n, int32_t *members,
                                     brc_sensor_patch *out)
{
    *out = (brc_sensor_patch){.set = -1, .faces = true, .n = n, .members = members, .own = members};
    return measure(context, d, out);
}

void brc_sensor_patch_free(brc_sensor_patch *patch)
{
    brc_memory_free(patch->u);
    brc_memory_free(patch->own);
    *patch = (brc_sensor_patch){.set = -1};
}

brc_status brc_sensor_patch_read(brc_sensor_patch *p, const brc_domain *domain, brc_simulation *simulation,
                                 const double *displacement)
{
    if (p->faces) BRC_TRY(brc_simulation_face_displacement(simulation, p->n, p->members, p->u));
    p->mean_u[0] = p->mean_u[1] = p->mean_u[2] = 0;
    for (int64_t m = 0; m < p->n; ++m) {
        double weight;
        brc_sensor_patch_point(domain, p, m, &weight);
        const double *u = brc_sensor_patch_displacement(p, displacement, m);
        for (int c = 0; c < 3; ++c)
            p->mean_u[c] += weight * u[c];
    }
    for (int c = 0; c < 3; ++c)
        p->mean_u[c] /= p->weight;
    return BRC_OK;
}
