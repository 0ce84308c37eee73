#include "opening.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int c = 0; c < 3; ++c)
        a[c] /= length;
}

/* Ties go to the smaller id. */
static int32_t nearest(const brc_domain *d, const double point[3])
{
    int32_t best = 0;
    double least = INFINITY;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double r[3] = {d->position[3 * e] - point[0], d->position[3 * e + 1] - point[1],
                             d->position[3 * e + 2] - point[2]};
        if (dot(r, r) >= least) continue;
        least = dot(r, r);
        best = (int32_t)e;
    }
    return best;
}

static brc_status prepare_points(brc_context *context, const brc_domain *d, const brc_sensor *sensor, brc_opening *out)
{
    out->of_points = true;
    out->element[0] = nearest(d, sensor->point);
    out->element[1] = nearest(d, sensor->point2);
    if (out->element[0] == out->element[1])
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "sensor %s: one element (of about %.3g m) is the nearest to both points; expected points "
                        "farther apart, or smaller elements",
                        sensor->name, d->quality.mean_spacing);
    double along[3];
    for (int c = 0; c < 3; ++c)
        along[c] = sensor->point2[c] - sensor->point[c];
    if (dot(sensor->axis, sensor->axis) > 0) {
        const double side = dot(sensor->axis, along) < 0 ? -1 : 1;
        for (int c = 0; c < 3; ++c)
            out->direction[c] = side * sensor->axis[c];
    } else {
        memcpy(out->direction, along, sizeof along);
    }
    normalise(out->direction);
    return BRC_OK;
}

static brc_status find_set(brc_context *context, const brc_domain *d, const brc_sensor *sensor, const char *name,
                           brc_sensor_patch *out)
{
    const int32_t set = brc_domain_find_set(d, name);
    if (set < 0 || d->sets[set].n_members == 0)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "sensor %s: there is no set \"%s\" in the domain, or it is empty; name a wall or one of the scene's sets",
            sensor->name, name);
    return brc_sensor_patch_of_set(context, d, set, out);
}

/* Which way is apart: by the places of the two sides; where these are one and the same, as of two lips, by the normals
 * of their faces, which look at each other. */
static brc_status prepare_sets(brc_context *context, const brc_domain *d, const brc_sensor *sensor, brc_opening *out)
{
    BRC_TRY(find_set(context, d, sensor, sensor->set, &out->side[0]));
    BRC_TRY(find_set(context, d, sensor, sensor->set2, &out->side[1]));
    const brc_sensor_patch *a = &out->side[0], *b = &out->side[1];
    double apart = 0, extent = 0, size = 0, facing = 0;
    memcpy(out->direction, sensor->axis, sizeof out->direction);
    normalise(out->direction);
    for (int c = 0; c < 3; ++c) {
        apart += (b->mean_position[c] - a->mean_position[c]) * out->direction[c];
        facing += (a->mean_normal[c] - b->mean_normal[c]) * out->direction[c];
        size += fabs(a->mean_normal[c]) + fabs(b->mean_normal[c]);
        extent = fmax(extent, d->bounds[1][c] - d->bounds[0][c]);
    }
    if (fabs(apart) < 1e-6 * extent) apart = fabs(facing) > 1e-3 * size ? facing : 0;
    if (apart == 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "sensor %s: \"%s\" and \"%s\" are at one place along the direction and do not face each other "
                        "along it; expected another direction, or sets on either side",
                        sensor->name, sensor->set, sensor->set2);
    for (int c = 0; c < 3 && apart < 0; ++c)
        out->direction[c] = -out->direction[c];
    return BRC_OK;
}

/* Normal of the crack of this name; false: no body of the scene tells. */
static bool normal_of(const brc_scene *scene, const char *name, double out[3])
{
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        for (int32_t k = 0; k < scene->bodies[b].n_cracks; ++k) {
            const brc_crack *crack = &scene->bodies[b].cracks[k];
            const double *u = crack->edge[0], *v = crack->edge[1];
            if (strcmp(crack->name, name) != 0) continue;
            for (int c = 0; c < 3; ++c)
                out[c] = crack->kind == BRC_CRACK_DISC
                             ? crack->normal[c]
                             : u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
            return true;
        }
    return false;
}

