/* One table lists every array of the file; writing and reading walk it. What follows from other arrays is not stored
 * twice: area vectors and centroids of shared faces are kept once a bond, seen from its smaller element; volume,
 * centroid and inertia of spheres follow from position and radius, but are stored all the same, so that readers find
 * them where those of cells are. */
#include "domain_file.h"

#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/base/version.h"
#include "hdf5_io.h"
#include "quality.h"

#include <omp.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define FORMAT_NAME "breccia domain"

/* Which count gives the rows of an array. */
typedef enum rows_of {
    ELEMENTS,
    ELEMENT_STARTS,
    HALF_EDGES,
    BONDS,
    FREE_FACES,
    FREE_FACE_STARTS,
    CORNERS,
    POLYGON_CORNERS,
    N_ROWS_OF
} rows_of;

/* Which domains have an array. */
typedef enum found_in { ALL, CELLS, SPHERES, GRAINS } found_in;

typedef struct array_entry {
    const char *name;
    size_t field; /* offset of the pointer in brc_domain */
    brc_h5_kind kind;
    rows_of rows;
    int64_t width;
    found_in found;
    const char *unit, *meaning;
} array_entry;

#define ENTRY(path, field, kind, rows, width, found, unit, meaning)                                                    \
    {                                                                                                                  \
        path, offsetof(brc_domain, field), kind, rows, width, found, unit, meaning                                     \
    }
static const array_entry arrays[] = {
    ENTRY("elements/position", position, BRC_H5_DOUBLE, ELEMENTS, 3, ALL, "m",
          "position X of each element: Voronoi seed, centre of a sphere; x y z"),
    ENTRY("elements/volume", volume, BRC_H5_DOUBLE, ELEMENTS, 1, ALL, "m^3", "volume of each element"),
    ENTRY("elements/centroid", centroid, BRC_H5_DOUBLE, ELEMENTS, 3, ALL, "m", "centre of mass of each element; x y z"),
    ENTRY("elements/inertia", inertia, BRC_H5_DOUBLE, ELEMENTS, 6, ALL, "m^5",
          "inertia about the centroid at unit density; xx yy zz yz xz xy"),
    ENTRY("elements/region", region, BRC_H5_INT32, ELEMENTS, 1, ALL, "-",
          "material region; 0: the material of the body"),
    ENTRY("elements/body", body, BRC_H5_INT32, ELEMENTS, 1, ALL, "-", "index of the body"),
    ENTRY("elements/grain", grain, BRC_H5_INT32, ELEMENTS, 1, GRAINS, "-",
          "index of the grain, counted through all bodies"),
    ENTRY("elements/radius", radius, BRC_H5_DOUBLE, ELEMENTS, 1, SPHERES, "m", "radius as packed, before any growth"),
    ENTRY("half_edges/row_start", row_start, BRC_H5_INT64, ELEMENT_STARTS, 1, ALL, "-",
          "first half-edge of each element, and the end"),
    ENTRY("half_edges/neighbour", neighbour, BRC_H5_INT32, HALF_EDGES, 1, ALL, "-", "element on the other side"),
    ENTRY("half_edges/twin", twin, BRC_H5_INT32, HALF_EDGES, 1, ALL, "-",
          "the same face or beam seen from the neighbour"),
    ENTRY("half_edges/bond", bond, BRC_H5_INT32, HALF_EDGES, 1, ALL, "-", "bond of each half-edge"),
    ENTRY("bonds/half_edge", bond_half_edge, BRC_H5_INT32, BONDS, 1, ALL, "-",
          "half-edge of each bond, seen from its lower id"),
    ENTRY("free_faces/row_start", free_start, BRC_H5_INT64, ELEMENT_STARTS, 1, CELLS, "-",
          "first free face of each element, and the end"),
    ENTRY("free_faces/element", free_element, BRC_H5_INT32, FREE_FACES, 1, CELLS, "-", "element of each free face"),
    ENTRY("free_faces/area_vector", free_area_vector, BRC_H5_DOUBLE, FREE_FACES, 3, CELLS, "m^2",
          "outward area vector; x y z"),
    ENTRY("free_faces/centroid", free_centroid, BRC_H5_DOUBLE, FREE_FACES, 3, CELLS, "m", "centroid; x y z"),
    ENTRY("free_faces/wall", free_wall, BRC_H5_INT32, FREE_FACES, 1, CELLS, "-",
          "wall of each free face: attribute wall_N of the file"),
    ENTRY("free_faces/polygon_start", free_polygon_start, BRC_H5_INT64, FREE_FACE_STARTS, 1, CELLS, "-",
          "first row of each free face in polygon, and the end"),
    ENTRY("free_faces/polygon", free_polygon, BRC_H5_INT32, POLYGON_CORNERS, 1, CELLS, "-",
          "corners of each free face, rows of cells/vertex, counter-clockwise from outside"),
    ENTRY("cells/vertex_start", vertex_start, BRC_H5_INT64, ELEMENT_STARTS, 1, CELLS, "-",
          "first row of each cell in vertex, and the end"),
    ENTRY("cells/vertex", vertex, BRC_H5_DOUBLE, CORNERS, 3, CELLS, "m", "corners of each cell; x y z"),
};
enum { N_ARRAYS = (int)(sizeof arrays / sizeof *arrays) };
static const char *const groups[] = {"elements", "half_edges", "bonds", "sets", "quality", "free_faces", "cells"};
enum { N_GROUPS = (int)(sizeof groups / sizeof *groups), N_GROUPS_OF_SPHERES = N_GROUPS - 2 };
static const char *const kind_name[] = {"cells", "spheres"}; /* by brc_element_kind */

