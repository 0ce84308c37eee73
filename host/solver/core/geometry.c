/* Device arrays that depend on the domain and the materials alone: connectivity, face geometry, least squares,
 * masses. */
#include "../../../preprocess/domain/domain_rows.h"
#include "../../base/ranks.h"
#include "../../device/shares.h"
#include "core_internal.h"
#include "sym3.h"
#include <math.h>
#include <string.h>

/* A direction in which the neighbours of an element span less than this part of the widest is left out of its least
 * squares. Far below what a boundary cell of an unrelaxed grid shows (0.07/0.57), far above
 * rounding: only flat or lone elements meet it. */
static const double span_threshold = 1e-6;
/* The same where coefficients are single: rounding of the gradient in the weakest direction is amplified by the ratio
 * of the spans, and what it leaves of a turned element's strain heats the body. An element of ratio 5e-4 doubled its
 * energy in 1e5 steps (docs/notebook/stability.md). */
static const double single_span_threshold = 1e-2;

static void branch_of(const brc_domain *d, int64_t h, int32_t i, double branch[3])
{
    const int64_t j = d->neighbour[h];
    for (int c = 0; c < 3; ++c)
        branch[c] = d->position[3 * j + c] - d->position[3 * (int64_t)i + c];
}

static void half_edge_geometry(const brc_domain *d, int64_t h, int32_t i, double branch[3], double area[3],
                               double offset[3], double *ratio)
{
    const int64_t j = d->neighbour[h];
    double length = 0, surface = 0;
    branch_of(d, h, i, branch);
    for (int c = 0; c < 3; ++c) {
        area[c] = d->area_vector[3 * h + c];
        offset[c] = d->face_centroid[3 * h + c] - 0.5 * (d->position[3 * (int64_t)i + c] + d->position[3 * j + c]);
        length += branch[c] * branch[c];
        surface += area[c] * area[c];
    }
    *ratio = sqrt(length / surface);
}

brc_status brc_geometry_rows(brc_simulation *s, brc_buffer *buffer, int width, brc_bond_values values,
                             const double missing[3])
{
    const brc_layout *layout = s->layout;
    const int slice = layout->slice;
    const uint8_t *const here = brc_buffer_slices_here(buffer);
    BRC_LOCAL(s->context, layout->n_slots * slice * width, double, rows, "neighbour rows");
#pragma omp parallel for schedule(static)
    for (int32_t block = 0; block < layout->n_slices; ++block)
        for (int32_t slot = layout->slot_start[block]; (!here || here[block]) && slot < layout->slot_start[block + 1];
             ++slot)
            for (int l = 0; l < slice; ++l) {
                const int32_t h = layout->half_edge[(int64_t)slot * slice + l];
                double value[3];
                memcpy(value, missing, sizeof value);
                if (h >= 0) values(s, layout->element_of_row[block * slice + l], h, value);
                for (int c = 0; c < width; ++c)
                    rows[((int64_t)slot * width + c) * slice + l] = value[c];
            }
    return brc_upload_coeff(s, buffer, rows, layout->n_slots * slice * width);
}

static void branch_values(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    branch_of(s->domain, h, (int32_t)e, out);
}

brc_status brc_geometry_branches(brc_simulation *s, brc_buffer *buffer)
{
    static const double missing[3] = {1, 0, 0};
    return brc_geometry_rows(s, buffer, 3, branch_values, missing);
}

static brc_status upload_connectivity(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    const int slice = layout->slice;
    BRC_TRY(brc_upload_int(s->core->row_start, layout->slot_start, layout->n_slices + 1));
    BRC_TRY(brc_upload_int(s->core->boundary, layout->boundary, layout->n_slices));
    BRC_TRY(brc_upload_int(s->core->asked_ahead, layout->ahead, layout->n_rows));
    const uint8_t *const here = brc_buffer_slices_here(s->core->neighbour);
    BRC_LOCAL(s->context, layout->n_slots * slice, int32_t, rows, "neighbours");
    for (int32_t block = 0; block < layout->n_slices; ++block)
        for (int32_t slot = layout->slot_start[block]; (!here || here[block]) && slot < layout->slot_start[block + 1];
             ++slot)
            for (int l = 0; l < slice; ++l) {
                const int32_t h = layout->half_edge[(int64_t)slot * slice + l];
                rows[(int64_t)slot * slice + l] =
                    h < 0 ? block * slice + l : layout->row_of_element[s->domain->neighbour[h]];
            }
    return brc_upload_int(s->core->neighbour, rows, layout->n_slots * slice);
}

