/* Strikers: made from the scene, moved, and asked. How they move is in rigid.h and strikers.cl; what pushes
 * them is contact. */
#include "strikers_internal.h"
#include "../loads/loads.h"
#include <math.h>
#include <string.h>

enum { TURNS = 8, PUSHED = 16 }; /* bits of `freedom` behind those of x y z, strikers.cl */
enum { N_PUSH = 4 };             /* numbers of each in push_now */

static const brc_striker *asked(const brc_simulation *s, int32_t i)
{
    return s->scene->strikers + i;
}
static bool is_driven(const brc_simulation *s, int32_t i)
{
    return asked(s, i)->motion == BRC_STRIKER_DRIVEN;
}
static bool is_free(const brc_simulation *s, int32_t i)
{
    return asked(s, i)->motion == BRC_STRIKER_FREE;
}

static int32_t freedom_of(const brc_striker *striker)
{
    int32_t bits = 0;
    if (striker->motion != BRC_STRIKER_FREE) return 0;
    for (int c = 0; c < 3; ++c)
        bits |= striker->held[c] ? 0 : 1 << c;
    if (striker->pushed) bits |= PUSHED;
    return striker->held_rotation ? bits : bits | TURNS;
}

/* ---- making ---- */

BRC_WANTED(strikers, w->scene->n_strikers > 0)
static bool pushing(const brc_wants *w)
{
    for (int32_t i = 0; i < w->scene->n_strikers; ++i)
        if (w->scene->strikers[i].pushed) return true;
    return false;
}

#define AT(member) BRC_FIELD_AT(brc_strikers, member)
static const brc_field_row rows[] = {
    {"striker_pose", brc_each_striker, 12, BRC_FIELD_STATE, NULL, AT(pose), "poses of strikers", "m, -",
     BRC_KEPT("strikers.pose", BRC_KEEP_ALL)},
    BRC_KEPT_FIELD(motion, brc_each_striker, 6, STATE, NULL, "velocities of strikers", "m/s, rad/s", "strikers.motion"),
    BRC_KEPT_FIELD(load, brc_each_striker, 6, STATE, NULL, "forces on strikers", "N, N m", "strikers.load"),
    BRC_KEPT_FIELD(displacement, brc_each_striker, 3, STATE, NULL, "displacements of strikers", "m",
                   "strikers.displacement"),
    BRC_KEPT_FIELD(orientation, brc_each_striker, 4, STATE, NULL, "orientations of strikers", "-",
                   "strikers.orientation"),
    BRC_KEPT_FIELD(momentum, brc_each_striker, 3, STATE, NULL, "angular momenta of strikers", "kg m^2/s",
                   "strikers.momentum"),
    BRC_FIELD(freedom, brc_each_striker, 1, INT, NULL, "freedoms of strikers", "-"),
    BRC_FIELD(mass, brc_each_striker, 1, STATE, NULL, "masses of strikers", "kg"),
    BRC_FIELD(inertia, brc_each_striker, 6, STATE, NULL, "inertia of strikers", "kg m^2"),
    BRC_FIELD(centre, brc_each_striker, 3, STATE, NULL, "centres of strikers", "m"),
    BRC_KEPT_FIELD(moved, brc_each_striker, 6, STATE, NULL, "moves of strikers", "m, rad", "strikers.moved"),
    BRC_KEPT_FIELD(last, brc_each_striker, 6, STATE, NULL, "last forces on strikers", "N, N m", "strikers.last"),
    BRC_KEPT_FIELD(work, brc_each_striker, 1, STATE, NULL, "work of strikers", "J", "strikers.work"),
    BRC_KEPT_FIELD(lost, brc_each_striker, 1, STATE, NULL, "numerical dissipation of strikers", "J", "strikers.lost"),
    BRC_KEPT_FIELD(push, brc_each_striker, 3, STATE, pushing, "prescribed forces on strikers", "N", "strikers.push"),
    BRC_KEPT_FIELD(pushed, brc_each_striker, 3, STATE, pushing, "last prescribed forces on strikers", "N",
                   "strikers.pushed"),
};
BRC_FIELD_TABLE(brc_striker_fields, "strikers", BRC_LIFE_RUN, strikers, rows);

