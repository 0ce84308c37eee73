/* Where elements are and how they stand: what the kernels of contact read of them. */

LAW svec3 svec3_load(GATHER(state) p, brc_size at) { return (svec3){p[at], p[at + 1], p[at + 2]}; }
LAW void svec3_store(PUT(state) p, brc_size at, svec3 a)
{
    p[at] = a.x;
    p[at + 1] = a.y;
    p[at + 2] = a.z;
}
LAW smat3 smat3_load(GATHER(state) p, brc_size at)
{
    return (smat3){p[at], p[at + 1], p[at + 2], p[at + 3], p[at + 4], p[at + 5], p[at + 6], p[at + 7], p[at + 8]};
}
LAW void smat3_store(PUT(state) p, brc_size at, smat3 a)
{
    p[at] = a.xx, p[at + 1] = a.xy, p[at + 2] = a.xz, p[at + 3] = a.yx, p[at + 4] = a.yy, p[at + 5] = a.yz;
    p[at + 6] = a.zx, p[at + 7] = a.zy, p[at + 8] = a.zz;
}
LAW squat squat_load(GATHER(state) p, int e)
{
    GLOBAL const state *restrict q = p + (brc_size)e * 4;
    return (squat){q[0], q[1], q[2], q[3]};
}
/* x_j - x_i now [m]: places and displacements apart, so that small motions of far places keep their digits. */
LAW svec3 contact_branch(GATHER(state) place, GATHER(state) displacement, int i, int j)
{
    const svec3 far = svec3_sub(svec3_load(place, (brc_size)j * 3), svec3_load(place, (brc_size)i * 3));
    return svec3_add(far,
                     svec3_sub(svec3_load(displacement, (brc_size)j * 3), svec3_load(displacement, (brc_size)i * 3)));
}

LAW svec3 svec3_of(convex_vec a) { return (svec3){a.x, a.y, a.z}; }
LAW convex_vec convex_of(svec3 a) { return (convex_vec){a.x, a.y, a.z}; }
LAW smat3 smat3_of(convex_map a) { return (smat3){a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz}; }
LAW convex_map convex_map_of(smat3 a) { return (convex_map){a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz}; }

/* Map of an element from its reference: I + H, or its rotation. */
LAW smat3 contact_map(int affine, GATHER(coeff) gradient, GATHER(state) orientation, int e)
{
    if (!affine) return squat_matrix(squat_load(orientation, e));
    GLOBAL const coeff *restrict h = gradient + (brc_size)e * 9;
    return (smat3){STATE(1) + (state)h[0], (state)h[1], (state)h[2], (state)h[3],
                   STATE(1) + (state)h[4], (state)h[5], (state)h[6], (state)h[7],
                   STATE(1) + (state)h[8]};
}
