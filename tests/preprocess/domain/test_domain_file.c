#include "../spheres.h"
#include "../support.h"

#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/domain_file.h"
#include "../../../preprocess/packing/beams.h"

#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static const char path[] = "domain_under_test.h5";

static brc_domain *sample(brc_context *context)
{
    static const brc_set_request sets[2] = {
        {.name = "grip", .kind = BRC_SET_FACES, .where = {.has_wall = true, .wall = "side"}},
        {.name = "core",
         .kind = BRC_SET_ELEMENTS,
         .where = {.has_sphere = true, .sphere_centre = {0.5, 0, 0}, .sphere_radius = 0.2}}};
    brc_build_request r = test_cylinder(300, 0.9);
    r.sets = sets;
    r.n_sets = 2;
    r.body = 3;
    return test_build(context, &r);
}

static void assert_refused(brc_context *context, const char *file, const char *says)
{
    brc_domain *d;
    brc_context_clear(context);
    assert_int_equal(brc_domain_read(context, file, &d), BRC_BAD_INPUT);
    assert_null(d);
    test_says(context, file);
    test_says(context, says);
}

static void what_was_written_is_read_back_bit_for_bit(void **state)
{
    brc_context *context = *state;
    brc_domain *a = sample(context), *b;
    assert_int_equal(brc_domain_write(context, a, path), BRC_OK);
    assert_int_equal(brc_domain_read(context, path, &b), BRC_OK);
    const int64_t n = a->n_elements, h = a->n_half_edges, f = a->n_free_faces, v = a->vertex_start[n];
    assert_int_equal(b->n_elements, n);
    assert_int_equal(b->n_bonds, a->n_bonds);
    assert_int_equal(b->n_half_edges, h);
    assert_int_equal(b->n_free_faces, f);
#define SAME(field, count) assert_memory_equal(a->field, b->field, (size_t)(count) * sizeof *a->field)
    SAME(position, 3 * n);
    SAME(volume, n);
    SAME(centroid, 3 * n);
    SAME(inertia, 6 * n);
    SAME(region, n);
    SAME(body, n);
    SAME(row_start, n + 1);
    SAME(neighbour, h);
    SAME(twin, h);
    SAME(bond, h);
    SAME(area_vector, 3 * h);
    SAME(face_centroid, 3 * h);
    SAME(bond_half_edge, a->n_bonds);
    SAME(free_start, n + 1);
    SAME(free_element, f);
    SAME(free_area_vector, 3 * f);
    SAME(free_centroid, 3 * f);
    SAME(free_wall, f);
    SAME(vertex_start, n + 1);
    SAME(vertex, 3 * v);
    SAME(free_polygon_start, f + 1);
    SAME(free_polygon, a->free_polygon_start[f]);
    assert_memory_equal(&a->quality, &b->quality, sizeof a->quality);
    assert_memory_equal(a->bounds, b->bounds, sizeof a->bounds);
    assert_string_equal(a->provenance, b->provenance);
    assert_int_equal(a->n_walls, b->n_walls);
    for (int32_t w = 0; w < a->n_walls; ++w)
        assert_string_equal(a->wall_name[w], b->wall_name[w]);
    assert_int_equal(a->n_sets, b->n_sets);
    for (int32_t s = 0; s < a->n_sets; ++s) {
        assert_string_equal(a->sets[s].name, b->sets[s].name);
        assert_int_equal(a->sets[s].kind, b->sets[s].kind);
        assert_int_equal(a->sets[s].n_members, b->sets[s].n_members);
        SAME(sets[s].members, a->sets[s].n_members);
    }
    brc_domain_free(&a);
    brc_domain_free(&b);
    remove(path);
}

