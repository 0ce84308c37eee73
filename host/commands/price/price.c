#include "price.h"
#include "price_choices.h"
#include "../reproduce/case.h"
#include "planned_output.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A stage is predicted after this many seconds, or this part of its steps where it is shorter. */
static const double watched_s = 0.5, watched_part = 0.02;

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    brc_price *p = self;
    (void)simulation, (void)stage;
    p->begin = brc_clock_s();
    p->first_step = 0;
    p->expected = 0;
    p->stage_frames_s = 0;
    p->stage_frames = 0;
    return BRC_OK;
}

static brc_status frame_begin(void *self, brc_simulation *simulation)
{
    brc_price *p = self;
    (void)simulation;
    p->frame_begin = brc_clock_s();
    return BRC_OK;
}

static brc_status frame_end(void *self, brc_simulation *simulation)
{
    brc_price *p = self;
    const double took = brc_clock_s() - p->frame_begin;
    (void)simulation;
    p->n_frames += 1;
    p->frame_s += (took - p->frame_s) / (double)p->n_frames;
    p->stage_frames += 1;
    p->stage_frames_s += took;
    return BRC_OK;
}

/* Frames of the stage that are still to come, that at its end too. */
static double frames_left_s(const brc_price *p, const brc_scene *scene, int32_t stage, int64_t total, double time_step)
{
    const int64_t left = brc_planned_frames(scene, stage, total, time_step) +
                         (stage == 0 && scene->output.n_frames >= 0) - p->stage_frames;
    return left > 0 ? (double)left * p->frame_s : 0;
}

static brc_status pause(void *self, brc_simulation *simulation, brc_pause why)
{
    brc_price *p = self;
    const brc_scene *scene = brc_simulation_scene(simulation);
    const int32_t stage = brc_simulation_stage(simulation);
    const int64_t step = brc_simulation_step(simulation);
    if (why != BRC_PAUSE_GOING || p->expected > 0 || scene->stages[stage].solver != BRC_SOLVER_DYNAMIC) return BRC_OK;
    const double now = brc_clock_s();
    if (p->first_step == 0) {                /* its batch touched every page for the first time */
        if (!(p->begin > 0)) p->begin = now; /* taken up in the middle of a stage, which therefore did not begin here */
        p->first_step = step;
        p->first_rest = brc_simulation_at_rest(simulation);
        p->first_s = now;
        p->first_frames_s = p->stage_frames_s;
        p->prediction.host_bytes = brc_memory_peak(); /* with what the first frame and the samples took */
        return BRC_OK;
    }
    const int64_t total = brc_simulation_planned_steps(simulation, stage, brc_simulation_time_step(simulation).value);
    if (now - p->begin < watched_s && (double)step < watched_part * (double)total) return BRC_OK;
    const double seen = (now - p->first_s - (p->stage_frames_s - p->first_frames_s)) / (double)(step - p->first_step),
                 pace = brc_rest_whole_pace(seen, p->first_rest, brc_simulation_at_rest(simulation)),
                 left = (double)(total - step);
    p->expected = now - p->begin + pace * (left - brc_rest_spared(simulation, left)) +
                  frames_left_s(p, scene, stage, total, brc_simulation_time_step(simulation).value);
    p->prediction.after_steps = step;
    if (p->expected > 60)
        brc_log(p->context, BRC_LOG_INFO, "stage '%s' will take about %.3g s at this pace", scene->stages[stage].name,
                p->expected);
    return BRC_OK;
}

static brc_status stage_end(void *self, brc_simulation *simulation, int32_t stage)
{
    brc_price *p = self;
    (void)simulation, (void)stage;
    if (!(p->expected > 0)) return BRC_OK;
    p->prediction.seconds = (isnan(p->prediction.seconds) ? 0 : p->prediction.seconds) + p->expected;
    p->prediction.took_seconds =
        (isnan(p->prediction.took_seconds) ? 0 : p->prediction.took_seconds) + brc_clock_s() - p->begin;
    return BRC_OK;
}

