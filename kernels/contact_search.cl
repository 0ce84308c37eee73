/* Which elements may touch: those that are exposed and whose balls, grown by a skin, meet. Rebuilt when something has moved by half the skin; in
 * between the list holds every pair that can touch. Positions are relative to the middle of the domain. Of the lists:
 * list [m]: rows of the exposed elements, ascending; slot_of [n + 1]: place of a row in it (of an exposed row; else that of the next one);
 * start [m + 1], used [m]: entries of each; entry: the other row, by ascending id, and n + piece of a striker; pair: number of the pair, seen from its lower id; below 0: -1 - pair, seen
 * from the higher one.
 * built [n][4]: where each element was when the list was made, and the radius of the ball about it that held it [m]. */

#define CONTACT_HISTORY 16

/* Bound of how much a map I + H lengthens anything: the root of the largest row sum of F^T F, 1 for rotations. */
LAW state contact_stretch(GLOBAL const coeff *restrict gradient, int e)
{
    GLOBAL const coeff *restrict h = gradient + (brc_size)e * 9;
    const smat3 f = {STATE(1) + h[0], h[1], h[2], h[3], STATE(1) + h[4], h[5], h[6], h[7], STATE(1) + h[8]};
    const smat3 c = smat3_mul(smat3_transpose(f), f);
    const state yz = c.yz < 0 ? -c.yz : c.yz, xz = c.xz < 0 ? -c.xz : c.xz, xy = c.xy < 0 ? -c.xy : c.xy;
    const state x = c.xx + xy + xz, y = c.yy + xy + yz, z = c.zz + xz + yz;
    const state xy_most = x > y ? x : y;
    return SQRT_STATE(xy_most > z ? xy_most : z);
}

/* Present positions and radii of all elements. reach [n]: radius about the element's place in the reference [m]; affine: elements follow I + H. */
KERNEL void contact_extent(int n, int affine, GLOBAL const state *restrict place, GLOBAL const state *restrict displacement,
                           GLOBAL const coeff *restrict gradient, GLOBAL const state *restrict reach, GLOBAL state *restrict built)
{
    FOR_EACH_ITEM(e, n) {
        for (int c = 0; c < 3; ++c) built[(brc_size)e * 4 + c] = place[(brc_size)e * 3 + c] + displacement[(brc_size)e * 3 + c];
        built[(brc_size)e * 4 + 3] = affine ? reach[e] * contact_stretch(gradient, e) : reach[e];
    }
}

#define CONTACT_BLOCK 256
/* Of each block of elements: how far an exposed one has moved and swollen since `built` [m], its largest speed and acceleration squared. moved [n_blocks][3]. */
KERNEL void contact_moved(int n_blocks, int n, int affine, GLOBAL const int *restrict exposed, GLOBAL const state *restrict place,
                          GLOBAL const state *restrict displacement, GLOBAL const coeff *restrict gradient, GLOBAL const state *restrict reach,
                          GLOBAL const state *restrict built, GLOBAL const state *restrict velocity, GLOBAL const state *restrict force,
                          GLOBAL const state *restrict mass, GLOBAL state *restrict moved)
{
    FOR_EACH_ITEM(b, n_blocks) {
        const int begin = b * CONTACT_BLOCK, end = begin + CONTACT_BLOCK < n ? begin + CONTACT_BLOCK : n;
        state far = 0, fast = 0, pushed = 0;
        for (int e = begin; e < end; ++e)
            if (exposed[e]) {
                state square = 0, speed = 0, push = 0;
                for (int c = 0; c < 3; ++c) {
                    const brc_size at = (brc_size)e * 3 + c;
                    const state way = place[at] + displacement[at] - built[(brc_size)e * 4 + c], a = force[at] / mass[e];
                    square += way * way;
                    speed += velocity[at] * velocity[at];
                    push += a * a;
                }
                const state grown = affine ? reach[e] * contact_stretch(gradient, e) - built[(brc_size)e * 4 + 3] : STATE(0);
                const state way = SQRT_STATE(square) + (grown > 0 ? grown : STATE(0));
                far = way > far ? way : far;
                fast = speed > fast ? speed : fast;
                pushed = push > pushed ? push : pushed;
            }
        moved[(brc_size)b * 3] = far;
        moved[(brc_size)b * 3 + 1] = fast;
        moved[(brc_size)b * 3 + 2] = pushed;
    }
}

