/* Making and freeing a simulation, entering stages, running them, and the observers. */
#include "split.h"
#include "look.h"
#include "run_internal.h"
#include "../../../preprocess/domain/domain_rows.h"
#include "../../base/ranks.h"
#include "../../device/shares.h"
#include <math.h>
#include <string.h>

/* Material of an element: its body's, or that of the last region it lies in. */
static int32_t material_index(const brc_scene *scene, const brc_domain *domain, int64_t e)
{
    const int32_t b = domain->body[e] < scene->n_bodies ? domain->body[e] : 0;
    return brc_body_material(&scene->bodies[b], domain->region[e]);
}

bool brc_simulation_needs_many_materials(const brc_scene *scene, const brc_domain *domain)
{
    for (int64_t e = 1; e < domain->n_elements; ++e)
        if (material_index(scene, domain, e) != material_index(scene, domain, 0)) return true;
    return false;
}

static brc_status find_materials(brc_simulation *s)
{
    BRC_TRY(BRC_ALLOCATE(s->context, &s->elastic, s->scene->n_materials, "materials"));
    BRC_TRY(BRC_ALLOCATE(s->context, &s->material_of_element, s->domain->n_elements, "materials of elements"));
    for (int32_t m = 0; m < s->scene->n_materials; ++m)
        s->elastic[m] = brc_elastic_of(s->scene->materials + m);
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        s->material_of_element[e] = material_index(s->scene, s->domain, e);
    return BRC_OK;
}

brc_status brc_simulation_layout(brc_context *context, const brc_scene *scene, const brc_domain *domain, int32_t slice,
                                 brc_layout **out)
{
    BRC_TRY(brc_layout_create(context, domain, slice, out));
    int n;
    const brc_effect *const *effects = brc_effects(&n);
    for (int k = 0; k < n; ++k)
        if (effects[k]->exposes && effects[k]->exposes(scene)) brc_layout_all_boundary(*out);
    return BRC_OK;
}

int64_t brc_simulation_planned_bytes(const brc_simulation *s)
{
    return brc_fields_planned(&s->wants, BRC_LIFE_RUN) + brc_fields_planned(&s->wants, BRC_LIFE_SEARCH);
}

/* Several ranks share the rows. */
static brc_status share_rows(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    const int64_t n = layout->n_slots * layout->slice;
    if (brc_ranks_count() == 1) return BRC_OK;
    BRC_LOCAL(s->context, n, int32_t, neighbour, "neighbours");
    for (int32_t block = 0; block < layout->n_slices; ++block)
        for (int64_t k = (int64_t)layout->slot_start[block] * layout->slice;
             k < (int64_t)layout->slot_start[block + 1] * layout->slice; ++k)
            neighbour[k] = layout->half_edge[k] >= 0
                               ? layout->row_of_element[s->domain->neighbour[layout->half_edge[k]]]
                               : block * layout->slice + (int32_t)(k % layout->slice);
    return brc_device_share(s->device, &(brc_rows_of_device){.n_rows = layout->n_rows,
                                                             .n_groups = s->n_groups,
                                                             .n_slices = layout->n_slices,
                                                             .slice = layout->slice,
                                                             .slot_start = layout->slot_start,
                                                             .neighbour = neighbour});
}

/* For what is made now: faces of cells whose rows this rank owns, and of those that their bonds reach; on other devices
 * than the cpu, whose arrays are of all rows, of all. */
static brc_status bring_cells(brc_simulation *s)
{
    const brc_domain *d = s->domain;
    const brc_layout *layout = s->layout;
    const bool all = brc_device_get_info(s->device)->kind != BRC_DEVICE_CPU;
    if (!d->here) return BRC_OK;
    BRC_LOCAL(s->context, d->n_elements, uint8_t, wanted, "cells of a rank");
    const brc_row_range own = brc_device_rows_here(s->device);
    if (all) memset(wanted, 1, (size_t)d->n_elements);
    for (int32_t r = own.first; r < own.end; ++r) {
        const int32_t e = layout->element_of_row[r];
        if (e >= 0) wanted[e] = 1;
        for (int64_t h = e < 0 ? 0 : d->row_start[e]; h < (e < 0 ? 0 : d->row_start[e + 1]); ++h)
            wanted[d->neighbour[h]] = 1;
    }
    return brc_domain_bring(s->context, d, wanted);
}

