/* Fracture of cells, dlsm and dlsm-published (docs/notebook/fracture.md): which bonds break, and what becomes of their
 * elements. A broken bond is stored like a missing one: its neighbour is home, its area 0, its ratio 1; the face is
 * then a free face of both cells without any more words, since the law reads intact faces only (docs/notebook/theory.md
 * T2). So the elastic passes do not know that anything broke.
 *
 * Of the entries [n_slots][C]: limit: normal stress at which the bond breaks, CELLS_NEVER where there is none [Pa];
 * twin: the entry of the same bond seen from the other element; alive: 1 while it holds, else 0; mark: 0, or how it
 * breaks at the end of this step; measure: its stress then [Pa]. found, n_marked: of an element or group of elements,
 * how many bonds it marked. touched [n]: 1 for the two elements of every marked bond, 2 once it broke, 3 where the rest
 * of an element's bonds are marked then: ring 0 of rings.cl. */

#define CELLS_NEVER REAL(1e30)
#define CELLS_TENSION 1
#define CELLS_SHEAR 3
#define CELLS_DETACHED 4

/* Bonds whose normal stress is above share * limit are marked. plane [n]: lambda + 2 mu [Pa]; n_marked [n_groups]. With
 * share 1 only groups that the force pass told to look at their bonds do; of the linearised law (finite 0) all of their
 * bonds. */
KERNEL void cells_check(int n_groups, coeff share, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area,
                        OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress,
                        GATHER(coeff) plane, int finite, UPDATE(int) look, OWN(coeff) limit, PUT(int) mark,
                        PUT(coeff) measure, FLAG(int) touched, PUT(state) n_marked)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        const int first = group * W;
        int marked = 0;
        if (share < REAL(1) || share > REAL(1) || look[group]) {
            look[group] = 0;
            const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
            const lane_int own = lane_own(first);
            const lane_mat3 h = lane_gather9(gradient, own), p = lane_gather9(stress, own);
            const lane k = lane_load(plane, (brc_size)first);
            const cell_side side = cell_side_of(h, p, k);
            const state_vec3 u = state_gather3(displacement, own);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                const lane_int j = int_block(neighbour, slot, lane0);
                const lane_vec3 r = lane_vec3_scale(lane_load(ratio, entry), lane_block3(area, slot, lane0));
                const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
                const lane bound = share * lane_load(limit, entry), room = cell_room(side, r, jump, bound);
                /* of the two halves of a bond above its limit one is above it too */
                if (!finite || LANE_ANY_SHORT(room, LANE_ZERO)) {
                    const lane inverse = cell_inverse_square(r), strain = cell_bond_strain(r, jump, inverse, finite);
                    const lane tau = cell_half_stress(h, p, k, r, strain, inverse, finite);
                    const lane other = cell_half_stress(lane_gather9(gradient, j), lane_gather9(stress, j),
                                                        gather_component(plane, j), r, strain, inverse, finite);
                    const lane sigma = REAL(0.5) * (tau + other);
#define MARK(l)                                                                                                        \
    if (LANE_ITEM(sigma, l) > LANE_ITEM(bound, l)) {                                                                   \
        mark[entry + 0x##l] = CELLS_TENSION;                                                                           \
        measure[entry + 0x##l] = LANE_ITEM(sigma, l);                                                                  \
        STORE_SAME(touched + first + 0x##l, 1);                                                                        \
        STORE_SAME(touched + LANE_ITEM(j, l), 1);                                                                      \
        marked += 1;                                                                                                   \
    }
                    LANE_EACH(MARK)
#undef MARK
                }
            }
        }
        n_marked[group] = (state)marked;
    }
}

/* The largest sigma / limit of each element's bonds [n] [-]. */
KERNEL void cells_ratio(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) ratio,
                        GATHER(state) displacement, GATHER(coeff) gradient, GATHER(coeff) stress, GATHER(coeff) plane,
                        int finite, OWN(coeff) limit, PUT(coeff) out)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const lane_int own = lane_own(first);
        const lane_mat3 h = lane_gather9(gradient, own), p = lane_gather9(stress, own);
        const lane k = lane_load(plane, (brc_size)first);
        const state_vec3 u = state_gather3(displacement, own);
        lane largest = LANE_ZERO;
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
            const lane_int j = int_block(neighbour, slot, lane0);
            const lane_vec3 r = lane_vec3_scale(lane_load(ratio, entry), lane_block3(area, slot, lane0));
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
            const lane inverse = cell_inverse_square(r), strain = cell_bond_strain(r, jump, inverse, finite);
            const lane tau = cell_half_stress(h, p, k, r, strain, inverse, finite);
            const lane other = cell_half_stress(lane_gather9(gradient, j), lane_gather9(stress, j),
                                                gather_component(plane, j), r, strain, inverse, finite);
            largest = cell_larger(largest, REAL(0.5) * (tau + other) / lane_load(limit, entry));
        }
