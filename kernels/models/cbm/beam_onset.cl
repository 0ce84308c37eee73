/* Where beams begin to open (cbm; docs/notebook/fracture.md "Fracture energy of beams"); arrays as in
 * beam_softening.cl.
 *
 * A beam of an interface (its normal: `plane`, fracture.cl). Sides that part by s along d load a beam of the stiffness
 * k K by s k sqrt(K), K = kappa + (1 - kappa) (e.d)^2 with kappa = k_m / k (beam_carried.h), so that it pulls back with
 * s k K. Over the beams across a plane of an isotropic packing, which cross it as |cos|, the mean of K is kappa + (1 -
 * kappa) (1 + (d.n)^2) / 4, that of |cos| 2/3. With b = 2/3 over that mean a beam's part of the plane is b sqrt(K) of
 * its capacity and b K of G_c times its area: together they bear the strength times the plane's area, cost G_c times
 * it, and all end at the same opening of the sides. d: of the mean traction on the plane, pushes left out; where it is
 * less than the largest pull, by which the interface fails, their parts are less by that. A beam opens where its
 * element's mean has come to the interface's strength (fracture_pick_of), at what it carries, so that what the beams
 * bear then is that mean; beside open beams at its part; and wherever it carries three times that, since the last beams
 * of a crack turn the means. */

/* A beam opens where its pull (beam_pull) is above `opens` of its capacity, and starts to fall at what it carries, at
 * `least` of its capacity at least; tilt: share of its energy that it costs. One that its element chose (mode; 0: none)
 * is left to break at once where it holds as much as its opening would take, and where the element fails by
 * compression. */
ROUTINE int beam_opens(UPDATE(coeff) crack, brc_size entry, coeff y, coeff k, coeff pull, coeff opens, coeff least,
                       coeff tilt, int mode)
{
    const coeff energy = BEAM_NUMBER(entry, ENERGY) * tilt, capacity = BEAM_NUMBER(entry, CAPACITY);
    const coeff carried = SQRT(REAL(2) * k * (y > 0 ? y : 0)),
                start = carried > least * capacity ? carried : least * capacity;
    if (!(energy > 0) || !(start > 0)) return 0;
    if (mode ? mode == FAILURE_COMPRESSION || !(REAL(2) * k * energy > start * start)
             : !(pull > opens * capacity && capacity > 0))
        return 0;
    BEAM_NUMBER(entry, START) = start;
    BEAM_NUMBER(entry, TILT) = tilt;
    BEAM_NUMBER(entry, SPENT) = 0, BEAM_NUMBER(entry, BOOKED) = 0; /* normals in checkpoints of before */
    BEAM_NUMBER(entry, HELD) = y > 0 ? y : 0;
    return 1;
}

/* Of an axis in the present body what it was in the undeformed one. */
LAW soft_vector beam_back(GATHER(state) orientation, int e, failure_axis a)
{
    const failure_axis back = fracture_turn(orientation, e, 1, a);
    return (soft_vector){back.x, back.y, back.z};
}

/* An interface's crack slides where the largest pull stands further from its normal: cos 30 degrees. */
#define BEAM_ASKEW REAL(0.8660254037844386)

/* lateral: what the body stretches across the pushes along a crack, nu / E of them [-]; part, tilt: of a
 * beam in an interface. */
typedef struct {
    coeff lateral, part, tilt;
} beam_laid;

/* Part and tilt of the beam e whose sides part along `way`, normal of the interface `plane`, kappa = k_m / k. */
LAW beam_laid beam_share(soft_vector beam, soft_vector way, soft_vector plane, coeff kappa)
{
    const coeff per = REAL(1) / (soft_dot(way, way) + REAL(1e-30)), along = soft_dot(way, beam),
                straight = soft_dot(way, plane);
    const coeff stiff = kappa + (REAL(1) - kappa) * along * along * per,
                mean = kappa + (REAL(1) - kappa) * (REAL(0.25) + REAL(0.25) * straight * straight * per),
                more = REAL(2) / (REAL(3) * mean);
    return (beam_laid){0, more * SQRT(stiff), more * stiff};
}

