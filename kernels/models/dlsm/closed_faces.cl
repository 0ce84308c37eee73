/* Closed cracks of dlsm whose bonds break at once (closed_face.h; docs/notebook/fracture.md): the faces whose two sides
 * still lie near each other, in the entries of the bonds that broke.
 *
 * Entries [n_slots][C]: closed: CLOSED_OPEN from the break on, CLOSED_PRESSED while its sides are, CLOSED_CLEAR once
 * they stand clear of each other, for good, and CLOSED_KIND times 1 + how many of its two cells have no bonds; 0: never
 * broke here. spring: kappa [N/m], of the bond that was, across its interface times the square of the cosine to it;
 * overlap: the gap, below 0, that a face had when it broke or one of its cells came off, from which on it counts:
 * nothing is pressed by a break [m]; slide [n_slots][3][C]: where
 * along its face it sticks, in the undeformed body [m], only with friction. The lower row of a face decides for both.
 * Elements [n]: next: the step at which the faces of which it is the lower row are looked at again, the next one while
 * some are there: how long a face that stands open stays so is not to be told from its speed, for what pushes its cells
 * may come in the next step; presses: 1
 * where some face is pressed, as of the last evaluation; load [n][12]: what these add to B, and their force on it [Pa]
 * [N]; held: what they hold, half of each face [J]; rubbed: lost to friction [J]; probe, near: the last step whose
 * breaks concern the element's faces, or its force. joined: some faces lie in interfaces, along: brittle_interfaces.cl.
 */

#define CLOSED_OPEN 1
#define CLOSED_PRESSED 2
#define CLOSED_CLEAR 3
#define CLOSED_KIND 4
#define CLOSED_LOAD 12
#define CLOSED_NEVER 2147483647
#define CLOSED_ENTRY ((brc_size)slot * C + (brc_size)(e % C))
#define CLOSED_IS(entry) (closed[entry] % CLOSED_KIND)
#define CLOSED_HOLDS(entry) (CLOSED_IS(entry) == CLOSED_OPEN || CLOSED_IS(entry) == CLOSED_PRESSED)
/* A broken bond points home, and so does its twin: that is the other cell. */
#define CLOSED_OTHER(entry) neighbour[twin[entry]]

LAW vec3 closed_difference(GATHER(state) p, int i, int j)
{
    GLOBAL const state *a = p + (brc_size)i * 3, *b = p + (brc_size)j * 3;
    return (vec3){(coeff)(b[0] - a[0]), (coeff)(b[1] - a[1]), (coeff)(b[2] - a[2])};
}
LAW vec3 closed_row(OWN(coeff) p, brc_size entry)
{
    GLOBAL const coeff *q = p + (entry / C) * 3 * C + entry % C;
    return (vec3){q[0], q[C], q[2 * C]};
}
LAW void closed_put_row(SCATTER(coeff) p, brc_size entry, vec3 a)
{
    GLOBAL coeff *q = p + (entry / C) * 3 * C + entry % C;
    q[0] = a.x, q[C] = a.y, q[2 * C] = a.z;
}
/* Cells that lost all bonds have no A^-1. */
LAW int closed_is_free(GATHER(coeff) inv_shape, int e)
{
    GLOBAL const coeff *p = inv_shape + (brc_size)(e / C) * 6 * C + e % C;
    return !(p[0] > 0);
}
/* From the middle of the branch to the face's centroid [m]: without the weight of dlsm_flux.h. */
LAW vec3 closed_offset(OWN(coeff) offset, GATHER(coeff) modulus, int e, int j, brc_size entry)
{
    const vec3 d = closed_row(offset, entry);
#if BRC_MANY_MATERIALS
    return vec3_scale((modulus[e] + modulus[j]) / (2 * modulus[j]), d);
#else
    (void)modulus, (void)e, (void)j;
    return d;
#endif
}
LAW closed_face closed_find(GATHER(state) place, OWN(coeff) offset, GATHER(coeff) modulus, GATHER(coeff) inv_shape,
                            GATHER(state) displacement, GATHER(coeff) gradient, OWN(coeff) overlap, int joined,
                            OWN(coeff) along, int e, int j, brc_size entry)
{
    closed_face f = closed_face_of(closed_difference(place, e, j), closed_offset(offset, modulus, e, j, entry),
                                   closed_difference(displacement, e, j), mat3_load(gradient, e),
                                   mat3_load(gradient, j), closed_is_free(inv_shape, e), closed_is_free(inv_shape, j));
    if (joined && !(closed_is_free(inv_shape, e) && closed_is_free(inv_shape, j)))
        f = closed_face_in(f, closed_row(along, entry));
    f.along -= overlap[entry];
    return f;
}

