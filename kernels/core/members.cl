/* The W elements that a work-item of an element pass does, and where what belongs to them is stored: a group, side by
 * side in one slice, or any W elements of a list (the rings around broken bonds, rings.cl). Passes are written once for
 * both; `listed` is a constant where a kernel makes its members, so that each kernel compiles to its own reading alone.
 * Rows of listed elements differ in length: beyond its own a row has missing bonds, whose neighbour is home and whose
 * face has no area. */
typedef struct {
    int listed;
    int first, slice, lane0; /* a group: row of its first element, slice, first lane */
    int begin, end;          /* slots to go through */
    lane_int own;            /* rows of the elements */
    lane_int start, slots;   /* listed: first slot and number of slots of each */
    lane_int lanes;          /* listed: place in the slice */
} members;

LAW members members_of_group(int group, OWN(int) row_start)
{
    const int slice = SLICE_OF(group), first = group * W;
    const lane_int own = lane_own(first);
    return (members){0, first, slice, FIRST_LANE_OF(group), row_start[slice], row_start[slice + 1], own, own, own, own};
}

/* Elements W item, ... of the list of n; behind its end the last one over and over. */
LAW members members_of_list(int item, int n, OWN(int) list, OWN(int) row_start)
{
#define OWN_LANE(l) list[item * W + 0x##l < n ? item * W + 0x##l : n - 1]
    const lane_int own = LANE_MAKE(lane_int, OWN_LANE);
#undef OWN_LANE
#define SLOTS(l) (row_start[LANE_ITEM(own, l) / C + 1] - row_start[LANE_ITEM(own, l) / C])
    const lane_int slots = LANE_MAKE(lane_int, SLOTS);
#undef SLOTS
#define START(l) (LANE_ITEM(slots, l) > 0 ? row_start[LANE_ITEM(own, l) / C] : 0)
    const lane_int start = LANE_MAKE(lane_int, START);
#undef START
#define PLACE(l) (LANE_ITEM(own, l) % C)
    const lane_int lanes = LANE_MAKE(lane_int, PLACE);
#undef PLACE
    int most = 0;
#define MOST(l) most = LANE_ITEM(slots, l) > most ? LANE_ITEM(slots, l) : most;
    LANE_EACH(MOST)
#undef MOST
    return (members){1, 0, 0, 0, 0, most, own, start, slots, lanes};
}

/* Listed: all bits where an element has this slot, none behind the end of its row. */
LAW lane_int members_has(members m, int slot) { return LANE_ABOVE(m.slots, slot); }
/* Listed: where component 0 of [slot][n][C] is for each; behind the end of its row its first slot. */
LAW lane_int members_entry(members m, int slot, int n)
{
    return (m.start + (members_has(m, slot) & slot)) * (n * C) + m.lanes;
}
/* Listed: where component 0 of [slice][n][C] is for each. */
LAW lane_int members_record(members m, int n) { return (m.own - m.lanes) * n + m.lanes; }

/* Material constants: scalars, or gathered from [slice][4][C] (lambda, mu, k, ell). */
#if BRC_MANY_MATERIALS
#define MEMBERS_MATERIAL(component, scalar) members_block(who, material, 4, component)
#else
#define MEMBERS_MATERIAL(component, scalar) (LANE_ZERO + (scalar))
#endif