/* Of each block the largest radius of an exposed element, as contact_moved gives its moves. */
KERNEL void contact_largest(int n_blocks, int n, GLOBAL const int *restrict exposed, GLOBAL const state *restrict built, GLOBAL state *restrict moved)
{
    FOR_EACH_ITEM(b, n_blocks) {
        const int begin = b * CONTACT_BLOCK, end = begin + CONTACT_BLOCK < n ? begin + CONTACT_BLOCK : n;
        state most = 0;
        for (int e = begin; e < end; ++e)
            if (exposed[e] && built[(brc_size)e * 4 + 3] > most) most = built[(brc_size)e * 4 + 3];
        moved[(brc_size)b * 3] = most;
        moved[(brc_size)b * 3 + 1] = moved[(brc_size)b * 3 + 2] = 0;
    }
}

/* Elements that lost a bond are exposed from then on. */
KERNEL void contact_expose(int n, GLOBAL const state *restrict broken, GLOBAL int *restrict exposed)
{
    FOR_EACH_ITEM(e, n) {
        if (broken[e] > 0) exposed[e] = 1;
    }
}

/* Groups of elements of which a bond was chosen in this step (fracture.cl). found [n_groups]. */
KERNEL void contact_marked(int n_groups, int step, GLOBAL const int *restrict mark, GLOBAL state *restrict found)
{
    FOR_EACH_ITEM(group, n_groups) { found[group] = mark[group] == step ? STATE(1) : STATE(0); }
}

KERNEL void contact_list(int n, GLOBAL const int *restrict exposed, GLOBAL const int *restrict slot_of, GLOBAL int *restrict list)
{
    FOR_EACH_ITEM(e, n) {
        if (exposed[e]) list[slot_of[e]] = e;
    }
}

/* ---- the grid ---- */

typedef struct { int x, y, z; } contact_cell;

LAW int contact_coordinate(state x, state per_edge)
{
    const state far = STATE(1000000), at = x * per_edge, held = at > far ? far : at < -far ? -far : at;
    const int down = (int)held;
    return (state)down > held ? down - 1 : down;
}
LAW contact_cell contact_cell_of(GLOBAL const state *restrict built, int e, state per_edge)
{
    const contact_cell cell = {contact_coordinate(built[(brc_size)e * 4], per_edge), contact_coordinate(built[(brc_size)e * 4 + 1], per_edge),
                               contact_coordinate(built[(brc_size)e * 4 + 2], per_edge)};
    return cell;
}
LAW int contact_key(contact_cell cell, int mask)
{
    const unsigned int mixed = (unsigned int)cell.x * 73856093u ^ (unsigned int)cell.y * 19349663u ^ (unsigned int)cell.z * 83492791u;
    return (int)((mixed ^ mixed >> 15) & (unsigned int)mask);
}

KERNEL void contact_keys(int m, state per_edge, int mask, GLOBAL const int *restrict list, GLOBAL const state *restrict built, GLOBAL int *restrict key,
                         GLOBAL int *restrict row)
{
    FOR_EACH_ITEM(k, m) {
        key[k] = contact_key(contact_cell_of(built, list[k], per_edge), mask);
        row[k] = list[k];
    }
}

/* Where each key begins and ends among the sorted ones; keys that none has keep first = last = 0. */
KERNEL void contact_buckets(int m, GLOBAL const int *restrict key, GLOBAL int *restrict first, GLOBAL int *restrict last)
{
    FOR_EACH_ITEM(k, m) {
        const int own = key[k];
        if (k == 0 || key[k - 1] != own) first[own] = k;
        if (k == m - 1 || key[k + 1] != own) last[own] = k + 1;
    }
}

/* Balls about two elements that meet when each grows by half the skin. The same from both sides to the last bit. */
LAW int contact_near(GLOBAL const state *restrict built, int i, int j, state skin)
{
    GLOBAL const state *restrict a = built + (brc_size)i * 4;
    GLOBAL const state *restrict b = built + (brc_size)j * 4;
    const state x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], reach = a[3] + b[3] + skin;
    return x * x + y * y + z * z < reach * reach;
}

