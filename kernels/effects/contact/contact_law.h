/* Laws of touching (docs/notebook/contact.md). Normal force of spheres: Hertz's exact two-body law, or a spring;
 * damping by a share b of the critical one; Coulomb friction as a spring in the plane of contact that slides. */
#ifndef BRC_KERNELS_CONTACT_LAW_H
#define BRC_KERNELS_CONTACT_LAW_H

#include "../../core/svec.h"

/* How two materials meet. */
typedef struct {
    state hertz;      /* E*: 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j [Pa] */
    state modulus;    /* of overlapping cells, k_n: harmonic mean of the two E [Pa] */
    state stiffness;  /* K_s of a pair [N/m]; 0: from the moduli */
    state tangential; /* tangential over normal stiffness [-] */
    state friction;   /* mu [-] */
    state damping;    /* b [-] */
} contact_law;

typedef struct {
    state force, energy; /* [N], [J] */
    state dashpot;       /* force over closing speed, at b = 1 [N s/m] */
    state sticking;      /* stiffness of the tangential spring [N/m] */
} contact_normal;

/* Overlap at which the tangential spring of Hertz's law has its ratio to the normal stiffness, and up to which the time
 * step bears that law; of the reduced radius [-]. */
#define CONTACT_DEPTH STATE(0.1)

/* Spheres that overlap by depth > 0 [m]; radius 1/R = 1/R_i + 1/R_j, a wall has 1/R = 0; mass: m_i m_j / (m_i + m_j).
 * Hertz: F = 4/3 E* sqrt(R) d^(3/2); in y = d^(5/4) and the time dt d^(1/4) a dashpot 2 b sqrt(5/6) sqrt(m dF/dd) is
 * that of a linear oscillator, so that b alone decides the restitution, at every speed. is_linear, or a given
 * stiffness: F = K d, K = E* R without one. */
LAW contact_normal contact_sphere_force(contact_law law, int is_linear, state depth, state radius, state mass)
{
    if (is_linear || law.stiffness > 0) {
        const state k = law.stiffness > 0 ? law.stiffness : law.hertz * radius;
        return (contact_normal){k * depth, STATE(0.5) * k * depth * depth, STATE(2) * SQRT_STATE(k * mass),
                                law.tangential * k};
    }
    const state root = SQRT_STATE(radius * depth), slope = STATE(2) * law.hertz * root;
    return (contact_normal){STATE(2.0 / 3) * slope * depth, STATE(4.0 / 15) * slope * depth * depth,
                            STATE(1.8257418583505538) * SQRT_STATE(slope * mass),
                            law.tangential * STATE(2) * law.hertz * radius * SQRT_STATE(CONTACT_DEPTH)};
}

/* Force of the dashpot [N] at closing speed rate [m/s]; surfaces push only, so that it never outdoes the force
 * itself. */
LAW state contact_dashpot(state force, state dashpot, state damping, state rate)
{
    const state viscous = damping * dashpot * rate;
    return viscous < -force ? -force : viscous;
}

/* The tangential spring after its two ends moved apart by `slip` [m]: stretch [m], kept across the normal n with its
 * length as the pair turns; it slides where its force exceeds limit [N]. */
typedef struct {
    svec3 stretch;
    state lost; /* [J] by trapezoids, as the kinetic energy changes */
    int sliding;
} contact_stick;
LAW contact_stick contact_friction(svec3 stretch, svec3 slip, svec3 n, state stiffness, state limit)
{
    const svec3 flat = svec3_across(stretch, n);
    const state was = svec3_dot(stretch, stretch), is = svec3_dot(flat, flat);
    const svec3 old = svec3_scale(is > 0 ? SQRT_STATE(was / is) : STATE(0), flat);
    const svec3 trial = svec3_add(old, svec3_across(slip, n));
    const state pull = stiffness * svec3_length(trial);
    if (!(pull > limit)) return (contact_stick){trial, STATE(0), 0};
    const svec3 held = svec3_scale(limit / pull, trial);
    return (contact_stick){held, STATE(0.5) * stiffness * svec3_dot(svec3_add(old, held), svec3_sub(trial, held)), 1};
}

#endif
