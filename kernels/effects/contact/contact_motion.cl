/* Where everything was when the list of pairs was made (contact_search.cl), and how far it has moved since.
 *
 * A common motion of all brings no two together: of elements only what is left of their way counts when the mean
 * displacement since then is taken off and, where the cloud grows, growth about its middle in proportion to the
 * distance: x -> x + a + g (x - middle) with g >= 0. Against strikers, which do not take part, it is the whole way.
 *
 * pose: how elements stand. 0: spheres; 1: by I + H; 2: by their rotation.
 * built [n][4]: place of each element, relative to the middle of the domain, and the radius of the ball about it that
 * held it [m]; posed [n][9]: its map (not of spheres). clear [n]: of each exposed element how far its ball was from the
 * nearest piece of a striker that it is not listed with [m]. */

/* Bound of how much a map I + H lengthens anything: the root of the largest row sum of F^T F, 1 for rotations; no less
 * than 1, since the cell may come loose. */
LAW state contact_stretch(OWN(coeff) gradient, int e)
{
    GLOBAL const coeff *restrict h = gradient + (brc_size)e * 9;
    const smat3 f = {STATE(1) + h[0], h[1], h[2], h[3], STATE(1) + h[4], h[5], h[6], h[7], STATE(1) + h[8]};
    const smat3 c = smat3_mul(smat3_transpose(f), f);
    const state yz = c.yz < 0 ? -c.yz : c.yz, xz = c.xz < 0 ? -c.xz : c.xz, xy = c.xy < 0 ? -c.xy : c.xy;
    const state x = c.xx + xy + xz, y = c.yy + xy + yz, z = c.zz + xz + yz;
    const state xy_most = x > y ? x : y, most = xy_most > z ? xy_most : z;
    return most > STATE(1) ? SQRT_STATE(most) : STATE(1);
}

/* Present positions, radii and maps of all elements. bounding_radius [n]: radius about the element's place in the
 * reference [m]. */
KERNEL void contact_extent(int n_rows, int pose, OWN(state) place, OWN(state) displacement, OWN(coeff) gradient,
                           OWN(state) orientation, OWN(state) bounding_radius, PUT(state) built, PUT(state) posed)
{
    FOR_EACH_ITEM(e, n_rows) {
        for (int c = 0; c < 3; ++c)
            built[(brc_size)e * 4 + c] = place[(brc_size)e * 3 + c] + displacement[(brc_size)e * 3 + c];
        built[(brc_size)e * 4 + 3] = pose == 1 ? bounding_radius[e] * contact_stretch(gradient, e) : bounding_radius[e];
        if (pose != 0) smat3_store(posed, (brc_size)e * 9, contact_map(pose == 1, gradient, orientation, e));
    }
}

LAW svec3 contact_way(OWN(state) place, OWN(state) displacement, svec3 was, int e)
{
    return svec3_add(svec3_sub(svec3_load(place, (brc_size)e * 3), was), svec3_load(displacement, (brc_size)e * 3));
}

#define CONTACT_BLOCK 256
#define CONTACT_PART 16
#define CONTACT_DRIFT 14
/* Sums over the exposed elements of each block: their number, way, velocity, acceleration and place when the list was
 * made; place . way, place . velocity, place . place. part [n_crews][CONTACT_PART]. */
