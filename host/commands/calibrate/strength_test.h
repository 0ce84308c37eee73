/* The fracture test that the law of strength is fitted to (NAH19 section 3.2): a bonded cube of spheres, pulled apart
 * along an axis until its load has passed its peak. The scene is made here; it is that of
 * tests/validation/nah19-strength with a time limit by rule.
 *
 * A static stage goes to START of the first failure, a dynamic one pulls on at constant speed, the whole sample moving
 * with it from the start so that no wave runs ahead. Speed: the strain that is left would take `passages` passages of a
 * wave along the sample, counted from no load to the strength the published law expects. The test ends when the load
 * has fallen to END of its largest value so far. */
#ifndef BRC_COMMANDS_STRENGTH_TEST_H
#define BRC_COMMANDS_STRENGTH_TEST_H

#include "../../../preprocess/domain/domain.h"
#include "../../device/device.h"

typedef struct brc_strength_pull {
    int axis;             /* 0 x 1 y 2 z: the walls "<axis>-" and "<axis>+" are moved apart, all other walls are free */
    double radius_spread; /* of the packing: which elastic law gives E and nu of the sample [-] */
    double radius;        /* r_m: beam radius over the mean radius of the packed spheres [-] */
    double beam_poisson;  /* nu_m [-] */
    double beam_young;    /* E_m [Pa] */
    double limit;         /* sigma_m: limit of tension of the virial stress [Pa] */
    double passages;      /* from no load to the expected strength */
} brc_strength_pull;

typedef struct brc_strength_answer {
    double ratio;  /* k = sigma_M / sigma_m [-]; sigma_M: largest load over the section of the bounding box (NAH19
                      section 2.4) */
    double first;  /* the same at the first failure, by the static stage: load over section over sigma_m there [-] */
    double strain; /* of the wall-to-wall length at the peak [-] */
    int64_t n_bonds, n_loose,
        n_broken;    /* bonds; elements without bonds, which are held still; bonds broken when the test ended */
    int64_t n_steps; /* dynamic */
    double seconds;
} brc_strength_answer;

/* The domain is a box of spheres with its six walls, not turned; the device was opened for one material and one
 * simulation at a time. BRC_BAD_INPUT: no such walls. BRC_PHYSICS_STOPPED: the load did not fall within three times the
 * expected strain. */
brc_status brc_strength_test(brc_context *context, brc_device *device, const brc_domain *domain,
                             const brc_strength_pull *pull, brc_strength_answer *out);

#endif
