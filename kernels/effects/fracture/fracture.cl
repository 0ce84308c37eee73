/* Fracture of cbm (NAH19 section 2.2): forces with the virial, elements that fail by its mean over neighbours and the
 * bond each loses, and what goes with a lost bond: fracture_force, fracture_check, fracture_break in every step. Each
 * writes arrays of its own element only, but for `mark`.
 *
 * A bond that broke becomes padding: its entry points home and its inverse length is 0, so that elastic passes need to
 * know nothing. record [slice][8][C]: sum over the beams of an element of the symmetric part of x_ij (x) f_ij, xx yy zz
 * yz xz xy [J]; twice its volume with its share of the voids [m^3]; one over that. choice [n]: 4 * (row of the
 * neighbour that loses the bond) + mode of failure, or -1. mark [n / W]: the last step in which a bond of the group was
 * chosen; the host counts steps from 1. stress_bound [n]: upper bound of the element's own ratio of failure by the
 * smallest limits of all, times record's volume [m^3] (failure_bound.h). weight [n]: volume of record over the element
 * and its neighbours [m^3]; limit_margin [n]: how much farther than the smallest its own limits are, times its weakest
 * factor, a little less [-]. While the sum of stress_bound over the members is below limit_margin times weight the
 * element cannot fail. near [n / W]: the last step in which some member of an element of the group had by itself a
 * bound of near_margin [n] or more, the smallest limit_margin of that member and its neighbours [-]: without one the
 * mean is below it too. factor [slot][C], weakest [n]: of the strength of each bond, and the smallest of those that are
 * left to an element; only read if weighted. plane [slot][3][C]: the normal of the interface that a bond lies in, out
 * of the own element, in the undeformed body, else 0; only read if joined; turned [n][4]: orientations of the elements;
 * only read if it has FRACTURE_TURNS. */

#define RECORD 8
/* Component 0 of a row or of a lane of rows; the next are C further on. */
#define RECORD_OF(row) ((row) / C * (RECORD * C) + (row) % C)

/* A group's sums of x (x) f, and how near to failure they are. */
LAW void fracture_put_record(int group, lane_sym3 virial, failure_scale scale, UPDATE(coeff) record,
                             PUT(coeff) stress_bound)
{
    const brc_size to = (brc_size)SLICE_OF(group) * RECORD * C + (brc_size)FIRST_LANE_OF(group);
    lane_store(record, to, virial.xx);
    lane_store(record, to + C, virial.yy);
    lane_store(record, to + 2 * C, virial.zz);
    lane_store(record, to + 3 * C, virial.yz);
    lane_store(record, to + 4 * C, virial.xz);
    lane_store(record, to + 5 * C, virial.xy);
    const lane volume = lane_load(record, to + 6 * C), inverse = lane_load(record, to + 7 * C);
    const lane_sym3 stress = {inverse * virial.xx, inverse * virial.yy, inverse * virial.zz,
                              inverse * virial.yz, inverse * virial.xz, inverse * virial.xy};
    const lane bound = volume * failure_bound(stress, scale);
    lane_store(stress_bound, (brc_size)(group * W), bound);
}

/* Mean stress of a group's elements over themselves (level 0) or with their neighbours over unbroken bonds (level
 * 1). */
LAW lane_sym3 fracture_mean(int group, int level, OWN(int) row_start, OWN(int) neighbour, GATHER(coeff) record)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
    const lane_int own = lane_own(group * W);
    lane sum[7];
    for (int c = 0; c < 7; ++c) sum[c] = lane_block(record, slice, RECORD, c, lane0);
    for (int slot = row_start[slice]; level > 0 && slot < row_start[slice + 1]; ++slot) {
        const lane_int j = int_block(neighbour, slot, lane0);
        const lane whole = LANE_DIFFERENT(j, own);
        const lane_int at = RECORD_OF(j);
        for (int c = 0; c < 7; ++c) sum[c] += whole * gather_component(record + c * C, at);
    }
    const lane inverse = REAL(1) / sum[6];
    return (lane_sym3){inverse * sum[0], inverse * sum[1], inverse * sum[2],
                       inverse * sum[3], inverse * sum[4], inverse * sum[5]};
}

/* Stress of every element [n][6]; level 0 or 1. */
KERNEL void fracture_stress(int n_groups, int level, OWN(int) row_start, OWN(int) neighbour, GATHER(coeff) record,
                            PUT(coeff) stress)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_sym3 mean = fracture_mean(group, level, row_start, neighbour, record);
        lane_store6(stress, group * W, mean);
    }
}