KERNEL void contact_drift(int n_crews, int n, OWN(int) exposed, OWN(state) place, OWN(state) displacement,
                          OWN(state) built, OWN(state) velocity, OWN(state) force, OWN(state) mass, PUT(state) part)
{
    CREW_STAGE(state, row);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * CONTACT_BLOCK, end = begin + CONTACT_BLOCK < n ? begin + CONTACT_BLOCK : n;
        state sum[CREW_SHARE(CONTACT_PART)];
        for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i) sum[i] = 0;
        for (int first = begin; first < end; first += CREW) {
            const int e = first + CREW_PLACE;
            state now[CONTACT_PART];
            for (int c = 0; c < CONTACT_PART; ++c) now[c] = 0;
            if (e < end && exposed[e]) {
                const svec3 was = svec3_load(built, (brc_size)e * 4), d = contact_way(place, displacement, was, e),
                            v = svec3_load(velocity, (brc_size)e * 3),
                            a = svec3_scale(STATE(1) / mass[e], svec3_load(force, (brc_size)e * 3));
                now[0] = STATE(1);
                now[1] = d.x, now[2] = d.y, now[3] = d.z;
                now[4] = v.x, now[5] = v.y, now[6] = v.z;
                now[7] = a.x, now[8] = a.y, now[9] = a.z;
                now[10] = was.x, now[11] = was.y, now[12] = was.z;
                now[13] = svec3_dot(was, d), now[14] = svec3_dot(was, v), now[15] = svec3_dot(was, was);
            } else if (CREW == 1)
                continue;
            for (int c = 0; c < CONTACT_PART; ++c) CREW_PUT(row, CREW_AT(CREW_PLACE, c, CONTACT_PART), now[c]);
            CREW_WAIT();
            for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i)
                for (int t = 0; t < CREW && CREW_COLUMN(i) < CONTACT_PART; ++t)
                    sum[i] += CREW_NUMBER(row, CREW_AT(t, CREW_COLUMN(i), CONTACT_PART), now[i]);
            CREW_WAIT();
        }
        for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i)
            if (CREW_COLUMN(i) < CONTACT_PART) part[(brc_size)b * CONTACT_PART + (brc_size)CREW_COLUMN(i)] = sum[i];
    }
}
/* Mean way, velocity, acceleration, middle; growth g [-] and its rate [1/s], least squares, none below 0. drift
 * [CONTACT_DRIFT]. n_crew_parts: 1. */
KERNEL void contact_drift_mean(int n_crew_parts, int n_blocks, OWN(state) part, SCATTER(state) drift)
{
    CREW_STAGE(state, column);
    FOR_EACH_CREW(k, n_crew_parts) {
        state own[CREW_SHARE(CONTACT_PART)];
        for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i) own[i] = 0;
        LOADS_TOGETHER(16)
        for (int b = 0; b < n_blocks; ++b)
            for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i)
                if (CREW_COLUMN(i) < CONTACT_PART)
                    own[i] += part[((brc_size)k + (brc_size)b) * CONTACT_PART + (brc_size)CREW_COLUMN(i)];
        for (int i = 0; i < CREW_SHARE(CONTACT_PART); ++i) CREW_PUT(column, CREW_COLUMN(i), own[i]);
        CREW_WAIT();
        if (CREW_FIRST) {
            state sum[CONTACT_PART];
            for (int c = 0; c < CONTACT_PART; ++c) sum[c] = CREW_NUMBER(column, c, own[c]);
            const state share = sum[0] > 0 ? STATE(1) / sum[0] : STATE(0);
            state along = 0, spread = sum[15], rate = 0;
            for (int c = 0; c < 12; ++c) drift[c] = share * sum[1 + c];
            for (int c = 0; c < 3; ++c) {
                along += drift[9 + c] * sum[1 + c];
                rate += drift[9 + c] * sum[4 + c];
                spread -= drift[9 + c] * sum[10 + c];
            }
            const state growth = spread > 0 ? (sum[13] - along) / spread : STATE(0),
                        growing = spread > 0 ? (sum[14] - rate) / spread : STATE(0);
            drift[12] = growth > 0 ? growth : STATE(0);
            drift[13] = growing > 0 ? growing : STATE(0);
        }
    }
}

#define CONTACT_MOVED 6
/* Of each block of elements, of the exposed ones, the largest: way of any of its points since the list was made, drift
 * taken off [m]; its speed, and the acceleration squared; way of any of its points less `clear` [m]; speed and
 * acceleration squared. spin: of elements that stand by their rotation. Points of a cell turn and strain with it: the
 * way of its place and bounding_radius times the change of its map; their speeds are taken as twice that of the place
 * where the map follows the neighbours (pose 1). moved [n_crews][CONTACT_MOVED]. */
