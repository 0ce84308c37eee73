/* Forces of pairs of convex cells, and of cells on strikers: history and result as in contact.cl. Energy of a pair W =
 * k_n V^2 / (2 h^3), V the volume of the overlap in the present poses, so that the pressure p = k_n V / h^3 acts on the
 * area vector of the overlap and every force and moment is a gradient of W. h: harmonic mean of the cube roots of the
 * two volumes, that of the element alone at a striker; never more than both bear. A dashpot p_v = 2 b sqrt(m k_n / h^3)
 * dV/dt / |a| makes V a linear oscillator whenever V is a power of the depth: b alone decides the restitution. Others
 * than elements: number n
 * + piece. piece_kind: 0 polyhedron, 1 sphere (whose polyhedron meets cells), 2 plane. Of elements and pieces: id, the
 * number of their shape too (convex_overlap.h), size: cube root of the volume (0: a piece), mass (0: does not move),
 * material. */

/* The moment of pressure (gradient dW/dH), or its torque, and that of a force f at arm (own frame) reach (frame of
 * space). */
LAW void contact_put_moment(PUT(state) out, int at, int affine, state pressure, convex_map moment, smat3 map, svec3 f,
                            svec3 own, svec3 reach)
{
    if (affine) {
        const smat3 whole = smat3_scale(pressure, smat3_of(convex_reference_moment(moment, convex_map_of(map))));
        smat3_store(out, (brc_size)at, smat3_add_outer(whole, svec3_scale(STATE(-1), f), own));
        return;
    }
    svec3_store(out, (brc_size)at,
                svec3_add(svec3_scale(pressure, svec3_of(convex_torque(moment))), svec3_cross(reach, f)));
}

/* Two rigid cells between which there is room along a direction: they rest apart, and nothing of them is looked at,
 * until they may have used it up, coming nearer along it or turning. way [n]: how far any point of a rigid cell can
 * have come by turning, in all [m]; turned: that of both. */
LAW int contact_rests(OWN(state) past, svec3 branch, state turned)
{
    return svec3_dot(svec3_load(past, 16), branch) - past[19] - turned > STATE(16) * STATE_ROUNDING * turned;
}
/* The wider of the two gaps along the branch from a to b and across the face that stands between (history 15), where
 * there is any to speak of beside rounding. */
ROUTINE void contact_lay_to_rest(PUT(state) past, contact_body a, contact_body b, convex_vec branch, int face,
                                 state turned)
{
    const state margin = STATE(1e-6) * (a.radius + b.radius);
    state widest = margin;
    for (int way = face != 0 ? 0 : 1; way < 2; ++way) {
        const convex_vec along =
            way == 1   ? branch
            : face > 0 ? convex_turn(a.map, convex_own_plane(a.shape, face - 1).normal)
                       : convex_scale(STATE(-1), convex_turn(b.map, convex_own_plane(b.shape, -face - 1).normal));
        const convex_vec d = convex_scale(STATE(1) / convex_length(along), along);
        const state reach = contact_support(a, d) + contact_support(b, convex_scale(STATE(-1), d)),
                    gap = convex_dot(d, branch) - reach;
        if (gap > widest) {
            widest = gap;
            svec3_store(past, 16, svec3_of(d));
            past[19] = reach + margin - turned;
            past[14] = 2;
        }
    }
}

/* Two polyhedra, seen from the place of i; the other one may be a piece of a striker, is_wall: a half-space. */
typedef struct contact_two_cells {
    convex_shape shape_i, shape_j;
    smat3 map_i, map_j;
    svec3 branch;
    int is_wall;
} contact_two_cells;

/* Their overlap; axis: as convex_overlap_after. */
LAW convex_overlap contact_overlap_of(contact_two_cells pair, int axis)
{
    const convex_pose pose_i = {{0, 0, 0}, convex_map_of(pair.map_i)};
    if (pair.is_wall) {
        const convex_plane face = convex_own_plane(pair.shape_j, 0);
        const svec3 normal = smat3_mul_vec(pair.map_j, svec3_of(face.normal));
        const convex_plane wall = {convex_of(normal), face.height + svec3_dot(normal, pair.branch)};
        return convex_wall_overlap(pair.shape_i, pose_i, wall, convex_of(pair.branch));
    }
    const convex_pose pose_j = {convex_of(pair.branch), convex_map_of(pair.map_j)};
    return convex_overlap_after(pair.shape_i, pose_i, pair.shape_j, pose_j, axis);
}

