/* breccia build: the domain of a scene alone. */
#include "command.h"
#include "scene_domain.h"
#include "../../preprocess/domain/domain_file.h"
#include "../../preprocess/domain/quality.h"
#include "../../preprocess/points.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../output/frames/export_domain.h"
#include "../output/report/isotropy_report.h"
#include "../output/report/skin_report.h"
#include "../scene/scene_reader.h"
#include <string.h>

static const brc_option options[] = {
    {"output", 'o', "FILE", false, "domain file to write (needed), e.g. domain.h5"},
    {"vtu", 0, "FILE", false, "write the elements for ParaView too"},
    {"csv", 0, "FILE", false, "write positions, radii and volumes too, as a table that `fill: {points: FILE}` reads"},
    {"isotropy", 0, "DIR", false, "histogram of the bonds' directions as table, surface and picture, with its numbers"},
    {"skin", 0, "FILE", false, "how few beams packed spheres have near the walls, layer by layer, as a table (CSV)"},
    BRC_OPTION_THREADS,
    BRC_OPTION_SET,
};

static void print_domain(const brc_domain *domain)
{
    printf("elements %lld, bonds %lld, free faces %lld\n", (long long)domain->n_elements, (long long)domain->n_bonds,
           (long long)domain->n_free_faces);
    brc_quality_print(stdout, domain);
    for (int32_t s = 0; s < domain->n_sets; ++s)
        printf("set %-16s %10lld %s\n", domain->sets[s].name, (long long)domain->sets[s].n_members,
               domain->sets[s].kind == BRC_SET_FACES ? "faces" : "elements");
}

/* Where the domains, tables and pictures go. */
typedef struct targets {
    const char *path, *vtu, *csv, *isotropy; /* NULL: not asked for */
} targets;

/* path, or of one model among several "name-model.ending"; freed by brc_memory_free. NULL stays NULL. */
static brc_status path_of_model(brc_context *context, const char *path, const char *model, char **out)
{
    *out = NULL;
    if (!path) return BRC_OK;
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    const size_t length = strlen(path), stem = dot && dot > (slash ? slash + 1 : path) ? (size_t)(dot - path) : length;
    const size_t room = length + (model ? strlen(model) + 1 : 0) + 1;
    BRC_TRY(BRC_ALLOCATE(context, out, (int64_t)room, "name of a file"));
    snprintf(*out, room, "%.*s%s%s%s", (int)stem, path, model ? "-" : "", model ? model : "", path + stem);
    return BRC_OK;
}

/* The folders of the reports, before anything is built. */
static brc_status make_folders(brc_context *context, const brc_split *split, const char *isotropy)
{
    brc_status status = BRC_OK;
    for (int32_t k = 0; isotropy && status == BRC_OK && k < split->n; ++k) {
        char *path;
        BRC_TRY(path_of_model(context, isotropy, split->n > 1 ? split->part[k].name : NULL, &path));
        status = brc_file_make_folder(context, path);
        brc_memory_free(path);
    }
    return status;
}

/* model: NULL where there is one domain. */
static brc_status write_domain(brc_context *context, const brc_domain *domain, const char *model, const targets *to)
{
    char *path = NULL, *vtu = NULL, *csv = NULL, *isotropy = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, path_of_model(context, to->path, model, &path));
    BRC_TRY_OR(cleanup, path_of_model(context, to->vtu, model, &vtu));
    BRC_TRY_OR(cleanup, path_of_model(context, to->csv, model, &csv));
    BRC_TRY_OR(cleanup, path_of_model(context, to->isotropy, model, &isotropy));
    BRC_TRY_OR(cleanup, brc_domain_write(context, domain, path));
    if (model) printf("model %s\n", model);
    print_domain(domain);
    if (vtu) BRC_TRY_OR(cleanup, brc_export_domain_vtu(context, domain, vtu));
    if (csv) BRC_TRY_OR(cleanup, brc_points_write(context, domain, csv));
    if (isotropy) BRC_TRY_OR(cleanup, brc_isotropy_report(context, domain, 3, isotropy));
    printf("%s\n", path);
