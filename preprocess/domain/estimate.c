/* Faces and corners per element as fitted to built domains (docs/reference/domain.md), times the sizes of domain.h. */
#include "estimate.h"

#include "../../host/base/spill.h"
#include "../cells/seeds.h"

#include <math.h>
#include <unistd.h>

/* While building, cells and half-edges are held at once, and the search of Voro++. */
#define BUILD_OVER_DOMAIN 2.2

/* Bonds' ends and free faces per element. w: cells at a wall, per element. A cell of random seeds has 15.6 neighbours
 * inside, fewer after relaxation, and loses four at a wall. A flat wall gives it one free face; laying p planes a cell
 * over a curved one gives 1 + p (cylinder, cone) or (1 + sqrt p)^2 (sphere); mirror images at curved walls give it one
 * of its own and slivers of its neighbours': five where all is curved, somewhere between for most shapes. Without noise
 * cells are cubes, until relaxation carries the disorder of a curved wall one layer a sweep inward. */
static void estimate_faces(const brc_solid *solid, const brc_fill *fill, double h, double w, double *half_edges,
                           double *free_faces)
{
    const brc_shape *shape = brc_solid_shape(solid);
    const double sweeps = fill->lloyd_sweeps,
                 r = fmax(shape->radius, shape->kind == BRC_SHAPE_CONE ? shape->radius2 : 0.0);
    const bool box = shape->kind == BRC_SHAPE_BOX, sphere = shape->kind == BRC_SHAPE_SPHERE;
    const bool round = shape->kind == BRC_SHAPE_CYLINDER || shape->kind == BRC_SHAPE_CONE;
    const double planes = brc_walls_n_planes(shape, h);
    *free_faces = w;
    if (round && planes > 0.0)
        *free_faces = w * (r + (1.0 + planes * h / (6.283185307 * r)) * shape->length) / (r + shape->length);
    if (sphere) *free_faces = w * pow(1.0 + sqrt(planes * h * h / 12.566370614) / r, 2.0);
    if (planes == 0.0 && !box)
        *free_faces = (shape->kind == BRC_SHAPE_TORUS ? 4.6 : shape->kind == BRC_SHAPE_CONE ? 6.0 : 1.6) * w;
    if (fill->kind != BRC_FILL_NOISY_GRID || fill->spread > 0.0) {
        *half_edges = (fill->kind == BRC_FILL_NOISY_GRID ? 14.9 + 0.7 * exp(-sweeps / 3.0) : 14.4) - 4.1 * w;
    } else {
        const double disorder = 1.0 - pow(fmax(0.0, 1.0 - w), sweeps);
        *half_edges = 6.0 - (sphere ? 0.0 : round ? 0.7 : 1.0) * w + (sphere ? 8.5 : round ? 2.0 : 0.0) * disorder;
    }
}

double brc_estimate_bytes(const brc_solid *solid, const brc_build_request *request, double n)
{
    double half_edges, free_faces;
    const double element = 3 * 8 + 8 + 3 * 8 + 6 * 8 + 4 + 4 + 3 * 8, half_edge = 3 * 4 + 6 * 8 + 2;
    if (request->beams > 0.0) return n * (element + 8 + request->beams * (3 * 4 + 2));
    const double h = cbrt(brc_solid_volume(solid, NULL) / n);
    estimate_faces(solid, &request->fill, h, brc_solid_surface(solid) / (h * h * n), &half_edges, &free_faces);
    const double corners = 2.0 * (half_edges + free_faces) - 4.0; /* three faces meet in a corner */
    const double free_face = 2 * 4 + 6 * 8 + 8 + 5.2 * 4 + 4;
    return n * (element + half_edges * half_edge + free_faces * free_face + corners * 3 * 8);
}

double brc_estimate_elements(const brc_solid *solid, const brc_fill *fill)
{
    if (fill->n_elements > 0 || fill->kind == BRC_FILL_POINTS) return (double)fill->n_elements;
    const double spacing = brc_fill_spacing(solid, fill);
    return brc_solid_volume(solid, NULL) / (spacing * spacing * spacing);
}

brc_status brc_estimate_check_memory(brc_context *context, double n, double bytes)
{
    const double physical = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) + brc_spill_room();
    const double needed = BUILD_OVER_DOMAIN * bytes;
    if (physical <= 0.0 || needed <= physical) return BRC_OK;
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "fill: building %.3g elements needs about %.3g GB, this machine has %.3g GB%s; ask for at most %.2g "
        "elements",
        n, needed * 1e-9, physical * 1e-9, brc_spill_folder() ? " with the folder of BRECCIA_SPILL" : "",
        n * physical / needed);
}
