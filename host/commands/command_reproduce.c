/* breccia reproduce: a table or figure of the papers, or a claim of ours, side by side with what comes out. */
#include "reproduce/operators.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the results (default results/CASE)"),
    {"list", 'l', NULL, false, "name the cases"},
    {"quick", 'q', NULL, false, "only the rows small enough for continuous integration"},
    {"folder", 'f', "DIR", false, "read the cases from DIR/CASE/case.yaml instead of from the program"},
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    BRC_OPTION_THREADS,
    BRC_OPTION_EXACT,
};

static brc_status print_cases(brc_context *context)
{
    const char *path;
    for (int k = 0; (path = brc_case_name(k)); ++k) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)(strchr(path, '/') - path), path);
        brc_case *what;
        BRC_TRY(brc_case_read(context, NULL, name, &what));
        int quick = 0;
        for (int r = 0; r < what->n_runs; ++r)
            quick += what->runs[r].quick;
        printf("%-18s %s (%d runs, %d with --quick)\n", name, what->title, what->n_runs, quick);
        brc_case_free(&what);
    }
    return BRC_OK;
}

static const char *rule_sign(brc_case_rule rule)
{
    return rule == BRC_CASE_AT_MOST       ? "<="
           : rule == BRC_CASE_AT_LEAST    ? ">="
           : rule == BRC_CASE_ERROR_BOUND ? "+-"
                                          : "";
}

/* Fields of a row that may hold numbers or words. */
static void add_label(brc_rows *rows, const brc_case_pair *label)
{
    char *end;
    const double value = strtod(label->value, &end);
    if (end != label->value && !*end)
        brc_rows_number(rows, label->key, value);
    else
        brc_rows_text(rows, label->key, label->value);
}

static void print_number(double value, int width)
{
    if (isnan(value))
        printf(" %*s", width, "-");
    else
        printf(" %*.7g", width, value);
}

/* One row: into the file and onto the screen. outcome: NULL for derived rows. */
static void put_row(brc_campaign *campaign, const brc_case_row *row, int n_labels, const brc_case_pair *labels,
                    const brc_outcome *outcome, double ours, double reference, const char *unit, const char *note)
{
    brc_rows *rows = &campaign->rows;
    const double error = isnan(reference)                  ? NAN
                         : row->absolute || reference == 0 ? ours - reference
                                                           : ours / reference - 1;
    bool within = true;
    if (row->rule == BRC_CASE_ERROR_BOUND) within = fabs(error) <= row->bound; /* false for NAN */
    if (row->rule == BRC_CASE_AT_MOST) within = ours <= row->bound;
    if (row->rule == BRC_CASE_AT_LEAST) within = ours >= row->bound;
    if (row->rule == BRC_CASE_INFORMATION)
        within = !isnan(ours) || (outcome && outcome->run->may_stop && outcome->done);
    const bool skipped = strncmp(note, "skipped", 7) == 0;
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", campaign->what->name);
    brc_rows_text(rows, "quantity", row->quantity);
    char label_text[128] = "";
    for (int k = 0; k < n_labels; ++k) {
        add_label(rows, &labels[k]);
        const size_t used = strlen(label_text);
        snprintf(label_text + used, sizeof label_text - used, "%s%s %s", k ? ", " : "", labels[k].key, labels[k].value);
    }
    brc_rows_text(rows, "unit", unit);
    brc_rows_number(rows, "reference", reference);
    brc_rows_number(rows, "paper", row->paper);
    brc_rows_number(rows, "ours", ours);
    brc_rows_number(rows, "error", error);
    brc_rows_text(rows, "rule", rule_sign(row->rule));
    brc_rows_number(rows, "bound", row->rule == BRC_CASE_INFORMATION ? NAN : row->bound);
    brc_rows_text(rows, "verdict",
                  skipped                                       ? "skipped"
                  : row->rule == BRC_CASE_INFORMATION && within ? "information"
                  : within                                      ? "within"
                                                                : "missed");
    if (outcome) {
        brc_rows_number(rows, "seconds", outcome->seconds);
        brc_rows_integer(rows, "elements", outcome->n_elements);
        brc_rows_integer(rows, "bonds", outcome->n_bonds);
        brc_rows_integer(rows, "steps", outcome->steps);
        brc_rows_text(rows, "precision", brc_precision_name(outcome->precision));
        brc_rows_text(rows, "device", outcome->device);
    }
    if (note[0]) brc_rows_text(rows, "note", note);
    brc_rows_stamp(rows);
    if (!skipped) {
        campaign->n_judged += row->rule != BRC_CASE_INFORMATION || !within;
        campaign->n_missed += !within;
    }
    printf("%-24s %-36s", row->quantity, label_text);
    print_number(row->paper, 10);
    print_number(ours, 13);
    print_number(reference, 13);
    if (isnan(error))
        printf(" %10s", "-");
    else
        printf(" %10.2e", error);
    if (row->rule == BRC_CASE_INFORMATION)
        printf(" %2s %8s", "", "-");
    else
        printf(" %2s %8.3g", rule_sign(row->rule), row->bound);
    if (outcome)
        printf(" %8.3g", outcome->seconds);
    else
        printf(" %8s", "-");
    printf("  %s%s%.60s\n", skipped ? "" : within ? "ok" : "MISSED", note[0] ? " " : "", note);
    fflush(stdout);
}

