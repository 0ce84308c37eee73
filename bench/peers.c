#include "peers.h"
#include "cube.h"
#include "peer_bar.h"
#include "peer_work.h"
#include "../host/base/file.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "../host/device/device.h"
#include "../host/solver/laws/beam_law.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 5,
    WARM_STEPS = 10,
    BAR_ELEMENTS = 1000,
    BAR_PERIODS = 4,
    BAR_SAMPLES = 50 /* in a period */,
    CUBE_TYPES = 256 /* of bonds, for LAMMPS */
};
/* Largest velocity at the start: strains of some 1e-5, far within what is linear [m/s]. */
static const double speed = 0.05;

/* A packing that breccia steps with model cbm, and what the peers are told of it. */
typedef struct field {
    brc_cube cube;
    brc_domain *domain;
    double *velocity;
    brc_device *device;
    brc_simulation *simulation;
    brc_peer_work work;
    char *folder;
} field;

static void free_field(field *f)
{
    brc_simulation_free(&f->simulation);
    brc_device_close(&f->device);
    brc_domain_free(&f->domain);
    brc_memory_free(f->velocity);
    brc_memory_free(f->folder);
}

/* The velocities of the bar's first longitudinal mode; in the cube waves along all axes. What no bond holds stays where
 * it is, as cbm holds it. */
static void set_velocity(const brc_domain *d, bool bar, double *velocity)
{
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = &d->position[3 * e], held = d->row_start[e + 1] > d->row_start[e] ? speed : 0;
        velocity[3 * e] = held * cos(M_PI * x[0]);
        velocity[3 * e + 1] = bar ? 0 : 0.6 * held * cos(M_PI * x[1]);
        velocity[3 * e + 2] = bar ? 0 : 0.8 * held * sin(M_PI * (x[0] + x[2]));
    }
}

/* The beams that give the material in this packing, as given numbers from here on. */
static brc_status choose_beams(brc_context *context, field *f)
{
    const brc_domain *d = f->domain;
    brc_material *m = &f->cube.material;
    brc_beam_body bonds;
    double sum = 0, least = INFINITY, most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        sum += d->radius[e];
        least = fmin(least, d->radius[e]);
        most = fmax(most, d->radius[e]);
    }
    const double mean = sum / (double)d->n_elements;
    BRC_TRY(brc_beam_body_of(context, d, -1, &bonds));
    BRC_TRY(brc_beam_law_invert(context, brc_beam_law_for(0.5 * (most - least) / mean), &bonds, m->poisson, m->young,
                                &m->beam_radius, &m->beam_young, NULL));
    const double square = m->beam_radius * mean * m->beam_radius * mean, moment = M_PI * square * square / 4;
    f->work = (brc_peer_work){.domain = d,
                              .velocity = f->velocity,
                              .density = m->density,
                              .axial = m->beam_young * M_PI * square,
                              .bend = m->beam_young * moment,
                              .twist = m->beam_young / (2 * (1 + f->cube.scene.model.beam_poisson)) * 2 * moment};
    return BRC_OK;
}

static brc_status make_field(brc_context *context, const brc_peers_request *r, bool bar, field *f)
{
    const brc_device_request open = {.selector = "cpu", .precision = BRC_DOUBLE, .n_threads = r->n_threads};
    brc_cube_make(&f->cube, brc_model_of_beams());
    f->cube.stage.n_initials = 0;
    if (bar) f->cube.body.shape.size[1] = f->cube.body.shape.size[2] = BRC_BAR_WIDTH;
    BRC_TRY(brc_file_join(context, r->folder, bar ? "bar" : "cube", &f->folder));
    BRC_TRY(brc_file_make_folder(context, f->folder));
    BRC_TRY(bar ? brc_cube_build_bar(context, BAR_ELEMENTS, &f->domain)
                : brc_cube_build(context, r->elements, true, &f->domain));
    BRC_TRY(BRC_ALLOCATE(context, &f->velocity, 3 * f->domain->n_elements, "velocities"));
    set_velocity(f->domain, bar, f->velocity);
    BRC_TRY(choose_beams(context, f));
    BRC_TRY(brc_device_open(context, &open, &f->device));
    BRC_TRY(brc_simulation_create(context, &f->cube.scene, f->domain, f->device, &f->simulation));
    BRC_TRY(brc_simulation_begin_stage(f->simulation, 0));
    f->work.time_step = brc_simulation_time_step(f->simulation).value;
    return brc_simulation_set_state(f->simulation, NULL, f->velocity);
}