/* Pieces of strikers: a ball about a centre (x y z, reach), or the half-space behind a plane (unit normal, height; piece_kind 2), in their striker's own frame; where they
 * are now, relative to the middle of the domain: piece [n_pieces][4]. */
LAW svec3 contact_striker_place(GLOBAL const state *restrict striker_pose, brc_size at, state middle_x, state middle_y, state middle_z)
{
    return (svec3){striker_pose[at] - middle_x, striker_pose[at + 1] - middle_y, striker_pose[at + 2] - middle_z};
}
LAW svec3 contact_striker_turn(GLOBAL const state *restrict striker_pose, brc_size at, svec3 a)
{
    GLOBAL const state *restrict r = striker_pose + at + 3;
    return (svec3){r[0] * a.x + r[1] * a.y + r[2] * a.z, r[3] * a.x + r[4] * a.y + r[5] * a.z, r[6] * a.x + r[7] * a.y + r[8] * a.z};
}
KERNEL void contact_pieces(int n_pieces, state middle_x, state middle_y, state middle_z, GLOBAL const int *restrict piece_striker,
                           GLOBAL const int *restrict piece_kind, GLOBAL const state *restrict piece_own, GLOBAL const state *restrict striker_pose,
                           GLOBAL state *restrict piece)
{
    FOR_EACH_ITEM(q, n_pieces) {
        const brc_size at = (brc_size)piece_striker[q] * 12, to = (brc_size)q * 4;
        const svec3 own = {piece_own[to], piece_own[to + 1], piece_own[to + 2]}, far = contact_striker_place(striker_pose, at, middle_x, middle_y, middle_z);
        const svec3 turned = contact_striker_turn(striker_pose, at, own);
        const int wall = piece_kind[q] == 2;
        const svec3 now = wall ? turned : svec3_add(far, turned);
        piece[to] = now.x;
        piece[to + 1] = now.y;
        piece[to + 2] = now.z;
        piece[to + 3] = wall ? piece_own[to + 3] + svec3_dot(turned, far) : piece_own[to + 3];
    }
}
/* How far pieces moved since `piece`, as contact_moved tells it of elements; span: how far from the middle anything may be that meets a plane [m]. */
KERNEL void contact_pieces_moved(int n_pieces, int first, state middle_x, state middle_y, state middle_z, state span, GLOBAL const int *restrict piece_striker,
                                 GLOBAL const int *restrict piece_kind, GLOBAL const state *restrict piece_own, GLOBAL const state *restrict striker_pose,
                                 GLOBAL const state *restrict motion, GLOBAL const state *restrict piece, GLOBAL state *restrict moved)
{
    FOR_EACH_ITEM(q, n_pieces) {
        const brc_size at = (brc_size)piece_striker[q] * 12, to = (brc_size)q * 4, way = (brc_size)(first + q) * 3, on = (brc_size)piece_striker[q] * 6;
        const svec3 own = {piece_own[to], piece_own[to + 1], piece_own[to + 2]}, far = contact_striker_place(striker_pose, at, middle_x, middle_y, middle_z);
        const svec3 turned = contact_striker_turn(striker_pose, at, own), was = {piece[to], piece[to + 1], piece[to + 2]};
        const svec3 v = {motion[on], motion[on + 1], motion[on + 2]}, w = {motion[on + 3], motion[on + 4], motion[on + 5]};
        const int wall = piece_kind[q] == 2;
        const state lever = wall ? span : svec3_length(own) + piece_own[to + 3];
        const state rise = wall ? piece_own[to + 3] + svec3_dot(turned, far) - piece[to + 3] : STATE(0);
        const svec3 off = svec3_sub(wall ? turned : svec3_add(far, turned), was);
        const state speed = svec3_length(v) + lever * svec3_length(w);
        moved[way] = wall ? (rise < 0 ? -rise : rise) + span * svec3_length(off) : svec3_length(off);
        moved[way + 1] = speed * speed;
        moved[way + 2] = 0;
    }
}
LAW int contact_near_piece(GLOBAL const state *restrict built, int e, GLOBAL const state *restrict piece, GLOBAL const int *restrict piece_kind, int q, state skin)
{
    GLOBAL const state *restrict a = built + (brc_size)e * 4;
    GLOBAL const state *restrict b = piece + (brc_size)q * 4;
    if (piece_kind[q] == 2) return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - b[3] < a[3] + skin;
    const state x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], reach = a[3] + b[3] + skin;
    return x * x + y * y + z * z < reach * reach;
}

