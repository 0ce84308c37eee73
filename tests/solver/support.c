#include "support.h"
#include "../../host/base/log.h"
#include "../../host/base/random.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

double random_at(uint64_t index)
{
    double draws[4];
    brc_random_uniform4(7, BRC_RANDOM_TEST, index, 0, draws);
    return 2 * draws[0] - 1;
}

void assert_done(bench_case *c, brc_status status)
{
    if (status != BRC_OK) fail_msg("status %s: %s", brc_status_text(status), brc_context_message(c->context));
}

static const char *or_else(const char *given, const char *fallback)
{
    return given ? given : fallback;
}

static brc_status build_domains(bench_case *c)
{
    const brc_body *body = c->scene->bodies;
    brc_predicate regions[8];
    for (int32_t r = 0; r < body->n_regions; ++r)
        regions[r] = body->regions[r].where;
    brc_build_request request = {.shape = body->shape,
                                 .fill = body->fill,
                                 .n_sets = c->scene->n_sets,
                                 .sets = c->scene->sets,
                                 .n_regions = body->n_regions,
                                 .regions = regions,
                                 .n_cracks = body->n_cracks,
                                 .cracks = body->cracks,
                                 .tiny_face_threshold = body->tiny_face_threshold};
    memcpy(request.translation, body->translation, sizeof request.translation);
    memcpy(request.rotation, body->rotation, sizeof request.rotation);
    return brc_domain_build(c->context, &request, &c->domain);
}

brc_status try_case(bench_case *c, case_options o)
{
    memset(c, 0, sizeof *c);
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    char text[8192];
    const int length =
        snprintf(text, sizeof text,
                 "version: 1\ntitle: test\nmaterials:\n%s\nmodel: %s\n%sbodies:\n  - name: body\n    shape: %s\n    "
                 "fill: {noisy_grid: {%s}}\n"
                 "    material: stone\n%s%sstages:\n%soutput: {frames: none, picture: false}\n",
                 or_else(o.materials, "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}"), or_else(o.model, "dlsm"),
                 or_else(o.gravity, ""), or_else(o.shape, "{box: {size: [1 m, 1 m, 1 m]}}"),
                 or_else(o.fill, "cells: [6, 6, 6], spread: 90 %, seed: 1"), or_else(o.regions, ""),
                 or_else(o.sets, ""), or_else(o.stages, "  - name: move\n    solver: {dynamic: {steps: 1}}\n"));
    BRC_TRY(brc_scene_read_text(c->context, "test.yaml", text, (size_t)length, 0, NULL, &c->scene));
    if (o.no_contact) c->scene->has_contact = false;
    BRC_TRY(build_domains(c));
    const brc_device_request request = {.selector = or_else(o.device, "cpu"),
                                        .precision = o.precision,
                                        .many_materials = brc_simulation_needs_many_materials(c->scene, c->domain),
                                        .n_threads = o.n_threads,
                                        .lanes = o.lanes,
                                        .exact = o.exact};
    BRC_TRY(brc_device_open(c->context, &request, &c->device));
    return brc_simulation_create(c->context, c->scene, c->domain, c->device, &c->simulation);
}

void open_case(bench_case *c, case_options options)
{
    assert_done(c, try_case(c, options));
}

void close_case(bench_case *c)
{
    brc_simulation_free(&c->simulation);
    brc_device_close(&c->device);
    brc_domain_free(&c->domain);
    brc_scene_free(&c->scene);
    brc_context_free(&c->context);
}

void assert_same_breaks(bench_case *a, bench_case *b, int64_t n_steps)
{
    bench_case *const both[2] = {a, b};
    const brc_break *events[2];
    int64_t n[2];
    for (int k = 0; k < 2; ++k) {
        assert_done(both[k], brc_simulation_begin_stage(both[k]->simulation, 0));
        assert_done(both[k], brc_simulation_advance(both[k]->simulation, n_steps));
        assert_done(both[k], brc_simulation_breaks(both[k]->simulation, &n[k], &events[k]));
    }
    assert_true(n[0] > 20);
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(events[0], events[1], (size_t)n[0] * sizeof *events[0]);
}

