/* The clock and what is counted over the whole run, number by number, for a store. */
#include "run_internal.h"

brc_status brc_store_clock(brc_simulation *s, brc_state_store *store)
{
    struct brc_run *run = s->run;
    brc_time_step *dt = &run->time_step;
    const struct {
        const char *name;
        double *value;
    } numbers[] = {{"time", &run->time},
                   {"total_time_before", &run->total_time_before},
                   {"load_factor", &run->load_factor},
                   {"time_step.value", &dt->value},
                   {"time_step.critical", &dt->critical},
                   {"time_step.published", &dt->published},
                   {"time_step.safety", &dt->safety},
                   {"damping_before", &run->damping_before},
                   {"numerical_before", &run->numerical_before},
                   {"initial_energy", &run->initial_energy},
                   {"peak_elastic", &run->peak_elastic},
                   {"peak_kinetic", &run->peak_kinetic},
                   {"total_before_stage", &run->total_before_stage},
                   {"regime.peak_elastic", &run->regime.peak_elastic}},
      ratios[] = {{"regime.at_first_break", &run->regime.at_first_break},
                  {"regime.at_peak", &run->regime.at_peak},
                  {"regime.until_peak", &run->regime.until_peak},
                  {"regime.last", &run->regime.last},
                  {"regime.most", &run->regime.most}}; /* none before something is strained */
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        BRC_TRY(brc_store_double(store, numbers[k].name, numbers[k].value));
    for (size_t k = 0; k < sizeof ratios / sizeof *ratios; ++k)
        BRC_TRY(brc_store_sample(store, ratios[k].name, ratios[k].value));
    const struct {
        const char *name;
        int64_t *value;
    } counts[] = {{"step", &run->step},
                  {"total_steps", &run->total_steps},
                  {"calm_steps", &run->calm_steps},
                  {"judged_step", &run->judged_step}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        BRC_TRY(brc_store_integer(store, counts[k].name, counts[k].value));
    return brc_store_flag(store, "regime.broke", &run->regime.broke);
}

brc_status brc_simulation_walk_motion(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(brc_store_clock(s, store));
    BRC_TRY(brc_store_elements(s, store));
    return brc_hook_run(s, BRC_HOOK_STRETCH, &(brc_occasion){.store = store});
}
