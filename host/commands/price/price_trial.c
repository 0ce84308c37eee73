/* From what parts of a run cost to what all of it will. */
#include "price_trial.h"
#include "pace.h"
#include "price_work.h"
#include <math.h>

/* Solves that could not be counted on a coarser body: examples took 0.5 to 2.4 times as many iterations as the rule of
 * thumb. */
static const double thumb_least = 0.5, thumb_most = 2.5;
/* A solve of this long is counted on a coarser body. */
static const double countable_s = 1.5;
/* How much longer a step gets at most where bonds break, softening faces are open or surfaces touch that are apart in
 * the trial (docs/notebook/fracture.md, docs/notebook/contact.md); and an event at most, as the body falls apart. */
static const double cells_break = 4.5, beams_break = 4, faces_soften = 6, surfaces_touch = 3, events_grow = 2;
/* The least of a range where nothing can end a stage early: what a pace is uncertain by. */
static const double uncertain = 0.8;
/* What breaks or meets is looked at on a coarser body that takes some so long, of so many elements at least and such a
 * share of them at most. */
static const double looked_s = 2.5, least_looked = 200, most_looked = 0.5;
static const double coarse_stage_s = 4; /* of a stage of a coarser body at most */
/* Bytes of a broken bond: on the host while it runs the event of 136, and its two faces while they are written where
 * that is more than what else is held for a while; at its end the event, and where a picture of cells is drawn two
 * faces of some 5.1 corners of 28 and 28 more; on disk once a line of cracks.csv and a row of result.h5, and in each
 * frame two polygons of 97 bytes and 32 a corner: octagons of beams, some 5.5 corners of cells; and in the frame
 * itself, of cells, the corners that come apart. Every cell of a frame before which some bond broke is written anew,
 * with its points and faces (branching, ball-breaks, ceramic-plate). */
static const double host_of_break = 150, event_of_break = 136, drawn_of_break = 344, row_of_break = 420,
                    frame_of_beam = 706, frame_of_face = 546, corners_of_break = 44, cell_anew = 200;

typedef struct sums {
    double seconds, least, most;
    double step_seconds, steps; /* of seconds, those of dynamic steps */
    bool ranged;
} sums;

static void add(sums *to, double seconds, double least, double most)
{
    to->seconds += seconds;
    to->least += least;
    to->most += most;
    to->ranged |= least < seconds || most > seconds;
}

/* Samples and frames of the whole stage beyond those of the trial. */
static double output_of(const brc_trial_stage *stage)
{
    return (double)stage->samples_planned * stage->sample_s + (double)stage->frames_planned * stage->frame_s;
}

static double worst_growth(const brc_scene *scene)
{
    double factor = 1;
    if (scene->has_fracture)
        factor += (brc_model_traits_of(scene->model.kind)->spheres ? beams_break : cells_break) - 1;
    for (int32_t k = 0; scene->has_fracture && k < scene->n_materials; ++k)
        if (scene->materials[k].fracture_energy > 0) factor = fmax(factor, faces_soften);
    if (scene->has_contact) factor += surfaces_touch - 1;
    return factor;
}

/* slower, done: of the coarser body, how much longer its steps got than in the trial and what part of its steps it did;
 * NAN: not known. */
