/* breccia check: what a scene asks for and what it will cost, before it runs. */
#include "command.h"
#include "price.h"
#include "scene_domain.h"
#include "setup.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../scene/scene_reader.h"
#include "../solver/lockstep.h"
#include "../solver/strikers.h"
#include <math.h>

static const brc_option options[] = {
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    BRC_OPTION_THREADS,
    BRC_OPTION_SET,
    {"estimate", 'e', NULL, false, "build no domain: counts and memory of it only, no time step and no seconds"},
};

/* Iterations of a linear solve to 1e-10, in units of the elements along the longest line through the solid: a rule of
 * thumb that does not know the loads. Four examples took 0.5 to 2.4 times as many as it says (docs/performance.md). */
#define ITERATIONS_PER_CELL_ACROSS 5
/* Linear solves of a static increment: the first and the corrections of the finite-strain law. */
#define SOLVES_PER_INCREMENT 4
/* What a mode costs, in linear solves: eight rounds a cell across, each with dense sums that take longer than the forces. */
#define SOLVES_PER_MODE 12.0

static brc_status print_resolved(brc_context *context, const brc_scene *scene)
{
    char *yaml;
    BRC_TRY(brc_scene_to_yaml(context, scene, &yaml));
    printf("%s\n", yaml);
    brc_memory_free(yaml);
    return BRC_OK;
}

/* model: NULL where all bodies have one. */
static void print_effects(const char *head, const char *model, const char *const *effects)
{
    printf("%s%s%s:", head, model ? " with " : "", model ? model : "");
    for (int k = 0; effects[k]; ++k)
        printf("%s%s", k ? ", " : " ", effects[k]);
    printf("%s\n", effects[0] ? "" : " none");
}

static brc_status print_estimate(brc_context *context, const brc_scene *scene)
{
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        if (body->domain_file[0]) {
            printf("body %s: read from %s\n", body->name, body->domain_file);
            continue;
        }
        brc_scene_request request;
        int64_t n_elements, bytes;
        BRC_TRY(brc_scene_request_make(context, scene, b, 0, &request));
        const brc_status status = brc_domain_estimate(context, &request.build, &n_elements, &bytes);
        brc_scene_request_free(&request);
        BRC_TRY(status);
        printf("body %s: about %lld elements, %.3g MB as a domain\n", body->name, (long long)n_elements, (double)bytes / 1e6);
    }
    return BRC_OK;
}

/* Seconds of one force evaluation and step: a few hundred milliseconds of the real thing. The stage is run as a dynamic
 * one whatever it is: what a static or modes stage repeats costs about the same. */
static brc_status time_a_step(brc_context *context, brc_scene *scene, const brc_domain *domain, brc_device *device,
                              int32_t stage, double *seconds)
{
    brc_simulation *simulation = NULL;
    brc_stage *changed = &scene->stages[stage];
    const brc_stage kept = *changed;
    changed->solver = BRC_SOLVER_DYNAMIC;
    changed->duration = 0;
    changed->steps = 1000000;
    changed->safety = kept.safety > 0 ? kept.safety : 0.8;
    if (kept.solver != BRC_SOLVER_DYNAMIC) changed->time_step_rule = BRC_TIME_STEP_AUTO;
    brc_status status = brc_simulation_create(context, scene, domain, device, &simulation);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_simulation_begin_stage(simulation, stage));
    BRC_TRY_OR(cleanup, brc_simulation_advance(simulation, 2)); /* pages are touched, kernels built */
    BRC_TRY_OR(cleanup, brc_simulation_wait(simulation));
    int64_t n = 1;
    double elapsed = 0;
    for (; elapsed < 0.2; n *= 2) {
        const double start = brc_clock_s();
        BRC_TRY_OR(cleanup, brc_simulation_advance(simulation, n));
        BRC_TRY_OR(cleanup, brc_simulation_wait(simulation));
        elapsed = brc_clock_s() - start;
        *seconds = elapsed / (double)n;
    }
cleanup:
    brc_simulation_free(&simulation);
    *changed = kept;
    return status;
}

