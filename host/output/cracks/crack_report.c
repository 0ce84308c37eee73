#include "crack_report.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

/* Cracks of every body: bonds are numbered part after part. */
static void sum_bodies(const brc_assembly *a, const brc_cracks *cracks, double *area)
{
    for (int32_t part = 0; part < a->n; ++part) {
        const int64_t first = brc_assembly_first_bond(a, part), end = brc_assembly_first_bond(a, part + 1);
        const int64_t element = brc_assembly_first_element(a, part);
        for (int64_t k = 0; k < cracks->n_broken; ++k) {
            const brc_break *b = &cracks->breaks[k];
            if (b->bond < first || b->bond >= end) continue;
            const int32_t body = brc_assembly_body(a, part, b->element_i - element);
            area[body < a->scene->n_bodies ? body : 0] += b->area;
        }
    }
}

static brc_status find_energy(const brc_assembly *assembly, const brc_cracks *cracks, brc_crack_report *out)
{
    for (int64_t k = 0; k < cracks->n_broken; ++k)
        out->released += cracks->breaks[k].energy;
    for (int32_t p = 0; p < assembly->n; ++p) {
        brc_softening_report one;
        const double implied = brc_simulation_implied_fracture_energy(assembly->part[p]);
        if (implied > out->implied_energy) out->implied_energy = implied;
        BRC_TRY(brc_simulation_softening(assembly->part[p], &one));
        out->softening.n_opened += one.n_opened, out->softening.n_ended += one.n_ended;
        out->softening.area += one.area, out->softening.spent += one.spent, out->softening.unfinished += one.unfinished;
    }
    return BRC_OK;
}

/* What cracks cost: by strength and cells where bonds break at once, and what was released; with a fracture energy what
 * open faces took. */
static void add_energy(brc_json *json, const brc_crack_report *report)
{
    const brc_softening_report *soft = &report->softening;
    brc_json_begin_object(json, "energy");
    brc_json_number(json, "released_J", report->released);
    brc_json_number(json, "per_area_J_per_m2",
                    report->statistics.total_area > 0 ? report->released / report->statistics.total_area : 0);
    if (report->implied_energy > 0) brc_json_number(json, "implied_J_per_m2", report->implied_energy);
    if (soft->n_opened > 0) {
        brc_json_integer(json, "opened", soft->n_opened);
        brc_json_integer(json, "ended", soft->n_ended);
        brc_json_number(json, "projected_area_m2", soft->area);
        brc_json_number(json, "spent_J", soft->spent);
        brc_json_number(json, "unfinished_J", soft->unfinished);
    }
    brc_json_end(json);
}

brc_status brc_crack_report_find(brc_context *context, const brc_assembly *assembly, const brc_cracks *cracks,
                                 const brc_fragment_sizes *sizes, brc_crack_report *out)
{
    int32_t *fragment = NULL;
    int64_t n;
    brc_status status = BRC_OK;
    brc_crack_report_free(out);
    BRC_TRY_OR(cleanup,
               BRC_ALLOCATE(context, &fragment, brc_assembly_first_element(assembly, assembly->n), "fragments"));
    BRC_TRY_OR(cleanup, brc_cracks_fragments(assembly, fragment, &n));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->area_of_body, assembly->scene->n_bodies, "areas of cracks"));
    brc_crack_statistics_of(cracks->n_broken, cracks->breaks, fragment, &out->statistics);
    sum_bodies(assembly, cracks, out->area_of_body);
    BRC_TRY_OR(cleanup, find_energy(assembly, cracks, out));
    out->sizes = *sizes;
    out->regime = brc_simulation_regime(assembly->part[0]);
cleanup:
    brc_memory_free(fragment);
    return status;
}

void brc_crack_report_free(brc_crack_report *report)
{
    brc_memory_free(report->area_of_body);
    *report = (brc_crack_report){0};
}

static void add_vector(brc_json *json, const char *key, const double v[3])
{
    brc_json_begin_array(json, key);
    for (int c = 0; c < 3; ++c)
        brc_json_number(json, NULL, v[c]);
    brc_json_end(json);
}