static void tell_dynamic(FILE *details, const brc_scene *scene, const brc_setup *setup, const brc_stage *stage,
                         const brc_trial_stage *t, double slower, double done, sums *total)
{
    const double growth = worst_growth(scene), unbroken = t->pace_s * ((double)t->planned - t->spared),
                 fixed = t->enter_s + t->warm_s, output = output_of(t);
    const double factor = t->cut && slower > 1 ? fmin(slower, growth) : 1,
                 part = t->cut && brc_trial_may_end_early(stage) && done > 0 ? fmin(done, 1) : 1;
    const double tried = t->enter_s + t->whole_s,
                 seconds = t->cut ? fmax(fixed + part * (factor * unbroken + output), tried)
                                  : tried; /* the trial came so far without an end */
    total->step_seconds += t->cut ? part * factor * unbroken : unbroken;
    total->steps += part * (double)t->planned;
    fprintf(details, "stage %s: time step %.6g s (%s", stage->name, t->time_step.value, t->time_step.governed_by);
    if (t->time_step.critical > 0)
        fprintf(details, ", %.3g of the critical %.6g s", t->time_step.value / t->time_step.critical,
                t->time_step.critical);
    if (t->time_step.published > 0) fprintf(details, "; the paper's rule would give %.6g s", t->time_step.published);
    fprintf(details, ")\n");
    fprintf(details,
            "stage %s: %lld steps of %.3g s each, %.3g bond updates/s, %lld samples of %.3g s, %lld frames of %.3g s: "
            "%.3g s%s\n",
            stage->name, (long long)t->planned, t->pace_s, (double)brc_setup_n_bonds(setup) / t->pace_s,
            (long long)t->samples_planned, t->sample_s, (long long)t->frames_planned, t->frame_s, seconds,
            t->cut ? "" : " (run to its end)");
    if (t->spared > 0)
        fprintf(details, "stage %s: elements that nothing has reached are left out: as much as %.3g steps\n",
                stage->name, t->spared);
    if (t->launches > 0)
        fprintf(details,
                "stage %s: %.4g launches and %.3g waits for the device in a step, samples and frames included; its "
                "passes move %.4g bytes a bond at least\n",
                stage->name, t->launches, t->waits, t->floor_bytes / (double)brc_setup_n_bonds(setup));
    if (factor > 1)
        fprintf(
            details,
            "stage %s: its steps get %.2g times as long as bonds break or surfaces meet (seen with fewer elements)\n",
            stage->name, factor);
    if (part < 1)
        fprintf(details, "stage %s: it ends after %.2g of its steps (seen with fewer elements)\n", stage->name, part);
    if (!t->cut)
        add(total, seconds, seconds, seconds);
    else if (growth == 1 && !brc_trial_may_end_early(stage))
        add(total, seconds, seconds, seconds);
    else {
        const double least = brc_trial_may_end_early(stage) ? tried : uncertain * (fixed + unbroken + output),
                     most = fixed + growth * unbroken + 2 * output;
        fprintf(details, "stage %s: from %.3g to %.3g s, as %s\n", stage->name, least, most,
                brc_trial_may_end_early(stage) ? "it may end early, bonds break or surfaces meet"
                                               : "bonds break or surfaces meet");
        add(total, seconds, least, most);
    }
}

static void tell_events(FILE *details, const brc_stage *stage, const brc_trial_stage *t, sums *total)
{
    const double fixed = t->enter_s + t->warm_s, events = t->pace_s * (double)(t->planned - 1),
                 whole = t->enter_s + t->whole_s;
    const double seconds = t->cut ? fixed + events + output_of(t) : whole,
                 most = t->cut ? fixed + events_grow * events + output_of(t) : whole;
    fprintf(details, "stage %s: %lld events of %.3g s each: %.3g s%s\n", stage->name, (long long)t->planned, t->pace_s,
            seconds, t->cut ? "" : " (run to its end)");
    if (t->cut)
        fprintf(details, "stage %s: from %.3g to %.3g s, as the body comes apart early or late\n", stage->name, whole,
                most);
    add(total, seconds, whole, most);
}

/* counted: iterations on a coarser body, made those of this one; 0: there were none to count. */
static void tell_solve(FILE *details, const brc_stage *stage, const brc_trial_stage *t, double counted, double across,
                       sums *total)
{
    const char *what = stage->solver == BRC_SOLVER_MODES ? "rounds" : "iterations";
    const double iterations = counted > 0 ? counted : brc_price_iterations(stage, across),
                 fixed = t->enter_s + t->warm_s;
    if (!t->cut) {
        fprintf(details, "stage %s: %lld %s of %.3g s each: %.3g s (run to its end)\n", stage->name,
                (long long)t->iterations, what, t->pace_s, t->enter_s + t->whole_s);
        add(total, t->enter_s + t->whole_s, t->enter_s + t->whole_s, t->enter_s + t->whole_s);
        return;
    }
    const double seconds = t->pace_s * iterations;
    fprintf(details, "stage %s: about %.2g %s of %.3g s each: %.3g s (%s)\n", stage->name, iterations, what, t->pace_s,
            fixed + seconds, counted > 0 ? "counted on a coarser body" : "a rule of thumb");
    if (counted > 0)
        add(total, fixed + seconds, fixed + seconds, fixed + seconds);
    else
        add(total, fixed + seconds, fixed + thumb_least * seconds, fixed + thumb_most * seconds);
}

static bool is_solve(const brc_stage *stage)
{
    return stage->solver != BRC_SOLVER_DYNAMIC && stage->most_events == 0;
}

/* Elements of the coarser body over those of this one: so many that the longest of the cut solves takes countable_s, as
 * elements^(4/3). 0: no solve was cut. */
static double coarse_share(const brc_scene *scene, const brc_trial *trial, double across)
{
    double longest = 0;
    for (int32_t k = 0; k < trial->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        if (is_solve(stage) && trial->stages[k].cut)
            longest = fmax(longest, brc_price_iterations(stage, across) * trial->stages[k].pace_s);
    }
    return longest > 0 ? fmin(0.25, pow(countable_s / longest, 0.75)) : 0;
}

