#include "free_bodies.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "pieces.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Parts that no bond joins, of a domain before anything broke. */
typedef struct parts {
    int64_t n;
    int32_t *of;            /* [n_elements] */
    int64_t *size;          /* [n] */
    int32_t *first;         /* [n] the first element of each */
    brc_free_motions *free; /* [n] */
    double (*push)[6];      /* [n] work of the loads on each free motion, */
    double (*most)[6];      /* and with all of it of one sign */
    double (*lean)[3][3];   /* [n] sum of force (x) place from the centre [N m] */
    double (*spread)[3][3]; /* [n] sum of mass place (x) place [kg m^2] */
} parts;

static brc_status find_parts(brc_context *context, const brc_domain *d, parts *p)
{
    BRC_TRY(BRC_ALLOCATE(context, &p->of, d->n_elements, "parts of bodies"));
    BRC_TRY(brc_pieces_number(context, d, p->of, &p->n));
    BRC_TRY(BRC_ALLOCATE(context, &p->size, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->first, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->free, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->push, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->most, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->lean, p->n, "parts of bodies"));
    BRC_TRY(BRC_ALLOCATE(context, &p->spread, p->n, "parts of bodies"));
    for (int64_t e = d->n_elements - 1; e >= 0; --e) {
        p->size[p->of[e]] += 1;
        p->first[p->of[e]] = (int32_t)e;
    }
    return BRC_OK;
}

static void free_parts(parts *p)
{
    brc_memory_free(p->of);
    brc_memory_free(p->size);
    brc_memory_free(p->first);
    brc_memory_free(p->free);
    brc_memory_free(p->push);
    brc_memory_free(p->most);
    brc_memory_free(p->lean);
    brc_memory_free(p->spread);
}

/* Places of all parts, then what they are supported at. */
static brc_status begin_motions(brc_context *context, const brc_domain *d, parts *p)
{
    int64_t start = 0;
    BRC_LOCAL(context, 3 * d->n_elements, double, place, "parts of bodies");
    BRC_LOCAL(context, p->n, int64_t, at, "parts of bodies");
    for (int64_t i = 0; i < p->n; start += p->size[i++])
        at[i] = start;
    for (int64_t e = 0; e < d->n_elements; ++e)
        memcpy(place + 3 * at[p->of[e]]++, d->position + 3 * e, 3 * sizeof *place);
    for (int64_t i = 0; i < p->n; ++i)
        brc_free_motions_begin(&p->free[i], p->size[i], place + 3 * (at[i] - p->size[i]));
    return BRC_OK;
}

static bool is_motion_of(const brc_load *load, bool faces)
{
    return faces ? load->kind == BRC_LOAD_FACE_DISPLACEMENT || load->kind == BRC_LOAD_FACE_VELOCITY
                 : load->kind == BRC_LOAD_ELEMENT_DISPLACEMENT || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
}
static bool is_force(const brc_load *load)
{
    return load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE || load->kind == BRC_LOAD_ELEMENT_FORCE;
}

/* The set a load names, NULL where the run will say that there is none. */
static const brc_set *set_of(const brc_domain *d, const brc_load *load)
{
    const int32_t index = brc_domain_find_set(d, load->set);
    return index < 0 ? NULL : &d->sets[index];
}

static void hold(const brc_domain *d, const brc_load *load, parts *p)
{
    const brc_set *set = set_of(d, load);
    for (int64_t k = 0; set && k < set->n_members; ++k) {
        const int32_t member = set->members[k], e = set->kind == BRC_SET_FACES ? d->free_element[member] : member;
        const double *place = is_motion_of(load, true) && set->kind == BRC_SET_FACES
                                  ? d->free_centroid + 3 * (int64_t)member
                                  : d->position + 3 * (int64_t)e;
        for (int c = 0; c < 3; ++c) {
            if (!load->component[c]) continue;
            if (load->kind == BRC_LOAD_ELEMENT_ROTATION)
                brc_free_motions_clamp(&p->free[p->of[e]], c);
            else
                brc_free_motions_hold(&p->free[p->of[e]], place, c);
        }
    }
}