/* The packing and the scripts, for each peer. n_types: of bonds in LAMMPS. */
static brc_status write_inputs(brc_context *context, const brc_peers_request *r, const field *f, int n_types,
                               const brc_peer *peers, int n)
{
    for (int k = 0; k < n; ++k)
        BRC_TRY(peers[k].kind == BRC_PEER_YADE
                    ? brc_peer_work_write_tables(context, &f->work, f->folder)
                    : brc_peer_work_write_lammps(context, &f->work, peers[k].turning, n_types, f->folder));
    for (int k = 0; n > 0 && k < r->n_scripts; ++k) {
        char *path = NULL;
        brc_status status = brc_file_join(context, f->folder, r->scripts[k].name, &path);
        if (status == BRC_OK)
            status = brc_file_write_whole(context, path, r->scripts[k].text, strlen(r->scripts[k].text));
        brc_memory_free(path);
        BRC_TRY(status);
    }
    return BRC_OK;
}

/* The first fields of a row. peer NULL: breccia with this model. */
static void begin_row(const brc_peers_request *r, const char *what, const char *quantity, const char *unit,
                      brc_model_kind model, const brc_domain *d, const brc_peer *peer, brc_rows *rows)
{
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", what);
    brc_rows_text(rows, "quantity", quantity);
    brc_rows_text(rows, "model", brc_model_name(model));
    brc_rows_text(rows, "unit", unit);
    brc_rows_number(rows, "reference", NAN);
    brc_rows_number(rows, "paper", NAN);
    brc_rows_number(rows, "ours", NAN);
    brc_rows_number(rows, "error", NAN);
    brc_rows_number(rows, "seconds", NAN);
    brc_rows_number(rows, "peer", NAN);
    brc_rows_text(rows, "program", peer ? peer->program : "breccia");
    brc_rows_text(rows, "law", peer ? peer->law : brc_model_name(model));
    brc_rows_integer(rows, "elements", d->n_elements);
    brc_rows_integer(rows, "bonds", d->n_bonds);
    brc_rows_integer(rows, "threads", r->n_threads);
    brc_rows_text(rows, "precision", brc_precision_name(BRC_DOUBLE));
}

/* The stamp, in which a peer has its own version, and the caller's look at the row. */
static brc_status end_row(const brc_peers_request *r, const brc_device *device, const brc_peer_result *theirs,
                          brc_rows *rows)
{
    brc_rows_text(rows, "device_name", brc_device_get_info(device)->name);
    brc_rows_stamp(rows);
    if (theirs) brc_rows_text(rows, "version", theirs->version);
    if (theirs && theirs->note[0]) brc_rows_text(rows, "note", theirs->note);
    BRC_TRY(rows->status);
    return r->row ? r->row(r->self, rows) : BRC_OK;
}

/* sqrt(E / density of the bulk) / (2 L): of a slender continuous bar [Hz]. */
static double slender_frequency(const field *f)
{
    double mass = 0;
    for (int64_t e = 0; e < f->domain->n_elements; ++e)
        mass += f->work.density * f->domain->volume[e];
    return 0.5 * sqrt(f->cube.material.young * BRC_BAR_WIDTH * BRC_BAR_WIDTH / mass);
}

