/* breccia check: what a scene asks for and what it will cost, before it runs. */
#include "price/check_scene.h"
#include "command.h"
#include "price/check_brief.h"
#include "price/check_ranks.h"
#include "price/pace.h"
#include "price/price.h"
#include "price/price_file.h"
#include "scene_domain.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../output/checkpoint/checkpoint_identity.h"
#include "../scene/scene_reader.h"
#include "../solver/statics/free_bodies.h"
#include "../solver/effects/strikers/strikers.h"
#include "../solver/effects/contact/touching.h"

static const brc_option options[] = {
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    BRC_OPTION_THREADS,
    BRC_OPTION_SET,
    {"output", 'o', "DIR", false,
     "also write the price into DIR/price.json, with which `breccia run SCENE -o DIR` compares what it took"},
    {"all", 'a', NULL, false,
     "all of it: the scene with its defaults, effects in and out, every error the class rests on"},
    {"brief", 'b', NULL, false,
     "cut every stage after about a second, also where bonds break or surfaces meet and some seconds more would see "
     "its end"},
    {"effects", 'E', NULL, false,
     "also name the kernels that the trial launched and the arrays on the device, with launches and bytes"},
    {"ranks", 'r', "N", false, "also tell seconds and memory of N ranks of MPI"},
    {"estimate", 'e', NULL, false, "build no domain: counts and memory of it only, no time step and no seconds"},
};

static brc_status print_resolved(FILE *details, brc_context *context, const brc_scene *scene)
{
    char *yaml;
    BRC_TRY(brc_scene_to_yaml(context, scene, &yaml));
    fprintf(details, "%s\n", yaml);
    brc_memory_free(yaml);
    return BRC_OK;
}

/* model: NULL where all bodies have one. */
static void print_effects(FILE *details, const char *head, const char *model, const char *const *effects)
{
    fprintf(details, "%s%s%s:", head, model ? " with " : "", model ? model : "");
    for (int k = 0; effects[k]; ++k)
        fprintf(details, "%s%s", k ? ", " : " ", effects[k]);
    fprintf(details, "%s\n", effects[0] ? "" : " none");
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
        printf("body %s: about %lld elements, %.3g MB as a domain\n", body->name, (long long)n_elements,
               (double)bytes / 1e6);
    }
    return BRC_OK;
}

/* Model by model where there are several. */
static void print_counts(FILE *details, const brc_setup *setup, double build_s)
{
    int64_t n_free = 0;
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_domain *domain = setup->domain[k];
        char bodies[256];
        n_free += domain->n_free_faces;
        if (setup->n > 1)
            fprintf(details, "model %s: %lld elements, %lld bonds, bodies %s\n", setup->split->part[k].name,
                    (long long)domain->n_elements, (long long)domain->n_bonds,
                    brc_split_bodies(setup->split, k, bodies, sizeof bodies));
    }
    fprintf(details, "counts: %lld elements, %lld bonds, %lld free faces (built in %.3g s)\n",
            (long long)brc_setup_n_elements(setup), (long long)brc_setup_n_bonds(setup), (long long)n_free, build_s);
}

/* A line for each wall and striker. */
static void print_strikers(FILE *details, const brc_assembly *a)
{
    static const char *const motion[] = {
        [BRC_STRIKER_FIXED] = "fixed", [BRC_STRIKER_DRIVEN] = "driven", [BRC_STRIKER_FREE] = "free"};
    for (int32_t k = 0; k < brc_simulation_n_strikers(a->part[0]); ++k) {
        const brc_striker *striker = &a->scene->strikers[k];
        const brc_striker_body *body = brc_simulation_striker_body(a->part[0], k);
        fprintf(details, "striker %s: %s, %s %.6g %.6g %.6g m", striker->name, motion[striker->motion],
                striker->is_plane ? "plane through" : "mass centre at", body->centre[0], body->centre[1],
                body->centre[2]);
        if (!striker->is_plane) fprintf(details, ", %d flat faces", (int)body->surface.n_faces);
        if (striker->motion == BRC_STRIKER_FREE)
            fprintf(details, ", mass %.6g kg, moments of inertia %.4g %.4g %.4g kg m^2", body->mass, body->inertia[0],
                    body->inertia[1], body->inertia[2]);
        if (striker->pushed)
            fprintf(details, ", pushed by %.4g %.4g %.4g N", striker->force[0], striker->force[1], striker->force[2]);
        fprintf(details, "\n");
    }
}