brc_status brc_price_watch_output(brc_context *context, const brc_setup *setup, brc_price *price)
{
    *price = (brc_price){.context = context,
                         .prediction = {.seconds = NAN, .took_seconds = NAN, .host_bytes = brc_memory_peak()}};
    for (int32_t k = 0; k < setup->n; ++k)
        price->prediction.device_bytes += brc_simulation_planned_bytes(setup->simulation[k]);
    return brc_simulation_observe(setup->simulation[0], &(brc_observer){.self = price, .frame = frame_begin});
}

brc_status brc_price_watch(const brc_setup *setup, brc_price *price)
{
    return brc_simulation_observe(
        setup->simulation[0],
        &(brc_observer){
            .self = price, .stage_begin = stage_begin, .frame = frame_end, .pause = pause, .stage_end = stage_end});
}

void brc_price_compare(const brc_price *price)
{
    const brc_prediction *p = &price->prediction;
    if (isnan(p->seconds)) return;
    brc_log(price->context, BRC_LOG_INFO, "dynamic stages: %.3g s told after %lld steps, %.3g s taken: %+.0f %%",
            p->seconds, (long long)p->after_steps, p->took_seconds, 100 * (p->seconds / p->took_seconds - 1));
}

/* Errors below this are not told apart: solvers' tolerances, strains squared, rounding [-]. */
static const double finest_class = 1e-4;

double brc_price_class(double error)
{
    return error < finest_class ? finest_class : pow(10, round(2 * log10(error)) / 2);
}

/* Elements over the most that were measured beyond which a curve says nothing. */
static const double farthest = 1000;

/* What so many elements give and cost. Below the fewest that were measured nothing is known but that fewer would do. */
static void tell_choice(const brc_price_curve *curve, double elements, double now, double seconds)
{
    if (elements > farthest * curve->most) {
        printf("more than %.2g elements, out of reach: '%s' falls as spacing^%.2g\n", farthest * curve->most,
               curve->problem, curve->order);
        return;
    }
    const bool below = elements < curve->least;
    const double n = below ? curve->least : ceil(elements);
    printf("%s%.0f elements: error %.2g %%, about %.2g s%s\n", below ? "no more than " : "", n,
           100 * brc_price_curve_error(curve, n), brc_price_seconds_at(seconds, now, n),
           below             ? " (the fewest that were measured)"
           : n > curve->most ? " (beyond the measured sizes)"
                             : "");
}

/* Curves of the scene's model, of the precision in `taken` or, where there are none, of double: resolution costs more
 * than rounding at any size that was measured. */
static brc_status read_curves(brc_context *context, const char *model, const char **taken, int *n,
                              brc_price_curve curve[BRC_CURVES_MOST])
{
    char *text;
    size_t bytes;
    BRC_TRY(brc_case_text(context, NULL, "results", "accuracy-curves.csv", &text, &bytes));
    brc_price_curves_read(text, model, *taken, n, curve);
    if (*n == 0) brc_price_curves_read(text, model, *taken = brc_precision_name(BRC_DOUBLE), n, curve);
    brc_memory_free(text);
    return BRC_OK;
}

/* The curve of the scene's own worst measure, through its error at `now` elements. */
static brc_price_curve own_curve(const brc_scene *scene, const brc_price_error *own, double error, double now)
{
    brc_price_curve curve = {.n = 1,
                             .order = own->order,
                             .scale = error * pow(now, own->order / 3),
                             .least = (double)own->least_elements,
                             .most = now};
    snprintf(curve.problem, sizeof curve.problem, "%.31s", scene->measures[own->worst].name);
    return curve;
}