/* Level 2: the neighbours' neighbours too, each element once. SECOND_SHELL: places of the table that knows who was
 * counted; the host refuses samples with elements that have more members. */
#define SECOND_SHELL 512
KERNEL void fracture_stress_second(int n_rows, GATHER(int) row_start, GATHER(int) neighbour, GATHER(coeff) record,
                                   PUT(coeff) stress)
{
    FOR_EACH_ITEM(e, n_rows) {
        int seen[SECOND_SHELL];
        coeff sum[7];
        for (int k = 0; k < SECOND_SHELL; ++k) seen[k] = -1;
        seen[e % SECOND_SHELL] = e;
        for (int c = 0; c < 7; ++c) sum[c] = record[RECORD_OF(e) + c * C];
        for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
            const int j = neighbour[(brc_size)slot * C + e % C];
            if (j == e) continue;
            for (int next = row_start[j / C] - 1; next < row_start[j / C + 1];
                 ++next) { /* first j itself, then its neighbours */
                const int k = next < row_start[j / C] ? j : neighbour[(brc_size)next * C + j % C];
                int place = k % SECOND_SHELL;
                while (seen[place] != -1 && seen[place] != k) place = (place + 1) % SECOND_SHELL;
                if (seen[place] == k) continue;
                seen[place] = k;
                for (int c = 0; c < 7; ++c) sum[c] += record[RECORD_OF(k) + c * C];
            }
        }
        for (int c = 0; c < 6; ++c) stress[(brc_size)e * 6 + c] = sum[c] / sum[6];
    }
}

LAW failure_stress fracture_stress_of(OWN(coeff) stress, int e)
{
    GLOBAL const coeff *s = stress + (brc_size)e * 6;
    return (failure_stress){s[0], s[1], s[2], s[3], s[4], s[5]};
}
/* limits [n][3]: tension, compression, shear [Pa]. */
LAW failure_limits fracture_limits_of(OWN(coeff) limits, int e)
{
    GLOBAL const coeff *l = limits + (brc_size)e * 3;
    return (failure_limits){l[0], l[1], l[2]};
}

/* x_j - x_i of a bond now [m]. */
LAW failure_axis fracture_branch_of(int e, int j, int slot, OWN(coeff) branch, GATHER(state) displacement)
{
    GLOBAL const coeff *r = branch + (brc_size)slot * 3 * C + e % C;
    GLOBAL const state *from = displacement + (brc_size)e * 3, *to = displacement + (brc_size)j * 3;
    return (failure_axis){r[0] + (coeff)(to[0] - from[0]), r[C] + (coeff)(to[1] - from[1]),
                          r[2 * C] + (coeff)(to[2] - from[2])};
}

/* The bond that an element would lose, and what the ratio of its stress counts there. */
typedef struct {
    int other;  /* row of the neighbour, -1: none is left */
    coeff gain; /* [-] */
} fracture_pick;

/* `a` turned with element e: a + 2 w v x a + 2 v x (v x a); back: against it. */
ROUTINE failure_axis fracture_turn(OWN(state) turned, int e, int back, failure_axis a)
{
    GLOBAL const state *q = turned + (brc_size)e * 4;
    const coeff w = (coeff)q[0], x = (coeff)q[1], y = (coeff)q[2], z = (coeff)q[3], k = (back ? REAL(-2) : REAL(2)) * w;
    const failure_axis once = {y * a.z - z * a.y, z * a.x - x * a.z, x * a.y - y * a.x};
    const failure_axis twice = {y * once.z - z * once.y, z * once.x - x * once.z, x * once.y - y * once.x};
    return (failure_axis){a.x + k * once.x + REAL(2) * twice.x, a.y + k * once.y + REAL(2) * twice.y,
                          a.z + k * once.z + REAL(2) * twice.z};
}

/* Normal of the interface that a bond lies in [-]; 0: in none. */
LAW failure_axis fracture_plane_of(OWN(coeff) plane, int slot, int e)
{
    GLOBAL const coeff *n = plane + (brc_size)slot * 3 * C + e % C;
    return (failure_axis){n[0], n[C], n[2 * C]};
}
LAW int fracture_lies(failure_axis n) { return n.x * n.x + n.y * n.y + n.z * n.z > 0; }

/* In joined: normals of interfaces turn with elements, which have orientations. */
#define FRACTURE_TURNS 2
/* cos 60 degrees: an interface fails by a direction of failure that stands no farther from its normal. */
#define FRACTURE_ACROSS REAL(0.5)

