/* Forces of touching pairs: each pair once, one work-item; results are gathered by element in the order of its entries
 * (contact_search.cl). history [n_pairs][CONTACT_HISTORY]: 0 stretch of the tangential spring; 3, 6 the point of
 * contact of the last step in either body's own frame [m]; 9 overlap (spheres: depth [m], below 0 apart; cells: volume
 * [m^3]) and 10 its rate; 11 force of the dashpot; 12 touching, 13 sliding, 14 looked at before, 2: and at rest apart
 * (contact_rests); 15 cells apart: 1 + the face of i that last stood between them, or minus that of j; 16 what rounding
 * makes of the slip of those points where nothing moves [m], or of a pair at rest apart a direction and, 19, how far
 * along it the two reach. touch [n_pairs]: 1 for pairs that touch; and of these only result [n_pairs][CONTACT_RESULT +
 * 2 width]: 0 force on i [N]; 3 energy held, 4 lost to friction, 5 to the dashpot in this step [J]; 6 normal force [N];
 * 7 depth [m]; then width numbers for i and for j: torque (width 3), or dW/dH in the frame of the reference (width 9).
 * law [n_materials][n_materials][6]: contact_law. */

#define CONTACT_RESULT 8

LAW contact_law contact_law_of(GATHER(state) law, int n_materials, int i, int j)
{
    GLOBAL const state *restrict p = law + ((brc_size)i * (brc_size)n_materials + (brc_size)j) * 6;
    return (contact_law){p[0], p[1], p[2], p[3], p[4], p[5]};
}
/* What a pair that does not touch leaves behind: nothing but its overlap, from which the next step takes the rate. */
LAW void contact_apart(UPDATE(state) history, state overlap, int face)
{
    if (!(history[14] > 0) || history[12] > 0)
        for (int c = 0; c < CONTACT_HISTORY; ++c) history[c] = 0;
    history[9] = overlap;
    history[14] = 1;
    history[15] = (state)face;
}

/* By how much the points own_i, own_j that met lie apart [m]. Less the same of the step before, which is nothing but
 * rounding: a pair at rest slips by nothing at all, however long. */
LAW svec3 contact_slip(smat3 map_i, svec3 own_i, smat3 map_j, svec3 own_j, svec3 branch)
{
    return svec3_sub(svec3_sub(smat3_mul_vec(map_i, own_i), smat3_mul_vec(map_j, own_j)), branch);
}

/* How a sphere meets another, or a piece of a striker: unit normal out of i, depth, and the arms from both places to
 * the point of contact. */
typedef struct {
    svec3 branch, normal, arm_i, arm_j;
    state depth, radius; /* reduced, for Hertz's law */
} contact_meeting;

LAW contact_meeting contact_of_spheres(svec3 branch, state ri, state rj, state reference)
{
    const state distance = svec3_length(branch), share = ri / (ri + rj);
    const svec3 normal = distance > 0 ? svec3_scale(STATE(1) / distance, branch) : (svec3){1, 0, 0};
    return (contact_meeting){branch,
                             normal,
                             svec3_scale(share, branch),
                             svec3_scale(share - STATE(1), branch),
                             (reference < ri + rj ? reference : ri + rj) - distance,
                             ri * rj / (ri + rj)};
}
/* foot: on the piece, in a frame about the sphere's place; branch: to the striker's mass centre. */
LAW contact_meeting contact_of_foot(convex_foot foot, svec3 branch, state ri, state rj)
{
    const svec3 normal = {-foot.normal.x, -foot.normal.y, -foot.normal.z},
                arm = {foot.point.x, foot.point.y, foot.point.z};
    return (contact_meeting){
        branch, normal, arm, svec3_sub(arm, branch), ri - foot.distance, rj > 0 ? ri * rj / (ri + rj) : ri};
}