/* How a crack across the largest principal value of the mean stress of element e (of_e), j (of_j) or both lies to the
 * beam between them, the others along it; or one along the interface of this normal that the beam crosses, 0: none. */
ROUTINE beam_laid beam_lay(UPDATE(coeff) crack, brc_size entry, int e, int j, int slot, int of_e, int of_j, int level,
                           failure_axis normal, coeff kappa, GATHER(int) row_start, GATHER(int) neighbour,
                           OWN(coeff) branch, OWN(coeff) inv_length, GATHER(state) orientation, GATHER(coeff) record)
{
    const failure_stress own = fracture_mean_of(e, level, row_start, neighbour, record),
                         theirs = fracture_mean_of(j, level, row_start, neighbour, record);
    const coeff part = of_e && of_j ? REAL(0.5) : REAL(1), p = of_e ? part : 0, q = of_j ? part : 0;
    const failure_stress mean = {p * own.xx + q * theirs.xx, p * own.yy + q * theirs.yy, p * own.zz + q * theirs.zz,
                                 p * own.yz + q * theirs.yz, p * own.xz + q * theirs.xz, p * own.xy + q * theirs.xy};
    const failure_principal principal = failure_principal_of(mean);
    const coeff second_push = principal.second < 0 ? -principal.second : 0,
                third_push = principal.third < 0 ? -principal.third : 0;
    const soft_vector pulled = beam_back(orientation, e, principal.first_axis),
                      pressed = beam_back(orientation, e, principal.third_axis), plane = {normal.x, normal.y, normal.z};
    const coeff straight = soft_dot(pulled, plane), least = soft_dot(pressed, plane);
    const int slides = soft_dot(plane, plane) > 0 && straight * straight < BEAM_ASKEW * BEAM_ASKEW;
    const int lies = soft_dot(plane, plane) > 0; /* its sides are known */
    const soft_vector axis = slides ? plane : soft_scale(lies && straight < 0 ? REAL(-1) : REAL(1), pulled);
    GLOBAL const coeff *r = branch + (brc_size)slot * 3 * C + e % C;
    const soft_vector beam = soft_scale(inv_length[entry], (soft_vector){r[0], r[C], r[2 * C]});
    const coeff cosine = soft_dot(axis, beam), sign = cosine < 0 && !lies ? REAL(-1) : REAL(1),
                c = sign * cosine > 0 ? sign * cosine : 0;
    soft_vector side = soft_add(soft_scale(sign, axis), -sign * cosine, beam);
    const coeff s = SQRT(soft_dot(side, side)), leans = REAL(4) * s * s;
    side = s > REAL(1e-6) ? side
                          : soft_add(pressed, -soft_dot(pressed, beam),
                                     beam); /* along the axis nothing of it is kept: any will do */
    side = soft_scale(REAL(1) / SQRT(soft_dot(side, side)), side);
    const soft_vector other = {beam.y * side.z - beam.z * side.y, beam.z * side.x - beam.x * side.z,
                               beam.x * side.y - beam.y * side.x};
    const soft_vector along = soft_add(soft_scale(s, beam), -c, side);
    coeff x = soft_dot(pressed, along), y = soft_dot(pressed, other);
    const coeff size = SQRT(x * x + y * y), per = (x < 0 ? REAL(-1) : REAL(1)) / (size > REAL(1e-6) ? size : REAL(1));
    x = size > REAL(1e-6) ? per * x : REAL(1), y = size > REAL(1e-6) ? per * y : 0;
    BEAM_NUMBER(entry, SIDE) = side.x;
    BEAM_COMPONENT(entry, BEAM_SIDE + 1) = side.y, BEAM_COMPONENT(entry, BEAM_SIDE + 2) = side.z;
    BEAM_NUMBER(entry, ALONG) = c < 1 ? c : REAL(1);
    BEAM_NUMBER(entry, COSINE) = slides ? REAL(-1) : x, BEAM_NUMBER(entry, SINE) = slides ? 0 : y;
    /* Where nothing presses the axes of neighbouring beams scatter, and sides that only open would lean on each other:
     * nothing is kept along the crack. */
    const coeff presses = third_push < principal.first ? third_push / principal.first : REAL(1);
    BEAM_NUMBER(entry, KEEPS) = slides ? REAL(1) : presses * presses * (leans < 1 ? leans : REAL(1));
    /* The traction on the plane, without its push. */
    const soft_vector between = soft_add(soft_add(plane, -straight, pulled), -least, pressed);
    soft_vector way = soft_add(soft_add(soft_scale(principal.second, between), principal.first * straight, pulled),
                               principal.third * least, pressed);
    const coeff push = soft_dot(way, plane);
    way = push < 0 ? soft_add(way, -push, plane) : way;
    beam_laid laid = beam_share(beam, slides ? way : pulled, plane, kappa);
    /* The element fails by its largest pull, of which the plane sees |way|. */
    const coeff seen = slides ? SQRT(soft_dot(way, way)) / failure_larger(principal.first, REAL(1e-30)) : REAL(1);
    laid.part *= seen < REAL(2) ? seen : REAL(2);
    laid.lateral = slides ? 0 : REAL(2) * BEAM_NUMBER(entry, LATERAL) * (second_push + third_push);
    return laid;
}