/* Elements of the coarser body on which what breaks or meets is looked at over those of this one; 0: nothing does, or
 * the trial saw the end of it. Events are as many in fewer elements, so that nothing follows from those. */
static double looked_share(const brc_scene *scene, const brc_setup *setup, const brc_trial *trial)
{
    const double n = (double)brc_setup_n_elements(setup);
    bool cut = false;
    for (int32_t k = 0; k < trial->n_stages; ++k)
        cut |= trial->stages[k].ran && trial->stages[k].cut && scene->stages[k].solver == BRC_SOLVER_DYNAMIC;
    if (!cut || worst_growth(scene) == 1) return 0;
    const double share = fmin(most_looked, pow(looked_s / (1.5 * brc_trial_seconds(trial)), 0.75));
    return share * n >= least_looked ? share : 0;
}

/* On the host, with so many more broken bonds than in the trial. */
static double host_with(const brc_scene *scene, const brc_trial *trial, double more)
{
    const bool drawn = !brc_model_traits_of(scene->model.kind)->spheres && scene->output.picture;
    const double stepping = (double)trial->stepping_bytes + more * host_of_break,
                 ending = (double)trial->ending_bytes + more * (event_of_break + (drawn ? drawn_of_break : 0));
    return fmax((double)trial->host_bytes, fmax(stepping, ending));
}

/* Beyond what the trial held. looked: on a coarser body, its shares NAN where nothing is known of it. */
typedef struct memory {
    double host, device, resident, disk;
} memory;

/* Bonds that break beyond those of the trial: by the end, and over all frames those that each of them has. */
typedef struct breaks {
    double more, in_frames;
} breaks;

/* Events: one breaks as many bonds as another. */
static breaks breaks_of_events(const brc_scene *scene, const brc_trial *trial)
{
    breaks b = {0};
    for (int32_t k = 0; k < trial->n_stages; ++k) {
        const brc_trial_stage *t = &trial->stages[k];
        if (!t->cut || scene->stages[k].most_events == 0 || t->done < 1) continue;
        const double more = (double)t->broken / (double)t->done * (double)(t->planned - t->done);
        b.more += more;
        b.in_frames += 0.5 * more * (double)t->frames_planned;
    }
    return b;
}

/* The last frame has all of them, the others some on average, of which the trial's had a few. */
static breaks breaks_of_look(const brc_setup *setup, const brc_trial *trial, const brc_coarse *looked)
{
    const double n_bonds = (double)brc_setup_n_bonds(setup),
                 mean = fmax(0, looked->broken_mean * n_bonds - 0.5 * (double)trial->n_broken);
    const double more = fmax(0, looked->broken * n_bonds - (double)trial->n_broken);
    double frames = 0;
    for (int32_t k = 0; k < trial->n_stages; ++k)
        frames += (looked->done[k] > 0 ? fmin(looked->done[k], 1) : 1) * (double)trial->stages[k].frames_planned;
    return (breaks){.more = more, .in_frames = frames > 1 ? mean * (frames - 1) + more : more * frames};
}

/* Cells written anew in all frames that the trial did not see. */
static double cells_anew(const brc_setup *setup, const brc_trial *trial)
{
    double n = 0;
    for (int32_t k = 0; k < trial->n_stages; ++k)
        if (trial->stages[k].cut) n += fmax(0, (double)(trial->stages[k].frames_planned - trial->stages[k].frames));
    return n * cell_anew * (double)brc_setup_n_elements(setup);
}

static memory add_up(const brc_scene *scene, const brc_setup *setup, const brc_trial *trial, const brc_coarse *looked)
{
    const bool was_looked = !isnan(looked->broken);
    memory m = {(double)trial->host_bytes, (double)trial->device_bytes[1], (double)trial->resident_bytes,
                (double)brc_trial_disk(trial, was_looked ? looked->done : NULL)};
    if (!scene->has_fracture) return m;
    const breaks b = was_looked ? breaks_of_look(setup, trial, looked) : breaks_of_events(scene, trial);
    const double device = was_looked && looked->grown > 0
                              ? fmax(0, looked->grown * (double)trial->device_bytes[0] - m.device)
                              : 0,
                 host = host_with(scene, trial, b.more) - m.host;
    m.host += host;
    m.device += device;
    m.resident += host + device; /* of the cpu device; a card has its own */
    m.disk += b.more * row_of_break;
    if (!brc_model_traits_of(scene->model.kind)->spheres)
        m.disk += b.in_frames * corners_of_break + (b.in_frames > 0 || !was_looked ? cells_anew(setup, trial) : 0);
    if (scene->output.crack_surface)
        m.disk += b.in_frames * (brc_model_traits_of(scene->model.kind)->spheres ? frame_of_beam : frame_of_face);
    return m;
}

