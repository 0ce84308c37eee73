/* Multigrid as preconditioner of static solves (host/solver/statics/multigrid): residuals, steps and transfers between
 * levels. A node of a level has a displacement move [n][3] and a rotation turn [n][3], forces and torques likewise; of
 * coarser levels that swell (swells 1) also a swelling swell [n], u = swell (x - centre), and what works on it, the
 * virial [n]. A block of these has its 36 numbers of the first six unknowns, by columns, then the six that swelling
 * does to them, the six that they do to swelling, and its own. Each work-item gathers and writes its own node. */

/* out = right - A x of the finest level of cells: its bonds from area vectors and L/S, or from branches and areas
 * (by_branch). moduli_of [n][3]: with several materials. n_right: right sides there are: 0 none, 1 forces, 2 forces and
 * torques. */
KERNEL void multigrid_cells(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) vector,
                            OWN(coeff) number, int by_branch, coeff axial, coeff shear, coeff frame,
                            GATHER(coeff) moduli_of, GATHER(state) move, GATHER(state) turn, int n_right,
                            OWN(state) right_force, OWN(state) right_torque, PUT(state) force, PUT(state) torque)
{
    FOR_EACH_ITEM(group, n_groups) {
        const members who = members_of_group(group, row_start);
        members_states_later(who, move, 3, ahead);
        members_states_later(who, turn, 3, ahead);
        const state_vec3 u = state_gather3(move, who.own), theta = state_gather3(turn, who.own);
        const state_vec3 zero = {STATE_FROM_LANE(LANE_ZERO), STATE_FROM_LANE(LANE_ZERO), STATE_FROM_LANE(LANE_ZERO)};
        const lane_vec3 own_turn = state_vec3_difference(theta, zero);
        lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO}, t = f;
        if (n_right > 0) f = state_vec3_difference(state_gather3(right_force, who.own), zero);
        if (n_right > 1) t = state_vec3_difference(state_gather3(right_torque, who.own), zero);
        for (int slot = who.begin; slot < who.end; ++slot) {
            const lane_int j = members_neighbour(who, neighbour, slot);
            members_ahead3(who, vector, slot);
            members_ahead1(who, number, slot);
            const lane_vec3 v = members_row3(who, vector, slot);
            const lane k = members_row1(who, number, slot);
            const multigrid_place at = by_branch ? multigrid_place_of_branch(v, k) : multigrid_place_of_face(v, k);
            const lane_vec3 turn_jump = state_vec3_difference(state_gather3(turn, j), theta);
            const lane_vec3 turn_sum = lane_vec3_add(turn_jump, lane_vec3_scale(LANE_ZERO + REAL(2), own_turn));
#if BRC_MANY_MATERIALS
            const lane_int a = who.own * 3, b = j * 3;
            const multigrid_moduli m = {
                multigrid_modulus(gather_component(moduli_of, a), gather_component(moduli_of, b)),
                multigrid_modulus(gather_component(moduli_of + 1, a), gather_component(moduli_of + 1, b)),
                multigrid_modulus(gather_component(moduli_of + 2, a), gather_component(moduli_of + 2, b))};
#else
            const multigrid_moduli m = {LANE_ZERO + axial, LANE_ZERO + shear, LANE_ZERO + frame};
#endif
            const multigrid_pull pull =
                multigrid_bond(at, m, state_vec3_difference(state_gather3(move, j), u), turn_sum, turn_jump);
            f = lane_vec3_add(f, pull.force);
            t = lane_vec3_add(t, pull.torque);
        }
        members_store3(who, force, f);
        members_store3(who, torque, t);
    }
}

