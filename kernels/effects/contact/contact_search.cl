/* Which elements may touch: those that are exposed, whose balls, grown by a skin, meet, and between which no plane
 * stands (contact_sift.h). Rebuilt when something has moved by half the skin (contact_motion.cl); in between the list
 * holds every pair that can touch. Positions are relative to the middle of the domain. Of the lists: list [m]: rows of
 * the exposed elements, ascending; slot_of [n + 1]: place of a row in it (of an exposed row; else that of the next
 * one); start [m + 1], used [m]: entries of each; entry: the other row, by ascending id, and n + piece of a striker;
 * pair: number of the pair, seen from its lower id; below 0: -1 - pair, seen from the higher one; with_pairs: those
 * slots of list that have entries at all. `list` is `listed` where far rows are read, which no bond reaches. */

#define CONTACT_HISTORY 20

/* Elements that lost a bond are exposed from then on. fresh [n]: 1 for those that lost one since this was asked last;
 * seen [n]: what they had lost then. */
KERNEL void contact_expose(int n_rows, OWN(state) broken, UPDATE(int) seen, PUT(int) exposed, PUT(int) fresh)
{
    FOR_EACH_ITEM(e, n_rows) {
        const int lost = (int)broken[e];
        fresh[e] = lost != seen[e];
        seen[e] = lost;
        if (lost > 0) exposed[e] = 1;
    }
}

/* Groups of elements of which a bond was chosen in this step (fracture.cl). found [n_groups]. */
KERNEL void contact_marked(int n, int step, OWN(int) mark, PUT(state) found)
{
    FOR_EACH_ITEM(group, n) { found[group] = mark[group] == step ? STATE(1) : STATE(0); }
}

KERNEL void contact_list(int n, OWN(int) exposed, OWN(int) slot_of, SCATTER(int) list)
{
    FOR_EACH_ITEM(e, n) {
        if (exposed[e]) list[slot_of[e]] = e;
    }
}

/* ---- the grid ---- */

typedef struct {
    int x, y, z;
} contact_cell;

LAW int contact_coordinate(state x, state per_edge)
{
    const state far = STATE(1000000), at = x * per_edge, held = at > far ? far : at < -far ? -far : at;
    const int down = (int)held;
    return (state)down > held ? down - 1 : down;
}
LAW contact_cell contact_cell_of(GATHER(state) built, int e, state per_edge)
{
    const contact_cell cell = {contact_coordinate(built[(brc_size)e * 4], per_edge),
                               contact_coordinate(built[(brc_size)e * 4 + 1], per_edge),
                               contact_coordinate(built[(brc_size)e * 4 + 2], per_edge)};
    return cell;
}
/* Cell `step` of the 27 about one. */
LAW contact_cell contact_cell_about(contact_cell home, int step)
{
    return (contact_cell){home.x + step % 3 - 1, home.y + step / 3 % 3 - 1, home.z + step / 9 - 1};
}
LAW int contact_key(contact_cell cell, int mask)
{
    const unsigned int mixed =
        (unsigned int)cell.x * 73856093u ^ (unsigned int)cell.y * 19349663u ^ (unsigned int)cell.z * 83492791u;
    return (int)((mixed ^ mixed >> 15) & (unsigned int)mask);
}

KERNEL void contact_keys(int m, state per_edge, int mask, OWN(int) list, OWN(state) built, PUT(int) key, PUT(int) row)
{
    FOR_EACH_ITEM(k, m) {
        key[k] = contact_key(contact_cell_of(built, list[k], per_edge), mask);
        row[k] = list[k];
    }
}

/* Where each key begins and ends among the sorted ones; keys that none has keep first = last = 0. */
KERNEL void contact_buckets(int m, OWN(int) key, SCATTER(int) first, SCATTER(int) last)
{
    FOR_EACH_ITEM(k, m) {
        const int own = key[k];
        if (k == 0 || key[k - 1] != own) first[own] = k;
        if (k == m - 1 || key[k + 1] != own) last[own] = k + 1;
    }
}

