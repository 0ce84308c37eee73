/* Loads on single elements, of all models: prescribed motion and rotation, forces. One work-item does one element of a
 * load; arrays are [n][3]. */

/* Imposed elements of one load: u = base + factor direction, v = rate direction on the chosen components. */
LAW void impose_motion_of(int i, state factor, state rate, int set_displacement, OWN(int) element, OWN(coeff) component,
                          OWN(state) base, OWN(state) direction, PUT(state) velocity, PUT(state) displacement)
{
    for (int c = 0; c < 3; ++c) {
        const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
        if (component[at] > REAL(0.5)) {
            if (set_displacement) displacement[to] = base[at] + factor * direction[at];
            velocity[to] = rate * direction[at];
        }
    }
}
/* Of two loads, in one launch: the first n_first items are of the first, the rest (none, where it is by itself) of the
 * other. No component of an element is of both. */
KERNEL void impose_motion(int n, int n_first, int set_displacement, state factor, state rate, OWN(int) element,
                          OWN(coeff) component, OWN(state) base, OWN(state) direction, state other_factor,
                          state other_rate, OWN(int) other_element, OWN(coeff) other_component, OWN(state) other_base,
                          OWN(state) other_direction, PUT(state) velocity, PUT(state) displacement)
{
    FOR_EACH_ITEM(i, n) {
        if (i < n_first)
            impose_motion_of(i, factor, rate, set_displacement, element, component, base, direction, velocity,
                             displacement);
        else
            impose_motion_of(i - n_first, other_factor, other_rate, set_displacement, other_element, other_component,
                             other_base, other_direction, velocity, displacement);
    }
}

/* Reaction of prescribed elements, minus the internal force [N] [n][3]. book: 0 no more; 1 adds the work of the load
 * since the last booking: reaction over the path by the trapezoidal rule plus the change of the prescribed components'
 * own kinetic energy [J]; 2 starts booking here. last, last_reaction [n][3]: u and reaction at the last booking. */
LAW void impose_book_of(int i, state rate, state last_rate, int book, OWN(int) element, OWN(coeff) component,
                        OWN(state) direction, OWN(state) mass, OWN(state) displacement, OWN(state) force,
                        PUT(state) reaction, UPDATE(state) last, UPDATE(state) last_reaction, UPDATE(state) work)
{
    for (int c = 0; c < 3; ++c) {
        const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
        if (component[at] > REAL(0.5)) {
            const state now = -force[to];
            if (book == 1) {
                const state speed = rate * direction[at], old = last_rate * direction[at];
                work[i] += STATE(0.5) * (last_reaction[at] + now) * (displacement[to] - last[at]) +
                           STATE(0.5) * mass[element[i]] * (speed * speed - old * old);
            }
            reaction[at] = now;
            if (book) {
                last[at] = displacement[to];
                last_reaction[at] = now;
            }
        }
    }
}
/* Of two loads, as impose_motion. */
KERNEL void impose_book(int n, int n_first, int book, OWN(state) mass, OWN(state) displacement, OWN(state) force,
                        state rate, state last_rate, OWN(int) element, OWN(coeff) component, OWN(state) direction,
                        PUT(state) reaction, UPDATE(state) last, UPDATE(state) last_reaction, UPDATE(state) work,
                        state other_rate, state other_last_rate, OWN(int) other_element, OWN(coeff) other_component,
                        OWN(state) other_direction, PUT(state) other_reaction, UPDATE(state) other_last,
                        UPDATE(state) other_last_reaction, UPDATE(state) other_work)
{
    FOR_EACH_ITEM(i, n) {
        if (i < n_first)
            impose_book_of(i, rate, last_rate, book, element, component, direction, mass, displacement, force, reaction,
                           last, last_reaction, work);
        else
            impose_book_of(i - n_first, other_rate, other_last_rate, book, other_element, other_component,
                           other_direction, mass, displacement, force, other_reaction, other_last, other_last_reaction,
                           other_work);
    }
}

/* Zero the chosen components of a vector: prescribed elements in linear solves. Of two loads, as impose_motion. */
KERNEL void impose_zero(int n, int n_first, OWN(int) element, OWN(coeff) component, OWN(int) other_element,
                        OWN(coeff) other_component, PUT(state) vector)
{
    FOR_EACH_ITEM(i, n) {
        const int k = i < n_first ? i : i - n_first, e = i < n_first ? element[k] : other_element[k];
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)k * 3 + c;
            if ((i < n_first ? component[at] : other_component[at]) > REAL(0.5)) vector[(brc_size)e * 3 + c] = 0;
        }
    }
}

/* Dead forces of one load on elements: f += factor total. total [n][3]: force per element at factor 1 [N]; book,
 * last_factor, last_path, work: the work of the load by the trapezoidal rule, as impose_book; last_path [n]: total.u at
 * the last booking. */
KERNEL void push_elements(int n, state factor, state last_factor, int book, OWN(int) element, OWN(state) total,
                          OWN(state) displacement, UPDATE(state) force, UPDATE(state) last_path, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        state sum = 0;
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            force[to] += factor * total[at];
            sum += total[at] * displacement[to];
        }
        if (book == 1) work[i] += STATE(0.5) * (factor + last_factor) * (sum - last_path[i]);
        if (book) last_path[i] = sum;
    }
}

/* Turned elements of one load: turn the orientations by the chosen components of angle direction [rad] (finite: 1 q <-
 * exp(turn/2) q; 0 the small rotations of a linear solve are added) unless the angle is 0, and set their spin to rate
 * direction [rad/s]. */
KERNEL void impose_turn(int n, state angle, int finite, state rate, OWN(int) element, OWN(coeff) component,
                        OWN(state) direction, PUT(state) spin, UPDATE(state) orientation)
{
    FOR_EACH_ITEM(i, n) {
        GLOBAL state *q = orientation + (brc_size)element[i] * 4;
        state half_turn[3];
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c;
            const int chosen = component[at] > REAL(0.5);
            half_turn[c] = chosen ? STATE(0.5) * angle * direction[at] : STATE(0);
            if (chosen) spin[(brc_size)element[i] * 3 + c] = rate * direction[at];
        }
        if (angle != 0 && finite)
            orientation_turn(q, half_turn[0], half_turn[1], half_turn[2]);
        else
            for (int c = 0; c < 3; ++c) q[c + 1] += half_turn[c];
    }
}

/* Moment of the load that turns elements, minus the internal torque [N m] [n][3]; the torque it balances becomes zero.
 * step: what the angle's factor grew by since the last booking; book, rate, last_rate, work: as impose_book. */
KERNEL void turn_book(int n, state step, state rate, state last_rate, int book, OWN(int) element, OWN(coeff) component,
                      OWN(state) direction, OWN(state) inertia, UPDATE(state) torque, PUT(state) reaction,
                      UPDATE(state) last_reaction, UPDATE(state) work)
{
    FOR_EACH_ITEM(i, n) {
        for (int c = 0; c < 3; ++c) {
            const brc_size at = (brc_size)i * 3 + c, to = (brc_size)element[i] * 3 + c;
            if (component[at] > REAL(0.5)) {
                const state now = -torque[to];
                if (book == 1) {
                    const state speed = rate * direction[at], old = last_rate * direction[at];
                    work[i] += STATE(0.5) * (last_reaction[at] + now) * (step * direction[at]) +
                               STATE(0.5) * inertia[element[i]] * (speed * speed - old * old);
                }
                reaction[at] = now;
                if (book) last_reaction[at] = now;
                torque[to] = 0;
            }
        }
    }
}