brc_status brc_simulation_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                 brc_device *device, brc_simulation **out)
{
    *out = NULL;
    const double start = brc_clock_s();
    BRC_ENDS_WITH(brc_simulation_free) brc_simulation *s = NULL;
    if (domain->n_elements < 1) return BRC_FAIL(context, BRC_BAD_INPUT, "the domain has no elements");
    if (domain->element_kind == BRC_ELEMENT_SPHERE &&
        brc_bond_model_of(scene->model.kind)->element != BRC_ELEMENT_SPHERE)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "model %s needs cells, the bodies are spheres joined by beams; remove `beams` from the bodies, "
                        "or use model: cbm",
                        brc_model_name(scene->model.kind));
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        if (scene->bodies[b].has_model && !brc_split_same_model(&scene->bodies[b].model, &scene->model))
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "body '%s' has a model of its own, which one simulation of the whole scene cannot move; "
                            "split the scene (split.h)",
                            scene->bodies[b].name);
    if (scene->n_interfaces > 0 && !scene->has_fracture)
        brc_log(
            context, BRC_LOG_WARNING,
            "interfaces say how bonds break, and the scene has no `fracture`: they decide nothing; add `fracture: {}`");
    BRC_TRY(BRC_ALLOCATE(context, &s, 1, "simulation"));
    s->context = context;
    s->scene = scene;
    s->model = brc_bond_model_of(scene->model.kind);
    s->domain = domain;
    s->device = device;
    BRC_TRY(BRC_ALLOCATE(context, &s->run, 1, "simulation"));
    BRC_TRY(brc_core_create(s));
    BRC_TRY(brc_statics_create(s));
    s->run->stage = -1;
    if (brc_simulation_needs_many_materials(scene, domain) != brc_device_has_many_materials(device))
        return BRC_FAIL(context, BRC_INTERNAL, "the device was opened for %s material, the scene has %s",
                        brc_device_has_many_materials(device) ? "several" : "one",
                        brc_device_has_many_materials(device) ? "one" : "several");
    BRC_TRY(brc_simulation_layout(context, scene, domain, brc_device_slice(device), &s->layout));
    BRC_TRY(BRC_ALLOCATE(context, &s->run->note, scene->n_stages, "stages"));
    BRC_TRY(find_materials(s));
    brc_wants_make(scene, domain, s->layout, device, s->material_of_element, &s->wants);
    s->n_groups = s->wants.n_groups;
    BRC_TRY(share_rows(s));
    BRC_TRY(bring_cells(s));
    if (s->model->create) BRC_TRY(s->model->create(s));
    BRC_TRY(brc_core_passes_make(s));
    BRC_TRY(brc_run_passes_make(s));
    BRC_TRY(brc_geometry_create(s));
    BRC_TRY(brc_simulation_fields_create(s));
    BRC_TRY(brc_effects_create(s));
    if (domain->here) brc_domain_keep_home(domain);
    s->run->setup_seconds = brc_clock_s() - start;
    *out = s;
    s = NULL;
    return BRC_OK;
}

void brc_simulation_free(brc_simulation **simulation)
{
    if (!simulation || !*simulation) return;
    brc_simulation *s = *simulation;
    brc_simulation_fields_free(s);
    brc_effects_free(s);
    if (s->model->free) s->model->free(s);
    brc_look_free(s);
    brc_geometry_free(s);
    brc_core_free(s);
    brc_layout_free(&s->layout);
    brc_memory_free(s->elastic);
    brc_memory_free(s->material_of_element);
    brc_statics_free(s);
    if (s->run) brc_memory_free(s->run->note);
    brc_memory_free(s->run);
    brc_memory_free(s);
    *simulation = NULL;
}

brc_status brc_simulation_observe(brc_simulation *s, const brc_observer *observer)
{
    if (s->run->n_observers == BRC_MOST_OBSERVERS)
        return BRC_FAIL(s->context, BRC_INTERNAL, "more than %d observers", BRC_MOST_OBSERVERS);
    s->run->observers[s->run->n_observers++] = *observer;
    return BRC_OK;
}

static brc_status leave_stage(brc_simulation *s)
{
    if (s->run->stage < 0) return BRC_OK;
    if (brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC) s->run->total_time_before += s->run->time;
    return brc_hook_run(s, BRC_HOOK_LEAVE, NULL);
}

/* The next stage goes by the full law and the present one by the linearised, or the other way round: parts that turned
 * far are strained by one and not by the other. */
