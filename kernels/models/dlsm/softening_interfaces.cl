/* Cracks along interfaces, whose plane is known (host/solver/effects/fracture/interfaces.h; docs/notebook/theory.md
 * T10). */

/* The least that the cohesion of a face along an interface starts at [N]: a face that stands across the plane carries
 * next to nothing of the stress there, and is no weaker than it has to be. wanted: by soft_follow; c: -cosine. */
LAW coeff soft_least_start(coeff wanted, coeff onset, soft_vector normal, coeff c)
{
    const coeff other = REAL(-0.5) * c * onset * SQRT(soft_dot(normal, normal));
    return wanted > other ? wanted : other;
}

/* Faces whose interfaces' normals stand within 45 degrees lie in one. */
#define SOFT_SAME_PLANE REAL(0.7071067811865476)

/* The furthest slide of the faces of the element of an entry that lie in an interface as it does, along its plane [m].
 * normal: of that, as it is now. */
LAW coeff soft_slid_beside(int e, soft_vector normal, OWN(int) row_start, OWN(int) lead, OWN(coeff) limit,
                           OWN(coeff) opening, OWN(coeff) crack)
{
    coeff most = 0;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = SOFT_ENTRY;
        if (!SOFT_IN_INTERFACE(entry) || limit[entry] < CELLS_NEVER) continue;
        const soft_vector its = soft_part(crack, entry, lead[entry] ? SOFT_AXIS : SOFT_SHIFT),
                          w = soft_row(opening, entry), slid = soft_add(w, -soft_dot(w, normal), normal);
        const coeff square = soft_dot(slid, slid);
        most = soft_dot(its, normal) > SOFT_SAME_PLANE && square > most ? square : most;
    }
    return SQRT(most);
}

/* After soft_check, in scenes with interfaces: a face that the slide of its neighbours pushes, as one does that stands
 * across the way, is never pulled open: it would hold both sides for ever. It opens too where its cell's other faces
 * have slid by half of what it could not bear. START until the onset: the least that its cohesion starts at [N]. */
KERNEL void soft_follow(int n, coeff share, OWN(int) row_start, OWN(int) neighbour, OWN(int) lead, OWN(int) n_open,
                        OWN(coeff) area, OWN(coeff) ratio, coeff k_one, GATHER(coeff) modulus, GATHER(coeff) gradient,
                        OWN(coeff) limit, OWN(coeff) opening, UPDATE(coeff) crack, UPDATE(int) mark, PUT(coeff) measure,
                        UPDATE(state) found)
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
            const coeff slid = soft_slid_beside(e, normal, row_start, lead, limit, opening, crack);
            if (!(k * slid > SOFT_PASSED * strength * ratio[entry] * size)) continue;
            mark[entry] = SOFT_WISH;
            measure[entry] = strength;
            SOFT_NUMBER(entry, TURNS) = 0;
            SOFT_NUMBER(entry, START) = strength * size * SOFT_ABS(SOFT_NUMBER(entry, COSINE));
            soft_put(crack, (int)entry, SOFT_AXIS, normal);
            count += 1;
        }
        found[e] += (state)count;
    }
}