/* Attributes of the group "quality". */
typedef struct quality_entry {
    const char *name;
    size_t field;
    brc_h5_kind kind;
    int64_t n;
    int since; /* format version; files before it are measured when read */
} quality_entry;

#define QUALITY(field, kind, n)                                                                                        \
    {                                                                                                                  \
#field, offsetof(brc_quality, field), kind, n, 1                                                               \
    }
#define QUALITY_2(field, kind, n)                                                                                      \
    {                                                                                                                  \
#field, offsetof(brc_quality, field), kind, n, 2                                                               \
    }
static const quality_entry quality_fields[] = {
    QUALITY(n_seeds_requested, BRC_H5_INT64, 1),
    QUALITY(n_seeds_duplicate, BRC_H5_INT64, 1),
    QUALITY(n_seeds_lost, BRC_H5_INT64, 1),
    QUALITY(n_tiny_faces_dropped, BRC_H5_INT64, 1),
    QUALITY(tiny_face_threshold, BRC_H5_DOUBLE, 1),
    QUALITY(tiny_face_area_fraction, BRC_H5_DOUBLE, 1),
    QUALITY(volume_shape, BRC_H5_DOUBLE, 1),
    QUALITY(volume_cells, BRC_H5_DOUBLE, 1),
    QUALITY(volume_error, BRC_H5_DOUBLE, 1),
    QUALITY(smallest_distance, BRC_H5_DOUBLE, 1),
    QUALITY(mean_spacing, BRC_H5_DOUBLE, 1),
    QUALITY(closure_worst, BRC_H5_DOUBLE, 1),
    QUALITY(twin_area_worst, BRC_H5_DOUBLE, 1),
    QUALITY(support_smallest, BRC_H5_DOUBLE, 1),
    QUALITY(coordination_mean, BRC_H5_DOUBLE, 1),
    QUALITY(coordination_histogram, BRC_H5_INT64, 64),
    QUALITY_2(volume_fraction, BRC_H5_DOUBLE, 1),
    QUALITY_2(growth, BRC_H5_DOUBLE, 1),
    QUALITY_2(n_elements_without_bond, BRC_H5_INT64, 1),
    QUALITY_2(n_pieces, BRC_H5_INT64, 1),
    QUALITY_2(volume_spread, BRC_H5_DOUBLE, 5),
    QUALITY_2(faces_spread, BRC_H5_DOUBLE, 5),
    QUALITY_2(branch_spread, BRC_H5_DOUBLE, 5),
};
enum { N_QUALITY = (int)(sizeof quality_fields / sizeof *quality_fields) };

