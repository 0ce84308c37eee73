/* The bond of the operator that multigrid takes for the stiffness of cells (docs/notebook/theory.md T6): a spring along
 * the bond and one across it, seen from frames that turn with its two ends, and one between these frames. It has no
 * energy under rigid motions. */
#ifndef BRC_KERNELS_MULTIGRID_BOND_H
#define BRC_KERNELS_MULTIGRID_BOND_H

#include "../core/vec.h"

/* Stiffness over S/L: along and across the bond, and of the frames over L^2 [Pa]. */
typedef struct {
    lane axial, shear, frame;
} multigrid_moduli;

/* Where it is: branch X_j - X_i [m], the inverse of its square [1/m^2], S/L [m], 0 for a missing neighbour. */
typedef struct {
    lane_vec3 branch;
    lane inv_square, weight;
} multigrid_place;

/* Length squared that only a missing neighbour's branch is below [m^2]. */
LAW lane multigrid_nothing(void) { return LANE_ZERO + REAL(1e-30); }

/* area: area vector s; ratio q = L/S. */
LAW multigrid_place multigrid_place_of_face(lane_vec3 area, lane ratio)
{
    const lane_vec3 branch = lane_vec3_scale(ratio, area);
    const lane inverse = REAL(1) / (lane_vec3_dot(branch, branch) + multigrid_nothing());
    return (multigrid_place){
        branch, inverse, lane_vec3_dot(branch, area) * inverse}; /* (q s).s / (q s)^2 = 1/q, without another division */
}

LAW multigrid_place multigrid_place_of_branch(lane_vec3 branch, lane area)
{
    const lane inverse = REAL(1) / (lane_vec3_dot(branch, branch) + multigrid_nothing());
    return (multigrid_place){branch, inverse, area * LANE_SQRT(inverse)};
}

/* What the bond does to element i: force [N] and torque about its centre [N m]. */
typedef struct {
    lane_vec3 force, torque;
} multigrid_pull;

/* jump: u_j - u_i [m]; turn_sum, turn_jump: theta_j + theta_i, theta_j - theta_i [-]. */
LAW multigrid_pull multigrid_bond(multigrid_place at, multigrid_moduli k, lane_vec3 jump, lane_vec3 turn_sum,
                                  lane_vec3 turn_jump)
{
    const lane_vec3 r = at.branch, turned = lane_vec3_scale(LANE_ZERO + REAL(0.5), lane_vec3_cross(turn_sum, r));
    const lane_vec3 stretch = lane_vec3_sub(jump, turned);
    const lane along = at.weight * (k.axial - k.shear) * at.inv_square * lane_vec3_dot(r, stretch);
    const lane_vec3 force = lane_vec3_add(lane_vec3_scale(along, r), lane_vec3_scale(at.weight * k.shear, stretch));
    const lane_vec3 lever = lane_vec3_scale(LANE_ZERO + REAL(0.5), lane_vec3_cross(r, force));
    const lane frame = at.weight * k.frame * lane_vec3_dot(r, r);
    return (multigrid_pull){force, lane_vec3_add(lever, lane_vec3_scale(frame, turn_jump))};
}

/* Modulus of a bond between two materials (modulus_between, host/solver/statics/multigrid/fine.c). */
LAW lane multigrid_modulus(lane a, lane b) { return REAL(0.1) * (a + b) + REAL(1.6) * a * b / (a + b); }

#endif