/* What a surface bears in the time step: the most energy over V^2 / 2, the stiffest tangential spring. bears [n][4]:
 * both, and both on strikers. */
typedef struct contact_bearing {
    state spring, sticking;
} contact_bearing;
LAW state contact_at_most(state value, state most) { return value > most ? most : value; }
LAW contact_bearing contact_bears(GATHER(state) bears, int i, int j, int is_element)
{
    const brc_size at = is_element ? 0 : 2, a = 4 * (brc_size)i + at, b = 4 * (brc_size)j + at;
    return (contact_bearing){contact_at_most(bears[a], bears[b]), contact_at_most(bears[a + 1], bears[b + 1])};
}

/* What touching polyhedra do to each other. h: their size [m]; heavy: their mass [kg]; is_element: the other one is no
 * striker. */
LAW void contact_press_cells(contact_two_cells pair, convex_overlap over, contact_law how, state h, state heavy,
                             contact_bearing most, state dt, int broke, int affine, int is_element, UPDATE(state) past,
                             UPDATE(state) out)
{
    const int width = affine ? 9 : 3, looked = past[14] > 0;
    const svec3 area = svec3_of(over.area), branch = pair.branch;
    const state surface = svec3_length(area), cube = h * h * h;
    const state modulus = how.stiffness > 0 ? how.stiffness / h : how.modulus,
                spring = contact_at_most(modulus / cube, most.spring);
    const state rate = dt > 0 ? (looked ? (over.volume - past[9]) / dt : STATE(0)) : past[10];
    const state elastic = spring * over.volume;
    const state viscous = contact_dashpot(elastic, STATE(2) * SQRT_STATE(heavy * spring) / surface, how.damping, rate);
    const state pressure = elastic + viscous, sticking = contact_at_most(how.tangential * modulus * h, most.sticking);
    const svec3 n_out = svec3_scale(STATE(-1) / surface, area), point = svec3_of(over.point),
                arm_j = svec3_sub(point, branch);
    svec3 slip = {0, 0, 0}, stretch = {0, 0, 0};
    if (past[12] > 0) {
        if (!broke)
            slip = svec3_sub(contact_slip(pair.map_i, svec3_load(past, 3), pair.map_j, svec3_load(past, 6), branch),
                             svec3_load(past, 16));
        stretch = svec3_load(past, 0);
    }
    const contact_stick stick = contact_friction(stretch, slip, n_out, sticking, how.friction * pressure * surface);
    const svec3 rub = svec3_scale(-sticking, stick.stretch), back = svec3_scale(STATE(-1), rub);
    const svec3 own_i = smat3_mul_vec(smat3_inverse(pair.map_i), point),
                own_j = smat3_mul_vec(smat3_inverse(pair.map_j), arm_j);
    svec3_store(out, 0, svec3_add_scaled(rub, pressure, area));
    out[3] = STATE(0.5) * (elastic * over.volume + sticking * svec3_dot(stick.stretch, stick.stretch));
    out[4] = dt > 0 ? stick.lost : STATE(0);
    out[5] = dt > 0 && looked ? STATE(0.5) * (past[11] + viscous) * (over.volume - past[9]) : STATE(0);
    out[6] = pressure * surface;
    out[7] = over.volume / surface;
    if (!pair.is_wall) {
        const contact_body a = {pair.shape_i, convex_map_of(pair.map_i), pair.shape_i.radius, 0},
                           b = {pair.shape_j, convex_map_of(pair.map_j), pair.shape_j.radius, 0};
        out[7] = contact_depth(a, b, convex_of(branch), out[7], h);
    }
    contact_put_moment(out, CONTACT_RESULT, affine, pressure, over.moment_a, pair.map_i, rub, own_i, point);
    contact_put_moment(out, CONTACT_RESULT + width, affine && is_element, pressure, over.moment_b, pair.map_j, back,
                       own_j, arm_j);
    if (dt > 0 || broke) {
        svec3_store(past, 0, stick.stretch);
        svec3_store(past, 3, own_i);
        svec3_store(past, 6, own_j);
        svec3_store(past, 16, contact_slip(pair.map_i, own_i, pair.map_j, own_j, branch));
        past[9] = over.volume;
        past[10] = rate;
        past[11] = viscous;
        past[12] = 1;
        past[13] = (state)stick.sliding;
        past[14] = 1;
        past[15] = 0;
    }
}

