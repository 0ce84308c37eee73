/* One table lists every array of the file; writing and reading (domain_file_read.c) walk it. What follows from other
 * arrays is stored all the same, so that each lies in the file as it does in memory and is read by mapping its pages.
 */
#include "domain_file_internal.h"

#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/base/version.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define ENTRY_SINCE(since, path, field, kind, rows, width, found, unit, meaning)                                       \
    {                                                                                                                  \
        path, offsetof(brc_domain, field), kind, rows, width, found, since, unit, meaning                              \
    }
#define ENTRY(...) ENTRY_SINCE(1, __VA_ARGS__)
const brc_domain_array brc_domain_arrays[] = {
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
    ENTRY_SINCE(3, "half_edges/area_vector", area_vector, BRC_H5_DOUBLE, HALF_EDGES, 3, CELLS, "m^2",
                "area vector of each half-edge's face, outward: exactly the negative of its twin's; x y z"),
    ENTRY_SINCE(3, "half_edges/face_centroid", face_centroid, BRC_H5_DOUBLE, HALF_EDGES, 3, CELLS, "m",
                "centroid of each half-edge's face: its twin's; x y z"),
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
const int brc_domain_n_arrays = (int)(sizeof brc_domain_arrays / sizeof *brc_domain_arrays);
static const char *const groups[] = {"elements", "half_edges", "bonds", "sets", "quality", "free_faces", "cells"};
enum { N_GROUPS = (int)(sizeof groups / sizeof *groups), N_GROUPS_OF_SPHERES = N_GROUPS - 2 };
const char *const brc_domain_kind_name[] = {"cells", "spheres"};

#define QUALITY(field, kind, n)                                                                                        \
    {                                                                                                                  \
#field, offsetof(brc_quality, field), kind, n, 1                                                               \
    }
#define QUALITY_2(field, kind, n)                                                                                      \
    {                                                                                                                  \
#field, offsetof(brc_quality, field), kind, n, 2                                                               \
    }
const brc_quality_field brc_quality_fields[] = {
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
const int brc_n_quality_fields = (int)(sizeof brc_quality_fields / sizeof *brc_quality_fields);

const char *const brc_domain_count_name[N_COUNTS] = {"n_elements",        "n_bonds", "n_free_faces", "n_corners",
                                                     "n_polygon_corners", "n_walls", "n_sets"};

void brc_domain_rows_from_counts(const int64_t count[N_COUNTS], int64_t rows[N_ROWS_OF])
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

bool brc_domain_has_array(const brc_domain *domain, const brc_domain_array *entry, bool has_grains)
{
    switch (entry->found) {
    case ALL: return true;
    case CELLS: return domain->element_kind == BRC_ELEMENT_CELL;
    case SPHERES: return domain->element_kind == BRC_ELEMENT_SPHERE;
    case GRAINS: break;
    }
    return has_grains;
}

static brc_status write_attributes(brc_context *context, hid_t file, const brc_domain *d, const char *path,
                                   const int64_t count[N_COUNTS])
{
    const int64_t version = BRC_DOMAIN_FORMAT_VERSION, has_grains = d->grain != NULL;
    BRC_TRY(brc_h5_write_text(context, file, path, "format", BRC_DOMAIN_FORMAT_NAME));
    BRC_TRY(brc_h5_write_numbers(context, file, path, "format_version", BRC_H5_INT64, 1, &version));
    BRC_TRY(brc_h5_write_text(context, file, path, "written_by", brc_version()));
    BRC_TRY(brc_h5_write_text(context, file, path, "element_kind", brc_domain_kind_name[d->element_kind]));
    BRC_TRY(brc_h5_write_numbers(context, file, path, "has_grains", BRC_H5_INT64, 1, &has_grains));
    BRC_TRY(brc_h5_write_text(context, file, path, "units", "SI: m, m^2, m^3; inertia at unit density: m^5"));
    BRC_TRY(brc_h5_write_text(context, file, path, "provenance", d->provenance));
    for (int k = 0; k < N_COUNTS; ++k)
        BRC_TRY(brc_h5_write_numbers(context, file, path, brc_domain_count_name[k], BRC_H5_INT64, 1, &count[k]));
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
    for (int k = 0; k < brc_n_quality_fields && status == BRC_OK; ++k)
        status = brc_h5_write_numbers(context, place, path, brc_quality_fields[k].name, brc_quality_fields[k].kind,
                                      brc_quality_fields[k].n, (const char *)&d->quality + brc_quality_fields[k].field);
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
    brc_domain_rows_from_counts(count, rows);
    BRC_TRY(write_attributes(context, file, domain, path, count));
    BRC_TRY(write_groups(context, file, domain, path));
    for (int k = 0; k < brc_domain_n_arrays; ++k) {
        const brc_domain_array *const a = &brc_domain_arrays[k];
        const void *data = *(void *const *)(const void *)((const char *)domain + a->field);
        if (!brc_domain_has_array(domain, a, domain->grain != NULL)) continue;
        BRC_TRY(brc_h5_write_array(context, file, path, a->name, a->kind, rows[a->rows], a->width, data));
        BRC_TRY(describe(context, file, path, a->name, a->unit, a->meaning));
    }
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
