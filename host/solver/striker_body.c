/* What a striker is: volume, mass centre and inertia of its shape, where the scene puts it. */
#include "../../preprocess/pose.h"
#include "strikers_internal.h"
#include <math.h>
#include <string.h>

/* Of a smooth shape at unit density, in its own axes: volume [m^3], centre, moments about it along the axes [m^5]. */
typedef struct solid_moments {
    double volume, centre[3], moment[3];
} solid_moments;

static solid_moments of_box(const brc_shape *shape)
{
    const double *a = shape->size;
    solid_moments m = {.volume = a[0] * a[1] * a[2]};
    for (int c = 0; c < 3; ++c) {
        m.centre[c] = shape->origin[c] + 0.5 * a[c];
        m.moment[c] = m.volume * (a[(c + 1) % 3] * a[(c + 1) % 3] + a[(c + 2) % 3] * a[(c + 2) % 3]) / 12;
    }
    return m;
}

/* Along the shape's axis, and across it. */
static void set_moments(const brc_shape *shape, double along, double across, solid_moments *m)
{
    for (int c = 0; c < 3; ++c) m->moment[c] = c == shape->axis ? along : across;
}

/* Integrals over the height of r^2, r^4, r^2 z and r^2 z^2 with the radius r linear in z. */
static solid_moments of_frustum(const brc_shape *shape)
{
    const double p = shape->radius, q = shape->kind == BRC_SHAPE_CYLINDER ? p : shape->radius2, h = shape->length;
    const double second = p * p + p * q + q * q, fourth = p * p * p * p + p * p * p * q + p * p * q * q + p * q * q * q + q * q * q * q;
    const double height = h * (p * p + 2 * p * q + 3 * q * q) / (4 * second);
    solid_moments m = {.volume = M_PI * h * second / 3};
    memcpy(m.centre, shape->origin, sizeof m.centre);
    m.centre[shape->axis] += height;
    set_moments(shape, M_PI * h * fourth / 10, M_PI * h * fourth / 20 + M_PI * h * h * h * (p * p / 30 + p * q / 10 + q * q / 5) - m.volume * height * height, &m);
    return m;
}

static solid_moments of_ball(const brc_shape *shape)
{
    const double r = shape->radius;
    solid_moments m = {.volume = 4 * M_PI / 3 * r * r * r};
    memcpy(m.centre, shape->origin, sizeof m.centre);
    for (int c = 0; c < 3; ++c) m.moment[c] = 0.4 * m.volume * r * r;
    return m;
}

static solid_moments of_ring(const brc_shape *shape)
{
    const double a = shape->radius, b = shape->radius2;
    solid_moments m = {.volume = 2 * M_PI * M_PI * a * b * b};
    memcpy(m.centre, shape->origin, sizeof m.centre);
    set_moments(shape, m.volume * (a * a + 0.75 * b * b), m.volume * (0.5 * a * a + 0.625 * b * b), &m);
    return m;
}

static brc_status moments_of(brc_simulation *s, const brc_striker *striker, solid_moments *out)
{
    switch (striker->shape.kind) {
    case BRC_SHAPE_BOX: *out = of_box(&striker->shape); return BRC_OK;
    case BRC_SHAPE_CYLINDER:
    case BRC_SHAPE_CONE: *out = of_frustum(&striker->shape); return BRC_OK;
    case BRC_SHAPE_SPHERE: *out = of_ball(&striker->shape); return BRC_OK;
    case BRC_SHAPE_TORUS: *out = of_ring(&striker->shape); return BRC_OK;
    case BRC_SHAPE_HALF_SPACE:
    case BRC_SHAPE_MESH:
    case BRC_SHAPE_PARTS: break;
    }
    return BRC_FAIL(s->context, BRC_BAD_INPUT, "striker '%s': meshes and shapes of parts are not in this version; use a box, a sphere, a cylinder, a cone or a torus",
                    striker->name);
}

/* The striker's pose: about the shape's origin, then moved. */
static void put_in_place(const brc_striker *striker, const solid_moments *m, double centre[3], double inertia[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    double turn[3][3];
    brc_pose_matrix(striker->rotation, turn);
    for (int i = 0; i < 3; ++i) {
        centre[i] = striker->shape.origin[i] + striker->translation[i];
        for (int j = 0; j < 3; ++j) centre[i] += turn[i][j] * (m->centre[j] - striker->shape.origin[j]);
    }
    for (int c = 0; c < 6; ++c) {
        inertia[c] = 0;
        for (int k = 0; k < 3; ++k) inertia[c] += turn[row[c]][k] * m->moment[k] * turn[column[c]][k];
    }
}

brc_status brc_striker_body_make(brc_simulation *s, int32_t i, brc_striker_body *out)
{
    const brc_striker *striker = s->scene->strikers + i;
    solid_moments m = {0};
    double inertia[6];
    *out = (brc_striker_body){0};
    if (striker->is_plane) {
        memcpy(out->centre, striker->point, sizeof out->centre);
        return BRC_OK;
    }
    BRC_TRY(moments_of(s, striker, &m));
    put_in_place(striker, &m, out->centre, inertia);
    out->volume = m.volume;
    if (striker->motion != BRC_STRIKER_FREE) return BRC_OK;
    out->mass = striker->mass > 0 ? striker->mass : m.volume * s->elastic[striker->material].density;
    if (!(out->mass > 0) || !isfinite(out->mass))
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "striker '%s': is free and has no mass: its volume is %.6g m^3 and the density of material '%s' %.6g kg/m^3; give it a mass",
                        striker->name, m.volume, s->scene->materials[striker->material].name, s->elastic[striker->material].density);
    for (int c = 0; c < 6; ++c) out->inertia[c] = inertia[c] * (out->mass / m.volume);
    return BRC_OK;
}