/* Numbers of a later pair that are asked for ahead. */
LAW void contact_ask_ahead(int p, int n, OWN(int) ends, GATHER(state) place, GATHER(state) displacement,
                           GATHER(state) way, UPDATE(state) history)
{
    const int next = ends[2 * (brc_size)p + 1];
    PREFETCH(history, (brc_size)p * CONTACT_HISTORY + 14);
    PREFETCH(history, (brc_size)p * CONTACT_HISTORY + 19);
    if (next < n) {
        PREFETCH(displacement, (brc_size)next * 3);
        PREFETCH(place, (brc_size)next * 3);
        PREFETCH(way, next);
    }
}

/* Pairs ahead whose numbers are asked for: most pairs rest, and cost what it takes to read that. */
#define CONTACT_AHEAD 16
/* whole: all pairs, else those of todo. broke: bonds did, so that the gradients of cells, and their surfaces with them,
 * have jumped where nothing moved: pairs go on from how they meet now, and what surfaces gained or lost by it is the
 * break's. rigid [n], way [n]: contact_rests. */
KERNEL void contact_cells(int n_items, int whole, int broke, state dt, int n, int affine, int n_materials,
                          state middle_x, state middle_y, state middle_z, OWN(int) todo, OWN(int) ends,
                          GATHER(state) place, GATHER(state) displacement, GATHER(coeff) gradient,
                          GATHER(state) orientation, GATHER(state) corner, GATHER(state) plane, GATHER(int) loop_start,
                          GATHER(int) loop, GATHER(state) radius, GATHER(int) corner_start, GATHER(int) face_start,
                          GATHER(int) id, GATHER(state) size, GATHER(state) mass, GATHER(state) bears,
                          GATHER(int) material, GATHER(int) piece_striker, GATHER(int) piece_kind,
                          GATHER(state) striker_pose, GATHER(state) law, GATHER(int) rigid, GATHER(state) way,
                          UPDATE(state) history, PUT(int) touch, UPDATE(state) result)
{
    FOR_EACH_ITEM(item, n_items) {
        const int p = whole ? item : todo[item];
        const int i = ends[2 * (brc_size)p], j = ends[2 * (brc_size)p + 1], width = affine ? 9 : 3;
        GLOBAL state *restrict past = history + (brc_size)p * CONTACT_HISTORY;
        GLOBAL state *restrict out = result + (brc_size)p * (brc_size)(CONTACT_RESULT + 2 * width);
        svec3 branch = {0, 0, 0};
        state turned = 0;
        int rests = 0;
        if (whole && item + CONTACT_AHEAD < n_items)
            contact_ask_ahead(item + CONTACT_AHEAD, n, ends, place, displacement, way, history);
        if (j < n) {
            branch = contact_branch(place, displacement, i, j);
            turned = rigid[i] && rigid[j] ? way[i] + way[j] : STATE(0);
            rests = past[14] > STATE(1) && contact_rests(past, branch, turned);
        }
        if (rests)
            touch[p] = 0;
        else {
            contact_two_cells pair;
            pair.branch = branch;
            pair.is_wall = 0;
            pair.map_i = contact_map(affine, gradient, orientation, i);
            pair.shape_i = convex_shape_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id[i]);
            pair.shape_j = convex_shape_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id[j]);
            if (j < n) {
                pair.map_j = contact_map(affine, gradient, orientation, j);
            } else {
                const brc_size at = (brc_size)piece_striker[j - n] * 12;
                const svec3 own = svec3_add(svec3_load(place, (brc_size)i * 3), (svec3){middle_x, middle_y, middle_z});
                pair.map_j = smat3_load(striker_pose, at + 3);
                pair.branch =
                    svec3_sub(svec3_sub(svec3_load(striker_pose, at), own), svec3_load(displacement, (brc_size)i * 3));
                pair.is_wall = piece_kind[j - n] == 2;
            }
            const convex_overlap over = contact_overlap_of(pair, (int)past[15]);
            /* an overlap that could not be taken (failed 2) divides by no area: what is not finite stops the run, in
             * place of a force that is missing */
            const int touching = (over.volume > 0 && svec3_length(svec3_of(over.area)) > 0) || over.failed == 2;
            touch[p] = touching;
            if (!touching && (dt > 0 || broke)) {
                contact_apart(past, STATE(0), over.apart);
                if (j < n && over.failed == 0 && rigid[i] && rigid[j]) {
                    const contact_body a = {pair.shape_i, convex_map_of(pair.map_i), pair.shape_i.radius, 0},
                                       b = {pair.shape_j, convex_map_of(pair.map_j), pair.shape_j.radius, 0};
                    contact_lay_to_rest(past, a, b, convex_of(pair.branch), over.apart, turned);
                }
            }
            if (touching) {
                const contact_law how = contact_law_of(law, n_materials, material[i], material[j]);
                const state h = size[j] > 0 ? STATE(2) * size[i] * size[j] / (size[i] + size[j]) : size[i],
                            heavy = mass[j] > 0 ? mass[i] * mass[j] / (mass[i] + mass[j]) : mass[i];
                contact_press_cells(pair, over, how, h, heavy, contact_bears(bears, i, j, j < n), dt, broke, affine,
                                    j < n, past, out);
            }
        }
    }
}

