/* dlsm: held faces (prescribed displacement) and tractions. One work-item does one element that has such faces, so that
 * nothing is scattered (docs/notebook/theory.md T2, Held faces). Arrays of a held element h:
 * element[h] its row, place[2h] its boundary block, place[2h + 1] its lane in the slice, face_start[h] its faces; of a
 * face: face_area s_f [m^2], arm d_f = C - X_i [m], held 1 or 0 per component, spring kappa_f [N/m], value u_f [m]. */

/* u_f - u_i, the difference taken in state. */
LAW vec3 held_jump(OWN(state) value, int face, OWN(state) displacement, int e)
{
    return (vec3){(coeff)(value[(brc_size)face * 3] - displacement[(brc_size)e * 3]),
                  (coeff)(value[(brc_size)face * 3 + 1] - displacement[(brc_size)e * 3 + 1]),
                  (coeff)(value[(brc_size)face * 3 + 2] - displacement[(brc_size)e * 3 + 2])};
}

/* Components where pi is 1. */
LAW vec3 held_only(vec3 pi, vec3 a) { return (vec3){pi.x * a.x, pi.y * a.y, pi.z * a.z}; }

/* u_f = base + factor direction, for the faces of one load. entry -> face; component flags as in held. */
KERNEL void held_prescribe(int n, state factor, OWN(int) face, OWN(coeff) component, OWN(state) base,
                           OWN(state) direction, PUT(state) value)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c)
            if (component[(brc_size)i * 3 + c] > REAL(0.5))
                value[(brc_size)face[i] * 3 + c] = base[(brc_size)i * 3 + c] + factor * direction[(brc_size)i * 3 + c];
    }
}

/* r_f = Pi (u_f - u_i - H_i d_f) [m]. */
LAW vec3 held_residual(vec3 pi, vec3 jump, mat3 grad, vec3 arm)
{
    return held_only(pi, vec3_sub(jump, mat3_mul_vec(grad, arm)));
}

/* Faces [from, to) of element e: part of V G, sum r_f (x) s_f. */
LAW mat3 held_gradient_of(int e, int from, int to, OWN(coeff) face_area, OWN(coeff) arm, OWN(coeff) held,
                          OWN(state) value, OWN(state) displacement, mat3 grad)
{
    mat3 sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    for (int f = from; f < to; ++f)
        sum = mat3_add_outer(
            sum, held_residual(vec3_load(held, f), held_jump(value, f, displacement, e), grad, vec3_load(arm, f)),
            vec3_load(face_area, f));
    return sum;
}

/* Part of V G, assigned to the element's place. */
KERNEL void held_gradient_pass(int n, OWN(int) element, OWN(int) place, OWN(int) face_start, OWN(coeff) face_area,
                               OWN(coeff) arm, OWN(coeff) held, OWN(state) value, OWN(state) displacement,
                               OWN(coeff) gradient, PUT(coeff) held_gradient)
{
    FOR_EACH_ITEM(h, n) {
        const int e = element[h];
        mat3_put_in_block(held_gradient, place[2 * h], place[2 * h + 1],
                          held_gradient_of(e, face_start[h], face_start[h + 1], face_area, arm, held, value,
                                           displacement, mat3_load(gradient, e)));
    }
}

/* Pull of held face f on its element e, Pi P_i s_f + kappa_f r_f [N]: a force at the face's centroid. */
LAW vec3 held_pull(int e, int f, OWN(coeff) face_area, vec3 arm, OWN(coeff) held, OWN(coeff) spring, OWN(state) value,
                   OWN(state) displacement, mat3 grad, mat3 stress)
{
    const vec3 pi = vec3_load(held, f);
    const vec3 r = held_residual(pi, held_jump(value, f, displacement, e), grad, arm);
    return vec3_add(held_only(pi, mat3_mul_vec(stress, vec3_load(face_area, f))), vec3_scale(spring[f], r));
}
/* Minus the moment of a pull, pull (x) d_f, added. */
LAW mat3 held_add_moment(mat3 sum, vec3 pull, vec3 arm) { return mat3_add_outer(sum, vec3_scale(REAL(-1), pull), arm); }
/* The pull is the force of the load on the solid (dW/du_f) too, kept as reaction [N]. book: 0 no more; 1 adds the work
 * of the load since the last booking by the trapezoidal rule [J]; 2 starts booking here. last [n][3], last_reaction
 * [n][3]: u_f and reaction at the last booking. */
LAW void held_book(int f, vec3 pull, OWN(state) value, int book, PUT(state) reaction, UPDATE(state) last,
                   UPDATE(state) last_reaction, UPDATE(state) work)
{
    const state on_element[3] = {(state)pull.x, (state)pull.y, (state)pull.z};
    for (int c = 0; c < 3; ++c) {
        const brc_size at = (brc_size)f * 3 + c;
        if (book == 1) work[f] += STATE(0.5) * (last_reaction[at] + on_element[c]) * (value[at] - last[at]);
        reaction[at] = on_element[c];
        if (book) {
            last[at] = value[at];
            last_reaction[at] = on_element[c];
        }
    }
}
/* f_i += the pulls on it. */
LAW void held_add_forces(int e, int from, int to, OWN(state) reaction, UPDATE(state) force)
{
    for (int f = from; f < to; ++f)
        for (int c = 0; c < 3; ++c) force[(brc_size)e * 3 + c] += reaction[(brc_size)f * 3 + c];
}