/* The counts of the file, attributes of its root. */
static const char *const count_name[] = {"n_elements",        "n_bonds", "n_free_faces", "n_corners",
                                         "n_polygon_corners", "n_walls", "n_sets"};
enum { N_COUNTS = (int)(sizeof count_name / sizeof *count_name) };

static void rows_from_counts(const int64_t count[N_COUNTS], int64_t rows[N_ROWS_OF])
{
    rows[ELEMENTS] = count[0];
    rows[ELEMENT_STARTS] = count[0] + 1;
    rows[HALF_EDGES] = 2 * count[1];
    rows[BONDS] = count[1];
    rows[FREE_FACES] = count[2];
    rows[FREE_FACE_STARTS] = count[2] + 1;
    rows[CORNERS] = count[3];
    rows[POLYGON_CORNERS] = count[4];
}

static bool has_array(const brc_domain *domain, const array_entry *entry, bool has_grains)
{
    switch (entry->found) {
    case ALL: return true;
    case CELLS: return domain->element_kind == BRC_ELEMENT_CELL;
    case SPHERES: return domain->element_kind == BRC_ELEMENT_SPHERE;
    case GRAINS: break;
    }
    return has_grains;
}

static void **pointer_of(brc_domain *domain, const array_entry *entry)
{
    return (void **)(void *)((char *)domain + entry->field);
}

static brc_status write_attributes(brc_context *context, hid_t file, const brc_domain *d, const char *path,
                                   const int64_t count[N_COUNTS])
{
    const int64_t version = BRC_DOMAIN_FORMAT_VERSION, has_grains = d->grain != NULL;
    BRC_TRY(brc_h5_write_text(context, file, path, "format", FORMAT_NAME));
    BRC_TRY(brc_h5_write_numbers(context, file, path, "format_version", BRC_H5_INT64, 1, &version));
    BRC_TRY(brc_h5_write_text(context, file, path, "written_by", brc_version()));
    BRC_TRY(brc_h5_write_text(context, file, path, "element_kind", kind_name[d->element_kind]));
    BRC_TRY(brc_h5_write_numbers(context, file, path, "has_grains", BRC_H5_INT64, 1, &has_grains));
    BRC_TRY(brc_h5_write_text(context, file, path, "units", "SI: m, m^2, m^3; inertia at unit density: m^5"));
    BRC_TRY(brc_h5_write_text(context, file, path, "provenance", d->provenance));
    for (int k = 0; k < N_COUNTS; ++k)
        BRC_TRY(brc_h5_write_numbers(context, file, path, count_name[k], BRC_H5_INT64, 1, &count[k]));
    return brc_h5_write_numbers(context, file, path, "bounds", BRC_H5_DOUBLE, 6, d->bounds);
}

static brc_status write_groups(brc_context *context, hid_t file, const brc_domain *d, const char *path)
{
    for (int k = 0; k < (d->element_kind == BRC_ELEMENT_CELL ? N_GROUPS : N_GROUPS_OF_SPHERES); ++k) {
        const hid_t group = brc_h5_create_group(file, groups[k]);
        if (group < 0 || H5Gclose(group) < 0) return brc_h5_fail(context, BRC_FILE_FAILED, path, groups[k]);
    }
    return BRC_OK;
}

