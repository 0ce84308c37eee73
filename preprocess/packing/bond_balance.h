/* Bonds that look alike in all directions. The pairs nearest to each other (bond_search.h) are even in direction on
 * average; one sample of 10 000 spheres is off by some tenths of a percent, and its stiffness along x, y and z with it
 * (docs/notebook/beams-calibration.md). Here the longest bond becomes a slightly different one in each direction, so
 * that the unevenness goes. */
#ifndef BRC_PREPROCESS_BOND_BALANCE_H
#define BRC_PREPROCESS_BOND_BALANCE_H

#include "../shapes/solid.h"

/* Real spherical harmonics of degree 2 (5) and 4 (9): what the fabric tensors of second and fourth order, sums of n n
 * and n n n n over bonds, have beyond their isotropic parts. */
enum { BRC_BALANCE_PARTS = 14 };

/* Of the unit vector n, scaled so that each has the mean square 1 over the sphere. */
void brc_balance_harmonics(const double n[3], double out[BRC_BALANCE_PARTS]);

/* Mean harmonics of the outward normals where the surface comes within two radii of a sphere: what walls do to the
 * directions of the bonds beside them lies along this, in each of the two degrees, and is no chance. Below a twentieth
 * of its largest possible length it is 0 (walls that cancel, such as those of a cube in degree 2). */
void brc_balance_of_walls(const brc_solid *solid, const double *position, const double *radius, int64_t n,
                          int n_threads, double out[BRC_BALANCE_PARTS]);

/* n_pairs pairs with the smallest d / (R_i + R_j) / (1 + t(n)), n the direction of the branch: t, a sum of the
 * harmonics, is such that the sum over bonds of length times harmonics vanishes, as nearly as whole bonds allow, but
 * for its part along `walls` (NULL: none). A share 12 / sqrt(n) more pairs than wanted are looked at, which bounds |t|:
 * some 2 % at 10 000 spheres, where 0.04 % (cn 6) to 1.3 % (cn 8, 10) are needed. Fewer than 200 more pairs, or a
 * lattice, whose pairs are all alike: the nearest pairs, t = 0. The rest as brc_bond_search; *growth: the largest
 * ratio. */
brc_status brc_bond_balance(brc_context *context, const double *position, const double *radius, int64_t n,
                            int64_t n_pairs, const double walls[BRC_BALANCE_PARTS], int n_threads, int32_t (**pair)[2],
                            double *growth);

#endif
