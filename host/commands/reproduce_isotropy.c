/* Directions of bonds in samples that differ by their seed alone: each number as the mean over the samples and how it
 * scatters, every bond counted once and weighted with face area; and the histograms of the first samples as a picture. */
#include "reproduce.h"
#include "scene_domain.h"
#include "../output/isotropy_picture.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <math.h>
#include <string.h>

enum { LEVEL = 3, COLUMNS = 5 };

enum { FABRIC, CUBIC, WORST, RMS, NOISE, EXCESS, NUMBERS };
static const char *const number_names[NUMBERS] = {"fabric_anisotropy", "cubic", "worst_bin", "rms_bin", "noise", "excess"};

static void numbers_of(const brc_isotropy *i, double out[NUMBERS])
{
    const double numbers[NUMBERS] = {i->fabric_anisotropy, i->cubic, i->worst_bin, i->rms_bin, i->noise, i->excess};
    memcpy(out, numbers, sizeof numbers);
}

/* Sums over samples. */
typedef struct tally {
    int n;
    double sum[NUMBERS], square[NUMBERS];
} tally;

static void add_sample(tally *t, const brc_isotropy *i)
{
    double x[NUMBERS];
    numbers_of(i, x);
    ++t->n;
    for (int k = 0; k < NUMBERS; ++k) {
        t->sum[k] += x[k];
        t->square[k] += x[k] * x[k];
    }
}

/* "<number>" or "<number>_area"; even directions would give the noise as rms_bin. What exceeds the noise is taken from the mean
 * squares: of a single sample it is cut off at 0 and so, on average, too large where the noise prevails. */
static void add_values(const tally *t, const char *suffix, brc_outcome *outcome)
{
    for (int k = 0; k < NUMBERS; ++k) {
        char name[BRC_NAME];
        const double mean = t->sum[k] / t->n, variance = t->n > 1 ? (t->square[k] - t->n * mean * mean) / (t->n - 1) : NAN;
        const double value = k == EXCESS ? sqrt(fmax(t->square[RMS] - t->square[NOISE], 0) / t->n) : mean;
        snprintf(name, sizeof name, "%s%s", number_names[k], suffix);
        brc_outcome_add(outcome, name, "-", value, k == RMS ? t->sum[NOISE] / t->n : NAN);
        outcome->values[outcome->n_values - 1].scatter = isnan(variance) ? NAN : sqrt(fmax(variance, 0));
    }
}

/* One sample: built, counted; the first one's histograms are kept. */
static brc_status take_sample(brc_context *context, brc_scene *scene, int n_threads, bool first, tally tallies[2], brc_outcome *outcome)
{
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_scene_domain_build(context, scene, n_threads, &domain));
    const int kinds = domain->element_kind == BRC_ELEMENT_CELL ? 2 : 1;
    for (int k = 0; k < kinds; ++k) {
        brc_isotropy isotropy;
        BRC_TRY_OR(cleanup, brc_isotropy_measure(context, domain, LEVEL, (brc_isotropy_weight)k, n_threads, &isotropy));
        add_sample(&tallies[k], &isotropy);
        if (first)
            outcome->isotropy[k] = isotropy;
        else
            brc_isotropy_free(&isotropy);
    }
    outcome->n_elements = domain->n_elements;
    outcome->n_bonds = domain->n_bonds;
cleanup:
    brc_domain_free(&domain);
    return status;
}

brc_status brc_isotropy_values(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes)
{
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    tally tallies[2] = {{0}, {0}};
    const double start = brc_clock_s();
    BRC_TRY(brc_scene_read_text(context, name, text, bytes, run->n_overrides, run->overrides, &scene));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &outcome->isotropy, 2, "histograms of a run"));
    for (int k = 0; k < run->n_seeds; ++k) {
        const int n_threads = run->n_threads > 0 ? run->n_threads : campaign->n_threads;
        BRC_TRY_OR(cleanup, take_sample(context, scene, n_threads, k == 0, tallies, outcome));
        for (int32_t b = 0; b < scene->n_bodies; ++b)
            ++scene->bodies[b].fill.seed;
    }
    outcome->seconds = brc_clock_s() - start;
    add_values(&tallies[0], "", outcome);
    if (tallies[1].n > 0) add_values(&tallies[1], "_area", outcome);
    brc_outcome_add(outcome, "seconds", "s", outcome->seconds, NAN);
    brc_outcome_add(outcome, "elements", "-", (double)outcome->n_elements, NAN);
    brc_outcome_add(outcome, "bonds", "-", (double)outcome->n_bonds, NAN);
cleanup:
    brc_scene_free(&scene);
    return status;
}

void brc_isotropy_forget(brc_outcome *outcome)
{
    for (int k = 0; outcome->isotropy && k < 2; ++k)
        brc_isotropy_free(&outcome->isotropy[k]);
    brc_memory_free(outcome->isotropy);
    outcome->isotropy = NULL;
}

/* The histograms of one kind side by side, in the order of the runs. */
static brc_status draw(brc_campaign *campaign, int kind, brc_isotropy_panel *panels)
{
    brc_context *context = campaign->session->context;
    char name[160], title[160], *path = NULL;
    int n = 0;
    for (int k = 0; k < campaign->what->n_runs; ++k) {
        const brc_outcome *outcome = &campaign->outcomes[k];
        if (!outcome->done || !outcome->isotropy || outcome->isotropy[kind].n_bins == 0 || outcome->run->quick != campaign->quick) continue;
        const brc_isotropy *i = &outcome->isotropy[kind];
        brc_isotropy_panel *panel = &panels[n++];
        panel->isotropy = i;
        snprintf(panel->title, sizeof panel->title, "%s", outcome->run->n_labels > 0 ? outcome->run->labels[0].value : outcome->run->name);
        snprintf(panel->note, sizeof panel->note, "rms %.3f, cubic order %.3f", i->rms_bin, i->cubic);
    }
    if (n == 0) return BRC_OK;
    snprintf(name, sizeof name, "%s%s.png", campaign->what->name, kind == BRC_ISOTROPY_AREA ? "-area" : "");
    snprintf(title, sizeof title, "Directions of faces, %s", kind == BRC_ISOTROPY_AREA ? "weighted with their area" : "every face once");
    BRC_TRY(brc_file_join(context, campaign->folder, name, &path));
    const brc_status status = brc_isotropy_montage(context, n, panels, n < COLUMNS ? n : COLUMNS, title, path);
    brc_memory_free(path);
    return status;
}

brc_status brc_isotropy_figures(brc_campaign *campaign)
{
    brc_isotropy_panel *panels;
    BRC_TRY(BRC_ALLOCATE(campaign->session->context, &panels, campaign->what->n_runs, "panels of a figure"));
    brc_status status = draw(campaign, BRC_ISOTROPY_BONDS, panels);
    if (status == BRC_OK) status = draw(campaign, BRC_ISOTROPY_AREA, panels);
    brc_memory_free(panels);
    return status;
}
