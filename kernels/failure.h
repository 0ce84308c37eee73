/* When a stress is too much: principal values and directions of a symmetric tensor, and limits on it. Tension is positive.
 *
 * Every limit is a ratio of degree one in the stress, so 1 / ratio is the factor on the load at which it is reached:
 *     tension      sigma_I / tension                                      NAH19 eq. 7
 *     compression  -sigma_III / compression                               NAH19 section 4.5
 *     shear        ((sigma_I - sigma_III) + sin phi (sigma_I + sigma_III)) / (2 c cos phi)     Mohr-Coulomb
 *                  (sqrt J2 + a I1) / k                                   Drucker-Prager
 * The largest one counts. A limit of 0 is none. */
#ifndef BRC_KERNELS_FAILURE_H
#define BRC_KERNELS_FAILURE_H

#include "portable.h"

#define FAILURE_TENSION 1
#define FAILURE_COMPRESSION 2
#define FAILURE_SHEAR 3

typedef struct { coeff xx, yy, zz, yz, xz, xy; } failure_stress; /* [Pa] */

/* value[0] >= value[1] >= value[2] [Pa]; axis[k]: unit vector that belongs to value[k], its sign open. */
typedef struct {
    coeff value[3], axis[3][3];
} failure_principal;

/* Limits of one element; tension, compression [Pa]; shear: 2 c cos phi, or k [Pa]. */
typedef struct { coeff tension, compression, shear; } failure_limits;

/* How shear counts, one for a scene. slope: sin phi, or a; friction: sin phi, for the plane it slides on. */
typedef struct {
    int drucker_prager;
    coeff slope, friction;
} failure_shear;

typedef struct {
    coeff ratio;        /* >= 1: failed [-] */
    coeff stress;       /* the principal value that counts; shear: half the difference of the outer two [Pa] */
    coeff normal[2][3]; /* normals of the planes it fails on, both equal unless it shears */
    int mode;           /* FAILURE_..., 0: no limit */
} failure_state;

LAW coeff failure_absolute(coeff x) { return x < 0 ? -x : x; }

/* Cyclic Jacobi rotations: only sums, products, quotients and roots, so all devices agree; exact for multiple values too. Values to
 * rounding of the largest, whatever their size. */
LAW failure_principal failure_principal_of(failure_stress s)
{
    coeff a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
    failure_principal out = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    coeff size = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) size = failure_absolute(a[i][j]) > size ? failure_absolute(a[i][j]) : size;
    if (!(size > 0)) return out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a[i][j] /= size;
    for (int sweep = 0; sweep < 12; ++sweep) {
        const coeff off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
        if (!(off > REAL(1e-34))) break;
        for (int k = 0; k < 3; ++k) {
            const int p = k == 2 ? 1 : 0, q = k == 0 ? 1 : 2, r = 3 - p - q;
            if (!(failure_absolute(a[p][q]) > REAL(1e-18))) continue;
            const coeff theta = (a[q][q] - a[p][p]) / (REAL(2) * a[p][q]);
            const coeff t = (theta < 0 ? REAL(-1) : REAL(1)) / (failure_absolute(theta) + SQRT(theta * theta + REAL(1)));
            const coeff c = REAL(1) / SQRT(t * t + REAL(1)), n = t * c, was = a[p][q];
            a[p][p] -= t * was;
            a[q][q] += t * was;
            a[p][q] = a[q][p] = 0;
            const coeff rp = c * a[r][p] - n * a[r][q], rq = n * a[r][p] + c * a[r][q];
            a[r][p] = a[p][r] = rp;
            a[r][q] = a[q][r] = rq;
            for (int i = 0; i < 3; ++i) {
                const coeff vp = c * out.axis[p][i] - n * out.axis[q][i];
                out.axis[q][i] = n * out.axis[p][i] + c * out.axis[q][i];
                out.axis[p][i] = vp;
            }
        }
    }
    for (int i = 0; i < 3; ++i) out.value[i] = size * a[i][i];
    for (int pass = 0; pass < 3; ++pass) { /* order by size */
        const int i = pass == 1 ? 1 : 0, j = i + 1;
        if (out.value[i] >= out.value[j]) continue;
        const coeff value = out.value[i];
        out.value[i] = out.value[j];
        out.value[j] = value;
        for (int c = 0; c < 3; ++c) {
            const coeff axis = out.axis[i][c];
            out.axis[i][c] = out.axis[j][c];
            out.axis[j][c] = axis;
        }
    }
    return out;
}

