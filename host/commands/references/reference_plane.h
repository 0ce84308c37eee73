/* Plane problems in closed form, in plane strain: what the stresses of a pressed disc and of a plate with a hole are
 * held against. In-plane components in the order xx, yy, xy of the plane's own axes. */
#ifndef BRC_COMMANDS_REFERENCE_PLANE_H
#define BRC_COMMANDS_REFERENCE_PLANE_H

#include "../../base/status.h"

/* A disc of radius 1 under a uniform radial pressure on two opposite arcs, each `half_angle` [rad] to either side of
 * the y axis: stress at (x, y) over the nominal stress 2 P / (pi t D), tension positive [-]. Hondros' whole field, by
 * superposition of pairs of point loads (Flamant, with the uniform tension that frees the rim) over the arcs, 64 Gauss
 * points; for points inside 0.9 of the radius good to 1e-10 at half angles up to pi/4. */
void brc_reference_disc(double half_angle, double x, double y, double stress[3]);

/* A ring a <= r <= b, free inside; on the outside every point is displaced by the affine field u = (e_xx x, e_yy y).
 * With b far beyond a this is Kirsch's plate. */
typedef struct brc_reference_ring {
    double inner, outer;     /* a, b [m] */
    double lambda, mu;       /* Lame's constants [Pa] */
    double even, even_inner; /* u_r = even r + even_inner / r [-], [m^2] */
    double c[4];             /* Airy's function (c0 r^2 + c1 r^4 + c2 / r^2 + c3) cos 2 theta, r in units of a [Pa] */
} brc_reference_ring;

/* Solve for the constants. BRC_BAD_INPUT: not 0 < inner < outer. */
brc_status brc_reference_ring_solve(brc_context *context, double inner, double outer, double young, double poisson,
                                    double e_xx, double e_yy, brc_reference_ring *out);
/* Stress [Pa] and displacement [m] at (x, y); displacement may be NULL. */
void brc_reference_ring_at(const brc_reference_ring *ring, double x, double y, double stress[3],
                           double displacement[2]);

#endif