/* Least-squares matrix of an element: sum w R (x) R, w 1 or S/L. */
static void shape_matrix(const brc_simulation *s, int64_t e, bool weighted, double out[6])
{
    const brc_domain *d = s->domain;
    memset(out, 0, 6 * sizeof *out);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        double r[3], area[3], offset[3], ratio;
        half_edge_geometry(d, h, (int32_t)e, r, area, offset, &ratio);
        const double w = weighted ? 1 / ratio : 1;
        out[0] += w * r[0] * r[0];
        out[1] += w * r[1] * r[1];
        out[2] += w * r[2] * r[2];
        out[3] += w * r[1] * r[2];
        out[4] += w * r[0] * r[2];
        out[5] += w * r[0] * r[1];
    }
}

double brc_geometry_least_span(const brc_simulation *s)
{
    return brc_device_get_precision(s->device) == BRC_DOUBLE ? span_threshold : single_span_threshold;
}

brc_status brc_geometry_shapes(brc_simulation *s, bool weighted, brc_shape_refinement refine)
{
    const brc_layout *layout = s->layout;
    const int slice = layout->slice;
    const double least_span = brc_geometry_least_span(s);
    BRC_LOCAL(s->context, (int64_t)layout->n_rows * 6, double, blocks, "least-squares matrices");
    int64_t flat = 0;
#pragma omp parallel for schedule(static) reduction(+ : flat)
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        if (e < 0 || !brc_domain_has(s->domain, e)) continue;
        double a[6], inverse[6];
        shape_matrix(s, e, weighted, a);
        const int spanned = brc_sym3_pseudo_inverse(a, least_span, inverse);
        flat += spanned < 3 && brc_domain_mine(s->domain, e);
        if (spanned == 3 && refine) refine(s, e, inverse);
        for (int c = 0; c < 6; ++c)
            blocks[((int64_t)(r / slice) * 6 + c) * slice + r % slice] = inverse[c];
    }
    if (s->domain->here) BRC_TRY(brc_ranks_reduce(s->context, BRC_SUM, 1, &flat));
    if (flat)
        brc_log(
            s->context, BRC_LOG_WARNING,
            "%lld of %lld elements have neighbours that do not span space; their gradient is taken over the directions "
            "they do span",
            (long long)flat, (long long)s->domain->n_elements);
    return brc_upload_coeff(s, s->core->inv_shape, blocks, (int64_t)layout->n_rows * 6);
}

static brc_status upload_masses(brc_simulation *s)
{
    const brc_domain *d = s->domain;
    const brc_layout *layout = s->layout;
    BRC_LOCAL(s->context, layout->n_rows > d->n_elements ? layout->n_rows : d->n_elements, double, values, "masses");
    for (int64_t e = 0; e < d->n_elements; ++e)
        values[e] = brc_mass_of_element(s, e);
    BRC_TRY(brc_state_to_rows(s, s->core->mass, values, 1, 1));
    if (s->core->volume) BRC_TRY(brc_state_to_rows(s, s->core->volume, d->volume, 1, 1));
    if (s->core->inertia) {
        /* mean of the principal moments: the trace of the inertia tensor over 3 */
        for (int64_t e = 0; e < d->n_elements; ++e)
            if (brc_domain_mine(d, e))
                values[e] = s->elastic[s->material_of_element[e]].density *
                            (d->inertia[6 * e] + d->inertia[6 * e + 1] + d->inertia[6 * e + 2]) / 3;
        if (d->here) BRC_TRY(brc_domain_elements(s->context, d, 1, values));
        BRC_TRY(brc_state_to_rows(s, s->core->inertia, values, 1, 1));
    }
    if (s->core->inv_volume) {
        for (int32_t r = 0; r < layout->n_rows; ++r)
            values[r] = layout->element_of_row[r] < 0 ? 1 : 1 / d->volume[layout->element_of_row[r]];
        BRC_TRY(brc_upload_coeff(s, s->core->inv_volume, values, layout->n_rows));
    }
    return BRC_OK;
}

