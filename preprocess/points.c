/* CSV here; LAMMPS data files in points_lammps.c. The two are told apart by content: only LAMMPS says "1000 atoms" before its
 * sections. */
#include "points.h"

#include "../host/base/file.h"
#include "../host/base/memory.h"
#include "points_lammps.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Lines looked at for the mark of a LAMMPS file: its header has some thirty keywords at most. */
enum { HEADER_LINES = 200 };
enum { X, Y, Z, RADIUS, DIAMETER, N_ROLES };
static const char *const role_name[N_ROLES] = {"x", "y", "z", "radius", "diameter"};

/* Where the columns of a CSV file are. */
typedef struct csv_header {
    char separator; /* ' ': any run of blanks and tabs */
    int64_t n_columns;
    int64_t column[N_ROLES]; /* index, -1: none */
} csv_header;

static bool says_atoms(const char *line, const char *end)
{
    const char *first, *last, *at = line;
    if (!brc_lines_token(&at, end, &first, &last)) return false;
    for (; first < last; ++first)
        if (*first < '0' || *first > '9') return false;
    if (!brc_lines_token(&at, end, &first, &last) || !brc_lines_is(first, last, "atoms")) return false;
    return !brc_lines_token(&at, end, &first, &last) || *first == '#';
}

static bool is_lammps(brc_lines lines)
{
    for (int k = 0; k < HEADER_LINES && brc_lines_next(&lines); ++k)
        if (says_atoms(lines.line, lines.line_end)) return true;
    return false;
}

/* The next field of a line at or after *at, which is NULL once the last one was given. Blanks and a pair of quotes around a
 * field are no part of it; a separator within quotes separates nothing. */
static bool next_field(char separator, const char **at, const char *end, const char **first, const char **last)
{
    if (!*at) return false;
    if (separator == ' ') return brc_lines_token(at, end, first, last);
    const char *c = *at;
    while (c < end && *c == ' ') ++c;
    const bool quoted = c < end && *c == '"';
    *first = c;
    if (quoted)
        for (++c; c < end && *c != '"';) ++c;
    while (c < end && *c != separator) ++c;
    *at = c < end ? c + 1 : NULL;
    while (c > *first && c[-1] == ' ') --c;
    *last = c;
    if (quoted && c - *first >= 2 && c[-1] == '"') {
        ++*first;
        --*last;
    }
    return true;
}

/* The next line that holds something. */
static bool next_row(brc_lines *lines)
{
    while (brc_lines_next(lines))
        if (lines->line < lines->line_end && *lines->line != '#') return true;
    return false;
}

static char separator_of(const brc_lines *lines)
{
    const size_t length = (size_t)(lines->line_end - lines->line);
    static const char known[] = ",;\t";
    for (const char *c = known; *c; ++c)
        if (memchr(lines->line, *c, length)) return *c;
    return ' ';
}

/* Read the row of names. False: faults were recorded, and reading on would only repeat them. */
static bool read_header(brc_lines *lines, csv_header *header)
{
    static const char want[] = "a row of names: x, y, z and, for spheres, radius or diameter";
    for (int k = 0; k < N_ROLES; ++k) header->column[k] = -1;
    header->n_columns = 0;
    if (!next_row(lines)) {
        brc_lines_bad(lines, lines->line_start, "no row found, expected %s, then a row for each point", want);
        return false;
    }
    header->separator = separator_of(lines);
    const int64_t bad_before = lines->n_bad;
    const char *first, *last, *at = lines->line;
    while (next_field(header->separator, &at, lines->line_end, &first, &last)) {
        for (int k = 0; k < N_ROLES; ++k) {
            if (!brc_lines_is(first, last, role_name[k])) continue;
            if (header->column[k] >= 0) brc_lines_bad(lines, first, "a second column '%s', expected one", role_name[k]);
            header->column[k] = header->n_columns;
        }
        header->n_columns++;
    }
    if (lines->n_bad > bad_before) return false;
    if (header->column[X] < 0 && header->column[Y] < 0 && header->column[Z] < 0) {
        brc_lines_bad(lines, lines->line, "'%.*s' names no coordinate, expected %s (a row behind '#' is a comment)",
                      (int)(lines->line_end - lines->line < 60 ? lines->line_end - lines->line : 60), lines->line, want);
        return false;
    }
    for (int k = X; k <= Z; ++k)
        if (header->column[k] < 0) brc_lines_bad(lines, lines->line, "no column '%s', expected %s", role_name[k], want);
    if (header->column[RADIUS] >= 0 && header->column[DIAMETER] >= 0)
        brc_lines_bad(lines, lines->line, "columns 'radius' and 'diameter', expected one of them; rename the other");
    return lines->n_bad == bad_before;
}

