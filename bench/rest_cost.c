/* What is gained where elements at rest are left out. */
#include "rest_cost.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/scene/scene_reader.h"
#include "../host/solver/effects/rest.h"
#include "../host/solver/simulation.h"
#include "../preprocess/domain/build.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5 };
static const double bound = 1.5;

static const char text[] =
    "version: 1\ntitle: a bar struck at one end\nmaterials:\n  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}\n"
    "model: %s\n"
    "bodies:\n  - {name: bar, shape: {box: {size: [200 mm, 10 mm, 10 mm]}}, fill: {%s}%s, material: glass}\n"
    "sets: {end: {elements: {wall: x-}}}\n"
    "stages:\n  - name: run\n    solver: {dynamic: {duration: 1 s}}\n"
    "    loads: [element_velocity: {set: end, x: 1 m/s}]\n"
    "output: {frames: none, picture: false}\n";
static const double length = 0.2; /* [m] as above */

/* A run of one round. */
typedef struct crossing {
    double seconds, left_out;
    int64_t n_steps, n_elements;
    double *displacement; /* [n_elements][3]; owned */
} crossing;

static brc_status build(brc_context *context, const brc_rest_cost_request *r, const brc_scene *scene, brc_domain **out)
{
    const brc_set_request end = {.name = "end", .kind = BRC_SET_ELEMENTS, .where = {.has_wall = true, .wall = "x-"}};
    const brc_build_request request = {.shape = scene->bodies[0].shape,
                                       .fill = scene->bodies[0].fill,
                                       .beams = brc_model_traits_of(r->model)->spheres ? 10 : 0,
                                       .n_sets = 1,
                                       .sets = &end};
    return brc_domain_build(context, &request, out);
}

static brc_status cross(brc_context *context, const brc_rest_cost_request *r, const brc_scene *scene,
                        const brc_domain *domain, bool whole, crossing *out)
{
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    const brc_material *m = scene->materials;
    const double speed = sqrt(m->young * (1 - m->poisson) / ((1 + m->poisson) * (1 - 2 * m->poisson) * m->density));
    brc_device *device = NULL;
    brc_simulation *simulation = NULL;
    brc_status status = BRC_OK;
    out->n_elements = domain->n_elements;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->displacement, 3 * domain->n_elements, "displacements"));
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &device));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, scene, domain, device, &simulation));
    if (whole) brc_rest_compute_all(simulation);
    BRC_TRY_OR(cleanup, brc_simulation_begin_stage(simulation, 0));
    out->n_steps = (int64_t)ceil(length / speed / brc_simulation_time_step(simulation).value);
    BRC_TRY_OR(cleanup, brc_simulation_wait(simulation));
    const double start = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_simulation_advance(simulation, out->n_steps));
    BRC_TRY_OR(cleanup, brc_simulation_wait(simulation));
    out->seconds = brc_clock_s() - start;
    const brc_rest_account account = brc_simulation_at_rest(simulation);
    out->left_out = account.all > 0 ? account.left_out / account.all : 0;
    status = brc_simulation_displacement(simulation, out->displacement);
cleanup:
    brc_simulation_free(&simulation);
    brc_device_close(&device);
    return status;
}

static brc_status compare(brc_context *context, const crossing *whole, const crossing *part)
{
    for (int64_t k = 0; k < 3 * whole->n_elements; ++k)
        if (memcmp(whole->displacement + k, part->displacement + k, sizeof(double)) != 0)
            return BRC_FAIL(context, BRC_INTERNAL,
                            "bench rest: element %lld has moved by %.17g m where all are gone over, by %.17g m where "
                            "those at rest are left out",
                            (long long)(k / 3), whole->displacement[k], part->displacement[k]);
    return BRC_OK;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static brc_status add_row(const brc_rest_cost_request *r, const crossing *part, double seconds[2][ROUNDS],
                          brc_rows *rows)
{
    double ratio[ROUNDS];
    for (int k = 0; k < ROUNDS; ++k)
        ratio[k] = seconds[0][k] / seconds[1][k];
    qsort(ratio, ROUNDS, sizeof *ratio, ascending);
    for (int side = 0; side < 2; ++side)
        qsort(seconds[side], ROUNDS, sizeof *seconds[side], ascending);
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "rest");
    brc_rows_text(rows, "quantity", "first-crossing");
    brc_rows_text(rows, "model", brc_model_name(r->model));
    brc_rows_text(rows, "unit", "-");
    brc_rows_number(rows, "bound", bound);
    brc_rows_number(rows, "ours", ratio[ROUNDS / 2]);
    brc_rows_text(rows, "verdict", ratio[ROUNDS / 2] >= bound ? "met" : "missed");
    brc_rows_integer(rows, "elements", part->n_elements);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_text(rows, "device", r->device);
    brc_rows_integer(rows, "threads", r->n_threads);
    brc_rows_number(rows, "least", ratio[0]);
    brc_rows_number(rows, "most", ratio[ROUNDS - 1]);
    brc_rows_number(rows, "seconds_without", seconds[0][ROUNDS / 2]);
    brc_rows_number(rows, "seconds", seconds[1][ROUNDS / 2]);
    brc_rows_integer(rows, "steps", part->n_steps);
    brc_rows_number(rows, "left_out", part->left_out);
    brc_rows_stamp(rows);
    BRC_TRY(rows->status);
    return r->row ? r->row(r->self, rows) : BRC_OK;
}

brc_status brc_rest_cost_measure(brc_context *context, const brc_rest_cost_request *r, brc_rows *rows)
{
    char fill[96], scene_text[sizeof text + 160];
    brc_scene *scene = NULL;
    brc_domain *domain = NULL;
    crossing side[2] = {0};
    double seconds[2][ROUNDS];
    brc_status status = BRC_OK;
    const bool spheres = brc_model_traits_of(r->model)->spheres;
    snprintf(fill, sizeof fill,
             spheres ? "packing: {elements: %lld, seed: 1}" : "noisy_grid: {elements: %lld, spread: 50 %%, seed: 1}",
             (long long)r->elements);
    snprintf(scene_text, sizeof scene_text, text, brc_model_name(r->model), fill, spheres ? ", beams: 10" : "");
    BRC_TRY_OR(cleanup, brc_scene_read_text(context, "bench rest", scene_text, strlen(scene_text), 0, NULL, &scene));
    BRC_TRY_OR(cleanup, build(context, r, scene, &domain));
    for (int round = -1; round < ROUNDS; ++round) /* one to warm up */
        for (int k = 0; k < 2; ++k) {
            brc_memory_free(side[k].displacement);
            side[k] = (crossing){0};
            BRC_TRY_OR(cleanup, cross(context, r, scene, domain, k == 0, &side[k]));
            if (round >= 0) seconds[k][round] = side[k].seconds;
            if (k == 1) BRC_TRY_OR(cleanup, compare(context, &side[0], &side[1]));
        }
    status = add_row(r, &side[1], seconds, rows);
cleanup:
    brc_memory_free(side[0].displacement);
    brc_memory_free(side[1].displacement);
    brc_domain_free(&domain);
    brc_scene_free(&scene);
    return status;
}
