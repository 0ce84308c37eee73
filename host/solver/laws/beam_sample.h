/* The elastic test that the laws of model cbm are fitted to (NAH19 sections 2.4 and 3.1): a packing, bonded to a
 * coordination number, pulled along one axis by one linear static solve. */
#ifndef BRC_SOLVER_BEAM_SAMPLE_H
#define BRC_SOLVER_BEAM_SAMPLE_H

#include "../../../preprocess/domain/build.h"
#include "../../device/device.h"

/* A packing that may be bonded to any number of coordination numbers. */
typedef struct brc_beam_sample brc_beam_sample;

/* Pack `fill` (kind packing) into `shape`, both copied but for the table of radii, which is borrowed. BRC_BAD_INPUT as
 * brc_packing_make. */
brc_status brc_beam_sample_pack(brc_context *context, const brc_shape *shape, const brc_fill *fill, int n_threads,
                                brc_beam_sample **out);
void brc_beam_sample_free(brc_beam_sample **sample);
/* A domain of one body and one material; the sample keeps its spheres. balanced: brc_beams_build. The sample is only
 * read: threads may share it, each with a context. */
brc_status brc_beam_sample_bond(brc_context *context, const brc_beam_sample *sample, double coordination, bool balanced,
                                int n_threads, brc_domain **out);

/* What pulls of one domain along one axis with the same E_m leave for the next: their states, and the simulation, which
 * borrows context, device and domain. Zeroed: none yet. */
enum { BRC_BEAM_STATES = 5 };
typedef struct brc_beam_states {
    int32_t n;
    double *state[BRC_BEAM_STATES]; /* [n] owned; the last comes first */
    struct brc_beam_test *test;     /* owned */
} brc_beam_states;
void brc_beam_states_free(brc_beam_states *states);

typedef struct brc_beam_pull {
    int axis;            /* 0 x 1 y 2 z: the walls "<axis>-" and "<axis>+" are moved apart, all other walls are free */
    double radius;       /* r_m: beam radius over the mean radius of the packed spheres [-] */
    double beam_poisson; /* nu_m [-] */
    double beam_young;   /* E_m [Pa]; 0: 1 Pa. The answer is the same but for rounding */
    double tolerance;    /* residual over load; 0: 1e-5, which moves E by up to 3e-5 and nu by 1e-5 of themselves
                            (docs/notebook/beams-calibration.md) */
    brc_beam_states *states; /* the solve begins from what mixes them best, and its own state is kept with the last of
                                them; NULL: from no load, and nothing is kept */
} brc_beam_pull;

typedef struct brc_beam_answer {
    double
        young; /* E_M / E_m [-]: force over the lateral edges of the bounding box, over the strain of its axial edge */
    double poisson;           /* nu_M [-]: mean of the two lateral strains over the axial one */
    double lateral[2];        /* the two ratios, axes in cyclic order [-] */
    double inner;             /* bonds of an element away from the walls, mean (beam_body.h) [-] */
    int64_t n_bonds, n_loose; /* bonds; elements without bonds, which are held still and counted in no mean */
    int64_t iterations;
    double seconds;
} brc_beam_answer;

/* Elements touching the two walls get their normal displacement, everything else is free. Edges of the bounding box:
 * distance of the mean positions of the elements touching two walls, plus the mean diameter. The domain is a box of
 * spheres with its six walls, not turned; the device was opened for one material. BRC_BAD_INPUT: no such walls, or
 * nothing touches them. */
brc_status brc_beam_sample_pull(brc_context *context, brc_device *device, const brc_domain *domain,
                                const brc_beam_pull *pull, brc_beam_answer *out);

#endif
