/* Everything is a sum over points: of the solid (volumes), of spheres (solid fraction) and of beams (stiffness). */
#include "skin.h"

#include "../../host/base/memory.h"
#include "../../host/base/random.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* Points along a beam, and along the edge of a cube around a sphere. Both divide a layer evenly, so that beams and
 * spheres on a lattice are counted without error. */
enum { POINTS_OF_BEAM = 8, POINTS_ACROSS_SPHERE = 8 };
enum { FEWEST_IN_CORE = 100 };
/* Where a point belongs that is outside the solid or near two walls; the core is layer BRC_SKIN_LAYERS. */
enum { CORE = BRC_SKIN_LAYERS, NOWHERE = BRC_SKIN_LAYERS + 1, PLACES = BRC_SKIN_LAYERS + 2 };
/* A point as far as this from the lower end of a layer [layers] is in it: rounding must not lift a lattice out of its
 * layer. */
#define ROUNDING 1e-9

static int place_of(const brc_solid *solid, double diameter, const double x[3], double normal[3])
{
    const double thickness = BRC_SKIN_THICKNESS * diameter;
    brc_foot feet[2];
    const int32_t n = brc_solid_feet(solid, x, BRC_SKIN_LAYERS * thickness * (1 - ROUNDING), feet, 2);
    if (n == 0) return brc_solid_inside(solid, x, 0) ? CORE : NOWHERE;
    if (n > 1) return NOWHERE;
    memcpy(normal, feet[0].normal, 3 * sizeof *normal);
    const int layer = (int)(feet[0].depth / thickness + ROUNDING);
    return layer < BRC_SKIN_LAYERS ? layer : CORE;
}

/* One random point in each cell of a grid of a layer's thickness: a count for each place. */
static void measure_volumes(const brc_solid *solid, double diameter, int n_threads, double volume[PLACES])
{
    const double edge = BRC_SKIN_THICKNESS * diameter;
    double bounds[2][3];
    int64_t dims[3], count[PLACES] = {0};
    brc_solid_bounds(solid, bounds);
    for (int c = 0; c < 3; ++c)
        dims[c] = (int64_t)ceil((bounds[1][c] - bounds[0][c]) / edge - ROUNDING);
#pragma omp parallel for schedule(dynamic, 4) num_threads(n_threads) reduction(+ : count)
    for (int64_t i = 0; i < dims[0]; ++i)
        for (int64_t j = 0; j < dims[1]; ++j)
            for (int64_t k = 0; k < dims[2]; ++k) {
                double draw[4], normal[3];
                brc_random_uniform4(0, BRC_RANDOM_SKIN, (uint64_t)i, (uint64_t)(j * dims[2] + k), draw);
                const double x[3] = {bounds[0][0] + edge * ((double)i + draw[0]),
                                     bounds[0][1] + edge * ((double)j + draw[1]),
                                     bounds[0][2] + edge * ((double)k + draw[2])};
                ++count[place_of(solid, diameter, x, normal)];
            }
    for (int p = 0; p < PLACES; ++p)
        volume[p] = (double)count[p] * edge * edge * edge;
}

/* Volume of sphere e in each place. */
static void add_sphere(const brc_solid *solid, const brc_domain *d, double diameter, int64_t e,
                       double solid_volume[PLACES])
{
    const double r = d->radius[e];
    int64_t count[PLACES] = {0}, n = 0;
    for (int i = 0; i < POINTS_ACROSS_SPHERE * POINTS_ACROSS_SPHERE * POINTS_ACROSS_SPHERE; ++i) {
        const int at[3] = {i % POINTS_ACROSS_SPHERE, i / POINTS_ACROSS_SPHERE % POINTS_ACROSS_SPHERE,
                           i / (POINTS_ACROSS_SPHERE * POINTS_ACROSS_SPHERE)};
        double x[3], normal[3], square = 0;
        for (int c = 0; c < 3; ++c) {
            const double offset = r * ((2.0 * at[c] + 1) / POINTS_ACROSS_SPHERE - 1);
            x[c] = d->position[3 * e + c] + offset;
            square += offset * offset;
        }
        if (square > r * r) continue;
        ++count[place_of(solid, diameter, x, normal)];
        ++n;
    }
    for (int p = 0; p < PLACES; ++p)
        solid_volume[p] += d->volume[e] * (double)count[p] / (double)n;
}

