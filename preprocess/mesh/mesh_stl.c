/* STL files. Binary: 80 bytes that mean nothing (they may begin with "solid"), the number of triangles, and 50 bytes a
 * triangle: normal, three corners, two spare bytes. ASCII: solid, facet normal, outer loop, three times vertex,
 * endloop, endfacet, endsolid; any case and white space, several solids one after another. Normals are not used: they
 * follow from the order of the corners. */
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../lines.h"
#include "mesh_internal.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum { HEADER = 84, RECORD = 50, MOST_FACETS = 700000000, SNIFF = 4096 };
static const size_t MOST_BYTES = (size_t)200 << 30; /* ASCII needs up to 300 bytes a triangle */

static uint32_t little_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static float float_at(const char *bytes)
{
    const uint32_t word = little_endian(bytes);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* ASCII begins with the word "solid" and has no byte in its first page that text never has. */
static bool is_text(const char *text, size_t bytes)
{
    const char *c = text, *end = text + bytes;
    if (bytes >= 3 && memcmp(c, "\xef\xbb\xbf", 3) == 0) c += 3;
    while (c < end && (*c == ' ' || *c == '\t' || *c == '\r' || *c == '\n'))
        ++c;
    if (end - c < 6 || strncasecmp(c, "solid", 5) != 0 || !(c[5] == ' ' || (c[5] >= '\t' && c[5] <= '\r')))
        return false;
    const char *last = bytes < SNIFF ? end : text + SNIFF;
    for (; c < last; ++c)
        if ((unsigned char)*c < 32 && !(*c >= '\t' && *c <= '\r')) return false;
    return true;
}

static brc_status read_binary(brc_context *context, const char *path, const char *data, size_t bytes,
                              double (**corner)[3], int32_t *n_facets)
{
    const uint32_t n = little_endian(data + HEADER - 4);
    const unsigned long long expected = HEADER + (unsigned long long)RECORD * n;
    if (bytes != expected)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: not an STL file, or a damaged one: as binary STL it announces %u triangles, which take "
                        "%llu bytes, but it has %zu%s; "
                        "export it again as binary or ASCII STL",
                        path, n, expected, bytes, bytes < expected ? " (truncated?)" : "");
    if (n > MOST_FACETS)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: has %u triangles, at most %d are read; export it coarser", path, n,
                        (int)MOST_FACETS);
    BRC_TRY(brc_memory_allocate(context, (void **)corner, 3 * (int64_t)n, sizeof **corner, "corners of a mesh"));
    *n_facets = (int32_t)n;
    for (int64_t t = 0; t < (int64_t)n; ++t) {
        const char *record = data + HEADER + RECORD * t;
        for (int k = 0; k < 9; ++k) {
            const float value = float_at(record + 12 + 4 * k);
            if (!isfinite(value))
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "%s: triangle %lld: %c of corner %d is %g, expected a finite number; export the mesh "
                                "again, or remove the triangle with a "
                                "repair tool and close the hole",
                                path, (long long)t + 1, "xyz"[k % 3], k / 3 + 1, (double)value);
            (*corner)[3 * t + k / 3][k % 3] = (double)value;
        }
    }
    return BRC_OK;
}

/* The next token of an ASCII file, on this line or a later one. */
typedef struct reader {
    brc_lines lines;
    const char *at, *first, *last;
} reader;

static bool next_token(reader *in)
{
    while (!brc_lines_token(&in->at, in->lines.line_end, &in->first, &in->last)) {
        if (!brc_lines_next(&in->lines)) return false;
        in->at = in->lines.line;
    }
    return true;
}

static bool expect(reader *in, const char *word)
{
    if (!next_token(in)) {
        brc_lines_bad(&in->lines, in->lines.line_end,
                      "the file ends where '%s' is expected (truncated?); export it again", word);
        return false;
    }
    if (brc_lines_is(in->first, in->last, word)) return true;
    brc_lines_bad(&in->lines, in->first, "'%.*s' where '%s' is expected; export the mesh again, ASCII or binary",
                  (int)(in->last - in->first < 40 ? in->last - in->first : 40), in->first, word);
    return false;
}

static bool read_corner(reader *in, double corner[3])
{
    static const char *const NAME[3] = {"x of a vertex", "y of a vertex", "z of a vertex"};
    if (!expect(in, "vertex")) return false;
    for (int d = 0; d < 3; ++d) {
        if (!next_token(in)) return expect(in, NAME[d]);
        if (!brc_lines_number(&in->lines, in->first, in->last, NAME[d], &corner[d])) return false;
    }
    return true;
}

