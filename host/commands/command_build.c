/* breccia build: the domain of a scene alone. */
#include "command.h"
#include "scene_domain.h"
#include "../../preprocess/domain_file.h"
#include "../../preprocess/quality.h"
#include "../../preprocess/points.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../output/export_domain.h"
#include "../output/isotropy_report.h"
#include "../scene/scene_reader.h"

static const brc_option options[] = {
    {"output", 'o', "FILE", false, "domain file to write (needed), e.g. domain.h5"},
    {"vtu", 0, "FILE", false, "write the elements for ParaView too"},
    {"csv", 0, "FILE", false, "write positions, radii and volumes too, as a table that `fill: {points: FILE}` reads"},
    {"isotropy", 0, "DIR", false, "histogram of the bonds' directions as table, surface and picture, with its numbers"},
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

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    const double start = brc_clock_s();
    const char *path = brc_arguments_value(arguments, "output");
    if (!path) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia build: say where the domain goes with -o FILE");
    const char *vtu = brc_arguments_value(arguments, "vtu"), *csv = brc_arguments_value(arguments, "csv");
    const char *isotropy = brc_arguments_value(arguments, "isotropy");
    const char *const files[] = {path, vtu, csv};
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k)
        if (files[k]) BRC_TRY(brc_file_check_place(context, files[k]));
    if (isotropy) BRC_TRY(brc_file_make_folder(context, isotropy));
    int64_t n_threads;
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    int n_overrides;
    const char *const *overrides = brc_arguments_values(arguments, "set", &n_overrides);
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    brc_domain *domain = NULL;
    BRC_TRY_OR(cleanup, brc_scene_read(context, arguments->positional[0], n_overrides, overrides, &scene));
    BRC_TRY_OR(cleanup, brc_scene_domain_build(context, scene, (int)n_threads, &domain));
    const double built = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_domain_write(context, domain, path));
    print_domain(domain);
    if (vtu) BRC_TRY_OR(cleanup, brc_export_domain_vtu(context, domain, vtu));
    if (csv) BRC_TRY_OR(cleanup, brc_points_write(context, domain, csv));
    if (isotropy) BRC_TRY_OR(cleanup, brc_isotropy_report(context, domain, 3, isotropy));
    printf("seconds: build %.3g, write %.3g\n%s\n", built - start, brc_clock_s() - built, path);
cleanup:
    brc_domain_free(&domain);
    brc_scene_free(&scene);
    return status;
}

const brc_command brc_command_build = {.name = "build",
                                       .operands = "SCENE",
                                       .least = 1,
                                       .most = 1,
                                       .summary = "build the domain of a scene (seeds, cells, bonds, sets) and write it",
                                       .details = "A scene uses the file with `domain: FILE` in place of shape and fill.",
                                       .options = options,
                                       .n_options = sizeof options / sizeof *options,
                                       .run = run};
