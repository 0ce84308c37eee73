/* Stresses along the loaded diameter of a disc against Hondros' (NAH19 section 4.3, Fig. 15), over the nominal stress 2
 * P / (pi t D), so that the load does not matter: means over the elements of equal stretches of the diameter, as
 * values, and a figure of all runs of a case. */
#include "operators.h"
#include "../references/reference_hondros.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../output/pictures/gnuplot.h"
#include "../../solver/core/loaded_faces.h"
#include <math.h>
#include <string.h>

enum { STRETCHES = 25, POINTS = 400 };
#define CENTRE 0.2 /* |rho| of the two values of the centre */
#define INSIDE 0.7 /* of rms_across: beyond it the stress is steep and depends on how the jaws hold the rim */

/* The disc, and which way it is pressed. */
typedef struct disc {
    double centre[3], radius, thickness, half_angle, half_width; /* of the strip of elements along the diameter [m] */
    int axis, along, across;
    double nominal; /* 2 P / (pi t D) [Pa] */
} disc;

/* Force of a jaw on the disc [N]: of imposed motion what it takes, of a pressure what it gives. */
static brc_status jaw_force(brc_context *context, brc_simulation *simulation, const brc_load *load, double out[3])
{
    const brc_domain *domain = brc_simulation_domain(simulation);
    const int32_t set = brc_domain_find_set(domain, load->set);
    if (load->kind != BRC_LOAD_PRESSURE) return brc_simulation_reaction(simulation, set, out);
    brc_loaded_face *loaded = NULL;
    int64_t n = 0;
    BRC_TRY(brc_loaded_faces(context, brc_simulation_scene(simulation), domain, &domain->sets[set], &loaded, &n));
    for (int c = 0; c < 3; ++c) {
        out[c] = 0;
        for (int64_t k = 0; k < n; ++k)
            out[c] -= load->value[0] * loaded[k].area[c];
    }
    brc_memory_free(loaded);
    return BRC_OK;
}

/* Which way a jaw presses; -1: unclear. */
static int jaw_direction(const brc_load *load, const double force[3])
{
    int along = -1;
    for (int c = 0; c < 3; ++c)
        if (load->kind == BRC_LOAD_PRESSURE ? along < 0 || fabs(force[c]) > fabs(force[along]) : load->component[c])
            along = c;
    return along;
}

static brc_status find_disc(brc_context *context, brc_simulation *simulation, const brc_case_run *run, disc *out)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_domain *domain = brc_simulation_domain(simulation);
    const brc_shape *shape = &scene->bodies[0].shape;
    const brc_stage *stage = &scene->stages[scene->n_stages - 1];
    double load = 0;
    *out = (disc){.radius = shape->radius,
                  .thickness = shape->length,
                  .half_angle = run->half_angle,
                  .axis = shape->axis,
                  .along = -1};
    for (int k = 0; k < 2 && stage->n_loads >= 2; ++k) {
        double force[3];
        BRC_TRY(jaw_force(context, simulation, &stage->loads[k], force));
        const int along = jaw_direction(&stage->loads[k], force);
        out->along = k == 0 || along == out->along ? along : -1;
        if (out->along >= 0) load += 0.5 * fabs(force[out->along]);
    }
    if (scene->n_bodies != 1 || shape->kind != BRC_SHAPE_CYLINDER || out->along < 0 || out->along == shape->axis ||
        !(run->half_angle > 0))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "run %s: `with: hondros` expects one cylinder, two jaws across its axis as the first loads of "
                        "the last stage (imposed motion or pressure), and `half_angle`",
                        run->name);
    out->across = 3 - out->axis - out->along;
    for (int c = 0; c < 3; ++c)
        out->centre[c] = shape->origin[c];
    for (int64_t e = 0; e < domain->n_elements; ++e) /* a mean diameter; cells: of a sphere of equal volume */
        out->half_width += 2 * (domain->radius ? domain->radius[e] : cbrt(0.75 / M_PI * domain->volume[e])) /
                           (double)domain->n_elements;
    out->nominal = load / (M_PI * out->thickness * out->radius);
    return BRC_OK;
}