/* Which side of a whole bond looks at it: that with the lower id where its element chose it or has open beams, else the
 * other where that has; in an interface always the first. */
LAW int beam_looks(OWN(int) neighbour, OWN(int) lead, OWN(int) open, GATHER(int) touched, GATHER(int) choice, int e,
                   brc_size entry)
{
    const int dies = fracture_dies(neighbour, choice, e, entry);
    if (neighbour[entry] == e) return 0;
    const int looks = lead[entry] & BEAM_JOINED  ? lead[entry] & BEAM_LEADS
                      : lead[entry] & BEAM_LEADS ? dies || touched[e]
                                                 : !dies && touched[e] && !touched[neighbour[entry]];
    return looks && open[entry] == BEAM_WHOLE; /* in this order: the side that looks writes both */
}

/* A beam of an interface opens by itself at its part of the capacity beside open beams, at three times that elsewhere;
 * chosen by its element it starts to fall at no less than half of it, so that its cohesion ends at no more than twice
 * the opening of the others. */
#define BEAM_ALONE REAL(3)
#define BEAM_FLOOR REAL(0.5)
LAW coeff beam_alone(GATHER(int) touched, int e, int j) { return touched[e] || touched[j] ? REAL(1) : BEAM_ALONE; }

/* Of a whole beam of an interface: below this share of its capacity nobody asks for its part [-]. Parts change slowly,
 * so it is a little below the last, START; each BEAM_TURNS steps what no part is below, b sqrt(kappa), that of a beam
 * across sides that part along the normal. */
#define BEAM_TURNS 32
LAW coeff beam_least(OWN(coeff) crack, brc_size entry, int step, coeff kappa)
{
    const coeff last = BEAM_NUMBER(entry, START);
    return last > 0 && step % BEAM_TURNS ? REAL(0.9) * last : REAL(4) * SQRT(kappa) / (REAL(3) + REAL(3) * kappa);
}