static void tell_class(const brc_price_curve *by, double now, const char *whose)
{
    const double error = brc_price_curve_error(by, now);
    if (error < finest_class)
        printf("error class (elastic): 0.01 %% or better (by %s '%s')\n", whose, by->problem);
    else {
        const double percent = 100 * brc_price_class(error), unit = pow(10, floor(log10(percent) + 1e-9));
        printf("error class (elastic): %.3g %% (by %s '%s')\n", round(percent / unit) * unit, whose,
               by->problem); /* one digit: 0.3, 1, 3, 10 */
    }
}

/* The same by the measured problems, the easiest and the hardest of those that were named, since the scene's own error
 * is told with care; a scene of modes alone is held against modes. */
static void tell_measured(const brc_scene *scene, const brc_price_judgement *j, double now, double seconds)
{
    bool rings = scene->n_stages > 0;
    const brc_price_curve *end[2] = {NULL, NULL};
    for (int k = 0; k < scene->n_stages; ++k)
        rings = rings && scene->stages[k].solver == BRC_SOLVER_MODES;
    for (int k = 0; k < j->n; ++k) {
        const brc_price_curve *curve = &j->curve[k];
        const double elements = brc_price_curve_elements(curve, scene->accuracy);
        if (rings && !curve->rings) continue;
        if (!end[0] || elements < brc_price_curve_elements(end[0], scene->accuracy)) end[0] = curve;
        if (!end[1] || elements > brc_price_curve_elements(end[1], scene->accuracy)) end[1] = curve;
    }
    for (int k = 0; k < 2 && end[k] && (k == 0 || (j->is_own && end[1] != end[0]));
         ++k) { /* else the hardest is what the proposal goes by */
        printf("as the measured problem '%s' (the %s of them) it asks for ", end[k]->problem,
               k ? "hardest" : "easiest");
        tell_choice(end[k], brc_price_curve_elements(end[k], scene->accuracy), now, seconds);
    }
}

static void tell_choices(const brc_scene *scene, const brc_price_judgement *j, double now, double seconds)
{
    const brc_price_curve *curve = &j->by;
    if (scene->accuracy > 0) {
        printf("accuracy %.3g %% asks for ", 100 * scene->accuracy);
        tell_choice(curve, brc_price_curve_elements(curve, scene->accuracy), now, seconds);
        printf("a tenth of the error would ask for ");
        tell_choice(curve, brc_price_curve_elements(curve, 0.1 * scene->accuracy), now, seconds);
        tell_measured(scene, j, now, seconds);
    }
    if (scene->budget > 0) {
        printf("budget %.3g s buys ", scene->budget);
        tell_choice(curve, brc_price_elements_for(seconds, now, scene->budget), now, seconds);
        printf("ten times the budget would buy ");
        tell_choice(curve, brc_price_elements_for(seconds, now, 10 * scene->budget), now, seconds);
    }
}

/* The proposal for a precision or a time step, from pairs of measured runs, and what the others would cost. `error`:
 * how much more is nothing beside the resolution's. */
static void tell_other_choices(const char *text, const char *model, const char *what, const char *column,
                               const char *usual, double error)
{
    int n;
    brc_price_choice choice[BRC_CHOICES_MOST];
    brc_price_choices_read(text, model, column, usual, &n, choice);
    if (n == 0) {
        printf("%s: take %s; others were not measured with model %s\n", what, usual, model);
        return;
    }
    const int best = brc_price_choice_best(n, choice, error);
    printf("%s: take %s;", what, best < 0 ? usual : choice[best].value);
    for (int c = 0; c < n; ++c)
        printf("%s %s takes %.2f of the time of %s and errs by at most %.1g %% more (%d pairs of runs)", c ? "," : "",
               choice[c].value, choice[c].time, usual, 100 * choice[c].more_error, choice[c].pairs);
    printf("\n");
}

