/* Bonds of dlsm that break (docs/notebook/fracture.md, "Fracture of cells"). */
#include "../../core/awake.h"
#include "brittle_interfaces.h"
#include "cell_softening.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../../base/ranks.h"
#include "../../core/sym3.h"
#include "../../effects/loads/loads.h"
#include "consistent.h"
#include "dlsm_internal.h"
#include "rims.h"
#include <math.h>

/* An element is held while the smallest eigenvalue of A / (2 V) is above this share of its value in the whole body, and
 * above `support_least` (docs/notebook/fracture.md, Fracture of cells; 0.57 or more inside a body, 0.07 to 0.5 at its
 * boundary). */
static const double support_share = 0.2, support_least = 0.05;
/* What holds an element in the whole body, from the coefficients that the device has: *least: smallest eigenvalue of A
 * / (2 V) [-]; *stiff: largest eigenvalue of A^-1 (sum s (x) s + t (x) t) A^-1, t = sum s (cells_stiffness) [1/m^2]. */
static void support_of(const brc_simulation *s, int64_t e, double *least, double *stiff)
{
    double a[6] = {0}, b[6] = {0}, total[3] = {0}, value[3], axis[3][3], root[3][3] = {{0}}, whole[6] = {0};
    static const int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    for (int64_t h = s->domain->row_start[e]; h <= s->domain->row_start[e + 1]; ++h) { /* and once more for t */
        const bool is_sum = h == s->domain->row_start[e + 1];
        double x[3], ratio = 0;
        if (!is_sum) brc_consistent_bond(s, e, h, x, &ratio);
        for (int c = 0; c < 3; ++c) {
            if (is_sum)
                x[c] = total[c];
            else
                total[c] += x[c];
        }
        const double six[6] = {x[0] * x[0], x[1] * x[1], x[2] * x[2], x[1] * x[2], x[0] * x[2], x[0] * x[1]};
        for (int c = 0; c < 6; ++c)
            a[c] += ratio * six[c], b[c] += six[c];
    }
    brc_sym3_eigen(a, value, axis);
    *least = 0.5 * value[0] / s->domain->volume[e];
    *stiff = 0;
    if (!(value[0] > 1e-12 * value[2])) return;
    for (int i = 0; i < 3; ++i) /* A^-1 */
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                root[i][j] += axis[k][i] * axis[k][j] / value[k];
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l)
                    whole[at[i][j]] += root[i][k] * b[at[k][l]] * root[l][j];
    brc_sym3_eigen(whole, value, NULL);
    *stiff = value[2];
}

/* Per element: lambda + 2 mu, what it must keep of its support, and how stiff it may become: as the stiffest of the
 * whole body, whose frequency the time step bears. */
static brc_status upload_elements(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    double largest = 0;
    int64_t weak = 0;
    BRC_LOCAL(s->context, layout->n_rows, double, modulus, "moduli");
    BRC_LOCAL(s->context, layout->n_rows, double, support, "supports");
    BRC_LOCAL(s->context, layout->n_rows, double, stiffest, "supports");
#pragma omp parallel for schedule(static) reduction(+ : weak) reduction(max : largest)
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        if (e < 0 || !brc_domain_has(s->domain, e)) continue;
        const brc_elastic *m = s->elastic + s->material_of_element[e];
        double whole, stiff;
        support_of(s, e, &whole, &stiff);
        support[r] = fmax(support_share * whole, support_least);
        weak += whole <= support_least && brc_domain_mine(s->domain, e);
        largest = fmax(largest, (m->lambda + 2 * m->mu) / m->density * stiff);
    }
    if (s->domain->here) {
        BRC_TRY(brc_ranks_reduce(s->context, BRC_SUM, 1, &weak));
        BRC_TRY(brc_ranks_most(s->context, 1, &largest));
    }
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        if (e < 0) continue;
        modulus[r] = s->elastic[s->material_of_element[e]].lambda + 2 * s->elastic[s->material_of_element[e]].mu;
        stiffest[r] = largest * s->elastic[s->material_of_element[e]].density / modulus[r];
    }
    if (weak)
        brc_log(s->context, BRC_LOG_WARNING,
                "fracture: %lld of %lld elements are held by their neighbours so weakly (smallest eigenvalue of A/2V "
                "up to %.2g) that they come off with "
                "their first broken bond; a relaxed grid (`lloyd`) has fewer",
                (long long)weak, (long long)s->domain->n_elements, support_least);
    BRC_TRY(brc_upload_coeff(s, brc_cell_breaks_array(s, "plane"), modulus, layout->n_rows));
    BRC_TRY(brc_upload_coeff(s, brc_cell_breaks_array(s, "support"), support, layout->n_rows));
    return brc_upload_coeff(s, brc_cell_breaks_array(s, "stiffest"), stiffest, layout->n_rows);
}