/* A force does work on the free motions of its part. */
static void push(parts *p, int32_t e, const double *place, const double force[3])
{
    const int32_t i = p->of[e];
    const brc_free_motions *free = &p->free[i];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            p->lean[i][r][c] += force[r] * (place[c] - free->centre[c]);
    for (int m = 0; m < free->n; ++m) {
        const double *a = free->motion[m], *b = a + 3;
        for (int c = 0; c < 3; ++c) {
            const int q = (c + 1) % 3, r = (c + 2) % 3;
            const double work =
                force[c] * (a[c] + b[q] * (place[r] - free->centre[r]) - b[r] * (place[q] - free->centre[q]));
            p->push[i][m] += work;
            p->most[i][m] += fabs(work);
        }
    }
}

static double mass_of(const brc_scene *scene, const brc_domain *d, int64_t e)
{
    const int32_t b = d->body[e] < scene->n_bodies ? d->body[e] : 0;
    return d->volume[e] * scene->materials[brc_body_material(&scene->bodies[b], d->region[e])].density;
}

static void push_faces(const brc_domain *d, const brc_load *load, parts *p)
{
    const brc_set *set = set_of(d, load);
    for (int64_t k = 0; set && set->kind == BRC_SET_FACES && k < set->n_members; ++k) {
        const int64_t f = set->members[k];
        const double *s = d->free_area_vector + 3 * f, area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        double force[3];
        for (int c = 0; c < 3; ++c)
            force[c] = load->kind == BRC_LOAD_PRESSURE ? -load->value[0] * s[c] : load->value[c] * area;
        push(p, d->free_element[f], d->free_centroid + 3 * f, force);
    }
}

/* Shared out as element_loads.c does; radial forces balance by themselves. */
static void push_elements(const brc_scene *scene, const brc_domain *d, const brc_load *load, parts *p)
{
    const brc_set *set = set_of(d, load);
    double mass = 0;
    if (!set || set->kind != BRC_SET_ELEMENTS || load->radial) return;
    for (int64_t k = 0; k < set->n_members; ++k)
        mass += mass_of(scene, d, set->members[k]);
    for (int64_t k = 0; k < set->n_members; ++k) {
        const int32_t e = set->members[k];
        const double share = load->share == BRC_SHARE_MASS ? mass_of(scene, d, e) / mass : 1.0 / (double)set->n_members;
        push(p, e, d->position + 3 * (int64_t)e,
             (double[3]){share * load->value[0], share * load->value[1], share * load->value[2]});
    }
}

static void push_all(const brc_scene *scene, const brc_stage *stage, const brc_domain *d, parts *p)
{
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const brc_load *load = &stage->loads[l];
        if (load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE) push_faces(d, load, p);
        if (load->kind == BRC_LOAD_ELEMENT_FORCE) push_elements(scene, d, load, p);
    }
    for (int64_t e = 0; scene->has_gravity && e < d->n_elements; ++e) {
        const double mass = mass_of(scene, d, e);
        push(p, (int32_t)e, d->position + 3 * e,
             (double[3]){mass * scene->gravity[0], mass * scene->gravity[1], mass * scene->gravity[2]});
    }
}

/* Turns among the motions, as orthonormal rows; returns how many. */
static int turns_of(const brc_free_motions *free, double turn[3][3])
{
    int n = 0;
    for (int m = 0; m < free->n && n < 3; ++m) {
        double left[3], square = 0;
        for (int c = 0; c < 3; ++c)
            left[c] = free->motion[m][3 + c] * free->arm;
        for (int twice = 0; twice < 2; ++twice)
            for (int k = 0; k < n; ++k) {
                const double along = left[0] * turn[k][0] + left[1] * turn[k][1] + left[2] * turn[k][2];
                for (int c = 0; c < 3; ++c)
                    left[c] -= along * turn[k][c];
            }
        for (int c = 0; c < 3; ++c)
            square += left[c] * left[c];
        if (square < 1e-8) continue;
        for (int c = 0; c < 3; ++c)
            turn[n][c] = left[c] / sqrt(square);
        ++n;
    }
    return n;
}

/* "along y, z": the axes whose flag is set; *at grows. */
static void put_axes(const bool axis[3], const char *how, char *out, size_t room, size_t *at)
{
    bool first = true;
    for (int c = 0; c < 3; ++c) {
        if (!axis[c] || *at >= room) continue;
        *at += (size_t)snprintf(out + *at, room - *at, "%s%s%c", first ? *at ? " and " : "" : ", ", first ? how : "",
                                "xyz"[c]);
        first = false;
    }
}