/* y[6] of a node. */
typedef struct {
    state v[6];
} multigrid_node;
LAW multigrid_node multigrid_load(GATHER(state) move, GATHER(state) turn, int i)
{
    const brc_size at = (brc_size)i * 3;
    return (multigrid_node){{move[at], move[at + 1], move[at + 2], turn[at], turn[at + 1], turn[at + 2]}};
}
LAW void multigrid_store(PUT(state) move, PUT(state) turn, int i, multigrid_node y)
{
    for (int c = 0; c < 3; ++c) {
        move[(brc_size)i * 3 + c] = y.v[c];
        turn[(brc_size)i * 3 + c] = y.v[c + 3];
    }
}
/* y + factor B x; block [6][6] by columns. */
LAW multigrid_node multigrid_add(multigrid_node y, state factor, OWN(state) block, multigrid_node x)
{
    for (int b = 0; b < 6; ++b) {
        const state by = factor * x.v[b];
        for (int a = 0; a < 6; ++a) y.v[a] += block[6 * b + a] * by;
    }
    return y;
}
/* y + B^T x. */
LAW multigrid_node multigrid_add_transposed(multigrid_node y, GATHER(state) block, multigrid_node x)
{
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) y.v[a] += block[6 * a + b] * x.v[b];
    return y;
}

/* Numbers of a block of a level. */
LAW int multigrid_block_size(int swells) { return swells ? 49 : 36; }
/* y + factor B e of a swelling e, without that of its own. */
LAW multigrid_node multigrid_add_swelling(multigrid_node y, state factor, GATHER(state) block, state e)
{
    for (int a = 0; a < 6; ++a) y.v[a] += block[36 + a] * (factor * e);
    return y;
}
/* Of the swelling: B x and B e; their transposes. */
LAW state multigrid_to_swelling(OWN(state) block, multigrid_node x, state e)
{
    state y = block[48] * e;
    for (int b = 0; b < 6; ++b) y += block[42 + b] * x.v[b];
    return y;
}
LAW multigrid_node multigrid_add_transposed_swelling(multigrid_node y, GATHER(state) block, state e)
{
    for (int a = 0; a < 6; ++a) y.v[a] += block[42 + a] * e;
    return y;
}
LAW state multigrid_transposed_to_swelling(GATHER(state) block, multigrid_node x, state e)
{
    state y = block[48] * e;
    for (int b = 0; b < 6; ++b) y += block[36 + b] * x.v[b];
    return y;
}

/* Held faces add blocks [n][36] to the stiffness of their elements: out -= block x. element [n] rows. */
KERNEL void multigrid_ground(int n, OWN(int) element, OWN(state) block, OWN(state) move, OWN(state) turn,
                             UPDATE(state) force, UPDATE(state) torque)
{
    FOR_EACH_ITEM(i, n) {
        const multigrid_node x = multigrid_load(move, turn, element[i]), y = multigrid_load(force, torque, element[i]);
        const multigrid_node left = multigrid_add(y, STATE(-1), block + (brc_size)i * 36, x);
        multigrid_store(force, torque, element[i], left);
    }
}

/* out = right - A x of a coarser level: rows of blocks [start[n]]; right only if n_right > 0. */
KERNEL void multigrid_matrix(int n, int swells, OWN(int) start, OWN(int) column, OWN(state) block, GATHER(state) move,
                             GATHER(state) turn, GATHER(state) swell, int n_right, OWN(state) right_force,
                             OWN(state) right_torque, OWN(state) right_virial, PUT(state) force, PUT(state) torque,
                             PUT(state) virial)
{
    FOR_EACH_ITEM(i, n) {
        multigrid_node y = {{0, 0, 0, 0, 0, 0}};
        state own = 0;
        if (n_right > 0) y = multigrid_load(right_force, right_torque, i);
        if (n_right > 0 && swells) own = right_virial[i];
        for (int k = start[i]; k < start[i + 1]; ++k) {
            const multigrid_node x = multigrid_load(move, turn, column[k]);
            GLOBAL const state *b = block + (brc_size)k * (brc_size)multigrid_block_size(swells);
            y = multigrid_add(y, STATE(-1), b, x);
            if (swells) {
                const state e = swell[column[k]];
                y = multigrid_add_swelling(y, STATE(-1), b, e);
                own -= multigrid_to_swelling(b, x, e);
            }
        }
        multigrid_store(force, torque, i, y);
        if (swells) virial[i] = own;
    }
}

/* x = [x +] weight D^-1 f, D^-1 as upper triangles [n][21], row by row; where nodes swell [n][28], the column of
 * swelling last. n_right as above: a missing torque is zero. */
