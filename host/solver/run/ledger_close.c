/* What a ledger's terms come to. */
#include "../simulation.h"
#include <math.h>

void brc_ledger_close(brc_ledger *l)
{
    l->total = l->kinetic + l->elastic + l->stabilisation + l->potential + l->contact;
    const double scale = fmax(l->peak_elastic, fmax(fabs(l->initial), fabs(l->work)));
    const double error =
        l->total - l->work + l->damping + l->numerical + l->fracture + l->friction + l->impact - l->initial;
    l->closure = scale > 0 ? error / scale : 0;
    if (!isfinite(l->total)) l->closure = NAN;
}
