#include "stop.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

bool brc_stop_after_peak(const brc_scene *scene, const brc_history *history, bool broke, char *reason, size_t room)
{
    const int64_t last = history->n_samples - 1;
    if (last < 0 || !broke) return false;
    const int32_t now = history->stage[last];
    const brc_stage *stage = &scene->stages[now];
    int32_t sensor = 0;
    double most = 0;
    if (stage->stop_sensor[0] == '\0') return false;
    while (sensor < scene->n_sensors && strcmp(scene->sensors[sensor].name, stage->stop_sensor) != 0)
        ++sensor;
    if (sensor == scene->n_sensors) return false;
    for (int64_t k = last; k >= 0 && history->stage[k] == now; --k)
        most = fmax(most, fabs(history->value[k * history->n_sensors + sensor]));
    const double value = fabs(history->value[last * history->n_sensors + sensor]);
    if (!(value < stage->stop_share * most)) return false;
    snprintf(reason, room, "stop_after_peak: %s fell to %.3g %% of its largest value, below %.4g %%",
             stage->stop_sensor, 100 * value / most, 100 * stage->stop_share);
    return true;
}
