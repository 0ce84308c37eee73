/* Open faces W at a time (softening.cl): what the laws of softening.h ask of a face and of the cells at its two ends.
 * face_row, face_entry [n_faces]: own row and entry of the leading side of each, in the order of the rows; behind the
 * end of the list the last one stands in. */

/* Rows of both cells, entry of the own side; area vector s [m^2], ratio q [1/m]. */
typedef struct {
    lane_int e, j, entry;
    lane_vec3 area;
    lane ratio;
} soft_faces;

/* Vectors of entries in rows [slot][3][C]. */
LAW lane_vec3 soft_rows(GATHER(coeff) row, lane_int entry)
{
    const lane_int at = entry + 2 * (entry & ~(C - 1));
    return (lane_vec3){gather_component(row, at), gather_component(row + C, at), gather_component(row + 2 * C, at)};
}
LAW lane_int soft_ints(GATHER(int) p, lane_int at)
{
#define ITEM(l) p[LANE_ITEM(at, l)]
    return LANE_MAKE(lane_int, ITEM);
#undef ITEM
}
LAW soft_faces soft_faces_of(lane_int e, lane_int entry, GATHER(int) neighbour, GATHER(coeff) area, GATHER(coeff) ratio)
{
    return (soft_faces){e, soft_ints(neighbour, entry), entry, soft_rows(area, entry), gather_component(ratio, entry)};
}
/* Faces W item, ... of the list. */
LAW soft_faces soft_faces_at(int item, int n_faces, OWN(int) face_row, OWN(int) face_entry, GATHER(int) neighbour,
                             GATHER(coeff) area, GATHER(coeff) ratio)
{
#define PLACE(l) (item * W + 0x##l < n_faces ? item * W + 0x##l : n_faces - 1)
#define ROW(l) face_row[PLACE(l)]
#define ENTRY(l) face_entry[PLACE(l)]
    return soft_faces_of(LANE_MAKE(lane_int, ROW), LANE_MAKE(lane_int, ENTRY), neighbour, area, ratio);
#undef ROW
#undef ENTRY
#undef PLACE
}
/* Asks for what the next ones have, which lies anywhere. */
LAW void soft_faces_ahead(int item, int n_faces, OWN(int) face_entry, GATHER(coeff) crack, GATHER(coeff) opening,
                          GATHER(coeff) edge_opening, GATHER(coeff) area)
{
#ifdef ROWS_AHEAD
    for (int l = 0; l < W; ++l) {
        const int k = item * W + W + l, entry = face_entry[k < n_faces ? k : n_faces - 1];
        const brc_size at = (brc_size)entry + 2 * (brc_size)(entry & ~(C - 1)), record = (brc_size)entry * SOFT_WIDTH;
        PREFETCH(crack, record), PREFETCH(crack, record + 8), PREFETCH(crack, record + 16);
        PREFETCH(area, at), PREFETCH(area, at + C), PREFETCH(area, at + 2 * C);
        PREFETCH(opening, at), PREFETCH(opening, at + C), PREFETCH(opening, at + 2 * C);
        PREFETCH(edge_opening, at), PREFETCH(edge_opening, at + C), PREFETCH(edge_opening, at + 2 * C);
    }
#else
    (void)item, (void)n_faces, (void)face_entry, (void)crack, (void)opening, (void)edge_opening, (void)area;
#endif
}
/* The face of one entry, in every lane. */
LAW soft_faces soft_face_of(int e, brc_size entry, GATHER(int) neighbour, GATHER(coeff) area, GATHER(coeff) ratio)
{
#define ROW(l) e
#define ENTRY(l) (int)entry
    return soft_faces_of(LANE_MAKE(lane_int, ROW), LANE_MAKE(lane_int, ENTRY), neighbour, area, ratio);
#undef ROW
#undef ENTRY
}

