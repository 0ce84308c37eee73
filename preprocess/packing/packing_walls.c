/* Walls of any solid as planes through the feet of the spheres near them. Asking the solid is dear (a mesh searches a
 * tree), so a sphere asks only when it can touch, and again when it has moved by a fiftieth of its radius: the depth is
 * then off by at most 2e-4 R / (2 x radius of curvature / R), and not at all at walls that are planes. */
#include "packing_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

/* Way after which a curved wall is asked again, and how far beyond the sphere it is looked for meanwhile [of the
 * radius]. */
#define ASK_AGAIN 0.02
#define LOOK_BEYOND 0.05

enum { MOST_FEET = 24 };

/* Planes through the feet of x nearer than `reach`, the nearest ones if there are too many. Returns false outside the
 * solid: the planes stay. */
static bool ask(const brc_solid *solid, const double *x, double reach, brc_pack_wall *wall)
{
    brc_foot feet[MOST_FEET];
    int32_t n = brc_solid_feet(solid, x, reach, feet, MOST_FEET);
    memcpy(wall->asked, x, sizeof wall->asked);
    if (n == 0 && !brc_solid_inside(solid, x, 0.0)) return false;
    if (n > MOST_FEET) n = MOST_FEET;
    wall->n_planes = 0;
    wall->flat = true;
    for (int32_t k = 0; k < n; ++k) {
        int32_t nearest = k;
        for (int32_t other = k + 1; other < n; ++other)
            if (feet[other].depth < feet[nearest].depth) nearest = other;
        const brc_foot foot = feet[nearest];
        feet[nearest] = feet[k];
        feet[k] = foot;
        wall->flat &= foot.plane;
        if (wall->n_planes == BRC_PACK_PLANES) continue;
        double *const plane = wall->plane[wall->n_planes++];
        memcpy(plane, foot.normal, 3 * sizeof *plane);
        plane[3] = foot.depth + foot.normal[0] * x[0] + foot.normal[1] * x[1] + foot.normal[2] * x[2];
    }
    return true;
}

/* How deep sphere i lies inside, at least; a centre outside goes back. Returns whether it may touch a wall before the
 * next list. */
static bool comes_near(brc_pack *pack, int64_t i)
{
    double *const x = pack->sphere[i];
    const double *const old = pack->listed[i];
    const double reach = x[3] + 0.5 * pack->skin;
    const double way =
        sqrt((x[0] - old[0]) * (x[0] - old[0]) + (x[1] - old[1]) * (x[1] - old[1]) + (x[2] - old[2]) * (x[2] - old[2]));
    const double bound = pack->depth_bound[i] - 1.0001 * way; /* the bound is kept in single precision */
    if (bound > reach) {
        pack->depth_bound[i] = (float)(0.999999 * bound);
        return false;
    }
    double depth = brc_solid_depth(pack->solid, x);
    if (!(depth > 0.0)) {
        memcpy(x, old, sizeof pack->listed[i]);
        memset(pack->velocity[i], 0, sizeof pack->velocity[i]);
        depth = brc_solid_depth(pack->solid, x);
    }
    pack->depth_bound[i] = (float)(0.999999 * depth);
    return depth <= reach;
}

brc_status brc_pack_list_walls(brc_pack *pack)
{
#pragma omp parallel for schedule(dynamic, 256) num_threads(pack->n_threads)
    for (int64_t i = 0; i < pack->n; ++i)
        pack->wall_row[i] = comes_near(pack, i) ? 0 : -1;
    pack->n_walls = 0;
    for (int64_t i = 0; i < pack->n; ++i)
        if (pack->wall_row[i] == 0) pack->wall_row[i] = (int32_t)pack->n_walls++;
    if (pack->n_walls > pack->wall_capacity) {
        brc_memory_free(pack->wall);
        pack->wall = NULL;
        pack->wall_capacity = 0;
        const int64_t capacity = pack->n_walls + pack->n_walls / 16;
        BRC_TRY(BRC_ALLOCATE(pack->context, &pack->wall, capacity, "walls of the packing"));
        pack->wall_capacity = capacity;
    }
    for (int64_t i = 0; i < pack->n; ++i)
        if (pack->wall_row[i] >= 0) pack->wall[pack->wall_row[i]].sphere = (int32_t)i;
#pragma omp parallel for schedule(dynamic, 64) num_threads(pack->n_threads)
    for (int64_t w = 0; w < pack->n_walls; ++w) {
        brc_pack_wall *const wall = pack->wall + w;
        const double *const x = pack->sphere[wall->sphere];
        wall->n_planes = 0;
        ask(pack->solid, x, x[3] + 0.5 * pack->skin, wall);
    }
    return BRC_OK;
}

void brc_pack_add_walls(brc_pack *pack, int64_t i, double force[3], brc_pack_sums *sums)
{
    if (pack->wall_row[i] < 0) return;
    brc_pack_wall *const wall = pack->wall + pack->wall_row[i];
    const double *const x = pack->sphere[i], *const asked = wall->asked;
    if (!wall->flat) {
        const double moved = (x[0] - asked[0]) * (x[0] - asked[0]) + (x[1] - asked[1]) * (x[1] - asked[1]) +
                             (x[2] - asked[2]) * (x[2] - asked[2]);
        if (moved > ASK_AGAIN * ASK_AGAIN * x[3] * x[3]) {
            ask(pack->solid, x, (1.0 + LOOK_BEYOND) * x[3], wall);
            wall->flat = false; /* farther walls may be curved */
        }
    }
    for (int k = 0; k < wall->n_planes; ++k) {
        const double *const plane = wall->plane[k];
        const double depth = plane[3] - plane[0] * x[0] - plane[1] * x[1] - plane[2] * x[2], overlap = x[3] - depth;
        if (overlap <= 0.0) continue;
        for (int c = 0; c < 3; ++c)
            force[c] -= 2.0 * overlap * plane[c];
        sums->energy += overlap * overlap;
        sums->wall_force += 2.0 * overlap;
        sums->wall_overlap += overlap / x[3];
        sums->wall_contacts++;
    }
}

int brc_pack_wall_contacts(const brc_pack *pack, int64_t i)
{
    if (pack->wall_row[i] < 0) return 0;
    const brc_pack_wall *const wall = pack->wall + pack->wall_row[i];
    const double *const x = pack->sphere[i];
    int n = 0;
    for (int k = 0; k < wall->n_planes; ++k) {
        const double *const plane = wall->plane[k];
        n += plane[3] - plane[0] * x[0] - plane[1] * x[1] - plane[2] * x[2] < x[3];
    }
    return n;
}
