/* The data files of LAMMPS's read_data: a comment line, a header of "number keyword" lines, then sections, each a name,
 * a blank line and rows. Only the number of atoms and the section "Atoms" matter here; everything else is stepped
 * over. */
#include "points_lammps.h"

#include "../host/base/log.h"
#include "../host/base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Columns of an atom, counted from 0; three image flags may follow. */
typedef struct atom_style {
    const char *name;
    int n_columns;
    int diameter; /* column, -1: none */
    int x;        /* first of three columns */
} atom_style;
static const atom_style styles[] = {
    {"atomic", 5, -1, 2},    {"sphere", 7, 2, 4}, {"bond", 6, -1, 3},
    {"molecular", 6, -1, 3}, {"angle", 6, -1, 3}, {"bpm/sphere", 8, 3, 5},
};
enum { N_STYLES = sizeof styles / sizeof *styles, MOST_COLUMNS = 11, N_FLAGS = 3 };

typedef struct atom {
    int64_t id, line;
    double x[3], diameter;
} atom;

typedef struct columns {
    int n;
    const char *first[MOST_COLUMNS + 1], *last[MOST_COLUMNS + 1];
} columns;

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Step to the next line that holds more than a comment, cut before the comment. */
static bool next_line(brc_lines *lines)
{
    while (brc_lines_next(lines)) {
        const char *comment = memchr(lines->line, '#', (size_t)(lines->line_end - lines->line));
        if (comment) lines->line_end = comment;
        if (lines->line < lines->line_end) return true;
    }
    return false;
}

static void split(const brc_lines *lines, columns *row)
{
    const char *at = lines->line;
    row->n = 0;
    while (row->n <= MOST_COLUMNS && brc_lines_token(&at, lines->line_end, &row->first[row->n], &row->last[row->n]))
        row->n++;
}

/* The style named behind "Atoms #". False when the name is none that is known; *style stays NULL when there is no
 * name. */
static bool named_style(brc_lines *lines, const atom_style **style)
{
    const char *end = lines->next, *at = memchr(lines->line_end, '#', (size_t)(end - lines->line_end));
    const char *first, *last;
    *style = NULL;
    if (!at) return true;
    ++at;
    while (end > at && (end[-1] == '\n' || end[-1] == '\r'))
        --end;
    if (!brc_lines_token(&at, end, &first, &last)) return true;
    for (int k = 0; k < N_STYLES; ++k)
        if (brc_lines_is(first, last, styles[k].name)) *style = &styles[k];
    if (*style) return true;
    brc_lines_bad(lines, first, "atom style '%.*s', expected atomic, sphere, bond, molecular, angle or bpm/sphere",
                  (int)(last - first < 40 ? last - first : 40), first);
    return false;
}

static bool is_whole(const char *first, const char *last)
{
    if (first < last && *first == '-') ++first;
    if (first == last) return false;
    for (; first < last; ++first)
        if (*first < '0' || *first > '9') return false;
    return true;
}

/* Do all rows from here to the end of the section end in three whole numbers? Eight columns are atomic with image
 * flags, or bpm/sphere without. */
static bool ends_in_flags(brc_lines lines)
{
    columns row;
    while (next_line(&lines) && !is_letter(*lines.line)) {
        split(&lines, &row);
        for (int k = row.n - N_FLAGS; k < row.n; ++k)
            if (k < 0 || !is_whole(row.first[k], row.last[k])) return false;
    }
    return true;
}