/* Numbers and vectors of the records. */
LAW lane soft_number(GATHER(coeff) crack, lane_int entry, int what)
{
    return gather_number(crack, entry, SOFT_WIDTH, (brc_size)what);
}
LAW lane_vec3 soft_vector_of(GATHER(coeff) crack, lane_int entry, int what)
{
    return (lane_vec3){soft_number(crack, entry, what), soft_number(crack, entry, what + 1),
                       soft_number(crack, entry, what + 2)};
}
/* The numbers of the records that move: the first SOFT_MOVES. */
typedef struct {
    lane_vec3 shift, edge_shift, axis;
    lane start, energy, exponential, widest, cosine, tilt, turns;
} soft_record;
LAW soft_record soft_record_of(GATHER(coeff) crack, lane_int entry)
{
#if LANE_SHUFFLES == 8
    const lane_columns a = lane_gather_columns(crack, entry, SOFT_WIDTH),
                       b = lane_gather_columns(crack + 8, entry, SOFT_WIDTH);
    return (soft_record){
        {a.c0, a.c1, a.c2}, {a.c3, a.c4, a.c5}, {a.c6, a.c7, b.c0}, b.c1, b.c2, b.c3, b.c4, b.c5, b.c6, b.c7};
#else
    return (soft_record){soft_vector_of(crack, entry, SOFT_SHIFT), soft_vector_of(crack, entry, SOFT_SIDE_SHIFT),
                         soft_vector_of(crack, entry, SOFT_AXIS),  soft_number(crack, entry, SOFT_START),
                         soft_number(crack, entry, SOFT_ENERGY),   soft_number(crack, entry, SOFT_EXPONENTIAL),
                         soft_number(crack, entry, SOFT_WIDEST),   soft_number(crack, entry, SOFT_COSINE),
                         soft_number(crack, entry, SOFT_TILT),     soft_number(crack, entry, SOFT_TURNS)};
#endif
}
LAW soft_face soft_law_of(soft_record r) { return (soft_face){r.start, r.energy * r.tilt, r.exponential}; }
LAW lane_mask soft_slides(soft_record r) { return LANE_LESS(lane_number(1), r.turns); }
/* Of faces whose crack is across a plane that is not that of a principal stress: what goes on through them beside that
 * fades with their cohesion (soft_passed). */
LAW lane_mask soft_passes(soft_record r) { return soft_slides(r) | LANE_LESS(r.turns, LANE_ZERO); }
/* Of interfaces, whose sides bear on each other across their smooth plane alone. */
LAW lane_mask soft_in_interface(soft_record r) { return LANE_LESS(r.cosine, LANE_ZERO); }
/* A face across the way of a slide beside it bears this part of its strength, did it not give way, and no more: with
 * all of it rough interfaces are up to a tenth stronger than smooth ones (bench/results/2026-11-30-torsion.md). */
#define SOFT_PASSED REAL(0.5)
/* What goes on through a face of an interface beside what acts on its plane, of itself [-]: the steps of a rough
 * interface push each other as it slides, which its plane does not know of, and would go on doing so. So it falls to 0
 * as the face slides further than it opens by what its strength, onset, strains it by. before: opening. */
LAW lane soft_stays(soft_faces f, soft_record r, lane_vec3 before, lane_vec3 axis, lane onset, lane k)
{
    const lane gap = lane_vec3_dot(before, axis), slid = soft_size(lane_vec3_more(before, -gap, axis)) - gap;
    const lane_mask slides = soft_in_interface(r) & LANE_LESS(LANE_ZERO, slid);
    const lane far = SOFT_PASSED * onset * (f.ratio * soft_size(f.area)); /* k times it; f.ratio |s|: the branch */
    return LANE_WHERE(slides, soft_above(REAL(1) - slid * k / far, 0), lane_number(1));
}
/* More than a tenth of what the cohesion held at the onset. push: soft_carried. */
LAW lane_mask soft_is_pushed(soft_record r, lane_vec3 push)
{
    const lane much = REAL(0.1) * r.start;
    return LANE_LESS(much * much, lane_vec3_dot(push, push));
}
/* Faces whose cohesion has ended. */
LAW lane_mask soft_apart(soft_faces f, GATHER(int) open)
{
#define APART(l) (open[LANE_ITEM(f.entry, l)] == SOFT_APART ? REAL(1) : REAL(0))
    const lane is = LANE_MAKE(lane, APART);
#undef APART
    return LANE_LESS(LANE_ZERO, is);
}

