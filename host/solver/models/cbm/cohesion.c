/* Cohesion of beams: those that open (beam_softening.c) and broken ones whose ends bear (beam_closure.c). */
#include "beam_alone.h"
#include "beam_bridges.h"
#include "beam_closure.h"
#include "beam_softening.h"
#include "cbm_internal.h"

static void release(brc_simulation *s)
{
    brc_beam_softening_free(s);
    brc_beam_closure_free(s);
    brc_beam_alone_free(s);
    brc_beam_bridges_free(s);
}

static brc_status store(brc_simulation *s, brc_state_store *to, const brc_chosen *bonds)
{
    (void)bonds;
    BRC_TRY(brc_beam_softening_store_state(s, to));
    return brc_beam_closure_store_state(s, to);
}

static brc_status report(brc_simulation *s, brc_softening_report *out)
{
    return brc_beam_softening_is_on(s) ? brc_beam_softening_report(s, out) : BRC_OK;
}

const brc_model_cohesion brc_cbm_cohesion = {.is_on = brc_beam_softening_is_on,
                                             .create = brc_beam_softening_create,
                                             .free = release,
                                             .report = report,
                                             .store = store,
                                             .store_ahead = brc_beam_closure_store_state};
