/* Forces and energies of cbm: the order of its passes (docs/notebook/beams.md). */
#include "beam_closure.h"
#include "beam_softening.h"
#include "../../core/awake.h"
#include "../../effects/fracture/breaking.h"
#include "cbm_internal.h"

brc_status brc_cbm_evaluate(brc_simulation *s, const brc_force_request *r)
{
    if (s->fracture && !r->homogeneous) return brc_cbm_breaking_force(s, r);
    return brc_pass_run_awake(s, brc_cbm_own_of(s)->force, s->n_groups, r, NULL);
}

brc_status brc_cbm_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    *stabilisation = 0;
    BRC_TRY(brc_pass_run(brc_cbm_own_of(s)->energy, s->n_groups));
    BRC_TRY(brc_beam_softening_energy(s));
    BRC_TRY(brc_beam_closure_energy(s));
    return brc_vector_sum(s, brc_elastic_energy_of(s), s->layout->n_rows, elastic);
}