/* What touching spheres do to each other, or a sphere and a striker. heavy: their mass [kg]. */
LAW void contact_press_spheres(contact_meeting meet, smat3 turn_i, smat3 turn_j, contact_law how, int is_linear,
                               state heavy, state dt, UPDATE(state) past, PUT(state) out)
{
    const state depth = meet.depth;
    const int looked = past[14] > 0;
    const contact_normal normal = contact_sphere_force(how, is_linear, depth, meet.radius, heavy);
    const state rate = dt > 0 ? (looked ? (depth - past[9]) / dt : STATE(0)) : past[10];
    const state viscous = contact_dashpot(normal.force, normal.dashpot, how.damping, rate);
    svec3 slip = {0, 0, 0}, stretch = {0, 0, 0};
    if (past[12] > 0) {
        slip = svec3_sub(contact_slip(turn_i, svec3_load(past, 3), turn_j, svec3_load(past, 6), meet.branch),
                         svec3_load(past, 16));
        stretch = svec3_load(past, 0);
    }
    const contact_stick stick =
        contact_friction(stretch, slip, meet.normal, normal.sticking, how.friction * (normal.force + viscous));
    const svec3 force =
        svec3_add_scaled(svec3_scale(-normal.sticking, stick.stretch), -(normal.force + viscous), meet.normal);
    svec3_store(out, 0, force);
    out[3] = normal.energy + STATE(0.5) * normal.sticking * svec3_dot(stick.stretch, stick.stretch);
    out[4] = dt > 0 ? stick.lost : STATE(0);
    out[5] = dt > 0 && looked ? STATE(0.5) * (past[11] + viscous) * (depth - past[9]) : STATE(0);
    out[6] = normal.force + viscous;
    out[7] = depth;
    svec3_store(out, CONTACT_RESULT, svec3_cross(meet.arm_i, force));
    svec3_store(out, CONTACT_RESULT + 3, svec3_scale(STATE(-1), svec3_cross(meet.arm_j, force)));
    if (dt > 0) {
        svec3_store(past, 0, stick.stretch);
        const svec3 own_i = smat3_tmul_vec(turn_i, meet.arm_i), own_j = smat3_tmul_vec(turn_j, meet.arm_j);
        svec3_store(past, 3, own_i);
        svec3_store(past, 6, own_j);
        svec3_store(past, 16, contact_slip(turn_i, own_i, turn_j, own_j, meet.branch));
        past[9] = depth;
        past[10] = rate;
        past[11] = viscous;
        past[12] = 1;
        past[13] = (state)stick.sliding;
        past[14] = 1;
    }
}

/* Spheres. dt: the step that ended, whose friction and damping are booked; 0: the same state again, nothing is
 * remembered. Others than elements: number n + piece of a striker, as in contact_cells.cl; piece_radius: of pieces that
 * are spheres [m]. */
KERNEL void contact_spheres(int n_items, int whole, state dt, int n, int is_linear, int n_materials, state middle_x,
                            state middle_y, state middle_z, OWN(int) todo, OWN(int) ends, GATHER(state) place,
                            GATHER(state) displacement, GATHER(state) orientation, GATHER(state) bounding_radius,
                            GATHER(state) corner, GATHER(state) plane, GATHER(int) loop_start, GATHER(int) loop,
                            GATHER(state) radius, GATHER(int) corner_start, GATHER(int) face_start, GATHER(int) id,
                            GATHER(state) mass, GATHER(int) material, GATHER(int) body, GATHER(int) piece_striker,
                            GATHER(int) piece_kind, GATHER(state) piece_radius, GATHER(state) striker_pose,
                            GATHER(state) law, UPDATE(state) history, PUT(int) touch, PUT(state) result)
{
    FOR_EACH_ITEM(item, n_items) {
        const int p = whole ? item : todo[item];
        const int i = ends[2 * (brc_size)p], j = ends[2 * (brc_size)p + 1];
        GLOBAL state *restrict past = history + (brc_size)p * CONTACT_HISTORY;
        GLOBAL state *restrict out = result + (brc_size)p * (CONTACT_RESULT + 6);
        const state ri = bounding_radius[i];
        const smat3 turn_i = squat_matrix(squat_load(orientation, i));
        smat3 turn_j;
        contact_meeting meet;
        if (j < n) {
            /* spheres of one body that overlap in the reference do not push there */
            const svec3 far = svec3_sub(svec3_load(place, (brc_size)j * 3), svec3_load(place, (brc_size)i * 3));
            const state rj = bounding_radius[j], reference = body[i] == body[j] ? svec3_length(far) : ri + rj;
            turn_j = squat_matrix(squat_load(orientation, j));
            meet = contact_of_spheres(contact_branch(place, displacement, i, j), ri, rj, reference);
        } else {
            const brc_size at = (brc_size)piece_striker[j - n] * 12;
            const int kind = piece_kind[j - n];
            const svec3 own = svec3_add(svec3_load(place, (brc_size)i * 3), (svec3){middle_x, middle_y, middle_z});
            const svec3 branch =
                svec3_sub(svec3_sub(svec3_load(striker_pose, at), own), svec3_load(displacement, (brc_size)i * 3));
            const convex_vec here = {0, 0, 0}, origin = {branch.x, branch.y, branch.z};
            const convex_shape shape =
                convex_shape_of(corner, plane, loop_start, loop, radius, corner_start, face_start, id[j]);
            convex_foot foot;
            turn_j = smat3_load(striker_pose, at + 3);
            const convex_map map = {turn_j.xx, turn_j.xy, turn_j.xz, turn_j.yx, turn_j.yy,
                                    turn_j.yz, turn_j.zx, turn_j.zy, turn_j.zz};
            if (kind == 1)
                foot = convex_foot_on_sphere(here, origin, piece_radius[j - n]);
            else if (kind == 2) {
                const convex_plane face = convex_own_plane(shape, 0);
                const convex_vec normal = convex_turn(map, face.normal);
                const convex_plane wall = {normal, face.height + convex_dot(normal, origin)};
                foot = convex_foot_on_plane(here, wall);
            } else {
                const convex_pose pose = {origin, map};
                foot = convex_foot_on_polyhedron(shape, pose, here, ri);
            }
            meet = contact_of_foot(foot, branch, ri, piece_radius[j - n]);
        }
        const int touching = meet.depth > 0;
        if (!touching && dt > 0) contact_apart(past, meet.depth, 0);
        touch[p] = touching;
        if (touching) {
            const contact_law how = contact_law_of(law, n_materials, material[i], material[j]);
            const state heavy = mass[j] > 0 ? mass[i] * mass[j] / (mass[i] + mass[j]) : mass[i];
            contact_press_spheres(meet, turn_i, turn_j, how, is_linear, heavy, dt, past, out);
        }
    }
}