static void spheres_and_grains_are_read_back_bit_for_bit(void **state)
{
    brc_context *context = *state;
    const int count[3] = {6, 5, 4};
    brc_domain *a = test_spheres(context, count, 8.0, 2, 1), *b;
    const int64_t n = a->n_elements, h = a->n_half_edges;
    assert_int_equal(BRC_ALLOCATE(context, &a->grain, n, "grains"), BRC_OK);
    for (int64_t e = 0; e < n; ++e)
        a->grain[e] = (int32_t)(e % 5);
    assert_int_equal(brc_domain_write(context, a, path), BRC_OK);
    if (brc_domain_read(context, path, &b) != BRC_OK) fail_msg("%s", brc_context_message(context));
    assert_int_equal(b->element_kind, BRC_ELEMENT_SPHERE);
    assert_int_equal(b->n_elements, n);
    assert_int_equal(b->n_bonds, a->n_bonds);
    SAME(position, 3 * n);
    SAME(radius, n);
    SAME(grain, n);
    SAME(volume, n);
    SAME(centroid, 3 * n);
    SAME(inertia, 6 * n);
    SAME(body, n);
    SAME(row_start, n + 1);
    SAME(neighbour, h);
    SAME(twin, h);
    SAME(bond, h);
    SAME(bond_half_edge, a->n_bonds);
    assert_memory_equal(&a->quality, &b->quality, sizeof a->quality);
    assert_int_equal(b->n_walls, 6);
    assert_int_equal(b->n_sets, 12);
    for (int32_t s = 0; s < 12; ++s)
        SAME(sets[s].members, a->sets[s].n_members);
    assert_null(b->area_vector);
    assert_null(b->free_start);
    assert_null(b->vertex);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(H5Lexists(file, "elements/radius", H5P_DEFAULT) > 0);
    assert_int_equal(H5Lexists(file, "free_faces", H5P_DEFAULT), 0);
    assert_int_equal(H5Lexists(file, "bonds/area_vector", H5P_DEFAULT), 0);
    H5Fclose(file);
    brc_domain_free(&a);
    brc_domain_free(&b);
    remove(path);
}

/* domain_version1.h5 was written by version 1 of the format: eight cubes of 1 m, body 3, region 1 above z = 1 m, set
 * "top". */
static void files_of_version_1_are_still_read(void **state)
{
    brc_domain *d;
    if (brc_domain_read(*state, BRC_SOURCE_DIR_PATH "/tests/preprocess/domain_version1.h5", &d) != BRC_OK)
        fail_msg("%s", brc_context_message(*state));
    assert_int_equal(d->element_kind, BRC_ELEMENT_CELL);
    assert_int_equal(d->n_elements, 8);
    assert_int_equal(d->n_bonds, 12);
    assert_int_equal(d->n_free_faces, 24);
    assert_null(d->grain);
    assert_null(d->radius);
    for (int64_t e = 0; e < 8; ++e) {
        assert_near(d->volume[e], 1.0, 1e-14);
        assert_int_equal(d->body[e], 3);
        assert_int_equal(d->region[e], d->position[3 * e + 2] > 1.0);
    }
    assert_int_equal(d->sets[brc_domain_find_set(d, "top")].n_members, 4);
    /* numbers that version 1 did not have are measured */
    assert_int_equal(d->quality.n_pieces, 1);
    assert_near(d->quality.faces_spread[2], 6.0, 0.0);
    assert_near(d->quality.branch_spread[4], 1.0, 1e-7); /* single precision */
    assert_near(d->quality.coordination_mean, 3.0, 0.0);
    brc_domain_free(&d);
}

/* domain_version2.h5 was written by version 2: 27 cubes of 1 m, two grains, set "top". Integers have 64 bits there, and
 * faces stand once a bond. */
static void files_of_version_2_are_still_read(void **state)
{
    brc_domain *d;
    if (brc_domain_read(*state, BRC_SOURCE_DIR_PATH "/tests/preprocess/domain_version2.h5", &d) != BRC_OK)
        fail_msg("%s", brc_context_message(*state));
    assert_int_equal(d->n_elements, 27);
    assert_int_equal(d->n_bonds, 54);
    assert_int_equal(d->pages.n, 0);
    int32_t grains = 0;
    for (int64_t e = 0; e < 27; ++e)
        grains |= 1 << d->grain[e];
    assert_int_equal(grains, 3);
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        const double *s = d->area_vector + 3 * h;
        assert_near(s[0] * s[0] + s[1] * s[1] + s[2] * s[2], 1.0, 1e-14);
    }
    assert_int_equal(d->sets[brc_domain_find_set(d, "top")].n_members, 9);
    brc_domain_free(&d);
}