/* The crack's faces near the place whose outward normals look along the direction (side 0) or against it (side 1);
 * returns the least distance of any face from the place [m]. */
static brc_status gather(brc_context *context, const brc_domain *d, const brc_set *set, const brc_sensor *sensor,
                         brc_opening *out, double *least)
{
    for (int side = 0; side < 2; ++side) {
        int32_t *members = NULL;
        int64_t n = 0;
        BRC_TRY(BRC_ALLOCATE(context, &members, set->n_members, "faces of a crack"));
        for (int64_t k = 0; k < set->n_members; ++k) {
            const double *x = d->free_centroid + 3 * (int64_t)set->members[k];
            const double away = hypot(hypot(x[0] - sensor->point[0], x[1] - sensor->point[1]), x[2] - sensor->point[2]);
            const double along = dot(d->free_area_vector + 3 * (int64_t)set->members[k], out->direction);
            if (sensor->is_near && away < *least) *least = away;
            if ((side ? along < 0 : along > 0) && (!sensor->is_near || away <= sensor->within))
                members[n++] = set->members[k];
        }
        if (n == 0) {
            brc_memory_free(members);
            return BRC_OK;
        }
        BRC_TRY(brc_sensor_patch_of_faces(context, d, n, members, &out->side[side]));
    }
    return BRC_OK;
}

static brc_status prepare_crack(brc_context *context, const brc_scene *scene, const brc_domain *d,
                                const brc_sensor *sensor, brc_opening *out)
{
    const int32_t set = brc_domain_find_set(d, sensor->set);
    double least = INFINITY;
    if (set < 0 || d->sets[set].kind != BRC_SET_FACES)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "sensor %s: the bodies have no faces of a crack \"%s\"; spheres have none at all: give `from` "
                        "and `to`, or two sets",
                        sensor->name, sensor->set);
    memcpy(out->direction, sensor->axis, sizeof out->direction);
    if (dot(sensor->axis, sensor->axis) == 0 && !normal_of(scene, sensor->set, out->direction))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "sensor %s: the scene does not say how crack \"%s\" lies; give a direction, as in direction: [1, 0, 0]",
            sensor->name, sensor->set);
    normalise(out->direction);
    BRC_TRY(gather(context, d, &d->sets[set], sensor, out, &least));
    if (out->side[0].n > 0 && out->side[1].n > 0) return BRC_OK;
    if (sensor->is_near)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "sensor %s: crack \"%s\" has no faces on both sides within %.4g m of (%.6g, %.6g, %.6g) m, the "
                        "nearest is %.4g m away; widen `within`",
                        sensor->name, sensor->set, sensor->within, sensor->point[0], sensor->point[1], sensor->point[2],
                        least);
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "sensor %s: crack \"%s\" has no faces on both sides of the direction; expected one across it",
                    sensor->name, sensor->set);
}

brc_status brc_opening_prepare(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                               const brc_sensor *sensor, brc_opening *out)
{
    *out = (brc_opening){.of_points = false};
    if (sensor->of_points) return prepare_points(context, domain, sensor, out);
    return sensor->of_crack ? prepare_crack(context, scene, domain, sensor, out)
                            : prepare_sets(context, domain, sensor, out);
}

void brc_opening_free(brc_opening *opening)
{
    for (int side = 0; side < 2; ++side)
        brc_sensor_patch_free(&opening->side[side]);
}

bool brc_opening_needs_elements(const brc_opening *o)
{
    return o->of_points || (o->side[0].n > 0 && !(o->side[0].faces && o->side[1].faces));
}

brc_status brc_opening_read(brc_opening *o, const brc_domain *domain, brc_simulation *simulation,
                            const double *displacement, double *value)
{
    *value = 0;
    for (int side = 0; side < 2; ++side) {
        if (!o->of_points) BRC_TRY(brc_sensor_patch_read(&o->side[side], domain, simulation, displacement));
        const double *u = o->of_points ? displacement + 3 * (int64_t)o->element[side] : o->side[side].mean_u;
        *value += (side ? 1 : -1) * dot(u, o->direction);
    }
    return BRC_OK;
}
