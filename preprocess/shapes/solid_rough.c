/* Walls of a rough mesh near a point: where so many patches are near that each means nothing, a wall is a direction in
 * which the surface is near. */
#include "solid_internal.h"

#include <math.h>
#include <string.h>

/* Directions nearer to each other than this (cosine) are one wall. */
#define SAME_WALL 0.7
/* A place not nearer than this share of a wall's depth, measured along its normal, lies on that wall. */
#define ON_NEAREST 0.8
#define ON_MEAN 0.9
/* Mean planes are taken over this radius [of the reach]: half a cell where the reach is two. A third lets bumps pass
 * for walls of their own: volumes of rough balls were smaller by 0.3 % then. */
#define MEAN_RADIUS 0.25
/* Bumps of a wall stand off its mean plane by so many times what they do around the foot. */
#define OTHER_BUMPS 2.5

static bool on_wall(const brc_rough_wall *wall, const double direction[3], double distance, bool mean)
{
    const double along = distance * brc_dot3(direction, wall->normal);
    if (mean) return along >= ON_MEAN * wall->depth - OTHER_BUMPS * wall->rough;
    return along >= ON_NEAREST * wall->depth;
}

/* The wall seen at a view, as a plane: through the nearest point, or the mean one around it. sign: 1 where x is inside
 * the mesh, else -1. */
static bool make_wall(const brc_mesh *mesh, const double x[3], const brc_mesh_foot *view, double sign, double reach,
                      bool mean, double least, brc_rough_wall *wall)
{
    double height;
    *wall = (brc_rough_wall){.foot = *view, .depth = view->distance};
    for (int d = 0; d < 3; ++d)
        wall->normal[d] = (view->point[d] - x[d]) / view->distance;
    if (!mean) return true;
    double normal[3] = {sign * wall->normal[0], sign * wall->normal[1], sign * wall->normal[2]};
    if (!brc_mesh_mean_plane(mesh, view->point, MEAN_RADIUS * reach, normal, &height, &wall->rough)) return true;
    /* nothing is nearer than `least`, so the plane need not be either */
    wall->depth = fmax(least, sign * (height - brc_dot3(normal, x)));
    for (int d = 0; d < 3; ++d)
        wall->normal[d] = sign * normal[d];
    return wall->depth < reach;
}

int32_t brc_rough_walls(const brc_mesh *mesh, const double x[3], double reach, bool mean, brc_rough_wall *walls,
                        int32_t most)
{
    brc_mesh_foot view[BRC_MESH_VIEWS];
    const int32_t n_views = brc_mesh_views(mesh, x, reach, view);
    const double sign = brc_mesh_inside(mesh, x) ? 1.0 : -1.0;
    int32_t n = 0;
    for (int32_t v = 0; v < n_views && n < most; ++v) {
        double direction[3];
        bool known = false;
        for (int d = 0; d < 3; ++d)
            direction[d] = (view[v].point[d] - x[d]) / view[v].distance;
        for (int32_t k = 0; k < n && !known; ++k)
            known = on_wall(&walls[k], direction, view[v].distance, mean);
        if (known || !make_wall(mesh, x, &view[v], sign, reach, mean, view[0].distance, &walls[n])) continue;
        for (int32_t k = 0; k < n && !known; ++k)
            known = brc_dot3(walls[k].normal, walls[n].normal) > SAME_WALL;
        n += !known;
    }
    return n;
}