/* Attributes `unit` and `meaning` of a dataset. */
static brc_status describe(brc_context *context, hid_t file, const char *path, const char *name, const char *unit,
                           const char *meaning)
{
    const hid_t place = H5Dopen2(file, name, H5P_DEFAULT);
    if (place < 0) return brc_h5_fail(context, BRC_FILE_FAILED, path, name);
    brc_status status = brc_h5_write_text(context, place, path, "unit", unit);
    if (status == BRC_OK) status = brc_h5_write_text(context, place, path, "meaning", meaning);
    if (H5Dclose(place) < 0 && status == BRC_OK) status = brc_h5_fail(context, BRC_FILE_FAILED, path, name);
    return status;
}

/* Area vectors and centroids once a bond. */
static brc_status write_bonds(brc_context *context, hid_t file, const brc_domain *d, const char *path)
{
    double *packed = NULL;
    if (d->element_kind == BRC_ELEMENT_SPHERE) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &packed, 3 * d->n_bonds, "bond geometry"));
    const char *const name[2] = {"bonds/area_vector", "bonds/face_centroid"}, *const unit[2] = {"m^2", "m"};
    const char *const meaning[2] = {"area vector of each bond's face, out of the lower id; x y z",
                                    "centroid of each bond's face; x y z"};
    const double *const from[2] = {d->area_vector, d->face_centroid};
    brc_status status = BRC_OK;
    for (int k = 0; k < 2 && status == BRC_OK; ++k) {
        for (int64_t b = 0; b < d->n_bonds; ++b)
            memcpy(packed + 3 * b, from[k] + 3 * (int64_t)d->bond_half_edge[b], 3 * sizeof *packed);
        status = brc_h5_write_array(context, file, path, name[k], BRC_H5_DOUBLE, d->n_bonds, 3, packed);
        if (status == BRC_OK) status = describe(context, file, path, name[k], unit[k], meaning[k]);
    }
    brc_memory_free(packed);
    return status;
}

static brc_status write_sets(brc_context *context, hid_t file, const brc_domain *d, const char *path)
{
    char name[64];
    for (int32_t w = 0; w < d->n_walls; ++w) {
        snprintf(name, sizeof name, "wall_%d", w);
        BRC_TRY(brc_h5_write_text(context, file, path, name, d->wall_name[w]));
    }
    for (int32_t s = 0; s < d->n_sets; ++s) {
        const brc_set *set = &d->sets[s];
        snprintf(name, sizeof name, "sets/%d", s);
        const char *const meaning = set->kind == BRC_SET_FACES ? "free faces of the set" : "elements of the set";
        BRC_TRY(brc_h5_write_array(context, file, path, name, BRC_H5_INT32, set->n_members, 1, set->members));
        BRC_TRY(describe(context, file, path, name, "-", meaning));
        const hid_t place = H5Dopen2(file, name, H5P_DEFAULT);
        if (place < 0) return brc_h5_fail(context, BRC_FILE_FAILED, path, name);
        brc_status status = brc_h5_write_text(context, place, path, "name", set->name);
        if (status == BRC_OK)
            status = brc_h5_write_text(context, place, path, "kind", set->kind == BRC_SET_FACES ? "faces" : "elements");
        if (H5Dclose(place) < 0 && status == BRC_OK) status = brc_h5_fail(context, BRC_FILE_FAILED, path, name);
        BRC_TRY(status);
    }
    return BRC_OK;
}

static brc_status write_quality(brc_context *context, hid_t file, const brc_domain *d, const char *path)
{
    const hid_t place = H5Gopen2(file, "quality", H5P_DEFAULT);
    if (place < 0) return brc_h5_fail(context, BRC_FILE_FAILED, path, "quality");
    brc_status status = BRC_OK;
    for (int k = 0; k < N_QUALITY && status == BRC_OK; ++k)
        status = brc_h5_write_numbers(context, place, path, quality_fields[k].name, quality_fields[k].kind,
                                      quality_fields[k].n, (const char *)&d->quality + quality_fields[k].field);
    if (H5Gclose(place) < 0 && status == BRC_OK) status = brc_h5_fail(context, BRC_FILE_FAILED, path, "quality");
    return status;
}