/* Part of Q, added to the element's place. */
KERNEL void held_moment_pass(int n, OWN(int) element, OWN(int) place, OWN(int) face_start, OWN(coeff) face_area,
                             OWN(coeff) arm, OWN(coeff) held, OWN(coeff) spring, OWN(state) value,
                             OWN(state) displacement, OWN(coeff) gradient, OWN(coeff) stress, UPDATE(coeff) held_moment)
{
    FOR_EACH_ITEM(h, n) {
        const int e = element[h];
        const mat3 grad = mat3_load(gradient, e), p = mat3_load(stress, e);
        mat3 sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
        for (int f = face_start[h]; f < face_start[h + 1]; ++f) {
            const vec3 d = vec3_load(arm, f);
            sum = held_add_moment(sum, held_pull(e, f, face_area, d, held, spring, value, displacement, grad, p), d);
        }
        mat3_add_to_block(held_moment, place[2 * h], place[2 * h + 1], sum);
    }
}

/* f_i += pull, and its reaction and work. */
KERNEL void held_force_pass(int n, OWN(int) element, OWN(int) face_start, OWN(coeff) face_area, OWN(coeff) arm,
                            OWN(coeff) held, OWN(coeff) spring, OWN(state) value, OWN(state) displacement,
                            OWN(coeff) gradient, OWN(coeff) stress, int book, UPDATE(state) force,
                            UPDATE(state) reaction, UPDATE(state) last, UPDATE(state) last_reaction, UPDATE(state) work)
{
    FOR_EACH_ITEM(h, n) {
        const int e = element[h];
        const mat3 grad = mat3_load(gradient, e), p = mat3_load(stress, e);
        for (int f = face_start[h]; f < face_start[h + 1]; ++f)
            held_book(f, held_pull(e, f, face_area, vec3_load(arm, f), held, spring, value, displacement, grad, p),
                      value, book, reaction, last, last_reaction, work);
        held_add_forces(e, face_start[h], face_start[h + 1], reaction, force);
    }
}

/* Stabilisation energy of held faces, kappa_f |r_f|^2 / 2 [J] [face]. */
KERNEL void held_energy(int n, OWN(int) element, OWN(int) face_start, OWN(coeff) arm, OWN(coeff) held,
                        OWN(coeff) spring, OWN(state) value, OWN(state) displacement, OWN(coeff) gradient,
                        PUT(state) energy)
{
    FOR_EACH_ITEM(h, n) {
        const int e = element[h];
        const mat3 grad = mat3_load(gradient, e);
        for (int f = face_start[h]; f < face_start[h + 1]; ++f) {
            const vec3 r =
                held_residual(vec3_load(held, f), held_jump(value, f, displacement, e), grad, vec3_load(arm, f));
            energy[f] = (state)(REAL(0.5) * spring[f] * vec3_dot(r, r));
        }
    }
}

/* Tractions of one load, summed per element: total [N] = sum t S, moment [N m] = sum t S (x) (C - X), at unit
 * factor. */
KERNEL void traction_moment_pass(int n, coeff factor, OWN(int) place, OWN(coeff) moment, UPDATE(coeff) held_moment)
{
    FOR_EACH_ITEM(i, n) {
        const mat3 m = mat3_load(moment, i);
        const mat3 minus = {-factor * m.xx, -factor * m.xy, -factor * m.xz, -factor * m.yx, -factor * m.yy,
                            -factor * m.yz, -factor * m.zx, -factor * m.zy, -factor * m.zz};
        mat3_add_to_block(held_moment, place[2 * i], place[2 * i + 1], minus);
    }
}

/* f_i += factor total; total.u + moment:H is what the traction works on [J]. book, last_path: as book and last above.
 */
KERNEL void traction_force_pass(int n, state factor, OWN(int) element, OWN(coeff) total, OWN(coeff) moment,
                                OWN(state) displacement, OWN(coeff) gradient, int book, state last_factor,
                                UPDATE(state) force, UPDATE(state) last_path, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        const int e = element[i];
        state sum = 0;
        for (int c = 0; c < 3; ++c) {
            const state t = (state)total[(brc_size)i * 3 + c];
            force[(brc_size)e * 3 + c] += factor * t;
            sum += t * displacement[(brc_size)e * 3 + c];
        }
        for (int c = 0; c < 9; ++c) sum += (state)(moment[(brc_size)i * 9 + c] * gradient[(brc_size)e * 9 + c]);
        if (book == 1) work[i] += STATE(0.5) * (factor + last_factor) * (sum - last_path[i]);
        if (book) last_path[i] = sum;
    }
}

/* Sensors: u_f of listed free faces [m]: u_i + H_i (C - X_i). */
KERNEL void face_displacement(int n, OWN(int) element, OWN(coeff) arm, OWN(state) displacement, OWN(coeff) gradient,
                              PUT(state) out)
{
    FOR_EACH_ITEM(i, n) {
        const vec3 reach = mat3_mul_vec(mat3_load(gradient, element[i]), vec3_load(arm, i));
        out[(brc_size)i * 3] = displacement[(brc_size)element[i] * 3] + (state)reach.x;
        out[(brc_size)i * 3 + 1] = displacement[(brc_size)element[i] * 3 + 1] + (state)reach.y;
        out[(brc_size)i * 3 + 2] = displacement[(brc_size)element[i] * 3 + 2] + (state)reach.z;
    }
}