/* Length of the beam of half-edge h in each place, times the means of n n n n that the directions ask for. Averages
 * over the directions t in the wall: n_t^4 is 3/8 s^4, n_t^2 is s^2 / 2, where s^2 = 1 - n_n^2. */
static void add_beam(const brc_solid *solid, const brc_domain *d, double diameter, int64_t h, int64_t e,
                     double length_in[PLACES], double sum[PLACES][BRC_SKIN_DIRECTIONS])
{
    const int64_t j = d->neighbour[h];
    double branch[3], length = 0;
    for (int c = 0; c < 3; ++c) {
        branch[c] = d->position[3 * j + c] - d->position[3 * e + c];
        length += branch[c] * branch[c];
    }
    length = sqrt(length);
    for (int k = 0; k < POINTS_OF_BEAM; ++k) {
        const double part = (k + 0.5) / POINTS_OF_BEAM, share = length / POINTS_OF_BEAM;
        double x[3], normal[3] = {0}, across = 0;
        for (int c = 0; c < 3; ++c)
            x[c] = d->position[3 * e + c] + part * branch[c];
        const int p = place_of(solid, diameter, x, normal);
        for (int c = 0; c < 3; ++c)
            across += branch[c] / length * normal[c];
        const double nn = across * across, tt = 1 - nn;
        length_in[p] += share;
        sum[p][BRC_SKIN_ALONG] += share * 3 / 8 * tt * tt;
        sum[p][BRC_SKIN_SHEAR] += share / 2 * tt * nn;
        sum[p][BRC_SKIN_ACROSS] += share * nn * nn;
    }
}

/* Sums of everything, then over volumes and over the core. */
static void evaluate(const brc_solid *solid, const brc_domain *d, int n_threads, brc_skin *out)
{
    static const double even[BRC_SKIN_DIRECTIONS] = {1.0 / 5, 1.0 / 15,
                                                     1.0 / 5}; /* means of n n n n over all directions */
    double volume[PLACES], solid_volume[PLACES] = {0}, length[PLACES] = {0}, sum[PLACES][BRC_SKIN_DIRECTIONS] = {{0}};
    int64_t n[PLACES] = {0}, ends[PLACES] = {0};
    measure_volumes(solid, out->diameter, n_threads, volume);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double normal[3];
        const int p = place_of(solid, out->diameter, d->position + 3 * e, normal);
        ++n[p];
        ends[p] += d->row_start[e + 1] - d->row_start[e];
        add_sphere(solid, d, out->diameter, e, solid_volume);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            if (d->neighbour[h] > e) add_beam(solid, d, out->diameter, h, e, length, sum);
    }
    const double dense = length[CORE] / volume[CORE];
    for (int p = 0; p <= CORE; ++p) {
        brc_skin_layer *layer = p < CORE ? &out->layer[p] : &out->core;
        *layer = (brc_skin_layer){
            .volume = volume[p], .n_elements = n[p], .coordination = n[p] > 0 ? (double)ends[p] / (double)n[p] : 0};
        if (volume[p] > 0) layer->solid = solid_volume[p] / volume[p];
        for (int k = 0; k < BRC_SKIN_DIRECTIONS; ++k) {
            layer->stiffness[k] = p == CORE ? 1 : volume[p] > 0 ? sum[p][k] / (volume[p] * dense * even[k]) : 0;
            if (p < CORE) out->missing[k] += BRC_SKIN_THICKNESS * (1 - layer->stiffness[k]);
        }
    }
}

brc_status brc_skin_measure(brc_context *context, const brc_solid *solid, const brc_domain *domain, int n_threads,
                            brc_skin *out)
{
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    memset(out, 0, sizeof *out);
    if (domain->element_kind != BRC_ELEMENT_SPHERE)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "skin: the body is made of cells, which fill it up to its walls; expected spheres joined by beams");
    int64_t deep = 0;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        out->diameter += 2 * domain->radius[e] / (double)domain->n_elements;
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        double normal[3];
        deep += place_of(solid, out->diameter, domain->position + 3 * e, normal) == CORE;
    }
    if (deep < FEWEST_IN_CORE)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "skin: %lld spheres are deeper than %g diameters below the surface, at least %d are needed to "
                        "compare the skin with; use more and so smaller spheres",
                        (long long)deep, BRC_SKIN_LAYERS * BRC_SKIN_THICKNESS, FEWEST_IN_CORE);
    evaluate(solid, domain, threads, out);
    return BRC_OK;
}