/* Hondros' stresses averaged from rho = a to b. */
static void expected(double half_angle, double a, double b, double out[2])
{
    out[0] = out[1] = 0;
    for (int k = 0; k < POINTS; ++k) {
        double s[2];
        brc_reference_hondros(half_angle, a + (b - a) * (k + 0.5) / POINTS, s);
        for (int c = 0; c < 2; ++c)
            out[c] += s[c] / POINTS;
    }
}

/* Sums over elements between two places of the diameter, weighted with their volumes. */
typedef struct mean {
    double volume, stress[2];
} mean;

static void add_element(mean *m, double volume, const double stress[2])
{
    m->volume += volume;
    for (int c = 0; c < 2; ++c)
        m->stress[c] += volume * stress[c];
}

static void stretch_name(char out[BRC_NAME], const char *direction, int k)
{
    snprintf(out, BRC_NAME, "%s_%02d", direction, k);
}
static double stretch_begin(int k)
{
    return -1 + 2.0 * k / STRETCHES;
}

static brc_status finished(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    const brc_domain *domain = brc_simulation_domain(simulation);
    mean stretch[STRETCHES] = {{0}}, centre = {0};
    double *stress = NULL, exact[2], squares = 0, worst = 0;
    brc_status status = BRC_OK;
    disc d;
    BRC_TRY(find_disc(context, simulation, outcome->run, &d));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &stress, 6 * domain->n_elements, "stress of a disc"));
    BRC_TRY_OR(cleanup, brc_simulation_strain_stress(simulation, NULL, NULL, stress));
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const double *x = domain->position + 3 * e;
        const double rho = (x[d.along] - d.centre[d.along]) / d.radius;
        const int k = (int)floor((rho + 1) / 2 * STRETCHES);
        if (fabs(x[d.across] - d.centre[d.across]) > d.half_width || k < 0 || k >= STRETCHES) continue;
        const double s[2] = {stress[6 * e + d.across] / d.nominal, stress[6 * e + d.along] / d.nominal};
        add_element(&stretch[k], domain->volume[e], s);
        if (fabs(rho) <= CENTRE) add_element(&centre, domain->volume[e], s);
    }
    int n_inside = 0;
    for (int k = 0; k < STRETCHES; ++k) {
        const double a = stretch_begin(k), b = stretch_begin(k + 1);
        if (!(stretch[k].volume > 0)) {
            status =
                BRC_FAIL(context, BRC_BAD_INPUT,
                         "run %s: no element between rho = %.2f and %.2f of the loaded diameter; take more elements",
                         outcome->run->name, a, b);
            goto cleanup;
        }
        expected(d.half_angle, a, b, exact);
        for (int c = 0; c < 2; ++c) {
            char name[BRC_NAME];
            stretch_name(name, c ? "along" : "across", k);
            brc_outcome_add(outcome, name, "-", stretch[k].stress[c] / stretch[k].volume, exact[c]);
        }
        if (fmax(fabs(a), fabs(b)) > INSIDE) continue;
        const double off = stretch[k].stress[0] / stretch[k].volume - exact[0];
        squares += off * off;
        worst = fmax(worst, fabs(off));
        ++n_inside;
    }
    expected(d.half_angle, -CENTRE, CENTRE, exact);
    brc_outcome_add(outcome, "centre_across", "-", centre.stress[0] / centre.volume, exact[0]);
    brc_outcome_add(outcome, "centre_along", "-", centre.stress[1] / centre.volume, exact[1]);
    brc_outcome_add(outcome, "rms_across", "-", sqrt(squares / n_inside), NAN);
    brc_outcome_add(outcome, "worst_across", "-", worst, NAN);
cleanup:
    brc_memory_free(stress);
    return status;
}

