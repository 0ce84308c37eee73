/* summary.json. Keys appear in every file, with null where a run did not come that far, so that scripts need no
 * guards. */
#include "summary.h"
#include "text.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/version.h"
#include "../solver/effects/guard.h"
#include "../solver/run/stage_end.h"
#include "../solver/effects/strikers/strikers.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *end_name(const brc_summary *summary)
{
    if (summary->running) return "running";
    switch (summary->end) {
    case BRC_OK: return "done";
    case BRC_PHYSICS_STOPPED: return "physics_stopped";
    case BRC_BOUND_MISSED: return "bound_missed";
    case BRC_BAD_INPUT: return "bad_input";
    case BRC_NO_MEMORY: return "no_memory";
    case BRC_DEVICE_FAILED: return "device_failed";
    case BRC_FILE_FAILED: return "file_failed";
    case BRC_INTERRUPTED: return "interrupted";
    case BRC_INTERNAL: break;
    }
    return "internal";
}

/* The kinds of models that bodies ask for, of a run that did not come to simulations. */
static const char *asked_models(const brc_scene *scene, char *words, size_t room)
{
    bool told[BRC_N_MODELS] = {false};
    words[0] = '\0';
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        const brc_model_kind kind = scene->bodies[b].has_model ? scene->bodies[b].model.kind : scene->model.kind;
        const size_t at = strlen(words);
        if (!told[kind]) snprintf(words + at, room - at, "%s%s", at > 0 ? ", " : "", brc_model_name(kind));
        told[kind] = true;
    }
    return words;
}

static void add_identity(brc_json *json, const brc_summary *s)
{
    const brc_device *device = s->assembly ? brc_simulation_device(s->assembly->part[0]) : NULL;
    char name[256] = "", models[256];
    if (device) {
        const brc_device_info *info = brc_device_get_info(device);
        snprintf(name, sizeof name, "%s (%s)", info->selector, info->name);
    }
    brc_json_string(json, "version", brc_version());
    brc_json_string(json, "commit", brc_version_commit());
    brc_json_string(json, "title", s->scene ? s->scene->title : NULL);
    brc_json_string(json, "model",
                    s->assembly ? brc_assembly_models(s->assembly, models, sizeof models)
                    : s->scene  ? asked_models(s->scene, models, sizeof models)
                                : NULL);
    brc_json_string(json, "precision", device ? brc_precision_name(brc_device_get_precision(device)) : NULL);
    brc_json_string(json, "device", device ? name : NULL);
}

static void add_counts(brc_json *json, int32_t n, const brc_domain *const *domains, int64_t n_broken)
{
    int64_t n_elements = 0, n_bonds = 0;
    for (int32_t k = 0; k < n; ++k) {
        n_elements += domains[k]->n_elements;
        n_bonds += domains[k]->n_bonds;
    }
    brc_json_begin_object(json, "counts");
    if (n > 0) {
        brc_json_integer(json, "elements", n_elements);
        brc_json_integer(json, "bonds", n_bonds);
        brc_json_integer(json, "broken", n_broken);
    } else {
        brc_json_null(json, "elements");
        brc_json_null(json, "bonds");
        brc_json_null(json, "broken");
    }
    brc_json_end(json);
}

static void add_time_step(brc_json *json, const brc_time_step *step)
{
    const bool stepped = step->value > 0; /* a static stage has none */
    brc_json_begin_object(json, "time_step");
    brc_json_number(json, "value_s", stepped ? step->value : NAN);
    brc_json_string(json, "governed_by", stepped ? step->governed_by : NULL);
    brc_json_number(json, "safety", stepped && step->critical > 0 ? step->safety : NAN);
    brc_json_number(json, "critical_s", step->critical > 0 ? step->critical : NAN);
    brc_json_number(json, "published_s", step->published > 0 ? step->published : NAN);
    brc_json_end(json);
}

