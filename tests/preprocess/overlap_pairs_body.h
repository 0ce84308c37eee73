/* The body of overlap_pairs_double and its like: BRC_PRECISION, BRC_LANES and OVERLAP_PAIRS, the function's name, are
 * defined. */
#include "overlap_pairs.h"

#define BRC_SLICE BRC_LANES
#define BRC_MANY_MATERIALS 0
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpsabi"
#include "../../kernels/effects/contact/convex_overlap.h"
#include <stdlib.h>
#include <time.h>

static state *converted(const double *from, int64_t n)
{
    state *to = malloc((size_t)n * sizeof *to);
    for (int64_t k = 0; to && k < n; ++k)
        to[k] = (state)from[k];
    return to;
}

static convex_pose pose_of(const overlap_pair *p, int side)
{
    const double *x = p->origin[side], *m = p->map[side];
    return (convex_pose){{(state)x[0], (state)x[1], (state)x[2]},
                         {(state)m[0], (state)m[1], (state)m[2], (state)m[3], (state)m[4], (state)m[5], (state)m[6],
                          (state)m[7], (state)m[8]}};
}

static void write_map(convex_map m, double out[9])
{
    const double row[9] = {m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz};
    for (int k = 0; k < 9; ++k)
        out[k] = row[k];
}

double OVERLAP_PAIRS(const brc_convex *convex, int64_t n, const overlap_pair *pair, int n_threads, overlap_found *out)
{
    const brc_convex *c = convex;
    state *corner = converted(c->corner, 3 * (int64_t)c->corner_start[c->n]),
          *plane = converted(c->plane, 4 * (int64_t)c->face_start[c->n]);
    state *radius = converted(c->radius, c->n);
    const clock_t start = clock();
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t k = 0; k < n; ++k) {
        const convex_shape a = convex_shape_of(corner, plane, c->loop_start, c->loop, radius, c->corner_start,
                                               c->face_start, pair[k].of[0]);
        const convex_shape b = convex_shape_of(corner, plane, c->loop_start, c->loop, radius, c->corner_start,
                                               c->face_start, pair[k].of[1]);
        const convex_overlap o = convex_overlap_of(a, pose_of(pair + k, 0), b, pose_of(pair + k, 1));
        out[k] = (overlap_found){.volume = o.volume,
                                 .area = {o.area.x, o.area.y, o.area.z},
                                 .point = {o.point.x, o.point.y, o.point.z},
                                 .failed = o.failed};
        write_map(o.moment_a, out[k].moment[0]);
        write_map(o.moment_b, out[k].moment[1]);
    }
    const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    free(corner);
    free(plane);
    free(radius);
    return seconds;
}