const char *brc_free_motions_text(const brc_free_motions *free, char *out, size_t room)
{
    static const double near = 1e-3; /* of an axis */
    double turn[3][3];
    bool moves[3], turns[3];
    size_t at = 0;
    const int n_turns = turns_of(free, turn);
    int named = 0;
    for (int c = 0; c < 3; ++c) {
        double moved = 0, turned = 0;
        for (int m = 0; m < free->n; ++m)
            moved += free->motion[m][c] * free->motion[m][c];
        for (int m = 0; m < n_turns; ++m)
            turned += turn[m][c] * turn[m][c];
        moves[c] = moved > 1 - near;
        turns[c] = turned > 1 - near;
        named += moves[c] + turns[c];
    }
    out[0] = '\0';
    put_axes(moves, "along ", out, room, &at);
    put_axes(turns, "to turn about ", out, room, &at);
    if (named < free->n && at < room)
        snprintf(out + at, room - at, "%sin %d way%s aslant the axes", at ? " and " : "", free->n - named,
                 free->n - named > 1 ? "s" : "");
    return out;
}

/* One line for a part. */
static void tell_part(brc_context *context, const brc_scene *scene, const brc_stage *stage, const brc_domain *d,
                      const parts *p, int64_t i, bool all)
{
    static const double least = 1e-3; /* of a load that pushes, as in statics.c */
    const int32_t e = p->first[i], body = d->body[e] < scene->n_bodies ? d->body[e] : 0;
    char motions[128], part[64] = "";
    bool pushed = false;
    int64_t of_body = 0;
    for (int64_t k = 0; k < p->n; ++k)
        of_body += d->body[p->first[k]] == d->body[e];
    if (of_body > 1) snprintf(part, sizeof part, "a part of %lld elements of ", (long long)p->size[i]);
    for (int m = 0; m < p->free[i].n; ++m)
        pushed = pushed || fabs(p->push[i][m]) > least * p->most[i][m];
    brc_free_motions_text(&p->free[i], motions, sizeof motions);
    if (pushed)
        brc_log(context, BRC_LOG_WARNING,
                "stage '%s': %sbody '%s' is free to move %s, and its loads push it there: no equilibrium answers them; "
                "hold it there, or balance its loads",
                stage->name, part, scene->bodies[body].name, motions);
    else if (all)
        brc_log(context, BRC_LOG_INFO,
                "stage '%s': %sbody '%s' is free to move %s; no load pushes it there, and it stays", stage->name, part,
                scene->bodies[body].name, motions);
}

/* What the loads of a stage leave free, and what they do there. */
static brc_status find_free_motions(brc_context *context, const brc_scene *scene, const brc_stage *stage,
                                    const brc_domain *d, parts *p)
{
    BRC_TRY(begin_motions(context, d, p));
    memset(p->push, 0, (size_t)p->n * sizeof *p->push);
    memset(p->most, 0, (size_t)p->n * sizeof *p->most);
    memset(p->lean, 0, (size_t)p->n * sizeof *p->lean);
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const brc_load *load = &stage->loads[l];
        if (is_motion_of(load, true) || is_motion_of(load, false) || load->kind == BRC_LOAD_ELEMENT_ROTATION)
            hold(d, load, p);
    }
    for (int64_t i = 0; i < p->n; ++i)
        if (!brc_free_motions_find(&p->free[i]))
            return BRC_FAIL(context, BRC_INTERNAL, "the free motions of stage '%s' were not found", stage->name);
    push_all(scene, stage, d, p);
    return BRC_OK;
}

/* a.A a - tr A: of a turn about the axis a by 1, twice the work of dead forces to second order (their lean), or minus
 * the moment of inertia (the spread of mass). */
static double about(const double axis[3], double of[3][3])
{
    double sum = -of[0][0] - of[1][1] - of[2][2];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            sum += axis[r] * of[r][c] * axis[c];
    return sum;
}

/* "y", or "(0.71, 0, 0.71)". */
static const char *axis_text(const double axis[3], char *out, size_t room)
{
    static const double near = 1e-3;
    for (int c = 0; c < 3; ++c)
        if (fabs(axis[c]) > 1 - near) return c == 0 ? "x" : c == 1 ? "y" : "z";
    double told[3];
    for (int c = 0; c < 3; ++c)
        told[c] = fabs(axis[c]) < near ? 0 : axis[c];
    snprintf(out, room, "(%.2g, %.2g, %.2g)", told[0], told[1], told[2]);
    return out;
}

