/* Counting bonds inside and at the walls, and measuring from wall to wall. */
#include "beam_body.h"
#include "../../../preprocess/domain/sets.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

/* Fewer inner elements than this say too little: the mean of so many scatters by half a percent. */
enum { FEWEST = 200 };

/* Mark the elements of all wall layers; false: there are none. */
static bool mark_layers(const brc_domain *d, uint8_t *at_wall)
{
    bool found = false;
    for (int32_t w = 0; w < d->n_walls; ++w) {
        char layer[BRC_LAYER_NAME];
        brc_sets_layer_name(d->wall_name[w], layer);
        const int32_t s = brc_domain_find_set(d, layer);
        if (s < 0 || d->sets[s].kind != BRC_SET_ELEMENTS) continue;
        found |= d->sets[s].n_members > 0;
        for (int64_t k = 0; k < d->sets[s].n_members; ++k)
            at_wall[d->sets[s].members[k]] = 1;
    }
    return found;
}

/* Where the spheres of a wall are that have bonds, mean; false: the body has none of that name, or several. */
static bool mean_place(const brc_domain *d, int32_t body, const char *ending, double out[3])
{
    int64_t n = 0, n_walls = 0;
    memset(out, 0, 3 * sizeof *out);
    for (int32_t w = 0; w < d->n_walls; ++w) {
        const int64_t before = n;
        const size_t length = strlen(d->wall_name[w]), tail = strlen(ending);
        const int32_t s = length >= tail && strcmp(d->wall_name[w] + length - tail, ending) == 0
                              ? brc_domain_find_set(d, d->wall_name[w])
                              : -1;
        if (s < 0 || d->sets[s].kind != BRC_SET_ELEMENTS) continue;
        for (int64_t k = 0; k < d->sets[s].n_members; ++k) {
            const int64_t e = d->sets[s].members[k];
            if ((body >= 0 && d->body[e] != body) || d->row_start[e + 1] == d->row_start[e]) continue;
            for (int c = 0; c < 3; ++c)
                out[c] += d->position[3 * e + c];
            ++n;
        }
        n_walls += n > before;
    }
    for (int c = 0; c < 3; ++c)
        out[c] /= n > 0 ? (double)n : 1;
    return n_walls == 1;
}

/* Mean distance of the spheres at the wall of a cylinder from the line through two points. */
static double mean_distance(const brc_domain *d, int32_t body, const double a[3], const double b[3])
{
    double axis[3], length = 0, sum = 0;
    int64_t n = 0;
    for (int c = 0; c < 3; ++c)
        length += (b[c] - a[c]) * (b[c] - a[c]);
    length = sqrt(length);
    for (int c = 0; c < 3; ++c)
        axis[c] = (b[c] - a[c]) / length;
    for (int32_t w = 0; w < d->n_walls; ++w) {
        const size_t name = strlen(d->wall_name[w]);
        const int32_t s =
            name >= 4 && strcmp(d->wall_name[w] + name - 4, "side") == 0 ? brc_domain_find_set(d, d->wall_name[w]) : -1;
        for (int64_t k = 0; s >= 0 && k < d->sets[s].n_members; ++k) {
            const int64_t e = d->sets[s].members[k];
            double along = 0, square = 0;
            if (body >= 0 && d->body[e] != body) continue;
            for (int c = 0; c < 3; ++c) {
                const double r = d->position[3 * e + c] - a[c];
                along += r * axis[c];
                square += r * r;
            }
            sum += sqrt(fmax(square - along * along, 0));
            ++n;
        }
    }
    return n > 0 ? sum / (double)n : 0;
}

/* Edges of the bounding box in mean diameters; false: not a box or a cylinder. */
static bool measure_edges(const brc_domain *d, int32_t body, double diameter, double edges[3])
{
    static const char *const ends[3][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};
    double low[3][3], high[3][3];
    int n = 0, axis = -1;
    for (int c = 0; c < 3; ++c) {
        double square = 0;
        if (!mean_place(d, body, ends[c][0], low[c]) || !mean_place(d, body, ends[c][1], high[c])) continue;
        for (int k = 0; k < 3; ++k)
            square += (high[c][k] - low[c][k]) * (high[c][k] - low[c][k]);
        edges[n++] = sqrt(square) / diameter + 1;
        axis = c;
    }
    if (n != 1) return n == 3;
    const double radius = mean_distance(d, body, low[axis], high[axis]);
    edges[1] = edges[2] = 2 * radius / diameter + 1;
    return radius > 0;
}

double brc_beam_body_reading(const double edges[3])
{
    static const double surface = 0.2;
    const double longest = fmax(edges[0], fmax(edges[1], edges[2])), all = 1 / edges[0] + 1 / edges[1] + 1 / edges[2];
    return 1 + 1 / longest - surface * (all - 1 / longest);
}

brc_status brc_beam_body_of(brc_context *context, const brc_domain *d, int32_t body, brc_beam_body *out)
{
    int64_t n = 0, inside = 0, ends = 0, inner_ends = 0;
    double diameter = 0, edges[3];
    *out = (brc_beam_body){0};
    BRC_LOCAL(context, d->n_elements, uint8_t, at_wall, "elements at walls");
    const bool has_walls = mark_layers(d, at_wall);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (body >= 0 && d->body[e] != body) continue;
        const int64_t own = d->row_start[e + 1] - d->row_start[e];
        ++n;
        ends += own;
        diameter += 2 * d->radius[e];
        if (at_wall[e]) continue;
        ++inside;
        inner_ends += own;
    }
    if (n > 0) out->coordination = (double)ends / (double)n;
    if (n > 0 && measure_edges(d, body, diameter / (double)n, edges)) out->reading = brc_beam_body_reading(edges);
    if (has_walls && inside >= FEWEST) out->inner = (double)inner_ends / (double)inside;
    return BRC_OK;
}