static brc_status make_passes(brc_simulation *s)
{
    brc_dlsm_own *c = brc_dlsm_own_of(s);
    const bool whole = !brc_cell_breaks_by_bond(s);
    const brc_scope run = brc_scope_of_run(s), request = brc_scope_of_request(&run);
    brc_cell_scopes of_state, of_request;
    const brc_scope *state = brc_cell_scopes_make(s, &run, &of_state);
    BRC_TRY(BRC_PASSES(s, state, {&c->check, "cells_check", "share", whole}, {&c->ratio, "cells_ratio", "out", whole},
                       BRC_PASS(&c->rebuild, "cells_rebuild", NULL),
                       BRC_PASS(&c->elastic, "dlsm_elastic_listed", BRC_LISTED),
                       BRC_PASS(&c->bonds, "dlsm_bonds_listed", BRC_LISTED)));
    /* a request is asked first */
    const brc_scope evaluation = brc_scope_of_request(brc_cell_scopes_make(s, &request, &of_request));
    BRC_TRY(BRC_PASSES(s, &evaluation, {&c->screening_force, "cells_force", NULL, whole},
                       {&c->screening_force_listed, "cells_force_listed", BRC_LISTED, whole}));
    const brc_scope held = brc_scope_of_held_faces(s, &evaluation);
    BRC_TRY(BRC_PASSES(s, &held, {&c->screening_force_held, "cells_force_held", NULL, whole || !s->wants.face_loads}));
    return brc_rims_make_passes(s, state);
}

brc_status brc_dlsm_breaks_create(brc_simulation *s)
{
    BRC_TRY(upload_elements(s));
    BRC_TRY(make_passes(s));
    return brc_brittle_interfaces_create(s);
}

brc_status brc_dlsm_mark(brc_simulation *s, double share)
{
    BRC_TRY(brc_pass_look_awake(s, brc_dlsm_own_of(s)->check, BRC_GIVEN({"share", BRC_COEFF(share)})));
    return brc_brittle_interfaces_mark(s, share);
}

brc_status brc_dlsm_rebuild(brc_simulation *s)
{
    return brc_pass_run(brc_dlsm_own_of(s)->rebuild, s->n_groups);
}

BRC_READ(bool, brc_dlsm_screens, brc_cell_breaks_by_bond(s) && !brc_softening_is_on(s))

brc_status brc_dlsm_screening_forces(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list, int ring)
{
    const brc_dlsm_own *c = brc_dlsm_own_of(s);
    return brc_pass_over(s, c->screening_force, c->screening_force_listed, list, ring, r, NULL);
}

brc_status brc_dlsm_ratio(brc_simulation *s, double *out)
{
    BRC_ENDS_WITH(brc_buffer_free) brc_buffer *ratio = NULL;
    *out = 0;
    BRC_TRY(brc_new_coeff(s, &ratio, s->layout->n_rows, "failure ratios"));
    BRC_TRY(BRC_RUN(brc_dlsm_own_of(s)->ratio, s->n_groups, {"out", BRC_BUF(ratio)}));
    BRC_TRY(brc_brittle_interfaces_ratio(s, ratio));
    return brc_largest_coeff(s, ratio, out);
}

/* Areas and ratios are stored in place of branches. */
brc_status brc_dlsm_branches(brc_simulation *s, brc_buffer **out)
{
    *out = brc_cell_breaks_array(s, "own_branch");
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t slice = layout->slice;
    BRC_LOCAL(s->context, 3 * layout->n_slots * slice, double, rows, "branches");
    for (int64_t k = 0; k < layout->n_slots * slice; ++k) {
        const int32_t h = layout->half_edge[k];
        for (int c = 0; c < 3; ++c)
            rows[(k / slice * 3 + c) * slice + k % slice] =
                h < 0 ? c == 0
                      : d->position[3 * (int64_t)d->neighbour[h] + c] -
                            d->position[3 * (int64_t)d->neighbour[d->twin[h]] + c];
    }
    return brc_upload_coeff(s, *out, rows, 3 * layout->n_slots * slice);
}