/* Before bonds of touched elements break: marked ones that never broke are faces that may close. */
KERNEL void closed_keep(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) twin, OWN(int) touched,
                        GATHER(int) mark, OWN(coeff) alive, OWN(coeff) area, OWN(coeff) ratio, coeff k_one,
                        coeff one_plus_tau, GATHER(coeff) modulus, int joined, OWN(coeff) along, PUT(int) closed,
                        PUT(coeff) spring)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int some = int_load(touched, (brc_size)group * W);
        for (int e = group * W; LANE_ANY(some) && e < group * W + W; ++e) {
            for (int slot = row_start[e / C]; touched[e] && slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = CLOSED_ENTRY;
                if (!(alive[entry] > 0) || !(mark[entry] || mark[twin[entry]])) continue;
#if BRC_MANY_MATERIALS
                const int j = neighbour[entry];
                const coeff k = modulus[e] < modulus[j] ? modulus[e] : modulus[j];
#else
                const coeff k = k_one;
#endif
                closed[entry] = CLOSED_OPEN;
                const vec3 n = joined ? closed_row(along, entry) : (vec3){0, 0, 0}, s = closed_row(area, entry);
                const coeff c = vec3_dot(n, n) > 0 ? vec3_dot(n, s) * vec3_dot(n, s) / vec3_dot(s, s) : REAL(1);
                spring[entry] = c * k * one_plus_tau / ratio[entry];
            }
        }
    }
}

/* After bonds broke: whose faces they concern. */
KERNEL void closed_probe(int n_groups, int moment, OWN(int) row_start, GATHER(int) neighbour, OWN(int) twin,
                         OWN(int) touched, OWN(int) closed, SCATTER(int) probe)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int some = int_load(touched, (brc_size)group * W);
        for (int e = group * W; LANE_ANY(some) && e < group * W + W; ++e) {
            for (int slot = row_start[e / C]; touched[e] && slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = CLOSED_ENTRY;
                if (!CLOSED_HOLDS(entry)) continue;
                STORE_SAME(probe + CLOSED_OTHER(entry), moment);
            }
            if (touched[e]) STORE_SAME(probe + e, moment);
        }
    }
}

/* Faces that are due, once H is there: which are pressed; and at the end of a step (moves) which slide or stand clear.
 * all: whether due or not. clear: of the length of the bond [-]; what a pressed face holds when it is let go is lost to
 * friction. friction [-]. */
KERNEL void closed_follow(int n_groups, int moment, int all, int moves, coeff clear, coeff friction, OWN(int) row_start,
                          GATHER(int) neighbour, OWN(int) twin, GATHER(state) place, OWN(coeff) offset,
                          GATHER(coeff) modulus, GATHER(coeff) inv_shape, GATHER(state) displacement,
                          GATHER(coeff) gradient, int joined, OWN(coeff) along, OWN(coeff) spring, OWN(coeff) overlap,
                          SCATTER(int) closed, SCATTER(coeff) slide, UPDATE(int) next, SCATTER(int) presses,
                          UPDATE(state) rubbed)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int until = moves ? moment : moment + 1; /* of a state that a step has left, the same faces */
        const lane_int waits = LANE_ABOVE(int_load(next, (brc_size)group * W), until), due = ~waits;
        for (int e = group * W; (all || LANE_ANY(due)) && e < group * W + W; ++e) {
            if (!all && next[e] > until) continue;
            int soonest = CLOSED_NEVER;
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = CLOSED_ENTRY;
                const int j = CLOSED_OTHER(entry);
                if (!(e < j) || !CLOSED_HOLDS(entry)) continue; /* the lower row writes what the upper would read */
                const closed_face f = closed_find(place, offset, modulus, inv_shape, displacement, gradient, overlap,
                                                  joined, along, e, j, entry);
                const int pressed = f.along < 0, was = CLOSED_IS(entry) == CLOSED_PRESSED;
                const brc_size other = (brc_size)twin[entry];
                if (moves) {
                    const coeff most = clear * f.length;
                    if (f.along > most || vec3_dot(f.across, f.across) > most * most) {
                        const vec3 held =
                            was && friction > 0 ? vec3_sub(f.across, closed_row(slide, entry)) : (vec3){0, 0, 0};
                        const closed_load left = closed_load_of(f, held, spring[entry]);
                        if (pressed) rubbed[e] += (state)left.energy;
                        closed[entry] = CLOSED_CLEAR;
                        closed[other] = CLOSED_CLEAR;
                        continue;
                    }
                    soonest = moment + 1;
                }
                if (pressed && friction > 0 && (moves || !was)) {
                    vec3 at = f.across;
                    if (was) {
                        const vec3 held = vec3_sub(f.across, closed_row(slide, entry));
                        const coeff size = SQRT(vec3_dot(held, held)), bears = -friction * f.along;
                        const vec3 kept = size > bears ? vec3_scale(bears / size, held) : held;
                        at = vec3_sub(f.across, kept);
                        if (size > bears) rubbed[e] += (state)(spring[entry] * bears * (size - bears));
                    }
                    closed_put_row(slide, entry, at);
                    closed_put_row(slide, other, vec3_scale(REAL(-1), at));
                }
                closed[entry] += (pressed ? CLOSED_PRESSED : CLOSED_OPEN) - CLOSED_IS(entry);
                closed[other] = closed[entry];
                if (pressed) {
                    STORE_SAME(presses + e, 1);
                    STORE_SAME(presses + j, 1);
                }
            }
            if (moves) next[e] = soonest;
        }
    }
}

