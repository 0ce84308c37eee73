/* Directions of bonds in samples that differ by their seed alone: each number as the mean over the samples and how it
 * scatters, every bond counted once and weighted with face area, of the whole samples and inside, where walls do not
 * reach; and the histograms of the first samples as a picture. */
#include "operators.h"
#include "../scene_domain.h"
#include "../../output/pictures/isotropy_picture.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

/* Spheres packed against a wall stand in layers that are lost after about three diameters. */
enum { LEVEL = 3, COLUMNS = 5, LAYERS = 3 };

enum { FABRIC, CUBIC, WORST, RMS, NOISE, EXCESS, NUMBERS };
static const char *const number_names[NUMBERS] = {"fabric_anisotropy", "cubic", "worst_bin",
                                                  "rms_bin",           "noise", "excess"};

/* What is counted: kind k has the weight k % 2, inside where k >= 2. */
enum { KINDS = 4 };
static const char *const kind_suffix[KINDS] = {"", "_area", "_inside", "_area_inside"};

static void numbers_of(const brc_isotropy *i, double out[NUMBERS])
{
    const double numbers[NUMBERS] = {i->fabric_anisotropy, i->cubic, i->worst_bin, i->rms_bin, i->noise, i->excess};
    memcpy(out, numbers, sizeof numbers);
}

/* Sums over samples. */
typedef struct tally {
    int n;
    double sum[NUMBERS], square[NUMBERS];
    int32_t n_bins;
    double *off;   /* [n_bins] density - 1; owned */
    double *share; /* [n_bins] solid angle over that of the sphere; owned */
} tally;

static brc_status add_sample(brc_context *context, tally *t, const brc_isotropy *i)
{
    double x[NUMBERS];
    if (t->n == 0) {
        t->n_bins = i->n_bins;
        BRC_TRY(BRC_ALLOCATE(context, &t->off, t->n_bins, "bins of directions"));
        BRC_TRY(BRC_ALLOCATE(context, &t->share, t->n_bins, "bins of directions"));
    }
    for (int32_t b = 0; b < t->n_bins; ++b) {
        t->off[b] += i->density[b] - 1;
        t->share[b] = i->solid_angle[b] / (4 * M_PI);
    }
    numbers_of(i, x);
    ++t->n;
    for (int k = 0; k < NUMBERS; ++k) {
        t->sum[k] += x[k];
        t->square[k] += x[k] * x[k];
    }
    return BRC_OK;
}

/* What samples have in common: the root of the mean product of the deviations of two different samples, over all pairs.
 * Chance, however strongly directions of one sample depend on each other, has the mean 0. NAN for one sample; 0 where
 * the mean is negative. */
static double common(const tally *t)
{
    double squares = 0;
    for (int32_t b = 0; b < t->n_bins; ++b)
        squares += t->share[b] * t->off[b] * t->off[b];
    return t->n > 1 ? sqrt(fmax(squares - t->square[RMS], 0) / (t->n * (t->n - 1.0))) : NAN;
}

/* "<number>", "<number>_area" and so on; even directions would give the noise as rms_bin. What exceeds the noise is
 * taken from the mean squares: of a single sample it is cut off at 0 and so, on average, too large where the noise
 * prevails. */
static void add_values(const tally *t, const char *suffix, brc_outcome *outcome)
{
    for (int k = 0; k < NUMBERS; ++k) {
        char name[BRC_NAME];
        const double mean = t->sum[k] / t->n,
                     variance = t->n > 1 ? (t->square[k] - t->n * mean * mean) / (t->n - 1) : NAN;
        const double value = k == EXCESS ? sqrt(fmax(t->square[RMS] - t->square[NOISE], 0) / t->n) : mean;
        snprintf(name, sizeof name, "%s%s", number_names[k], suffix);
        brc_outcome_add(outcome, name, "-", value, k == RMS ? t->sum[NOISE] / t->n : NAN);
        outcome->values[outcome->n_values - 1].scatter = isnan(variance) ? NAN : sqrt(fmax(variance, 0));
    }
    char name[BRC_NAME];
    snprintf(name, sizeof name, "common%s", suffix);
    brc_outcome_add(outcome, name, "-", common(t), NAN);
}

/* One sample: built, counted; the first one's histograms are kept. */
static brc_status take_sample(brc_context *context, brc_scene *scene, int n_threads, bool first, tally tallies[KINDS],
                              brc_outcome *outcome)
{
    brc_domain *domain = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_scene_domain_build(context, scene, n_threads, &domain));
    for (int k = 0; k < KINDS; ++k) {
        brc_isotropy isotropy;
        const brc_isotropy_weight weight = k % 2 ? BRC_ISOTROPY_AREA : BRC_ISOTROPY_BONDS;
        if (weight == BRC_ISOTROPY_AREA && domain->element_kind != BRC_ELEMENT_CELL) continue;
        BRC_TRY_OR(cleanup, brc_isotropy_measure_inside(context, domain, k < 2 ? 0 : LAYERS, LEVEL, weight, n_threads,
                                                        &isotropy));
        status = add_sample(context, &tallies[k], &isotropy);
        if (first)
            outcome->isotropy[k] = isotropy;
        else
            brc_isotropy_free(&isotropy);
        if (status != BRC_OK) goto cleanup;
    }
    outcome->n_elements = domain->n_elements;
    outcome->n_bonds = domain->n_bonds;