bool device_is_there(const char *selector)
{
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    bool there = false;
    assert_non_null(context);
    assert_int_equal(brc_device_list_create(context, &list), BRC_OK);
    for (int k = 0; k < list->n; ++k)
        there |= list->items[k].usable && list->items[k].has_double && strcmp(list->items[k].selector, selector) == 0;
    brc_device_list_free(&list);
    brc_context_free(&context);
    return there;
}

static FILE *listening;
static int real_stderr;

void begin_listening(void)
{
    fflush(stderr);
    listening = tmpfile();
    real_stderr = dup(2);
    dup2(fileno(listening), 2);
}

const char *heard(void)
{
    static char text[16384];
    fflush(stderr);
    dup2(real_stderr, 2);
    close(real_stderr);
    rewind(listening);
    text[fread(text, 1, sizeof text - 1, listening)] = '\0';
    fclose(listening);
    return text;
}

const char *heard_of_run(case_options options)
{
    bench_case c;
    open_case(&c, options);
    brc_log_set_level(c.context, BRC_LOG_WARNING);
    begin_listening();
    assert_done(&c, brc_simulation_run(c.simulation));
    const char *said = heard();
    close_case(&c);
    return said;
}

void begin_first(bench_case *c)
{
    assert_done(c, brc_simulation_begin_stage(c->simulation, 0));
}

void run_steps(bench_case *c, int64_t n_steps)
{
    assert_done(c, brc_simulation_advance(c->simulation, n_steps));
    assert_done(c, brc_simulation_wait(c->simulation));
}

int64_t count_broken(bench_case *c)
{
    int64_t n;
    assert_done(c, brc_simulation_broken(c->simulation, &n));
    return n;
}

brc_ledger ledger_now(bench_case *c)
{
    brc_ledger ledger;
    assert_done(c, brc_simulation_ledger(c->simulation, &ledger));
    return ledger;
}

brc_softening_report softening_now(bench_case *c)
{
    brc_softening_report report;
    assert_done(c, brc_simulation_softening(c->simulation, &report));
    return report;
}

void cell_momenta(bench_case *c, double p[6])
{
    const brc_domain *d = c->domain;
    double *u = calloc((size_t)(6 * d->n_elements), sizeof *u), *v = u + 3 * d->n_elements;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    for (int k = 0; k < 6; ++k)
        p[k] = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            const int64_t a = 3 * e + (k + 1) % 3, b = 3 * e + (k + 2) % 3;
            p[k] += d->volume[e] * v[3 * e + k];
            p[3 + k] += d->volume[e] * ((d->position[a] + u[a]) * v[b] - (d->position[b] + u[b]) * v[a]);
        }
    free(u);
}

bool is_listed(const char *const *names, const char *name)
{
    for (; *names; ++names)
        if (strcmp(*names, name) == 0) return true;
    return false;
}

typedef struct elastica_point {
    double angle, curvature, x, z;
} elastica_point;

static elastica_point elastica_end(double length, const double force[2], double curvature)
{
    enum { STEPS = 400 };
    const double h = length / STEPS;
    elastica_point p = {0, curvature, 0, 0};
    for (int i = 0; i < STEPS; ++i) {
        elastica_point slope[4], sum = p, at = p;
        for (int k = 0; k < 4; ++k) {
            const double weight = (k == 1 || k == 2 ? 2 : 1) * h / 6, next = (k == 2 ? 1 : 0.5) * h;
            slope[k] = (elastica_point){at.curvature, force[0] * sin(at.angle) - force[1] * cos(at.angle),
                                        cos(at.angle), sin(at.angle)};
            sum.angle += weight * slope[k].angle, sum.curvature += weight * slope[k].curvature;
            sum.x += weight * slope[k].x, sum.z += weight * slope[k].z;
            at.angle = p.angle + next * slope[k].angle, at.curvature = p.curvature + next * slope[k].curvature;
        }
        p = sum;
    }
    return p;
}

void elastica_tip(double stiffness, double length, double along, double across, double tip[2])
{
    const double force[2] = {along / stiffness, across / stiffness};
    double low = 0, high = 1e-12 / length;
    while (elastica_end(length, force, high).curvature < 0)
        low = high, high *= 2;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        if (elastica_end(length, force, middle).curvature < 0)
            low = middle;
        else
            high = middle;
    }
    const elastica_point end = elastica_end(length, force, high);
    tip[0] = end.x - length;
    tip[1] = end.z;
}
