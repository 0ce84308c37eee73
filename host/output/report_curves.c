#include "report_curves.h"
#include "gnuplot.h"
#include "html.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SENSORS_MOST = 512, LINES_MOST = 8, FIRST = 4 }; /* stage, step, stage_time, time_s stand before the sensors */

/* One figure: columns of a unit. */
typedef struct figure {
    const char *csv;  /* path */
    const char *unit; /* of all */
    int x;            /* column across, from 1 as gnuplot counts */
    int n;
    int column[LINES_MOST];
    const char *name[LINES_MOST];
} figure;

static void add_quoted(brc_text *script, const char *words)
{
    brc_text_add(script, "'");
    for (const char *s = words; *s; ++s) brc_text_add(script, *s == '\'' ? "''" : "%c", *s);
    brc_text_add(script, "'");
}

static void draw(const void *self, brc_text *script)
{
    const figure *f = self;
    brc_text_add(script, "set datafile separator ','\nset key outside top left horizontal noenhanced\nset xlabel '%s'\nset ylabel ",
                 f->x == FIRST ? "time [s]" : "load factor or time of the stage");
    add_quoted(script, f->unit);
    brc_text_add(script, " noenhanced\nplot ");
    for (int k = 0; k < f->n; ++k) {
        brc_text_add(script, "%s", k ? ", " : "");
        add_quoted(script, f->csv);
        brc_text_add(script, " using %d:%d every ::1 with lines linewidth 1.5 title ", f->x, f->column[k]);
        add_quoted(script, f->name[k]);
    }
    brc_text_add(script, "\n");
}

static brc_status add_figure(brc_context *context, const char *folder, const figure *f, brc_text *page, bool *drawn)
{
    char *path = NULL, *bytes = NULL;
    size_t n = 0;
    bool made;
    brc_status status = BRC_OK;
    const brc_gnuplot_figure drawing = {.folder = folder, .name = "report-curve.png", .numbers = "histories.csv", .width = 1060, .height = 480, .draw = draw, .self = f};
    BRC_TRY_OR(cleanup, brc_gnuplot_make(context, &drawing, &made));
    *drawn = *drawn && made;
    if (!made) goto cleanup;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, drawing.name, &path));
    status = brc_file_read_whole(context, path, (size_t)1 << 26, &bytes, &n);
    unlink(path);
    if (status != BRC_OK) goto cleanup;
    brc_html_picture(page, f->name[0], bytes, n);
    brc_text_add(page, "\n");
cleanup:
    brc_memory_free(bytes);
    brc_memory_free(path);
    return status;
}

/* "name [unit]" is taken apart in place. */
static const char *unit_of(char *head)
{
    char *bracket = strrchr(head, '['), *end = bracket ? strchr(bracket, ']') : NULL;
    if (!bracket || !end || bracket == head) return "";
    bracket[-1] = *end = '\0';
    return bracket + 1;
}

/* Does the time of the run move at all? A static run has none. */
static bool has_time(const char *rows)
{
    for (const char *line = rows; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const char *at = line;
        for (int k = 1; k < FIRST && at; ++k) at = (at = strchr(at, ',')) ? at + 1 : NULL;
        if (at && strtod(at, NULL) > 0) return true;
    }
    return false;
}

brc_status brc_report_curves(brc_context *context, const char *folder, brc_text *page, int *n_figures, bool *drawn)
{
    char *path = NULL, *text = NULL;
    size_t bytes = 0;
    brc_status status = BRC_OK;
    *n_figures = 0;
    *drawn = true;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "histories.csv", &path));
    if (!brc_file_exists(path)) goto cleanup;
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, (size_t)1 << 30, &text, &bytes));
    char *rows = strchr(text, '\n');
    if (!rows || !strchr(rows + 1, '\n')) goto cleanup; /* no sample yet */
    *rows++ = '\0';
    const int x = has_time(rows) ? FIRST : FIRST - 1;
    const char *name[SENSORS_MOST], *unit[SENSORS_MOST];
    bool shown[SENSORS_MOST] = {false};
    int n = 0;
    char *rest = text;
    for (int k = 0; rest && n < SENSORS_MOST; ++k) {
        char *head = strsep(&rest, ",");
        if (k < FIRST) continue;
        unit[n] = unit_of(head);
        name[n++] = head;
    }
    for (int first = 0; first < n && *drawn; ++first) {
        if (shown[first]) continue;
        figure f = {.csv = path, .unit = unit[first], .x = x};
        for (int k = first; k < n && f.n < LINES_MOST; ++k) {
            if (shown[k] || strcmp(unit[k], unit[first]) != 0) continue;
            shown[k] = true;
            f.column[f.n] = FIRST + 1 + k;
            f.name[f.n++] = name[k];
        }
        BRC_TRY_OR(cleanup, add_figure(context, folder, &f, page, drawn));
        *n_figures += *drawn;
    }
cleanup:
    brc_memory_free(text);
    brc_memory_free(path);
    return status;
}
