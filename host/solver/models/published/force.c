/* Forces and energies of dlsm-published: the order of its passes (docs/notebook/theory.md T3). */
#include "../../core/awake.h"
#include "../../effects/loads/loads.h"
#include "published_internal.h"

brc_status brc_published_evaluate(brc_simulation *s, const brc_force_request *r)
{
    const brc_ring_list *list = brc_request_list(r);
    if (s->fracture)
        BRC_TRY(brc_published_breaks_strains(s, r));
    else
        BRC_TRY(brc_pass_run_awake(s, brc_published_own_of(s)->strain, s->n_groups, r, NULL));
    if (brc_cell_breaks_by_bond(s) && !r->homogeneous) return brc_published_breaks_force(s, r);
    return brc_pass_over(s, brc_published_own_of(s)->force, brc_published_own_of(s)->force_listed, list, 2, r, NULL);
}

brc_status brc_published_tractions(brc_simulation *s, const brc_force_request *r)
{
    return brc_traction_forces_run(s, brc_published_own_of(s)->traction, r);
}

brc_status brc_published_replace_around(brc_simulation *s, const brc_rings *rings)
{
    return brc_rings_replace(s, rings, 2, 2);
}

/* Energies of the elements, brc_elastic_energy_of(s). */
static brc_status element_energies(brc_simulation *s, const brc_ring_list *list, int ring)
{
    return brc_pass_over(s, brc_published_own_of(s)->energy, brc_published_own_of(s)->energy_listed, list, ring, NULL,
                         NULL);
}

/* Rings 0 and 1 have other strains. */
brc_status brc_published_energy_around(brc_simulation *s, const brc_rings *rings, bool found, double part[4])
{
    const brc_ring_list *list = brc_rings_around(rings);
    const int ring = found ? 2 : 1;
    part[1] = part[2] = part[3] = 0;
    BRC_TRY(element_energies(s, list, ring));
    BRC_TRY(brc_rings_sum(s, list, ring, brc_elastic_energy_of(s), &part[0]));
    if (!found) return BRC_OK;
    return brc_rings_sum(s, list, 0, brc_elastic_energy_of(s), &part[1]); /* counted when they were found */
}

brc_status brc_published_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    *stabilisation = 0;
    BRC_TRY(element_energies(s, NULL, 0));
    return brc_vector_sum(s, brc_elastic_energy_of(s), s->layout->n_rows, elastic);
}
