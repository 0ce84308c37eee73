/* Momenta of fragments from the state of their elements. */
#include "fragments.h"
#include "../../core/solver.h"
#include "../../core/sym3.h"

/* Directions with less than this share of the largest moment of inertia count as without: a row of points about
 * itself. */
static const double no_inertia = 1e-12;

/* State of the elements by id. */
typedef struct elements {
    double *mass, *inertia;     /* [n]; inertia NULL: points */
    double *place, *velocity;   /* [n][3] */
    double *orientation, *spin; /* [n][4], [n][3] or NULL */
    int32_t *fragment;          /* -1: of none */
} elements;

static brc_status read_elements(brc_simulation *s, elements *e)
{
    const int64_t n = s->domain->n_elements;
    BRC_TRY(BRC_ALLOCATE(s->context, &e->mass, n, "fragments"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->place, 3 * n, "fragments"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->velocity, 3 * n, "fragments"));
    BRC_TRY(brc_state_from_rows(s, brc_mass_of(s), e->mass, 1));
    BRC_TRY(brc_simulation_displacement(s, e->place));
    for (int64_t k = 0; k < 3 * n; ++k)
        e->place[k] += s->domain->position[k];
    BRC_TRY(brc_simulation_velocity(s, e->velocity));
    if (!s->model->turns) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &e->inertia, n, "fragments"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->orientation, 4 * n, "fragments"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->spin, 3 * n, "fragments"));
    BRC_TRY(brc_state_from_rows(s, brc_inertia_of(s), e->inertia, 1));
    return brc_simulation_orientation(s, e->orientation, e->spin);
}

static void free_elements(elements *e)
{
    brc_memory_free(e->mass);
    brc_memory_free(e->inertia);
    brc_memory_free(e->place);
    brc_memory_free(e->velocity);
    brc_memory_free(e->orientation);
    brc_memory_free(e->spin);
    brc_memory_free(e->fragment);
}

/* Mass, centre and velocity; kinetic energy of the elements, in `internal` for now. */
static void sum_momenta(const elements *e, int64_t n_elements, int64_t n, brc_fragment *list)
{
    for (int64_t k = 0; k < n_elements; ++k) {
        if (e->fragment[k] < 0) continue;
        brc_fragment *f = &list[e->fragment[k]];
        if (f->n_elements++ == 0) f->first_element = (int32_t)k;
        f->mass += e->mass[k];
        for (int c = 0; c < 3; ++c) {
            f->centre[c] += e->mass[k] * e->place[3 * k + c];
            f->velocity[c] += e->mass[k] * e->velocity[3 * k + c];
        }
    }
    for (int64_t i = 0; i < n; ++i) {
        brc_fragment *f = &list[i];
        for (int c = 0; c < 3; ++c) {
            f->centre[c] /= f->mass;
            f->velocity[c] /= f->mass;
            f->translation += 0.5 * f->mass * f->velocity[c] * f->velocity[c];
        }
    }
}

/* Inertia, and the angular momentum about the centre in `spin` for now. Velocities count from the centre's, so that
 * nothing cancels. */
static void sum_moments(const elements *e, int64_t n_elements, brc_fragment *list)
{
    for (int64_t k = 0; k < n_elements; ++k) {
        if (e->fragment[k] < 0) continue;
        brc_fragment *f = &list[e->fragment[k]];
        const double m = e->mass[k];
        double r[3], v[3];
        for (int c = 0; c < 3; ++c) {
            r[c] = e->place[3 * k + c] - f->centre[c];
            v[c] = e->velocity[3 * k + c] - f->velocity[c];
        }
        const double own = e->inertia ? e->inertia[k] : 0;
        for (int c = 0; c < 3; ++c) {
            const int a = (c + 1) % 3, b = (c + 2) % 3;
            const double w = e->spin ? e->spin[3 * k + c] : 0;
            f->inertia[c] += m * (r[a] * r[a] + r[b] * r[b]) + own;
            f->inertia[3 + c] -= m * r[a] * r[b];
            f->spin[c] += m * (r[a] * v[b] - r[b] * v[a]) + own * w;
            f->internal += 0.5 * (m * v[c] * v[c] + own * w * w);
        }
    }
}

/* The spin from the angular momentum. */
static void turn(brc_fragment *f)
{
    double inverse[6], spin[3];
    const double moment[3] = {f->spin[0], f->spin[1], f->spin[2]};
    const int kept = brc_sym3_pseudo_inverse(f->inertia, no_inertia, inverse);
    for (int c = 0; c < 3; ++c) { /* packed xx yy zz yz xz xy: the entry of rows a, b is 3 + c */
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        spin[c] = kept > 0 ? inverse[c] * moment[c] + inverse[3 + b] * moment[a] + inverse[3 + a] * moment[b] : 0;
    }
    for (int c = 0; c < 3; ++c) {
        f->spin[c] = spin[c];
        f->rotation += 0.5 * spin[c] * moment[c];
    }
    f->internal -= f->rotation;
}

static void sum_up(const elements *e, int64_t n_elements, int64_t n, brc_fragment *list)
{
    sum_momenta(e, n_elements, n, list);
    sum_moments(e, n_elements, list);
    for (int64_t i = 0; i < n; ++i)
        turn(&list[i]);
}

brc_status brc_simulation_set_motion(brc_simulation *s, int32_t set, brc_fragment *out)
{
    const int64_t n_elements = s->domain->n_elements;
    BRC_ENDS_WITH(free_elements) elements e = {0};
    *out = (brc_fragment){0};
    BRC_TRY(BRC_ALLOCATE(s->context, &e.fragment, n_elements, "motion of a set"));
    for (int64_t k = 0; k < n_elements; ++k)
        e.fragment[k] = set < 0 ? 0 : -1;
    for (int64_t k = 0; set >= 0 && k < s->domain->sets[set].n_members; ++k)
        e.fragment[s->domain->sets[set].members[k]] = 0;
    BRC_TRY(read_elements(s, &e));
    sum_up(&e, n_elements, 1, out);
    return BRC_OK;
}

brc_status brc_simulation_fragment_list(brc_simulation *s, int64_t *n, brc_fragment **out)
{
    const int64_t n_elements = s->domain->n_elements;
    BRC_ENDS_WITH(free_elements) elements e = {0};
    *n = 0;
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &e.fragment, n_elements, "fragments"));
    BRC_TRY(brc_simulation_fragments(s, e.fragment, n));
    BRC_TRY(read_elements(s, &e));
    BRC_TRY(BRC_ALLOCATE(s->context, out, *n, "fragments"));
    sum_up(&e, n_elements, *n, *out);
    return BRC_OK;
}
