#include "beam_bridges.h"
#include "../../effects/fracture/ahead.h"
#include "cbm_internal.h"

struct brc_beam_bridges {
    brc_pass *choose;
    brc_buffer *bears; /* [n_rows] */
};
typedef struct brc_beam_bridges beam_bridges;

/* Sides of a crack move apart by little in a step: they are looked at in one of these. */
static const int32_t every = 4;

/* Beams of some material break at once. */
static bool wanted(const brc_wants *w)
{
    const brc_scene *scene = w->scene;
    bool brittle = false;
    for (int32_t m = 0; m < scene->n_materials; ++m) {
        const brc_material *of = &scene->materials[m];
        brittle = brittle || ((of->tension > 0 || of->beam_strength > 0) && !(of->fracture_energy > 0));
    }
    return brittle && scene->has_fracture && scene->fracture.closure && brc_wants_spheres(w);
}

#define AT(member) BRC_FIELD_AT(beam_bridges, member)
static const brc_field_row rows[] = {
    BRC_FIELD(bears, brc_each_row, 1, COEFF, NULL, "strengths of bridging beams", "N m"),
};
BRC_FIELD_TABLE(brc_beam_bridge_fields, "beams that bridge cracks", BRC_LIFE_RUN, wanted, rows);

static brc_status upload(brc_simulation *s, const beam_bridges *f)
{
    const brc_domain *d = s->domain;
    const double *limit = brc_fracture_limits(s);
    BRC_LOCAL(s->context, s->layout->n_rows, double, bears, "strengths of bridging beams");
    for (int64_t r = 0; r < s->layout->n_rows; ++r) {
        const int64_t e = s->layout->element_of_row[r];
        const int64_t n = e < 0 ? 0 : d->row_start[e + 1] - d->row_start[e];
        if (n == 0 || s->scene->materials[s->material_of_element[e]].fracture_energy > 0) continue;
        bears[r] = limit[3 * e] * 6 * d->volume[e] / (double)n;
    }
    return brc_upload_coeff(s, f->bears, bears, s->layout->n_rows);
}

brc_status brc_beam_bridges_create(brc_simulation *s)
{
    if (!wanted(&s->wants)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_cbm_own_of(s)->bridges, 1, "beams that bridge cracks"));
    beam_bridges *f = brc_cbm_own_of(s)->bridges;
    BRC_TRY(brc_fields_create(s->device, &brc_beam_bridge_fields, &s->wants, f));
    const brc_scope run = brc_scope_of_run(s), breaks = brc_scope_of_breaks(s, &run),
                    criterion = brc_scope_of_criterion(s, &breaks);
    const brc_scope beams = {
        .owner = "beams that bridge cracks", .base = f, .tables = {&brc_beam_bridge_fields}, .outer = &criterion};
    BRC_TRY(BRC_PASSES(s, &beams, BRC_PASS(&f->choose, "beam_bridges_choose", "level step")));
    return upload(s, f);
}

void brc_beam_bridges_free(brc_simulation *s)
{
    beam_bridges *f = brc_cbm_own_of(s)->bridges;
    if (!f) return;
    brc_fields_free(&brc_beam_bridge_fields, f);
    brc_memory_free(f);
    brc_cbm_own_of(s)->bridges = NULL;
}

brc_status brc_beam_bridges_choose(brc_simulation *s, int32_t moment, double half_kick)
{
    const beam_bridges *f = brc_cbm_own_of(s)->bridges;
    const bool looks = f && (!(half_kick > 0) || moment % every == 0) && !brc_ahead_is_whole(s);
    return looks ? BRC_RUN(f->choose, s->n_groups, {"level", BRC_INT(s->scene->fracture.level)},
                           {"step", BRC_INT(moment)})
                 : BRC_OK;
}