/* dlsm: moments of touching pairs, added to the element's place in held_moment; of rigid elements the torque instead.
 * As contact_gather_turning. */
KERNEL void contact_gather_moments(int n_with_pairs, int book, OWN(int) with_pairs, OWN(int) list, OWN(int) start,
                                   OWN(int) used, OWN(int) pair, GATHER(int) touch, GATHER(state) result,
                                   OWN(int) boundary, OWN(int) rigid, OWN(coeff) gradient, UPDATE(coeff) held_moment,
                                   UPDATE(state) turn, PUT(state) stored, UPDATE(state) lost_friction,
                                   UPDATE(state) lost_impact)
{
    FOR_EACH_ITEM(item, n_with_pairs) {
        const int k = with_pairs[item], e = list[k];
        smat3 sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
        state held = 0, rubbed = 0, damped = 0;
        int any = 0;
        for (int at = start[k]; at < start[k] + used[k]; ++at) {
            const int owner = pair[at] >= 0, p = owner ? pair[at] : -1 - pair[at];
            GLOBAL const state *restrict one = result + (brc_size)p * (CONTACT_RESULT + 18);
            if (!touch[p]) continue;
            any = 1;
            sum = smat3_add(sum, smat3_load(one, owner ? CONTACT_RESULT : CONTACT_RESULT + 9));
            if (owner) {
                held += one[3];
                rubbed += one[4];
                damped += one[5];
            }
        }
        if (rigid[e] && !any)
            svec3_store(turn, (brc_size)e * 3, (svec3){0, 0, 0});
        else if (rigid[e]) {
            const smat3 turned = smat3_mul(sum, smat3_transpose(contact_map(1, gradient, turn, e)));
            svec3_store(turn, (brc_size)e * 3, svec3_scale(STATE(-1), smat3_moment(turned)));
        } else if (any) {
            const mat3 narrow = {(coeff)sum.xx, (coeff)sum.xy, (coeff)sum.xz, (coeff)sum.yx, (coeff)sum.yy,
                                 (coeff)sum.yz, (coeff)sum.zx, (coeff)sum.zy, (coeff)sum.zz};
            mat3_add_to_block(held_moment, boundary[e / C], e % C, narrow);
        }
        stored[e] = held;
        if (book) {
            lost_friction[e] += rubbed;
            lost_impact[e] += damped;
        }
    }
}

