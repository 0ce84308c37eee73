/* Cracks along interfaces, whose plane is known (host/solver/effects/fracture/interfaces.h; docs/notebook/theory.md
 * T10). */

/* The least that the cohesion of a face along an interface starts at [N]: a face that stands across the plane carries
 * next to nothing of the stress there, and is no weaker than it has to be. wanted: by soft_follow; c: -cosine. */
LAW coeff soft_least_start(coeff wanted, coeff onset, soft_vector normal, coeff c)
{
    const coeff other = REAL(-0.5) * c * onset * SQRT(soft_dot(normal, normal));
    return wanted > other ? wanted : other;
}

/* A face follows when its cell's others have opened by this part of what it could not bear: until then it holds both
 * sides, of a stair across an askew pull a third of all faces (bench/results/2026-11-30-slid-planes.md). */
#define SOFT_FOLLOWS REAL(0.1)
/* Faces whose interfaces' normals stand within 45 degrees lie in one. */
#define SOFT_SAME_PLANE REAL(0.7071067811865476)

/* Of the open faces of an element that lie in an interface as one with this normal does: the furthest opening [m], and
 * what they began to carry over their area in its plane [Pa]. */
typedef struct {
    coeff opening, traction;
} soft_neighbours;
LAW soft_neighbours soft_open_beside(int e, soft_vector normal, OWN(int) row_start, OWN(int) twin, OWN(int) lead,
                                     OWN(coeff) area, OWN(coeff) limit, OWN(coeff) opening, GATHER(coeff) crack)
{
    coeff most = 0, start = 0, plane = 0;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = SOFT_ENTRY;
        if (!SOFT_IN_INTERFACE(entry) || limit[entry] < CELLS_NEVER) continue;
        const soft_vector its = soft_part(crack, entry, lead[entry] ? SOFT_AXIS : SOFT_SHIFT),
                          w = soft_row(opening, entry), s = soft_row(area, entry);
        if (!(soft_dot(its, normal) > SOFT_SAME_PLANE)) continue;
        const brc_size from = lead[entry] ? entry : (brc_size)twin[entry];
        most = failure_larger(most, soft_dot(w, w));
        start += SOFT_NUMBER(from, START);
        plane += SQRT(soft_dot(s, s)) * SOFT_ABS(SOFT_NUMBER(from, COSINE));
    }
    return (soft_neighbours){SQRT(most), start / (plane + REAL(1e-30))};
}

/* After soft_check, in scenes with interfaces: a face that the slide of its neighbours pushes, as one does that stands
 * across the way, is never pulled open: it would hold both sides for ever. It opens too where its cell's other faces
 * have opened by SOFT_FOLLOWS of what it could not bear. START until the onset: the least that its cohesion starts at
 * [N], as much over its area in the plane as theirs did. */
KERNEL void soft_follow(int n, coeff share, OWN(int) row_start, OWN(int) neighbour, OWN(int) twin, OWN(int) lead,
                        OWN(int) n_open, OWN(coeff) area, OWN(coeff) ratio, coeff k_one, GATHER(coeff) modulus,
                        GATHER(coeff) gradient, OWN(coeff) limit, OWN(coeff) opening, SCATTER(coeff) crack,
                        UPDATE(int) mark, PUT(coeff) measure, UPDATE(state) found)
{
    FOR_EACH_ITEM(e, n) {
        int count = 0;
        for (int slot = row_start[e / C]; n_open[e] && slot < row_start[e / C + 1]; ++slot) {
            const brc_size entry = SOFT_ENTRY;
            if (!SOFT_IN_INTERFACE(entry) || !(limit[entry] < CELLS_NEVER) || mark[entry]) continue;
            const soft_vector s = soft_row(area, entry),
                              normal = soft_interface_at(crack, entry, gradient, e, neighbour[entry]);
            const coeff size = SQRT(soft_dot(s, s)), strength = share * limit[entry];
#if BRC_MANY_MATERIALS
            const coeff k = modulus[e] < modulus[neighbour[entry]] ? modulus[e] : modulus[neighbour[entry]];
#else
            const coeff k = k_one;
            (void)modulus;
#endif
            const soft_neighbours beside =
                soft_open_beside(e, normal, row_start, twin, lead, area, limit, opening, crack);
            if (!(k * beside.opening > SOFT_FOLLOWS * strength * ratio[entry] * size)) continue;
            mark[entry] = SOFT_WISH;
            measure[entry] = strength;
            SOFT_NUMBER(entry, TURNS) = 0;
            SOFT_NUMBER(entry, START) =
                (beside.traction < strength ? beside.traction : strength) * size * SOFT_ABS(SOFT_NUMBER(entry, COSINE));
            soft_put(crack, (int)entry, SOFT_AXIS, normal);
            count += 1;
        }
        found[e] += (state)count;
    }
}