/* Of a beam that begins to open, at both ends. stress: of the element that failed [Pa], 0: its own. */
ROUTINE void beam_opened(SCATTER(int) open, SCATTER(coeff) crack, SCATTER(coeff) factor, brc_size at, brc_size to,
                         coeff stress, int mode)
{
    open[at] = BEAM_OPENS, open[to] = BEAM_OPENS;
    factor[at] = BEAM_NEVER, factor[to] = BEAM_NEVER;
    BEAM_NUMBER(at, ONSET) = stress > 0 ? stress : BEAM_NUMBER(at, START) * BEAM_NUMBER(at, PER_AREA);
    BEAM_NUMBER(at, MODE) = (coeff)mode;
    for (int what = BEAM_START; what < BEAM_WIDTH; ++what) { /* beam_lean */
        const coeff sign = (what >= BEAM_SIDE && what < BEAM_ALONG) || what == BEAM_SINE ? REAL(-1) : REAL(1);
        BEAM_COMPONENT(to, (brc_size)what) = sign * BEAM_COMPONENT(at, (brc_size)what);
    }
}

/* k_m / k of a beam. */
LAW lane beam_kappa(cbm_bond bond)
{
    return REAL(6) * bond.stiffness.bend * bond.inv_length0 * bond.inv_length0 / bond.stiffness.axial;
}

/* What opens a beam [N]: beam_pull; along an interface all that a slide would take of it, the root of its energy y. */
LAW lane beam_pulled(cbm_bond bond, lane_vec3 axis0, cbm_own own, lane_quat q_j, beam_lean lean, lane stretch, lane y)
{
    const lane across =
        beam_pull(bond.shape, bond.inv_length0, bond.stiffness, axis0, own.orientation, q_j, lean, stretch);
    const lane slide = LANE_SQRT(REAL(2) * bond.stiffness.axial * bond.inv_length0 * soft_above(y, 0));
    return across + beam_slides(lean) * (slide - across);
}

/* After the elements chose: chosen beams open, as far as they can; whole beams of elements with open ones, at their
 * capacity: what bridges a crack stands between elements whose mean stress no longer sees it; and beams of interfaces,
 * at their part of it. */
KERNEL void beam_soft_begin(int n_groups, int step, int level, coeff steepest, GATHER(int) row_start,
                            GATHER(int) neighbour, OWN(int) twin, OWN(int) lead, OWN(coeff) branch,
                            OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                            coeff bend, coeff twist, GATHER(coeff) beam_of, OWN(int) mark, GATHER(int) choice,
                            GATHER(coeff) measure, GATHER(coeff) record, OWN(coeff) plane, GATHER(int) touched,
                            OWN(int) active, FLAG(int) raised, SCATTER(int) open, SCATTER(coeff) crack,
                            SCATTER(coeff) factor)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), first = group * W, last = row_start[slice + 1];
        if (mark[group] == step || active[group]) {
            const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
            for (int slot = row_start[slice]; slot < last; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)lane0;
                int any = 0, some = 0;
                for (int l = 0; l < W; ++l)
                    any |= beam_looks(neighbour, lead, open, touched, choice, first + l, entry + (brc_size)l);
                if (!any) continue;
                const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement,
                                                  orientation, axial, bend, twist, beam_of, 1);
                const lane k = bond.stiffness.axial * bond.inv_length0,
                           whole = cbm_beam_energy(bond.shape, bond.inv_length0, bond.stiffness, 1),
                           kappa = beam_kappa(bond);
                beam_laid laid[W];