static void put_rows_of_run(brc_campaign *campaign, const brc_outcome *outcome)
{
    for (int k = 0; k < outcome->run->n_rows; ++k) {
        const brc_case_row *row = &outcome->run->rows[k];
        const brc_case_value *value = brc_outcome_find(outcome, row->quantity);
        double reference = row->reference;
        if (isnan(reference) && value) reference = value->reference;
        const char *unit = value && strcmp(row->unit, "-") == 0 ? value->unit : row->unit;
        char note[480];
        snprintf(note, sizeof note, "%s%s%s", outcome->note, value || outcome->note[0] ? "" : "the run gives no ",
                 value || outcome->note[0] ? "" : row->quantity);
        /* A stopped run has no value to be trusted. */
        if (!note[0] && value && !isnan(value->scatter)) snprintf(note, sizeof note, "scatter %.2g", value->scatter);
        put_row(campaign, row, outcome->run->n_labels, outcome->run->labels, outcome,
                value && outcome->done ? value->value : NAN, reference, unit, note);
        if (value && !isnan(value->scatter)) brc_rows_number(&campaign->rows, "scatter", value->scatter);
    }
}

static brc_status carry_out(brc_campaign *campaign)
{
    const brc_case *what = campaign->what;
    printf("%s\n%s%s\n%-24s %-36s %10s %13s %13s %10s %11s %8s\n", what->title, what->about, what->about[0] ? "\n" : "",
           "quantity", "", "paper", "ours", "reference", "error", "bound", "seconds");
    for (int k = 0; k < what->n_runs; ++k) {
        brc_outcome *outcome = &campaign->outcomes[k];
        outcome->run = &what->runs[k];
        if (campaign->quick && !outcome->run->quick) {
            outcome->skipped = true;
            continue;
        }
        if (outcome->run->about[0]) printf("-- %s\n", outcome->run->about);
        BRC_TRY(brc_outcome_obtain(campaign, outcome));
        put_rows_of_run(campaign, outcome);
        BRC_TRY(brc_rows_write(&campaign->rows, campaign->folder)); /* a long campaign that is stopped keeps its rows */
    }
    for (int k = 0; k < what->n_derived; ++k) {
        const brc_case_derived *derived = &what->derived[k];
        if (campaign->quick && !derived->quick) continue;
        char note[480];
        const double value = brc_derived_value(campaign, derived, note, sizeof note);
        put_row(campaign, &derived->row, derived->n_labels, derived->labels, NULL, value, derived->row.reference,
                derived->row.unit, note);
    }
    BRC_TRY(brc_rows_write(&campaign->rows, campaign->folder));
    for (const brc_operator *const *k = brc_operators; *k; ++k)
        if ((*k)->figure) BRC_TRY((*k)->figure(campaign));
    printf("%d of %d bounded rows within their bounds; %s/rows.json\n", campaign->n_judged - campaign->n_missed,
           campaign->n_judged, campaign->folder);
    if (campaign->n_missed > 0)
        return BRC_FAIL(campaign->session->context, BRC_BOUND_MISSED, "%s: %d row(s) missed their bound", what->name,
                        campaign->n_missed);
    return BRC_OK;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    if (brc_arguments_value(arguments, "list")) return print_cases(context);
    if (arguments->n_positional == 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia reproduce: name a case; `breccia reproduce --list` names them");
    brc_status status = BRC_OK;
    brc_case *what = NULL;
    char folder[512];
    const char *out = brc_arguments_value(arguments, "output");
    snprintf(folder, sizeof folder, "%s%s", out ? out : "results/", out ? "" : arguments->positional[0]);
    int64_t n_threads;
    brc_campaign campaign = {.session = session, .folder = folder, .rows.context = context};
    campaign.device = brc_arguments_value(arguments, "device");
    campaign.exact = brc_arguments_value(arguments, "exact") != NULL;
    campaign.quick = brc_arguments_value(arguments, "quick") != NULL;
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    campaign.n_threads = (int)n_threads;
    BRC_TRY(brc_arguments_precision(context, arguments, &campaign.precision));
    BRC_TRY(brc_case_read(context, brc_arguments_value(arguments, "folder"), arguments->positional[0], &what));
    campaign.what = what;
    if (!isatty(STDERR_FILENO)) brc_log_set_level(context, BRC_LOG_WARNING); /* the rows tell how far it is */
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &campaign.outcomes, what->n_runs, "outcomes of a case"));
    status = carry_out(&campaign);
cleanup:
    for (int k = 0; campaign.outcomes && k < what->n_runs; ++k) {
        brc_memory_free(campaign.outcomes[k].displacement);
        brc_isotropy_forget(&campaign.outcomes[k]);
    }
    brc_memory_free(campaign.outcomes);
    brc_sample_store_free(&campaign.samples);
    brc_rows_free(&campaign.rows);
    brc_case_free(&what);
    return status;
}

const brc_command brc_command_reproduce = {
    .name = "reproduce",
    .operands = "[CASE]",
    .least = 0,
    .most = 1,
    .summary = "a table or figure of the papers, side by side with ours",
    .details = "Exit code 0 only if every row is within the bound printed beside it; rows.json and "
               "rows.csv hold the rows.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