KERNEL void multigrid_step(int n, int swells, state weight, int add, OWN(state) inverse, int n_right, OWN(state) force,
                           OWN(state) torque, OWN(state) virial, UPDATE(state) move, UPDATE(state) turn,
                           UPDATE(state) swell)
{
    FOR_EACH_ITEM(e, n) {
        GLOBAL const state *p = inverse + (brc_size)e * (swells ? 28 : 21), *f = force + (brc_size)e * 3,
                           *t = torque + (brc_size)e * 3;
        const state a = weight * f[0], b = weight * f[1], c = weight * f[2];
        state d = 0, g = 0, h = 0;
        multigrid_node x = {{0, 0, 0, 0, 0, 0}};
        if (n_right > 1) d = weight * t[0], g = weight * t[1], h = weight * t[2];
        if (add) x = multigrid_load(move, turn, e);
        x.v[0] = x.v[0] + p[0] * a + p[1] * b + p[2] * c + p[3] * d + p[4] * g + p[5] * h;
        x.v[1] = x.v[1] + p[1] * a + p[6] * b + p[7] * c + p[8] * d + p[9] * g + p[10] * h;
        x.v[2] = x.v[2] + p[2] * a + p[7] * b + p[11] * c + p[12] * d + p[13] * g + p[14] * h;
        x.v[3] = x.v[3] + p[3] * a + p[8] * b + p[12] * c + p[15] * d + p[16] * g + p[17] * h;
        x.v[4] = x.v[4] + p[4] * a + p[9] * b + p[13] * c + p[16] * d + p[18] * g + p[19] * h;
        x.v[5] = x.v[5] + p[5] * a + p[10] * b + p[14] * c + p[17] * d + p[19] * g + p[20] * h;
        if (swells) {
            const state w = weight * virial[e];
            for (int k = 0; k < 6; ++k) x.v[k] += p[21 + k] * w;
            swell[e] = (add ? swell[e] : 0) + p[21] * a + p[22] * b + p[23] * c + p[24] * d + p[25] * g + p[26] * h +
                       p[27] * w;
        }
        multigrid_store(move, turn, e, x);
    }
}

/* The same of the finest level, whose triangles lie by slices [slice][21][C]. */
LAW state_vec3 multigrid_part(state weight, int there, GATHER(state) p, lane_int own)
{
    const lane_state zero = STATE_FROM_LANE(LANE_ZERO);
    if (!there) return (state_vec3){zero, zero, zero};
    const state_vec3 x = state_gather3(p, own);
    return (state_vec3){weight * x.x, weight * x.y, weight * x.z};
}
KERNEL void multigrid_finest_step(int n_groups, state weight, int add, OWN(state) inverse, int n_right,
                                  OWN(state) force, OWN(state) torque, UPDATE(state) move, UPDATE(state) turn)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int own = lane_own(group * W);
        const state_vec3 f = multigrid_part(weight, 1, force, own),
                         t = multigrid_part(weight, n_right > 1, torque, own);
        const state_vec3 was = multigrid_part(1, add, move, own), turned = multigrid_part(1, add, turn, own);
        const brc_size at = (brc_size)SLICE_OF(group) * 21 * C + (brc_size)FIRST_LANE_OF(group);
#define P(k) state_load(inverse, at + (k)*C)
        const lane_state p1 = P(1), p2 = P(2), p3 = P(3), p4 = P(4), p5 = P(5), p7 = P(7), p8 = P(8), p9 = P(9),
                         p10 = P(10), p12 = P(12), p13 = P(13), p14 = P(14), p16 = P(16), p17 = P(17), p19 = P(19);
        const lane_state x = was.x + P(0) * f.x + p1 * f.y + p2 * f.z + p3 * t.x + p4 * t.y + p5 * t.z,
                         y = was.y + p1 * f.x + P(6) * f.y + p7 * f.z + p8 * t.x + p9 * t.y + p10 * t.z,
                         z = was.z + p2 * f.x + p7 * f.y + P(11) * f.z + p12 * t.x + p13 * t.y + p14 * t.z,
                         a = turned.x + p3 * f.x + p8 * f.y + p12 * f.z + P(15) * t.x + p16 * t.y + p17 * t.z,
                         b = turned.y + p4 * f.x + p9 * f.y + p13 * f.z + p16 * t.x + P(18) * t.y + p19 * t.z,
                         c = turned.z + p5 * f.x + p10 * f.y + p14 * f.z + p17 * t.x + p19 * t.y + P(20) * t.z;