/* Balls about two elements that meet when each grows by half the skin. The same from both sides to the last bit. */
LAW int contact_near(GATHER(state) built, int i, int j, state skin)
{
    GLOBAL const state *restrict a = built + (brc_size)i * 4;
    GLOBAL const state *restrict b = built + (brc_size)j * 4;
    const state x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], reach = a[3] + b[3] + skin;
    return x * x + y * y + z * z < reach * reach;
}

/* Distance of the ball about an element from that of a piece, or from its half-space [m]. */
LAW state contact_piece_gap(OWN(state) built, int e, GATHER(state) piece, GATHER(int) piece_kind, int q)
{
    GLOBAL const state *restrict a = built + (brc_size)e * 4;
    GLOBAL const state *restrict b = piece + (brc_size)q * 4;
    if (piece_kind[q] == 2) return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - b[3] - a[3];
    const state x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return SQRT_STATE(x * x + y * y + z * z) - a[3] - b[3];
}

/* ---- what a break changes of the list ----
 *
 * Who is an entry of whom depends on places and maps when the last search was made, on bonds, and on who is exposed and
 * rigid. Of these a break changes only what belongs to the elements that lost a bond (contact_allowed asks for bonds of
 * either side, and a third one that parts from one of them is a bond less of that one). So all entries of these are
 * looked for anew, and all of those that are near one; the others keep theirs. The list is that of a search of all from
 * the same places, and holds as long: new elements are listed where they were at the last search, as old ones are, and
 * their motion counts from there, the common motion taken off (contact_motion.cl). */

/* The slots that are looked for: again [m], 0 before. whole: all of them. */
KERNEL void contact_again(int m, int whole, state skin, state per_edge, int mask, OWN(int) list, GATHER(int) slot_of,
                          OWN(int) fresh, GATHER(state) built, GATHER(int) first, GATHER(int) last, GATHER(int) row,
                          SCATTER(int) again)
{
    FOR_EACH_ITEM(k, m) {
        const int e = list[k];
        if (whole || fresh[e]) STORE_SAME(again + k, 1);
        if (!whole && fresh[e]) {
            const contact_cell home = contact_cell_of(built, e, per_edge);
            for (int step = 0; step < 27; ++step) {
                const int key = contact_key(contact_cell_about(home, step), mask);
                for (int at = first[key]; at < last[key]; ++at)
                    if (contact_near(built, e, row[at], skin)) STORE_SAME(again + slot_of[row[at]], 1);
            }
        }
    }
}

/* Room for the entries that slots keep. */
KERNEL void contact_kept(int m, OWN(int) list, OWN(int) again, OWN(int) old_slot_of, GATHER(int) old_used,
                         PUT(int) count)
{
    FOR_EACH_ITEM(k, m) {
        if (!again[k]) count[k] = old_used[old_slot_of[list[k]]];
    }
}
/* The same entries; owned, any as contact_fill. */
KERNEL void contact_keep(int m, OWN(int) listed, OWN(int) again, GATHER(int) id, OWN(int) old_slot_of,
                         GATHER(int) old_start, GATHER(int) old_used, GATHER(int) old_entry, OWN(int) start,
                         PUT(int) entry, PUT(int) used, PUT(int) owned, PUT(int) any)
{
    FOR_EACH_ITEM(k, m) {
        if (!again[k]) {
            const int e = listed[k], old = old_slot_of[e], from = old_start[old], n = old_used[old];
            int own_pairs = 0;
            for (int at = 0; at < n; ++at) {
                const int j = old_entry[from + at];
                entry[start[k] + at] = j;
                own_pairs += id[j] > id[e];
            }
            used[k] = n;
            owned[k] = own_pairs;
            any[k] = n > 0;
        }
    }
}

/* Pairs that a break may have changed: one of the two lost a bond, or is `touched` by what broke (rings.cl). flag
 * [n_pairs]. */
KERNEL void contact_changed(int n_pairs, int n, OWN(int) ends, GATHER(int) fresh, GATHER(int) touched, PUT(int) flag)
{
    FOR_EACH_ITEM(p, n_pairs) {
        const int i = ends[2 * (brc_size)p], j = ends[2 * (brc_size)p + 1];
        flag[p] = fresh[i] || touched[i] || (j < n && (fresh[j] || touched[j]));
    }
}
/* The elements of these pairs are given the level `to` where they have none (rings.cl). */
KERNEL void contact_spread(int n_items, int n, int to, OWN(int) todo, OWN(int) ends, SCATTER(int) level)
{
    FOR_EACH_ITEM(k, n_items) {
        const int i = ends[2 * (brc_size)todo[k]], j = ends[2 * (brc_size)todo[k] + 1];
        if (level[i] == 0) STORE_SAME(level + i, to);
        if (j < n && level[j] == 0) STORE_SAME(level + j, to);
    }
}

