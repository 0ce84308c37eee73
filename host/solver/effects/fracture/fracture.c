/* Bonds that break: limits of the elements, the order of the passes, and what broke (fracture.cl). */
#include "../../core/awake.h"
#include "cell_breaks_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_MEMBERS = 500, MOST_ROWS = 1 << 28 }; /* below SECOND_SHELL in fracture.cl; rows times 8 fit an int */

const char *brc_break_mode_name(int32_t mode)
{
    static const char *const name[] = {"none", "tension", "compression", "shear", "detached"};
    return mode >= BRC_BREAK_TENSION && mode <= BRC_BREAK_DETACHED ? name[mode] : name[0];
}

static brc_criterion_kind criterion(const brc_simulation *s)
{
    return brc_criterion_of(&s->scene->fracture, s->scene->model.kind);
}

/* ---- limits ---- */

/* Slope of the shear limit and its size [Pa] of the solid. */
static double shear_limit(const brc_fracture *f, double *slope)
{
    const double sine = sin(f->friction), cosine = cos(f->friction);
    if (f->kind == BRC_CRITERION_MOHR_COULOMB) {
        *slope = sine;
        return 2 * f->cohesion * cosine;
    }
    if (f->kind == BRC_CRITERION_DRUCKER_PRAGER) { /* through the compressive edges of the Mohr-Coulomb pyramid */
        *slope = 2 * sine / (sqrt(3) * (3 - sine));
        return 6 * f->cohesion * cosine / (sqrt(3) * (3 - sine));
    }
    *slope = 0;
    return 0;
}

/* The stress of a cell is that of the solid. */
static brc_status limits_of_solid(const brc_limit_case *of, double limit[3])
{
    limit[0] = of->material->tension, limit[1] = of->material->compression, limit[2] = of->shear;
    return BRC_OK;
}

static brc_status find_limits(brc_simulation *s)
{
    const brc_domain *d = s->domain;
    const int32_t n_materials = s->scene->n_materials, n_pairs = s->scene->n_bodies * n_materials;
    const double shear = shear_limit(&s->scene->fracture, &s->fracture->slope);
    s->fracture->friction = sin(s->scene->fracture.friction);
    BRC_LOCAL(s->context, 3 * (int64_t)n_pairs, double, pair, "limits of materials");
    BRC_LOCAL(s->context, n_pairs, bool, known, "limits of materials");
    BRC_LOCAL(s->context, s->scene->n_bodies, double, mean, "radii of bodies");
    BRC_LOCAL(s->context, s->scene->n_bodies, int64_t, count, "radii of bodies");
    BRC_TRY(BRC_ALLOCATE(s->context, &s->fracture->limit, 3 * d->n_elements, "limits of elements"));
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int32_t b = d->body[e] < s->scene->n_bodies ? d->body[e] : 0;
        if (d->radius) mean[b] += d->radius[e];
        count[b] += 1;
    }
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int32_t b = d->body[e] < s->scene->n_bodies ? d->body[e] : 0, m = s->material_of_element[e],
                      at = b * n_materials + m;
        if (!known[at]) {
            const brc_limit_case of = {&s->scene->materials[m], b, e, (double)count[b], mean[b], shear};
            BRC_TRY(s->model->limits ? s->model->limits(s, &of, pair + 3 * at) : limits_of_solid(&of, pair + 3 * at));
        }
        known[at] = true;
        memcpy(s->fracture->limit + 3 * e, pair + 3 * at, 3 * sizeof *pair);
    }
    return BRC_OK;
}

/* ---- arrays ---- */

/* Limits, and the volumes in the records. */
static brc_status upload_rows(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, 8 * (int64_t)layout->n_rows, double, record, "virial records");
    BRC_LOCAL(s->context, 3 * (int64_t)layout->n_rows, double, limit, "limits");
    for (int64_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        double *volume = record + (8 * (r / layout->slice) + 6) * layout->slice + r % layout->slice;
        volume[0] = e < 0 ? 1 : brc_fracture_volume(d, e);
        volume[layout->slice] = 1 / volume[0];
        for (int c = 0; e >= 0 && c < 3; ++c)
            limit[3 * r + c] = s->fracture->limit[3 * (int64_t)e + c];
    }
    BRC_TRY(brc_upload_coeff(s, s->fracture->record, record, 8 * (int64_t)layout->n_rows));
    return brc_upload_coeff(s, s->fracture->limits, limit, 3 * (int64_t)layout->n_rows);
}

