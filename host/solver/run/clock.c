/* The clock of a simulation: stage, step, time, load factor. */
#include "run_internal.h"

BRC_READ(const brc_stage *, brc_current_stage, &s->scene->stages[s->run->stage])

double brc_loads_time(const brc_simulation *s)
{
    const bool is_static = s->run->stage >= 0 && brc_current_stage(s)->solver == BRC_SOLVER_STATIC;
    return is_static ? s->run->load_factor : s->run->time;
}

void brc_clock_set_step(brc_simulation *s, int64_t step)
{
    s->run->step = step;
}
void brc_clock_set_load(brc_simulation *s, double factor)
{
    s->run->load_factor = factor;
}

BRC_READ(bool, brc_half_kick_is_missing, s->run->open)
void brc_half_kick_missing(brc_simulation *s, bool missing)
{
    s->run->open = missing;
}

BRC_READ(bool, brc_stage_has_ended, s->run->note[s->run->stage].ended)
BRC_READ(int32_t, brc_simulation_stage, s->run->stage)
BRC_READ(int64_t, brc_simulation_step, s->run->step)
BRC_READ(int64_t, brc_simulation_total_steps, s->run->total_steps)
BRC_READ(double, brc_simulation_setup_seconds, s->run->setup_seconds)
BRC_READ(double, brc_simulation_step_seconds, s->run->step_seconds)
BRC_READ(brc_time_step, brc_simulation_time_step, s->run->time_step)
BRC_READ(bool, brc_simulation_conserves, s->model->conserves)

double brc_simulation_time(const brc_simulation *s)
{
    return s->run->stage >= 0 && brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC ? s->run->load_factor
                                                                                    : s->run->time;
}

BRC_READ(double, brc_simulation_total_time, s->run->total_time_before + s->run->time)
BRC_READ(brc_regime, brc_simulation_regime, s->run->regime)