/* dlsm: forces of touching pairs. */
KERNEL void contact_gather_forces(int n_with_pairs, OWN(int) with_pairs, OWN(int) list, OWN(int) start, OWN(int) used,
                                  OWN(int) pair, GATHER(int) touch, GATHER(state) result, UPDATE(state) force)
{
    FOR_EACH_ITEM(item, n_with_pairs) {
        const int k = with_pairs[item];
        const brc_size to = (brc_size)list[k] * 3;
        svec3 push = {0, 0, 0};
        int any = 0;
        for (int at = start[k]; at < start[k] + used[k]; ++at) {
            const int owner = pair[at] >= 0, p = owner ? pair[at] : -1 - pair[at];
            GLOBAL const state *restrict one = result + (brc_size)p * (CONTACT_RESULT + 18);
            if (!touch[p]) continue;
            any = 1;
            push = svec3_add_scaled(push, owner ? STATE(1) : STATE(-1), svec3_load(one, 0));
        }
        if (any) svec3_store(force, to, svec3_add(svec3_load(force, to), push));
    }
}

/* Of every block of 256 pairs the force and torque on each striker: part [n_strikers][n_blocks][6]; then their sums:
 * load [n_strikers][6]. */
#define CONTACT_PAIRS 256
KERNEL void contact_striker_parts(int n_crew_parts, int n_blocks, int n_pairs, int n, int stride, int torque_at,
                                  OWN(int) ends, GATHER(int) piece_striker, OWN(int) touch, OWN(state) result,
                                  PUT(state) part)
{
    CREW_STAGE(state, row);
    FOR_EACH_CREW(k, n_crew_parts) {
        const int striker = k / n_blocks, begin = k % n_blocks * CONTACT_PAIRS,
                  end = begin + CONTACT_PAIRS < n_pairs ? begin + CONTACT_PAIRS : n_pairs;
        state sum[CREW_SHARE(6)];
        for (int i = 0; i < CREW_SHARE(6); ++i) sum[i] = 0;
        for (int first = begin; first < end; first += CREW) {
            const int p = first + CREW_PLACE, j = p < end ? ends[2 * (brc_size)p + 1] : 0;
            svec3 push = {0, 0, 0}, turn = {0, 0, 0};
            if (j >= n && piece_striker[j - n] == striker && touch[p]) {
                GLOBAL const state *restrict one = result + (brc_size)p * (brc_size)stride;
                push = svec3_scale(STATE(-1), svec3_load(one, 0));
                turn = svec3_load(one, (brc_size)torque_at);
            } else if (CREW == 1)
                continue;
            const state now[6] = {push.x, push.y, push.z, turn.x, turn.y, turn.z};
            for (int c = 0; c < 6; ++c) CREW_PUT(row, CREW_AT(CREW_PLACE, c, 6), now[c]);
            CREW_WAIT();
            for (int i = 0; i < CREW_SHARE(6); ++i)
                for (int t = 0; t < CREW && CREW_COLUMN(i) < 6; ++t)
                    sum[i] += CREW_NUMBER(row, CREW_AT(t, CREW_COLUMN(i), 6), now[i]);
            CREW_WAIT();
        }
        for (int i = 0; i < CREW_SHARE(6); ++i)
            if (CREW_COLUMN(i) < 6) part[(brc_size)k * 6 + (brc_size)CREW_COLUMN(i)] = sum[i];
    }
}
KERNEL void contact_striker_load(int n_crew_parts, int n_blocks, OWN(state) part, PUT(state) load)
{
    FOR_EACH_CREW(k, n_crew_parts) {
        state sum[CREW_SHARE(6)];
        for (int i = 0; i < CREW_SHARE(6); ++i) sum[i] = 0;
        LOADS_TOGETHER(16)
        for (int b = 0; b < n_blocks; ++b)
            for (int i = 0; i < CREW_SHARE(6); ++i)
                if (CREW_COLUMN(i) < 6)
                    sum[i] += part[((brc_size)k * (brc_size)n_blocks + (brc_size)b) * 6 + (brc_size)CREW_COLUMN(i)];
        for (int i = 0; i < CREW_SHARE(6); ++i)
            if (CREW_COLUMN(i) < 6) load[(brc_size)k * 6 + (brc_size)CREW_COLUMN(i)] = sum[i];
    }
}