/* The part of a slide that friction holds under this overlap: no more than its share. */
LAW vec3 closed_kept(vec3 held, coeff along, coeff friction)
{
    const coeff size = SQRT(vec3_dot(held, held)), bears = along < 0 ? -friction * along : 0;
    return size > bears ? vec3_scale(bears / size, held) : held;
}

/* What the pressed faces of one element add to it; returns whether any is pressed. broke: bonds did, so faces may be
 * new, or of a cell that has come off. */
LAW int closed_sum(int e, OWN(int) row_start, GATHER(int) neighbour, OWN(int) twin, GATHER(state) place,
                   OWN(coeff) offset, GATHER(coeff) modulus, GATHER(coeff) inv_shape, GATHER(state) displacement,
                   GATHER(coeff) gradient, int joined, OWN(coeff) along, OWN(coeff) spring, UPDATE(coeff) overlap,
                   UPDATE(int) closed, UPDATE(coeff) slide, coeff friction, int broke, GATHER(int) touched, coeff *sum,
                   state *energy)
{
    mat3 q = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    vec3 push = {0, 0, 0};
    state all = 0;
    int any = 0;
    for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
        const brc_size entry = CLOSED_ENTRY;
        if (!CLOSED_HOLDS(entry)) continue;
        const int j = CLOSED_OTHER(entry);
        closed_face f =
            closed_find(place, offset, modulus, inv_shape, displacement, gradient, overlap, joined, along, e, j, entry);
        if (broke && (touched[e] || touched[j])) { /* H of one of them is another: both sides ask anew */
            const int kind = 1 + closed_is_free(inv_shape, e) + closed_is_free(inv_shape, j);
            if (closed[entry] / CLOSED_KIND != kind) {
                const coeff whole = f.along + overlap[entry];
                overlap[entry] = whole < 0 ? whole : 0;
                f.along = whole - overlap[entry];
                closed[entry] = CLOSED_OPEN;
            }
            if (friction > 0 && f.along < 0) { /* what a break slides is part of its energy */
                const vec3 held =
                    CLOSED_IS(entry) == CLOSED_OPEN ? (vec3){0, 0, 0} : vec3_sub(f.across, closed_row(slide, entry));
                closed_put_row(slide, entry, vec3_sub(f.across, closed_kept(held, f.along, friction)));
            }
            closed[entry] = (f.along < 0 ? CLOSED_PRESSED : CLOSED_OPEN) + CLOSED_KIND * kind;
        }
        if (CLOSED_IS(entry) != CLOSED_PRESSED) continue;
        const vec3 held = friction > 0 ? vec3_sub(f.across, closed_row(slide, entry)) : (vec3){0, 0, 0};
        const closed_load one = closed_load_of(f, held, spring[entry]);
        q = mat3_mix(REAL(1), q, REAL(1), one.moment);
        push = vec3_add(push, one.push);
        all += STATE(0.5) * (state)one.energy;
        any = 1;
    }
    GLOBAL const coeff *p = inv_shape + (brc_size)(e / C) * 6 * C + e % C;
    const coeff xx = p[0], yy = p[C], zz = p[2 * C], yz = p[3 * C], xz = p[4 * C], xy = p[5 * C];
    sum[0] = q.xx * xx + q.xy * xy + q.xz * xz, sum[1] = q.xx * xy + q.xy * yy + q.xz * yz,
    sum[2] = q.xx * xz + q.xy * yz + q.xz * zz;
    sum[3] = q.yx * xx + q.yy * xy + q.yz * xz, sum[4] = q.yx * xy + q.yy * yy + q.yz * yz,
    sum[5] = q.yx * xz + q.yy * yz + q.yz * zz;
    sum[6] = q.zx * xx + q.zy * xy + q.zz * xz, sum[7] = q.zx * xy + q.zy * yy + q.zz * yz,
    sum[8] = q.zx * xz + q.zy * yz + q.zz * zz;
    sum[9] = push.x, sum[10] = push.y, sum[11] = push.z;
    *energy = all;
    return any;
}

