/* Dead forces on elements, and elements whose rotation is prescribed. */
#include "../../statics/balance.h"
#include "loads_internal.h"
#include <math.h>
#include <stdlib.h>

int brc_load_compare_members(const void *left, const void *right)
{
    const brc_load_member *a = left, *b = right;
    if (a->row != b->row) return a->row < b->row ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

brc_status brc_load_members(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_load_member **out,
                            int32_t *n)
{
    const brc_domain *d = s->domain;
    brc_status status = BRC_OK;
    *out = NULL;
    *n = 0;
    const brc_set *set = brc_load_find_set(s, stage, load, BRC_SET_ELEMENTS, &status);
    if (!set) return status;
    BRC_TRY(BRC_ALLOCATE(s->context, out, set->n_members, "elements of a load"));
    brc_load_member *items = *out;
    for (int64_t m = 0; m < set->n_members; ++m) {
        const int32_t e = set->kind == BRC_SET_ELEMENTS ? set->members[m] : d->free_element[set->members[m]];
        items[m] = (brc_load_member){s->layout->row_of_element[e], e};
    }
    qsort(items, (size_t)set->n_members, sizeof *items, brc_load_compare_members);
    for (int64_t m = 0; m < set->n_members; ++m)
        if (*n == 0 || items[*n - 1].id != items[m].id) items[(*n)++] = items[m];
    return BRC_OK;
}

/* A force on an element that has no bond and is held still would be lost, and the body out of balance: those with bonds
 * share the total. */
static brc_status leave_isolated_out(brc_simulation *s, const brc_stage *stage, const brc_load *load,
                                     brc_load_member *items, int32_t *n)
{
    const int64_t *start = s->domain->row_start;
    int32_t kept = 0;
    if (!brc_has_spheres(s)) return BRC_OK;
    for (int32_t i = 0; i < *n; ++i)
        if (start[items[i].id + 1] > start[items[i].id]) items[kept++] = items[i];
    if (kept == 0 && *n > 0)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "stage '%s': none of the %d elements of '%s' has a bond, so a force on them has nothing to "
                        "hold it; load others",
                        stage->name, (int)*n, load->set);
    *n = kept;
    return BRC_OK;
}

/* Forces at factor 1 [n][3]. */
static brc_status share_out(brc_simulation *s, const brc_stage *stage, const brc_load *load,
                            const brc_load_member *items, int32_t n, double *total)
{
    double mass = 0;
    for (int32_t i = 0; i < n; ++i)
        mass += brc_mass_of_element(s, items[i].id);
    for (int32_t i = 0; i < n; ++i) {
        double *f = total + 3 * (int64_t)i;
        const double part = load->share == BRC_SHARE_MASS ? brc_mass_of_element(s, items[i].id) / mass : 1.0 / n;
        const double *x = s->domain->position + 3 * (int64_t)items[i].id;
        const double r[3] = {x[0] - load->origin[0], x[1] - load->origin[1], x[2] - load->origin[2]};
        const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        if (load->radial && !(length > 0))
            return BRC_FAIL(s->context, BRC_BAD_INPUT,
                            "stage '%s': element %d of '%s' lies at the centre of the radial forces; move the centre",
                            stage->name, (int)items[i].id, load->set);
        for (int c = 0; c < 3; ++c)
            f[c] = load->radial ? load->radial_force / n * r[c] / length : part * load->value[c];
    }
    if (load->radial) {
        double *place = NULL, rigid;
        BRC_TRY(BRC_ALLOCATE(s->context, &place, 3 * (int64_t)n, "forces on elements"));
        for (int64_t k = 0; k < 3 * (int64_t)n; ++k)
            place[k] = s->domain->position[3 * (int64_t)items[k / 3].id + k % 3];
        brc_balance(n, place, NULL, total, &rigid);
        brc_memory_free(place);
    }
    return BRC_OK;
}

brc_status brc_push_create(brc_simulation *s, const brc_stage *stage, int32_t l, brc_push_load *out)
{
    const brc_load *load = stage->loads + l;
    BRC_FREED brc_load_member *items = NULL;
    int32_t n = 0;
    BRC_TRY(brc_load_members(s, stage, load, &items, &n));
    BRC_TRY(leave_isolated_out(s, stage, load, items, &n));
    BRC_LOCAL(s->context, n, int32_t, element, "forces on elements");
    BRC_TRY(BRC_ALLOCATE(s->context, &out->element_id, n, "forces on elements"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->total_of, 3 * (int64_t)n, "forces on elements"));
    BRC_TRY(share_out(s, stage, load, items, n, out->total_of));
    out->load = l;
    out->n = n;
    for (int32_t i = 0; i < n; ++i) {
        element[i] = items[i].row;
        out->element_id[i] = items[i].id;
    }
    BRC_TRY(brc_load_fields_create(s, &brc_push_fields, n, out));
    BRC_TRY(brc_upload_int(out->element, element, n));
    return brc_upload_state(s, out->total, out->total_of, 3 * (int64_t)n);
}

