/* The numbers that a scene may limit, as one table. Needs nothing but the structs, so that the reader of scenes can ask
 * for the names alone. */
#include "quality.h"

#include <math.h>

#define VALUE(name, expression)                                                                                        \
    static double name(const brc_domain *domain, const brc_isotropy *isotropy)                                         \
    {                                                                                                                  \
        (void)domain;                                                                                                  \
        (void)isotropy;                                                                                                \
        return (expression);                                                                                           \
    }
VALUE(volume_error, fabs(domain->quality.volume_error))
VALUE(duplicates, (double)domain->quality.n_seeds_duplicate)
VALUE(lost, (double)domain->quality.n_seeds_lost)
VALUE(tiny_faces, (double)domain->quality.n_tiny_faces_dropped)
VALUE(tiny_face_area, domain->quality.tiny_face_area_fraction)
VALUE(closure, domain->quality.closure_worst)
VALUE(twin_area, domain->quality.twin_area_worst)
VALUE(smallest_distance, domain->quality.smallest_distance / domain->quality.mean_spacing)
VALUE(support, domain->quality.support_smallest)
VALUE(pieces, domain->quality.n_pieces < 0 ? NAN : (double)domain->quality.n_pieces)
VALUE(unbonded, (double)domain->quality.n_elements_without_bond)
VALUE(anisotropy_fabric, isotropy->fabric_anisotropy)
VALUE(anisotropy_worst_bin, isotropy->worst_bin)
VALUE(anisotropy_rms, isotropy->rms_bin)
VALUE(anisotropy_excess, isotropy->excess)
VALUE(anisotropy_cubic, fabs(isotropy->cubic))

static double coordination_least(const brc_domain *domain, const brc_isotropy *isotropy)
{
    (void)isotropy;
    int k = 0;
    while (k < 63 && domain->quality.coordination_histogram[k] == 0)
        ++k;
    return k;
}

#define RELAX "use a few `lloyd` sweeps, or another seed"
#define MORE_BONDS "use another seed or, with `beams`, a larger coordination"
#define DIRECTIONS "use a spread of 90 % or a packing, and more elements: few bonds are uneven by chance"
static const brc_quality_number numbers[] = {
    /* name, meaning, unit, less is worse, of cells, of spheres, of directions, cure, value */
    {"volume_error", "volume of all cells against the shape's: the size of the relative difference", "-", false, true,
     false, false, "use more elements", volume_error},
    {"duplicates", "seeds dropped because they were too near to an earlier one", "", false, true, true, false,
     "use a smaller `min_distance`, another seed, or points without doubles", duplicates},
    {"lost", "seeds that got no cell", "", false, true, false, false, "use another seed", lost},
    {"tiny_faces", "faces below `tiny_face_threshold`, which were dropped", "", false, true, false, false, RELAX,
     tiny_faces},
    {"tiny_face_area", "area of the dropped faces over the area of all", "-", false, true, false, false, RELAX,
     tiny_face_area},
    {"closure", "worst cell: size of the sum of its area vectors over its surface", "-", false, true, false, false,
     RELAX, closure},
    {"twin_area", "worst difference of a face's area seen from its two sides, over the mean area", "-", false, true,
     false, false, RELAX, twin_area},
    {"smallest_distance", "shortest branch over the mean spacing", "-", true, true, true, false,
     "use a few `lloyd` sweeps or a larger `min_distance`", smallest_distance},
    {"support",
     "worst cell: smallest eigenvalue of its least-squares matrix A/(2V); 0.5 for the corner of a grid of cubes", "-",
     true, true, false, false, RELAX ", or a smaller spread", support},
    {"coordination_least", "least number of bonds of an element", "", true, true, true, false, MORE_BONDS,
     coordination_least},
    {"pieces", "parts of the body that no bond joins to each other", "", false, true, true, false,
     MORE_BONDS ", or shorten cracks that cut through", pieces},
    {"unbonded", "elements without any bond", "", false, true, true, false, MORE_BONDS, unbonded},
    {"anisotropy_fabric", "anisotropy of the fabric tensor of bond directions", "-", false, true, true, true,
     DIRECTIONS, anisotropy_fabric},
    {"anisotropy_worst_bin", "largest relative deviation of a bin of bond directions (162 bins) from the mean", "-",
     false, true, true, true, DIRECTIONS, anisotropy_worst_bin},
    {"anisotropy_rms", "root mean square of the relative deviations of the bins of bond directions (162 bins)", "-",
     false, true, true, true, DIRECTIONS, anisotropy_rms},
    {"anisotropy_excess", "the part of anisotropy_rms that the number of bonds does not explain", "-", false, true,
     true, true, DIRECTIONS, anisotropy_excess},
    {"anisotropy_cubic", "order that a grid leaves in the bond directions, which the fabric tensor cannot see", "-",
     false, true, true, true, DIRECTIONS, anisotropy_cubic},
};
const brc_quality_number *brc_quality_numbers(int32_t *n)
{
    *n = (int32_t)(sizeof numbers / sizeof *numbers);
    return numbers;
}
