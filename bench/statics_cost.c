/* What an elastic equilibrium takes. */
#include "statics_cost.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/scene/scene_reader.h"
#include "../host/solver/simulation.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const char head[] =
    "version: 1\ntitle: cost of equilibrium\nmaterials:\n  stone: {E: 20 GPa, nu: 0.3, density: 1000 kg/m^3}\nbodies:\n"
    "  - {name: body, shape: {box: {size: %s}}, fill: {noisy_grid: {cells: %s, spread: 90 %%, lloyd: 5, seed: 1}}, "
    "material: stone}\n"
    "stages:\n  - name: solve\n    solver: static\n    loads:\n%soutput: {frames: none, picture: false}\n";
static const char bending[] =
    "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n      - traction: {set: x+, z: 1 kPa}\n";
static const char pulling[] = "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: "
                              "0}\n      - face_displacement: {set: z-, z: 0}\n"
                              "      - face_displacement: {set: x+, x: 1 um}\n";

/* Of one body: nearest to the wanted number of elements. */
static brc_status make(brc_context *context, const brc_statics_cost_request *r, bool cantilever, brc_scene **scene,
                       brc_domain **domain)
{
    char text[2048], cells[64];
    const int across = (int)lround(cbrt((double)r->elements / (cantilever ? 10 : 1)));
    snprintf(cells, sizeof cells, "[%d, %d, %d]", cantilever ? 10 * across : across, across, across);
    const int length = snprintf(text, sizeof text, head, cantilever ? "[1 m, 10 cm, 10 cm]" : "[1 m, 1 m, 1 m]", cells,
                                cantilever ? bending : pulling);
    BRC_TRY(brc_scene_read_text(context, "bench statics", text, (size_t)length, 0, NULL, scene));
    (*scene)->materials[0].poisson = r->poisson;
    const brc_build_request build = {.shape = (*scene)->bodies[0].shape,
                                     .fill = (*scene)->bodies[0].fill,
                                     .tiny_face_threshold = (*scene)->bodies[0].tiny_face_threshold};
    return brc_domain_build(context, &build, domain);
}

static double seconds_now(const brc_statics_cost_request *r, const brc_device *device)
{
    struct timespec t;
    const bool alone = brc_device_get_info(device)->kind == BRC_DEVICE_CPU && r->n_threads == 1;
    clock_gettime(alone ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* One row; *seconds of its solve. before: of diagonal blocks, NAN: unknown. */
static brc_status solve(brc_context *context, const brc_statics_cost_request *r, brc_scene *scene,
                        const brc_domain *domain, const char *body, brc_preconditioner_kind preconditioner,
                        double before, double *seconds, brc_rows *rows)
{
    const brc_device_request open = {.selector = r->device, .precision = r->precision, .n_threads = r->n_threads};
    const double n = (double)domain->n_elements;
    brc_device *device = NULL;
    brc_simulation *simulation = NULL;
    brc_status status = BRC_OK;
    scene->stages[0].preconditioner = preconditioner;
    BRC_TRY_OR(cleanup, brc_device_open(context, &open, &device));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, scene, domain, device, &simulation));
    const int64_t bytes = brc_device_bytes(device);
    const double start = seconds_now(r, device);
    BRC_TRY_OR(cleanup, brc_simulation_run(simulation));
    *seconds = seconds_now(r, device) - start;
    const brc_static_report report = brc_simulation_static_report(simulation);
    brc_rows_begin(rows);
    brc_rows_text(rows, "bench", "statics");
    brc_rows_text(rows, "body", body);
    brc_rows_text(rows, "preconditioner", preconditioner == BRC_PRECONDITIONER_BLOCKS ? "blocks" : "multigrid");
    brc_rows_number(rows, "poisson", r->poisson);
    brc_rows_integer(rows, "elements", domain->n_elements);
    brc_rows_integer(rows, "bonds", domain->n_bonds);
    brc_rows_integer(rows, "iterations", report.iterations);
    brc_rows_integer(rows, "corrections", report.corrections);
    brc_rows_number(rows, "residual", report.residual);
    brc_rows_number(rows, "seconds", *seconds);
    brc_rows_number(rows, "setup_s", report.multigrid_seconds);
    brc_rows_number(rows, "blocks_over_this", before / *seconds);
    brc_rows_number(rows, "device_bytes_per_element", (double)bytes / n);
    brc_rows_number(rows, "multigrid_bytes_per_element", (double)report.multigrid_bytes / n);
    brc_rows_number(rows, "most_resident_bytes", (double)brc_memory_resident());
    brc_rows_text(rows, "device", brc_device_get_info(device)->selector);
    brc_rows_text(rows, "device_name", brc_device_get_info(device)->name);
    brc_rows_text(rows, "precision", brc_precision_name(r->precision));
    brc_rows_integer(rows, "threads", r->n_threads);
    brc_rows_stamp(rows);
    status = rows->status == BRC_OK ? r->row(r->self, rows) : rows->status;
cleanup:
    brc_simulation_free(&simulation);
    brc_device_close(&device);
    return status;
}

brc_status brc_statics_cost_measure(brc_context *context, const brc_statics_cost_request *r, brc_rows *rows)
{
    for (int k = 0; k < 2; ++k) {
        const char *body = k == 0 ? "cantilever" : "cube";
        brc_scene *scene = NULL;
        brc_domain *domain = NULL;
        brc_status status = BRC_OK;
        double before = NAN, seconds;
        if (!(k == 0 ? r->cantilever : r->cube)) continue;
        status = make(context, r, k == 0, &scene, &domain);
        if (status == BRC_OK && domain->n_elements <= r->most_of_blocks)
            status = solve(context, r, scene, domain, body, BRC_PRECONDITIONER_BLOCKS, NAN, &before, rows);
        if (status == BRC_OK)
            status = solve(context, r, scene, domain, body, BRC_PRECONDITIONER_MULTIGRID, before, &seconds, rows);
        if (status == BRC_OK && r->peer) {
            const brc_statics_peer_body whole = {body, domain->n_elements, r->poisson, seconds};
            status = brc_statics_peer_row(context, r->peer, &whole, rows);
            if (status == BRC_OK) status = r->row(r->self, rows);
        }
        brc_domain_free(&domain);
        brc_scene_free(&scene);
        BRC_TRY(status);
    }
    return BRC_OK;
}