/* Loads of the elements that closed_follow found pressed. */
KERNEL void closed_press(int n_groups, coeff friction, OWN(int) row_start, GATHER(int) neighbour, OWN(int) twin,
                         GATHER(state) place, OWN(coeff) offset, GATHER(coeff) modulus, GATHER(coeff) inv_shape,
                         GATHER(state) displacement, GATHER(coeff) gradient, int joined, OWN(coeff) along,
                         OWN(coeff) spring, UPDATE(coeff) overlap, UPDATE(int) closed, UPDATE(coeff) slide,
                         GATHER(int) presses, PUT(coeff) load, PUT(state) held)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int some = int_load(presses, (brc_size)group * W);
        for (int e = group * W; LANE_ANY(some) && e < group * W + W; ++e) {
            if (!presses[e]) continue;
            coeff sum[CLOSED_LOAD];
            state energy;
            closed_sum(e, row_start, neighbour, twin, place, offset, modulus, inv_shape, displacement, gradient, joined,
                       along, spring, overlap, closed, slide, friction, 0, presses, sum, &energy);
            for (int c = 0; c < CLOSED_LOAD; ++c) load[(brc_size)e * CLOSED_LOAD + (brc_size)c] = sum[c];
            held[e] = energy;
        }
    }
}

/* Elements that a work-item goes over: one of a list, or a group of which some are pressed. */
LAW int closed_begin(int item, int listed, OWN(int) list) { return listed ? list[item] : item * W; }
LAW int closed_end(int item, int listed, OWN(int) list, OWN(int) presses)
{
    if (listed) return list[item] + 1;
    const lane_int some = int_load(presses, (brc_size)item * W);
    return LANE_ANY(some) ? item * W + W : item * W;
}

/* Of all groups, or of the n elements of a list: loads go into B. fluxes above 0: and into what B gained, whose records
 * begin there (rims.cl). */
KERNEL void closed_flux(int n, int listed, OWN(int) list, int fluxes, OWN(int) level, OWN(int) presses, OWN(coeff) load,
                        UPDATE(coeff) flux, SCATTER(coeff) delta)
{
    FOR_EACH_ITEM(item, n) {
        for (int e = closed_begin(item, listed, list); e < closed_end(item, listed, list, presses); ++e) {
            for (int c = 0; presses[e] && c < 9; ++c) {
                const coeff more = load[(brc_size)e * CLOSED_LOAD + (brc_size)c];
                flux[(brc_size)e * 9 + (brc_size)c] += more;
                if (fluxes > 0) delta[((brc_size)fluxes + (brc_size)RING_PLACE(level[e])) * 9 + (brc_size)c] += more;
            }
        }
    }
}

/* And the forces of their faces. */
KERNEL void closed_force(int n, int listed, OWN(int) list, OWN(int) presses, OWN(coeff) load, UPDATE(state) force)
{
    FOR_EACH_ITEM(item, n) {
        for (int e = closed_begin(item, listed, list); e < closed_end(item, listed, list, presses); ++e)
            for (int c = 0; presses[e] && c < 3; ++c)
                force[(brc_size)e * 3 + (brc_size)c] += (state)load[(brc_size)e * CLOSED_LOAD + 9 + (brc_size)c];
    }
}

