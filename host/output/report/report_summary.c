#include "report_summary.h"
#include "../pictures/label.h"
#include <stdlib.h>
#include <string.h>

const char *brc_report_summary_text(const brc_node *map, const char *key)
{
    const brc_node *node = map ? brc_node_find(map, key) : NULL;
    return node && node->kind == BRC_NODE_SCALAR && strcmp(node->text, "null") != 0 ? node->text : "";
}

static double number_of(const brc_node *map, const char *key)
{
    return strtod(brc_report_summary_text(map, key), NULL);
}

const char *brc_report_summary_title(const brc_node *summary, const char *folder)
{
    const char *title = brc_report_summary_text(summary, "title");
    return title[0] ? title : folder;
}

void brc_report_summary_head(brc_text *page, const brc_node *summary, const char *folder)
{
    static const char *const keys[] = {"model", "precision", "device", "version", "commit"};
    brc_text_add(page, "<h1>");
    brc_html_words(page, brc_report_summary_title(summary, folder));
    brc_text_add(page, "</h1>\n<p class=\"small\">");
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k) {
        brc_text_add(page, "%s%s ", k ? " &middot; " : "", k >= 3 ? keys[k] : "");
        brc_html_words(page, brc_report_summary_text(summary, keys[k]));
    }
    brc_text_add(page, "</p>\n");
    const brc_node *end = brc_node_find(summary, "end");
    const bool done = strcmp(brc_report_summary_text(end, "status"), "done") == 0;
    brc_text_add(page, "<p class=\"%s\"><b>", done ? "done" : "stopped");
    brc_html_words(page, end ? brc_report_summary_text(end, "status") : "no end recorded: the run was killed");
    brc_text_add(page, "</b> ");
    brc_html_words(page, brc_report_summary_text(end, "reason"));
    brc_text_add(page, "</p>\n");
}

static bool ends_with(const char *word, const char *end)
{
    const size_t length = strlen(word), n = strlen(end);
    return length > n && strcmp(word + length - n, end) == 0;
}

/* Values of a map with their share of `whole`; keys that end in `suffix` only. */
static void add_shares(brc_text *page, const brc_node *map, const char *suffix, double whole, const char *of)
{
    brc_text_add(page, "<table><tr><th></th><th></th><th>share of %s</th></tr>\n", of);
    for (const brc_node *child = map->first; child; child = child->next) {
        brc_text_add(page, "<tr><th>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</th><td>");
        brc_html_value(page, child->key, child);
        brc_text_add(page, "</td><td>");
        if (whole > 0 && ends_with(child->key, suffix) && !ends_with(child->key, "_per_s") &&
            child->kind == BRC_NODE_SCALAR)
            brc_text_add(page, "%.4g %%", 100 * strtod(child->text, NULL) / whole);
        brc_text_add(page, "</td></tr>\n");
    }
    brc_text_add(page, "</table>\n");
}

/* A section of the summary with something in it; NULL: none. */
static const brc_node *section_of(const brc_node *summary, const char *key)
{
    const brc_node *child = brc_node_find(summary, key);
    return child && child->kind == BRC_NODE_MAP && child->first ? child : NULL;
}

/* What the figures of fracture are called where their keys say too little. */
static void add_name_of_fracture(brc_text *page, const char *key)
{
    static const char *const name[][2] = {{"largest_fragment", "largest fragment, share of the mass"},
                                          {"tension", "bonds broken in tension"},
                                          {"compression", "bonds broken in compression"},
                                          {"shear", "bonds broken in shear"},
                                          {"detached", "bonds lost by cells that came loose"},
                                          {"released_J", "elastic energy released"},
                                          {"per_area_J_per_m2", "released over crack area"},
                                          {"implied_J_per_m2", "fracture energy that cells and strength imply"},
                                          {"opened", "faces that opened"},
                                          {"ended", "faces that opened and broke"},
                                          {"projected_area_m2", "projected area of these"},
                                          {"spent_J", "energy spent against cohesion"},
                                          {"unfinished_J", "of it at faces that still hold"}};
    for (size_t k = 0; k < sizeof name / sizeof *name; ++k)
        if (strcmp(key, name[k][0]) == 0) {
            brc_html_words(page, name[k][1]);
            return;
        }
    brc_html_key(page, key);
}

static void add_figures_of_fracture(brc_text *page, const brc_node *map)
{
    for (const brc_node *child = map ? map->first : NULL; child; child = child->next) {
        if (child->kind != BRC_NODE_SCALAR) continue;
        brc_text_add(page, "<tr><th>");
        add_name_of_fracture(page, child->key);
        brc_text_add(page, "</th><td>");
        brc_html_scalar(page, child->key, child->text);
        brc_text_add(page, "</td></tr>\n");
    }
}

