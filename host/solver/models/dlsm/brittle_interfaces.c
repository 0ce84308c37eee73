#include "brittle_interfaces.h"
#include "../../core/awake.h"
#include "../../effects/fracture/breaking.h"
#include "../../effects/fracture/strengths.h"
#include "dlsm_internal.h"
#include <math.h>

static const double never = 1e30; /* CELLS_NEVER of cells.cl */

struct brc_brittle_interfaces {
    brc_pass *check, *ratio;
    brc_buffer *along, *across; /* [n_slots][3][C] */
    brc_buffer *nearest;        /* [n_rows] */
};
typedef struct brc_brittle_interfaces brittle_interfaces;

BRC_WANTED(joined, w->scene->n_interfaces > 0 && brc_wants_deforming(w) && w->scene->has_fracture && !w->softens)

#define AT(member) BRC_FIELD_AT(brittle_interfaces, member)
static const brc_field_row rows[] = {
    BRC_FIELD(along, brc_each_entry, 3, COEFF, NULL, "normals of interfaces", "-"),
    BRC_FIELD(across, brc_each_entry, 3, COEFF, NULL, "branches of interfaces", "m"),
    BRC_FIELD(nearest, brc_each_row, 1, COEFF, NULL, "limits of interfaces", "Pa"),
};
BRC_FIELD_TABLE(brc_brittle_interface_fields, "interfaces that break at once", BRC_LIFE_RUN, joined, rows);

/* Of faces that are weaker than their solids; others are judged by their own normal, as these. */
static brc_status upload(brc_simulation *s, const brittle_interfaces *f)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t slice = layout->slice, n_entries = layout->n_slots * slice;
    BRC_ENDS_WITH(brc_strengths_free) brc_strengths strengths = {0};
    BRC_TRY(brc_strengths_create(s->context, s->scene, d, s->material_of_element, &strengths));
    BRC_LOCAL(s->context, 3 * n_entries, double, along, "normals of interfaces");
    BRC_LOCAL(s->context, 3 * n_entries, double, across, "branches of interfaces");
    BRC_LOCAL(s->context, layout->n_rows, double, nearest, "limits of interfaces");
    BRC_LOCAL(s->context, d->n_bonds, uint8_t, lies, "normals of interfaces");
    for (int64_t b = 0; b < d->n_bonds; ++b)
        lies[b] = strengths.factor[b] < 1 && strengths.tension[b] > 0;
    BRC_TRY(brc_fracture_planes(s, lies, along));
    for (int32_t r = 0; r < layout->n_rows; ++r)
        nearest[r] = never;
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        if (h < 0 || !lies[d->bond[h]]) continue;
        const int32_t e = d->neighbour[d->twin[h]];
        double size = 0;
        for (int c = 0; c < 3; ++c) {
            const int64_t at = (k / slice * 3 + c) * slice + k % slice;
            across[at] = d->position[3 * (int64_t)d->neighbour[h] + c] - d->position[3 * (int64_t)e + c];
            size += fabs(along[at]);
        }
        double *own = &nearest[layout->row_of_element[e]];
        if (size > 0) *own = fmin(*own, strengths.tension[d->bond[h]]);
    }
    BRC_TRY(brc_upload_coeff(s, f->along, along, 3 * n_entries));
    BRC_TRY(brc_upload_coeff(s, f->across, across, 3 * n_entries));
    return brc_upload_coeff(s, f->nearest, nearest, layout->n_rows);
}

brc_status brc_brittle_interfaces_create(brc_simulation *s)
{
    if (!joined(&s->wants)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_dlsm_own_of(s)->interfaces, 1, "interfaces"));
    brittle_interfaces *f = brc_dlsm_own_of(s)->interfaces;
    BRC_TRY(brc_fields_create(s->device, &brc_brittle_interface_fields, &s->wants, f));
    brc_dlsm_own_of(s)->joined = 1;
    brc_dlsm_own_of(s)->along = f->along;
    const brc_scope run = brc_scope_of_run(s);
    brc_cell_scopes of_state;
    const brc_scope faces = {.owner = "interfaces that break at once",
                             .base = f,
                             .tables = {&brc_brittle_interface_fields},
                             .outer = brc_cell_scopes_make(s, &run, &of_state)};
    BRC_TRY(BRC_PASSES(s, &faces, BRC_PASS(&f->check, "interface_check", "share by_element"),
                       BRC_PASS(&f->ratio, "interface_ratio", "out")));
    return upload(s, f);
}

brc_scope brc_scope_of_brittle_interfaces(const brc_simulation *s, const brc_scope *outer)
{
    static const brc_value_row values[] = {{"joined", BRC_VALUE_INT, BRC_FIELD_AT(brc_dlsm_own, joined)},
                                           {"along", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_dlsm_own, along)}};
    return (brc_scope){
        .owner = "normals of interfaces", .base = brc_dlsm_own_of(s), BRC_VALUES(values), .outer = outer};
}

void brc_brittle_interfaces_free(brc_simulation *s)
{
    brittle_interfaces *f = brc_dlsm_own_of(s)->interfaces;
    if (!f) return;
    brc_fields_free(&brc_brittle_interface_fields, f);
    brc_memory_free(f);
    brc_dlsm_own_of(s)->interfaces = NULL;
}

brc_status brc_brittle_interfaces_mark(brc_simulation *s, double share)
{
    const brittle_interfaces *f = brc_dlsm_own_of(s)->interfaces;
    if (!f) return BRC_OK;
    return brc_pass_look_awake(
        s, f->check,
        BRC_GIVEN({"share", BRC_COEFF(share)}, {"by_element", BRC_INT(brc_cell_breaks_by_bond(s) ? 0 : 1)}));
}
brc_status brc_brittle_interfaces_follow(brc_simulation *s)
{
    return brc_brittle_interfaces_mark(s, 1);
}

brc_status brc_brittle_interfaces_ratio(brc_simulation *s, brc_buffer *ratio)
{
    const brittle_interfaces *f = brc_dlsm_own_of(s)->interfaces;
    return f ? BRC_RUN(f->ratio, s->n_groups, {"out", BRC_BUF(ratio)}) : BRC_OK;
}
