#include "price_work.h"
#include <math.h>

/* Iterations of a solve in units of elements across, and with multigrid, which bodies of so many elements across have
 * (500 elements: host/solver/statics/multigrid). */
static const double iterations_across = 5, multigrid_iterations = 40, multigrid_across = 8,
                    solves_per_finite_increment = 3;
/* Measured in units of a bond update of a dynamic step: a round of modes for each bond and mode (rounds themselves do
 * not grow with the modes), a cell of a sweep of Lloyd or of the tessellation, a packed sphere; and how much longer a
 * step gets where surfaces touch. */
static const double mode_of_round = 10, swept_cell = 200, packed_sphere = 2000, touching = 3;

bool brc_price_iterations_grow(const brc_stage *stage, double across)
{
    return stage->solver == BRC_SOLVER_DYNAMIC || stage->preconditioner == BRC_PRECONDITIONER_BLOCKS ||
           (stage->preconditioner == BRC_PRECONDITIONER_AUTO && across < multigrid_across);
}

double brc_price_iterations(const brc_stage *stage, double across)
{
    return (brc_price_iterations_grow(stage, across) ? iterations_across * across : multigrid_iterations) *
           (stage->solver == BRC_SOLVER_MODES ? stage->n_modes
            : stage->finite_strain            ? solves_per_finite_increment
                                              : 1);
}

static double building(const brc_scene *scene, double n_elements)
{
    double most = 0;
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        const brc_fill *fill = &scene->bodies[b].fill;
        most = fmax(most, fill->kind == BRC_FILL_PACKING ? packed_sphere : swept_cell * (1 + fill->lloyd_sweeps));
    }
    return most * n_elements;
}

double brc_price_work(const brc_scene *scene, const brc_setup *setup, const brc_trial *trial)
{
    const double n_bonds = (double)brc_setup_n_bonds(setup), across = brc_setup_across(setup);
    double work = building(scene, (double)brc_setup_n_elements(setup));
    for (int32_t k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        const double planned = (double)trial->stages[k].planned;
        if (stage->solver == BRC_SOLVER_DYNAMIC)
            work += planned * n_bonds * (scene->has_contact ? touching : 1);
        else if (stage->solver == BRC_SOLVER_MODES)
            work += brc_price_iterations(stage, across) * mode_of_round * n_bonds;
        else
            work += fmax(1, planned) * brc_price_iterations(stage, across) * n_bonds;
    }
    return work;
}