static brc_status tell_precision_and_step(brc_context *context, const brc_scene *scene, const char *model,
                                          const brc_price_curve *curve, double now, double seconds)
{
    if (!(scene->accuracy > 0) && !(scene->budget > 0)) return BRC_OK;
    /* a tenth of the error that the resolution leaves */
    const double error =
        0.1 * (scene->accuracy > 0 ? scene->accuracy
                                   : brc_price_curve_error(curve, brc_price_elements_for(seconds, now, scene->budget)));
    bool moves = false, rings = false;
    for (int k = 0; k < scene->n_stages; ++k) {
        moves = moves || scene->stages[k].solver == BRC_SOLVER_DYNAMIC;
        rings = rings || scene->stages[k].solver == BRC_SOLVER_MODES;
    }
    char *text;
    size_t bytes;
    BRC_TRY(brc_case_text(context, NULL, "results", "accuracy-curves.csv", &text, &bytes));
    if (rings)
        printf("precision: take double: modes are not found in less\n");
    else
        tell_other_choices(text, model,
                           "precision (double where bodies turn at small strains: docs/notebook/stability.md)",
                           "precision", brc_precision_name(BRC_DOUBLE), error);
    if (moves) tell_other_choices(text, model, "time step over its bound", "dt_fraction", "0.8", error);
    brc_memory_free(text);
    return BRC_OK;
}

/* What the model itself is off by, however many elements: beams by their calibration and their sample, as a pulled cube
 * of them. */
static double model_error(brc_model_kind model, int n, const brc_price_curve *curve, double now)
{
    for (int k = 0; k < n && brc_model_traits_of(model)->spheres; ++k)
        if (strcmp(curve[k].problem, "tension") == 0) return brc_price_curve_error(&curve[k], now);
    return 0;
}

/* Of a scene without contact, the problem of two bodies that touch says nothing; of one where nothing moves, those that
 * were stepped through time. */
static void leave_out_others(const brc_scene *scene, int *n, brc_price_curve *curve)
{
    int kept = 0;
    bool moves = false;
    for (int k = 0; k < scene->n_stages; ++k)
        moves = moves || scene->stages[k].solver == BRC_SOLVER_DYNAMIC;
    for (int k = 0; k < *n; ++k)
        if ((scene->has_contact || strcmp(curve[k].problem, "hertz") != 0) && (moves || !curve[k].moves))
            curve[kept++] = curve[k];
    *n = kept;
}

brc_status brc_price_judge(brc_context *context, const brc_scene *scene, const brc_setup *setup,
                           brc_precision precision, const brc_price_error *own, brc_price_judgement *out)
{
    const brc_model_kind kind = setup->split->part[0].scene->model.kind;
    const double now = (double)brc_setup_n_elements(setup);
    const char *taken = brc_precision_name(precision);
    int worst = 0;
    BRC_TRY(read_curves(context, brc_model_name(kind), &taken, &out->n, out->curve));
    leave_out_others(scene, &out->n, out->curve);
    out->taken = taken;
    out->is_own = own->worst >= 0;
    out->known = out->is_own || out->n > 0;
    for (int k = 1; k < out->n; ++k)
        if (brc_price_curve_error(&out->curve[k], now) > brc_price_curve_error(&out->curve[worst], now)) worst = k;
    if (out->is_own)
        out->by = own_curve(scene, own, fmax(own->error[own->worst], model_error(kind, out->n, out->curve, now)), now);
    else if (out->known)
        out->by = out->curve[worst];
    return BRC_OK;
}