/* The bond with the largest |cos| to the direction of failure over its factor, the first of equals. gain: that over the
 * largest |cos| of all: the element fails when ratio times gain is 1, so a bond of factor f in the direction of failure
 * goes at f times the limit, and one farther off at as much more as its |cos| is smaller. Without factors the nearest
 * bond, and gain is 1. A bond in an interface goes at f times the limit however it stands to the direction of failure,
 * as long as the interface's normal stands within 60 degrees of it; of some alike the nearest. */
LAW fracture_pick fracture_pick_of(int e, failure_state failed, int weighted, int joined, OWN(int) row_start,
                                   OWN(int) neighbour, OWN(coeff) branch, GATHER(state) displacement, OWN(coeff) factor,
                                   OWN(coeff) plane, OWN(state) turned)
{
    coeff best = REAL(-1), nearest = REAL(-1), weak = 0, weak_aligned = REAL(-1);
    int other = -1, across = -1;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + e % C;
        const int j = neighbour[entry];
        if (j == e) continue;
        const failure_axis x = fracture_branch_of(e, j, slot, branch, displacement);
        const coeff aligned = failure_alignment(failed, x, REAL(1) / SQRT(x.x * x.x + x.y * x.y + x.z * x.z));
        const coeff inverse = weighted ? REAL(1) / factor[entry] : REAL(1);
        const failure_axis n = joined ? fracture_plane_of(plane, slot, e) : (failure_axis){0, 0, 0};
        nearest = failure_larger(nearest, aligned);
        if (fracture_lies(n)) {
            const failure_axis now = joined & FRACTURE_TURNS ? fracture_turn(turned, e, 0, n) : n;
            if (failure_alignment(failed, now, REAL(1)) < FRACTURE_ACROSS) continue;
            if (!(inverse > weak || (inverse == weak && aligned > weak_aligned))) continue;
            weak = inverse, weak_aligned = aligned, across = j;
            continue;
        }
        const coeff counts = weighted ? aligned / factor[entry] : aligned;
        if (!(counts > best)) continue;
        best = counts;
        other = j;
    }
    const coeff gain = other < 0 ? 0 : nearest > 0 ? best / nearest : REAL(1);
    return across >= 0 && weak >= gain ? (fracture_pick){across, weak} : (fracture_pick){other, gain};
}

/* 1: of an element whose bonds are of different strength and which only tension can fail, none of them can go, shown
 * without principal values; 0: they have to be asked. Ratio times |cos| over factor must reach the largest |cos| of all
 * (fracture_pick): bonds with a factor above the ratio cannot, and of the others one that lies nearer to the axis than
 * theirs allow is enough. Most elements that wait with a weak bond across the pull are let off here. Room for rounding
 * as in failure_possible. */
LAW int fracture_spared(int e, failure_stress s, coeff tension, int joined, OWN(int) row_start, OWN(int) neighbour,
                        OWN(coeff) branch, GATHER(state) displacement, OWN(coeff) factor, OWN(coeff) plane)
{
    const failure_leading lead = failure_leading_of(s);
    const coeff most = REAL(1.001) * lead.first / tension;
    coeff needed = REAL(-1);
    if (!lead.known) return 0;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + e % C;
        const int j = neighbour[entry];
        if (j == e || factor[entry] > most) continue;
        if (joined && fracture_lies(fracture_plane_of(plane, slot, e))) return 0;
        const failure_axis x = fracture_branch_of(e, j, slot, branch, displacement);
        const coeff times = most / factor[entry];
        const coeff share =
            times * times *
            (failure_leading_share(lead, x, REAL(1) / (x.x * x.x + x.y * x.y + x.z * x.z)) + lead.slack);
        needed = failure_larger(needed, share + lead.slack);
    }
    if (needed < 0) return 1;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const int j = neighbour[(brc_size)slot * C + e % C];
        if (j == e) continue;
        const failure_axis x = fracture_branch_of(e, j, slot, branch, displacement);
        if (failure_leading_share(lead, x, REAL(1) / (x.x * x.x + x.y * x.y + x.z * x.z)) > needed) return 1;
    }
    return 0;
}