/* Is row j, which has the key of a cell, in that cell, and near e? */
LAW int contact_is_near(GATHER(state) built, int e, int j, contact_cell cell, state per_edge, state skin)
{
    const contact_cell own = contact_cell_of(built, j, per_edge);
    return j != e && own.x == cell.x && own.y == cell.y && own.z == cell.z && contact_near(built, e, j, skin);
}
/* How many others are near an element in those cells that this one of a crew looks through. */
LAW int contact_near_count(GATHER(state) built, int e, state per_edge, int mask, state skin, GATHER(int) first,
                           GATHER(int) last, GATHER(int) row)
{
    const contact_cell home = contact_cell_of(built, e, per_edge);
    int near = 0;
    for (int step = CREW_PLACE; step < 27; step += CREW) {
        const contact_cell cell = contact_cell_about(home, step);
        const int key = contact_key(cell, mask);
        for (int at = first[key]; at < last[key]; ++at)
            near += contact_is_near(built, e, row[at], cell, per_edge, skin);
    }
    return near;
}

/* How many others are near the elements in the slots redo [n_crew_parts], bonds not asked. */
KERNEL void contact_count(int n_crew_parts, state skin, state per_edge, int mask, int n_pieces, GATHER(state) piece,
                          GATHER(int) piece_kind, OWN(int) redo, OWN(int) listed, GATHER(state) built,
                          GATHER(int) first, GATHER(int) last, GATHER(int) row, PUT(int) count)
{
    CREW_ROOM(room);
    FOR_EACH_CREW(item, n_crew_parts) {
        const int k = redo[item], e = listed[k];
        int near = contact_near_count(built, e, per_edge, mask, skin, first, last, row);
        for (int q = CREW_PLACE; q < n_pieces; q += CREW)
            near += contact_piece_gap(built, e, piece, piece_kind, q) < skin;
        near = CREW_ALL(room, near);
        if (CREW_FIRST) count[k] = near;
    }
}

/* May two elements touch that are near each other? Not while a bond joins them, nor, if they never had one, while both
 * are bonded to a third: those are in touch at an edge or a corner in the reference, and what holds them is the third.
 * Once bonded and broken they may. */
LAW int contact_allowed(int i, int j, int within, GATHER(int) body, GATHER(int) row_start, GATHER(int) neighbour,
                        OWN(int) original)
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
        for (int other = row_start[k / C]; other < row_start[k / C + 1]; ++other)
            third |= neighbour[(brc_size)other * C + k % C] == j;
    }
    return !bonded && (was || !third);
}

/* Polyhedra and maps of elements, and which are rigid. */
LAW contact_body contact_body_of(GATHER(state) corner, GATHER(state) plane, GATHER(int) loop_start, GATHER(int) loop,
                                 GATHER(state) radius, GATHER(int) corner_start, GATHER(int) face_start, GATHER(int) id,
                                 GATHER(int) rigid, GATHER(state) built, GATHER(state) posed, int e)
{
    return (contact_body){convex_shape_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id[e]),
                          convex_map_of(smat3_load(posed, (brc_size)e * 9)), built[(brc_size)e * 4 + 3], rigid[e]};
}

/* Does a plane keep two apart? Both sides of a pair ask alike, from the lower id. */
LAW int contact_kept_apart(GATHER(state) corner, GATHER(state) plane, GATHER(int) loop_start, GATHER(int) loop,
                           GATHER(state) radius, GATHER(int) corner_start, GATHER(int) face_start, GATHER(int) id,
                           GATHER(int) rigid, GATHER(state) built, GATHER(state) posed, int e, int j, state skin)
{
    const int low = id[e] < id[j] ? e : j, high = id[e] < id[j] ? j : e;
    const contact_body a = contact_body_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id, rigid,
                                           built, posed, low);
    const contact_body b = contact_body_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id, rigid,
                                           built, posed, high);
    const svec3 branch = svec3_sub(svec3_load(built, (brc_size)high * 4), svec3_load(built, (brc_size)low * 4));
    return contact_parted(a, b, convex_of(branch), skin);
}