static brc_status measure_bar(brc_context *context, const brc_peers_request *r, const brc_peer *peers, int n,
                              brc_rows *rows)
{
    field f = {0};
    brc_peer_result ours = {0}, theirs = {0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, make_field(context, r, true, &f));
    BRC_TRY_OR(cleanup, write_inputs(context, r, &f, 0, peers, n));
    const double dt = f.work.time_step, reference = slender_frequency(&f), period = 1 / (reference * dt);
    const int64_t every = (int64_t)fmax(1, floor(period / BAR_SAMPLES)),
                  steps = every * (int64_t)ceil(BAR_PERIODS * period / (double)every);
    const brc_peer_request ask = {.folder = f.folder,
                                  .steps = steps,
                                  .every = every,
                                  .time_step = dt,
                                  .longest = brc_peer_work_longest(&f.work),
                                  .n_threads = r->n_threads};
    BRC_TRY_OR(cleanup, brc_peer_bar_follow(context, f.simulation, f.work.density, steps, every, &ours));
    const double frequency = brc_peer_bar_frequency(&ours, dt);
    for (int k = -1; k < n; ++k) {
        if (k >= 0 && !peers[k].turning) continue;
        const brc_peer *peer = k < 0 ? NULL : &peers[k];
        brc_peer_result_free(&theirs);
        if (peer) BRC_TRY_OR(cleanup, brc_peer_run(context, peer, &ask, &theirs));
        begin_row(r, "peers-bar", "frequency", "Hz", brc_model_of_beams(), f.domain, peer, rows);
        brc_rows_number(rows, "reference", reference);
        brc_rows_number(rows, "ours", frequency);
        brc_rows_number(rows, "error", frequency / reference - 1);
        if (peer && !theirs.note[0]) {
            brc_rows_number(rows, "peer", brc_peer_bar_frequency(&theirs, dt));
            brc_rows_number(rows, "difference", brc_peer_bar_frequency(&theirs, dt) / frequency - 1);
            brc_rows_number(rows, "kinetic_difference", brc_peer_bar_difference(&ours, &theirs));
        }
        brc_rows_integer(rows, "steps", steps);
        brc_rows_number(rows, "time_step", dt);
        BRC_TRY_OR(cleanup, end_row(r, f.device, peer ? &theirs : NULL, rows));
    }
cleanup:
    brc_peer_result_free(&ours);
    brc_peer_result_free(&theirs);
    free_field(&f);
    return status;
}

/* One of the programs in the rounds: seconds a step of each round. */
typedef struct runner {
    const brc_peer *peer; /* NULL: breccia */
    brc_simulation *simulation;
    brc_model_kind model;
    const brc_domain *domain;
    double per_step[ROUNDS], ratio[ROUNDS]; /* [s]; over model cbm in the same round */
    brc_peer_result last;
} runner;

