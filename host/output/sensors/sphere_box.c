#include "sphere_box.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

bool brc_sphere_is_bonded(const brc_domain *d, int64_t element)
{
    return d->row_start[element + 1] > d->row_start[element];
}

int64_t brc_sphere_count_bonded(const brc_domain *d, const brc_set *set)
{
    int64_t n = 0;
    for (int64_t k = 0; k < set->n_members; ++k)
        n += brc_sphere_is_bonded(d, set->members[k]);
    return n;
}

double brc_sphere_mean_diameter(const brc_domain *d)
{
    double sum = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        sum += 2 * d->radius[e];
    return sum / (double)d->n_elements;
}

static double mean_position(const brc_domain *d, int32_t set, int axis)
{
    const brc_set *s = &d->sets[set];
    double sum = 0;
    for (int64_t k = 0; k < s->n_members; ++k)
        if (brc_sphere_is_bonded(d, s->members[k])) sum += d->position[3 * (int64_t)s->members[k] + axis];
    return sum / (double)brc_sphere_count_bonded(d, s);
}

double brc_sphere_box_length(const brc_domain *d, int32_t set, int32_t against, int axis)
{
    const double distance = mean_position(d, set, axis) - mean_position(d, against, axis);
    return distance + copysign(brc_sphere_mean_diameter(d), distance);
}

/* The set of another wall of the same part: prefix, wall, suffix. */
static int32_t other_wall(const brc_domain *d, const char *prefix, int n_prefix, const char *wall, const char *suffix)
{
    char name[128];
    snprintf(name, sizeof name, "%.*s%s%s", n_prefix, prefix, wall, suffix);
    const int32_t set = brc_domain_find_set(d, name);
    return set >= 0 && d->sets[set].kind == BRC_SET_ELEMENTS && d->sets[set].n_members > 0 ? set : -1;
}

static double round_section(const brc_domain *d, int32_t end, int32_t side, int axis)
{
    const brc_set *s = &d->sets[side];
    double sum = 0;
    for (int64_t k = 0; k < s->n_members; ++k) {
        double square = 0;
        if (!brc_sphere_is_bonded(d, s->members[k])) continue;
        for (int c = 1; c < 3; ++c) {
            const int across = (axis + c) % 3;
            const double r = d->position[3 * (int64_t)s->members[k] + across] - mean_position(d, end, across);
            square += r * r;
        }
        sum += sqrt(square);
    }
    const double radius = sum / (double)brc_sphere_count_bonded(d, s) + brc_sphere_mean_diameter(d) / 2;
    return M_PI * radius * radius;
}

double brc_sphere_box_section(const brc_domain *d, int32_t set)
{
    if (set < 0 || !d->radius || d->sets[set].kind != BRC_SET_ELEMENTS || d->sets[set].n_members == 0) return NAN;
    const char *name = d->sets[set].name;
    const size_t length = strlen(name), layer = strlen("_layer");
    const char *suffix =
        length > layer && strcmp(name + length - layer, "_layer") == 0 ? name + length - layer : name + length;
    if (suffix - name < 2) return NAN;
    const char *wall = suffix - 2;
    const int axis = wall[0] - 'x', n_prefix = (int)(wall - name);
    if (axis < 0 || axis > 2 || (wall[1] != '-' && wall[1] != '+') || (n_prefix > 0 && wall[-1] != '_')) return NAN;
    const int32_t side = other_wall(d, name, n_prefix, "side", suffix);
    if (side >= 0) return round_section(d, set, side, axis);
    double area = 1;
    for (int c = 1; c < 3; ++c) {
        const int across = (axis + c) % 3;
        const char low[3] = {(char)('x' + across), '-', 0}, high[3] = {(char)('x' + across), '+', 0};
        const int32_t from = other_wall(d, name, n_prefix, low, suffix),
                      to = other_wall(d, name, n_prefix, high, suffix);
        area *= from >= 0 && to >= 0 ? brc_sphere_box_length(d, to, from, across) : NAN;
    }
    return area;
}