cleanup:
    brc_domain_free(&domain);
    return status;
}

static brc_status obtain(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes,
                         const char *folder)
{
    (void)folder; /* no files */
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    brc_status status = BRC_OK;
    brc_scene *scene = NULL;
    tally tallies[KINDS] = {{0}};
    const double start = brc_clock_s();
    BRC_TRY(brc_scene_read_text(context, name, text, bytes, run->n_overrides, run->overrides, &scene));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &outcome->isotropy, KINDS, "histograms of a run"));
    for (int k = 0; k < run->n_seeds; ++k) {
        const int n_threads = run->n_threads > 0 ? run->n_threads : campaign->n_threads;
        BRC_TRY_OR(cleanup, take_sample(context, scene, n_threads, k == 0, tallies, outcome));
        for (int32_t b = 0; b < scene->n_bodies; ++b)
            ++scene->bodies[b].fill.seed;
    }
    outcome->seconds = brc_clock_s() - start;
    for (int k = 0; k < KINDS; ++k)
        if (tallies[k].n > 0) add_values(&tallies[k], kind_suffix[k], outcome);
    brc_outcome_add(outcome, "seconds", "s", outcome->seconds, NAN);
    brc_outcome_add(outcome, "elements", "-", (double)outcome->n_elements, NAN);
    brc_outcome_add(outcome, "bonds", "-", (double)outcome->n_bonds, NAN);
cleanup:
    for (int k = 0; k < KINDS; ++k) {
        brc_memory_free(tallies[k].off);
        brc_memory_free(tallies[k].share);
    }
    brc_scene_free(&scene);
    return status;
}

void brc_isotropy_forget(brc_outcome *outcome)
{
    for (int k = 0; outcome->isotropy && k < KINDS; ++k)
        brc_isotropy_free(&outcome->isotropy[k]);
    brc_memory_free(outcome->isotropy);
    outcome->isotropy = NULL;
}

/* The histograms of one kind side by side, in the order of the runs. */
static brc_status draw(brc_campaign *campaign, int kind, brc_isotropy_panel *panels)
{
    brc_context *context = campaign->session->context;
    static const char *const endings[KINDS] = {"", "-area", "-inside", "-area-inside"};
    char name[160], title[160], *path = NULL;
    int n = 0;
    for (int k = 0; k < campaign->what->n_runs; ++k) {
        const brc_outcome *outcome = &campaign->outcomes[k];
        if (!outcome->done || !outcome->isotropy || outcome->isotropy[kind].n_bins == 0 ||
            outcome->run->quick != campaign->quick)
            continue;
        const brc_isotropy *i = &outcome->isotropy[kind];
        brc_isotropy_panel *panel = &panels[n++];
        panel->isotropy = i;
        snprintf(panel->title, sizeof panel->title, "%s",
                 outcome->run->n_labels > 0 ? outcome->run->labels[0].value : outcome->run->name);
        snprintf(panel->note, sizeof panel->note, "rms %.3f, cubic order %.3f", i->rms_bin, i->cubic);
    }
    if (n == 0) return BRC_OK;
    snprintf(name, sizeof name, "%s%s.png", campaign->what->name, endings[kind]);
    snprintf(title, sizeof title, "Directions of faces, %s%s",
             kind % 2 ? "weighted with their area" : "every face once",
             kind >= 2 ? ", three layers of cells away from the walls" : "");
    BRC_TRY(brc_file_join(context, campaign->folder, name, &path));
    const brc_status status = brc_isotropy_montage(context, n, panels, n < COLUMNS ? n : COLUMNS, title, path);
    brc_memory_free(path);
    return status;
}

static brc_status figures(brc_campaign *campaign)
{
    brc_isotropy_panel *panels;
    BRC_TRY(BRC_ALLOCATE(campaign->session->context, &panels, campaign->what->n_runs, "panels of a figure"));
    brc_status status = BRC_OK;
    for (int kind = 0; status == BRC_OK && kind < KINDS; ++kind)
        status = draw(campaign, kind, panels);
    brc_memory_free(panels);
    return status;
}

/* The isotropy operator: build run->n_seeds samples of the scene (a text, its name a path) and add fabric_anisotropy,
 * cubic, worst_bin, rms_bin (reference: noise), noise, excess, means with their scatter, and common (what the samples
 * share: chance falls out); the same with _area (weighted with it), _inside (three layers away from walls) and
 * _area_inside. Figures: <case>.png, <case>-area.png, <case>-inside.png, <case>-area-inside.png. */
const brc_operator brc_operator_isotropy = {.name = "isotropy", .obtain = obtain, .figure = figures};