/* ---- rows: of the bonds in one slot ---- */
LAW lane_int members_neighbour(members m, OWN(int) neighbour, int slot)
{
    if (!m.listed) return int_block(neighbour, slot, m.lane0);
    const lane_int at = members_entry(m, slot, 1), has = members_has(m, slot);
#define NEXT(l) neighbour[LANE_ITEM(at, l)]
    return (has & LANE_MAKE(lane_int, NEXT)) | (~has & m.own);
#undef NEXT
}
/* The slot, or the last. */
LAW int members_slot(members m, int slot) { return slot < m.end ? slot : m.end - 1; }
/* The same from one slot to that `turns` behind it: a GPU asks for those before it waits for what these have. */
LAW lane_int members_first_neighbour(members m, OWN(int) neighbour, int turn)
{
    return SPLIT_LOOPS && m.begin < m.end ? members_neighbour(m, neighbour, members_slot(m, m.begin + turn)) : m.own;
}
LAW lane_int members_next_neighbour(members m, OWN(int) neighbour, int slot, int turns, lane_int *next)
{
    if (!SPLIT_LOOPS) return members_neighbour(m, neighbour, slot);
    const lane_int now = *next;
    *next = members_neighbour(m, neighbour, members_slot(m, slot + turns));
    return now;
}
LAW lane members_row1(members m, OWN(coeff) p, int slot)
{
    return m.listed ? gather_component(p, members_entry(m, slot, 1))
                    : lane_load(p, (brc_size)slot * C + (brc_size)m.lane0);
}
LAW lane_vec3 members_row3(members m, OWN(coeff) p, int slot)
{
    if (!m.listed) return lane_block3(p, slot, m.lane0);
    const lane_int at = members_entry(m, slot, 3);
    return (lane_vec3){gather_component(p, at), gather_component(p + C, at), gather_component(p + 2 * C, at)};
}
/* 1, and 0 behind the end of an element's row. */
LAW lane members_there(members m, int slot)
{
    const lane_int has = members_has(m, slot);
    return LANE_DIFFERENT(has, 0);
}
/* Areas, as numbers and as vectors. */
LAW lane members_face1(members m, OWN(coeff) area, int slot)
{
    const lane s = members_row1(m, area, slot);
    return m.listed ? members_there(m, slot) * s : s;
}
LAW lane_vec3 members_face3(members m, OWN(coeff) area, int slot)
{
    const lane_vec3 s = members_row3(m, area, slot);
    return m.listed ? lane_vec3_scale(members_there(m, slot), s) : s;
}
/* What a group asks for ahead; a list is short. */
LAW void members_ahead1(members m, OWN(coeff) p, int slot)
{
    if (!m.listed) rows_ahead1(p, slot);
}
LAW void members_ahead3(members m, OWN(coeff) p, int slot)
{
    if (!m.listed) rows_ahead3(p, slot);
}
LAW void members_records_ahead9(members m, OWN(coeff) p)
{
    if (!m.listed) records_ahead9(p, m.first);
}
LAW void members_later(members m, GATHER(coeff) p, int width, OWN(int) ahead)
{
    if (!m.listed) records_later(p, width, ahead, m.first);
}
LAW void members_states_later(members m, GATHER(state) p, int width, OWN(int) ahead)
{
    if (!m.listed) states_later(p, width, ahead, m.first);
}

/* ---- of the elements ---- */
LAW lane members_number(members m, OWN(coeff) p)
{
    return m.listed ? gather_component(p, m.own) : lane_load(p, (brc_size)m.first);
}
/* A component of [slice][n][C]. */
LAW lane members_block(members m, OWN(coeff) p, int n, int component)
{
    return m.listed ? gather_component(p + component * C, members_record(m, n))
                    : lane_block(p, m.slice, n, component, m.lane0);
}
LAW lane_sym3 members_block6(members m, OWN(coeff) p)
{
    if (!m.listed) return lane_block6(p, m.slice, m.lane0);
    const lane_int at = members_record(m, 6);
    return (lane_sym3){gather_component(p, at),         gather_component(p + C, at),
                       gather_component(p + 2 * C, at), gather_component(p + 3 * C, at),
                       gather_component(p + 4 * C, at), gather_component(p + 5 * C, at)};
}
/* sum + factor times [block][9][C] of elements whose slice has a block (boundary[slice] >= 0). */
LAW lane_mat3 members_add_boundary(members m, lane_mat3 sum, lane factor, OWN(int) boundary, OWN(coeff) p)
{
    if (!m.listed)
        return boundary[m.slice] < 0
                   ? sum
                   : lane_mat3_add(sum, lane_mat3_scale(factor, lane_block9(p, boundary[m.slice], m.lane0)));
#define BLOCK(l) boundary[LANE_ITEM(m.own, l) / C]
    const lane_int block = LANE_MAKE(lane_int, BLOCK);
#undef BLOCK
#define OF_BLOCK(l) (LANE_ITEM(block, l) < 0 ? 0 : LANE_ITEM(block, l) * 9 * C + LANE_ITEM(m.own, l) % C)
    const lane_int at = LANE_MAKE(lane_int, OF_BLOCK);
#undef OF_BLOCK
#define HAS(l) (LANE_ITEM(block, l) < 0 ? REAL(0) : REAL(1))
    const lane has = LANE_MAKE(lane, HAS) * factor;
#undef HAS
    const lane_mat3 x = {
        gather_component(p, at),         gather_component(p + C, at),     gather_component(p + 2 * C, at),
        gather_component(p + 3 * C, at), gather_component(p + 4 * C, at), gather_component(p + 5 * C, at),
        gather_component(p + 6 * C, at), gather_component(p + 7 * C, at), gather_component(p + 8 * C, at)};
    return lane_mat3_add(sum, lane_mat3_scale(has, x));
}