/* The rest of a facet whose first word has been read. Its normal may be anything: some writers put nan there. */
static bool read_facet(reader *in, double (*corner)[3])
{
    if (!expect(in, "normal")) return false;
    for (int d = 0; d < 3; ++d)
        if (!next_token(in)) return expect(in, "a component of the normal");
    if (!expect(in, "outer") || !expect(in, "loop")) return false;
    for (int k = 0; k < 3; ++k)
        if (!read_corner(in, corner[k])) return false;
    return expect(in, "endloop") && expect(in, "endfacet");
}

/* After "solid" and "endsolid": the name, which is the rest of the line, unless the first facet follows on the same
 * line. */
static void skip_name(reader *in)
{
    const char *line_end = in->lines.line_end, *before = in->at, *first, *last;
    while (brc_lines_token(&in->at, line_end, &first, &last)) {
        const char *ahead = in->at, *word, *word_end;
        if (brc_lines_is(first, last, "facet") && brc_lines_token(&ahead, line_end, &word, &word_end) &&
            brc_lines_is(word, word_end, "normal")) {
            in->at = before;
            return;
        }
        before = in->at;
    }
}

static bool read_solids(reader *in, brc_context *context, double (**corner)[3], int64_t *capacity, int32_t *n_facets,
                        brc_status *status)
{
    bool open = false;
    while (next_token(in)) {
        if (!open) {
            if (!brc_lines_is(in->first, in->last, "solid")) {
                in->at = in->first;
                return expect(in, "solid");
            }
            open = true;
            skip_name(in);
        } else if (brc_lines_is(in->first, in->last, "endsolid")) {
            open = false;
            skip_name(in);
        } else if (brc_lines_is(in->first, in->last, "facet")) {
            if (*n_facets >= MOST_FACETS) {
                brc_lines_bad(&in->lines, in->first, "more than %d triangles; export the mesh coarser",
                              (int)MOST_FACETS);
                return false;
            }
            if (3 * (int64_t)*n_facets >= *capacity) {
                *capacity *= 2;
                *status = brc_memory_resize(context, (void **)corner, *capacity, sizeof **corner, "corners of a mesh");
                if (*status != BRC_OK) return false;
            }
            if (!read_facet(in, *corner + 3 * (int64_t)*n_facets)) return false;
            ++*n_facets;
        } else {
            in->at = in->first;
            return expect(in, "facet");
        }
    }
    if (open)
        brc_lines_bad(&in->lines, in->lines.line_end,
                      "the file ends where 'facet' or 'endsolid' is expected (truncated?); export it again");
    return !open;
}

static brc_status read_text(brc_context *context, const char *path, const char *text, size_t bytes,
                            double (**corner)[3], int32_t *n_facets)
{
    reader in = {0};
    int64_t capacity = 3 * (int64_t)(bytes / 200 + 16); /* a facet takes about 250 bytes */
    BRC_TRY(brc_memory_allocate(context, (void **)corner, capacity, sizeof **corner, "corners of a mesh"));
    BRC_TRY(brc_lines_begin(context, path, text, bytes, &in.lines));
    in.at = in.lines.line_end;
    brc_status status = BRC_OK;
    if (!read_solids(&in, context, corner, &capacity, n_facets, &status) && status == BRC_OK)
        status = brc_lines_verdict(&in.lines);
    brc_lines_end(&in.lines);
    return status;
}

brc_status brc_mesh_read_facets(brc_context *context, const char *path, double (**corner)[3], int32_t *n_facets)
{
    *corner = NULL;
    *n_facets = 0;
    char *data = NULL;
    size_t bytes = 0;
    brc_status status = BRC_OK;
    BRC_TRY(brc_file_read_whole(context, path, MOST_BYTES, &data, &bytes));
    const bool whole =
        bytes >= HEADER && HEADER + (unsigned long long)RECORD * little_endian(data + HEADER - 4) == bytes;
    if (!whole && is_text(data, bytes))
        BRC_TRY_OR(cleanup, read_text(context, path, data, bytes, corner, n_facets));
    else if (bytes >= HEADER)
        BRC_TRY_OR(cleanup, read_binary(context, path, data, bytes, corner, n_facets));
    else {
        status = BRC_FAIL(
            context, BRC_BAD_INPUT,
            "%s: not an STL file: it has %zu bytes, binary STL at least %d, and ASCII STL begins with 'solid'; export "
            "the part as STL",
            path, bytes, (int)HEADER);
        goto cleanup;
    }
    if (*n_facets == 0)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: has no triangles; export a part that has a volume", path);
cleanup:
    brc_memory_free(data);
    if (status != BRC_OK) {
        brc_memory_free(*corner);
        *corner = NULL;
    }
    return status;
}