/* I w of a symmetric tensor. */
static void times(const double i[6], const double w[3], double out[3])
{
    out[0] = i[0] * w[0] + i[5] * w[1] + i[4] * w[2];
    out[1] = i[5] * w[0] + i[1] * w[1] + i[3] * w[2];
    out[2] = i[4] * w[0] + i[3] * w[1] + i[2] * w[2];
}

/* The state as the run starts. */
static brc_status upload_start(brc_simulation *s)
{
    brc_strikers *t = s->strikers;
    const int32_t n = t->n;
    BRC_LOCAL(s->context, 35 * (int64_t)n, double, room, "strikers");
    BRC_LOCAL(s->context, n, int32_t, freedom, "strikers");
    double *upright = room, *motion = upright + 4 * n, *momentum = motion + 6 * n, *mass = momentum + 3 * n,
           *inertia = mass + n, *centre = inertia + 6 * n, *pose = centre + 3 * n;
    for (int32_t i = 0; i < n; ++i) {
        const brc_striker *striker = asked(s, i);
        upright[4 * i] = 1;
        freedom[i] = freedom_of(striker);
        mass[i] = is_free(s, i) ? t->body[i].mass : 1; /* others have none, and are never divided by it */
        for (int c = 0; c < 3; ++c) {
            inertia[6 * i + c] = is_free(s, i) ? t->body[i].inertia[c] : 1;
            inertia[6 * i + 3 + c] = is_free(s, i) ? t->body[i].inertia[3 + c] : 0;
            centre[3 * i + c] = pose[12 * i + c] = t->body[i].centre[c];
            pose[12 * i + 3 + 4 * c] = 1;
        }
        if (!is_free(s, i)) continue;
        for (int c = 0; c < 3; ++c) {
            motion[6 * i + c] = striker->held[c] ? 0 : striker->velocity[c];
            motion[6 * i + 3 + c] = striker->held_rotation ? 0 : striker->spin[c];
        }
        times(t->body[i].inertia, motion + 6 * i + 3, momentum + 3 * i);
    }
    BRC_TRY(brc_fields_create(s->device, &brc_striker_fields, &s->wants, t));
    BRC_TRY(brc_upload_int(t->freedom, freedom, n));
    BRC_TRY(brc_upload_state(s, t->orientation, upright, 4 * (int64_t)n));
    BRC_TRY(brc_upload_state(s, t->pose, pose, 12 * (int64_t)n));
    BRC_TRY(brc_upload_state(s, t->centre, centre, 3 * (int64_t)n));
    BRC_TRY(brc_upload_state(s, t->motion, motion, 6 * (int64_t)n));
    BRC_TRY(brc_upload_state(s, t->momentum, momentum, 3 * (int64_t)n));
    BRC_TRY(brc_upload_state(s, t->mass, mass, 1 * (int64_t)n));
    return brc_upload_state(s, t->inertia, inertia, 6 * (int64_t)n);
}