BRC_WANTED(breaks, w->scene->has_fracture)
/* By a stress of elements: beams always, cells where the criterion asks for it. */
BRC_WANTED(breaks_by_element, breaks(w) && (brc_wants_spheres(w) || w->by_element))
BRC_WANTED(weighted, w->weighted || (w->softens && brc_wants_spheres(w)))
bool brc_wants_joined(const brc_wants *w)
{
    return w->scene->n_interfaces > 0 && brc_wants_spheres(w);
}
BRC_WANTED(joined, brc_wants_joined(w) || (w->scene->n_interfaces > 0 && w->by_element))

#define AT(member) BRC_FIELD_AT(brc_breaking, member)
static const brc_field_row break_rows[] = {
    BRC_PART_KEPT(break_step, brc_each_entry, 1, INT, NULL, "steps of breaks", "-", "fracture.step", BRC_KEEP_BROKEN),
    BRC_PART_KEPT(break_mode, brc_each_entry, 1, INT, NULL, "modes of breaks", "-", "fracture.mode", BRC_KEEP_BROKEN),
    BRC_PART_KEPT(break_stress, brc_each_entry, 1, COEFF, NULL, "stresses of breaks", "Pa", "fracture.stress",
                  BRC_KEEP_BROKEN),
    BRC_PART_KEPT(break_energy, brc_each_entry, 1, COEFF, NULL, "energies of breaks", "J", "fracture.energy",
                  BRC_KEEP_BROKEN),
    BRC_KEPT_FIELD(lost, brc_each_row, 1, STATE, NULL, "energy of broken bonds", "J", "fracture.lost"),
    BRC_KEPT_FIELD(gone, brc_each_row, 1, STATE, brc_wants_cells, "lost bonds", "-", "cells.gone"),
    BRC_KEPT_FIELD(gone, brc_each_row, 1, STATE, brc_wants_lost_beams, "lost beams", "-", "closure.gone"),
    BRC_KEPT_FIELD(broken, brc_each_row, 1, STATE, NULL, "broken bonds", "-", "fracture.broken"),
};
BRC_FIELD_TABLE(brc_break_fields, "broken bonds", BRC_LIFE_RUN, breaks, break_rows);
static const brc_field_row criterion_rows[] = {
    BRC_KEPT_FIELD(record, brc_each_block, 8, COEFF, brc_wants_spheres, "virial records", "J, m^3", "fracture.record"),
    BRC_FIELD(record, brc_each_block, 8, COEFF, brc_wants_cells, "virial records", "J, m^3"),
    BRC_FIELD(stress, brc_each_row, 6, COEFF, NULL, "virial stresses", "Pa"),
    BRC_FIELD(limits, brc_each_row, 3, COEFF, NULL, "limits", "Pa"),
    BRC_FIELD(choice, brc_each_row, 1, INT, NULL, "chosen bonds", "-"),
    BRC_FIELD(measure, brc_each_row, 1, COEFF, NULL, "stresses at failure", "Pa"),
    BRC_FIELD(limit_margin, brc_each_row, 1, COEFF, NULL, "bounds of stress", "-"),
    BRC_FIELD(near_margin, brc_each_row, 1, COEFF, NULL, "bounds of stress", "-"),
    BRC_KEPT_FIELD(weight, brc_each_row, 1, COEFF, brc_wants_spheres, "bounds of stress", "m^3", "fracture.weight"),
    BRC_KEPT_FIELD(weight, brc_each_row, 1, COEFF, brc_wants_cells, "bounds of stress", "m^3", "cells.weight"),
    BRC_KEPT_FIELD(stress_bound, brc_each_row, 1, COEFF, brc_wants_spheres, "bounds of stress", "m^3",
                   "fracture.reach"),
    BRC_FIELD(stress_bound, brc_each_row, 1, COEFF, brc_wants_cells, "bounds of stress", "m^3"),
    BRC_FIELD(near, brc_each_group, 1, INT, NULL, "groups near failure", "-"),
    BRC_FIELD(mark, brc_each_group, 1, INT, NULL, "groups that lose bonds", "-"),
    BRC_FIELD(factor, brc_each_entry, 1, COEFF, weighted, "factors of bonds", "-"),
    BRC_FIELD(weakest, brc_each_row, 1, COEFF, weighted, "factors of bonds", "-"),
    BRC_FIELD(plane, brc_each_entry, 3, COEFF, joined, "normals of interfaces", "-"),
};
BRC_FIELD_TABLE(brc_criterion_fields, "criteria of elements", BRC_LIFE_RUN, breaks_by_element, criterion_rows);

brc_scope brc_scope_of_breaks(const brc_simulation *s, const brc_scope *outer)
{
    return (brc_scope){.owner = "broken bonds", .base = s->fracture, .tables = {&brc_break_fields}, .outer = outer};
}