/* One round of one program [s] a step; a peer that failed once is left alone. */
static brc_status run_once(brc_context *context, const brc_peers_request *r, const brc_peer_request *ask, runner *one,
                           double *per_step)
{
    const bool processor = r->n_threads == 1;
    *per_step = NAN;
    if (!one->peer) {
        const double start = processor ? brc_processor_s() : brc_clock_s();
        BRC_TRY(brc_simulation_advance(one->simulation, r->steps));
        BRC_TRY(brc_simulation_wait(one->simulation));
        *per_step = ((processor ? brc_processor_s() : brc_clock_s()) - start) / (double)r->steps;
        return BRC_OK;
    }
    if (one->last.note[0]) return BRC_OK;
    BRC_TRY(brc_peer_run(context, one->peer, ask, &one->last));
    if (!one->last.note[0] && one->last.bonds >= 0 && one->last.bonds != one->domain->n_bonds)
        snprintf(one->last.note, sizeof one->last.note, "it had %lld bonds, not %lld", (long long)one->last.bonds,
                 (long long)one->domain->n_bonds);
    if (!one->last.note[0]) *per_step = (processor ? one->last.processor_s : one->last.wall_s) / (double)r->steps;
    return BRC_OK;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static brc_status add_speed(const brc_peers_request *r, const brc_device *device, const runner *cbm, const runner *one,
                            brc_rows *rows)
{
    const double bonds = (double)one->domain->n_bonds, elements = (double)one->domain->n_elements,
                 middle = one->per_step[ROUNDS / 2];
    const bool failed = one->last.note[0] != 0;
    begin_row(r, "peers", "bond_updates_per_s", "1/s", one->model, one->domain, one->peer, rows);
    brc_rows_number(rows, "ours",
                    (one->peer ? (double)cbm->domain->n_bonds : bonds) / (one->peer ? cbm : one)->per_step[ROUNDS / 2]);
    if (!failed) {
        brc_rows_number(rows, "seconds", middle);
        brc_rows_number(rows, "seconds_min", one->per_step[0]);
        brc_rows_number(rows, "seconds_max", one->per_step[ROUNDS - 1]);
        brc_rows_number(rows, "bond_updates_per_s", bonds / middle);
        brc_rows_number(rows, "element_updates_per_s", elements / middle);
    }
    if (!failed && one->peer) {
        brc_rows_number(rows, "peer", bonds / middle);
        brc_rows_number(rows, "ratio", one->ratio[ROUNDS / 2]);
        brc_rows_number(rows, "ratio_min", one->ratio[0]);
        brc_rows_number(rows, "ratio_max", one->ratio[ROUNDS - 1]);
    }
    brc_rows_integer(rows, "steps", r->steps);
    brc_rows_integer(rows, "samples", ROUNDS);
    brc_rows_text(rows, "clock", r->n_threads == 1 ? "processor" : "wall");
    return end_row(r, device, one->peer ? &one->last : NULL, rows);
}

static brc_status measure_cube(brc_context *context, const brc_peers_request *r, const brc_peer *peers, int n,
                               brc_rows *rows)
{
    field f = {0};
    brc_cube cells;
    brc_domain *domain = NULL;
    brc_simulation *simulation = NULL;
    brc_progress *progress = NULL;
    runner *runners = NULL;
    brc_status status = BRC_OK;
    brc_cube_make(&cells, brc_model_of_cells());
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &runners, n + 2, "programs of the bench"));
    BRC_TRY_OR(cleanup, make_field(context, r, false, &f));
    BRC_TRY_OR(cleanup, write_inputs(context, r, &f, CUBE_TYPES, peers, n));
    BRC_TRY_OR(cleanup, brc_cube_build(context, r->elements, false, &domain));
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &cells.scene, domain, f.device, &simulation));
    BRC_TRY_OR(cleanup, brc_simulation_begin_stage(simulation, 0));
    runners[0] = (runner){.simulation = f.simulation, .model = brc_model_of_beams(), .domain = f.domain};
    for (int k = 0; k < n; ++k)
        runners[1 + k] = (runner){.peer = &peers[k], .model = brc_model_of_beams(), .domain = f.domain};
    runners[n + 1] = (runner){.simulation = simulation, .model = brc_model_of_cells(), .domain = domain};
    const brc_peer_request ask = {.folder = f.folder,
                                  .steps = r->steps,
                                  .warm = WARM_STEPS,
                                  .time_step = f.work.time_step,
                                  .longest = brc_peer_work_longest(&f.work),
                                  .n_threads = r->n_threads};
    BRC_TRY_OR(cleanup, brc_simulation_advance(f.simulation, WARM_STEPS));
    BRC_TRY_OR(cleanup, brc_simulation_advance(simulation, WARM_STEPS));
    BRC_TRY_OR(cleanup, brc_progress_create(context, &progress, "programs in turns", (int64_t)ROUNDS * (n + 2),
                                            "samples", 0, NULL));
    for (int round = 0; round < ROUNDS; ++round)
        for (int k = 0; k < n + 2; ++k) {
            BRC_TRY_OR(cleanup, run_once(context, r, &ask, &runners[k], &runners[k].per_step[round]));
            runners[k].ratio[round] = runners[k].per_step[round] / runners[0].per_step[round];
            brc_progress_update(progress, (int64_t)round * (n + 2) + k + 1);
        }
    brc_progress_finish(&progress);
    for (int k = 0; k < n + 2; ++k) {
        qsort(runners[k].per_step, ROUNDS, sizeof runners[k].per_step[0], ascending);
        qsort(runners[k].ratio, ROUNDS, sizeof runners[k].ratio[0], ascending);
    }
    for (int k = 0; k < n + 2; ++k)
        BRC_TRY_OR(cleanup, add_speed(r, f.device, &runners[0], &runners[k], rows));
cleanup:
    brc_progress_finish(&progress);
    for (int k = 0; runners && k < n + 2; ++k)
        brc_peer_result_free(&runners[k].last);
    brc_simulation_free(&simulation);
    brc_memory_free(runners);
    brc_domain_free(&domain);
    free_field(&f);
    return status;
}

brc_status brc_peers_measure(brc_context *context, const brc_peers_request *request, brc_rows *rows)
{
    brc_peer peers[BRC_PEERS_MOST];
    int n;
    BRC_TRY(brc_file_make_folder(context, request->folder));
    BRC_TRY(brc_peer_find(context, request->n_threads, request->folder, peers, &n));
    BRC_TRY(measure_bar(context, request, peers, n, rows));
    return measure_cube(context, request, peers, n, rows);
}