brc_status brc_strikers_create(brc_simulation *s)
{
    if (s->scene->n_strikers == 0) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &s->strikers, 1, "strikers"));
    brc_strikers *t = s->strikers;
    t->n = s->scene->n_strikers;
    BRC_TRY(BRC_ALLOCATE(s->context, &t->body, t->n, "strikers"));
    BRC_TRY(BRC_ALLOCATE(s->context, &t->placed, t->n, "strikers"));
    BRC_TRY(BRC_ALLOCATE(s->context, &t->warned, t->n, "strikers"));
    BRC_TRY(BRC_ALLOCATE(s->context, &t->push_now, N_PUSH * (int64_t)t->n, "strikers"));
    for (int32_t i = 0; i < t->n; ++i)
        BRC_TRY(brc_striker_body_make(s, i));
    const brc_scope run = brc_scope_of_run(s),
                    bodies = {.owner = "strikers", .base = t, .tables = {&brc_striker_fields}, .outer = &run};
    const brc_pass_wanted wanted[] = {
        BRC_PASS(&t->advance, "striker_advance", "kick drift extra numerical"),
        BRC_PASS(&t->place, "striker_place", "which ux uy uz qw qx qy qz vx vy vz wx wy wz mx my mz tx ty tz"),
        BRC_PASS(&t->push_on, "striker_push", "which fx fy fz"), BRC_PASS(&t->book, "striker_book", "book numerical")};
    BRC_TRY(BRC_PASSES_MAKE(s, &bodies, wanted));
    brc_want_pieces(s, &t->convex);
    BRC_TRY(brc_strikers_check(s));
    return upload_start(s);
}

void brc_strikers_free(brc_simulation *s)
{
    brc_strikers *t = s->strikers;
    if (!t) return;
    brc_fields_free(&brc_striker_fields, t);
    for (int32_t i = 0; t->body && i < t->n; ++i)
        brc_striker_body_free(&t->body[i]);
    brc_convex_free(&t->convex);
    brc_want_pieces(s, NULL);
    brc_memory_free(t->piece_striker);
    brc_memory_free(t->piece_kind);
    brc_memory_free(t->piece_radius);
    brc_memory_free(t->body);
    brc_memory_free(t->placed);
    brc_memory_free(t->warned);
    brc_memory_free(t->push_now);
    brc_memory_free(t);
    s->strikers = NULL;
}

brc_striker_piece brc_striker_piece_of(const brc_simulation *s, int32_t p)
{
    const brc_strikers *t = s->strikers;
    return (brc_striker_piece){t->piece_striker[p], t->piece_kind[p], t->piece_radius[p]};
}

brc_scope brc_scope_of_strikers(const brc_simulation *s, const brc_scope *outer)
{
    static const brc_strikers none = {0};
    static const brc_value_row values[] = {{"striker_pose", BRC_VALUE_BUFFER, AT(pose)},
                                           {"motion", BRC_VALUE_BUFFER, AT(motion)},
                                           {"load", BRC_VALUE_BUFFER, AT(load)}};
    return (brc_scope){
        .owner = "strikers", .base = s->strikers ? s->strikers : &none, BRC_VALUES(values), .outer = outer};
}

brc_status brc_strikers_set_load(brc_simulation *s, const double *load)
{
    const brc_strikers *t = s->strikers;
    return load ? brc_upload_state(s, t->load, load, 6 * (int64_t)t->n) : brc_buffer_fill_zero(t->load);
}

bool brc_strikers_overlap(const brc_simulation *s)
{
    for (int32_t i = 0; s->strikers && i < s->strikers->n; ++i)
        if (s->strikers->warned[i]) return true;
    return false;
}

/* ---- motion ---- */

static const double *gravity(const brc_simulation *s)
{
    static const double none[3] = {0, 0, 0};
    return s->scene->has_gravity ? s->scene->gravity : none;
}

brc_status brc_strikers_advance(brc_simulation *s, double kick, double drift, double extra, bool numerical)
{
    const brc_strikers *t = s->strikers;
    return BRC_RUN(t->advance, t->n, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)},
                   {"extra", BRC_STATE(extra)}, {"numerical", BRC_INT(numerical ? 1 : 0)});
}

/* exp of the rotation vector `turn`. */
static void quaternion(const double turn[3], double q[4])
{
    const double angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]),
                 share = angle > 0 ? sin(0.5 * angle) / angle : 0.5;
    q[0] = cos(0.5 * angle);
    for (int c = 0; c < 3; ++c)
        q[c + 1] = share * turn[c];
}

/* Told to the device where it has changed. Within a step of velocity Verlet from force f to f' its work is (f + f') / 2
 * . (way + dt^2 (f' - f) / 4 m); the second part, dt^2 (f'^2 - f^2) / 8 m, is summed here. */