#define PUT_LANE(l) out[(brc_size)first + 0x##l] = LANE_ITEM(largest, l);
        LANE_EACH(PUT_LANE)
#undef PUT_LANE
    }
}

/* Bonds of touched elements that are marked on either side become missing ones. width: numbers a face's area has, 3 for
 * a vector. weight [n]: gains the sum over the element's bonds that break of stress^2 times volume (S L; without a
 * ratio S^(3/2)): shares of the energy that they release, kept in break_energy until cells_share, which leaves it 0.
 * changed [n]: 1 where a bond went. gone [n]: bonds lost so far; broken [n]: bonds that broke so far, those among them
 * whose sides still bear on each other. */
KERNEL void cells_break(int n_groups, int step, int width, OWN(int) row_start, OWN(int) twin, UPDATE(int) touched,
                        GATHER(int) mark, GATHER(coeff) measure, UPDATE(coeff) alive, PUT(int) neighbour,
                        UPDATE(coeff) area, UPDATE(coeff) ratio, PUT(coeff) limit, UPDATE(int) break_step,
                        PUT(int) break_mode, PUT(coeff) break_stress, PUT(coeff) break_energy, UPDATE(state) weight,
                        PUT(int) changed, UPDATE(state) gone, UPDATE(state) broken)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int some = int_load(touched, (brc_size)group * W);
        for (int e = group * W; LANE_ANY(some) && e < group * W + W; ++e) {
            state sum = 0;
            int count = 0, fresh = 0;
            for (int slot = row_start[e / C]; touched[e] && slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C;
                if (!(alive[entry] > 0)) continue;
                const int other = twin[entry], mode = mark[entry] ? mark[entry] : mark[other];
                if (!mode) continue;
                const coeff stress = mark[entry] ? measure[entry] : measure[other];
                coeff square = 0; /* S^2 */
                for (int c = 0; c < width; ++c) {
                    const brc_size at = ((brc_size)slot * width + c) * C + e % C;
                    square += area[at] * area[at];
                    area[at] = 0;
                }
                const coeff part = stress * stress * (width == 3 ? square * ratio[entry] : square / SQRT(SQRT(square)));
                alive[entry] = 0;
                neighbour[entry] = e;
                if (width == 3) ratio[entry] = 1;
                limit[entry] = CELLS_NEVER;
                sum += (state)part;
                count += 1;
                if (break_step[entry])
                    continue; /* broke before, and its sides have come clear of each other now (softening.cl) */
                break_step[entry] = step;
                break_mode[entry] = mode;
                break_stress[entry] = stress;
                break_energy[entry] = part;
                fresh += 1;
            }
            if (touched[e]) touched[e] = 2;
            if (!count) continue;
            weight[e] += sum;
            changed[e] = 1;
            gone[e] += (state)count;
            broken[e] += (state)fresh;
        }
    }
}

/* A symmetric matrix in state: sums of what breaks go on in the precision of the state. */
typedef struct {
    state xx, yy, zz, yz, xz, xy;
} cells_sym;
LAW cells_sym cells_add_square(cells_sym a, state w, state x, state y, state z)
{
    return (cells_sym){a.xx + w * x * x, a.yy + w * y * y, a.zz + w * z * z,
                       a.yz + w * y * z, a.xz + w * x * z, a.xy + w * x * y};
}
LAW cells_sym cells_inverse(cells_sym a)
{
    const state xx = a.yy * a.zz - a.yz * a.yz, xy = a.xz * a.yz - a.xy * a.zz, xz = a.xy * a.yz - a.xz * a.yy;
    const state per = STATE(1) / (a.xx * xx + a.xy * xy + a.xz * xz);
    return (cells_sym){per * xx,
                       per * (a.xx * a.zz - a.xz * a.xz),
                       per * (a.xx * a.yy - a.xy * a.xy),
                       per * (a.xy * a.xz - a.xx * a.yz),
                       per * xz,
                       per * xy};
}
LAW void cells_put(PUT(coeff) block, int e, cells_sym a)
{
    const coeff six[6] = {(coeff)a.xx, (coeff)a.yy, (coeff)a.zz, (coeff)a.yz, (coeff)a.xz, (coeff)a.xy};
    for (int c = 0; c < 6; ++c) block[((brc_size)(e / C) * 6 + c) * C + e % C] = six[c];
}

LAW failure_stress cells_narrow(cells_sym a)
{
    return (failure_stress){(coeff)a.xx, (coeff)a.yy, (coeff)a.zz, (coeff)a.yz, (coeff)a.xz, (coeff)a.xy};
}

/* How stiffly an element answers its neighbours: the largest eigenvalue of A^-1 (sum s (x) s + t (x) t) A^-1, t = sum s
 * [1/m^2]. Times (lambda + 2 mu) / density it is of the order of the square of the highest frequency that the element
 * takes part in. */
