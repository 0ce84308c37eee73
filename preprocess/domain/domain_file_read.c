/* Arrays that lie in the file as in memory are its pages; the others, and all that is short, are read. */
#include "domain_file_internal.h"

#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../packing/beams.h"
#include "quality.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Files of version 1 hold cells. */
static brc_status read_kind(brc_context *context, hid_t file, const char *path, int64_t version, brc_domain *d)
{
    char *kind = NULL;
    if (version < 2) return BRC_OK;
    BRC_TRY(brc_h5_read_text(context, file, path, "element_kind", &kind));
    if (strcmp(kind, brc_domain_kind_name[BRC_ELEMENT_SPHERE]) == 0) d->element_kind = BRC_ELEMENT_SPHERE;
    const bool known = strcmp(kind, brc_domain_kind_name[d->element_kind]) == 0;
    brc_memory_free(kind);
    if (known) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: its kind of elements is unknown, expected cells or spheres", path);
}

static brc_status read_header(brc_context *context, hid_t file, const char *path, int64_t *version,
                              int64_t count[N_COUNTS], brc_domain *d)
{
    char *format = NULL;
    BRC_TRY(brc_h5_read_text(context, file, path, "format", &format));
    const bool ours = strcmp(format, BRC_DOMAIN_FORMAT_NAME) == 0;
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
        BRC_TRY(brc_h5_read_numbers(context, file, path, brc_domain_count_name[k], BRC_H5_INT64, 1, &count[k]));
        if (count[k] < 0 || count[k] > INT32_MAX || (k == 0 && count[k] == 0))
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: %s is %lld, must be %d to 2^31 - 1", path,
                            brc_domain_count_name[k], (long long)count[k], k == 0);
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

/* Files before version 3: give both half-edges of a bond its geometry; indices were not checked yet, so look before
 * writing. */
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
    for (int k = 0; k < brc_n_quality_fields && status == BRC_OK; ++k)
        if (brc_quality_fields[k].since <= version)
            status = brc_h5_read_numbers(context, place, path, brc_quality_fields[k].name, brc_quality_fields[k].kind,
                                         brc_quality_fields[k].n, (char *)&d->quality + brc_quality_fields[k].field);
    H5Gclose(place);
    return status;
}

static void **pointer_of(brc_domain *domain, const brc_domain_array *entry)
{
    return (void **)(void *)((char *)domain + entry->field);
}

static brc_status read_arrays(brc_context *context, hid_t file, const char *path, int64_t version,
                              const int64_t count[N_COUNTS], brc_domain *d)
{
    const brc_h5_pages pages = {brc_h5_descriptor(file), &d->elsewhere, &d->pages};
    int64_t rows[N_ROWS_OF], has_grains = 0;
    BRC_TRY(brc_file_pages_begin(context, pages.file, path, brc_domain_n_arrays, &d->elsewhere, &d->pages));
    brc_domain_rows_from_counts(count, rows);
    if (version > 1) BRC_TRY(brc_h5_read_numbers(context, file, path, "has_grains", BRC_H5_INT64, 1, &has_grains));
    for (int k = 0; k < brc_domain_n_arrays; ++k) {
        const brc_domain_array *const a = &brc_domain_arrays[k];
        if (a->since <= version && brc_domain_has_array(d, a, has_grains != 0))
            BRC_TRY(brc_h5_map_array(context, file, path, a->name, a->kind, rows[a->rows], a->width, &pages,
                                     pointer_of(d, a)));
    }
    const bool cells = d->element_kind == BRC_ELEMENT_CELL;
    if ((cells ? d->vertex_start[d->n_elements] : 0) != count[3] ||
        (cells ? d->free_polygon_start[d->n_free_faces] : 0) != count[4])
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the rows of corners do not end at their number", path);
    return version < 3 ? read_bonds(context, file, path, d) : BRC_OK;
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
    brc_file_pages_forget(&d->pages, &d->elsewhere);
    if (version < 2) brc_quality_measure(d, omp_get_max_threads()); /* numbers that the file does not have */
    if (version > 3 || d->element_kind != BRC_ELEMENT_SPHERE) return BRC_OK;
    BRC_TRY(brc_domain_take_pages(context, d));
    brc_beams_fill(d, d->quality.volume_fraction);
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