static brc_status push(brc_simulation *s, int32_t i, double now)
{
    const brc_strikers *t = s->strikers;
    const brc_striker *striker = asked(s, i);
    const double factor = brc_table_value(&striker->table, now), dt = brc_simulation_time_step(s).value;
    const bool verlet = brc_simulation_step(s) > 0 && brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC &&
                        brc_current_stage(s)->integrator != BRC_TCHAMWA_WIELGOSZ;
    double *last = t->push_now + N_PUSH * (int64_t)i, f[3];
    for (int c = 0; c < 3; ++c)
        f[c] = factor * striker->force[c];
    if (memcmp(f, last, sizeof f) == 0) return BRC_OK;
    for (int c = 0; c < 3 && verlet; ++c)
        if (!striker->held[c]) last[3] += dt * dt * (f[c] * f[c] - last[c] * last[c]) / (8 * t->body[i].mass);
    memcpy(last, f, sizeof f);
    return BRC_RUN(t->push_on, 1, {"which", BRC_INT(i)}, {"fx", BRC_STATE(f[0])}, {"fy", BRC_STATE(f[1])},
                   {"fz", BRC_STATE(f[2])});
}

double brc_strikers_pushed(const brc_simulation *s)
{
    const brc_strikers *t = s->strikers;
    double most = 0;
    for (int32_t i = 0; i < t->n; ++i) {
        const double *f = t->push_now + N_PUSH * (int64_t)i;
        if (asked(s, i)->pushed) most = fmax(most, sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / t->body[i].mass);
    }
    return most;
}

brc_status brc_strikers_prescribe(brc_simulation *s)
{
    brc_strikers *t = s->strikers;
    const double now = brc_simulation_total_time(s);
    for (int32_t i = 0; i < t->n; ++i) {
        if (asked(s, i)->pushed) BRC_TRY(push(s, i, now));
        if (!is_driven(s, i)) continue;
        const brc_striker *striker = asked(s, i);
        const double factor = brc_table_value(&striker->table, now), path = brc_table_integral(&striker->table, now),
                     step = path - t->placed[i];
        const double *v = striker->velocity, *w = striker->spin, turn[3] = {path * w[0], path * w[1], path * w[2]};
        double q[4];
        quaternion(turn, q);
        BRC_TRY(BRC_RUN(
            t->place, 1, {"which", BRC_INT(i)}, {"ux", BRC_STATE(path * v[0])}, {"uy", BRC_STATE(path * v[1])},
            {"uz", BRC_STATE(path * v[2])}, {"qw", BRC_STATE(q[0])}, {"qx", BRC_STATE(q[1])}, {"qy", BRC_STATE(q[2])},
            {"qz", BRC_STATE(q[3])}, {"vx", BRC_STATE(factor * v[0])}, {"vy", BRC_STATE(factor * v[1])},
            {"vz", BRC_STATE(factor * v[2])}, {"wx", BRC_STATE(factor * w[0])}, {"wy", BRC_STATE(factor * w[1])},
            {"wz", BRC_STATE(factor * w[2])}, {"mx", BRC_STATE(step * v[0])}, {"my", BRC_STATE(step * v[1])},
            {"mz", BRC_STATE(step * v[2])}, {"tx", BRC_STATE(step * w[0])}, {"ty", BRC_STATE(step * w[1])},
            {"tz", BRC_STATE(step * w[2])}));
        t->placed[i] = path;
    }
    return BRC_OK;
}

brc_status brc_strikers_book(brc_simulation *s, brc_booking book)
{
    const brc_strikers *t = s->strikers;
    const brc_stage *stage = brc_simulation_stage(s) >= 0 ? brc_current_stage(s) : NULL;
    const bool numerical = stage && stage->solver == BRC_SOLVER_DYNAMIC && stage->integrator == BRC_TCHAMWA_WIELGOSZ;
    return BRC_RUN(t->book, t->n, {"book", BRC_INT(book)}, {"numerical", BRC_INT(numerical ? 1 : 0)});
}