/* k of the bonds [Pa], ell of a cell [-]. */
LAW lane soft_modulus(soft_faces f, GATHER(coeff) modulus, coeff k_one)
{
#if BRC_MANY_MATERIALS
    return lane_min(gather_component(modulus, f.e), gather_component(modulus, f.j));
#else
    (void)f, (void)modulus;
    return lane_number(k_one);
#endif
}

/* k [beta M s - (1 + tau) H s] / 2 of one cell, whose gradient this is. */
LAW lane_vec3 soft_own_part(lane_mat3 gradient, lane_vec3 s, coeff half_k, lane ell, coeff beta, coeff one_plus_tau)
{
    const lane_vec3 along = lane_mat3_mul_vec(gradient, s), compact = dlsm_compaction_along(gradient, along, s, ell, 1);
    return (lane_vec3){half_k * (beta * compact.x - one_plus_tau * along.x),
                       half_k * (beta * compact.y - one_plus_tau * along.y),
                       half_k * (beta * compact.z - one_plus_tau * along.z)};
}

/* What the forces of a face take from the cell at one end of it, which goes into both sums: B s [N], and with several
 * materials the bond part, with one k [beta M s - (1 + tau) H s] / 2 (soft_own_part). */
typedef struct {
    lane_vec3 flux, own;
} soft_pulls;
LAW soft_pulls soft_pulls_of(lane_int row, lane_vec3 s, GATHER(coeff) flux, GATHER(coeff) bond_part, lane_mat3 h,
                             coeff k_one, coeff ell_one, coeff beta, coeff one_plus_tau)
{
    const lane_vec3 pulled = lane_mat3_mul_vec(lane_gather9(flux, row), s);
#if BRC_MANY_MATERIALS
    (void)h, (void)k_one, (void)ell_one, (void)beta, (void)one_plus_tau;
    return (soft_pulls){pulled, lane_mat3_mul_vec(lane_gather9(bond_part, row), s)};
#else
    (void)bond_part;
    return (soft_pulls){pulled, soft_own_part(h, s, REAL(0.5) * k_one, lane_number(ell_one), beta, one_plus_tau)};
#endif
}
/* Force of the bond on its own element [N]: dlsm_bond_force. spring: k (1 + tau) [Pa]. */
LAW lane_vec3 soft_bond_force(soft_pulls own, soft_pulls beside, lane spring, lane ratio, lane_vec3 elastic_jump)
{
    lane_vec3 f = lane_vec3_add(own.flux, beside.flux);
#if BRC_MANY_MATERIALS
    f = lane_vec3_more(f, spring, lane_vec3_add(own.own, beside.own));
#endif
    return lane_vec3_more(f, spring / ratio, elastic_jump);
}
/* How unevenly the two sides of a face pull [N]: what the opening of either side alone does work against; the same seen
 * from both. With one material the flux holds the bond's own part too, which depends on what both sides open. */
LAW lane_vec3 soft_uneven(soft_pulls own, soft_pulls beside)
{
    const lane_vec3 d = lane_vec3_sub(own.flux, beside.flux);
#if BRC_MANY_MATERIALS
    return d;
#else
    return lane_vec3_add(lane_vec3_sub(d, own.own), beside.own);
#endif
}
LAW lane_vec3 soft_jump(soft_faces f, GATHER(state) displacement)
{
    return state_vec3_difference(state_gather3(displacement, f.j), state_gather3(displacement, f.e));
}