brc_scope brc_scope_of_criterion(const brc_simulation *s, const brc_scope *outer)
{
    static const brc_value_row values[] = {
        {"inv_tension", BRC_VALUE_REAL, AT(scale[0])}, {"inv_compression", BRC_VALUE_REAL, AT(scale[1])},
        {"inv_shear", BRC_VALUE_REAL, AT(scale[2])},   {"slope", BRC_VALUE_REAL, AT(slope)},
        {"friction", BRC_VALUE_REAL, AT(friction)},    {"drucker_prager", BRC_VALUE_BOOL, AT(drucker_prager)},
        {"weighted", BRC_VALUE_BOOL, AT(weighted)},    {"screened", BRC_VALUE_BOOL, AT(screened)},
        {"joined", BRC_VALUE_INT, AT(joined)},         {"turned", BRC_VALUE_BUFFER, AT(turned)},
        {"branch", BRC_VALUE_BUFFER, AT(branch)}};
    return (brc_scope){.owner = "criterion",
                       .base = s->fracture,
                       .tables = {&brc_criterion_fields},
                       BRC_VALUES(values),
                       .outer = outer};
}

static brc_status make_passes(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    const brc_scope run = brc_scope_of_run(s), breaks = brc_scope_of_breaks(s, &run),
                    criterion = brc_scope_of_criterion(s, &breaks);
    const brc_pass_wanted of_state[] = {BRC_PASS(&f->stress_pass, "fracture_stress", "level"),
                                        BRC_PASS(&f->stress_second, "fracture_stress_second", NULL),
                                        BRC_PASS(&f->near_pass, "fracture_near", "step"),
                                        BRC_PASS(&f->check, "fracture_check", "level step"),
                                        BRC_PASS(&f->choose, "fracture_choose", "step"),
                                        BRC_PASS(&f->ratio, "fracture_ratio", "ratio")};
    return BRC_PASSES_MAKE(s, &criterion, of_state);
}

/* Elements within two shells of one: no more than degrees allow. */
static int64_t most_members(const brc_domain *d)
{
    int64_t most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        int64_t sum = 1 + d->row_start[e + 1] - d->row_start[e];
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            sum += d->row_start[d->neighbour[h] + 1] - d->row_start[d->neighbour[h]] - 1;
        if (sum > most) most = sum;
    }
    return most;
}

brc_status brc_fracture_create_elements(brc_simulation *s, brc_buffer *branch)
{
    brc_breaking *f = s->fracture;
    if (s->layout->n_rows >= MOST_ROWS)
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "fracture: %d elements are more than the %d that can break",
                        (int)s->layout->n_rows, MOST_ROWS);
    if (s->scene->fracture.level == 2 && most_members(s->domain) > MOST_MEMBERS)
        return BRC_FAIL(
            s->context, BRC_BAD_INPUT,
            "fracture: some element may have %lld others within two shells, level 2 counts up to %d; use level 1%s",
            (long long)most_members(s->domain), MOST_MEMBERS,
            brc_has_spheres(s) ? " or a lower coordination number" : "");
    f->branch = branch;
    f->drucker_prager = criterion(s) == BRC_CRITERION_DRUCKER_PRAGER;
    BRC_TRY(make_passes(s));
    BRC_TRY(find_limits(s));
    BRC_TRY(brc_fields_create(s->device, &brc_criterion_fields, &s->wants, f));
    BRC_TRY(brc_fracture_bound(s));
    return upload_rows(s);
}

/* One line of the materials that bear anything. */
static void tell_unbreakable(brc_simulation *s)
{
    const brc_scene *scene = s->scene;
    char names[256] = "";
    for (int32_t m = 0; m < scene->n_materials; ++m) {
        bool used = false;
        for (int32_t b = 0; b < scene->n_bodies; ++b)
            used = used || brc_body_uses(&scene->bodies[b], m);
        const size_t at = strlen(names);
        if (used && !brc_material_breaks(scene, scene->model.kind, &scene->materials[m]))
            snprintf(names + at, sizeof names - at, "%s'%s'", at ? ", " : "", scene->materials[m].name);
    }
    if (names[0])
        brc_log(s->context, BRC_LOG_INFO,
                "fracture: no strength%s is given for %s, which does not break; its bonds with others break by theirs",
                brc_scene_breaks_by_bond(s->scene, s->scene->model.kind) ? " in tension" : "", names);
}

brc_status brc_fracture_create(brc_simulation *s)
{
    tell_unbreakable(s);
    BRC_TRY(BRC_ALLOCATE(s->context, &s->fracture, 1, "fracture"));
    BRC_TRY(brc_fields_create(s->device, &brc_break_fields, &s->wants, s->fracture));
    return s->model->create_fracture(s);
}