static brc_status write_all(brc_context *context, hid_t file, const brc_domain *domain, const char *path)
{
    const bool cells = domain->element_kind == BRC_ELEMENT_CELL;
    const int64_t count[N_COUNTS] = {domain->n_elements,
                                     domain->n_bonds,
                                     domain->n_free_faces,
                                     cells ? domain->vertex_start[domain->n_elements] : 0,
                                     cells ? domain->free_polygon_start[domain->n_free_faces] : 0,
                                     domain->n_walls,
                                     domain->n_sets};
    int64_t rows[N_ROWS_OF];
    rows_from_counts(count, rows);
    BRC_TRY(write_attributes(context, file, domain, path, count));
    BRC_TRY(write_groups(context, file, domain, path));
    for (int k = 0; k < N_ARRAYS; ++k) {
        const void *data = *(void *const *)(const void *)((const char *)domain + arrays[k].field);
        if (!has_array(domain, &arrays[k], domain->grain != NULL)) continue;
        BRC_TRY(brc_h5_write_array(context, file, path, arrays[k].name, arrays[k].kind, rows[arrays[k].rows],
                                   arrays[k].width, data));
        BRC_TRY(describe(context, file, path, arrays[k].name, arrays[k].unit, arrays[k].meaning));
    }
    BRC_TRY(write_bonds(context, file, domain, path));
    BRC_TRY(write_sets(context, file, domain, path));
    return write_quality(context, file, domain, path);
}

brc_status brc_domain_write(brc_context *context, const brc_domain *domain, const char *path)
{
    char *aside = NULL;
    brc_h5_voice voice;
    brc_h5_quiet(&voice);
    hid_t file = -1;
    brc_status status = brc_file_aside(context, path, &aside);
    if (status != BRC_OK) goto cleanup;
    file = brc_h5_create_file(aside);
    if (file < 0) {
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, "cannot create the domain file");
        goto cleanup;
    }
    status = write_all(context, file, domain, path);
    /* flushed first: once closing has failed, the file cannot be closed any more */
    if (status == BRC_OK && H5Fflush(file, H5F_SCOPE_LOCAL) < 0)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, "cannot finish the domain file");
    if (status != BRC_OK)
        brc_h5_close_broken(file);
    else if (H5Fclose(file) < 0)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, "cannot close the domain file");
    if (status == BRC_OK) status = brc_file_commit(context, aside, path);
    if (status != BRC_OK) brc_file_discard(aside);
cleanup:
    brc_h5_loud(&voice);
    brc_memory_free(aside);
    return status;
}

/* Files of version 1 hold cells. */
static brc_status read_kind(brc_context *context, hid_t file, const char *path, int64_t version, brc_domain *d)
{
    char *kind = NULL;
    if (version < 2) return BRC_OK;
    BRC_TRY(brc_h5_read_text(context, file, path, "element_kind", &kind));
    if (strcmp(kind, kind_name[BRC_ELEMENT_SPHERE]) == 0) d->element_kind = BRC_ELEMENT_SPHERE;
    const bool known = strcmp(kind, kind_name[d->element_kind]) == 0;
    brc_memory_free(kind);
    if (known) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: its kind of elements is unknown, expected cells or spheres", path);
}

