/* breccia check: what a scene asks for and what it will cost, before it runs. */
#include "command.h"
#include "pace.h"
#include "price.h"
#include "price_file.h"
#include "price_trial.h"
#include "scene_domain.h"
#include "setup.h"
#include "trial.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../output/checkpoint_identity.h"
#include "../scene/scene_reader.h"
#include "../solver/free_bodies.h"
#include "../solver/strikers.h"
#include "../solver/touching.h"

static const brc_option options[] = {
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    BRC_OPTION_THREADS,
    BRC_OPTION_SET,
    {"output", 'o', "DIR", false, "also write the price into DIR/price.json, with which `breccia run SCENE -o DIR` compares what it took"},
    {"brief", 'b', NULL, false, "cut every stage after about a second, also where bonds break or surfaces meet and some seconds more would see its end"},
    {"effects", 'E', NULL, false, "also name the kernels that the trial launched and the arrays on the device, with launches and bytes"},
    {"estimate", 'e', NULL, false, "build no domain: counts and memory of it only, no time step and no seconds"},
};

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
    printf("memory: %.4g MB on the device (%.0f bytes an element), %.4g MB on the host so far\n", bytes / 1e6,
           bytes / (double)brc_setup_n_elements(setup), (double)brc_memory_peak() / 1e6);
    for (int32_t k = 0; k < a->n; ++k) {
        const double each = (double)brc_simulation_pair_bytes(a->part[k]), bonds = (double)setup->domain[k]->n_bonds;
        if (each > 0) printf("        and at most %.0f bytes for each pair of surfaces near each other: %.4g MB for as many as there are bonds\n", each, each * bonds / 1e6);
    }
}

/* A line for each kernel that was launched, and for each array. */
static void print_parts(const brc_setup *setup)
{
    enum { MOST = 256 };
    brc_device_item item[MOST];
    for (int32_t k = 0; k < setup->assembly.n; ++k) {
        const char *of = setup->assembly.split ? brc_assembly_part_name(&setup->assembly, k) : "";
        int n = brc_device_launched(setup->device[k], MOST, item);
        for (int i = 0; i < n && i < MOST; ++i) printf("kernel %s%s%s: %lld launches\n", of, of[0] ? "." : "", item[i].name, (long long)item[i].number);
        n = brc_device_buffers(setup->device[k], MOST, item);
        for (int i = 0; i < n && i < MOST; ++i) printf("array %s%s%s: %lld bytes\n", of, of[0] ? "." : "", item[i].name, (long long)item[i].number);
    }
}

/* What the last static stage of each model added for its solves. */
static void print_multigrid(const brc_setup *setup)
{
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_static_report r = brc_simulation_static_report(setup->assembly.part[k]);
        if (r.multigrid_levels > 0)
            printf("multigrid: %d levels made in %.3g s, %.4g MB more on the device while a static stage solves (%.0f bytes an element)\n", r.multigrid_levels,
                   r.multigrid_seconds, (double)r.multigrid_bytes / 1e6, (double)r.multigrid_bytes / (double)setup->domain[k]->n_elements);
    }
}

/* The simulations, and how long making them took. */
static brc_status make_simulations(brc_context *context, const brc_device_request *request, brc_setup *setup, double *seconds)
{
    const double start = brc_pace_clock_s(request);
    BRC_TRY(brc_setup_simulations(context, request, setup));
    *seconds = brc_pace_clock_s(request) - start;
    return BRC_OK;
}

/* OpenCL drivers compile a kernel when it is first launched and keep it on disk for later runs: PoCL takes some ten seconds for all of a run, which would be taken for its pace. So
 * a brief trial goes before the one that is measured. */
static brc_status compile_first(brc_context *context, const brc_device_request *request, brc_setup *setup, double *seconds)
{
    brc_trial trial = {0};
    if (brc_device_get_info(setup->device[0])->kind != BRC_DEVICE_OPENCL) return BRC_OK;
    const brc_status status = brc_trial_run(context, setup, request, true, &trial);
    brc_trial_free(&trial);
    brc_setup_free_simulations(setup);
    for (int32_t k = 0; k < setup->n; ++k) brc_device_close(&setup->device[k]);
    return status == BRC_OK ? make_simulations(context, request, setup, seconds) : status;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    char *yaml = NULL;
    brc_setup setup = {0};
    brc_trial trial = {0};
    brc_price_error own = {.worst = -1};
    brc_prediction_told told;
    double simulations_s;
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
    BRC_TRY_OR(cleanup, brc_checkpoint_scene(context, scene, &yaml));
    const char *selector = brc_arguments_value(arguments, "device"), *folder = brc_arguments_value(arguments, "output");
    const brc_device_request request = {.selector = selector ? selector : "auto", .precision = precision, .n_threads = (int)n_threads};
    if (folder) BRC_TRY_OR(cleanup, brc_file_make_folder(context, folder)); /* before the trial: it may take minutes */
    const double start = brc_pace_start_s(&request), build_start = brc_pace_clock_s(&request);
    BRC_TRY_OR(cleanup, brc_setup_domains(context, scene, NULL, (int)n_threads, &setup));
    print_counts(&setup, brc_pace_clock_s(&request) - build_start);
    BRC_TRY_OR(cleanup, brc_setup_polish(context, (int)n_threads, &setup));
    const double built_s = brc_pace_clock_s(&request) - start;
    BRC_TRY_OR(cleanup, make_simulations(context, &request, &setup, &simulations_s));
    print_setup(&setup, precision);
    for (int32_t k = 0; k < setup.n; ++k) BRC_TRY_OR(cleanup, brc_free_bodies_tell(context, setup.split->part[k].scene, setup.domain[k], true));
    BRC_TRY_OR(cleanup, compile_first(context, &request, &setup, &simulations_s));
    BRC_TRY_OR(cleanup, brc_trial_run(context, &setup, &request, brc_arguments_value(arguments, "brief") != NULL, &trial));
    print_multigrid(&setup);
    if (brc_arguments_value(arguments, "effects")) print_parts(&setup);
    brc_setup_free_simulations(&setup); /* a coarser body may need the room */
    BRC_TRY_OR(cleanup, brc_price_tell_trial(context, scene, &setup, &request, &trial, built_s + simulations_s, &told));
    const brc_price_of of = {yaml, brc_device_get_info(setup.device[0])->selector, precision, (int)n_threads};
    if (folder && told.known) BRC_TRY_OR(cleanup, brc_price_file_write(context, folder, &of, &told));
    BRC_TRY_OR(cleanup, brc_price_error_find(context, scene, &setup, &request, &trial, &own));
    BRC_TRY_OR(cleanup, brc_price_tell_accuracy(context, scene, &setup, precision, told.seconds, &own));
cleanup:
    brc_price_error_free(&own);
    brc_trial_free(&trial);
    brc_setup_free(&setup);
    brc_scene_free(&scene);
    brc_memory_free(yaml);
    return status;
}

const brc_command brc_command_check = {.name = "check",
                                       .operands = "SCENE",
                                       .least = 1,
                                       .most = 1,
                                       .summary = "validate a scene and price it: effects, counts, time step, memory, seconds",
                                       .details = "Prints the scene with all defaults. Seconds, memory and disk come from a trial: the run itself in a folder\nthat is removed (below TMPDIR), each stage cut after about a second (where bonds break, surfaces meet or a condition ends it: only if\nmore than some seconds of it are left).",
                                       .options = options,
                                       .n_options = sizeof options / sizeof *options,
                                       .run = run};