/* $law: rho, across, along; $ours: rho, across, its scatter, along, its scatter, run by run. */
static void add_data(const brc_campaign *campaign, double half_angle, brc_text *text)
{
    brc_text_add(text, "$law << END\n");
    for (int k = 0; k <= POINTS; ++k) {
        double s[2];
        const double rho = -1 + 2.0 * k / POINTS;
        brc_reference_hondros(half_angle, rho, s);
        brc_text_add(text, "%.6g %.8g %.8g\n", rho, s[0], s[1]);
    }
    brc_text_add(text, "END\n");
    for (int r = 0; r < campaign->what->n_runs; ++r) {
        const brc_outcome *outcome = &campaign->outcomes[r];
        if (!outcome->done || outcome->run->operator!= & brc_operator_hondros) continue;
        brc_text_add(text, "$ours%d << END\n", r);
        for (int k = 0; k < STRETCHES; ++k) {
            brc_text_add(text, "%.6g", stretch_begin(k) + 1.0 / STRETCHES);
            for (int c = 0; c < 2; ++c) {
                char name[BRC_NAME];
                stretch_name(name, c ? "along" : "across", k);
                const brc_case_value *value = brc_outcome_find(outcome, name);
                brc_text_add(text, " %.8g %.8g", value->value, isnan(value->scatter) ? 0 : value->scatter);
            }
            brc_text_add(text, "\n");
        }
        brc_text_add(text, "END\n");
    }
}

static void add_curves(const brc_campaign *campaign, brc_text *text)
{
    static const char *const directions[2] = {"across the loaded diameter", "along it"};
    brc_text_add(text, "set multiplot layout 2,1\nset xrange [-1:1]\nset xlabel 'r / R'\nset ylabel 'stress / (2P / "
                       "{/Symbol p}tD)'\nset key bottom center\n");
    for (int c = 0; c < 2; ++c) {
        brc_text_add(text,
                     "set title '%s'\nset yrange [%s]\nplot $law using 1:%d with lines linewidth 2 linecolor rgb "
                     "'#222222' title 'Hondros'",
                     directions[c], c ? "-9:1" : "-3:1.5", 2 + c);
        for (int r = 0, colour = 0; r < campaign->what->n_runs; ++r) {
            const brc_outcome *outcome = &campaign->outcomes[r];
            static const char *const colours[] = {"#4477aa", "#cc6677", "#228833", "#ccbb44"};
            if (!outcome->done || outcome->run->operator!= & brc_operator_hondros) continue;
            brc_text_add(text, ", $ours%d using 1:%d:%d with yerrorbars pointtype 7 linecolor rgb '%s' title '%s'", r,
                         2 + 2 * c, 3 + 2 * c, colours[colour++ % 4], outcome->run->name);
        }
        brc_text_add(text, "\n");
    }
    brc_text_add(text, "unset multiplot\n");
}

static brc_status figure(brc_campaign *campaign)
{
    brc_context *context = campaign->session->context;
    double half_angle = 0;
    for (int r = 0; r < campaign->what->n_runs; ++r)
        if (campaign->outcomes[r].done && campaign->what->runs[r].operator== & brc_operator_hondros)
            half_angle = campaign->what->runs[r].half_angle;
    if (!(half_angle > 0)) return BRC_OK;
    brc_text data = {.context = context}, script = {.context = context};
    char *path = NULL, *numbers = NULL, *aside = NULL;
    bool made;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(context, campaign->folder, "hondros.png", &path));
    BRC_TRY_OR(cleanup, brc_file_join(context, campaign->folder, "hondros.dat", &numbers));
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    add_data(campaign, half_angle, &data);
    BRC_TRY_OR(cleanup, brc_text_write(&data, numbers));
    brc_gnuplot_begin(&script, 900, 1000, aside);
    brc_text_add_bytes(&script, data.data, data.length);
    add_curves(campaign, &script);
    status = brc_gnuplot_draw(context, &script, aside, path, numbers, &made);
cleanup:
    brc_text_free(&data);
    brc_text_free(&script);
    brc_memory_free(path);
    brc_memory_free(numbers);
    brc_memory_free(aside);
    return status;
}

/* The hondros operator, at the end of a run: across_KK and along_KK (stress over 2 P / (pi t D)) in 25 stretches of
 * the loaded diameter, centre_across and centre_along (|r| <= R/5; references: Hondros), rms_across and worst_across
 * (rms and largest difference to Hondros) of the stretches within 0.7 R. BRC_BAD_INPUT: not one cylinder under two
 * loads across its axis. hondros.png and its numbers, hondros.dat, into the campaign's folder, where such runs were
 * made. */
const brc_operator brc_operator_hondros = {.name = "hondros", .finished = finished, .figure = figure};