cleanup:
    brc_memory_free(path);
    brc_memory_free(vtu);
    brc_memory_free(csv);
    brc_memory_free(isotropy);
    return status;
}

/* The shape that a scene's only body stands in; it was not moved or turned. */
static brc_status only_shape(brc_context *context, const brc_scene *scene, int n_threads, brc_solid **out)
{
    if (scene->n_bodies != 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "--skin: the scene has %d bodies; give a scene of one",
                        scene->n_bodies);
    const brc_body *body = &scene->bodies[0];
    bool posed = false;
    for (int c = 0; c < 3; ++c)
        posed |= body->translation[c] != 0 || body->rotation[c] != 0;
    if (body->domain_file[0] || posed || !(body->beams > 0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "--skin: body '%s' %s; expected spheres joined by beams, packed into a shape where it stands",
                        body->name,
                        body->domain_file[0] ? "comes from a file"
                        : posed              ? "is moved or turned"
                                             : "is made of cells");
    brc_scene_request request = {.regions = NULL};
    brc_status status = brc_scene_request_make(context, scene, 0, n_threads, &request);
    if (status == BRC_OK) status = brc_solid_create(context, &request.build.shape, n_threads, out);
    brc_scene_request_free(&request);
    return status;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    const double start = brc_clock_s();
    const targets to = {.path = brc_arguments_value(arguments, "output"),
                        .vtu = brc_arguments_value(arguments, "vtu"),
                        .csv = brc_arguments_value(arguments, "csv"),
                        .isotropy = brc_arguments_value(arguments, "isotropy")};
    if (!to.path) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia build: say where the domain goes with -o FILE");
    const char *skin_path = brc_arguments_value(arguments, "skin");
    const char *const files[] = {to.path, to.vtu, to.csv, skin_path};
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k)
        if (files[k]) BRC_TRY(brc_file_check_place(context, files[k]));
    int64_t n_threads;
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    int n_overrides;
    const char *const *overrides = brc_arguments_values(arguments, "set", &n_overrides);
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    brc_split *split = NULL;
    brc_domain **domain = NULL;
    brc_solid *solid = NULL;
    BRC_TRY_OR(cleanup, brc_scene_read(context, arguments->positional[0], n_overrides, overrides, &scene));
    if (skin_path) BRC_TRY_OR(cleanup, only_shape(context, scene, (int)n_threads, &solid));
    BRC_TRY_OR(cleanup, brc_split_create(context, scene, &split));
    BRC_TRY_OR(cleanup, make_folders(context, split, to.isotropy));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain, split->n, "domains of a scene"));
    BRC_TRY_OR(cleanup, brc_split_domains_build(context, split, (int)n_threads, false, domain));
    const double built = brc_clock_s();
    for (int32_t k = 0; k < split->n; ++k)
        BRC_TRY_OR(cleanup, write_domain(context, domain[k], split->n > 1 ? split->part[k].name : NULL, &to));
    if (solid) {
        brc_skin skin;
        BRC_TRY_OR(cleanup, brc_skin_measure(context, solid, domain[0], (int)n_threads, &skin));
        BRC_TRY_OR(cleanup, brc_skin_report(context, &skin, skin_path));
    }
    printf("seconds: build %.3g, write %.3g\n", built - start, brc_clock_s() - built);
cleanup:
    for (int32_t k = 0; domain && k < split->n; ++k)
        brc_domain_free(&domain[k]);
    brc_memory_free(domain);
    brc_solid_free(&solid);
    brc_split_free(&split);
    brc_scene_free(&scene);
    return status;
}

const brc_command brc_command_build = {
    .name = "build",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .summary = "build the domain of a scene (seeds, cells, bonds, sets) and write it",
    .details = "A scene uses the file with `domain: FILE` in place of shape and fill. Bodies of several models are "
               "written model by model, each file's name with the model's before its ending.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
