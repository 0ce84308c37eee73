/* Micro-parameters of model cbm corrected on a sample: the laws hold for the mean of many samples, a sample of its own
 * differs by a percent or so. */
#ifndef BRC_SOLVER_BEAM_POLISH_H
#define BRC_SOLVER_BEAM_POLISH_H

#include "../../device/device.h"
#include "../../scene/scene.h"
#include "beam_body.h"

/* Samples a material is tried on: boxes of spheres with their six walls, packed alike. */
typedef struct brc_polish_request {
    int n_samples;
    const brc_domain *const *samples;    /* [n_samples] borrowed */
    int n_axes;                          /* axes each is pulled along, from x on: 1, 2 or 3 */
    const brc_beam_body *body;           /* what the beams are for; NULL: the first sample */
    double poisson, young, beam_poisson; /* nu [-], E [Pa] of the material; nu_m [-] */
} brc_polish_request;

typedef struct brc_polish {
    double radius, beam_young;         /* r_m [-], E_m [Pa] */
    double law_radius, law_beam_young; /* what the law gave */
    double law_poisson,
        law_young;  /* nu [-], E [Pa] of the samples with these, as far as they are off the law carried to the body */
    double poisson; /* the same with the polished ones [-]; E is `young` exactly */
    int n_tests;    /* each pulls every sample along all axes */
    double seconds;
} brc_polish;

/* Start from the law for the body and the spread of the samples' radii, follow the secant of nu in r_m for at most
 * three tests, until nu is within 5e-4 of `poisson` (relative); E_m scales. nu and E of a test are means over samples
 * and axes; the body has what the law says of it and what the samples have beyond what it says of them: a difference of
 * nu, a factor of E. BRC_BAD_INPUT as brc_beam_law_invert and brc_beam_sample_pull. */
brc_status brc_beam_polish(brc_context *context, brc_device *device, const brc_polish_request *request,
                           brc_polish *out);

/* Give every material of the scene that its cbm bodies use, and that has no beams of its own, polished ones: on the
 * domain itself where the scene is one packed box of one material, not turned and without cracks, else on four cubes
 * packed as the body is (coordination, radii, the body's seed and the next ones; at most 10 000 spheres each).
 * BRC_BAD_INPUT too: bodies of points, files or different packings that share a material. Says what it did in the
 * log. */
brc_status brc_beam_polish_scene(brc_context *context, brc_scene *scene, const brc_domain *domain, int n_threads);

#endif