/* How many others are near each exposed element, bonds not asked. */
KERNEL void contact_count(int m, state skin, state per_edge, int mask, int n_pieces, GLOBAL const state *restrict piece,
                          GLOBAL const int *restrict piece_kind, GLOBAL const int *restrict list, GLOBAL const state *restrict built,
                          GLOBAL const int *restrict first, GLOBAL const int *restrict last, GLOBAL const int *restrict row, GLOBAL int *restrict count)
{
    FOR_EACH_ITEM(k, m) {
        const int e = list[k];
        const contact_cell home = contact_cell_of(built, e, per_edge);
        int near = 0;
        for (int step = 0; step < 27; ++step) {
            const contact_cell cell = {home.x + step % 3 - 1, home.y + step / 3 % 3 - 1, home.z + step / 9 - 1};
            const int key = contact_key(cell, mask);
            for (int at = first[key]; at < last[key]; ++at) {
                const int j = row[at];
                const contact_cell own = contact_cell_of(built, j, per_edge);
                near += j != e && own.x == cell.x && own.y == cell.y && own.z == cell.z && contact_near(built, e, j, skin);
            }
        }
        for (int q = 0; q < n_pieces; ++q) near += contact_near_piece(built, e, piece, piece_kind, q, skin);
        count[k] = near;
    }
}

/* May two elements touch that are near each other? Not while a bond joins them, nor, if they never had one, while both are bonded to a third: those are in
 * touch at an edge or a corner in the reference, and what holds them is the third. Once bonded and broken they may. */
LAW int contact_allowed(int i, int j, int within, GLOBAL const int *restrict body, GLOBAL const int *restrict row_start,
                        GLOBAL const int *restrict neighbour, GLOBAL const int *restrict original)
{
    int bonded = 0, was = 0, third = 0;
    if (body[i] != body[j]) return 1;
    if (!within) return 0;
    for (int slot = row_start[i / C]; slot < row_start[i / C + 1]; ++slot) {
        const brc_size at = (brc_size)slot * C + i % C;
        const int k = neighbour[at];
        bonded |= k == j;
        was |= original[at] == j;
        if (k == i || third) continue;
        for (int other = row_start[k / C]; other < row_start[k / C + 1]; ++other) third |= neighbour[(brc_size)other * C + k % C] == j;
    }
    return !bonded && (was || !third);
}

/* The entries of each exposed element, sorted by id; owned [m]: pairs in which its id is the lower one. */
KERNEL void contact_fill(int m, int rows, state skin, state per_edge, int mask, int within, int n_pieces, GLOBAL const state *restrict piece,
                         GLOBAL const int *restrict piece_kind, GLOBAL const int *restrict list, GLOBAL const state *restrict built,
                         GLOBAL const int *restrict first, GLOBAL const int *restrict last, GLOBAL const int *restrict row,
                         GLOBAL const int *restrict id, GLOBAL const int *restrict body, GLOBAL const int *restrict row_start,
                         GLOBAL const int *restrict neighbour, GLOBAL const int *restrict original, GLOBAL const int *restrict start,
                         GLOBAL int *restrict entry, GLOBAL int *restrict used, GLOBAL int *restrict owned)
{
    FOR_EACH_ITEM(k, m) {
        const int e = list[k], begin = start[k];
        const contact_cell home = contact_cell_of(built, e, per_edge);
        int n = 0, own_pairs = 0;
        for (int step = 0; step < 27; ++step) {
            const contact_cell cell = {home.x + step % 3 - 1, home.y + step / 3 % 3 - 1, home.z + step / 9 - 1};
            const int key = contact_key(cell, mask);
            for (int at = first[key]; at < last[key]; ++at) {
                const int j = row[at];
                const contact_cell own = contact_cell_of(built, j, per_edge);
                if (j == e || own.x != cell.x || own.y != cell.y || own.z != cell.z || !contact_near(built, e, j, skin)) continue;
                if (!contact_allowed(e, j, within, body, row_start, neighbour, original)) continue;
                int to = n;
                while (to > 0 && id[entry[begin + to - 1]] > id[j]) {
                    entry[begin + to] = entry[begin + to - 1];
                    to -= 1;
                }
                entry[begin + to] = j;
                n += 1;
                own_pairs += id[j] > id[e];
            }
        }
        for (int q = 0; q < n_pieces; ++q)
            if (contact_near_piece(built, e, piece, piece_kind, q, skin)) {
                entry[begin + n] = rows + q; /* ids of pieces follow those of elements */
                n += 1;
                own_pairs += 1;
            }
        used[k] = n;
        owned[k] = own_pairs;
    }
}

