#include "peer_bar.h"
#include "../host/base/memory.h"
#include <math.h>

static brc_peer_sample sample_of(const brc_domain *d, double density, const double *velocity, int64_t step)
{
    brc_peer_sample sample = {.step = step};
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *v = &velocity[3 * e], mass = density * d->volume[e];
        sample.momentum += mass * v[0] * cos(M_PI * d->position[3 * e]);
        sample.kinetic += 0.5 * mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sample;
}

brc_status brc_peer_bar_follow(brc_context *context, brc_simulation *simulation, double density, int64_t steps,
                               int64_t every, brc_peer_result *out)
{
    const brc_domain *d = brc_simulation_domain(simulation);
    double *velocity = NULL;
    brc_status status = BRC_OK;
    out->n_samples = 0;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &velocity, 3 * d->n_elements, "velocities"));
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&out->samples, steps / every + 1, sizeof *out->samples,
                                          "samples of the bar"));
    for (int64_t step = 0; step <= steps; step += every) {
        if (step > 0) BRC_TRY_OR(cleanup, brc_simulation_advance(simulation, every));
        BRC_TRY_OR(cleanup, brc_simulation_velocity(simulation, velocity));
        out->samples[out->n_samples++] = sample_of(d, density, velocity, step);
    }
cleanup:
    brc_memory_free(velocity);
    return status;
}

double brc_peer_bar_frequency(const brc_peer_result *result, double time_step)
{
    double first = NAN, last = NAN;
    int n = 0;
    for (int64_t k = 1; k < result->n_samples; ++k) {
        const brc_peer_sample a = result->samples[k - 1], b = result->samples[k];
        if ((a.momentum < 0) == (b.momentum < 0)) continue;
        last = time_step * ((double)a.step + (double)(b.step - a.step) * a.momentum / (a.momentum - b.momentum));
        if (n++ == 0) first = last;
    }
    return n < 2 ? NAN : 0.5 * (n - 1) / (last - first);
}

double brc_peer_bar_difference(const brc_peer_result *ours, const brc_peer_result *theirs)
{
    double largest = NAN;
    for (int64_t j = 0, k = 0; j < ours->n_samples && k < theirs->n_samples;) {
        const brc_peer_sample a = ours->samples[j], b = theirs->samples[k];
        if (a.step == b.step) largest = fmax(largest, fabs(a.kinetic - b.kinetic) / ours->samples[0].kinetic);
        j += a.step <= b.step;
        k += b.step <= a.step;
    }
    return largest;
}