static brc_status read_header(brc_context *context, hid_t file, const char *path, int64_t *version,
                              int64_t count[N_COUNTS], brc_domain *d)
{
    char *format = NULL;
    BRC_TRY(brc_h5_read_text(context, file, path, "format", &format));
    const bool ours = strcmp(format, FORMAT_NAME) == 0;
    brc_memory_free(format);
    if (!ours) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: not a domain file of breccia", path);
    BRC_TRY(brc_h5_read_numbers(context, file, path, "format_version", BRC_H5_INT64, 1, version));
    if (*version < 1 || *version > BRC_DOMAIN_FORMAT_VERSION)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: domain format version %lld, this program reads versions 1 to %d; build "
                        "the domain again",
                        path, (long long)*version, BRC_DOMAIN_FORMAT_VERSION);
    BRC_TRY(read_kind(context, file, path, *version, d));
    for (int k = 0; k < N_COUNTS; ++k) {
        BRC_TRY(brc_h5_read_numbers(context, file, path, count_name[k], BRC_H5_INT64, 1, &count[k]));
        if (count[k] < 0 || count[k] > INT32_MAX || (k == 0 && count[k] == 0))
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: %s is %lld, must be %d to 2^31 - 1", path, count_name[k],
                            (long long)count[k], k == 0);
    }
    if (count[1] > INT32_MAX / 2)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: n_bonds is %lld, must be below 2^30", path, (long long)count[1]);
    d->n_elements = count[0];
    d->n_bonds = count[1];
    d->n_half_edges = 2 * count[1];
    d->n_free_faces = count[2];
    BRC_TRY(brc_h5_read_text(context, file, path, "provenance", &d->provenance));
    return brc_h5_read_numbers(context, file, path, "bounds", BRC_H5_DOUBLE, 6, d->bounds);
}

/* Give both half-edges of a bond its geometry; indices were not checked yet, so look before writing. */
static brc_status read_bonds(brc_context *context, hid_t file, const char *path, brc_domain *d)
{
    const char *const name[2] = {"bonds/area_vector", "bonds/face_centroid"};
    double **const to[2] = {&d->area_vector, &d->face_centroid};
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int32_t h = d->bond_half_edge[b];
        if (h < 0 || h >= d->n_half_edges || d->twin[h] < 0 || d->twin[h] >= d->n_half_edges)
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: bond %lld has a half-edge or twin out of range", path,
                            (long long)b);
    }
    if (d->element_kind == BRC_ELEMENT_SPHERE) return BRC_OK;
    for (int k = 0; k < 2; ++k) {
        void *packed = NULL;
        BRC_TRY(brc_h5_read_array(context, file, path, name[k], BRC_H5_DOUBLE, d->n_bonds, 3, &packed, NULL));
        const brc_status status = BRC_ALLOCATE(context, to[k], 3 * d->n_half_edges, name[k]);
        for (int64_t b = 0; b < d->n_bonds && status == BRC_OK; ++b)
            for (int c = 0; c < 3; ++c) {
                const int64_t h = d->bond_half_edge[b], t = d->twin[h];
                const double value = ((const double *)packed)[3 * b + c];
                (*to[k])[3 * h + c] = value;
                (*to[k])[3 * t + c] = k == 0 ? -value : value;
            }
        brc_memory_free(packed);
        BRC_TRY(status);
    }
    return BRC_OK;
}

static brc_status read_sets(brc_context *context, hid_t file, const char *path, const int64_t count[N_COUNTS],
                            brc_domain *d)
{
    char name[64];
    BRC_TRY(BRC_ALLOCATE(context, &d->wall_name, count[5], "wall names"));
    BRC_TRY(BRC_ALLOCATE(context, &d->sets, count[6], "sets"));
    for (; d->n_walls < count[5]; ++d->n_walls) {
        snprintf(name, sizeof name, "wall_%d", d->n_walls);
        BRC_TRY(brc_h5_read_text(context, file, path, name, &d->wall_name[d->n_walls]));
    }
    while (d->n_sets < count[6]) {
        brc_set *set = &d->sets[d->n_sets];
        char *kind = NULL;
        snprintf(name, sizeof name, "sets/%d", d->n_sets++);
        BRC_TRY(
            brc_h5_read_array(context, file, path, name, BRC_H5_INT32, -1, 1, (void **)&set->members, &set->n_members));
        const hid_t place = H5Dopen2(file, name, H5P_DEFAULT);
        if (place < 0) return brc_h5_fail(context, BRC_BAD_INPUT, path, name);
        brc_status status = brc_h5_read_text(context, place, path, "name", &set->name);
        if (status == BRC_OK) status = brc_h5_read_text(context, place, path, "kind", &kind);
        H5Dclose(place);
        BRC_TRY(status);
        set->kind = strcmp(kind, "faces") == 0 ? BRC_SET_FACES : BRC_SET_ELEMENTS;
        const bool known = set->kind == BRC_SET_FACES || strcmp(kind, "elements") == 0;
        brc_memory_free(kind);
        if (!known) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the kind of '%s' is unknown", path, name);
    }
    return BRC_OK;
}

