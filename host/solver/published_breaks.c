/* Bonds of dlsm-published that break by their normal stress (AGH19 section 5.3, eq. 35-36): passes of kernels/published_breaks.cl. */
#include "ahead.h"
#include "cell_breaks_internal.h"
#include "sym3.h"
#include <math.h>

/* An element whose bonds span less than this share of what they spanned in its weakest direction in the whole body has no strain any more, as one of
 * fewer than three contacts (AGH19 section 2.2): its strain would answer its neighbours more stiffly than the time step bears. */
static const double support_share = 0.2, span_least = 1e-6;

/* Of the whole body: the least eigenvalue that A = sum w R (x) R must keep, and the projector on the directions spanned (geometry.c). */
static double support_of(const brc_simulation *s, int64_t e, double projector[6])
{
    static const int of_component[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const brc_domain *d = s->domain;
    double a[6] = {0}, value[3], axis[3][3];
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const int64_t j = d->neighbour[h];
        double r[3], length = 0, surface = 0;
        for (int c = 0; c < 3; ++c) {
            r[c] = d->position[3 * j + c] - d->position[3 * e + c];
            length += r[c] * r[c];
            surface += d->area_vector[3 * h + c] * d->area_vector[3 * h + c];
        }
        const double w = s->scene->model.area_weights ? sqrt(surface / length) : 1;
        const double six[6] = {r[0] * r[0], r[1] * r[1], r[2] * r[2], r[1] * r[2], r[0] * r[2], r[0] * r[1]};
        for (int c = 0; c < 6; ++c) a[c] += w * six[c];
    }
    brc_sym3_eigen(a, value, axis);
    for (int k = 0; k < 3; ++k)
        for (int c = 0; value[k] > span_least * value[2] && c < 6; ++c) projector[c] += axis[k][of_component[c][0]] * axis[k][of_component[c][1]];
    return fmax(support_share * value[0], span_least * value[2]);
}

brc_status brc_published_breaks_create(brc_simulation *s)
{
    brc_cell_breaks *c = s->fracture->cells;
    const brc_layout *layout = s->layout;
    double *support = NULL, *spanned = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_kernel_find(s->device, "published_rebuild", &c->rebuild));
    BRC_TRY(brc_kernel_find(s->device, "published_breaking_strain", &c->breaking_strain));
    BRC_TRY(brc_kernel_find(s->device, "published_breaking_strain_listed", &c->breaking_strain_listed));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &support, layout->n_rows, "supports"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &spanned, 6 * (int64_t)layout->n_rows, "supports"));
#pragma omp parallel for schedule(static)
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        double projector[6] = {0};
        if (layout->element_of_row[r] >= 0) support[r] = support_of(s, layout->element_of_row[r], projector);
        for (int k = 0; k < 6; ++k) spanned[(int64_t)(r / layout->slice * 6 + k) * layout->slice + r % layout->slice] = projector[k];
    }
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, c->spanned, spanned, 6 * (int64_t)layout->n_rows));
    BRC_TRY_OR(cleanup, brc_upload_coeff(s, c->support, support, layout->n_rows));
    if (c->by_element) goto cleanup;
    BRC_TRY_OR(cleanup, brc_kernel_find(s->device, "published_breaking_force", &c->breaking_force));
    BRC_TRY_OR(cleanup, brc_kernel_find(s->device, "published_breaking_force_listed", &c->breaking_force_listed));
    BRC_TRY_OR(cleanup, brc_kernel_find(s->device, "published_check", &c->check));
cleanup:
    brc_memory_free(support);
    brc_memory_free(spanned);
    return status;
}

brc_status brc_published_breaks_strains(brc_simulation *s, const brc_force_request *r)
{
    const brc_cell_breaks *c = s->fracture->cells;
    return BRC_PASS(s, c->breaking_strain, c->breaking_strain_listed, r->rings ? &r->rings->around : NULL, 0, BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                      BRC_BUF(s->offset), BRC_BUF(s->area), BRC_INT(s->scene->model.area_weights ? 1 : 0), BRC_BUF(r->displacement), BRC_BUF(r->orientation),
                      BRC_BUF(s->inv_shape), BRC_BUF(c->spanned), BRC_INT(r->finite ? 1 : 0), BRC_BUF(s->gradient));
}

brc_status brc_published_breaks_force(brc_simulation *s, const brc_force_request *r)
{
    const brc_cell_breaks *c = s->fracture->cells;
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    const brc_ring_list *list = r->rings && !r->rings->whole_force ? &r->rings->around : NULL;
    return BRC_PASS(s, c->breaking_force, c->breaking_force_listed, list, 2, BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->offset),
                      BRC_BUF(s->area), BRC_BUF(r->displacement), BRC_BUF(r->orientation), BRC_BUF(s->gradient), BRC_COEFF(m->lambda),
                      BRC_COEFF(m->mu), BRC_COEFF(m->young), BRC_COEFF(s->scene->model.rotation_stiffness), BRC_COEFF(s->scene->model.couple_modulus), BRC_BUF(s->lame_of),
                      BRC_BUF(c->limit), BRC_BUF(r->force), BRC_BUF(r->torque), BRC_BUF(c->reach));
}

brc_status brc_published_breaks_mark(brc_simulation *s, double share, double *n)
{
    const brc_cell_breaks *c = s->fracture->cells;
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    BRC_TRY(BRC_LAUNCH(c->check, s->n_groups, BRC_INT(s->n_groups), BRC_COEFF(share), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                       BRC_BUF(s->offset), BRC_BUF(s->area), BRC_BUF(s->displacement), BRC_BUF(s->orientation), BRC_BUF(s->gradient),
                       BRC_COEFF(m->lambda), BRC_COEFF(m->mu), BRC_COEFF(m->young), BRC_COEFF(s->scene->model.rotation_stiffness), BRC_COEFF(s->scene->model.couple_modulus),
                       BRC_BUF(s->lame_of), BRC_BUF(c->limit), BRC_BUF(c->reach), BRC_BUF(c->mark), BRC_BUF(c->measure), BRC_BUF(c->rings->touched),
                       BRC_BUF(c->found)));
    return brc_ahead_count(s, c->found, s->n_groups, n);
}

brc_status brc_published_breaks_rebuild(brc_simulation *s)
{
    const brc_cell_breaks *c = s->fracture->cells;
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(c->rebuild, n, BRC_INT(n), BRC_INT(s->scene->model.area_weights ? 1 : 0), BRC_BUF(s->row_start), BRC_BUF(s->offset),
                      BRC_BUF(s->area), BRC_BUF(c->alive), BRC_BUF(c->support), BRC_BUF(c->changed), BRC_BUF(s->inv_shape),
                      BRC_BUF(c->spanned), BRC_BUF(c->mark));
}

brc_status brc_published_breaks_ratio(brc_simulation *s, double *out)
{
    double *value = NULL;
    *out = 0;
    BRC_TRY(BRC_ALLOCATE(s->context, &value, s->domain->n_elements, "failure ratios"));
    const brc_status status = brc_coeff_from_rows(s, s->fracture->cells->reach, value, 1);
    for (int64_t e = 0; status == BRC_OK && e < s->domain->n_elements; ++e) *out = fmax(*out, value[e]);
    brc_memory_free(value);
    return status;
}