/* Time step and number of steps of a dynamic stage. */
typedef struct plan {
    brc_time_step step;
    int64_t n_steps;
} plan;

static brc_status make_plans(const brc_assembly *assembly, plan *plans)
{
    for (int32_t k = 0; k < assembly->scene->n_stages; ++k) {
        if (assembly->scene->stages[k].solver != BRC_SOLVER_DYNAMIC) continue;
        BRC_TRY(brc_lockstep_begin_stage(assembly->n, assembly->part, k));
        plans[k].step = brc_assembly_time_step(assembly);
        plans[k].n_steps = brc_simulation_planned_steps(assembly->part[0], k, plans[k].step.value);
    }
    return BRC_OK;
}

/* What a solve repeats, in steps, by a part's size. */
static double cells_across(const brc_domain *domain)
{
    double longest = 0;
    for (int d = 0; d < 3; ++d)
        longest = fmax(longest, domain->bounds[1][d] - domain->bounds[0][d]);
    return longest / domain->quality.mean_spacing;
}

/* A line or two a stage; adds its predicted seconds to *total. */
static brc_status print_stage(brc_context *context, const brc_setup *setup, int32_t index, const plan *planned, double *total)
{
    const brc_stage *stage = &setup->split->scene->stages[index];
    double per_step = 0, iterated = 0; /* iterated: a step of each part times what is across it */
    for (int32_t k = 0; k < setup->n; ++k) {
        double one;
        BRC_TRY(time_a_step(context, setup->split->part[k].scene, setup->domain[k], setup->device[k], index, &one));
        per_step += one;
        iterated += one * cells_across(setup->domain[k]);
    }
    if (stage->solver == BRC_SOLVER_DYNAMIC) {
        const brc_time_step step = planned->step;
        const int64_t n = planned->n_steps;
        printf("stage %s: time step %.6g s (%s", stage->name, step.value, step.governed_by);
        if (step.critical > 0) printf(", %.3g of the critical %.6g s", step.value / step.critical, step.critical);
        printf("; the paper's rule would give %.6g s)\n", step.published);
        printf("stage %s: %lld steps of %.3g s each, %.3g bond updates/s: %.3g s\n", stage->name, (long long)n, per_step,
               (double)brc_setup_n_bonds(setup) / per_step, per_step * (double)n);
        *total += per_step * (double)n;
        return BRC_OK;
    }
    const double solves = stage->solver == BRC_SOLVER_MODES ? SOLVES_PER_MODE * stage->n_modes
                                                            : stage->increments * (stage->finite_strain ? SOLVES_PER_INCREMENT : 1.0);
    const double seconds = solves * ITERATIONS_PER_CELL_ACROSS * iterated;
    printf("stage %s: %s; about %.2g iterations of %.3g s each: %.2g s (a rule of thumb)\n", stage->name,
           stage->solver == BRC_SOLVER_MODES ? "modes" : "static", seconds / per_step, per_step, seconds);
    *total += seconds;
    return BRC_OK;
}

/* Model by model where there are several. */
static void print_counts(const brc_setup *setup, double build_s)
{
    int64_t n_free = 0;
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_domain *domain = setup->domain[k];
        char bodies[256];
        n_free += domain->n_free_faces;
        if (setup->n > 1)
            printf("model %s: %lld elements, %lld bonds, bodies %s\n", setup->split->part[k].name, (long long)domain->n_elements,
                   (long long)domain->n_bonds, brc_split_bodies(setup->split, k, bodies, sizeof bodies));
    }
    printf("counts: %lld elements, %lld bonds, %lld free faces (built in %.3g s)\n", (long long)brc_setup_n_elements(setup),
           (long long)brc_setup_n_bonds(setup), (long long)n_free, build_s);
}