/* limit - sign sigma is positive definite: every principal value of sign sigma is below the limit. */
LAW int failure_all_below(failure_stress s, coeff sign, coeff limit)
{
    const coeff a = limit - sign * s.xx, b = limit - sign * s.yy, c = limit - sign * s.zz;
    const coeff minor = a * b - s.xy * s.xy;
    const coeff det = c * minor - sign * s.yz * (sign * a * s.yz + s.xy * s.xz) - sign * s.xz * (s.xy * s.yz + sign * s.xz * b);
    return a > 0 && minor > 0 && det > 0;
}

/* 0: no limit is within reach, without the principal values. Leaves a little room for its own rounding. */
LAW int failure_possible(failure_stress s, failure_limits limits, failure_shear shear)
{
    const coeff near = REAL(0.999);
    if (limits.tension > 0 && !failure_all_below(s, REAL(1), near * limits.tension)) return 1;
    if (limits.compression > 0 && !failure_all_below(s, REAL(-1), near * limits.compression)) return 1;
    if (limits.shear > 0) {
        const coeff square = s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + REAL(2) * (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy);
        /* |sigma_I -+ sigma_III| <= sqrt 2 |sigma|; sqrt J2 <= |sigma| / sqrt 2, I1 <= sqrt 3 |sigma| */
        const coeff reach = shear.drucker_prager ? REAL(0.7072) + REAL(1.7321) * shear.slope : REAL(1.4143) * (REAL(1) + shear.slope);
        if (reach * reach * square >= near * near * limits.shear * limits.shear) return 1;
    }
    return 0;
}

LAW failure_state failure_set(failure_state now, coeff ratio, coeff stress, failure_principal p, int k, int mode)
{
    if (!(ratio > now.ratio)) return now;
    now.ratio = ratio;
    now.stress = stress;
    now.mode = mode;
    for (int c = 0; c < 3; ++c) now.normal[0][c] = now.normal[1][c] = p.axis[k][c];
    return now;
}

LAW failure_state failure_of(failure_principal p, failure_limits limits, failure_shear shear)
{
    failure_state out = {0, 0, {{0, 0, 0}, {0, 0, 0}}, 0};
    const coeff first = p.value[0], third = p.value[2];
    if (limits.tension > 0) out = failure_set(out, first / limits.tension, first, p, 0, FAILURE_TENSION);
    if (limits.compression > 0) out = failure_set(out, -third / limits.compression, third, p, 2, FAILURE_COMPRESSION);
    if (limits.shear > 0) {
        coeff measure = (first - third) + shear.slope * (first + third);
        if (shear.drucker_prager) {
            const coeff a = first - p.value[1], b = p.value[1] - third, c = first - third;
            measure = SQRT((a * a + b * b + c * c) / REAL(6)) + shear.slope * (first + p.value[1] + third);
        }
        const coeff before = out.ratio;
        out = failure_set(out, measure / limits.shear, REAL(0.5) * (first - third), p, 0, FAILURE_SHEAR);
        if (out.ratio > before) { /* planes at 45 deg + phi / 2 between the outer axes */
            const coeff along = SQRT(REAL(0.5) * (REAL(1) + shear.friction)), across = SQRT(REAL(0.5) * (REAL(1) - shear.friction));
            for (int c = 0; c < 3; ++c) {
                out.normal[0][c] = along * p.axis[0][c] + across * p.axis[2][c];
                out.normal[1][c] = along * p.axis[0][c] - across * p.axis[2][c];
            }
        }
    }
    return out;
}

/* |cos| of the angle between a direction (need not be a unit vector; 1/length given) and the nearer plane's normal. */
LAW coeff failure_alignment(failure_state f, coeff x, coeff y, coeff z, coeff inv_length)
{
    const coeff a = failure_absolute(f.normal[0][0] * x + f.normal[0][1] * y + f.normal[0][2] * z);
    const coeff b = failure_absolute(f.normal[1][0] * x + f.normal[1][1] * y + f.normal[1][2] * z);
    return (a > b ? a : b) * inv_length;
}

#endif
