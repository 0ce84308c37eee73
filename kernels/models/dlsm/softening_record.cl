/* Records of the open faces of cells (softening.cl, softening_onset.cl).
 * Vectors of an entry are seen from its own element. Rows [n_slots][3][C], which every evaluation of forces reads:
 * opening: w [m]; edge_opening: v, by how much this side of the face opens more than w and the other less, the same
 * seen from both [m]; both 0 of faces that never opened. crack [n_slots][C][SOFT_WIDTH], of an entry: what the last
 * step added to w, SHIFT [m], and to v, SIDE_SHIFT [m]; AXIS: of the crack, in the undeformed body; START, ENERGY:
 * soft_face (ENERGY before the onset: G_c S) [N] [J]; EXPONENTIAL: 1, else linear; WIDEST: largest opening, |w| and |v|
 * together [m]; COSINE of normal and axis at the onset; of a face in an interface, whose plane no crack
 * chooses, minus that to the interface's normal, which is in SHIFT until then, from the start (others: 0 before the
 * onset) [-]; TILT: what the direction of the opening leaves of ENERGY, 1 in an interface [-]; TURNS: 1 of a face whose
 * edge opens, SOFT_SLIDES of one that slides: by shear, along the plane across AXIS, which has no v, SOFT_ALONG of one
 * that opens along its interface, in whatever way; PULL: force of the
 * bond on the own element at the last evaluation [N]; SIDE_PULL: by how much this side pulled more than the other at
 * the last evaluation [N], or RUBS: what the last step rubbed off [J]; ONSET: principal stress at the onset [Pa];
 * SPENT: energy that its cohesion took so far but for what is HELD, which comes back [J]; BOOKED: what of SPENT the
 * last step added [J]. Entries: open: 0 whole, SOFT_OPENS from the onset on, SOFT_APART from the end of the cohesion
 * on; lead: 1 on the side with the lower id, which computes for both and alone has the whole record: the other has
 * ONSET, SPENT, HELD, BOOKED, RUBS and TURNS. Elements [n]: n_open: open faces that hold, n_lead: those that it leads;
 * reach: sum of |A^-1 s| over all of them, or more (soft_count) [1/m]. */

#define SOFT_SHIFT 0
#define SOFT_SIDE_SHIFT 3
#define SOFT_AXIS 6
#define SOFT_START 9
#define SOFT_ENERGY 10
#define SOFT_EXPONENTIAL 11
#define SOFT_WIDEST 12
#define SOFT_COSINE 13
#define SOFT_TILT 14
#define SOFT_TURNS 15
#define SOFT_PULL 16
#define SOFT_SIDE_PULL 19
#define SOFT_RUBS 19
#define SOFT_ONSET 22
#define SOFT_SPENT 23
#define SOFT_HELD 24
#define SOFT_BOOKED 25
#define SOFT_WIDTH 26
#define SOFT_SLIDES REAL(2)
#define SOFT_ALONG REAL(-1)
#define SOFT_OPENS 1  /* open: against its cohesion */
#define SOFT_APART 2  /* open: its cohesion ended; it still shuts */
#define SOFT_WISH 100 /* in mark: the bond is to open */

#define SOFT_ENTRY ((brc_size)slot * C + (brc_size)(e % C))
#define SOFT_NUMBER(entry, what) crack[(entry)*SOFT_WIDTH + SOFT_##what]
#define SOFT_IS_SLIDING(entry) (SOFT_NUMBER(entry, TURNS) > REAL(1))

LAW soft_vector soft_part(GATHER(coeff) crack, brc_size entry, int what)
{
    GLOBAL const coeff *p = crack + entry * SOFT_WIDTH + what;
    return (soft_vector){p[0], p[1], p[2]};
}
/* The vector of an entry in a row, as its area vector [m^2]. */
LAW soft_vector soft_row(OWN(coeff) row, brc_size entry)
{
    GLOBAL const coeff *p = row + (entry / C) * 3 * C + entry % C;
    return (soft_vector){p[0], p[C], p[2 * C]};
}
/* Any of the elements has open faces; one of these is in a slot. */
LAW int soft_has_open(members who, OWN(int) n_open)
{
#define NUMBER(l) n_open[LANE_ITEM(who.own, l)]
    const lane_int number = who.listed ? LANE_MAKE(lane_int, NUMBER) : int_load(n_open, (brc_size)who.first);
#undef NUMBER
    return LANE_ANY(number);
}
LAW int soft_slot_open(members who, OWN(int) open, int slot)
{
    if (!who.listed) {
        const lane_int is = int_block(open, slot, who.lane0);
        return LANE_ANY(is);
    }
    const lane_int at = members_entry(who, slot, 1);
#define IS(l) open[LANE_ITEM(at, l)]
    const lane_int is = members_has(who, slot) & LANE_MAKE(lane_int, IS);
#undef IS
    return LANE_ANY(is);
}
/* sum - a (x) b */
LAW lane_mat3 soft_less_outer(lane_mat3 sum, lane_vec3 a, lane_vec3 b)
{
    return (lane_mat3){sum.xx - a.x * b.x, sum.xy - a.x * b.y, sum.xz - a.x * b.z,
                       sum.yx - a.y * b.x, sum.yy - a.y * b.y, sum.yz - a.y * b.z,
                       sum.zx - a.z * b.x, sum.zy - a.z * b.y, sum.zz - a.z * b.z};
}
/* The bonds in a slot. */
LAW lane soft_bond_modulus(members who, OWN(int) neighbour, GATHER(coeff) modulus, coeff k_one, int slot)
{
#if BRC_MANY_MATERIALS
    return lane_min(members_number(who, modulus), gather_component(modulus, members_neighbour(who, neighbour, slot)));
#else
    (void)who, (void)neighbour, (void)modulus, (void)slot;
    return LANE_ZERO + k_one;
#endif
}