/* An element at a limit chooses a bond; measure: its stress then [Pa]. */
LAW void fracture_choose_of(int e, int step, failure_stress s, failure_shear shear, int weighted, int joined,
                            OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, GATHER(state) displacement,
                            OWN(coeff) limits, OWN(coeff) factor, OWN(coeff) weakest, OWN(coeff) plane,
                            OWN(state) turned, PUT(int) choice, PUT(coeff) measure, SCATTER(int) mark)
{
    const failure_limits limit = fracture_limits_of(limits, e);
    const coeff least = weighted ? weakest[e] : REAL(1);
    const failure_limits reachable = {least * limit.tension, least * limit.compression, least * limit.shear};
    if (!failure_possible(s, reachable, shear)) return;
    if (weighted && limit.tension > 0) {
        const failure_limits others = {0, reachable.compression, reachable.shear};
        if (!failure_possible(s, others, shear) &&
            fracture_spared(e, s, limit.tension, joined, row_start, neighbour, branch, displacement, factor, plane))
            return;
    }
    const failure_principal p = failure_principal_of(s);
    const failure_state failed = failure_of(p, limit, shear);
    if (!(failed.ratio >= least)) return;
    const fracture_pick pick = fracture_pick_of(e, failed, weighted, joined, row_start, neighbour, branch, displacement,
                                                factor, plane, turned);
    if (pick.other < 0 || !(failed.ratio * pick.gain >= REAL(1))) return;
    choice[e] = 4 * pick.other + failed.mode;
    measure[e] = failed.stress;
    STORE_SAME(mark + e / W, step);
    STORE_SAME(mark + pick.other / W, step);
}

/* fracture_mean of one element, to the last bit. */
LAW failure_stress fracture_mean_of(int e, int level, GATHER(int) row_start, GATHER(int) neighbour,
                                    GATHER(coeff) record)
{
    coeff sum[7];
    for (int c = 0; c < 7; ++c) sum[c] = record[RECORD_OF(e) + c * C];
    for (int slot = row_start[e / C]; level > 0 && slot < row_start[e / C + 1]; ++slot) {
        const int j = neighbour[(brc_size)slot * C + e % C];
        for (int c = 0; j != e && c < 7; ++c) sum[c] += record[RECORD_OF(j) + c * C];
    }
    const coeff inverse = REAL(1) / sum[6];
    return (failure_stress){inverse * sum[0], inverse * sum[1], inverse * sum[2],
                            inverse * sum[3], inverse * sum[4], inverse * sum[5]};
}

/* Before the next pass, level 1: which groups it has to look at. */
KERNEL void fracture_near(int n_groups, int step, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) record,
                          OWN(coeff) stress_bound, OWN(coeff) near_margin, SCATTER(int) near)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        const lane reaches = lane_load(near_margin, (brc_size)first) * lane_block(record, slice, RECORD, 6, lane0);
        if (LANE_SOME(~LANE_LESS(lane_load(stress_bound, (brc_size)first), reaches))) {
            STORE_SAME(near + group, step);
            for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot)
                for (int l = 0; l < W; ++l)
                    STORE_SAME(near + neighbour[(brc_size)slot * C + (brc_size)(lane0 + l)] / W, step);
        }
    }
}

/* Levels 0 and 1: what each element loses. Only elements which the bound lets fail look at stresses: few of a group
 * do. screened: fracture_near has marked this step's groups, all others are passed by. */
KERNEL void fracture_check(int n_groups, int level, int step, int screened, int drucker_prager, coeff slope,
                           coeff friction, int weighted, int joined, OWN(int) row_start, OWN(int) neighbour,
                           OWN(coeff) branch, GATHER(state) displacement, OWN(coeff) limits, OWN(coeff) factor,
                           OWN(coeff) weakest, OWN(coeff) plane, OWN(state) turned, GATHER(coeff) record,
                           GATHER(coeff) stress_bound, OWN(coeff) limit_margin, OWN(coeff) weight, OWN(int) near,
                           PUT(int) choice, PUT(coeff) measure, SCATTER(int) mark)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W, last = row_start[slice + 1];
        const int looks = !screened || near[group] == step;
        for (int l = 0; l < W; ++l) choice[first + l] = -1;
        lane sum = lane_load(stress_bound, (brc_size)first);
        for (int slot = row_start[slice]; level > 0 && looks && slot < last;
             ++slot) /* what points home adds the element's own: it is no less a bound */
            sum += gather_component(stress_bound, int_block(neighbour, slot, lane0));
        const lane room = lane_load(limit_margin, (brc_size)first) * lane_load(weight, (brc_size)first) - sum;
        const failure_shear shear = {drucker_prager, slope, friction};
        int look[W], any = 0;
