#include "planned_output.h"
#include <math.h>

/* Samples of a dynamic stage where the scene does not say. */
enum { SAMPLES = 500 };

int64_t brc_planned_samples(const brc_scene *scene, int32_t index, int64_t planned)
{
    const brc_stage *stage = &scene->stages[index];
    if (stage->solver != BRC_SOLVER_DYNAMIC)
        return planned + (stage->most_events > 0 ? 2 : 1 + (stage->to_failure > 0));
    const int64_t every =
        scene->output.history_every > 0 ? scene->output.history_every : (planned + SAMPLES - 1) / SAMPLES;
    return every > 0 ? 1 + (planned + every - 1) / every : 1;
}

int64_t brc_planned_frames(const brc_scene *scene, int32_t index, int64_t planned, double time_step)
{
    const brc_stage *stage = &scene->stages[index];
    const brc_output *output = &scene->output;
    int64_t every = 0;
    if (output->n_frames < 0) return 0;
    if (planned < 1) return 1;
    if (stage->solver == BRC_SOLVER_DYNAMIC) {
        every = output->n_frames > 0         ? planned / output->n_frames
                : output->frame_interval > 0 ? (int64_t)llround(output->frame_interval / time_step)
                                             : 0;
        if (every < 1 && (output->n_frames > 0 || output->frame_interval > 0)) every = 1;
    } else if (stage->most_events > 0 && output->n_frames > 0) {
        every = (stage->most_events + output->n_frames - 1) / output->n_frames;
    }
    return every > 0 ? 1 + (planned - 1) / every : 1;
}