static void add_size(brc_json *json, const brc_summary *s)
{
    brc_time_step step = {.value = NAN, .critical = NAN, .published = NAN, .safety = NAN};
    add_counts(json, s->n_domains, s->domains, s->cracks ? s->cracks->cracks.n_broken : 0);
    if (s->assembly) step = brc_assembly_time_step(s->assembly);
    add_time_step(json, &step);
    if (s->assembly)
        brc_json_integer(json, "steps", brc_simulation_total_steps(s->assembly->part[0]));
    else
        brc_json_null(json, "steps");
    brc_json_integer(json, "frames", s->n_frames);
}

static void add_memory(brc_json *json, int64_t device_bytes)
{
    brc_json_begin_object(json, "memory");
    brc_json_integer(json, "host_bytes", brc_memory_peak());
    brc_json_integer(json, "resident_bytes", brc_memory_resident());
    if (device_bytes >= 0)
        brc_json_integer(json, "device_bytes", device_bytes);
    else
        brc_json_null(json, "device_bytes");
    brc_json_end(json);
}

static void add_cost(brc_json *json, const brc_summary *s)
{
    double setup = NAN, steps = NAN, rate = NAN;
    if (s->assembly) {
        const brc_assembly *a = s->assembly;
        setup = brc_assembly_setup_seconds(a);
        steps = brc_simulation_step_seconds(a->part[0]);
        const double updates =
            (double)brc_simulation_total_steps(a->part[0]) * (double)brc_assembly_first_bond(a, a->n);
        if (updates > 0 && steps > 0) rate = updates / steps;
    }
    brc_json_begin_object(json, "timing");
    brc_json_number(json, "total_s", s->total_s);
    brc_json_number(json, "processor_s", brc_processor_s());
    brc_json_number(json, "build_s", s->build_s);
    brc_json_number(json, "setup_s", setup);
    brc_json_number(json, "steps_s", steps);
    brc_json_number(json, "output_s", s->output_s);
    brc_json_number(json, "bond_updates_per_s", rate);
    brc_json_number(json, "at_rest", s->assembly ? brc_assembly_at_rest(s->assembly) : NAN);
    brc_json_begin_object(json, "phases");
    for (int phase = BRC_PHASE_NONE + 1; phase < BRC_N_PHASES; ++phase) {
        char key[32];
        snprintf(key, sizeof key, "%s_s", brc_phase_name((brc_step_phase)phase));
        brc_json_number(json, key, s->assembly ? brc_assembly_phase_seconds(s->assembly, (brc_step_phase)phase) : NAN);
    }
    brc_json_end(json);
    brc_json_end(json);
    add_memory(json, s->assembly ? brc_assembly_device_bytes(s->assembly) : -1);
}

/* What check told, and what the run took. */
static void add_told(brc_json *json, const brc_summary *s, const brc_prediction_told *told)
{
    brc_json_begin_object(json, "check");
    brc_json_boolean(json, "processor_time", told->processor_time);
    brc_json_number(json, "seconds", told->seconds);
    brc_json_number(json, "least_seconds", told->least_seconds);
    brc_json_number(json, "most_seconds", told->most_seconds);
    brc_json_number(json, "actual_seconds", told->processor_time ? brc_processor_s() : s->total_s);
    brc_json_number(json, "host_bytes", told->host_bytes);
    brc_json_number(json, "actual_host_bytes", (double)brc_memory_peak());
    brc_json_number(json, "device_bytes", told->device_bytes);
    brc_json_number(json, "actual_device_bytes", s->assembly ? (double)brc_assembly_device_bytes(s->assembly) : NAN);
    brc_json_number(json, "resident_bytes", told->resident_bytes);
    brc_json_number(json, "actual_resident_bytes", (double)brc_memory_resident());
    brc_json_number(json, "disk_bytes", told->disk_bytes);
    brc_json_end(json);
}