/* ---- pairs ---- */

/* Number of the pair of row i, the lower id, and row j; -1: not in the list. */
LAW int contact_pair_of(int i, int j, GLOBAL const int *restrict slot_of, GLOBAL const int *restrict start, GLOBAL const int *restrict used,
                        GLOBAL const int *restrict entry, GLOBAL const int *restrict pair)
{
    const int k = slot_of[i];
    if (slot_of[i + 1] == k) return -1; /* not exposed */
    for (int at = start[k]; at < start[k] + used[k]; ++at)
        if (entry[at] == j) return pair[at];
    return -1;
}

/* Pairs seen from their lower id: numbers in the order of rows and then of ids. pair_start [m + 1]. */
KERNEL void contact_own_pairs(int m, GLOBAL const int *restrict list, GLOBAL const int *restrict start, GLOBAL const int *restrict used,
                              GLOBAL const int *restrict entry, GLOBAL const int *restrict id, GLOBAL const int *restrict pair_start,
                              GLOBAL int *restrict pair, GLOBAL int *restrict ends)
{
    FOR_EACH_ITEM(k, m) {
        const int e = list[k];
        int next = pair_start[k];
        for (int at = start[k]; at < start[k] + used[k]; ++at) {
            const int j = entry[at];
            if (id[j] > id[e]) {
                pair[at] = next;
                ends[2 * (brc_size)next] = e;
                ends[2 * (brc_size)next + 1] = j;
                next += 1;
            }
        }
    }
}
KERNEL void contact_other_pairs(int m, GLOBAL const int *restrict list, GLOBAL const int *restrict slot_of, GLOBAL const int *restrict start,
                                GLOBAL const int *restrict used, GLOBAL const int *restrict entry, GLOBAL const int *restrict id,
                                GLOBAL int *restrict pair)
{
    FOR_EACH_ITEM(k, m) {
        const int e = list[k];
        for (int at = start[k]; at < start[k] + used[k]; ++at) {
            const int j = entry[at];
            if (id[j] < id[e]) {
                const int theirs = slot_of[j];
                for (int other = start[theirs]; other < start[theirs] + used[theirs]; ++other)
                    if (entry[other] == e) pair[at] = -1 - pair[other];
            }
        }
    }
}

/* What pairs remember goes over from the lists before; new pairs have touched nothing. history [n_pairs][CONTACT_HISTORY]. */
KERNEL void contact_carry(int n_pairs, int had, GLOBAL const int *restrict ends, GLOBAL const int *restrict old_slot_of,
                          GLOBAL const int *restrict old_start, GLOBAL const int *restrict old_used, GLOBAL const int *restrict old_entry,
                          GLOBAL const int *restrict old_pair, GLOBAL const state *restrict old_history, GLOBAL state *restrict history)
{
    FOR_EACH_ITEM(p, n_pairs) {
        const int before = had ? contact_pair_of(ends[2 * (brc_size)p], ends[2 * (brc_size)p + 1], old_slot_of, old_start, old_used, old_entry, old_pair) : -1;
        for (int c = 0; c < CONTACT_HISTORY; ++c)
            history[(brc_size)p * CONTACT_HISTORY + c] = before >= 0 ? old_history[(brc_size)before * CONTACT_HISTORY + c] : STATE(0);
    }
}