KERNEL void contact_moved(int n_crews, int n, int pose, OWN(int) exposed, OWN(int) rigid, OWN(state) place,
                          OWN(state) displacement, OWN(coeff) gradient, OWN(state) orientation,
                          OWN(state) bounding_radius, OWN(state) built, OWN(state) posed, OWN(state) clear,
                          OWN(state) velocity, OWN(state) spin, OWN(state) force, OWN(state) mass, GATHER(state) drift,
                          PUT(state) moved)
{
    CREW_STAGE(state, row);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * CONTACT_BLOCK, end = begin + CONTACT_BLOCK < n ? begin + CONTACT_BLOCK : n;
        const svec3 way = svec3_load(drift, 0), speed = svec3_load(drift, 3), push = svec3_load(drift, 6),
                    middle = svec3_load(drift, 9);
        state most[CONTACT_MOVED];
        for (int c = 0; c < CONTACT_MOVED; ++c) most[c] = c == 3 ? -STATE(1e30) : STATE(0);
        for (int e = begin + CREW_PLACE; e < end; e += CREW)
            if (exposed[e]) {
                const svec3 was = svec3_load(built, (brc_size)e * 4), d = contact_way(place, displacement, was, e),
                            v = svec3_load(velocity, (brc_size)e * 3);
                const svec3 a = svec3_scale(STATE(1) / mass[e], svec3_load(force, (brc_size)e * 3)),
                            arm = svec3_sub(was, middle);
                state turned = 0, turning = 0, follows = STATE(1);
                if (pose != 0 && !rigid[e]) { /* rigid cells are listed by their balls, whose turning moves nothing */
                    const smat3 off = smat3_add(contact_map(pose == 1, gradient, orientation, e),
                                                smat3_scale(STATE(-1), smat3_load(posed, (brc_size)e * 9)));
                    const smat3 square = smat3_mul(smat3_transpose(off), off);
                    turned = bounding_radius[e] * SQRT_STATE(square.xx + square.yy + square.zz);
                    if (pose == 1)
                        follows = STATE(2);
                    else
                        turning = bounding_radius[e] * svec3_length(svec3_load(spin, (brc_size)e * 3));
                }
                const svec3 off = svec3_sub(svec3_sub(d, way), svec3_scale(drift[12], arm)),
                            apart = svec3_sub(svec3_sub(v, speed), svec3_scale(drift[13], arm));
                const svec3 pushed = svec3_sub(a, push);
                const state now[CONTACT_MOVED] = {
                    svec3_length(off) + turned,          follows * svec3_length(apart) + turning,
                    svec3_dot(pushed, pushed),           svec3_length(d) + turned - clear[e],
                    follows * svec3_length(v) + turning, svec3_dot(a, a)};
                for (int c = 0; c < CONTACT_MOVED; ++c) most[c] = now[c] > most[c] ? now[c] : most[c];
            }
        for (int c = 0; c < CONTACT_MOVED; ++c) CREW_PUT(row, CREW_AT(CREW_PLACE, c, CONTACT_MOVED), most[c]);
        CREW_WAIT();
        FOR_CREW_COLUMNS(c, CONTACT_MOVED) {
            state largest = CREW_NUMBER(row, c, most[c]);
            for (int t = 1; t < CREW; ++t) {
                const state other = CREW_NUMBER(row, CREW_AT(t, c, CONTACT_MOVED), most[c]);
                largest = other > largest ? other : largest;
            }
            moved[(brc_size)b * CONTACT_MOVED + (brc_size)c] = largest;
        }
    }
}

/* The larger of each number, of this look and of those before it. */
KERNEL void contact_most(int n, OWN(state) moved, UPDATE(state) most)
{
    FOR_EACH_ITEM(i, n) { most[i] = moved[i] > most[i] ? moved[i] : most[i]; }
}

/* Of each block the largest radius of an exposed element, and of any, in the first two of CONTACT_MOVED columns. */
KERNEL void contact_largest(int n_crews, int n, OWN(int) exposed, OWN(state) built, PUT(state) moved)
{
    CREW_STAGE(state, row);
    FOR_EACH_CREW(b, n_crews) {
        const int begin = b * CONTACT_BLOCK, end = begin + CONTACT_BLOCK < n ? begin + CONTACT_BLOCK : n;
        state most = 0, any = 0;
        for (int e = begin + CREW_PLACE; e < end; e += CREW) {
            const state radius = built[(brc_size)e * 4 + 3];
            if (exposed[e] && radius > most) most = radius;
            any = radius > any ? radius : any;
        }
        CREW_PUT(row, CREW_AT(CREW_PLACE, 0, 2), most);
        CREW_PUT(row, CREW_AT(CREW_PLACE, 1, 2), any);
        CREW_WAIT();
        for (int t = 0; t < CREW; ++t) {
            const state one = CREW_NUMBER(row, CREW_AT(t, 0, 2), most), other = CREW_NUMBER(row, CREW_AT(t, 1, 2), any);
            most = one > most ? one : most;
            any = other > any ? other : any;
        }
        FOR_CREW_COLUMNS(c, CONTACT_MOVED)
            moved[(brc_size)b * CONTACT_MOVED + (brc_size)c] = c == 0 ? most : c == 1 ? any : STATE(0);
    }
}