#undef P
#define PUT_ROW(l)                                                                                                     \
    multigrid_store(move, turn, group *W + 0x##l,                                                                      \
                    (multigrid_node){{LANE_ITEM(x, l), LANE_ITEM(y, l), LANE_ITEM(z, l), LANE_ITEM(a, l),              \
                                      LANE_ITEM(b, l), LANE_ITEM(c, l)}});
        LANE_EACH(PUT_ROW)
#undef PUT_ROW
    }
}

/* Motions of aggregates, the finest level: force, torque and virial about the aggregate's centre of what acts on its
 * members' free components (bits 1 2 4 of displacements, 8 16 32 of rotations). member [start[n]] rows, arm [n_rows][3]
 * from the centre [m]. */
KERNEL void multigrid_collect(int n, int swells, OWN(int) start, OWN(int) member, GATHER(coeff) arm,
                              GATHER(int) free_bits, GATHER(state) force, GATHER(state) torque, PUT(state) whole_force,
                              PUT(state) whole_torque, PUT(state) whole_virial)
{
    FOR_EACH_ITEM(i, n) {
        multigrid_node y = {{0, 0, 0, 0, 0, 0}};
        for (int k = start[i]; k < start[i + 1]; ++k) {
            const int e = member[k], bits = free_bits[e];
            multigrid_node r = multigrid_load(force, torque, e);
            for (int c = 0; c < 6; ++c) r.v[c] = bits >> c & 1 ? r.v[c] : 0;
            const state x = (state)arm[(brc_size)e * 3], z = (state)arm[(brc_size)e * 3 + 2],
                        w = (state)arm[(brc_size)e * 3 + 1];
            for (int c = 0; c < 6; ++c) y.v[c] += r.v[c];
            y.v[3] += w * r.v[2] - z * r.v[1];
            y.v[4] += z * r.v[0] - x * r.v[2];
            y.v[5] += x * r.v[1] - w * r.v[0];
        }
        multigrid_store(whole_force, whole_torque, i, y);
        if (swells) {
            state virial = 0;
            for (int k = start[i]; k < start[i + 1]; ++k) {
                const brc_size at = (brc_size)member[k] * 3;
                for (int c = 0; c < 3; ++c)
                    virial +=
                        free_bits[member[k]] >> c & 1 ? (state)arm[at + (brc_size)c] * force[at + (brc_size)c] : 0;
            }
            whole_virial[i] = virial;
        }
    }
}

/* Members move on with their aggregate in their free components. aggregate [n], -1: none. */
KERNEL void multigrid_spread(int n, int swells, OWN(int) aggregate, OWN(coeff) arm, OWN(int) free_bits,
                             GATHER(state) whole_move, GATHER(state) whole_turn, GATHER(state) whole_swell,
                             UPDATE(state) move, UPDATE(state) turn)
{
    FOR_EACH_ITEM(e, n) {
        if (aggregate[e] >= 0) {
            const int bits = free_bits[e];
            const state x = (state)arm[(brc_size)e * 3], z = (state)arm[(brc_size)e * 3 + 2],
                        w = (state)arm[(brc_size)e * 3 + 1];
            multigrid_node to = multigrid_load(move, turn, e), y = multigrid_load(whole_move, whole_turn, aggregate[e]);
            y.v[0] += y.v[4] * z - y.v[5] * w;
            y.v[1] += y.v[5] * x - y.v[3] * z;
            y.v[2] += y.v[3] * w - y.v[4] * x;
            for (int c = 0; c < 6; ++c) to.v[c] += bits >> c & 1 ? y.v[c] : 0;
            multigrid_store(move, turn, e, to);
            if (swells) {
                const brc_size at = (brc_size)e * 3;
                const state swell = whole_swell[aggregate[e]];
                for (int c = 0; c < 3; ++c)
                    move[at + (brc_size)c] += bits >> c & 1 ? swell * (state)arm[at + (brc_size)c] : 0;
            }
        }
    }
}