static brc_status read_quality(brc_context *context, hid_t file, const char *path, int64_t version, brc_domain *d)
{
    const hid_t place = H5Gopen2(file, "quality", H5P_DEFAULT);
    if (place < 0) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the group 'quality' is missing", path);
    brc_status status = BRC_OK;
    for (int k = 0; k < N_QUALITY && status == BRC_OK; ++k)
        if (quality_fields[k].since <= version)
            status = brc_h5_read_numbers(context, place, path, quality_fields[k].name, quality_fields[k].kind,
                                         quality_fields[k].n, (char *)&d->quality + quality_fields[k].field);
    H5Gclose(place);
    return status;
}

static brc_status read_arrays(brc_context *context, hid_t file, const char *path, int64_t version,
                              const int64_t count[N_COUNTS], brc_domain *d)
{
    int64_t rows[N_ROWS_OF], has_grains = 0;
    rows_from_counts(count, rows);
    if (version > 1) BRC_TRY(brc_h5_read_numbers(context, file, path, "has_grains", BRC_H5_INT64, 1, &has_grains));
    for (int k = 0; k < N_ARRAYS; ++k)
        if (has_array(d, &arrays[k], has_grains != 0))
            BRC_TRY(brc_h5_read_array(context, file, path, arrays[k].name, arrays[k].kind, rows[arrays[k].rows],
                                      arrays[k].width, pointer_of(d, &arrays[k]), NULL));
    const bool cells = d->element_kind == BRC_ELEMENT_CELL;
    if ((cells ? d->vertex_start[d->n_elements] : 0) != count[3] ||
        (cells ? d->free_polygon_start[d->n_free_faces] : 0) != count[4])
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the rows of corners do not end at their number", path);
    return read_bonds(context, file, path, d);
}

static brc_status read_all(brc_context *context, hid_t file, const char *path, brc_domain *d)
{
    int64_t version = 0, count[N_COUNTS];
    BRC_TRY(read_header(context, file, path, &version, count, d));
    BRC_TRY(read_arrays(context, file, path, version, count, d));
    BRC_TRY(read_sets(context, file, path, count, d));
    BRC_TRY(read_quality(context, file, path, version, d));
    const brc_status status = brc_domain_check(context, d);
    if (status != BRC_OK)
        return BRC_FAIL(context, status, "%s: the domain in this file is broken; build it again", path);
    if (version < 2) brc_quality_measure(d, omp_get_max_threads()); /* numbers that the file does not have */
    return BRC_OK;
}

brc_status brc_domain_read(brc_context *context, const char *path, brc_domain **out)
{
    *out = NULL;
    if (!brc_file_exists(path))
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: no such file; write it with 'breccia build'", path);
    brc_domain *domain = NULL;
    brc_h5_voice voice;
    brc_h5_quiet(&voice);
    hid_t file = -1;
    brc_status status = BRC_ALLOCATE(context, &domain, 1, "domain");
    if (status != BRC_OK) goto cleanup;
    if (H5Fis_hdf5(path) <= 0) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: not an HDF5 file, expected a domain file of breccia", path);
        goto cleanup;
    }
    file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) {
        status = brc_h5_fail(context, BRC_BAD_INPUT, path, "cannot open the domain file");
        goto cleanup;
    }
    status = read_all(context, file, path, domain);
    if (status != BRC_OK) goto cleanup;
    *out = domain;
    domain = NULL;
cleanup:
    if (file >= 0) H5Fclose(file);
    brc_h5_loud(&voice);
    brc_domain_free(&domain);
    return status;
}
