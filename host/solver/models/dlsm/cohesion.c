/* Cohesion of cells: faces that open (cell_softening.c) and broken ones that are closed (closed_faces.c), at the breaks
 * of a step. */
#include "brittle_interfaces.h"
#include "cell_softening.h"
#include "closed_faces.h"
#include "dlsm_internal.h"

static brc_status create(brc_simulation *s, const brc_strengths *strengths)
{
    BRC_TRY(brc_softening_create(s, strengths));
    return brc_closed_faces_create(s);
}

static void release(brc_simulation *s)
{
    brc_softening_free(s);
    brc_closed_faces_free(s);
    brc_brittle_interfaces_free(s);
}

static brc_status store(brc_simulation *s, brc_state_store *to, const brc_chosen *bonds)
{
    BRC_TRY(brc_closed_faces_store_state(s, to, bonds));
    return brc_softening_store_state(s, to);
}

static brc_status store_ahead(brc_simulation *s, brc_state_store *to)
{
    return brc_closed_faces_store_state(s, to, NULL);
}

static brc_status after_breaks(brc_simulation *s)
{
    BRC_TRY(brc_softening_recount(s));
    return brc_closed_faces_probe(s);
}

const brc_model_cohesion brc_dlsm_cohesion = {.is_on = brc_softening_is_on,
                                              .create = create,
                                              .free = release,
                                              .report = brc_softening_find_report,
                                              .store = store,
                                              .step = brc_softening_step,
                                              .before_breaks = brc_closed_faces_keep,
                                              .after_breaks = after_breaks,
                                              .change = brc_closed_faces_change,
                                              .refresh = brc_softening_refresh,
                                              .settle = brc_softening_settle,
                                              .stored = brc_closed_faces_stored,
                                              .store_ahead = store_ahead};