brc_status brc_turn_create(brc_simulation *s, const brc_stage *stage, int32_t l, int32_t *taken, brc_turn_load *out)
{
    const brc_load *load = stage->loads + l;
    BRC_FREED brc_load_member *items = NULL;
    int32_t n = 0;
    int64_t twice = 0;
    if (!s->model->turns || (stage->solver != BRC_SOLVER_DYNAMIC && !brc_solves_rotations(s->model)))
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "stage '%s': element_rotation needs elements with rotations: model cbm, or dlsm-published in a "
                        "dynamic stage",
                        stage->name);
    BRC_TRY(brc_load_members(s, stage, load, &items, &n));
    BRC_LOCAL(s->context, n, int32_t, element, "turned elements");
    BRC_TRY(BRC_ALLOCATE(s->context, &out->element_id, n, "turned elements"));
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, flags, "turned elements");
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, direction, "turned elements");
    out->load = l;
    out->n = n;
    for (int32_t i = 0; i < n; ++i) {
        bool again = false;
        element[i] = items[i].row;
        out->element_id[i] = items[i].id;
        for (int c = 0; c < 3; ++c) {
            if (!load->component[c]) continue;
            again |= taken[items[i].id] >> c & 1;
            taken[items[i].id] |= 1 << c;
            flags[3 * (int64_t)i + c] = 1;
            direction[3 * (int64_t)i + c] = load->value[c];
        }
        twice += again;
    }
    if (twice) return brc_loads_refuse_twice(s, stage, load, twice);
    BRC_TRY(brc_load_fields_create(s, &brc_turn_fields, n, out));
    BRC_TRY(brc_upload_int(out->element, element, n));
    BRC_TRY(brc_upload_coeff(s, out->component, flags, 3 * (int64_t)n));
    return brc_upload_state(s, out->direction, direction, 3 * (int64_t)n);
}

void brc_element_loads_free(brc_loads *loads)
{
    for (int32_t i = 0; i < loads->n_pushes; ++i) {
        brc_push_load *p = loads->pushes + i;
        brc_fields_free(&brc_push_fields, p);
        brc_memory_free(p->element_id);
        brc_memory_free(p->total_of);
    }
    for (int32_t i = 0; i < loads->n_turns; ++i) {
        brc_turn_load *t = loads->turns + i;
        brc_fields_free(&brc_turn_fields, t);
        brc_memory_free(t->element_id);
    }
    brc_memory_free(loads->pushes);
    brc_memory_free(loads->turns);
}

static bool is_static(const brc_simulation *s)
{
    return brc_current_stage(s)->solver == BRC_SOLVER_STATIC;
}

brc_status brc_pushes_apply(brc_simulation *s, const brc_force_request *r)
{
    for (int32_t i = 0; i < s->loads->n_pushes; ++i) {
        brc_push_load *p = s->loads->pushes + i;
        p->factor = brc_load_factor(brc_current_stage(s)->loads + p->load, r->t, is_static(s));
        BRC_TRY(brc_pass_run_on(s->loads->pass.push_elements, p->n, r, p, NULL));
        if (r->book != BRC_BOOK_NOTHING) p->last_factor = p->factor;
    }
    return BRC_OK;
}

brc_status brc_turns_book(brc_simulation *s, const brc_force_request *r)
{
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        brc_turn_load *m = s->loads->turns + i;
        const brc_load *load = brc_current_stage(s)->loads + m->load;
        const double factor = brc_load_factor(load, r->t, is_static(s)),
                     rate = is_static(s) ? 0 : brc_load_rate(load, r->t);
        BRC_TRY(BRC_RUN_ON(s->loads->pass.turn_book, m->n, r, m, {"step", BRC_STATE(factor - m->last_factor)},
                           {"rate", BRC_STATE(rate)}));
        if (r->book == BRC_BOOK_NOTHING) continue;
        m->last_factor = factor;
        m->last_rate = rate;
    }
    return BRC_OK;
}

static brc_status turn(brc_simulation *s, const brc_turn_load *m, double angle, bool finite, double rate)
{
    return BRC_RUN_ON(s->loads->pass.impose_turn, m->n, NULL, m, {"angle", BRC_STATE(angle)},
                      {"finite", BRC_INT(finite ? 1 : 0)}, {"rate", BRC_STATE(rate)});
}

brc_status brc_turns_prescribe(brc_simulation *s, double t)
{
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        brc_turn_load *m = s->loads->turns + i;
        const brc_load *load = brc_current_stage(s)->loads + m->load;
        const double factor = brc_load_factor(load, t, is_static(s));
        /* dynamics integrates the spin; only a factor that is there from the start is a jump */
        const double jump = is_static(s) || t == 0 ? factor - m->turned : 0;
        BRC_TRY(turn(s, m, jump, !is_static(s) || brc_current_stage(s)->finite_strain,
                     is_static(s) ? 0 : brc_load_rate(load, t)));
        m->turned = factor;
    }
    return BRC_OK;
}

brc_status brc_turns_begin_step(brc_simulation *s, double t0, double t1)
{
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        const brc_turn_load *m = s->loads->turns + i;
        const brc_load *load = brc_current_stage(s)->loads + m->load;
        BRC_TRY(turn(s, m, 0, true, (brc_load_factor(load, t1, false) - brc_load_factor(load, t0, false)) / (t1 - t0)));
    }
    return BRC_OK;
}
