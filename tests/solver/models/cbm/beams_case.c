#include "beams_case.h"
#include "../../../../host/base/log.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void beams_done(beams_case *c, brc_status status)
{
    assert_done(c, status);
}
void close_beams(beams_case *c)
{
    close_case(c);
}

void open_beams(beams_case *c, beams_options o)
{
    char name[64], text[8192];
    memset(c, 0, sizeof *c);
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    snprintf(name, sizeof name, "beams_case_%ld.csv", (long)getpid()); /* tests run side by side */
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file, "x,y,z,radius\n");
    for (int64_t i = 0; i < o.n; ++i)
        fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", o.position[3 * i], o.position[3 * i + 1], o.position[3 * i + 2],
                o.radius);
    fclose(file);
    const int length = snprintf(
        text, sizeof text,
        "version: 1\nmaterials:\n%s\nmodel: %s\nbodies:\n  - name: body\n    shape: {box: {origin: [-5 m, -5 m, -5 m], "
        "size: [30 m, 30 m, 30 m]}}\n"
        "    fill: {points: {file: %s}}\n    beams: %.17g\n    material: stone\n%s%soutput: {frames: none, picture: "
        "false}\n",
        o.materials ? o.materials : "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.2, E: 1 Pa}}",
        o.model ? o.model : "cbm", name, o.coordination, o.regions ? o.regions : "", o.stages);
    assert_true(length < (int)sizeof text);
    assert_done(c, brc_scene_read_text(c->context, "test.yaml", text, (size_t)length, 0, NULL, &c->scene));
    const brc_body *body = c->scene->bodies;
    brc_predicate regions[8];
    for (int32_t r = 0; r < body->n_regions; ++r)
        regions[r] = body->regions[r].where;
    const brc_build_request request = {.shape = body->shape,
                                       .fill = body->fill,
                                       .beams = body->beams,
                                       .n_sets = c->scene->n_sets,
                                       .sets = c->scene->sets,
                                       .n_regions = body->n_regions,
                                       .regions = regions};
    assert_done(c, brc_domain_build(c->context, &request, &c->domain));
    remove(name);
    const brc_device_request open = {.selector = o.device ? o.device : "cpu",
                                     .precision = o.precision,
                                     .many_materials = brc_simulation_needs_many_materials(c->scene, c->domain),
                                     .n_threads = o.n_threads,
                                     .exact = o.exact};
    assert_done(c, brc_device_open(c->context, &open, &c->device));
    const brc_status status = brc_simulation_create(c->context, c->scene, c->domain, c->device, &c->simulation);
    if (o.refused)
        assert_int_equal(status, BRC_BAD_INPUT);
    else
        assert_done(c, status);
}

void open_lattice(beams_case *c, int n, beams_options o)
{
    double *x = calloc((size_t)(3 * n * n * n), sizeof *x);
    for (int i = 0, at = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const int cell[3] = {i, j, k};
                for (int d = 0; d < 3; ++d, ++at)
                    x[at] = 0.5 + cell[d] + 0.1 * random_at((uint64_t)at);
            }
    o.n = (int64_t)n * n * n;
    o.position = x;
    o.radius = 0.5;
    open_beams(c, o);
    free(x);
}
