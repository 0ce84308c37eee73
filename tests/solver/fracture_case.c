#include "fracture_case.h"
#include "../../host/base/log.h"
#include <stdio.h>
#include <string.h>

brc_status try_fracture(bench_case *c, fracture_options o)
{
    char text[8192];
    memset(c, 0, sizeof *c);
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    const int length = snprintf(
        text, sizeof text,
        "version: 1\nmaterials:\n  glass: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: %s%s%s}\nmodel: cbm\nbodies:\n  - name: cube\n"
        "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n    fill: {packing: {elements: %d, seed: %d}}\n    beams: 8\n    material: glass\n%s%s%s%s%s%s%s"
        "output: {frames: none, picture: false}\n",
        o.beam ? o.beam : "{radius: 0.4, E: 8 Pa}", o.strength ? ", " : "", o.strength ? o.strength : "", o.elements ? o.elements : 500,
        o.seed ? o.seed : 1, o.grains ? "    grains: " : "", o.grains ? o.grains : "", o.grains ? "\n" : "", o.fracture ? "fracture: " : "", o.fracture ? o.fracture : "", o.fracture ? "\n" : "",
        o.stages ? o.stages : "stages:\n  - name: move\n    solver: {dynamic: {steps: 1}}\n");
    assert_true(length < (int)sizeof text);
    BRC_TRY(brc_scene_read_text(c->context, "test.yaml", text, (size_t)length, 0, NULL, &c->scene));
    const brc_body *body = c->scene->bodies;
    const brc_build_request request = {.shape = body->shape, .fill = body->fill, .beams = body->beams, .grains = body->grains, .n_sets = c->scene->n_sets, .sets = c->scene->sets};
    BRC_TRY(brc_domain_build(c->context, &request, &c->domain));
    const brc_device_request device = {.selector = o.device ? o.device : "cpu", .precision = o.precision, .n_threads = o.n_threads,
                                       .lanes = o.lanes, .exact = o.exact};
    BRC_TRY(brc_device_open(c->context, &device, &c->device));
    return brc_simulation_create(c->context, c->scene, c->domain, c->device, &c->simulation);
}

void open_fracture(bench_case *c, fracture_options options) { assert_done(c, try_fracture(c, options)); }

void fracture_compare(fracture_options a, fracture_options b)
{
    bench_case x, y;
    open_fracture(&x, a);
    open_fracture(&y, b);
    assert_same_breaks(&x, &y, 120);
    close_case(&x);
    close_case(&y);
}
