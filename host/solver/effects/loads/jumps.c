/* Motions that begin elsewhere than what they move stands: all of the way is gone in the first step, as a shock. */
#include "loads_internal.h"
#include <math.h>

static const double told = 1e-5; /* strain of a cell that is told of: a tenth of what breaks the most brittle solids */

double brc_load_jump(const brc_load *load, const double direction[3], const double now[3])
{
    const double factor = brc_load_factor(load, 0, false);
    double most = 0;
    for (int c = 0; c < 3; ++c)
        if (load->component[c]) most = fmax(most, fabs(factor * direction[c] - now[c]));
    return most;
}

static void tell(const brc_simulation *s, const brc_load *load, double jump)
{
    const double size = s->domain->quality.mean_spacing;
    const char *what = load->kind == BRC_LOAD_FACE_DISPLACEMENT ? "face" : "element";
    if (!(jump > told * size)) return;
    brc_log(s->context, BRC_LOG_WARNING,
            "stage '%s': %s_displacement begins up to %.3g m from where '%s' stands, and all of that is gone in the "
            "first step (a strain of %.2g across an element): let it grow from there by a `table`, or hold what is "
            "there with `%s_velocity: {set: %s, x: 0}`",
            brc_current_stage(s)->name, what, jump, load->set, jump / size, what, load->set);
}

brc_status brc_loads_tell_jumps(brc_simulation *s)
{
    const brc_stage *stage = brc_current_stage(s);
    if (stage->solver != BRC_SOLVER_DYNAMIC) return BRC_OK;
    for (int32_t k = 0; k < s->loads->held.n_loads; ++k)
        tell(s, stage->loads + s->loads->held.loads[k].load, s->loads->held.loads[k].jump);
    for (int32_t k = 0; k < s->loads->n_prescribed; ++k)
        if (s->loads->prescribed[k].load >= 0)
            tell(s, stage->loads + s->loads->prescribed[k].load, s->loads->prescribed[k].jump);
    return BRC_OK;
}