static void numbers_are_stored_as_in_memory_little_endian(void **state)
{
    brc_domain *d = sample(*state);
    assert_int_equal(brc_domain_write(*state, d, path), BRC_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    const char *const name[5] = {"half_edges/neighbour", "elements/body", "half_edges/area_vector", "sets/0",
                                 "cells/vertex_start"};
    for (int k = 0; k < 5; ++k) {
        const hid_t set = H5Dopen2(file, name[k], H5P_DEFAULT), type = H5Dget_type(set);
        assert_true(H5Tequal(type, k == 2 ? H5T_IEEE_F64LE : k == 4 ? H5T_STD_I64LE : H5T_STD_I32LE) > 0);
        if (k == 2) assert_int_equal(H5Dget_offset(set) % BRC_FILE_PAGE, 0);
        H5Tclose(type);
        H5Dclose(set);
    }
    H5Fclose(file);
    brc_domain_free(&d);
    remove(path);
}

/* Long arrays are not in memory that the program holds; what is written to them stays with the domain, also where the
 * file has another name or none. */
static void long_arrays_are_pages_of_the_file(void **state)
{
    brc_context *context = *state;
    brc_build_request r = test_box(4000, 0.9);
    brc_domain *a = test_build(context, &r), *b, *again;
    const int64_t built = brc_memory_held(), n = a->n_elements, v = 3 * a->vertex_start[n];
    assert_int_equal(brc_domain_write(context, a, path), BRC_OK);
    assert_int_equal(brc_domain_read(context, path, &b), BRC_OK);
    const int64_t own = brc_memory_held() - built;
    assert_true(b->pages.n >= 10);
    if (10 * own > built) fail_msg("%lld bytes of %lld are held", (long long)own, (long long)built);
    assert_true(brc_memory_block_bytes(b->vertex) >= v * (int64_t)sizeof *b->vertex);
    SAME(vertex, v);
    b->vertex[1] = -7.0;
    assert_int_equal(brc_domain_read(context, path, &again), BRC_OK);
    assert_memory_equal(again->vertex, a->vertex, (size_t)v * sizeof *a->vertex);
    brc_domain_free(&again);
    remove(path);
    assert_true(b->vertex[1] == -7.0);
    b->vertex[1] = a->vertex[1];
    SAME(area_vector, 3 * a->n_half_edges);
    assert_int_equal(brc_domain_take_pages(context, b), BRC_OK);
    assert_int_equal(b->pages.n, 0);
    assert_true(brc_memory_held() - built > built / 2);
    SAME(vertex, v);
    SAME(twin, a->n_half_edges);
    test_same_bytes(context, a, b);
    brc_domain_free(&a);
    brc_domain_free(&b);
}

static void foreign_and_missing_files_are_refused(void **state)
{
    brc_context *context = *state;
    assert_refused(context, "no_such_file.h5", "no such file");
    FILE *file = fopen(path, "wb");
    fputs("not a domain\n", file);
    fclose(file);
    assert_refused(context, path, "not an HDF5 file");
    remove(path);
    H5Fclose(H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    assert_refused(context, path, "'format' is missing");
    remove(path);
    assert_refused(context, ".", "not an HDF5 file");
}

/* Open the written file, let `change` spoil it, and expect the sentence. */
static void spoil(brc_context *context, void (*change)(hid_t file), const char *says)
{
    brc_domain *d = sample(context);
    assert_int_equal(brc_domain_write(context, d, path), BRC_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    assert_refused(context, path, says);
    brc_domain_free(&d);
    remove(path);
}

static void write_version(hid_t file, int64_t version)
{
    const hid_t attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_INT64, &version);
    H5Aclose(attribute);
}

static void set_version(hid_t file)
{
    write_version(file, 99);
}

/* Spheres of version 3 have their own volumes. */
static void spheres_of_version_3_stand_for_their_part_of_the_body(void **state)
{
    const int count[3] = {6, 5, 4};
    brc_domain *a = test_spheres(*state, count, 8.0, 2, 1), *b;
    brc_beams_fill(a, 1);
    assert_int_equal(brc_domain_write(*state, a, path), BRC_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    write_version(file, 3);
    H5Fclose(file);
    if (brc_domain_read(*state, path, &b) != BRC_OK) fail_msg("%s", brc_context_message(*state));
    brc_beams_fill(a, a->quality.volume_fraction);
    assert_memory_equal(a->volume, b->volume, 120 * sizeof(double));
    assert_memory_equal(a->inertia, b->inertia, 720 * sizeof(double));
    brc_domain_free(&a);
    brc_domain_free(&b);
    remove(path);
}

static void set_count(hid_t file)
{
    const hid_t attribute = H5Aopen(file, "n_elements", H5P_DEFAULT);
    const int64_t count = INT32_MAX;
    H5Awrite(attribute, H5T_NATIVE_INT64, &count);
    H5Aclose(attribute);
}

static void change_kind(hid_t file)
{
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, 5);
    H5Adelete(file, "element_kind");
    const hid_t attribute = H5Acreate2(file, "element_kind", type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, "cubes");
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

static void delete_array(hid_t file)
{
    H5Ldelete(file, "half_edges/twin", H5P_DEFAULT);
}

static void replace(hid_t file, hid_t type, hsize_t rows)
{
    H5Ldelete(file, "elements/volume", H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &rows, NULL);
    H5Dclose(H5Dcreate2(file, "elements/volume", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
}

static void wrong_shape(hid_t file)
{
    replace(file, H5T_IEEE_F64LE, 3);
}

static void wrong_type(hid_t file)
{
    replace(file, H5T_IEEE_F32LE, 3);
}

static void change_a_number(hid_t file)
{
    const hid_t set = H5Dopen2(file, "elements/position", H5P_DEFAULT);
    double x[3000];
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x);
    x[17] += 1e-9;
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x);
    H5Dclose(set);
}

static void spoiled_files_are_refused_with_what_is_wrong(void **state)
{
    spoil(*state, set_version, "format version 99, this program reads versions 1 to 4");
    spoil(*state, set_count, "expected [2147483647]");
    spoil(*state, change_kind, "kind of elements is unknown, expected cells or spheres");
    spoil(*state, delete_array, "'half_edges/twin' is missing");
    spoil(*state, wrong_shape, "'elements/volume' has the shape [3][1], expected [3");
    spoil(*state, wrong_type, "'elements/volume' has another type");
    spoil(*state, change_a_number, "'elements/position' was damaged");
}

/* Cut the file at many lengths and flip bytes at many places: always refused or read as it was, never a crash. */
static void damaged_bytes_never_give_a_wrong_domain(void **state)
{
    brc_context *context = *state;
    brc_domain *d = sample(context), *back;
    assert_int_equal(brc_domain_write(context, d, path), BRC_OK);
    FILE *file = fopen(path, "rb");
    fseek(file, 0, SEEK_END);
    const long n = ftell(file);
    char *bytes;
    assert_int_equal(BRC_ALLOCATE(context, &bytes, n, "file"), BRC_OK);
    rewind(file);
    assert_int_equal(fread(bytes, 1, (size_t)n, file), (size_t)n);
    fclose(file);
    for (int k = 0; k < 120; ++k) {
        const bool cut = k < 40;
        const long at = (long)((double)n * (k % (cut ? 40 : 80)) / (cut ? 40 : 80));
        if (!cut) bytes[at] ^= 0x41;
        file = fopen(path, "wb");
        fwrite(bytes, 1, (size_t)(cut ? at : n), file);
        fclose(file);
        if (!cut) bytes[at] ^= 0x41;
        brc_context_clear(context);
        const brc_status status = brc_domain_read(context, path, &back);
        if (status == BRC_OK) { /* a byte nobody reads */
            assert_false(cut);
            assert_memory_equal(back->position, d->position, 3 * (size_t)d->n_elements * sizeof(double));
            assert_memory_equal(back->neighbour, d->neighbour, (size_t)d->n_half_edges * sizeof(int32_t));
            brc_domain_free(&back);
        } else {
            assert_int_equal(status, BRC_BAD_INPUT);
            assert_true(strlen(brc_context_message(context)) > 20);
        }
    }
    brc_memory_free(bytes);
    brc_domain_free(&d);
    remove(path);
}

/* A limit on the size of files stops HDF5 like a full disk does: one sentence, no crash, the old file stays, no rest is
 * left. */
static void a_full_disk_gives_a_sentence_and_keeps_the_old_file(void **state)
{
    brc_context *context = *state;
    brc_domain *d = sample(context), *back;
    assert_int_equal(brc_domain_write(context, d, path), BRC_OK);
    struct rlimit old, small = {.rlim_cur = 100000};
    getrlimit(RLIMIT_FSIZE, &old);
    small.rlim_max = old.rlim_max;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const brc_status status = brc_domain_write(context, d, path);
    setrlimit(RLIMIT_FSIZE, &old);
    signal(SIGXFSZ, SIG_DFL);
    assert_int_equal(status, BRC_FILE_FAILED);
    test_says(context, path);
    test_says(context, "File too large");
    assert_int_equal(brc_domain_read(context, path, &back), BRC_OK);
    assert_null(fopen("domain_under_test.h5.part", "rb"));
    brc_domain_free(&back);
    assert_int_equal(brc_domain_write(context, d, "/no/such/folder/d.h5"), BRC_FILE_FAILED);
    test_says(context, "/no/such/folder/d.h5");
    brc_domain_free(&d);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_was_written_is_read_back_bit_for_bit, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_and_grains_are_read_back_bit_for_bit, test_begin, test_end),
        cmocka_unit_test_setup_teardown(files_of_version_1_are_still_read, test_begin, test_end),
        cmocka_unit_test_setup_teardown(files_of_version_2_are_still_read, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_of_version_3_stand_for_their_part_of_the_body, test_begin, test_end),
        cmocka_unit_test_setup_teardown(numbers_are_stored_as_in_memory_little_endian, test_begin, test_end),
        cmocka_unit_test_setup_teardown(long_arrays_are_pages_of_the_file, test_begin, test_end),
        cmocka_unit_test_setup_teardown(foreign_and_missing_files_are_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spoiled_files_are_refused_with_what_is_wrong, test_begin, test_end),
        cmocka_unit_test_setup_teardown(damaged_bytes_never_give_a_wrong_domain, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_full_disk_gives_a_sentence_and_keeps_the_old_file, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