static void add_angles(brc_json *json, const char *key, const double normal[3])
{
    const double angle[3] = {brc_crack_angle(normal, 0), brc_crack_angle(normal, 1), brc_crack_angle(normal, 2)};
    add_vector(json, key, angle);
}

static void add_plane(brc_json *json, const char *key, const brc_crack_plane *p)
{
    const bool known = p->normal[0] != 0 || p->normal[1] != 0 || p->normal[2] != 0;
    if (!known) {
        brc_json_null(json, key);
        return;
    }
    brc_json_begin_object(json, key);
    brc_json_integer(json, "bonds", p->n);
    brc_json_number(json, "area_m2", p->area);
    add_vector(json, "point_m", p->point);
    add_vector(json, "normal", p->normal);
    add_angles(json, "angle_to_axes_deg", p->normal);
    brc_json_number(json, "rough_m", p->rough);
    brc_json_end(json);
}

static void add_orientation(brc_json *json, const brc_crack_statistics *s)
{
    static const char *const NAME[6] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    if (s->total_area > 0) {
        brc_json_begin_object(json, "fabric");
        for (int k = 0; k < 6; ++k)
            brc_json_number(json, NAME[k], s->fabric[k]);
        add_vector(json, "axis", s->normal);
        add_angles(json, "angle_to_axes_deg", s->normal);
        brc_json_end(json);
    } else {
        brc_json_null(json, "fabric");
    }
    add_plane(json, "plane", &s->all);
    add_plane(json, "separating_plane", &s->separating);
}

/* Bonds that broke while nothing was followed broke in static stages. */
static void add_regime(brc_json *json, bool broke, const brc_regime *r)
{
    brc_json_begin_object(json, "regime");
    brc_json_string(json, "name", r->broke ? brc_regime_name(r) : broke ? "event by event" : NULL);
    brc_json_number(json, "kinetic_over_elastic_at_first_break", r->broke ? r->at_first_break : NAN);
    brc_json_number(json, "kinetic_over_elastic_at_peak", r->broke ? r->at_peak : NAN);
    brc_json_number(json, "kinetic_over_elastic_until_peak", r->broke ? fmax(r->until_peak, r->at_peak) : NAN);
    brc_json_end(json);
}

void brc_crack_report_add(brc_json *json, const brc_scene *scene, const brc_cracks *cracks,
                          const brc_crack_report *report)
{
    const int64_t n = cracks->n_broken;
    const brc_crack_statistics *s = &report->statistics;
    brc_json_begin_object(json, "fracture");
    brc_json_integer(json, "fragments", cracks->n_fragments);
    brc_json_number(json, "largest_fragment", report->sizes.largest_share);
    brc_json_number(json, "mean_fragment_kg", report->sizes.mean_mass);
    brc_json_number(json, "first_break_s", n > 0 ? cracks->breaks[0].time : NAN);
    brc_json_number(json, "last_break_s", n > 0 ? cracks->breaks[n - 1].time : NAN);
    for (int mode = BRC_BREAK_TENSION; mode < BRC_BREAK_MODES; ++mode)
        if (mode <= BRC_BREAK_SHEAR || s->count[mode] > 0)
            brc_json_integer(json, brc_break_mode_name(mode), s->count[mode]);
    brc_json_number(json, "crack_area_m2", s->total_area);
    brc_json_begin_object(json, "area_of_mode_m2");
    for (int mode = BRC_BREAK_TENSION; mode < BRC_BREAK_MODES; ++mode)
        if (mode <= BRC_BREAK_SHEAR || s->count[mode] > 0)
            brc_json_number(json, brc_break_mode_name(mode), s->area[mode]);
    brc_json_end(json);
    brc_json_begin_object(json, "area_of_body_m2");
    for (int32_t b = 0; report->area_of_body && b < scene->n_bodies; ++b)
        brc_json_number(json, scene->bodies[b].name, report->area_of_body[b]);
    brc_json_end(json);
    add_energy(json, report);
    add_orientation(json, s);
    add_regime(json, n > 0, &report->regime);
    brc_json_end(json);
}