/* How long the forces of a stage last [s]: its duration, or until the tables of all of them have come to 0. */
static double lasts(const brc_stage *stage)
{
    double longest = 0;
    for (int32_t l = 0; l < stage->n_loads; ++l) {
        const brc_load *load = &stage->loads[l];
        if (!is_force(load)) continue;
        const int32_t last = load->table.n - 1;
        const bool ends = last >= 0 && load->table.value[last] == 0;
        longest = fmax(longest, ends ? fmin(load->table.time[last], stage->duration) : stage->duration);
    }
    return longest;
}

/* Dead forces that press a part which nothing keeps from turning: the farther it turns, the more they turn it. Warned
 * of where a turn grows tenfold ten times while they last. */
static void tell_turning(brc_context *context, const brc_scene *scene, const brc_stage *stage, const brc_domain *d,
                         const parts *p, int64_t i)
{
    const int32_t e = p->first[i], body = d->body[e] < scene->n_bodies ? d->body[e] : 0;
    double turn[3][3];
    char axis[64];
    const int n_turns = turns_of(&p->free[i], turn);
    for (int m = 0; m < n_turns; ++m) {
        const double work = about(turn[m], p->lean[i]), inertia = -about(turn[m], p->spread[i]);
        const double tenfold = work > 0 && inertia > 0 ? log(10) / sqrt(work / inertia) : INFINITY;
        if (!(lasts(stage) > 10 * tenfold)) continue;
        brc_log(context, BRC_LOG_WARNING,
                "stage '%s': body '%s' is free to turn about %s, and its loads press it: they keep their direction, so "
                "that a turn grows tenfold every %.2g s of the %.2g s they last; hold two of its elements by "
                "element_velocity, or press it by strikers",
                stage->name, scene->bodies[body].name, axis_text(turn[m], axis, sizeof axis), tenfold, lasts(stage));
        return;
    }
}

static brc_status tell_dynamic_stage(brc_context *context, const brc_scene *scene, const brc_stage *stage,
                                     const brc_domain *d, parts *p)
{
    BRC_TRY(find_free_motions(context, scene, stage, d, p));
    memset(p->spread, 0, (size_t)p->n * sizeof *p->spread);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double mass = mass_of(scene, d, e), *centre = p->free[p->of[e]].centre, *place = d->position + 3 * e;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                p->spread[p->of[e]][r][c] += mass * (place[r] - centre[r]) * (place[c] - centre[c]);
    }
    for (int64_t i = 0; i < p->n; ++i)
        if (p->free[i].n > 0 && p->size[i] > 1) tell_turning(context, scene, stage, d, p, i);
    return BRC_OK;
}

static brc_status tell_stage(brc_context *context, const brc_scene *scene, const brc_stage *stage, const brc_domain *d,
                             parts *p, bool all)
{
    enum { MOST_WARNED = 8 };
    int64_t n_warned = 0;
    BRC_TRY(find_free_motions(context, scene, stage, d, p));
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->free[i].n == 0 || p->size[i] < 2) continue; /* single elements without bonds: beams.c */
        if (n_warned++ < MOST_WARNED) tell_part(context, scene, stage, d, p, i, all);
    }
    if (all && n_warned > MOST_WARNED)
        brc_log(context, BRC_LOG_INFO, "stage '%s': %lld more parts are free to move", stage->name,
                (long long)(n_warned - MOST_WARNED));
    return BRC_OK;
}

/* A dynamic stage with forces, of bodies that neither strikers nor each other may hold by contact. */
static bool presses_freely(const brc_scene *scene, const brc_stage *stage)
{
    bool some = false;
    for (int32_t l = 0; l < stage->n_loads; ++l)
        some = some || is_force(&stage->loads[l]);
    return some && stage->solver == BRC_SOLVER_DYNAMIC && scene->n_strikers == 0 &&
           !(scene->has_contact && scene->n_bodies > 1);
}

brc_status brc_free_bodies_tell(brc_context *context, const brc_scene *scene, const brc_domain *domain, bool all)
{
    parts p = {0};
    brc_status status = BRC_OK;
    for (int32_t k = 0; status == BRC_OK && k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        const bool is_static = stage->solver == BRC_SOLVER_STATIC;
        if (!is_static && !presses_freely(scene, stage)) continue;
        if (!p.of) status = find_parts(context, domain, &p);
        if (status != BRC_OK) break;
        status = is_static ? tell_stage(context, scene, stage, domain, &p, all)
                           : tell_dynamic_stage(context, scene, stage, domain, &p);
    }
    free_parts(&p);
    return status;
}
