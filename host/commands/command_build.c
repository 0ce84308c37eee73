/* breccia build: the domain of a scene alone. */
#include "command.h"
#include "scene_domain.h"
#include "../../preprocess/domain_file.h"
#include "../base/log.h"
#include "../scene/scene_reader.h"

static const brc_option options[] = {
    {"output", 'o', "FILE", false, "domain file to write (needed), e.g. domain.h5"},
    BRC_OPTION_THREADS,
    BRC_OPTION_SET,
};

static void print_quality(const brc_domain *domain)
{
    const brc_quality *quality = &domain->quality;
    printf("elements %lld, bonds %lld, free faces %lld\n", (long long)domain->n_elements, (long long)domain->n_bonds,
           (long long)domain->n_free_faces);
    printf("coordination number %.4g, mean spacing %.6g m, smallest distance %.6g m\n", quality->coordination_mean,
           quality->mean_spacing, quality->smallest_distance);
    printf("volume %.9g m^3, off by %.2e from the shape's\n", quality->volume_cells, quality->volume_error);
    printf("seeds: %lld asked, %lld too near another one, %lld lost\n", (long long)quality->n_seeds_requested,
           (long long)quality->n_seeds_duplicate, (long long)quality->n_seeds_lost);
    printf("faces below %.1e of the mean area dropped: %lld (%.1e of the area)\n", quality->tiny_face_threshold,
           (long long)quality->n_tiny_faces_dropped, quality->tiny_face_area_fraction);
    printf("worst closure of a cell %.1e, worst difference of twin areas %.1e, least support %.3g\n", quality->closure_worst,
           quality->twin_area_worst, quality->support_smallest);
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
    print_quality(domain);
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