/* What the run was expected to cost, and what it did. */
static void add_prediction(brc_json *json, const brc_summary *s)
{
    const brc_prediction none = {.seconds = NAN, .took_seconds = NAN}, *p = s->prediction ? s->prediction : &none;
    brc_json_begin_object(json, "prediction");
    brc_json_integer(json, "after_steps", p->after_steps);
    brc_json_number(json, "seconds", p->seconds);
    brc_json_number(json, "actual_seconds", p->took_seconds);
    brc_json_number(json, "host_bytes", s->prediction ? (double)p->host_bytes : NAN);
    brc_json_number(json, "actual_host_bytes", s->prediction ? (double)brc_memory_peak() : NAN);
    brc_json_number(json, "device_bytes", s->prediction ? (double)p->device_bytes : NAN);
    brc_json_number(json, "actual_device_bytes",
                    s->prediction && s->assembly ? (double)brc_assembly_device_bytes(s->assembly) : NAN);
    if (p->told.known) add_told(json, s, &p->told);
    brc_json_end(json);
}

/* How often the guard looked; null before the first dynamic stage. */
static void add_guard(brc_json *json, const brc_assembly *a)
{
    const brc_guard_report report = a ? brc_simulation_guard_report(a->part[0]) : (brc_guard_report){0};
    brc_json_begin_object(json, "guard");
    if (report.every > 0) {
        brc_json_integer(json, "every", report.every);
        brc_json_integer(json, "ledger_every", report.ledger_every);
    } else {
        brc_json_null(json, "every");
        brc_json_null(json, "ledger_every");
    }
    brc_json_integer(json, "looks", report.probes);
    brc_json_integer(json, "ledgers", report.ledgers);
    brc_json_end(json);
}

static void add_ledger(brc_json *json, const brc_ledger *ledger)
{
    const brc_ledger none = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const brc_ledger *l = ledger ? ledger : &none;
    brc_json_begin_object(json, "ledger");
    brc_json_number(json, "kinetic_J", l->kinetic);
    brc_json_number(json, "elastic_J", l->elastic);
    brc_json_number(json, "stabilisation_J", l->stabilisation);
    brc_json_number(json, "potential_J", l->potential);
    brc_json_number(json, "work_J", l->work);
    brc_json_number(json, "damping_J", l->damping);
    brc_json_number(json, "numerical_J", l->numerical);
    brc_json_number(json, "contact_J", l->contact);
    brc_json_number(json, "friction_J", l->friction);
    brc_json_number(json, "impact_J", l->impact);
    brc_json_number(json, "fracture_J", l->fracture);
    brc_json_number(json, "initial_J", l->initial);
    brc_json_number(json, "total_J", l->total);
    brc_json_number(json, "closure", l->closure);
    brc_json_number(json, "peak_elastic_J", l->peak_elastic);
    brc_json_number(json, "peak_kinetic_J", l->peak_kinetic);
    brc_json_end(json);
}

static void add_names(brc_json *json, const char *key, const char *const *names)
{
    brc_json_begin_array(json, key);
    for (; names && *names; ++names)
        brc_json_string(json, NULL, *names);
    brc_json_end(json);
}

static bool is_named(const char *const *names, const char *name)
{
    for (; names && *names; ++names)
        if (strcmp(*names, name) == 0) return true;
    return false;
}

/* Effects of the parts before k hold this one in. */
static bool in_before(const brc_assembly *a, int32_t k, const char *name)
{
    for (int32_t other = 0; other < k; ++other)
        if (is_named(brc_simulation_effects_in(a->part[other]), name)) return true;
    return false;
}

static void add_effects(brc_json *json, const brc_assembly *a)
{
    brc_json_begin_object(json, "effects");
    brc_json_begin_array(json, "in");
    for (int32_t k = 0; a && k < a->n; ++k)
        for (const char *const *name = brc_simulation_effects_in(a->part[k]); *name; ++name)
            if (!in_before(a, k, *name)) brc_json_string(json, NULL, *name);
    brc_json_end(json);
    brc_json_begin_array(json, "out"); /* every part lists all effects, in or out */
    for (const char *const *name = a ? brc_simulation_effects_out(a->part[0]) : NULL; name && *name; ++name)
        if (!in_before(a, a->n, *name)) brc_json_string(json, NULL, *name);
    brc_json_end(json);
    brc_json_end(json);
}