#define LOOK(l) look[0x##l] = looks && !(LANE_ITEM(room, l) > 0), any |= look[0x##l];
        LANE_EACH(LOOK)
#undef LOOK
        for (int l = 0; any && l < W; ++l) {
            if (!look[l]) continue;
            const failure_stress s = fracture_mean_of(first + l, level, row_start, neighbour, record);
            fracture_choose_of(first + l, step, s, shear, weighted, joined, row_start, neighbour, branch, displacement,
                               limits, factor, weakest, plane, turned, choice, measure, mark);
        }
    }
}

/* The same from stresses [n][6]. */
KERNEL void fracture_choose(int n_rows, int step, int drucker_prager, coeff slope, coeff friction, int weighted,
                            int joined, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                            GATHER(state) displacement, OWN(coeff) limits, OWN(coeff) factor, OWN(coeff) weakest,
                            OWN(coeff) plane, OWN(state) turned, OWN(coeff) stress, PUT(int) choice, PUT(coeff) measure,
                            SCATTER(int) mark)
{
    FOR_EACH_ITEM(e, n_rows) {
        const failure_shear shear = {drucker_prager, slope, friction};
        const failure_stress s = fracture_stress_of(stress, e);
        choice[e] = -1;
        fracture_choose_of(e, step, s, shear, weighted, joined, row_start, neighbour, branch, displacement, limits,
                           factor, weakest, plane, turned, choice, measure, mark);
    }
}

/* How far every element is on its way to failure [n]. */
KERNEL void fracture_ratio(int n_rows, int drucker_prager, coeff slope, coeff friction, int weighted, int joined,
                           OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, GATHER(state) displacement,
                           OWN(coeff) limits, OWN(coeff) factor, OWN(coeff) plane, OWN(state) turned, OWN(coeff) stress,
                           PUT(coeff) ratio)
{
    FOR_EACH_ITEM(e, n_rows) {
        const failure_shear shear = {drucker_prager, slope, friction};
        const failure_stress s = fracture_stress_of(stress, e);
        const failure_limits limit = fracture_limits_of(limits, e);
        const failure_principal p = failure_principal_of(s);
        const failure_state failed = failure_of(p, limit, shear);
        coeff gain = REAL(1);
        if (weighted) {
            const fracture_pick pick = fracture_pick_of(e, failed, 1, joined, row_start, neighbour, branch,
                                                        displacement, factor, plane, turned);
            gain = pick.gain;
        }
        ratio[e] = failed.ratio * gain; /* of names: clang's target reading cannot map a member of a call's value */
    }
}

/* The bond of an entry is unbroken and chosen by one of its two elements. */
LAW int fracture_dies(OWN(int) neighbour, GATHER(int) choice, int e, brc_size entry)
{
    const int j = neighbour[entry], own = choice[e], other = choice[j];
    return j != e && ((own >= 0 && own / 4 == j) || (other >= 0 && other / 4 == e));
}

/* x = (x, y, z) of one element: force -= f, velocity += half_kick f / m. */
LAW void fracture_take(UPDATE(state) force, UPDATE(state) velocity, state mass, state half_kick, int e, coeff x,
                       coeff y, coeff z)
{
    const coeff part[3] = {x, y, z};
    for (int c = 0; c < 3; ++c) {
        force[(brc_size)e * 3 + c] -= part[c];
        velocity[(brc_size)e * 3 + c] += half_kick * part[c] / mass;
    }
}

/* Volume of an element and its neighbours over unbroken bonds [m^3]. */
LAW coeff fracture_weight(int e, OWN(int) row_start, OWN(int) neighbour, GATHER(coeff) record)
{
    coeff sum = record[RECORD_OF(e) + 6 * C];
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const int j = neighbour[(brc_size)slot * C + e % C];
        if (j != e) sum += record[RECORD_OF(j) + 6 * C];
    }
    return sum;
}

/* The weakest of the bonds that are left to an element decides how near to failure it may come. */
LAW void fracture_raise(int e, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) factor, UPDATE(coeff) weakest,
                        UPDATE(coeff) limit_margin)
{
    coeff least = REAL(-1);
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = (brc_size)slot * C + e % C;
        if (neighbour[entry] != e && (least < 0 || factor[entry] < least)) least = factor[entry];
    }
    if (!(least > weakest[e])) return;
    limit_margin[e] *= least / weakest[e];
    weakest[e] = least;
}