/* What was measured of bodies of a model that break, as rows of docs/notebook/fracture.md say. */
static const char *measured_of(brc_model_kind model, bool by_bond, bool softens)
{
    if (brc_model_traits_of(model)->spheres)
        return softens ? "energy per area of a crack 0.91 to 1.06 of the fracture energy given, at coordination "
                         "numbers 6 to 13 (docs/notebook/fracture.md, \"Measured on beams\")"
                       : "strength in tension within 0.6 %, discs pressed across up to 6 % below it with few bonds, "
                         "twisted rods 7 to 15 % above; a crack's energy is what strength and spheres "
                         "make of it (docs/notebook/beams-tests.md)";
    if (!brc_model_traits_of(model)->deforms || !by_bond)
        return "only the onset, at the strength in an even pull; a crack's energy is what strength and cells make of "
               "it (docs/notebook/fracture.md)";
    return softens ? "peak loads of notched parts +3 to +7 % with regular cells or 30 cells in the notch, +11 to +13 % "
                     "with 15 uneven ones; energy per area of a crack 0.98 to 1.09 of the fracture "
                     "energy given (docs/notebook/fracture.md, \"What fracture must show\")"
                   : "onset in an even pull within 0.03 % of the strength, peak loads of discs pressed across +0.6 % "
                     "(arcs) to -7 % (narrow strips); a crack's energy is what strength and cells make "
                     "of it, so loads of notched parts change with the cells (docs/notebook/fracture.md, \"What "
                     "fracture must show\")";
}

/* The error class is of elastic solids; a line for every kind of breaking in the scene. */
static void tell_breaking(FILE *details, const brc_scene *scene, const brc_setup *setup)
{
    const char *said[BRC_N_MODELS] = {NULL};
    if (!scene->has_fracture) return;
    fprintf(details, "what breaks: the errors above are of the elastic solid; no error of this scene's cracks or "
                     "strength is known\n");
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_model_kind kind = setup->split->part[k].scene->model.kind;
        if (said[kind]) continue;
        said[kind] = measured_of(kind, brc_scene_breaks_by_bond(scene, kind), brc_scene_softens(scene));
        fprintf(details, "measured where %s breaks: %s\n", brc_model_name(kind), said[kind]);
    }
}

brc_status brc_price_tell_accuracy(brc_context *context, const brc_scene *scene, const brc_setup *setup,
                                   brc_precision precision, double seconds, const brc_price_error *own, FILE *details)
{
    const double now = (double)brc_setup_n_elements(setup);
    brc_price_judgement j;
    BRC_TRY(brc_price_judge(context, scene, setup, precision, own, &j));
    for (int k = 0; k < j.n; ++k)
        fprintf(details,
                "error as of '%s' at %.0f elements: %.2g %% (%d points of %s from %.0f to %.0f elements, falls as "
                "spacing^%.2g)\n",
                j.curve[k].problem, now, 100 * brc_price_curve_error(&j.curve[k], now), j.curve[k].n, j.taken,
                j.curve[k].least, j.curve[k].most, j.curve[k].order);
    for (int32_t k = 0; own->worst >= 0 && k < scene->n_measures; ++k)
        if (!isnan(own->error[k]))
            fprintf(details, "error of measure '%s': about %.2g %% (from the same scene with about %lld elements%s)\n",
                    scene->measures[k].name, 100 * own->error[k], (long long)own->least_elements,
                    own->error[k] > 1 ? "; it differs by more than itself: a number that is zero but for the cells has "
                                        "no relative error, leave it out of `measure`"
                                      : "");
    if (own->worst >= 0 && own->volumes > finest_class)
        fprintf(details, "of that %.2g %%: volumes of the materials, whose boundaries run along cells\n",
                100 * own->volumes);
    if (own->out_of_time)
        fprintf(details,
                "measures were not compared with those of fewer elements: a stage of these was not over after %.0f s "
                "(another machine may tell another class)\n",
                brc_price_error_stage_s);
    if (!j.known) {
        printf("error class (elastic): not known, no curve of model %s was measured (docs/notebook/accuracy.md)\n",
               brc_model_name(setup->split->part[0].scene->model.kind));
        tell_breaking(details, scene, setup);
        return BRC_OK;
    }
    tell_class(&j.by, now, j.is_own ? "measure" : "the worst of these problems,");
    tell_breaking(details, scene, setup);
    tell_choices(scene, &j, now, seconds);
    return tell_precision_and_step(context, scene, brc_model_name(setup->split->part[0].scene->model.kind), &j.by, now,
                                   seconds);
}
