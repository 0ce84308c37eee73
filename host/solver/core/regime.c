#include "regime.h"
#include <math.h>

void brc_regime_follow(brc_regime *r, double kinetic, double elastic, bool broken)
{
    const double ratio = elastic > 0 ? kinetic / elastic : NAN;
    if (broken && !r->broke) {
        r->broke = true;
        r->at_first_break = r->most = r->until_peak = r->peak_elastic > 0 ? r->last : ratio;
    }
    if (r->broke) r->most = fmax(r->most, ratio); /* of a number and NAN this is the number */
    if (elastic > r->peak_elastic) {
        r->peak_elastic = elastic;
        r->at_peak = ratio;
        r->until_peak = r->most;
    }
    r->last = ratio;
}

const char *brc_regime_name(const brc_regime *r)
{
    if (!r->broke) return "";
    return fmax(r->until_peak, r->at_peak) <= BRC_QUASI_STATIC ? "quasi-static" : "dynamic";
}
