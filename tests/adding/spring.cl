/* spring: central springs, in one pass over elements and their bonds. branch X_j - X_i [slot][3][C], stiffness [N/m]
 * [slot][C] (missing: 0). */

typedef struct {
    lane_vec3 force; /* [N] */
    lane energy;     /* [J] */
} spring_pull;

/* Of a spring r at rest whose ends are u apart more; finite: the full law, else its linearisation. */
LAW spring_pull spring_law(lane_vec3 r, lane_vec3 u, lane k, int finite)
{
    const lane_vec3 now = lane_vec3_add(r, u);
    const lane length = LANE_SQRT(lane_vec3_dot(r, r)), length_now = LANE_SQRT(lane_vec3_dot(now, now));
    /* |now| - |r| without loss of digits */
    const lane change =
        finite ? lane_vec3_dot(lane_vec3_add(now, r), u) / (length_now + length) : lane_vec3_dot(r, u) / length;
    const lane pull = k * change;
    return (spring_pull){lane_vec3_scale(pull / (finite ? length_now : length), finite ? now : r),
                         REAL(0.5) * pull * change};
}

LAW spring_pull spring_sum(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) stiffness,
                           GATHER(state) displacement, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const state_vec3 own = state_gather3(displacement, lane_own(group * W));
    spring_pull sum = {{LANE_ZERO, LANE_ZERO, LANE_ZERO}, LANE_ZERO};
    for (int slot = row_start[slice]; slot < last; ++slot) {
        const lane_int j = int_block(neighbour, slot, lane0);
        const lane k = lane_load(stiffness, (brc_size)slot * C + (brc_size)lane0);
        const spring_pull one = spring_law(lane_block3(branch, slot, lane0),
                                           state_vec3_difference(state_gather3(displacement, j), own), k, finite);
        sum.force = lane_vec3_add(sum.force, one.force);
        sum.energy += one.energy;
    }
    return sum;
}

/* Force on every element [N] [n][3]. */
KERNEL void spring_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) stiffness,
                         GATHER(state) displacement, int finite, PUT(state) force)
{
    FOR_EACH_ITEM(group, n_groups) {
        const spring_pull sum = finite ? spring_sum(group, row_start, neighbour, branch, stiffness, displacement, 1)
                                       : spring_sum(group, row_start, neighbour, branch, stiffness, displacement, 0);
        state_store3(force, group * W, sum.force);
    }
}

/* Half of the energy of each of an element's springs [J] [n]. */
KERNEL void spring_energy(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) stiffness,
                          GATHER(state) displacement, PUT(state) elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        const spring_pull sum = spring_sum(group, row_start, neighbour, branch, stiffness, displacement, 1);
        state_store1(elastic, group * W, REAL(0.5) * sum.energy);
    }
}
