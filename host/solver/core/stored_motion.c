/* The clock, what is counted over the whole run, and the arrays of the elements, number by number, for a store. */
#include "simulation_internal.h"
#include "state_store.h"

brc_status brc_store_clock(brc_simulation *s, brc_state_store *store)
{
    brc_time_step *dt = &s->time_step;
    const struct {
        const char *name;
        double *value;
    } numbers[] = {{"time", &s->time},
                   {"total_time_before", &s->total_time_before},
                   {"load_factor", &s->load_factor},
                   {"time_step.value", &dt->value},
                   {"time_step.critical", &dt->critical},
                   {"time_step.published", &dt->published},
                   {"time_step.safety", &dt->safety},
                   {"work_before", &s->work_before},
                   {"damping_before", &s->damping_before},
                   {"numerical_before", &s->numerical_before},
                   {"initial_energy", &s->initial_energy},
                   {"peak_elastic", &s->peak_elastic},
                   {"peak_kinetic", &s->peak_kinetic},
                   {"total_before_stage", &s->total_before_stage},
                   {"released", &s->released},
                   {"static.residual", &s->static_report.residual},
                   {"events.margin", &s->progress.margin},
                   {"events.largest_load", &s->progress.largest_load},
                   {"regime.peak_elastic", &s->regime.peak_elastic}},
      ratios[] = {{"regime.at_first_break", &s->regime.at_first_break},
                  {"regime.at_peak", &s->regime.at_peak},
                  {"regime.until_peak", &s->regime.until_peak},
                  {"regime.last", &s->regime.last},
                  {"regime.most", &s->regime.most}}; /* none before something is strained */
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        BRC_TRY(brc_store_double(store, numbers[k].name, numbers[k].value));
    for (size_t k = 0; k < sizeof ratios / sizeof *ratios; ++k)
        BRC_TRY(brc_store_sample(store, ratios[k].name, ratios[k].value));
    const struct {
        const char *name;
        int64_t *value;
    } counts[] = {{"step", &s->step},
                  {"total_steps", &s->total_steps},
                  {"calm_steps", &s->progress.calm_steps},
                  {"judged_step", &s->progress.judged_step},
                  {"static.iterations", &s->static_report.iterations},
                  {"static.corrections", &s->static_report.corrections}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        BRC_TRY(brc_store_integer(store, counts[k].name, counts[k].value));
    return brc_store_flag(store, "regime.broke", &s->regime.broke);
}

/* Displacement gradients and stresses of dlsm follow from the displacements; the strains of dlsm-published do so only
 * to rounding, since the half kick that closes a batch normalises its orientations once more. */
brc_status brc_store_elements(brc_simulation *s, brc_state_store *store)
{
    return brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_state_fields, .owner = s});
}

brc_status brc_simulation_walk_motion(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(brc_store_clock(s, store));
    BRC_TRY(brc_store_elements(s, store));
    return brc_hook_run(s, BRC_HOOK_STRETCH, &(brc_occasion){.store = store});
}
