/* The two sides of a broken face of dlsm that lie against each other (docs/notebook/fracture.md, "Closed faces"). Each
 * side moves with its own cell, u_f = u + H (C - X); g = u_f,j - u_f,i is what they have come apart by, and G = F^T g,
 * F = I + (H_i + H_j)/2, the same seen in the undeformed body, which no rotation changes. Along the normal N of the
 * face it is a gap, across it a slide. Where the gap is below 0 the face holds
 *     W = kappa/2 [ (N.G)^2 + |e|^2 ],
 * e the part of the slide that friction has not let go. With P = dW/dG the sides are pulled with F P (element i; -F P
 * element j) at the face's centroid, and W has dW/dF = g (x) P: all of it the gradient of W, so that momentum and its
 * moment hold. A cell without bonds is a mass at its place X, where it meets the other side, whose F it takes; two of
 * them push along the line between them, by what that is shorter than it was. */
#ifndef BRC_KERNELS_CLOSED_FACE_H
#define BRC_KERNELS_CLOSED_FACE_H

#include "../../core/vec.h"

typedef struct {
    vec3 gap;     /* g [m] */
    vec3 across;  /* the slide, in the undeformed body; 0 between two cells without bonds [m] */
    vec3 normal;  /* N; between two cells without bonds the present direction [-] */
    coeff along;  /* the gap N.G [m] */
    coeff length; /* |R| [m] */
    vec3 arm;     /* C - X_i [m] */
    coeff share;  /* of H_i in F; 0, 1/2 or 1 [-] */
    mat3 map;     /* F - I [-] */
} closed_face;

LAW mat3 mat3_mix(coeff a, mat3 m, coeff b, mat3 n)
{
    return (mat3){a * m.xx + b * n.xx, a * m.xy + b * n.xy, a * m.xz + b * n.xz,
                  a * m.yx + b * n.yx, a * m.yy + b * n.yy, a * m.yz + b * n.yz,
                  a * m.zx + b * n.zx, a * m.zy + b * n.zy, a * m.zz + b * n.zz};
}
LAW vec3 mat3_tmul_vec(mat3 a, vec3 b)
{
    return (vec3){a.xx * b.x + a.yx * b.y + a.zx * b.z, a.xy * b.x + a.yy * b.y + a.zy * b.z,
                  a.xz * b.x + a.yz * b.y + a.zz * b.z};
}

/* branch: R = X_j - X_i; offset: d, from the middle of it to C; jump: u_j - u_i; free: a cell has no bonds. */
LAW closed_face closed_face_of(vec3 branch, vec3 offset, vec3 jump, mat3 own, mat3 other, int own_free, int other_free)
{
    closed_face f;
    const coeff square = vec3_dot(branch, branch), length = SQRT(square);
    const coeff share = own_free     ? REAL(0)
                        : other_free ? REAL(1)
                                     : REAL(0.5),
                rest = other_free ? REAL(0) : REAL(1) - share;
    f.length = length;
    f.share = share;
    f.map = mat3_mix(share, own, rest, other);
    if (own_free && other_free) {
        const vec3 now = vec3_add(branch, jump);
        const coeff present = SQRT(vec3_dot(now, now));
        f.gap = jump;
        f.arm = (vec3){0, 0, 0};
        f.across = vec3_sub(jump, vec3_scale(vec3_dot(branch, jump) / square, branch));
        f.normal = vec3_scale(REAL(1) / present, now);
        f.along = (REAL(2) * vec3_dot(branch, jump) + vec3_dot(jump, jump)) / (present + length);
    } else {
        const coeff to_own = own_free     ? REAL(0)
                             : other_free ? REAL(1)
                                          : REAL(0.5),
                    has_face = own_free || other_free ? REAL(0) : REAL(1);
        const vec3 face = vec3_scale(has_face, offset);
        const vec3 arm = vec3_add(vec3_scale(to_own, branch), face),
                   arm_other = vec3_add(vec3_scale(to_own - REAL(1), branch), face);
        f.arm = arm;
        f.gap = vec3_add(jump, vec3_sub(mat3_mul_vec(other, arm_other), mat3_mul_vec(own, arm)));
        f.normal = vec3_scale(REAL(1) / length, branch);
        const vec3 seen = vec3_add(f.gap, mat3_tmul_vec(f.map, f.gap));
        f.along = vec3_dot(f.normal, seen);
        f.across = vec3_sub(seen, vec3_scale(f.along, f.normal));
    }
    return f;
}

/* A face of an interface, of the normal n out of its own element, 0: in none: its sides press and slide as those of
 * the plane do, or else the steps of a rough plane would hold each other. */
LAW closed_face closed_face_in(closed_face f, vec3 n)
{
    const vec3 seen = vec3_add(vec3_scale(f.along, f.normal), f.across);
    if (!(vec3_dot(n, n) > 0)) return f;
    f.normal = n;
    f.along = vec3_dot(n, seen);
    f.across = vec3_sub(seen, vec3_scale(f.along, n));
    return f;
}

/* What a face adds to its own element i. */
typedef struct {
    vec3 push;    /* force [N] */
    mat3 moment;  /* dW/dH_i of its two sides' places and of F: part of Q [N m] */
    coeff energy; /* W of the whole face [J] */
} closed_load;

/* held: e of a face that friction holds, else 0 [m]; stiffness: kappa [N/m]. */
LAW closed_load closed_load_of(closed_face f, vec3 held, coeff stiffness)
{
    closed_load out;
    const mat3 none = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const vec3 p = vec3_scale(stiffness, vec3_add(vec3_scale(f.along, f.normal), held));
    out.energy = REAL(0.5) * stiffness * (f.along * f.along + vec3_dot(held, held));
    out.push = vec3_add(p, mat3_mul_vec(f.map, p));
    out.moment =
        mat3_add_outer(mat3_add_outer(none, vec3_scale(REAL(-1), out.push), f.arm), vec3_scale(f.share, f.gap), p);
    return out;
}

#endif