/* ---- stores into [element][n] ---- */
LAW void members_store9(members m, SCATTER(coeff) p, lane_mat3 a)
{
    if (!m.listed) {
        lane_store9(p, m.first, a);
        return;
    }
#define PUT_LANE(l)                                                                                                    \
    {                                                                                                                  \
        GLOBAL coeff *q = p + (brc_size)LANE_ITEM(m.own, l) * 9;                                                       \
        q[0] = LANE_ITEM(a.xx, l), q[1] = LANE_ITEM(a.xy, l), q[2] = LANE_ITEM(a.xz, l);                               \
        q[3] = LANE_ITEM(a.yx, l), q[4] = LANE_ITEM(a.yy, l), q[5] = LANE_ITEM(a.yz, l);                               \
        q[6] = LANE_ITEM(a.zx, l), q[7] = LANE_ITEM(a.zy, l), q[8] = LANE_ITEM(a.zz, l);                               \
    }
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
LAW void members_store6(members m, PUT(coeff) p, lane_sym3 a)
{
    if (!m.listed) {
        lane_store6(p, m.first, a);
        return;
    }
#define PUT_LANE(l)                                                                                                    \
    {                                                                                                                  \
        GLOBAL coeff *q = p + (brc_size)LANE_ITEM(m.own, l) * 6;                                                       \
        q[0] = LANE_ITEM(a.xx, l), q[1] = LANE_ITEM(a.yy, l), q[2] = LANE_ITEM(a.zz, l);                               \
        q[3] = LANE_ITEM(a.yz, l), q[4] = LANE_ITEM(a.xz, l), q[5] = LANE_ITEM(a.xy, l);                               \
    }
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
LAW void members_store3(members m, PUT(state) p, lane_vec3 a)
{
    if (!m.listed) {
        state_store3(p, m.first, a);
        return;
    }
#define PUT_LANE(l)                                                                                                    \
    {                                                                                                                  \
        GLOBAL state *q = p + (brc_size)LANE_ITEM(m.own, l) * 3;                                                       \
        q[0] = (state)LANE_ITEM(a.x, l), q[1] = (state)LANE_ITEM(a.y, l), q[2] = (state)LANE_ITEM(a.z, l);             \
    }
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
LAW void members_store1(members m, PUT(state) p, lane a)
{
    if (!m.listed) {
        state_store1(p, m.first, a);
        return;
    }
#define PUT_LANE(l) p[LANE_ITEM(m.own, l)] = (state)LANE_ITEM(a, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
/* The same, of numbers that are no state. */
LAW void members_put1(members m, PUT(coeff) p, lane a)
{
#define PUT_LANE(l) p[LANE_ITEM(m.own, l)] = LANE_ITEM(a, l);
    LANE_EACH(PUT_LANE)
#undef PUT_LANE
}