brc_status brc_geometry_materials(brc_simulation *s)
{
    if (!brc_device_has_many_materials(s->device)) return BRC_OK;
    const brc_layout *layout = s->layout;
    const int slice = layout->slice;
    BRC_LOCAL(s->context, (int64_t)layout->n_rows * 4, double, blocks, "materials of elements");
    BRC_LOCAL(s->context, layout->n_rows, double, modulus, "materials of elements");
    BRC_LOCAL(s->context, layout->n_rows, double, ell, "materials of elements");
    BRC_LOCAL(s->context, (int64_t)layout->n_rows * 3, double, lame, "materials of elements");
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        const brc_elastic *m = s->elastic + (e < 0 ? 0 : s->material_of_element[e]);
        const double four[4] = {m->lambda, m->mu, m->k, m->ell};
        for (int c = 0; c < 4; ++c)
            blocks[((int64_t)(r / slice) * 4 + c) * slice + r % slice] = four[c];
        modulus[r] = m->k;
        ell[r] = m->ell;
        lame[3 * (int64_t)r] = m->lambda;
        lame[3 * (int64_t)r + 1] = m->mu;
        lame[3 * (int64_t)r + 2] = m->young;
    }
    if (s->core->lame_of) {
        BRC_TRY(brc_upload_coeff(s, s->core->lame_of, lame, (int64_t)layout->n_rows * 3));
    } else {
        BRC_TRY(brc_upload_coeff(s, s->core->material, blocks, (int64_t)layout->n_rows * 4));
        BRC_TRY(brc_upload_coeff(s, s->core->modulus, modulus, layout->n_rows));
        BRC_TRY(brc_upload_coeff(s, s->core->ell_of, ell, layout->n_rows));
    }
    return BRC_OK;
}

BRC_WANTED(many_dlsm, w->many_materials &&brc_wants_deforming(w))
BRC_WANTED(many_published, w->many_materials &&brc_wants_rigid_cells(w))
BRC_WANTED(many_beams, w->many_materials &&brc_wants_spheres(w))

#define AT(member) BRC_FIELD_AT(struct brc_core, member)
static const brc_field_row rows[] = {
    BRC_FIELD(row_start, brc_each_slice_end, 1, INT, NULL, "slice starts", "-"),
    BRC_FIELD(neighbour, brc_each_entry, 1, INT, NULL, "neighbours", "-"),
    {"ahead", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(asked_ahead), "rows asked for ahead", "-", BRC_NOT_KEPT},
    BRC_FIELD(boundary, brc_each_slice, 1, INT, NULL, "boundary blocks", "-"),
    BRC_FIELD(mass, brc_each_row, 1, STATE, NULL, "masses", "kg"),
    BRC_FIELD(volume, brc_each_row, 1, STATE, brc_wants_rigid_cells, "volumes", "m^3"),
    BRC_FIELD(inertia, brc_each_row, 1, STATE, brc_wants_turning, "moments of inertia", "kg m^2"),
    BRC_FIELD(inv_volume, brc_each_row, 1, COEFF, brc_wants_deforming, "inverse volumes", "1/m^3"),
    BRC_PART_KEPT(inv_shape, brc_each_block, 6, COEFF, brc_wants_cells, "least-squares matrices", "1/m^3",
                  "cells.inverse_shape", BRC_KEEP_OWNERS),
    BRC_PART_KEPT(area, brc_each_entry, 3, COEFF, brc_wants_deforming, "area vectors", "m^2", "cells.area",
                  BRC_KEEP_BROKEN),
    BRC_FIELD(offset, brc_each_entry, 3, COEFF, brc_wants_deforming, "face offsets", "m"),
    BRC_PART_KEPT(ratio, brc_each_entry, 1, COEFF, brc_wants_deforming, "length over area", "1/m", "cells.ratio",
                  BRC_KEEP_BROKEN),
    {"branch", brc_each_entry, 3, BRC_FIELD_COEFF, brc_wants_turning, AT(offset), "branches", "m", BRC_NOT_KEPT},
    BRC_PART_KEPT(area, brc_each_entry, 1, COEFF, brc_wants_rigid_cells, "face areas", "m^2", "cells.area",
                  BRC_KEEP_BROKEN),
    {"inv_length", brc_each_entry, 1, BRC_FIELD_COEFF, brc_wants_spheres, AT(ratio), "inverse lengths", "1/m",
     BRC_KEPT("fracture.inverse_length", BRC_KEEP_BROKEN)},
    BRC_FIELD(material, brc_each_block, 4, COEFF, many_dlsm, "materials of elements", "Pa, -"),
    BRC_FIELD(modulus, brc_each_row, 1, COEFF, many_dlsm, "stabilisation moduli", "Pa"),
    BRC_FIELD(ell_of, brc_each_row, 1, COEFF, many_dlsm, "compaction ratios", "-"),
    BRC_FIELD(lame_of, brc_each_row, 3, COEFF, many_published, "materials of elements", "Pa"),
    BRC_FIELD(beam_of, brc_each_row, 3, COEFF, many_beams, "beams of elements", "N, N m^2"),
};
BRC_FIELD_TABLE(brc_geometry_fields, "geometry", BRC_LIFE_RUN, NULL, rows);