static brc_status take_law(brc_simulation *s, const brc_stage *next, const brc_ledger *before)
{
    static const double much = 0.01; /* of the energy; strains alone, of 0.1 % at most where things break, are below */
    static const double rounding = 1e-9; /* of the most that the body ever held */
    const bool was_finite = brc_force_is_finite(s);
    brc_ledger after;
    brc_force_take_law(s, next);
    if (was_finite == brc_force_is_finite(s)) return BRC_OK;
    BRC_TRY(brc_simulation_ledger(s, &after));
    const double most = fmax(after.elastic, before->elastic);
    if (fabs(after.elastic - before->elastic) > much * most && most > rounding * after.peak_elastic)
        brc_log(s->context, BRC_LOG_WARNING,
                "stage '%s' begins with an elastic energy of %.3g J where stage '%s' ended with %.3g J: one of them "
                "has finite_strain: false, and parts of the body turned so far that by the full law they are strained "
                "otherwise; leave finite_strain out, or load less",
                next->name, after.elastic, brc_current_stage(s)->name, before->elastic);
    return BRC_OK;
}

brc_status brc_stage_enter(brc_simulation *s, int32_t stage)
{
    if (stage < 0 || stage >= s->scene->n_stages)
        return BRC_FAIL(s->context, BRC_INTERNAL, "stage %d of %d", (int)stage, (int)s->scene->n_stages);
    const double start = brc_clock_s();
    const brc_stage *next = s->scene->stages + stage;
    brc_ledger before = {0};
    if (s->run->stage >= 0) BRC_TRY(brc_simulation_ledger(s, &before));
    s->run->total_before_stage = before.total;
    if (s->run->stage >= 0)
        BRC_TRY(take_law(s, next, &before));
    else
        brc_force_take_law(s, next);
    BRC_TRY(leave_stage(s));
    s->run->stopped_early = false;
    s->run->stage = -1; /* lists of the next stage are not there yet */
    BRC_TRY(brc_initial_apply(s, next));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ENTER, &(brc_occasion){.stage = next}));
    s->run->stage = stage;
    s->run->step = 0;
    s->run->time = s->run->load_factor = 0;
    s->run->calm_steps = s->run->judged_step = 0;
    if (next->solver == BRC_SOLVER_DYNAMIC) BRC_TRY(brc_time_step_find(s, next, &s->run->time_step));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ENTERED, NULL));
    s->run->setup_seconds += brc_clock_s() - start;
    return BRC_OK;
}

brc_status brc_stage_start(brc_simulation *s)
{
    const double start = brc_clock_s();
    brc_ledger after;
    BRC_TRY(brc_hook_run(s, BRC_HOOK_BEGIN, NULL));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_PLACE, &(brc_occasion){.t = 0}));
    BRC_TRY(brc_force_refresh(s)); /* the search for the time step has evaluated other motions */
    BRC_TRY(brc_hook_run(s, BRC_HOOK_RESTART, NULL));
    BRC_TRY(brc_force_of_state(s, BRC_BOOK_START));
    BRC_TRY(brc_simulation_ledger(s, &after));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_STARTED, &(brc_occasion){.ledger = &after}));
    const double begins = after.total - s->run->total_before_stage; /* initial fields, and what changed supports hold */
    if (brc_statics_go_on(s))
        brc_statics_change(s, begins);
    else
        s->run->initial_energy += begins;
    s->run->setup_seconds += brc_clock_s() - start;
    return BRC_OK;
}

brc_status brc_simulation_renew(brc_simulation *s)
{
    if (!s->model->renew || s->scene->has_fracture || s->scene->has_contact)
        return BRC_FAIL(s->context, BRC_INTERNAL, "a simulation that cannot be renewed");
    BRC_TRY(leave_stage(s));
    s->run->stage = -1;
    BRC_TRY(s->model->renew(s));
    BRC_TRY(brc_buffer_fill_zero(brc_displacement_of(s)));
    BRC_TRY(brc_buffer_fill_zero(brc_velocity_of(s)));
    if (brc_spin_of(s)) BRC_TRY(brc_buffer_fill_zero(brc_spin_of(s)));
    return brc_simulation_set_upright(s);
}

brc_status brc_simulation_begin_stage(brc_simulation *s, int32_t stage)
{
    BRC_TRY(brc_stage_enter(s, stage));
    return brc_stage_start(s);
}

brc_status brc_simulation_find_time_step(brc_simulation *s, int32_t stage, brc_time_step *out)
{
    BRC_TRY(brc_simulation_begin_stage(s, stage));
    if (brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC)
        *out = s->run->time_step;
    else
        *out = (brc_time_step){.governed_by = "no time step: not a dynamic stage"};
    return BRC_OK;
}

brc_status brc_simulation_advance(brc_simulation *s, int64_t n_steps)
{
    const double start = brc_clock_s();
    const brc_status status = brc_dynamics_advance(s, n_steps);
    s->run->step_seconds += brc_clock_s() - start;
    return status;
}

brc_status brc_simulation_wait(brc_simulation *s)
{
    return brc_device_wait(s->device);
}