brc_status brc_strikers_store_state(brc_simulation *s, brc_state_store *store)
{
    const brc_strikers *t = s->strikers;
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_striker_fields, .owner = t, .n = t->n}));
    if (t->push) BRC_TRY(store->numbers(store, "strikers.push_now", BRC_STORED_DOUBLE, t->n, N_PUSH, t->push_now));
    return store->numbers(store, "strikers.placed", BRC_STORED_DOUBLE, t->n, 1, t->placed);
}

/* ---- asking ---- */

BRC_READ(int32_t, brc_simulation_n_strikers, s->strikers ? s->strikers->n : 0)
const brc_striker_body *brc_simulation_striker_body(const brc_simulation *s, int32_t striker)
{
    return s->strikers->body + striker;
}

/* `width` numbers of one striker. */
static brc_status read_one(brc_simulation *s, brc_buffer *buffer, int32_t striker, int width, double *out)
{
    if (brc_state_bytes(s) == 8) return brc_buffer_read(buffer, (int64_t)striker * width * 8, out, (int64_t)width * 8);
    float narrow[6];
    BRC_TRY(brc_buffer_read(buffer, (int64_t)striker * width * 4, narrow, (int64_t)width * 4));
    for (int c = 0; c < width; ++c)
        out[c] = narrow[c];
    return BRC_OK;
}

/* Rotation vector of a unit quaternion, at most half a turn. */
static void rotation_vector(const double q[4], double out[3])
{
    const double sine = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), sign = q[0] < 0 ? -1 : 1;
    const double share = sine > 0 ? 2 * atan2(sine, sign * q[0]) / sine : 2;
    for (int c = 0; c < 3; ++c)
        out[c] = sign * share * q[c + 1];
}

brc_status brc_simulation_striker_now(brc_simulation *s, int32_t i, brc_striker_now *out)
{
    const brc_strikers *t = s->strikers;
    double motion[6], load[6], applied[3] = {0};
    BRC_TRY(read_one(s, t->displacement, i, 3, out->displacement));
    BRC_TRY(read_one(s, t->orientation, i, 4, out->orientation));
    BRC_TRY(read_one(s, t->momentum, i, 3, out->momentum));
    BRC_TRY(read_one(s, t->motion, i, 6, motion));
    BRC_TRY(read_one(s, t->load, i, 6, load));
    if (t->push) BRC_TRY(read_one(s, t->push, i, 3, applied));
    rotation_vector(out->orientation, out->rotation);
    out->kinetic = 0;
    for (int c = 0; c < 3; ++c) {
        out->velocity[c] = motion[c];
        out->spin[c] = motion[3 + c];
        out->force[c] = load[c];
        out->torque[c] = load[3 + c];
        out->applied[c] = applied[c];
        out->position[c] = t->body[i].centre[c] + out->displacement[c];
        if (is_free(s, i))
            out->kinetic +=
                0.5 * t->body[i].mass * out->velocity[c] * out->velocity[c] + 0.5 * out->momentum[c] * out->spin[c];
    }
    return BRC_OK;
}

brc_status brc_strikers_energies(brc_simulation *s, brc_striker_energies *out)
{
    const double *g = gravity(s);
    *out = (brc_striker_energies){0};
    for (int32_t i = 0; i < s->strikers->n; ++i) {
        brc_striker_now now;
        double work, lost;
        BRC_TRY(brc_simulation_striker_now(s, i, &now));
        BRC_TRY(read_one(s, s->strikers->work, i, 1, &work));
        BRC_TRY(read_one(s, s->strikers->lost, i, 1, &lost));
        out->kinetic += now.kinetic;
        out->work += work + s->strikers->push_now[N_PUSH * (int64_t)i + 3];
        out->numerical += lost;
        for (int c = 0; c < 3; ++c)
            out->potential -= s->strikers->body[i].mass * g[c] * now.displacement[c];
    }
    return BRC_OK;
}