/* x += P e with rows of blocks [start[n]]. */
KERNEL void multigrid_prolong(int n, int swells, OWN(int) start, OWN(int) column, OWN(state) block,
                              GATHER(state) coarse_move, GATHER(state) coarse_turn, GATHER(state) coarse_swell,
                              UPDATE(state) move, UPDATE(state) turn, UPDATE(state) swell)
{
    FOR_EACH_ITEM(i, n) {
        multigrid_node y = multigrid_load(move, turn, i);
        state own = swells ? swell[i] : 0;
        for (int k = start[i]; k < start[i + 1]; ++k) {
            const multigrid_node x = multigrid_load(coarse_move, coarse_turn, column[k]);
            GLOBAL const state *b = block + (brc_size)k * (brc_size)multigrid_block_size(swells);
            y = multigrid_add(y, STATE(1), b, x);
            if (swells) {
                const state e = coarse_swell[column[k]];
                y = multigrid_add_swelling(y, STATE(1), b, e);
                own += multigrid_to_swelling(b, x, e);
            }
        }
        multigrid_store(move, turn, i, y);
        if (swells) swell[i] = own;
    }
}

/* P^T r: column_start [n + 1] of the places (block, row) [.][2] of each column of P. */
KERNEL void multigrid_restrict(int n, int swells, OWN(int) column_start, OWN(int) place, GATHER(state) block,
                               GATHER(state) force, GATHER(state) torque, GATHER(state) virial, PUT(state) coarse_force,
                               PUT(state) coarse_torque, PUT(state) coarse_virial)
{
    FOR_EACH_ITEM(i, n) {
        multigrid_node y = {{0, 0, 0, 0, 0, 0}};
        state own = 0;
        for (int k = column_start[i]; k < column_start[i + 1]; ++k) {
            const multigrid_node r = multigrid_load(force, torque, place[2 * k + 1]);
            GLOBAL const state *b = block + (brc_size)place[2 * k] * (brc_size)multigrid_block_size(swells);
            y = multigrid_add_transposed(y, b, r);
            if (swells) {
                const state e = virial[place[2 * k + 1]];
                y = multigrid_add_transposed_swelling(y, b, e);
                own += multigrid_transposed_to_swelling(b, r, e);
            }
        }
        multigrid_store(coarse_force, coarse_torque, i, y);
        if (swells) coarse_virial[i] = own;
    }
}

/* The coarsest level, solved: the inverse [6 n][6 n], or [7 n][7 n], a node's displacement before its rotation before
 * its swelling. */
KERNEL void multigrid_coarsest(int n, int swells, OWN(state) inverse, GATHER(state) force, GATHER(state) torque,
                               GATHER(state) virial, PUT(state) move, PUT(state) turn, PUT(state) swell)
{
    FOR_EACH_ITEM(i, n) {
        multigrid_node y = {{0, 0, 0, 0, 0, 0}};
        state own = 0;
        const brc_size each = swells ? 7 : 6, row_size = (brc_size)n * each;
        for (int j = 0; j < n; ++j) {
            const multigrid_node r = multigrid_load(force, torque, j);
            const state e = swells ? virial[j] : 0;
            GLOBAL const state *block = inverse + (brc_size)i * each * row_size + (brc_size)j * each;
            for (int a = 0; a < 6; ++a) {
                GLOBAL const state *row = block + (brc_size)a * row_size;
                for (int b = 0; b < 6; ++b) y.v[a] += row[b] * r.v[b];
                if (swells) y.v[a] += row[6] * e;
            }
            if (swells) {
                GLOBAL const state *row = block + 6 * row_size;
                for (int b = 0; b < 6; ++b) own += row[b] * r.v[b];
                own += row[6] * e;
            }
        }
        multigrid_store(move, turn, i, y);
        if (swells) swell[i] = own;
    }
}
