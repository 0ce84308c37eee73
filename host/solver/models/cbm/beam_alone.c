#include "beam_alone.h"
#include "../../effects/fracture/bond_area.h"
#include "../../effects/fracture/strengths.h"
#include "cbm_internal.h"

enum { HOLD = 2 }; /* beam_alone.cl */

struct brc_beam_alone {
    brc_pass *choose;
    brc_buffer *hold;  /* [n_slots][HOLD][C] */
    brc_buffer *holds; /* [n_groups] */
};
typedef struct brc_beam_alone beam_alone;

#define AT(member) BRC_FIELD_AT(beam_alone, member)
static const brc_field_row rows[] = {
    BRC_FIELD(hold, brc_each_entry, HOLD, COEFF, NULL, "beams of brittle interfaces", "-"),
    BRC_FIELD(holds, brc_each_group, 1, INT, NULL, "beams of brittle interfaces", "-"),
};
BRC_FIELD_TABLE(brc_beam_alone_fields, "beams of brittle interfaces", BRC_LIFE_RUN, brc_wants_joined, rows);

/* Strength times area, and area, of beams of brittle interfaces weaker than their solids. */
static brc_status upload(brc_simulation *s, const beam_alone *f)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t slice = layout->slice, n_entries = layout->n_slots * slice, width = layout->n_rows / s->n_groups;
    BRC_ENDS_WITH(brc_strengths_free) brc_strengths strengths = {0};
    BRC_TRY(brc_strengths_create(s->context, s->scene, d, s->material_of_element, &strengths));
    BRC_LOCAL(s->context, HOLD * n_entries, double, hold, "beams of brittle interfaces");
    BRC_LOCAL(s->context, s->n_groups, int32_t, holds, "beams of brittle interfaces");
    BRC_LOCAL(s->context, d->n_bonds, double, area, "areas of beams");
    BRC_TRY(brc_bond_areas_closed(s->context, d, area));
    for (int32_t block = 0; block < layout->n_slices; ++block)
        for (int64_t k = (int64_t)layout->slot_start[block] * slice; k < (int64_t)layout->slot_start[block + 1] * slice;
             ++k) {
            const int32_t h = layout->half_edge[k], bond = h < 0 ? -1 : d->bond[h];
            if (bond < 0 || !strengths.joint[bond] || strengths.energy[bond] > 0 || !(strengths.factor[bond] < 1))
                continue;
            double *own = hold + (k / slice) * HOLD * slice + k % slice;
            own[0] = strengths.tension[bond] * area[bond];
            own[slice] = area[bond];
            holds[(block * slice + k % slice) / width] |= own[0] > 0;
        }
    BRC_TRY(brc_upload_coeff(s, f->hold, hold, HOLD * n_entries));
    return brc_upload_int(f->holds, holds, s->n_groups);
}

brc_status brc_beam_alone_create(brc_simulation *s)
{
    if (!brc_wants_joined(&s->wants)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_cbm_own_of(s)->alone, 1, "beams of brittle interfaces"));
    beam_alone *f = brc_cbm_own_of(s)->alone;
    BRC_TRY(brc_fields_create(s->device, &brc_beam_alone_fields, &s->wants, f));
    const brc_scope run = brc_scope_of_run(s), breaks = brc_scope_of_breaks(s, &run),
                    criterion = brc_scope_of_criterion(s, &breaks);
    const brc_scope beams = {
        .owner = "beams of brittle interfaces", .base = f, .tables = {&brc_beam_alone_fields}, .outer = &criterion};
    BRC_TRY(BRC_PASSES(s, &beams, BRC_PASS(&f->choose, "beam_alone_choose", "step")));
    return upload(s, f);
}

void brc_beam_alone_free(brc_simulation *s)
{
    beam_alone *f = brc_cbm_own_of(s)->alone;
    if (!f) return;
    brc_fields_free(&brc_beam_alone_fields, f);
    brc_memory_free(f);
    brc_cbm_own_of(s)->alone = NULL;
}

brc_status brc_beam_alone_choose(brc_simulation *s, int32_t moment)
{
    const beam_alone *f = brc_cbm_own_of(s)->alone;
    return f ? BRC_RUN(f->choose, s->n_groups, {"step", BRC_INT(moment)}) : BRC_OK;
}
