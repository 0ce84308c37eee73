/* How strong every bond is: its materials, the interface it lies in, and the scatter drawn for it. Made once at the
 * start of scenes with `fracture`; the same whatever the device, the order of storage and the number of threads, since
 * a draw depends on the seed of the scene and on the ids of the bond's two elements only.
 *
 * The weaker side of a bond is the material with the smaller strength (tension, or beam: {strength} of beams; none is
 * the strongest), of equal ones that with the smaller fracture energy, then the one listed first. Strength, fracture
 * energy and scatter of the bond are that side's. Draws p are uniform in (0, 1). Factors of a Weibull scatter are
 * (-ln(1 - p) V_0 / V)^(1/m), V the volume of the bond: S L / 3 of cells (the two pyramids over the face), for spheres
 * an equal part, over its bonds, of the volume of each of its elements with the pores. */
#ifndef BRC_SOLVER_STRENGTHS_H
#define BRC_SOLVER_STRENGTHS_H

#include "../../../../preprocess/domain/domain.h"
#include "../../../scene/scene.h"

typedef struct brc_strengths {
    double *tension; /* [n_bonds] normal stress at which the bond fails: the weaker side's strength, or its interface's,
                        times factor; 0: none [Pa] */
    double *energy;  /* [n_bonds] G_c of a crack through it; 0: it breaks at once [J/m^2] */
    double *shear_energy; /* [n_bonds] G_II, in the same ratio to the energy as in the weaker side's material [J/m^2] */
    double *factor; /* [n_bonds] what scatter and interface make of the strength of the weaker side [-]; for criteria of
                       elements */
    uint8_t *joint; /* [n_bonds] 1: it lies in an interface */
    bool softens;   /* some energy is above 0 */
    uint8_t *exponential; /* [n_bonds] with an energy: 1: the softening is exponential, 0: linear */
} brc_strengths;

/* material: [n_elements] index into scene->materials. Refuses (BRC_BAD_INPUT) files that cannot be read or name no bond
 * of the domain, with line and column, and an interface of given tension at materials without, where the criterion is
 * one of elements. Interfaces without a bond warn. The caller frees with brc_strengths_free. */
brc_status brc_strengths_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                const int32_t *material, brc_strengths *out);
void brc_strengths_free(brc_strengths *strengths);
/* Without a draw or a file: is some bond scattered or of an interface that changes its strength; has some bond a
 * fracture energy? */
void brc_strengths_ask(const brc_scene *scene, const brc_domain *domain, const int32_t *material, bool *weighted,
                       bool *softens);

/* Volume of a bond as the scatter sees it [m^3]. */
double brc_strengths_volume(const brc_domain *domain, int64_t bond);

#endif