/* Device, effects and memory. */
static void print_setup(FILE *details, const brc_setup *setup, brc_precision precision)
{
    const brc_assembly *a = &setup->assembly;
    const double bytes = (double)brc_assembly_device_bytes(a);
    const brc_device_info *info = brc_device_get_info(setup->device[0]);
    fprintf(details, "device: %s (%s), %s precision\n", info->selector, info->name, brc_precision_name(precision));
    for (int32_t k = 0; k < a->n; ++k) {
        const char *model = a->split ? brc_assembly_part_name(a, k) : NULL;
        print_effects(details, "effects in", model, brc_simulation_effects_in(a->part[k]));
        print_effects(details, "effects out", model, brc_simulation_effects_out(a->part[k]));
    }
    print_strikers(details, a);
    fprintf(details, "memory: %.4g MB on the device (%.0f bytes an element), %.4g MB on the host so far\n", bytes / 1e6,
            bytes / (double)brc_setup_n_elements(setup), (double)brc_memory_peak() / 1e6);
    for (int32_t k = 0; k < a->n; ++k) {
        const double each = (double)brc_simulation_pair_bytes(a->part[k]), bonds = (double)setup->domain[k]->n_bonds;
        if (each > 0)
            fprintf(details,
                    "        and at most %.0f bytes for each pair of surfaces near each other: %.4g MB for as many as "
                    "there are bonds\n",
                    each, each * bonds / 1e6);
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
        for (int i = 0; i < n && i < MOST; ++i)
            printf("kernel %s%s%s: %lld launches\n", of, of[0] ? "." : "", item[i].name, (long long)item[i].number);
        n = brc_device_buffers(setup->device[k], MOST, item);
        for (int i = 0; i < n && i < MOST; ++i)
            printf("array %s%s%s: %lld bytes\n", of, of[0] ? "." : "", item[i].name, (long long)item[i].number);
    }
}

/* What the last static stage of each model added for its solves: memory that the price, of the end of a run, does not
 * have. */
static void print_multigrid(const brc_setup *setup)
{
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_static_report r = brc_simulation_static_report(setup->assembly.part[k]);
        if (r.multigrid_levels > 0)
            printf("multigrid: %d levels made in %.3g s, %.4g MB more on the device while a static stage solves (%.0f "
                   "bytes an element)\n",
                   r.multigrid_levels, r.multigrid_seconds, (double)r.multigrid_bytes / 1e6,
                   (double)r.multigrid_bytes / (double)setup->domain[k]->n_elements);
    }
}

/* What the command line asks for. */
typedef struct asked {
    brc_device_request request;
    const char *folder; /* NULL: no price.json */
    bool brief, effects;
    int32_t n_ranks;
    FILE *details; /* where the long report goes; not shown: a stream that keeps nothing */
    bool all;
} asked;