/* Half of the stress of a cell in the present frame, sym(P F_H^T) / 2 [Pa]. */
LAW lane_sym3 soft_half_stress(lane_mat3 h, lane_mat3 p)
{
    const lane xx = p.xx + p.xx * h.xx + p.xy * h.xy + p.xz * h.xz, yy = p.yy + p.yx * h.yx + p.yy * h.yy + p.yz * h.yz,
               zz = p.zz + p.zx * h.zx + p.zy * h.zy + p.zz * h.zz;
    const lane xy = p.xy + p.xx * h.yx + p.xy * h.yy + p.xz * h.yz, yx = p.yx + p.yx * h.xx + p.yy * h.xy + p.yz * h.xz;
    const lane xz = p.xz + p.xx * h.zx + p.xy * h.zy + p.xz * h.zz, zx = p.zx + p.zx * h.xx + p.zy * h.xy + p.zz * h.xz;
    const lane yz = p.yz + p.yx * h.zx + p.yy * h.zy + p.yz * h.zz, zy = p.zy + p.zx * h.yx + p.zy * h.yy + p.zz * h.yz;
    return (lane_sym3){REAL(0.5) * xx,         REAL(0.5) * yy,         REAL(0.5) * zz,
                       REAL(0.25) * (yz + zy), REAL(0.25) * (xz + zx), REAL(0.25) * (xy + yx)};
}

/* What a face takes from one of its cells: its pulls; H s and H axis; half of its stress in the present frame,
 * sym(P F_H^T) / 2 [Pa]. */
typedef struct {
    soft_pulls pulls;
    lane_vec3 along_area, along_axis;
    lane_sym3 stress;
} soft_cell;
LAW soft_cell soft_cell_of(lane_int row, lane_vec3 s, lane_vec3 axis, GATHER(coeff) flux, GATHER(coeff) bond_part,
                           GATHER(coeff) gradient, GATHER(coeff) stress, coeff k_one, coeff ell_one, coeff beta,
                           coeff one_plus_tau)
{
    const lane_mat3 h = lane_gather9(gradient, row), p = lane_gather9(stress, row);
    return (soft_cell){soft_pulls_of(row, s, flux, bond_part, h, k_one, ell_one, beta, one_plus_tau),
                       lane_mat3_mul_vec(h, s), lane_mat3_mul_vec(h, axis), soft_half_stress(h, p)};
}
/* Mean of the two cells' stress in the present frame [Pa]; an area vector [m^2] and the axis of the crack there, from
 * what they were in the undeformed body: a + (H_i + H_j) a / 2. */
LAW lane_sym3 soft_mean_stress(soft_cell own, soft_cell beside) { return lane_sym3_add(own.stress, beside.stress); }
LAW lane_vec3 soft_turned(lane_vec3 a, lane_vec3 along, lane_vec3 along_beside)
{
    return lane_vec3_more(a, lane_number(REAL(0.5)), lane_vec3_add(along, along_beside));
}
/* v of sides that lie where their own cells put them [m]: (H_j - H_i) R / 2, R = s q the branch across the face. */
LAW lane_vec3 soft_sides_apart(soft_faces f, soft_cell own, soft_cell beside)
{
    return lane_vec3_scale(REAL(0.5) * f.ratio, lane_vec3_sub(beside.along_area, own.along_area));
}

/* How far v is from there once the face has opened by `moved` more, as an opening turns its cells [m]: given: (A_i^-1 s
 * - A_j^-1 s).s; share: of v that the two gradients take up. */
LAW lane_vec3 soft_sides_lack(soft_faces f, soft_cell own, soft_cell beside, lane given, lane share, lane_vec3 moved,
                              lane_vec3 v)
{
    const lane_vec3 apart = lane_vec3_more(soft_sides_apart(f, own, beside), REAL(0.5) * f.ratio * given, moved);
    return lane_vec3_scale(REAL(1) / soft_above(REAL(1) - share, REAL(0.05)), lane_vec3_sub(apart, v));
}
/* How a cell at the end of a face draws back when the face opens [N/m]; pull: A^-1 s [1/m]. */
LAW lane_vec3 soft_pull_of(lane_int row, lane_vec3 s, GATHER(coeff) inv_shape)
{
    const lane_int at = row + 5 * (row & ~(C - 1));
    const lane_sym3 inverse = {gather_component(inv_shape, at),         gather_component(inv_shape + C, at),
                               gather_component(inv_shape + 2 * C, at), gather_component(inv_shape + 3 * C, at),
                               gather_component(inv_shape + 4 * C, at), gather_component(inv_shape + 5 * C, at)};
    return lane_sym3_mul_vec(inverse, s);
}
LAW lane_sym3 soft_draws_back(lane_int row, lane_vec3 pull, coeff stiffen, GATHER(coeff) inv_volume,
                              GATHER(coeff) plane, GATHER(coeff) shear, GATHER(coeff) reach)
{
    return soft_cell_stiffness(pull, gather_component(reach, row), stiffen / gather_component(inv_volume, row),
                               gather_component(plane, row), gather_component(shear, row));
}