/* What a beam does to element i, and its energy [J]; only called with a constant `finite`. */
typedef struct {
    cbm_end end;
    lane energy;
} fracture_beam;
LAW fracture_beam fracture_beam_of(lane_vec3 branch, lane inverse, lane_vec3 jump, lane_quat q_i, lane_quat q_j,
                                   cbm_stiffness k, int finite)
{
    const cbm_shape shape = cbm_beam_shape(branch, inverse, jump, q_i, q_j, finite);
    return (fracture_beam){cbm_beam_law(shape, inverse, k, finite), cbm_beam_energy(shape, inverse, k, finite)};
}

/* Bonds chosen by either of their elements break. What they carried leaves the forces, which then are those of the step
 * to come; half_kick dt/2 gives the step that ends its share of them back (velocity Verlet closes with the old force
 * and opens with the new one), 0 none. Of every entry that breaks: step, stress [Pa] and mode of the element that chose
 * it (its own if both did), energy of the bond [J]. lost, broken [n]: half the energy and the number of bonds of each
 * element, added up. */
KERNEL void fracture_break(int n_groups, int level, int step, state half_kick, OWN(int) row_start,
                           UPDATE(int) neighbour, OWN(coeff) branch, UPDATE(coeff) inv_length, OWN(int) mark,
                           GATHER(coeff) record, PUT(coeff) weight, GATHER(int) choice, GATHER(coeff) measure,
                           GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                           GATHER(coeff) beam_of, int finite, OWN(state) mass, OWN(state) inertia, UPDATE(state) force,
                           UPDATE(state) torque, UPDATE(state) velocity, UPDATE(state) spin, PUT(int) break_step,
                           PUT(int) break_mode, PUT(coeff) break_stress, PUT(coeff) break_energy, UPDATE(state) lost,
                           UPDATE(state) broken, int weighted, OWN(coeff) factor, UPDATE(coeff) weakest,
                           UPDATE(coeff) limit_margin)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W;
        for (int slot = row_start[slice]; mark[group] == step && slot < row_start[slice + 1]; ++slot) {
            const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
            int any = 0;
            for (int l = 0; l < W; ++l) any |= fracture_dies(neighbour, choice, first + l, entry + l);
            if (!any) continue;
            const lane_int own = lane_own(first), j = int_block(neighbour, slot, lane0);
            const state_vec3 u = state_gather3(displacement, own);
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
            const lane inverse = lane_load(inv_length, entry);
            const cbm_stiffness k = cbm_stiffness_of(beam_of, own, j, axial, bend, twist);
            const fracture_beam beam =
                finite ? fracture_beam_of(lane_block3(branch, slot, lane0), inverse, jump,
                                          lane_gather4(orientation, own), lane_gather4(orientation, j), k, 1)
                       : fracture_beam_of(lane_block3(branch, slot, lane0), inverse, jump,
                                          lane_gather4(orientation, own), lane_gather4(orientation, j), k, 0);
            const cbm_end end = beam.end;
            const lane energy = beam.energy;
#define TAKE(l)                                                                                                        \
    if (fracture_dies(neighbour, choice, first + 0x##l, entry + 0x##l)) {                                              \
        const int e = first + 0x##l, other = neighbour[entry + 0x##l];                                                 \
        const int by = choice[e] >= 0 && choice[e] / 4 == other ? e : other;                                           \
        neighbour[entry + 0x##l] = e;                                                                                  \
        inv_length[entry + 0x##l] = 0;                                                                                 \
        if (level == 1) weight[e] = fracture_weight(e, row_start, neighbour, record);                                  \
        if (weighted) fracture_raise(e, row_start, neighbour, factor, weakest, limit_margin);                          \
        break_step[entry + 0x##l] = step;                                                                              \
        break_mode[entry + 0x##l] = choice[by] % 4;                                                                    \
        break_stress[entry + 0x##l] = measure[by];                                                                     \
        break_energy[entry + 0x##l] = LANE_ITEM(energy, l);                                                            \
        lost[e] += STATE(0.5) * (state)LANE_ITEM(energy, l);                                                           \
        broken[e] += 1;                                                                                                \
        fracture_take(force, velocity, mass[e], half_kick, e, LANE_ITEM(end.force.x, l), LANE_ITEM(end.force.y, l),    \
                      LANE_ITEM(end.force.z, l));                                                                      \
        fracture_take(torque, spin, inertia[e], half_kick, e, LANE_ITEM(end.torque.x, l), LANE_ITEM(end.torque.y, l),  \
                      LANE_ITEM(end.torque.z, l));                                                                     \
    }
            LANE_EACH(TAKE)
#undef TAKE
        }
    }
}