/* The figures of fracture that stand in one line each. */
static void add_fracture(brc_text *page, const brc_node *fracture)
{
    brc_text_add(page, "<div><h2>Cracks and fragments</h2>\n<table>");
    add_figures_of_fracture(page, fracture);
    add_figures_of_fracture(page, brc_node_find(fracture, "energy"));
    brc_text_add(page, "</table></div>\n");
}

/* A measure's value or target in a unit that suits it, the whole number on hovering. */
static void add_quantity(brc_text *page, const brc_node *measure, const char *key)
{
    char shown[64];
    const char *text = brc_report_summary_text(measure, key), *unit = brc_report_summary_text(measure, "unit");
    if (!text[0]) {
        brc_text_add(page, "<td>&ndash;</td>");
        return;
    }
    brc_label_value(strtod(text, NULL), unit, 5, shown);
    brc_text_add(page, "<td><span title=\"%s %s\">%s</span></td>", text, unit, shown);
}

static void add_measures(brc_text *page, const brc_node *measures)
{
    brc_text_add(page,
                 "<div><h2>Measures</h2>\n<table><tr><th></th><th>value</th><th>target</th><th>error</th></tr>\n");
    for (const brc_node *child = measures->first; child; child = child->next) {
        const char *why_not = brc_report_summary_text(child, "why_not");
        char error[32] = "&ndash;";
        brc_text_add(page, "<tr><th>");
        brc_html_words(page, child->key);
        brc_text_add(page, "</th>");
        add_quantity(page, child, "value");
        add_quantity(page, child, "target");
        if (brc_report_summary_text(child, "error")[0])
            brc_label_error(number_of(child, "value"), number_of(child, "target"), number_of(child, "error"), error);
        brc_text_add(page, "<td>%s</td><td>", error);
        brc_html_words(page, why_not);
        brc_text_add(page, "</td></tr>\n");
    }
    brc_text_add(page, "</table></div>\n");
}

void brc_report_summary_results(brc_text *page, const brc_node *summary)
{
    const brc_node *measures = section_of(summary, "measures"), *fracture = section_of(summary, "fracture");
    if (!measures && !fracture) return;
    brc_text_add(page, "<section class=\"beside\">\n");
    if (measures) add_measures(page, measures);
    if (fracture) add_fracture(page, fracture);
    brc_text_add(page, "</section>\n");
}

void brc_report_summary_cost(brc_text *page, const brc_node *summary)
{
    const brc_node *ledger = section_of(summary, "ledger"), *timing = section_of(summary, "timing");
    const brc_node *memory = section_of(summary, "memory");
    brc_text_add(page, "<section class=\"beside\">\n");
    if (timing) {
        brc_text_add(page, "<div><h2>What it cost</h2>\n");
        add_shares(page, timing, "_s", number_of(timing, "total_s"), "the total");
        if (memory) brc_html_value(page, "memory", memory);
        brc_text_add(page, "</div>\n");
    }
    if (ledger) {
        brc_text_add(page, "<div><h2>Energy ledger</h2>\n");
        add_shares(page, ledger, "_J", number_of(ledger, "peak_elastic_J"), "the elastic peak");
        brc_text_add(page, "</div>\n");
    }
    brc_text_add(page, "</section>\n");
}

static bool is_shown(const brc_node *child)
{
    static const char *const shown[] = {"title", "model",  "precision", "device", "version", "commit",
                                        "end",   "ledger", "timing",    "memory", "measures"};
    for (size_t k = 0; k < sizeof shown / sizeof *shown; ++k)
        if (strcmp(child->key, shown[k]) == 0) return true;
    return false;
}

void brc_report_summary_rest(brc_text *page, const brc_node *summary)
{
    brc_text_add(page, "<h2>Further figures</h2>\n<details><summary>run</summary>\n<table>");
    for (const brc_node *child = summary->first; child; child = child->next) {
        if (is_shown(child) || child->kind != BRC_NODE_SCALAR) continue;
        brc_text_add(page, "<tr><th>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</th><td>");
        brc_html_scalar(page, child->key, child->text);
        brc_text_add(page, "</td></tr>\n");
    }
    brc_text_add(page, "</table></details>\n");
    for (const brc_node *child = summary->first; child; child = child->next) {
        if (is_shown(child) || child->kind == BRC_NODE_SCALAR || !child->first) continue;
        brc_text_add(page, "<details><summary>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</summary>\n");
        brc_html_value(page, child->key, child);
        brc_text_add(page, "</details>\n");
    }
}