/* Pieces of strikers: a ball about a centre (x y z, reach), or the half-space behind a plane (unit normal, height;
 * piece_kind 2), in their striker's own frame; where they are now, relative to the middle of the domain: piece
 * [n_pieces][4]. */
LAW svec3 contact_striker_place(GATHER(state) striker_pose, brc_size at, state middle_x, state middle_y, state middle_z)
{
    return (svec3){striker_pose[at] - middle_x, striker_pose[at + 1] - middle_y, striker_pose[at + 2] - middle_z};
}
LAW svec3 contact_striker_turn(GATHER(state) striker_pose, brc_size at, svec3 a)
{
    GLOBAL const state *restrict r = striker_pose + at + 3;
    return (svec3){r[0] * a.x + r[1] * a.y + r[2] * a.z, r[3] * a.x + r[4] * a.y + r[5] * a.z,
                   r[6] * a.x + r[7] * a.y + r[8] * a.z};
}
KERNEL void contact_pieces(int n_pieces, state middle_x, state middle_y, state middle_z, OWN(int) piece_striker,
                           OWN(int) piece_kind, OWN(state) piece_own, GATHER(state) striker_pose, PUT(state) piece)
{
    FOR_EACH_ITEM(q, n_pieces) {
        const brc_size at = (brc_size)piece_striker[q] * 12, to = (brc_size)q * 4;
        const svec3 own = {piece_own[to], piece_own[to + 1], piece_own[to + 2]},
                    far = contact_striker_place(striker_pose, at, middle_x, middle_y, middle_z);
        const svec3 turned = contact_striker_turn(striker_pose, at, own);
        const int wall = piece_kind[q] == 2;
        const svec3 now = wall ? turned : svec3_add(far, turned);
        piece[to] = now.x;
        piece[to + 1] = now.y;
        piece[to + 2] = now.z;
        piece[to + 3] = wall ? piece_own[to + 3] + svec3_dot(turned, far) : piece_own[to + 3];
    }
}
/* How far pieces moved since `piece`, and their speed squared, in columns 0 and 1 of CONTACT_MOVED from row `first` on;
 * span: how far from the middle anything may be that meets a plane [m]. */
KERNEL void contact_pieces_moved(int n_pieces, int first, state middle_x, state middle_y, state middle_z, state span,
                                 OWN(int) piece_striker, OWN(int) piece_kind, OWN(state) piece_own,
                                 GATHER(state) striker_pose, GATHER(state) motion, OWN(state) piece, PUT(state) moved)
{
    FOR_EACH_ITEM(q, n_pieces) {
        const brc_size at = (brc_size)piece_striker[q] * 12, to = (brc_size)q * 4,
                       way = (brc_size)(first + q) * CONTACT_MOVED, on = (brc_size)piece_striker[q] * 6;
        const svec3 own = {piece_own[to], piece_own[to + 1], piece_own[to + 2]},
                    far = contact_striker_place(striker_pose, at, middle_x, middle_y, middle_z);
        const svec3 turned = contact_striker_turn(striker_pose, at, own),
                    was = {piece[to], piece[to + 1], piece[to + 2]};
        const svec3 v = {motion[on], motion[on + 1], motion[on + 2]},
                    w = {motion[on + 3], motion[on + 4], motion[on + 5]};
        const int wall = piece_kind[q] == 2;
        const state lever = wall ? span : svec3_length(own) + piece_own[to + 3];
        const state rise = wall ? piece_own[to + 3] + svec3_dot(turned, far) - piece[to + 3] : STATE(0);
        const svec3 off = svec3_sub(wall ? turned : svec3_add(far, turned), was);
        const state speed = svec3_length(v) + lever * svec3_length(w);
        for (int c = 2; c < CONTACT_MOVED; ++c) moved[way + (brc_size)c] = 0;
        moved[way] = wall ? (rise < 0 ? -rise : rise) + span * svec3_length(off) : svec3_length(off);
        moved[way + 1] = speed * speed;
    }
}
