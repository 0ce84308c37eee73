/* Records of the open faces of cells (softening.cl, softening_onset.cl).
 * crack [n_slots][C][SOFT_WIDTH], of an entry (vectors seen from its own element): the opening w [m]; what the last
 * step added to it, SHIFT [m]; PULL: force of the bond on the own element at the last evaluation [N]; START, ENERGY:
 * soft_face (ENERGY before the onset: G_c S) [N] [J]; ONSET: principal stress at the onset [Pa]; WIDEST: largest
 * opening, |w| and |v| together [m]; SPENT: energy that its cohesion took so far but for what is HELD, which comes back
 * [J]; BOOKED: what of SPENT the last step added [J]; COSINE of normal and principal axis at the onset [-];
 * EXPONENTIAL: 1, else linear; TILT: what the direction of the opening leaves of ENERGY [-]; AXIS: of the crack, in the
 * undeformed body; SIDE: v, by how much this side of the face opens more than w and the other less, the same seen from
 * both [m]; SIDE_SHIFT: what the last step added to it [m]; SIDE_PULL: by how much this side pulled more than the other
 * at the last evaluation [N]; TURNS: 1 of a face whose edge opens, SOFT_SLIDES of one that slides: by shear, along the
 * plane across AXIS. That one has no SIDE; RUBS: what the last step rubbed off [J]. Entries: open: 0 whole, SOFT_OPENS
 * from the onset on, SOFT_APART from the end of the cohesion on; lead: 1 on the side with the lower id, which computes
 * for both. Elements [n]: n_open: open faces that hold; reach: sum of |A^-1 s| over them [1/m]. */

#define SOFT_OPENING 0
#define SOFT_SHIFT 3
#define SOFT_PULL 6
#define SOFT_START 9
#define SOFT_ENERGY 10
#define SOFT_ONSET 11
#define SOFT_WIDEST 12
#define SOFT_SPENT 13
#define SOFT_HELD 14
#define SOFT_BOOKED 15
#define SOFT_COSINE 16
#define SOFT_EXPONENTIAL 17
#define SOFT_TILT 18
#define SOFT_AXIS 19
#define SOFT_SIDE 22
#define SOFT_SIDE_SHIFT 25
#define SOFT_SIDE_PULL 28
#define SOFT_RUBS 28
#define SOFT_TURNS 31
#define SOFT_SLIDES REAL(2)
#define SOFT_WIDTH 32
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
LAW void soft_put(SCATTER(coeff) crack, brc_size entry, int what, soft_vector a)
{
    GLOBAL coeff *p = crack + entry * SOFT_WIDTH + what;
    p[0] = a.x, p[1] = a.y, p[2] = a.z;
}
/* Area vector of an entry [m^2]. */
LAW soft_vector soft_area(OWN(coeff) area, brc_size entry)
{
    GLOBAL const coeff *p = area + (entry / C) * 3 * C + entry % C;
    return (soft_vector){p[0], p[C], p[2 * C]};
}
/* [element][9] times a vector. */
LAW soft_vector soft_times(GATHER(coeff) m, int e, soft_vector a)
{
    GLOBAL const coeff *p = m + (brc_size)e * 9;
    return (soft_vector){p[0] * a.x + p[1] * a.y + p[2] * a.z, p[3] * a.x + p[4] * a.y + p[5] * a.z,
                         p[6] * a.x + p[7] * a.y + p[8] * a.z};
}
/* A^-1 s of element e [1/m]. */
LAW soft_vector soft_pull_of(GATHER(coeff) inv_shape, int e, soft_vector s)
{
    GLOBAL const coeff *p = inv_shape + (brc_size)(e / C) * 6 * C + e % C;
    const coeff xx = p[0], yy = p[C], zz = p[2 * C], yz = p[3 * C], xz = p[4 * C], xy = p[5 * C];
    return (soft_vector){xx * s.x + xy * s.y + xz * s.z, xy * s.x + yy * s.y + yz * s.z,
                         xz * s.x + yz * s.y + zz * s.z};
}
LAW soft_vector soft_jump(GATHER(state) displacement, int i, int j)
{
    GLOBAL const state *a = displacement + (brc_size)i * 3, *b = displacement + (brc_size)j * 3;
    return (soft_vector){(coeff)(b[0] - a[0]), (coeff)(b[1] - a[1]), (coeff)(b[2] - a[2])};
}
#if BRC_MANY_MATERIALS
#define SOFT_BOND_MODULUS(e, j) (modulus[e] < modulus[j] ? modulus[e] : modulus[j])
#define SOFT_ELL(e) ell_of[e]
#else
#define SOFT_BOND_MODULUS(e, j) k_one
#define SOFT_ELL(e) ell_one
#endif