/* One object a model, where there are several. The ledgers are left out where the whole's is: the device cannot be
 * asked any more. */
static void add_parts(brc_json *json, const brc_summary *s)
{
    const brc_assembly *a = s->assembly;
    if (!a || a->n == 1) return;
    brc_json_begin_array(json, "parts");
    for (int32_t k = 0; k < a->n; ++k) {
        const brc_scene_part *part = &a->split->part[k];
        const brc_domain *const domain = brc_simulation_domain(a->part[k]);
        const brc_time_step step = brc_simulation_time_step(a->part[k]);
        const int64_t first = brc_assembly_first_bond(a, k), end = brc_assembly_first_bond(a, k + 1);
        int64_t n_broken = 0;
        brc_ledger ledger;
        for (int64_t b = 0; s->cracks && b < s->cracks->cracks.n_broken; ++b)
            n_broken += s->cracks->cracks.breaks[b].bond >= first && s->cracks->cracks.breaks[b].bond < end;
        const bool has_ledger = s->ledger && brc_simulation_ledger(a->part[k], &ledger) == BRC_OK;
        brc_json_begin_object(json, NULL);
        brc_json_string(json, "model", part->name);
        brc_json_begin_array(json, "bodies");
        for (int32_t b = 0; b < part->n_bodies; ++b)
            brc_json_string(json, NULL, s->scene->bodies[part->body[b]].name);
        brc_json_end(json);
        add_counts(json, 1, &domain, n_broken);
        add_time_step(json, &step);
        add_ledger(json, has_ledger ? &ledger : NULL);
        add_memory(json, brc_device_bytes(brc_simulation_device(a->part[k])));
        brc_json_begin_object(json, "effects");
        add_names(json, "in", brc_simulation_effects_in(a->part[k]));
        add_names(json, "out", brc_simulation_effects_out(a->part[k]));
        brc_json_end(json);
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_measures(brc_json *json, const brc_summary *s)
{
    brc_json_begin_object(json, "measures");
    for (int32_t m = 0; m < s->n_measures; ++m) {
        const brc_measured *measured = &s->measures[m];
        brc_json_begin_object(json, measured->name);
        brc_json_number(json, "value", measured->value);
        brc_json_string(json, "unit", measured->unit);
        brc_json_number(json, "target", measured->has_target ? measured->target : NAN);
        brc_json_number(json, "error", measured->has_target ? measured->error : NAN);
        if (measured->why_not[0]) brc_json_string(json, "why_not", measured->why_not);
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_sensors(brc_json *json, const brc_summary *s)
{
    brc_json_begin_object(json, "sensors");
    for (int32_t k = 0; s->scene && k < s->scene->n_sensors; ++k) {
        double last = NAN, smallest = NAN, largest = NAN;
        if (s->history) brc_history_range(s->history, k, &last, &smallest, &largest);
        brc_json_begin_object(json, s->scene->sensors[k].name);
        brc_json_number(json, "last", last);
        brc_json_number(json, "min", smallest);
        brc_json_number(json, "max", largest);
        brc_json_string(json, "unit", brc_sensor_unit(&s->scene->sensors[k]));
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_vector(brc_json *json, const char *key, const double v[3])
{
    brc_json_begin_array(json, key);
    for (int c = 0; c < 3; ++c)
        brc_json_number(json, NULL, v[c]);
    brc_json_end(json);
}

/* Where walls and strikers are at the end; left out where the ledger is: the device cannot be asked any more. */
static void add_strikers(brc_json *json, const brc_summary *s)
{
    const int32_t n = s->assembly && s->ledger ? brc_simulation_n_strikers(s->assembly->part[0]) : 0;
    if (n == 0) return;
    brc_json_begin_object(json, "strikers");
    for (int32_t k = 0; k < n; ++k) {
        brc_striker_now now;
        if (brc_simulation_striker_now(s->assembly->part[0], k, &now) != BRC_OK) continue;
        brc_json_begin_object(json, s->scene->strikers[k].name);
        brc_json_number(json, "mass_kg", brc_simulation_striker_body(s->assembly->part[0], k)->mass);
        add_vector(json, "position_m", now.position);
        add_vector(json, "displacement_m", now.displacement);
        add_vector(json, "rotation_rad", now.rotation);
        add_vector(json, "velocity_m_per_s", now.velocity);
        add_vector(json, "spin_rad_per_s", now.spin);
        add_vector(json, "force_N", now.force);
        add_vector(json, "torque_N_m", now.torque);
        brc_json_number(json, "kinetic_J", now.kinetic);
        brc_json_end(json);
    }
    brc_json_end(json);
}

/* Of the last stage, where it was solved rather than stepped; of several parts the sums and the largest residual. */
static void add_static(brc_json *json, const brc_summary *s)
{
    const int32_t stage = s->assembly ? brc_simulation_stage(s->assembly->part[0]) : -1;
    if (stage < 0 || !s->scene || s->scene->stages[stage].solver != BRC_SOLVER_STATIC) return;
    brc_static_report report = {0};
    for (int32_t k = 0; k < s->assembly->n; ++k) {
        const brc_static_report one = brc_simulation_static_report(s->assembly->part[k]);
        report.iterations += one.iterations;
        report.corrections += one.corrections;
        report.residual = k == 0 ? one.residual : fmax(report.residual, one.residual);
    }
    brc_json_begin_object(json, "static");
    brc_json_integer(json, "iterations", report.iterations);
    brc_json_integer(json, "corrections", report.corrections);
    brc_json_number(json, "residual", report.residual);
    brc_json_end(json);
}

/* Stages that were begun, and why they ended before their plan, if they did. */
static void add_stages(brc_json *json, const brc_summary *s)
{
    const int32_t last = s->assembly ? brc_simulation_stage(s->assembly->part[0]) : -1;
    brc_json_begin_array(json, "stages");
    for (int32_t k = 0; s->scene && k <= last; ++k) {
        brc_json_begin_object(json, NULL);
        brc_json_string(json, "name", s->scene->stages[k].name);
        brc_json_string(json, "ended_by", brc_simulation_stage_reason(s->assembly->part[0], k));
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_checkpoints(brc_json *json, const brc_checkpoint_report *c)
{
    const bool resumed = c->from && c->from[0];
    brc_json_begin_object(json, "checkpoints");
    brc_json_integer(json, "written", c->n_written);
    brc_json_number(json, "seconds", c->seconds);
    brc_json_integer(json, "bytes", c->bytes);
    brc_json_string(json, "last", c->last && c->last[0] ? c->last : NULL);
    brc_json_string(json, "from", resumed ? c->from : NULL);
    if (resumed)
        brc_json_integer(json, "from_step", c->from_step);
    else
        brc_json_null(json, "from_step");
    brc_json_end(json);
}

brc_status brc_summary_write(brc_context *context, const brc_summary *summary, const char *path)
{
    brc_json json = {.text = {.context = context}};
    brc_json_begin_object(&json, NULL);
    add_identity(&json, summary);
    add_size(&json, summary);
    add_cost(&json, summary);
    add_prediction(&json, summary);
    add_guard(&json, summary->assembly);
    add_ledger(&json, summary->ledger);
    if (summary->cracks)
        brc_crack_report_add(&json, summary->scene, &summary->cracks->cracks, &summary->cracks->report);
    add_effects(&json, summary->assembly);
    add_measures(&json, summary);
    add_sensors(&json, summary);
    add_strikers(&json, summary);
    add_static(&json, summary);
    add_stages(&json, summary);
    add_parts(&json, summary);
    add_checkpoints(&json, &summary->checkpoints);
    brc_json_begin_object(&json, "end");
    brc_json_string(&json, "status", end_name(summary));
    brc_json_string(&json, "reason", summary->reason ? summary->reason : "");
    brc_json_integer(&json, "exit_code", summary->running ? 0 : brc_status_exit_code(summary->end));
    return brc_json_write(&json, path);
}
