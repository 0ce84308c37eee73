/* Micro-parameters of model cbm corrected on a sample: the laws hold for the mean of many samples, a sample of its own differs by a percent or so. */
#ifndef BRC_SOLVER_BEAM_POLISH_H
#define BRC_SOLVER_BEAM_POLISH_H

#include "../../preprocess/domain.h"
#include "../device/device.h"
#include "../scene/scene.h"

typedef struct brc_polish {
    double radius, beam_young; /* r_m [-], E_m [Pa] */
    double law_radius, law_beam_young; /* what the law gave */
    double law_poisson, law_young;     /* nu [-], E [Pa] of the sample with these */
    double poisson; /* nu of the sample with the polished ones [-]; its E is `young` exactly */
    int n_tests;    /* each pulls the sample along all three axes */
    double seconds;
} brc_polish;

/* Start from the law for the domain's coordination number and the spread of its radii, follow the secant of nu in r_m for at most three tests, until nu is
 * within 5e-4 of `poisson` (relative); E_m scales. nu and E of a test are means over the three axes: they scatter a third as much between samples as those of one axis
 * (docs/beams-calibration.md). The domain is a box as in beam_sample.h. BRC_BAD_INPUT as brc_beam_law_invert and brc_beam_sample_pull. */
brc_status brc_beam_polish(brc_context *context, brc_device *device, const brc_domain *domain, double poisson, double young, double beam_poisson,
                           brc_polish *out);

/* Give every material of the scene that its cbm bodies use, and that has no beams of its own, polished ones: on the domain itself where the scene is one
 * packed box of one material, not turned and without cracks, else on a cube packed as the body is (coordination, radii, seed; at most 10 000 spheres).
 * BRC_BAD_INPUT too: bodies of points, files or different packings that share a material. Says what it did in the log. */
brc_status brc_beam_polish_scene(brc_context *context, brc_scene *scene, const brc_domain *domain, int n_threads);

#endif