/* Elements that turn: force += sign times those of contact, torque likewise; kick: velocities lose kick f / m, spins
 * likewise (a pair that is new in the middle of a step must not act on the step that ended). book 1: what was lost in
 * the step is added up. stored [n] [J]. */
KERNEL void contact_gather_turning(int n_with_pairs, state sign, state kick, int book, OWN(int) with_pairs,
                                   OWN(int) list, OWN(int) start, OWN(int) used, OWN(int) pair, GATHER(int) touch,
                                   GATHER(state) result, OWN(state) mass, OWN(state) inertia, UPDATE(state) force,
                                   UPDATE(state) torque, UPDATE(state) velocity, UPDATE(state) spin, PUT(state) stored,
                                   UPDATE(state) lost_friction, UPDATE(state) lost_impact)
{
    FOR_EACH_ITEM(item, n_with_pairs) {
        const int k = with_pairs[item], e = list[k];
        svec3 push = {0, 0, 0}, turn = {0, 0, 0};
        state held = 0, rubbed = 0, damped = 0;
        for (int at = start[k]; at < start[k] + used[k]; ++at) {
            const int owner = pair[at] >= 0, p = owner ? pair[at] : -1 - pair[at];
            GLOBAL const state *restrict one = result + (brc_size)p * (CONTACT_RESULT + 6);
            if (!touch[p]) continue;
            push = svec3_add_scaled(push, owner ? STATE(1) : STATE(-1), svec3_load(one, 0));
            turn = svec3_add(turn, svec3_load(one, owner ? CONTACT_RESULT : CONTACT_RESULT + 3));
            if (owner) {
                held += one[3];
                rubbed += one[4];
                damped += one[5];
            }
        }
        const brc_size at = (brc_size)e * 3;
        svec3_store(force, at, svec3_add_scaled(svec3_load(force, at), sign, push));
        svec3_store(torque, at, svec3_add_scaled(svec3_load(torque, at), sign, turn));
        if (kick != 0) {
            svec3_store(velocity, at, svec3_add_scaled(svec3_load(velocity, at), -sign * kick / mass[e], push));
            svec3_store(spin, at, svec3_add_scaled(svec3_load(spin, at), -sign * kick / inertia[e], turn));
        }
        stored[e] = held;
        if (book) {
            lost_friction[e] += rubbed;
            lost_impact[e] += damped;
        }
    }
}