/* The style that has as many columns as the first row. `lines` stands on the name of the section. */
static const atom_style *guessed_style(brc_lines *lines)
{
    brc_lines ahead = *lines;
    columns row;
    if (!next_line(&ahead)) return &styles[0];
    split(&ahead, &row);
    const atom_style *style = NULL;
    const bool flags = row.n == 8 && ends_in_flags(*lines);
    for (int k = N_STYLES - 1; k >= 0; --k) { /* downwards: of equal ones the first */
        if (row.n == styles[k].n_columns && !flags) style = &styles[k];
        if (row.n == styles[k].n_columns + N_FLAGS && (row.n != 8 || flags)) style = &styles[k];
    }
    if (!style) {
        ahead.n_bad = lines->n_bad;
        brc_lines_bad(&ahead, ahead.line,
                      "%d columns belong to no atom style that is read; name it behind the section: 'Atoms # sphere'",
                      row.n);
        lines->n_bad = ahead.n_bad;
        return NULL;
    }
    brc_log(lines->context, BRC_LOG_WARNING, "%s: the section 'Atoms' names no style; %d columns are read as '%s'",
            lines->path, row.n, style->name);
    return style;
}

/* One row of the section. *flagged counts atoms with an image flag that is not 0. */
static bool read_atom(brc_lines *lines, const atom_style *style, atom *out, int64_t *flagged)
{
    columns row;
    split(lines, &row);
    if (row.n != style->n_columns && row.n != style->n_columns + N_FLAGS) {
        brc_lines_bad(lines, lines->line, "%d%s columns, expected the %d of style '%s', or %d with image flags", row.n,
                      row.n > MOST_COLUMNS ? " or more" : "", style->n_columns, style->name,
                      style->n_columns + N_FLAGS);
        return false;
    }
    out->line = lines->number;
    if (!brc_lines_integer(lines, row.first[0], row.last[0], "the atom's id", &out->id)) return false;
    for (int k = 0; k < 3; ++k) {
        static const char *const name[3] = {"x", "y", "z"};
        if (!brc_lines_number(lines, row.first[style->x + k], row.last[style->x + k], name[k], &out->x[k]))
            return false;
    }
    bool moved = false;
    for (int k = style->n_columns; k < row.n; ++k) {
        int64_t flag;
        if (!brc_lines_integer(lines, row.first[k], row.last[k], "an image flag", &flag)) return false;
        moved = moved || flag != 0;
    }
    *flagged += moved;
    if (style->diameter < 0) return true;
    const char *first = row.first[style->diameter], *last = row.last[style->diameter];
    if (!brc_lines_number(lines, first, last, "diameter", &out->diameter)) return false;
    if (out->diameter > 0.0) return true;
    brc_lines_bad(lines, first, "diameter is %g, must be > 0", out->diameter);
    return false;
}

static int compare_atoms(const void *a, const void *b)
{
    const atom *p = a, *q = b;
    if (p->id != q->id) return p->id < q->id ? -1 : 1;
    return p->line < q->line ? -1 : p->line > q->line;
}

/* Sort by id; ids that occur twice are faults. */
static void sort_atoms(brc_lines *lines, atom *atoms, int64_t n)
{
    bool sorted = true;
    for (int64_t k = 1; k < n && sorted; ++k)
        sorted = atoms[k - 1].id < atoms[k].id;
    if (sorted) return;
    qsort(atoms, (size_t)n, sizeof *atoms, compare_atoms);
    const char *start = lines->line_start;
    for (int64_t k = 1; k < n; ++k) {
        if (atoms[k - 1].id != atoms[k].id) continue;
        lines->number = atoms[k].line; /* the place of the fault, which is not where reading stands */
        brc_lines_bad(lines, start, "a second atom %lld, the first is on line %lld; ids must differ",
                      (long long)atoms[k].id, (long long)atoms[k - 1].line);
    }
}

/* Header lines up to the first section: the number of atoms. `lines` stands on the section afterwards; false at the end
 * of the file. */
static bool read_header(brc_lines *lines, int64_t *n_atoms)
{
    if (!brc_lines_next(lines)) return false; /* LAMMPS never reads the first line */
    *n_atoms = -1;
    while (next_line(lines)) {
        if (is_letter(*lines->line)) return true;
        columns row;
        split(lines, &row);
        if (row.n == 2 && brc_lines_is(row.first[1], row.last[1], "atoms"))
            brc_lines_integer(lines, row.first[0], row.last[0], "the number of atoms", n_atoms);
    }
    return false;
}