void brc_fracture_free(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    if (!f) return;
    brc_fields_free(&brc_criterion_fields, f);
    brc_fields_free(&brc_break_fields, f);
    brc_memory_free(f->limit);
    brc_memory_free(f->spans);
    brc_memory_free(f->load);
    brc_memory_free(f->events);
    brc_memory_free(f);
    s->fracture = NULL;
}

/* ---- the step ---- */

static brc_status find_stress(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    const int32_t n = s->layout->n_rows, level = s->scene->fracture.level;
    if (level == 2) return brc_pass_run(f->stress_second, n);
    return BRC_RUN(f->stress_pass, s->n_groups, {"level", BRC_INT(level)});
}

brc_status brc_fracture_choose(brc_simulation *s, int32_t moment)
{
    brc_breaking *f = s->fracture;
    const int32_t n = s->layout->n_rows, level = s->scene->fracture.level;
    if (f->screened) BRC_TRY(BRC_RUN(f->near_pass, s->n_groups, {"step", BRC_INT(moment)}));
    if (level < 2)
        return brc_pass_look_awake(s, f->check, BRC_GIVEN({"level", BRC_INT(level)}, {"step", BRC_INT(moment)}));
    BRC_TRY(find_stress(s));
    return BRC_RUN(f->choose, n, {"step", BRC_INT(moment)});
}

brc_status brc_fracture_step(brc_simulation *s, double half_kick)
{
    return s->model->break_bonds(s, half_kick);
}

int brc_fracture_step_passes(const brc_simulation *s, brc_step_pass *out)
{
    static const char of_failing[] = "branch displacement limits factor weakest record measure mark",
                      of_nobody_near[] = "neighbour branch displacement limits factor weakest record measure mark",
                      of_choosing[] = "row_start neighbour branch displacement factor measure mark",
                      of_marked[] = "row_start neighbour stress mark measure touched";
    const brc_breaking *f = s->fracture;
    const brc_cell_breaks *c = f ? f->cells : NULL;
    int n = 0;
    if (!f || (c && !c->by_element)) return 0;
    if (c) out[n++] = (brc_step_pass){c->record, NULL};
    if (s->scene->fracture.level == 2) {
        out[n++] = (brc_step_pass){f->stress_second, NULL};
        out[n++] = (brc_step_pass){f->choose, of_choosing};
    } else {
        out[n++] = (brc_step_pass){f->check, s->scene->fracture.level == 1 ? of_failing : of_nobody_near};
    }
    if (c) out[n++] = (brc_step_pass){c->mark_chosen, of_marked};
    return n;
}

brc_status brc_fracture_lost(brc_simulation *s, double *out)
{
    *out = 0;
    return s->fracture ? brc_vector_sum(s, s->fracture->lost, s->layout->n_rows, out) : BRC_OK;
}

brc_status brc_fracture_ratio(brc_simulation *s, double *out)
{
    const int32_t n = s->layout->n_rows;
    BRC_ENDS_WITH(brc_buffer_free) brc_buffer *ratio = NULL;
    *out = 0;
    BRC_TRY(brc_new_coeff(s, &ratio, n, "failure ratios"));
    BRC_TRY(find_stress(s));
    BRC_TRY(BRC_RUN(s->fracture->ratio, n, {"ratio", BRC_BUF(ratio)}));
    return brc_largest_coeff(s, ratio, out);
}

BRC_READ(const double *, brc_fracture_limits, s->fracture->limit)

brc_status brc_fracture_judged(brc_simulation *s, double *stress, double *record)
{
    const brc_layout *layout = s->layout;
    const int bytes = brc_coeff_bytes(s);
    BRC_TRY(brc_coeff_from_rows(s, s->fracture->stress, stress, 6));
    BRC_LOCAL(s->context, 8 * (int64_t)layout->n_rows, double, rows, "virial records");
    const brc_status status = brc_download(s, s->fracture->record, bytes, rows, 8 * (int64_t)layout->n_rows);
    for (int64_t k = 0; status == BRC_OK && k < 8 * s->domain->n_elements; ++k) {
        const int64_t r = layout->row_of_element[k / 8];
        record[k] = rows[(8 * (r / layout->slice) + k % 8) * layout->slice + r % layout->slice];
    }
    return status;
}

double brc_simulation_element_strength(const brc_simulation *s, int64_t e)
{
    return s->fracture && s->fracture->limit ? s->fracture->limit[3 * e] : 0;
}

brc_buffer *brc_fracture_lost_bonds(const brc_simulation *s)
{
    if (!s->fracture) return NULL;
    return s->fracture->gone ? s->fracture->gone : s->fracture->broken;
}

BRC_READ(brc_buffer *, brc_fracture_factors, s->fracture->factor)
BRC_READ(double, brc_simulation_implied_fracture_energy, s->fracture ? s->fracture->implied_energy : 0)