/* What pressed faces hold [J], in out [n]. */
KERNEL void closed_energy(int n, OWN(int) presses, OWN(state) held, PUT(state) out)
{
    FOR_EACH_ITEM(e, n) { out[e] = presses[e] ? held[e] : STATE(0); }
}

/* ---- after bonds broke: the forces of the rings around them are there, with the loads of before ---- */

/* Loads of the elements that the breaks concern, with their new H; delta [n][12]: what these gained. All their faces
 * are looked at in the next step. */
KERNEL void closed_again(int n_groups, int moment, coeff friction, GATHER(int) touched, OWN(int) row_start,
                         GATHER(int) neighbour, OWN(int) twin, GATHER(state) place, OWN(coeff) offset,
                         GATHER(coeff) modulus, GATHER(coeff) inv_shape, GATHER(state) displacement,
                         GATHER(coeff) gradient, int joined, OWN(coeff) along, OWN(coeff) spring, UPDATE(coeff) overlap,
                         UPDATE(int) closed, UPDATE(coeff) slide, OWN(int) probe, SCATTER(int) near, PUT(int) next,
                         UPDATE(int) presses, UPDATE(coeff) load, PUT(state) held, PUT(coeff) delta)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int fresh =
            ~LANE_ABOVE(moment, int_load(probe, (brc_size)group * W)); /* none is above the present moment */
        for (int e = group * W; LANE_ANY(fresh) && e < group * W + W; ++e) {
            if (probe[e] != moment) continue;
            coeff sum[CLOSED_LOAD];
            state energy;
            const int before = presses[e];
            const int now =
                closed_sum(e, row_start, neighbour, twin, place, offset, modulus, inv_shape, displacement, gradient,
                           joined, along, spring, overlap, closed, slide, friction, 1, touched, sum, &energy);
            for (int c = 0; c < CLOSED_LOAD; ++c) {
                const brc_size at = (brc_size)e * CLOSED_LOAD + (brc_size)c;
                delta[at] = sum[c] - (before ? load[at] : 0);
                load[at] = sum[c];
            }
            held[e] = energy;
            presses[e] = now;
            next[e] = 0;
            if (!before && !now) continue;
            STORE_SAME(near + e, moment);
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot)
                STORE_SAME(near + neighbour[CLOSED_ENTRY], moment);
        }
    }
}

/* Forces gain what the loads of their elements and of those around them gained, and velocities half_kick over mass
 * times what forces lose (ring_take). */
KERNEL void closed_delta(int n_groups, int moment, state half_kick, OWN(int) row_start, OWN(int) neighbour,
                         OWN(coeff) area, GATHER(int) probe, OWN(int) near, GATHER(coeff) delta, OWN(state) mass,
                         UPDATE(state) force, UPDATE(state) velocity)
{
    FOR_EACH_ITEM(group, n_groups) {
        const lane_int fresh = ~LANE_ABOVE(moment, int_load(near, (brc_size)group * W));
        for (int e = group * W; LANE_ANY(fresh) && e < group * W + W; ++e) {
            if (near[e] != moment) continue;
            const int own = probe[e] == moment;
            GLOBAL const coeff *a = delta + (brc_size)e * CLOSED_LOAD;
            coeff f[3] = {own ? a[9] : 0, own ? a[10] : 0, own ? a[11] : 0};
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const brc_size entry = CLOSED_ENTRY;
                const int j = neighbour[entry], other = probe[j] == moment;
                GLOBAL const coeff *b = delta + (brc_size)j * CLOSED_LOAD;
                const vec3 s = closed_row(area, entry);
                for (int c = 0; c < 3; ++c) {
                    if (own) f[c] += a[3 * c] * s.x + a[3 * c + 1] * s.y + a[3 * c + 2] * s.z;
                    if (other) f[c] += b[3 * c] * s.x + b[3 * c + 1] * s.y + b[3 * c + 2] * s.z;
                }
            }
            for (int c = 0; c < 3; ++c) {
                const brc_size at = (brc_size)e * 3 + (brc_size)c;
                velocity[at] -= half_kick * (state)f[c] / mass[e];
                force[at] += (state)f[c];
            }
        }
    }
}
#undef CLOSED_ENTRY
#undef CLOSED_HOLDS
#undef CLOSED_OTHER