#define LAY(l)                                                                                                         \
    {                                                                                                                  \
        const brc_size at = entry + 0x##l;                                                                             \
        const int e = first + 0x##l, j = neighbour[at], dies = fracture_dies(neighbour, choice, e, at),                \
                  own_choice = choice[e] >= 0 && choice[e] / 4 == j, joined = lead[at] & BEAM_JOINED;                  \
        const coeff capacity =                                                                                         \
            BEAM_NUMBER(at, CAPACITY) *                                                                                \
            (joined ? beam_alone(touched, e, j) * beam_least(crack, at, step, LANE_ITEM(kappa, l)) : REAL(1));         \
        laid[0x##l] = (beam_laid){0, BEAM_NEVER, 0};                                                                   \
        if (beam_looks(neighbour, lead, open, touched, choice, e, at) &&                                               \
            (dies || REAL(2) * LANE_ITEM(k, l) * LANE_ITEM(whole, l) > capacity * capacity)) {                         \
            laid[0x##l] =                                                                                              \
                beam_lay(crack, at, e, j, slot, !dies || own_choice, !dies || !own_choice, level,                      \
                         joined ? fracture_plane_of(plane, slot, e) : (failure_axis){0, 0, 0}, LANE_ITEM(kappa, l),    \
                         row_start, neighbour, branch, inv_length, orientation, record);                               \
            if (joined) BEAM_NUMBER(at, START) = laid[0x##l].part;                                                     \
            some = 1;                                                                                                  \
        }                                                                                                              \
    }
                LANE_EACH(LAY)
#undef LAY
                if (!some) continue; /* a beam's pull is not above the root of its energy */
                const lane_quat q_j = lane_gather4(orientation, int_block(neighbour, slot, lane0));
                const beam_lean lean = beam_lean_at(crack, slot, lane0);
                const lane_vec3 axis0 = lane_vec3_scale(bond.inv_length0, lane_block3(branch, slot, lane0));
                const beam_part part = beam_part_of(bond, axis0, own, q_j, lean);
#define LATERAL(l) laid[0x##l].lateral
                const lane stretch = LANE_MAKE(lane, LATERAL);
#undef LATERAL
                const lane y = part.energy, cosine = lane_max(beam_cosine(bond), LANE_ZERO + steepest),
                           pull = beam_pulled(bond, axis0, own, q_j, lean, stretch, y);
#define BEGIN(l)                                                                                                       \
    {                                                                                                                  \
        const brc_size at = entry + 0x##l;                                                                             \
        const int e = first + 0x##l, j = neighbour[at], dies = fracture_dies(neighbour, choice, e, at),                \
                  joined = lead[at] & BEAM_JOINED;                                                                     \
        if (beam_looks(neighbour, lead, open, touched, choice, e, at)) {                                               \
            const int by = choice[e] >= 0 && choice[e] / 4 == j ? e : j, mode = dies ? choice[by] % 4 : 0;             \
            const coeff share = joined ? laid[0x##l].part : REAL(1),                                                   \
                        opens = joined ? share * beam_alone(touched, e, j) : share,                                    \
                        least = joined && mode ? share * BEAM_FLOOR : share;                                           \
            if (beam_opens(crack, at, LANE_ITEM(y, l), LANE_ITEM(k, l), LANE_ITEM(pull, l), opens, least,              \
                           joined ? laid[0x##l].tilt : LANE_ITEM(cosine, l), mode)) {                                  \
                beam_opened(open, crack, factor, at, (brc_size)twin[at], dies ? measure[by] : 0,                       \
                            dies ? mode : FAILURE_TENSION);                                                            \
                STORE_SAME(raised + group, 1);                                                                         \
                STORE_SAME(raised + j / W, 1);                                                                         \
            }                                                                                                          \
        }                                                                                                              \
    }
                LANE_EACH(BEGIN)
#undef BEGIN
            }
        }
    }
}

/* Groups and elements with beams that opened are active and touched; choices of beams that opened are no longer
 * choices. */
KERNEL void beam_soft_keep(int n_groups, int step, OWN(int) row_start, OWN(int) neighbour, OWN(int) mark,
                           OWN(int) raised, UPDATE(int) active, OWN(int) open, UPDATE(int) choice, PUT(int) touched)
{
    FOR_EACH_ITEM(group, n_groups) {
        if (raised[group]) active[group] = 1;
        for (int e = group * W; (mark[group] == step || active[group]) && e < (group + 1) * W; ++e) {
            const int chosen = choice[e];
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = (brc_size)slot * C + (brc_size)(e % C);
                if (open[entry] != BEAM_WHOLE) touched[e] = 1;
                if (open[entry] == BEAM_OPENS && chosen >= 0 && neighbour[entry] == chosen / 4) choice[e] = -1;
            }
        }
    }
}
#undef BEAM_NUMBER