/* Into the record or row of one entry. */
LAW void soft_put(SCATTER(coeff) crack, int entry, int what, soft_vector a)
{
    GLOBAL coeff *p = crack + (brc_size)entry * SOFT_WIDTH + what;
    p[0] = a.x, p[1] = a.y, p[2] = a.z;
}
LAW void soft_put_row(SCATTER(coeff) row, int entry, soft_vector a)
{
    GLOBAL coeff *p = row + ((brc_size)entry + 2 * (brc_size)(entry & ~(C - 1)));
    p[0] = a.x, p[C] = a.y, p[2 * C] = a.z;
}
/* Into both entries of a face: seen from the other side; the same. */
LAW void soft_put_rows(SCATTER(coeff) row, int entry, int other, coeff turned, soft_vector a)
{
    soft_put_row(row, entry, a), soft_put_row(row, other, soft_scale(turned, a));
}
LAW void soft_put_number(SCATTER(coeff) crack, int entry, int what, coeff a)
{
    crack[(brc_size)entry * SOFT_WIDTH + (brc_size)what] = a;
}
LAW void soft_put_numbers(SCATTER(coeff) crack, int entry, int other, int what, coeff a)
{
    soft_put_number(crack, entry, what, a), soft_put_number(crack, other, what, a);
}
/* Of one lane. */
#define SOFT_LANE(a, l) ((soft_vector){LANE_ITEM((a).x, l), LANE_ITEM((a).y, l), LANE_ITEM((a).z, l)})

LAW soft_vector soft_unit(soft_vector a) { return soft_scale(REAL(1) / SQRT(soft_dot(a, a)), a); }
/* a + (H_i + H_j) a / 2, a direction of the undeformed body as it is now; with the strides 1 and 3 of the transpose one
 * of the present body as it was, of small strains. H_rc is in place r row + c column. */
LAW soft_vector soft_turned_by(GATHER(coeff) gradient, int i, int j, soft_vector a, int row, int column)
{
    GLOBAL const coeff *p = gradient + (brc_size)i * 9, *q = gradient + (brc_size)j * 9;
#define ALONG(r)                                                                                                       \
    ((p[r * row] + q[r * row]) * a.x + (p[r * row + column] + q[r * row + column]) * a.y +                             \
     (p[r * row + 2 * column] + q[r * row + 2 * column]) * a.z)
    const soft_vector sum = {ALONG(0), ALONG(1), ALONG(2)};
#undef ALONG
    return soft_add(a, REAL(0.5), sum);
}
#define SOFT_TURNED_ON(gradient, i, j, a) soft_turned_by(gradient, i, j, a, 3, 1)
#define SOFT_TURNED_BACK(gradient, i, j, a) soft_turned_by(gradient, i, j, a, 1, 3)
/* Normal of the interface that the face of an entry lies in, as it is now; of no use elsewhere. */
#define SOFT_IN_INTERFACE(entry) (SOFT_NUMBER(entry, COSINE) < 0)
LAW soft_vector soft_interface_at(GATHER(coeff) crack, brc_size entry, GATHER(coeff) gradient, int i, int j)
{
    return soft_unit(SOFT_TURNED_ON(gradient, i, j, soft_part(crack, entry, SOFT_SHIFT)));
}
