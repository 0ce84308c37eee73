/* A domain built and written, timed. */
#include "operators.h"
#include "../scene_domain.h"
#include "../../../preprocess/domain/domain_file.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <unistd.h>

/* Seeds to domain file. The file itself is not kept: at a million elements it is larger than all other results. */
static brc_status obtain(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes,
                         const char *folder)
{
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    brc_domain *domain = NULL;
    char *path = NULL;
    BRC_TRY(brc_file_make_folder(context, folder));
    BRC_TRY(brc_file_join(context, folder, "domain.h5", &path));
    BRC_TRY_OR(cleanup, brc_scene_read_text(context, name, text, bytes, run->n_overrides, run->overrides, &scene));
    const double start = brc_clock_s();
    const int n_threads = run->n_threads > 0 ? run->n_threads : campaign->n_threads;
    BRC_TRY_OR(cleanup, brc_scene_domain_build(context, scene, n_threads, &domain));
    const double built = brc_clock_s();
    BRC_TRY_OR(cleanup, brc_domain_write(context, domain, path));
    const double end = brc_clock_s();
    unlink(path);
    outcome->seconds = end - start;
    outcome->n_elements = domain->n_elements;
    outcome->n_bonds = domain->n_bonds;
    brc_outcome_add(outcome, "seconds", "s", end - start, NAN);
    brc_outcome_add(outcome, "build_seconds", "s", built - start, NAN);
    brc_outcome_add(outcome, "write_seconds", "s", end - built, NAN);
    brc_outcome_add(outcome, "elements", "-", (double)domain->n_elements, NAN);
    brc_outcome_add(outcome, "bonds", "-", (double)domain->n_bonds, NAN);
    brc_outcome_add(outcome, "volume_error", "-", domain->quality.volume_error, 0);
cleanup:
    brc_memory_free(path);
    brc_domain_free(&domain);
    brc_scene_free(&scene);
    return status;
}

const brc_operator brc_operator_build = {.name = "build", .obtain = obtain};