brc_status brc_geometry_create(brc_simulation *s)
{
    BRC_TRY(brc_fields_create(s->device, &brc_geometry_fields, &s->wants, s->core));
    BRC_TRY(upload_connectivity(s));
    BRC_TRY(upload_masses(s));
    return s->model->upload(s);
}

void brc_geometry_free(brc_simulation *s)
{
    if (s->core) brc_fields_free(&brc_geometry_fields, s->core);
}

brc_status brc_geometry_store(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds,
                              const brc_chosen *elements)
{
    return brc_store_fields(
        s, store,
        &(brc_kept_fields){.table = &brc_geometry_fields, .owner = s->core, .bonds = bonds, .elements = elements});
}

static const double no_block[6] = {1, 1, 1, 0, 0, 0};

/* Inverse of what holds an element at its place while its neighbours stay. */
static void block_of(const brc_simulation *s, int64_t e, double block[6])
{
    const brc_domain *d = s->domain;
    const brc_elastic *m = s->elastic + s->material_of_element[e];
    const double along = m->lambda + m->mu > 0 ? m->lambda + m->mu : 0;
    double sum[6] = {0};
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        double branch[3], area[3], offset[3], ratio;
        half_edge_geometry(d, h, (int32_t)e, branch, area, offset, &ratio);
        double n[3];
        const double surface = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
        for (int c = 0; c < 3; ++c)
            n[c] = area[c] / surface;
        sum[0] += (m->mu + along * n[0] * n[0]) / ratio;
        sum[1] += (m->mu + along * n[1] * n[1]) / ratio;
        sum[2] += (m->mu + along * n[2] * n[2]) / ratio;
        sum[3] += along * n[1] * n[2] / ratio;
        sum[4] += along * n[0] * n[2] / ratio;
        sum[5] += along * n[0] * n[1] / ratio;
    }
    memcpy(block, no_block, sizeof no_block);
    if (d->row_start[e + 1] > d->row_start[e]) brc_sym3_pseudo_inverse(sum, 1e-12, block);
}

brc_status brc_geometry_precondition_blocks(brc_simulation *s, double *out)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, 6 * d->n_elements, double, blocks, "preconditioner");
#pragma omp parallel for schedule(static)
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (brc_domain_mine(d, e)) block_of(s, e, blocks + 6 * e);
    if (d->here) BRC_TRY(brc_domain_elements(s->context, d, 6, blocks));
    for (int64_t r = 0; r < layout->n_rows; ++r) {
        const int64_t e = layout->element_of_row[r];
        memcpy(out + 6 * r, e < 0 ? no_block : blocks + 6 * e, sizeof no_block);
    }
    return BRC_OK;
}
