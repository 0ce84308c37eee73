/* The clock of a simulation: stage, step, time, load factor. */
#include "run_internal.h"

const brc_stage *brc_current_stage(const brc_simulation *s)
{
    return &s->scene->stages[s->run->stage];
}

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

bool brc_half_kick_is_missing(const brc_simulation *s)
{
    return s->run->open;
}
void brc_half_kick_missing(brc_simulation *s, bool missing)
{
    s->run->open = missing;
}

bool brc_stage_has_ended(const brc_simulation *s)
{
    return s->run->note[s->run->stage].ended;
}

int32_t brc_simulation_stage(const brc_simulation *s)
{
    return s->run->stage;
}

int64_t brc_simulation_step(const brc_simulation *s)
{
    return s->run->step;
}

int64_t brc_simulation_total_steps(const brc_simulation *s)
{
    return s->run->total_steps;
}

double brc_simulation_setup_seconds(const brc_simulation *s)
{
    return s->run->setup_seconds;
}

double brc_simulation_step_seconds(const brc_simulation *s)
{
    return s->run->step_seconds;
}

brc_time_step brc_simulation_time_step(const brc_simulation *s)
{
    return s->run->time_step;
}

double brc_simulation_time(const brc_simulation *s)
{
    return s->run->stage >= 0 && brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC ? s->run->load_factor
                                                                                    : s->run->time;
}

double brc_simulation_total_time(const brc_simulation *s)
{
    return s->run->total_time_before + s->run->time;
}

brc_regime brc_simulation_regime(const brc_simulation *s)
{
    return s->run->regime;
}