/* The entries of the elements in the slots redo, sorted by id; owned [m]: pairs in which its id is the lower one; any
 * [m]: whether there are entries. In pair: who is near, then who of them may touch. clear [n]: contact_motion.cl. */
KERNEL void contact_fill(int n_crew_parts, int rows, int pose, state skin, state per_edge, int mask, int within,
                         int n_pieces, GATHER(state) piece, GATHER(int) piece_kind, OWN(int) redo, OWN(int) listed,
                         GATHER(state) built, GATHER(state) posed, GATHER(int) rigid, GATHER(state) corner,
                         GATHER(state) plane, GATHER(int) loop_start, GATHER(int) loop, GATHER(state) radius,
                         GATHER(int) corner_start, GATHER(int) face_start, GATHER(int) first, GATHER(int) last,
                         GATHER(int) row, GATHER(int) id, GATHER(int) body, GATHER(int) row_start,
                         GATHER(int) neighbour, OWN(int) original, OWN(int) start, PUT(int) entry, UPDATE(int) pair,
                         PUT(int) used, PUT(int) owned, PUT(int) any, PUT(state) clear)
{
    CREW_ROOM(room);
    CREW_STAGE(state, gap_of);
    FOR_EACH_CREW(item, n_crew_parts) {
        const int k = redo[item], e = listed[k], begin = start[k];
        const contact_cell home = contact_cell_of(built, e, per_edge);
        int near = CREW > 1 ? contact_near_count(built, e, per_edge, mask, skin, first, last, row) : 0,
            to = begin + CREW_BEFORE(room, near);
        near = CREW_ALL(room, near);
        for (int step = CREW_PLACE; step < 27; step += CREW) {
            const contact_cell cell = contact_cell_about(home, step);
            const int key = contact_key(cell, mask);
            for (int at = first[key]; at < last[key]; ++at)
                if (contact_is_near(built, e, row[at], cell, per_edge, skin)) CREW_SHARED(pair)[to++] = row[at];
        }
        if (CREW == 1) near = to - begin;
        CREW_WAIT();
        int n = 0, own_pairs = 0;
        for (int from = 0; from < near; from += CREW) {
            const int j = from + CREW_PLACE < near ? CREW_SHARED(pair)[begin + from + CREW_PLACE] : e;
            const int may = j != e && contact_allowed(e, j, within, body, row_start, neighbour, original) &&
                            !(pose != 0 && contact_kept_apart(corner, plane, loop_start, loop, radius, corner_start,
                                                              face_start, id, rigid, built, posed, e, j, skin));
            const int at = begin + n + CREW_BEFORE(room, may);
            if (may) CREW_SHARED(pair)[at] = j;
            n += CREW_ALL(room, may);
        }
        CREW_WAIT();
        for (int at = CREW_PLACE; at < n; at += CREW) {
            const int j = CREW_SHARED(pair)[begin + at], own = id[j];
            int lower = 0;
            for (int other = 0; other < n; ++other) lower += id[CREW_SHARED(pair)[begin + other]] < own;
            entry[begin + lower] = j;
            own_pairs += own > id[e];
        }
        state free_way = STATE(1e30);
        for (int from = 0; from < n_pieces; from += CREW) {
            const int q = from + CREW_PLACE;
            const state gap = q < n_pieces ? contact_piece_gap(built, e, piece, piece_kind, q) : STATE(1e30);
            const int hit = gap < skin, at = begin + n + CREW_BEFORE(room, hit);
            if (hit) entry[at] = rows + q; /* ids of pieces follow those of elements */
            if (!hit && gap < free_way) free_way = gap;
            own_pairs += hit;
            n += CREW_ALL(room, hit);
        }
        own_pairs = CREW_ALL(room, own_pairs);
        CREW_PUT(gap_of, CREW_PLACE, free_way);
        CREW_WAIT();
        for (int t = 0; t < CREW; ++t)
            free_way = CREW_NUMBER(gap_of, t, free_way) < free_way ? CREW_NUMBER(gap_of, t, free_way) : free_way;
        if (CREW_FIRST) {
            used[k] = n;
            owned[k] = own_pairs;
            any[k] = n > 0;
            clear[e] = free_way;
        }
    }
}

