/* Parts, domains, devices, simulations of a scene. */
#include "setup.h"
#include "scene_domain.h"
#include "../../preprocess/domain/domain_ranks.h"
#include "../../preprocess/domain/domain_rows.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include "../base/spill.h"
#include "../output/checkpoint/checkpoint_identity.h"
#include "../device/device_list.h"
#include "../solver/laws/beam_polish.h"
#include <math.h>
#include <omp.h>
#include <string.h>

/* With the threads of all ranks of this machine, whose first this is; with others each computes some of the cells, and
 * has no more than that where nothing puts domains on a disk. */
static brc_status build_among_firsts(brc_context *context, const brc_split *split, int n_threads, brc_domain **out)
{
    brc_ranks_narrow();
    const brc_together way = brc_ranks_count() == 1 ? BRC_ALONE : brc_spill_folder() ? BRC_TOGETHER : BRC_APART;
    brc_status status = brc_split_domains_build(context, split, n_threads, way, out);
    for (int32_t k = 0; status == BRC_OK && k < split->n; ++k)
        status = brc_checkpoint_sum_areas(context, out[k]);
    brc_ranks_widen();
    return status;
}

static void tell_whole(brc_context *context, const brc_split *split, int32_t part, const brc_domain *domain)
{
    char bodies[128];
    if (domain->here || domain->pages.n > 0) return;
    brc_log(context, BRC_LOG_INFO, "each machine has the whole domain of %s: %s",
            brc_split_bodies(split, part, bodies, sizeof bodies),
            brc_spill_folder() ? "BRECCIA_SPILL keeps it on a disk" : "it is of spheres or of a file");
}

/* All ranks, where some of a machine cannot see what the first has: they build it all. */
static brc_status build_on_each(brc_context *context, const brc_split *split, int n_threads, brc_domain **out)
{
    for (int32_t k = 0; k < split->n; ++k)
        if (out[k] && out[k]->here) BRC_TRY(brc_domain_bring_whole(context, out[k]));
    if (brc_ranks_here().local == 0) return BRC_OK;
    for (int32_t k = 0; k < split->n; ++k)
        brc_domain_free(&out[k]);
    return brc_split_domains_build(context, split, n_threads, BRC_ALONE, out);
}

/* On several ranks the first of each machine builds. */
static brc_status build(brc_context *context, const brc_split *split, int n_threads, brc_domain **out)
{
    const brc_ranks_place here = brc_ranks_here();
    const int each = n_threads > 0 ? n_threads : omp_get_max_threads();
    bool all = true, shared;
    if (here.count == 1) return brc_split_domains_build(context, split, n_threads, BRC_ALONE, out);
    if (here.local == 0) BRC_TRY(build_among_firsts(context, split, each * here.local_count, out));
    for (int32_t k = 0; k < split->n; ++k) {
        BRC_TRY(brc_domain_share(context, &out[k], &shared));
        all = all && shared;
    }
    if (!all) return build_on_each(context, split, n_threads, out);
    for (int32_t k = 0; k < split->n && here.local_count < here.count; ++k)
        tell_whole(context, split, k, out[k]);
    return BRC_OK;
}

brc_status brc_setup_domains(brc_context *context, brc_scene *scene, const brc_domain *given, int n_threads,
                             brc_setup *setup)
{
    BRC_TRY(brc_split_create(context, scene, &setup->split));
    const int32_t n = setup->split->n;
    BRC_TRY(BRC_ALLOCATE(context, &setup->built, n, "domains of a scene"));
    BRC_TRY(BRC_ALLOCATE(context, &setup->domain, n, "domains of a scene"));
    BRC_TRY(BRC_ALLOCATE(context, &setup->device, n, "devices of a scene"));
    BRC_TRY(BRC_ALLOCATE(context, &setup->simulation, n, "simulations of a scene"));
    setup->n = n;
    if (given && n > 1) return BRC_FAIL(context, BRC_INTERNAL, "one domain was given for bodies of %d models", (int)n);
    if (!given) BRC_TRY(build(context, setup->split, n_threads, setup->built));
    for (int32_t k = 0; k < n; ++k)
        setup->domain[k] = given ? given : setup->built[k];
    return brc_split_share(context, setup->split, setup->domain);
}

brc_status brc_setup_polish(brc_context *context, int n_threads, brc_setup *setup)
{
    for (int32_t k = 0; k < setup->n; ++k) {
        brc_scene *scene = setup->split->part[k].scene;
        if (brc_model_traits_of(scene->model.kind)->spheres && scene->model.polish)
            BRC_TRY(brc_beam_polish_scene(context, scene, setup->domain[k], n_threads));
    }
    return BRC_OK;
}

brc_status brc_setup_simulations(brc_context *context, const brc_device_request *request, brc_setup *setup)
{
    if (setup->split->scene->has_contact && setup->n > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "contact: bodies of %d models are in the scene, whose surfaces and strikers do not meet across "
                        "models; give all bodies one model, or leave contact out",
                        (int)setup->n);
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_scene *scene = setup->split->part[k].scene;
        brc_device_request own = *request;
        own.many_materials = brc_simulation_needs_many_materials(scene, setup->domain[k]);
        BRC_TRY(brc_device_open(context, &own, &setup->device[k]));
        if (k == 0) BRC_TRY(brc_device_log_places(context, setup->device[k]));
        BRC_TRY(brc_simulation_create(context, scene, setup->domain[k], setup->device[k], &setup->simulation[k]));
        if (setup->domain[k]->here) BRC_TRY(brc_domain_tell(context, setup->built[k]));
    }
    setup->assembly = brc_assembly_make(setup->split->scene, setup->split, setup->n, setup->simulation);
    return BRC_OK;
}

void brc_setup_free_simulations(brc_setup *setup)
{
    for (int32_t k = 0; k < setup->n; ++k)
        brc_simulation_free(&setup->simulation[k]);
    setup->assembly = (brc_assembly){0};
}

void brc_setup_free(brc_setup *setup)
{
    brc_setup_free_simulations(setup);
    for (int32_t k = 0; k < setup->n; ++k) {
        brc_device_close(&setup->device[k]);
        brc_domain_free(&setup->built[k]);
    }
    brc_memory_free(setup->simulation);
    brc_memory_free(setup->device);
    brc_memory_free(setup->domain);
    brc_memory_free(setup->built);
    brc_split_free(&setup->split);
    memset(setup, 0, sizeof *setup);
}

int64_t brc_setup_n_elements(const brc_setup *setup)
{
    int64_t n = 0;
    for (int32_t k = 0; k < setup->n; ++k)
        n += setup->domain[k] ? setup->domain[k]->n_elements : 0;
    return n;
}

int64_t brc_setup_n_bonds(const brc_setup *setup)
{
    int64_t n = 0;
    for (int32_t k = 0; k < setup->n; ++k)
        n += setup->domain[k] ? setup->domain[k]->n_bonds : 0;
    return n;
}

double brc_setup_across(const brc_setup *setup)
{
    double most = 0;
    for (int32_t k = 0; k < setup->n; ++k)
        for (int d = 0; d < 3; ++d)
            most = fmax(most, (setup->domain[k]->bounds[1][d] - setup->domain[k]->bounds[0][d]) /
                                  setup->domain[k]->quality.mean_spacing);
    return most;
}