/* The scene's price, from its domains to its class of error. */
static brc_status price(brc_context *context, const asked *a, brc_scene *scene, const char *yaml)
{
    const brc_device_request *request = &a->request;
    brc_check check = {.details = a->details, .built = print_counts};
    const brc_setup *setup = &check.setup;
    brc_price_error own = {.worst = -1};
    brc_check_ranks ranks = {.n_ranks = a->n_ranks};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_check_build(context, scene, request, brc_pace_start_s(request), &check));
    print_setup(a->details, setup, request->precision);
    if (!a->all) brc_check_brief_setup(stdout, scene, setup, request->precision);
    for (int32_t k = 0; k < setup->n; ++k)
        BRC_TRY_OR(cleanup, brc_free_bodies_tell(context, setup->split->part[k].scene, setup->domain[k], true));
    BRC_TRY_OR(cleanup, brc_check_try(context, request, a->brief, &check));
    print_multigrid(setup);
    if (a->effects) print_parts(setup);
    BRC_TRY_OR(cleanup, brc_check_ranks_look(context, setup, request->precision, &ranks));
    BRC_TRY_OR(cleanup, brc_check_price(context, scene, request, &check));
    if (!a->all) brc_check_brief_trial(stdout, scene, setup, &check.trial, &check.told);
    brc_check_ranks_tell(stdout, scene, &check.told, &ranks);
    const brc_price_of of = {yaml, brc_device_get_info(setup->device[0])->selector, request->precision,
                             request->n_threads};
    if (a->folder && check.told.known) BRC_TRY_OR(cleanup, brc_price_file_write(context, a->folder, &of, &check.told));
    BRC_TRY_OR(cleanup, brc_price_error_find(context, scene, &check.setup, request, &check.trial, &own));
    BRC_TRY_OR(cleanup, brc_price_tell_accuracy(context, scene, setup, request->precision, check.told.seconds, &own,
                                                a->details));
    if (!a->all) printf("more: breccia check --all; warnings, where there are any, are above\n");
cleanup:
    brc_price_error_free(&own);
    brc_check_free(&check);
    return status;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    char *yaml = NULL;
    int64_t n_threads, n_ranks;
    brc_precision precision;
    const bool all = brc_arguments_value(arguments, "all") != NULL;
    FILE *const none = all ? NULL : fopen("/dev/null", "w"), *const details = none ? none : stdout;
    BRC_TRY_OR(cleanup, brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    BRC_TRY_OR(cleanup, brc_arguments_integer(context, arguments, "ranks", 1, BRC_CHECK_MOST_RANKS, 1, &n_ranks));
    BRC_TRY_OR(cleanup, brc_arguments_precision(context, arguments, &precision));
    if (n_ranks > 1 && brc_arguments_value(arguments, "estimate")) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "breccia check: --ranks needs a domain; leave out --estimate");
        goto cleanup;
    }
    int n_overrides;
    const char *const *overrides = brc_arguments_values(arguments, "set", &n_overrides);
    BRC_TRY_OR(cleanup, brc_scene_read(context, arguments->positional[0], n_overrides, overrides, &scene));
    BRC_TRY_OR(cleanup, print_resolved(details, context, scene));
    if (brc_arguments_value(arguments, "estimate")) {
        status = print_estimate(context, scene);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_checkpoint_scene(context, scene, &yaml));
    const char *selector = brc_arguments_value(arguments, "device"), *folder = brc_arguments_value(arguments, "output");
    const asked a = {
        .request = {.selector = selector ? selector : "auto", .precision = precision, .n_threads = (int)n_threads},
        .folder = folder,
        .brief = brc_arguments_value(arguments, "brief") != NULL,
        .effects = brc_arguments_value(arguments, "effects") != NULL,
        .n_ranks = (int32_t)n_ranks,
        .details = details,
        .all = all};
    if (folder) BRC_TRY_OR(cleanup, brc_file_make_folder(context, folder)); /* before the trial: it may take minutes */
    status = price(context, &a, scene, yaml);
cleanup:
    brc_scene_free(&scene);
    brc_memory_free(yaml);
    if (none) fclose(none);
    return status;
}

const brc_command brc_command_check = {
    .name = "check",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .summary = "validate a scene and price it: effects, counts, time step, memory, seconds",
    .details = "Ten lines of what matters; --all prints the scene with its defaults and every number. Seconds, memory "
               "and disk come from a trial: the run itself in a folder\nthat is removed (below TMPDIR), each stage cut "
               "after about a second (where bonds break, surfaces meet or a condition ends it: only if\nmore than some "
               "seconds of it are left).",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
