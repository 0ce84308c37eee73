#include "stage_end.h"
#include "run_internal.h"
#include <stdio.h>

void brc_simulation_end_stage(brc_simulation *s, const char *reason)
{
    brc_stage_note *note = &s->run->note[s->run->stage];
    if (note->ended) return;
    note->ended = true;
    snprintf(note->reason, sizeof note->reason, "%s", reason);
    brc_log(s->context, BRC_LOG_INFO, "stage '%s' ends at step %lld: %s", brc_current_stage(s)->name,
            (long long)s->run->step, reason);
}

const char *brc_simulation_stage_reason(const brc_simulation *s, int32_t stage)
{
    return stage >= 0 && stage < s->scene->n_stages ? s->run->note[stage].reason : "";
}