static brc_status read_section(brc_lines *lines, const atom_style *style, int64_t n_atoms, atom *atoms,
                               int64_t *flagged)
{
    int64_t found = 0;
    bool more = false;
    while ((more = next_line(lines)) && !is_letter(*lines->line)) {
        atom one = {.id = 0};
        const bool good = read_atom(lines, style, &one, flagged);
        if (good && found < n_atoms) atoms[found] = one;
        ++found;
    }
    if (found != n_atoms) {
        brc_lines_bad(lines, more ? lines->line : lines->line_start,
                      "the section 'Atoms' ends after %lld rows, the header says %lld atoms", (long long)found,
                      (long long)n_atoms);
    } else if (lines->n_bad == 0) {
        sort_atoms(lines, atoms, n_atoms);
    }
    return brc_lines_verdict(lines);
}

static brc_status copy_out(brc_lines *lines, const atom_style *style, const atom *atoms, int64_t n, double **position,
                           double **radius)
{
    BRC_TRY(BRC_ALLOCATE(lines->context, position, 3 * n, "points"));
    if (style->diameter >= 0) BRC_TRY(BRC_ALLOCATE(lines->context, radius, n, "radii of points"));
    for (int64_t k = 0; k < n; ++k) {
        memcpy(*position + 3 * k, atoms[k].x, sizeof atoms[k].x);
        if (*radius) (*radius)[k] = 0.5 * atoms[k].diameter;
    }
    return BRC_OK;
}

brc_status brc_points_read_lammps(brc_lines *lines, double **position, double **radius, int64_t *n)
{
    int64_t n_atoms = -1, flagged = 0;
    bool section = read_header(lines, &n_atoms);
    if (lines->n_bad == 0 && n_atoms < 0)
        brc_lines_bad(lines, lines->line_start,
                      "no 'N atoms' between the first line, which LAMMPS takes as a comment, and the first section");
    if (n_atoms == 0) brc_lines_bad(lines, lines->line_start, "the header says 0 atoms, must be at least 1");
    columns row = {.n = 0};
    for (; section; section = next_line(lines)) {
        split(lines, &row);
        if (row.n == 1 && brc_lines_is(row.first[0], row.last[0], "Atoms")) break;
    }
    if (!section && lines->n_bad == 0)
        brc_lines_bad(lines, lines->line_start, "the file ends without a section 'Atoms'");
    if (section && lines->n_bad == 0 && n_atoms > brc_lines_left(lines))
        brc_lines_bad(lines, lines->line, "the header says %lld atoms, only %lld lines follow here", (long long)n_atoms,
                      (long long)brc_lines_left(lines));
    BRC_TRY(brc_lines_verdict(lines));
    const atom_style *style = NULL;
    if (named_style(lines, &style) && !style) style = guessed_style(lines);
    BRC_TRY(brc_lines_verdict(lines));
    atom *atoms = NULL;
    brc_status status = BRC_ALLOCATE(lines->context, &atoms, n_atoms, "atoms");
    if (status == BRC_OK) status = read_section(lines, style, n_atoms, atoms, &flagged);
    if (status == BRC_OK) status = copy_out(lines, style, atoms, n_atoms, position, radius);
    if (status == BRC_OK) {
        *n = n_atoms;
        if (flagged > 0)
            brc_log(lines->context, BRC_LOG_WARNING,
                    "%s: %lld atoms have image flags; positions are taken as they are written, nothing is wrapped or "
                    "unwrapped",
                    lines->path, (long long)flagged);
        else
            brc_log(lines->context, BRC_LOG_INFO,
                    "%s: %lld atoms of style '%s'; the box is not used, nothing is wrapped", lines->path,
                    (long long)n_atoms, style->name);
    }
    brc_memory_free(atoms);
    return status;
}
