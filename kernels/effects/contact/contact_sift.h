/* Near polyhedra that a plane keeps apart are not listed as a pair.
 *
 * When the list is made all corners of either are on its side of some plane, a skin apart or more. Until it is made
 * again no point of an element moves by half the skin but for the common motion x -> x + a + g (x - middle), g >= 0
 * (contact_motion.cl; turning and straining of a cell included). The common motion moves the two by g (place_j -
 * place_i) relative to each other: that parts them, since each place lies on its own side. So the plane, moved with
 * them, keeps at least its rounding between the two, and they cannot share volume. A cell that has come loose turns
 * freely; it stands for the ball about it, which its turning does not move. */
#ifndef BRC_KERNELS_CONTACT_SIFT_H
#define BRC_KERNELS_CONTACT_SIFT_H

#include "convex_overlap.h"

/* A polyhedron about its own origin, or the ball that holds it. */
typedef struct {
    convex_shape shape;
    convex_map map;
    state radius; /* of the ball [m] */
    int is_ball;
} contact_body;

/* How far it reaches from its origin along the unit vector d [m]. */
ROUTINE state contact_support(contact_body b, convex_vec d)
{
    if (b.is_ball) return b.radius;
    const convex_vec own = convex_turn(convex_transpose(b.map), d);
    state most = convex_dot(own, convex_corner(b.shape, 0));
    for (int k = 1; k < b.shape.n_corners; ++k) {
        const state h = convex_dot(own, convex_corner(b.shape, k));
        most = h > most ? h : most;
    }
    return most;
}

/* Does a face of b keep the other, branch away, at least `skin` off? */
ROUTINE int contact_face_parts(contact_body b, contact_body other, convex_vec branch, state skin)
{
    if (b.is_ball || !(convex_determinant(b.map) > 0)) return 0;
    const convex_map turn = convex_transpose(convex_inverse(b.map));
    for (int f = 0; f < b.shape.n_faces; ++f) {
        const convex_plane own = convex_own_plane(b.shape, f);
        const convex_vec n = convex_turn(turn, own.normal);
        const state k = STATE(1) / convex_length(n), far = k * (convex_dot(n, branch) - own.height);
        if (far > skin && far - contact_support(other, convex_scale(-k, n)) > skin) return 1;
    }
    return 0;
}

/* Is there such a plane: across the branch from a to b, or one of their faces? */
ROUTINE int contact_parted(contact_body a, contact_body b, convex_vec branch, state skin)
{
    const state length = convex_length(branch);
    if (!(length > 0) || (a.is_ball && b.is_ball)) return 0;
    const convex_vec d = convex_scale(STATE(1) / length, branch), back = convex_scale(STATE(-1), d);
    if (length - contact_support(a, d) - contact_support(b, back) > skin) return 1;
    return contact_face_parts(a, b, branch, skin) || contact_face_parts(b, a, convex_scale(STATE(-1), branch), skin);
}

/* How far the other, branch away, must move to be off a face of b, at the least: `least` or less. */
ROUTINE state contact_face_way_out(contact_body b, contact_body other, convex_vec branch, state least)
{
    const convex_map turn = convex_transpose(convex_inverse(b.map));
    for (int f = 0; f < b.shape.n_faces; ++f) {
        const convex_plane own = convex_own_plane(b.shape, f);
        const convex_vec n = convex_turn(turn, own.normal);
        const state k = STATE(1) / convex_length(n),
                    way = contact_support(other, convex_scale(-k, n)) - k * (convex_dot(n, branch) - own.height);
        least = way < least ? way : least;
    }
    return least;
}

/* Depth of two that overlap: the volume they share over its area is that of a face pressed in. It grows without bound
 * where a thin one goes through a cell, or stands inside it, for the areas of its two sides cancel; so where it is not
 * small beside a cell of size h, it is no more than the way out of a face of either. */
ROUTINE state contact_depth(contact_body a, contact_body b, convex_vec branch, state mean, state h)
{
    if (!(mean > STATE(0.1) * h)) return mean;
    return contact_face_way_out(b, a, convex_scale(STATE(-1), branch), contact_face_way_out(a, b, branch, mean));
}

#endif