/* Slots with entries; at [m + 1]: running sums of any. */
KERNEL void contact_with_pairs(int m, OWN(int) any, OWN(int) at, SCATTER(int) with_pairs)
{
    FOR_EACH_ITEM(k, m) {
        if (any[k]) with_pairs[at[k]] = k;
    }
}

/* ---- pairs ---- */

/* Number of the pair of row i, the lower id, and row j; -1: not in the list. */
LAW int contact_pair_of(int i, int j, GATHER(int) slot_of, GATHER(int) start, GATHER(int) used, GATHER(int) entry,
                        GATHER(int) pair)
{
    const int k = slot_of[i];
    if (slot_of[i + 1] == k) return -1; /* not exposed */
    for (int at = start[k]; at < start[k] + used[k]; ++at)
        if (entry[at] == j) return pair[at];
    return -1;
}

/* Pairs seen from their lower id: numbers in the order of rows and then of ids. pair_start [m + 1]. */
KERNEL void contact_own_pairs(int m, OWN(int) list, OWN(int) start, OWN(int) used, OWN(int) entry, GATHER(int) id,
                              OWN(int) pair_start, PUT(int) pair, SCATTER(int) ends)
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
/* with_pairs [n_with_pairs]: slots that have entries. */
KERNEL void contact_other_pairs(int n_with_pairs, OWN(int) with_pairs, OWN(int) list, GATHER(int) slot_of,
                                GATHER(int) start, GATHER(int) used, GATHER(int) entry, GATHER(int) id,
                                SCATTER(int) pair)
{
    FOR_EACH_ITEM(item, n_with_pairs) {
        const int k = with_pairs[item], e = list[k];
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

/* The results of pairs that touch, one after the other: at [n_pairs + 1] running sums of touch. */
KERNEL void contact_pack(int n_pairs, int stride, OWN(int) touch, OWN(int) at, OWN(state) result, SCATTER(state) packed)
{
    FOR_EACH_ITEM(p, n_pairs) {
        for (int c = 0; touch[p] && c < stride; ++c)
            packed[(brc_size)at[p] * (brc_size)stride + (brc_size)c] =
                result[(brc_size)p * (brc_size)stride + (brc_size)c];
    }
}

/* What pairs remember goes over from the lists before, and with a stride above 0 the result of the last evaluation too
 * (contact.cl), as contact_pack left it; new pairs have touched nothing. whole: all pairs, else those of todo. history
 * [n_pairs][CONTACT_HISTORY], result [n_pairs][stride]. */
KERNEL void contact_carry(int n_items, int whole, int had, int stride, OWN(int) todo, OWN(int) ends,
                          GATHER(int) old_slot_of, GATHER(int) old_start, GATHER(int) old_used, GATHER(int) old_entry,
                          GATHER(int) old_pair, GATHER(state) old_history, GATHER(int) packed_at, GATHER(state) packed,
                          PUT(state) history, UPDATE(int) touch, PUT(state) result)
{
    FOR_EACH_ITEM(item, n_items) {
        const int p = whole ? item : todo[item];
        const int before = had ? contact_pair_of(ends[2 * (brc_size)p], ends[2 * (brc_size)p + 1], old_slot_of,
                                                 old_start, old_used, old_entry, old_pair)
                               : -1;
        for (int c = 0; c < CONTACT_HISTORY; ++c)
            history[(brc_size)p * CONTACT_HISTORY + c] =
                before >= 0 ? old_history[(brc_size)before * CONTACT_HISTORY + c] : STATE(0);
        touch[p] = stride > 0 && before >= 0 && packed_at[before + 1] > packed_at[before];
        if (touch[p]) {
            GLOBAL const state *restrict from = packed + (brc_size)packed_at[before] * (brc_size)stride;
            for (int c = 0; c < stride; ++c) result[(brc_size)p * (brc_size)stride + (brc_size)c] = from[c];
        }
    }
}