static bool read_row(brc_lines *lines, const csv_header *header, double value[N_ROLES])
{
    const char *first, *last, *at = header->separator == '\t' ? lines->line_start : lines->line;
    int64_t column = 0;
    for (; next_field(header->separator, &at, lines->line_end, &first, &last); ++column) {
        if (column >= header->n_columns && first == last && !at) break; /* a separator at the end of the row */
        if (column >= header->n_columns) {
            brc_lines_bad(lines, first, "more fields than the %lld names of the header%s", (long long)header->n_columns,
                          header->separator == ',' ? "; numbers need a decimal point, not a comma" : "");
            return false;
        }
        for (int k = 0; k < N_ROLES; ++k)
            if (column == header->column[k] && !brc_lines_number(lines, first, last, role_name[k], &value[k])) return false;
    }
    if (column < header->n_columns) {
        brc_lines_bad(lines, lines->line_end, "%lld fields, expected the %lld of the header", (long long)column,
                      (long long)header->n_columns);
        return false;
    }
    for (int k = RADIUS; k <= DIAMETER; ++k)
        if (header->column[k] >= 0 && !(value[k] > 0.0)) {
            brc_lines_bad(lines, lines->line, "%s is %g, must be > 0", role_name[k], value[k]);
            return false;
        }
    return true;
}

static brc_status read_csv(brc_lines *lines, double **position, double **radius, int64_t *n)
{
    csv_header header;
    if (!read_header(lines, &header)) return brc_lines_verdict(lines);
    const int64_t room = brc_lines_left(lines);
    const int role = header.column[RADIUS] >= 0 ? RADIUS : DIAMETER;
    const bool spheres = header.column[role] >= 0;
    BRC_TRY(BRC_ALLOCATE(lines->context, position, 3 * room, "points"));
    if (spheres) BRC_TRY(BRC_ALLOCATE(lines->context, radius, room, "radii of points"));
    while (next_row(lines)) {
        double value[N_ROLES] = {0.0};
        if (!read_row(lines, &header, value)) continue;
        memcpy(*position + 3 * *n, value, 3 * sizeof *value);
        if (spheres) (*radius)[*n] = role == DIAMETER ? 0.5 * value[role] : value[role];
        ++*n;
    }
    if (*n == 0 && lines->n_bad == 0) brc_lines_bad(lines, lines->line_start, "no point follows the header, expected a row for each point");
    return brc_lines_verdict(lines);
}

/* Into metres; what overflows is refused. */
static brc_status apply_scale(brc_context *context, const char *path, double scale, double *position, double *radius, int64_t n)
{
    bool finite = true;
    for (int64_t k = 0; k < 3 * n; ++k) finite = isfinite(position[k] *= scale) && finite;
    for (int64_t k = 0; radius && k < n; ++k) finite = isfinite(radius[k] *= scale) && radius[k] > 0.0 && finite;
    if (finite) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: coordinates times the scale %g m are beyond what a double holds; use another scale",
                    path, scale);
}

brc_status brc_points_read(brc_context *context, const char *path, double scale, double **position, double **radius, int64_t *n)
{
    *position = *radius = NULL;
    *n = 0;
    char *text = NULL;
    size_t bytes = 0;
    brc_lines lines = {.path = path};
    brc_status status = BRC_OK;
    if (!(isfinite(scale) && scale > 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the scale is %g m, must be finite and > 0", path, scale);
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, (size_t)1 << 40, &text, &bytes));
    BRC_TRY_OR(cleanup, brc_lines_begin(context, path, text, bytes, &lines));
    const bool lammps = is_lammps(lines);
    BRC_TRY_OR(cleanup, lammps ? brc_points_read_lammps(&lines, position, radius, n) : read_csv(&lines, position, radius, n));
    if (*n > INT32_MAX)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: %lld points, must be below 2^31", path, (long long)*n);
    else
        status = apply_scale(context, path, scale, *position, *radius, *n);
cleanup:
    brc_lines_end(&lines);
    brc_memory_free(text);
    if (status != BRC_OK) {
        brc_memory_free(*position);
        brc_memory_free(*radius);
        *position = *radius = NULL;
        *n = 0;
    }
    return status;
}

/* 17 digits give every double back; the program around us may use a decimal comma, so it is put right. */
static void print_number(FILE *file, double value)
{
    char digits[40];
    snprintf(digits, sizeof digits, ",%.17g", value);
    for (char *c = digits + 1; *c; ++c)
        if (*c == ',') *c = '.';
    fputs(digits, file);
}

static void print_elements(FILE *file, const brc_domain *d)
{
    fprintf(file, "id,x,y,z%s,volume,region,body%s\n", d->radius ? ",radius" : "", d->grain ? ",grain" : "");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        fprintf(file, "%lld", (long long)e);
        for (int k = 0; k < 3; ++k) print_number(file, d->position[3 * e + k]);
        if (d->radius) print_number(file, d->radius[e]);
        print_number(file, d->volume[e]);
        fprintf(file, ",%d,%d", d->region[e], d->body[e]);
        if (d->grain) fprintf(file, ",%d", d->grain[e]);
        fputc('\n', file);
    }
}

brc_status brc_points_write(brc_context *context, const brc_domain *domain, const char *path)
{
    char *aside = NULL;
    BRC_TRY(brc_file_aside(context, path, &aside));
    brc_status status = BRC_OK;
    FILE *file = fopen(aside, "w");
    if (!file) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot create: %s", aside, strerror(errno));
        goto cleanup;
    }
    print_elements(file, domain);
    const bool broken = ferror(file) != 0;
    if (fclose(file) != 0 || broken)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write; is the disk full?", aside);
    if (status == BRC_OK) status = brc_file_commit(context, aside, path);
    if (status != BRC_OK) brc_file_discard(aside);
cleanup:
    brc_memory_free(aside);
    return status;
}