LAW coeff cells_stiffness(cells_sym inverse, cells_sym squares, state x, state y, state z)
{
    const cells_sym b = cells_add_square(squares, STATE(1), x, y, z), i = inverse;
    /* rows of A^-1 B, then (A^-1 B) A^-1, symmetric */
    const state p = i.xx * b.xx + i.xy * b.xy + i.xz * b.xz, q = i.xx * b.xy + i.xy * b.yy + i.xz * b.yz,
                r = i.xx * b.xz + i.xy * b.yz + i.xz * b.zz;
    const state k = i.xy * b.xx + i.yy * b.xy + i.yz * b.xz, l = i.xy * b.xy + i.yy * b.yy + i.yz * b.yz,
                m = i.xy * b.xz + i.yy * b.yz + i.yz * b.zz;
    const state u = i.xz * b.xx + i.yz * b.xy + i.zz * b.xz, v = i.xz * b.xy + i.yz * b.yy + i.zz * b.yz,
                w = i.xz * b.xz + i.yz * b.yz + i.zz * b.zz;
    const failure_principal largest = failure_principal_of(
        (failure_stress){(coeff)(p * i.xx + q * i.xy + r * i.xz), (coeff)(k * i.xy + l * i.yy + m * i.yz),
                         (coeff)(u * i.xz + v * i.yz + w * i.zz), (coeff)(k * i.xz + l * i.yz + m * i.zz),
                         (coeff)(p * i.xz + q * i.yz + r * i.zz), (coeff)(p * i.xy + q * i.yy + r * i.yz)});
    return largest.first;
}

/* Elements that lost a bond: the inverse of A = sum q s (x) s, smallest limit, marks cleared. An element that its
 * neighbours no longer hold marks the bonds it has left: the smallest eigenvalue of A / (2 V) is below support [n], or
 * it has become stiffer than stiffest [n] [1/m^2], which the time step does not bear. */
KERNEL void cells_rebuild(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area, OWN(coeff) ratio,
                          OWN(coeff) alive, OWN(coeff) limit, OWN(coeff) inv_volume, OWN(coeff) support,
                          OWN(coeff) stiffest, UPDATE(int) changed, PUT(coeff) least, PUT(coeff) inv_shape,
                          PUT(int) mark, PUT(coeff) measure, FLAG(int) touched)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int some = int_load(changed, (brc_size)group * W);
        for (int e = group * W; LANE_ANY(some) && e < group * W + W; ++e) {
            if (!changed[e]) continue;
            cells_sym a = {0, 0, 0, 0, 0, 0}, squares = {0, 0, 0, 0, 0, 0}, inverse = {0, 0, 0, 0, 0, 0};
            state tx = 0, ty = 0, tz = 0;
            coeff weakest = CELLS_NEVER;
            changed[e] = 0;
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C, at = (brc_size)slot * 3 * C + e % C;
                const state x = (state)area[at], y = (state)area[at + C], z = (state)area[at + 2 * C];
                a = cells_add_square(a, (state)ratio[entry], x, y, z);
                squares = cells_add_square(squares, STATE(1), x, y, z);
                tx += x, ty += y, tz += z;
                weakest = limit[entry] < weakest ? limit[entry] : weakest;
                mark[entry] = 0;
            }
            const failure_principal spans = failure_principal_of(cells_narrow(a));
            int held = REAL(0.5) * spans.third * inv_volume[e] > support[e];
            if (held) {
                inverse = cells_inverse(a);
                held = !(cells_stiffness(inverse, squares, tx, ty, tz) > stiffest[e]);
            }
            if (!held) inverse = (cells_sym){0, 0, 0, 0, 0, 0};
            cells_put(inv_shape, e, inverse);
            int count = 0;
            for (int slot = row_start[e / C]; !held && slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C;
                if (!(alive[entry] > 0)) continue;
                mark[entry] = CELLS_DETACHED;
                measure[entry] = 0;
                if (touched[neighbour[entry]] == 0) STORE_SAME(touched + neighbour[entry], 1);
                count += 1;
            }
            if (count) STORE_SAME(touched + e, 3);
            least[e] = weakest;
        }
    }
}

/* The energy that the bonds of this step release, by their weights: per_weight [J/weight] is that of one side; list
 * [n]: the elements that lost some, whose weights are 0 afterwards, and which are touched no longer. lost [J]: of every
 * element. */
KERNEL void cells_share(int n, int step, state per_weight, OWN(int) list, OWN(int) row_start, OWN(int) break_step,
                        PUT(int) touched, UPDATE(state) weight, UPDATE(coeff) break_energy, UPDATE(state) lost)
{
    FOR_EACH_ITEM(k, n) {
        const int e = list[k];
        touched[e] = 0;
        if (weight[e] > 0) {
            lost[e] += per_weight * weight[e];
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + e % C;
                if (break_step[entry] == step) break_energy[entry] *= (coeff)(STATE(2) * per_weight);
            }
            weight[e] = 0;
        }
    }
}
