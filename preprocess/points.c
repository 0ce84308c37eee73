/* CSV here; LAMMPS data files in points_lammps.c. The two are told apart by content: only LAMMPS says "1000 atoms"
 * before its sections. */
#include "points.h"

#include "../host/base/file.h"
#include "../host/base/memory.h"
#include "csv.h"
#include "points_lammps.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Lines looked at for the mark of a LAMMPS file: its header has some thirty keywords at most. */
enum { HEADER_LINES = 200 };
enum { X, Y, Z, RADIUS, DIAMETER, N_ROLES };
static const char *const role_name[N_ROLES] = {"x", "y", "z", "radius", "diameter"};

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

static bool read_row(brc_lines *lines, const brc_csv *csv, double value[N_ROLES])
{
    if (!brc_csv_row(lines, csv, value, NULL)) return false;
    for (int k = RADIUS; k <= DIAMETER; ++k)
        if (csv->column[k] >= 0 && !(value[k] > 0.0)) {
            brc_lines_bad(lines, lines->line, "%s is %g, must be > 0", role_name[k], value[k]);
            return false;
        }
    return true;
}

static bool read_header(brc_lines *lines, brc_csv *csv)
{
    if (!brc_csv_header(lines, csv)) return false;
    if (csv->column[RADIUS] < 0 || csv->column[DIAMETER] < 0) return true;
    brc_lines_bad(lines, lines->line, "columns 'radius' and 'diameter', expected one of them; rename the other");
    return false;
}

static brc_status read_csv(brc_lines *lines, double **position, double **radius, int64_t *n)
{
    brc_csv header = {.n_roles = N_ROLES,
                      .n_required = 3,
                      .role = role_name,
                      .what = "coordinate",
                      .wanted =
                          "a row of names: x, y, z and, for spheres, radius or diameter, then a row for each point"};
    if (!read_header(lines, &header)) return brc_lines_verdict(lines);
    const int64_t room = brc_lines_left(lines);
    const int role = header.column[RADIUS] >= 0 ? RADIUS : DIAMETER;
    const bool spheres = header.column[role] >= 0;
    BRC_TRY(BRC_ALLOCATE(lines->context, position, 3 * room, "points"));
    if (spheres) BRC_TRY(BRC_ALLOCATE(lines->context, radius, room, "radii of points"));
    while (brc_csv_next(lines)) {
        double value[N_ROLES] = {0.0};
        if (!read_row(lines, &header, value)) continue;
        memcpy(*position + 3 * *n, value, 3 * sizeof *value);
        if (spheres) (*radius)[*n] = role == DIAMETER ? 0.5 * value[role] : value[role];
        ++*n;
    }
    if (*n == 0 && lines->n_bad == 0)
        brc_lines_bad(lines, lines->line_start, "no point follows the header, expected a row for each point");
    return brc_lines_verdict(lines);
}

/* Into metres; what overflows is refused. */
static brc_status apply_scale(brc_context *context, const char *path, double scale, double *position, double *radius,
                              int64_t n)
{
    bool finite = true;
    for (int64_t k = 0; k < 3 * n; ++k)
        finite = isfinite(position[k] *= scale) && finite;
    for (int64_t k = 0; radius && k < n; ++k)
        finite = isfinite(radius[k] *= scale) && radius[k] > 0.0 && finite;
    if (finite) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "%s: coordinates times the scale %g m are beyond what a double holds; use another scale", path,
                    scale);
}

brc_status brc_points_read(brc_context *context, const char *path, double scale, double **position, double **radius,
                           int64_t *n)
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
    BRC_TRY_OR(cleanup,
               lammps ? brc_points_read_lammps(&lines, position, radius, n) : read_csv(&lines, position, radius, n));
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
        for (int k = 0; k < 3; ++k)
            print_number(file, d->position[3 * e + k]);
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