/* A line for each wall and striker. */
static void print_strikers(const brc_assembly *a)
{
    static const char *const motion[] = {[BRC_STRIKER_FIXED] = "fixed", [BRC_STRIKER_DRIVEN] = "driven", [BRC_STRIKER_FREE] = "free"};
    for (int32_t k = 0; k < brc_simulation_n_strikers(a->part[0]); ++k) {
        const brc_striker *striker = &a->scene->strikers[k];
        const brc_striker_body *body = brc_simulation_striker_body(a->part[0], k);
        printf("striker %s: %s, %s %.6g %.6g %.6g m", striker->name, motion[striker->motion], striker->is_plane ? "plane through" : "mass centre at", body->centre[0],
               body->centre[1], body->centre[2]);
        if (!striker->is_plane) printf(", %d flat faces", (int)body->surface.n_faces);
        if (striker->motion == BRC_STRIKER_FREE)
            printf(", mass %.6g kg, moments of inertia %.4g %.4g %.4g kg m^2", body->mass, body->inertia[0], body->inertia[1], body->inertia[2]);
        printf("\n");
    }
}

/* Device, effects and memory. */
static void print_setup(const brc_setup *setup, brc_precision precision)
{
    const brc_assembly *a = &setup->assembly;
    const double bytes = (double)brc_assembly_device_bytes(a);
    const brc_device_info *info = brc_device_get_info(setup->device[0]);
    printf("device: %s (%s), %s precision\n", info->selector, info->name, brc_precision_name(precision));
    for (int32_t k = 0; k < a->n; ++k) {
        const char *model = a->split ? brc_assembly_part_name(a, k) : NULL;
        print_effects("effects in", model, brc_simulation_effects_in(a->part[k]));
        print_effects("effects out", model, brc_simulation_effects_out(a->part[k]));
    }
    print_strikers(a);
    printf("memory: %.4g MB on the device (%.0f bytes an element), %.4g MB on the host\n", bytes / 1e6,
           bytes / (double)brc_setup_n_elements(setup), (double)brc_memory_peak() / 1e6);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    brc_setup setup = {0};
    plan *plans = NULL;
    int64_t n_threads;
    brc_precision precision;
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    BRC_TRY(brc_arguments_precision(context, arguments, &precision));
    int n_overrides;
    const char *const *overrides = brc_arguments_values(arguments, "set", &n_overrides);
    BRC_TRY(brc_scene_read(context, arguments->positional[0], n_overrides, overrides, &scene));
    BRC_TRY_OR(cleanup, print_resolved(context, scene));
    if (brc_arguments_value(arguments, "estimate")) {
        status = print_estimate(context, scene);
        goto cleanup;
    }
    const double build_start = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_setup_domains(context, scene, NULL, (int)n_threads, &setup));
    double total = brc_clock_s() - build_start;
    print_counts(&setup, total);
    const char *selector = brc_arguments_value(arguments, "device");
    const brc_device_request request = {.selector = selector ? selector : "auto", .precision = precision, .n_threads = (int)n_threads};
    BRC_TRY_OR(cleanup, brc_setup_simulations(context, &request, &setup));
    print_setup(&setup, precision);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &plans, scene->n_stages, "plans of the stages"));
    BRC_TRY_OR(cleanup, make_plans(&setup.assembly, plans));
    brc_setup_free_simulations(&setup); /* the timing makes its own, and both may not fit */
    for (int32_t k = 0; k < scene->n_stages; ++k)
        BRC_TRY_OR(cleanup, print_stage(context, &setup, k, &plans[k], &total));
    printf("predicted: %.3g s with building, without output\n", total);
    BRC_TRY_OR(cleanup, brc_price_tell_accuracy(context, scene, &setup, precision, total));
cleanup:
    brc_memory_free(plans);
    brc_setup_free(&setup);
    brc_scene_free(&scene);
    return status;
}

const brc_command brc_command_check = {.name = "check",
                                       .operands = "SCENE",
                                       .least = 1,
                                       .most = 1,
                                       .summary = "validate a scene and price it: effects, counts, time step, memory, seconds",
                                       .details = "Prints the scene with all defaults. Seconds come from timing some steps on the device.",
                                       .options = options,
                                       .n_options = sizeof options / sizeof *options,
                                       .run = run};
