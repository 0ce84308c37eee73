/* Means over faces are weighted with face areas, means over cells with their volumes; spheres of a wall count alike
 * where they stand for a face; those without bonds, which are held still, count nowhere. All sums run in the order of
 * the set's members, so equal states give equal bytes. */
#include "sensor_means.h"
#include "sphere_box.h"
#include <math.h>

/* Ties go to the smaller id. */
int32_t brc_sensor_nearest_element(const brc_domain *d, const double point[3])
{
    int32_t best = 0;
    double least = INFINITY;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += (d->position[3 * e + c] - point[c]) * (d->position[3 * e + c] - point[c]);
        if (square < least) {
            least = square;
            best = (int32_t)e;
        }
    }
    return best;
}

/* R of a sphere by its surface elements [m]. */
double brc_sensor_surface_radius(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set)
{
    double sum = 0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const double *x = sensors->domain->position + 3 * (int64_t)set->members[k];
        if (brc_sphere_is_bonded(sensors->domain, set->members[k]))
            sum += hypot(hypot(x[0] - sensor->point[0], x[1] - sensor->point[1]), x[2] - sensor->point[2]);
    }
    return sum / (double)brc_sphere_count_bonded(sensors->domain, set) + brc_sphere_mean_diameter(sensors->domain) / 2;
}

/* Sum over the set of a vector's radial components. */
double brc_sensor_radial_sum(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set,
                             const double *vector)
{
    double sum = 0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const int64_t e = set->members[k];
        double r[3], along = 0, square = 0;
        for (int c = 0; c < 3; ++c) {
            r[c] = sensors->domain->position[3 * e + c] - sensor->point[c];
            along += r[c] * vector[3 * e + c];
            square += r[c] * r[c];
        }
        if (square > 0) sum += along / sqrt(square);
    }
    return sum;
}

double brc_sensor_volume_mean(const brc_sensors *sensors, const double *tensor, int32_t set, int32_t component)
{
    const brc_domain *d = sensors->domain;
    const int64_t n = set >= 0 ? d->sets[set].n_members : d->n_elements;
    double sum = 0, volume = 0;
    for (int64_t k = 0; k < n; ++k) {
        const int64_t e = set >= 0 ? d->sets[set].members[k] : k;
        sum += d->volume[e] * tensor[6 * e + component];
        volume += d->volume[e];
    }
    return sum / volume;
}

/* Mean rotation about the axis through `point`: the angle that turns the reference arms r, seen along the axis, into
 * the present ones best: tan(angle) = sum S (r x u).a / sum S r.(r + u), across the axis. To first order in u this is
 * sum S (r x u).a / sum S |r|^2; of a rigid rotation it is the angle itself, however large (within +-pi). */
double brc_sensor_twist_angle(const brc_sensors *sensors, const brc_sensor *sensor, const brc_sensor_patch *p)
{
    const double *a = sensor->axis;
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double axis[3] = {a[0] / length, a[1] / length, a[2] / length};
    double turning = 0, staying = 0;
    for (int64_t k = 0; k < p->n; ++k) {
        double weight;
        const double *x = brc_sensor_patch_point(sensors->domain, p, k, &weight);
        const double *u = brc_sensor_patch_displacement(p, sensors->displacement, k);
        double r[3] = {x[0] - sensor->point[0], x[1] - sensor->point[1], x[2] - sensor->point[2]};
        const double along = r[0] * axis[0] + r[1] * axis[1] + r[2] * axis[2];
        for (int c = 0; c < 3; ++c)
            r[c] -= along * axis[c];
        turning += weight * (axis[0] * (r[1] * u[2] - r[2] * u[1]) + axis[1] * (r[2] * u[0] - r[0] * u[2]) +
                             axis[2] * (r[0] * u[1] - r[1] * u[0]));
        staying += weight * (r[0] * (r[0] + u[0]) + r[1] * (r[1] + u[1]) + r[2] * (r[2] + u[2]));
    }
    return atan2(turning, staying);
}

/* Component of the rotation vector of a unit quaternion: 2 atan2(|v|, w) v / |v|, the short way round. */
double brc_sensor_turn(const double q[4], int component)
{
    const double sign = q[0] < 0 ? -1 : 1, length = hypot(hypot(q[1], q[2]), q[3]);
    const double angle = 2 * atan2(length, sign * q[0]);
    return length > 0 ? sign * q[1 + component] * (angle / length) : 0;
}