static void tell_total(FILE *details, const brc_device_request *request, const memory *m, const sums *total)
{
    fprintf(details, "predicted: %.3g s of %s time with building and output", total->seconds,
            brc_pace_clock_name(request));
    if (total->ranged) fprintf(details, ", from %.3g to %.3g s", total->least, total->most);
    fprintf(details, "; %.4g MB on the host, %.4g MB on the device, %.4g MB resident; %.4g MB on disk\n", m->host / 1e6,
            m->device / 1e6, m->resident / 1e6, m->disk / 1e6);
}

/* What was looked at, and what it would be if everything broke. */
static void tell_broken(FILE *details, const brc_scene *scene, const brc_setup *setup, const brc_trial *trial,
                        const brc_coarse *looked)
{
    const double n_bonds = (double)brc_setup_n_bonds(setup), frame = brc_model_traits_of(scene->model.kind)->spheres
                                                                         ? frame_of_beam
                                                                         : frame_of_face + corners_of_break;
    const double anew =
        brc_model_traits_of(scene->model.kind)->spheres ? 0 : cell_anew * (double)brc_setup_n_elements(setup);
    int64_t n_frames = 0;
    for (int32_t k = 0; k < trial->n_stages; ++k)
        n_frames += trial->stages[k].frames_planned;
    if (!scene->has_fracture) return;
    if (!isnan(looked->broken))
        fprintf(details, "broken bonds: about %.2g %% of all at the end, as with %lld elements\n", 100 * looked->broken,
                (long long)looked->n_elements);
    else if (brc_trial_is_whole(trial))
        fprintf(details, "broken bonds: %.3g %% of all at the end\n", 100 * (double)trial->n_broken / n_bonds);
    fprintf(details, "if all bonds broke: up to %.4g MB on the host and %.4g MB on disk\n",
            host_with(scene, trial, n_bonds) / 1e6,
            ((double)brc_trial_disk(trial, NULL) + (row_of_break + frame * (double)n_frames) * n_bonds +
             anew * (double)n_frames) /
                1e6);
}

brc_status brc_price_tell_trial(brc_context *context, brc_scene *scene, const brc_setup *setup,
                                const brc_device_request *request, const brc_trial *trial, double before_s,
                                FILE *details, brc_prediction_told *told)
{
    const double across = brc_setup_across(setup), share = coarse_share(scene, trial, across),
                 look = trial->stopped ? 0 : looked_share(scene, setup, trial);
    sums total = {0};
    brc_coarse coarse = {0}, looked = {.broken = NAN};
    brc_status status = BRC_OK;
    *told = (brc_prediction_told){.seconds = NAN};
    if (share > 0)
        BRC_TRY_OR(cleanup,
                   brc_trial_coarse(context, scene, request,
                                    &(brc_coarse_request){.share = share, .stage_s = coarse_stage_s}, &coarse));
    if (look > 0)
        BRC_TRY_OR(cleanup,
                   brc_trial_coarse(
                       context, scene, request,
                       &(brc_coarse_request){.trial = trial, .share = look, .whole = true, .stage_s = coarse_stage_s},
                       &looked));
    add(&total, before_s + trial->end_s, before_s + trial->end_s, before_s + trial->end_s);
    for (int32_t k = 0; k < trial->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        const brc_trial_stage *t = &trial->stages[k];
        if (!t->ran) continue;
        const double grown =
            coarse.across > 0 && brc_price_iterations_grow(stage, coarse.across) ? across / coarse.across : 1;
        if (is_solve(stage))
            tell_solve(details, stage, t, coarse.across > 0 ? (double)coarse.iterations[k] * grown : 0, across, &total);
        else if (stage->most_events > 0)
            tell_events(details, stage, t, &total);
        else
            tell_dynamic(details, scene, setup, stage, t, looked.slower ? looked.slower[k] : NAN,
                         looked.done ? looked.done[k] : NAN, &total);
    }
    if (trial->stopped) {
        fprintf(details, "predicted: nothing, the trial was stopped: %s\n", trial->reason);
        goto cleanup;
    }
    const memory m = add_up(scene, setup, trial, &looked);
    tell_total(details, request, &m, &total);
    tell_broken(details, scene, setup, trial, &looked);
    *told = (brc_prediction_told){.known = true,
                                  .processor_time = brc_pace_is_processor(request),
                                  .seconds = total.seconds,
                                  .least_seconds = total.least,
                                  .most_seconds = total.most,
                                  .step_seconds = total.step_seconds,
                                  .steps = total.steps,
                                  .host_bytes = m.host,
                                  .device_bytes = m.device,
                                  .resident_bytes = m.resident,
                                  .disk_bytes = m.disk};
cleanup:
    brc_coarse_free(&coarse);
    brc_coarse_free(&looked);
    return status;
}
