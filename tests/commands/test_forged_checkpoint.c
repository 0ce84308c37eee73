/* Checkpoints whose numbers somebody changed and sealed again: whatever number of a state is not finite, in whichever
 * array, resume refuses it by the array's name. */
#include "support.h"
#include "../../host/base/log.h"
#include "../../host/output/seal.h"
#include <dirent.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 200 };
typedef struct listed {
    char name[MOST][96];
    int n;
} listed;

/* A body that breaks on a floor with friction, under a pressure: pairs, cells that came off, a striker and a load
 * remember something. */
static const char scene[] =
    "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3, strength: {tension: 1 MPa}}}\n"
    "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [3, 3, 3]}}}]\n"
    "fracture: {}\ninteractions: {contact: {friction: 0.3, restitution: 0.7}}\n"
    "strikers: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: m}}\n"
    "stages: [{name: fall, solver: {dynamic: {steps: 100}}, initial: [{velocity: {velocity: [5 m/s, 0, -30 m/s]}}], "
    "loads: [{pressure: {set: z+, value: 1 MPa}}]}]\n"
    "sensors: {total: {energy: kinetic}}\noutput: {frames: none, picture: false, history_every: 20, checkpoint: "
    "{every: 1 ns}}\n";

static brc_context *context;
static char kept[256];

static int begin(void **state)
{
    (void)state;
    context = brc_context_create();
    return context ? test_make_folder(scene) : -1;
}

static int end(void **state)
{
    brc_context_free(&context);
    return test_remove_folder(state);
}

static herr_t list_one(hid_t file, const char *name, const H5L_info_t *info, void *to)
{
    listed *l = to;
    (void)info;
    const hid_t data = H5Dopen2(file, name, H5P_DEFAULT);
    if (data < 0) return 0; /* a group */
    const hid_t type = H5Dget_type(data), space = H5Dget_space(data);
    if (H5Tget_class(type) == H5T_FLOAT && H5Sget_simple_extent_npoints(space) > 0) {
        assert_true(l->n < MOST);
        snprintf(l->name[l->n++], sizeof l->name[0], "%s", name);
    }
    H5Sclose(space), H5Tclose(type), H5Dclose(data);
    return 0;
}

static void list_numbers(const char *path, listed *out)
{
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    H5E_auto2_t report;
    void *to;
    out->n = 0;
    assert_true(file >= 0);
    H5Eget_auto2(H5E_DEFAULT, &report, &to);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    assert_true(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, list_one, out) >= 0);
    H5Eset_auto2(H5E_DEFAULT, report, to);
    H5Fclose(file);
}

static void copy(const char *from, const char *to)
{
    char command[600];
    snprintf(command, sizeof command, "cp %s %s", from, to);
    assert_int_equal(system(command), 0);
}

/* Checkpoints of the run but the one that is kept beside them. */
static void remove_all(void)
{
    char command[300];
    snprintf(command, sizeof command, "rm -f %s/out/checkpoints/*", test_folder());
    assert_int_equal(system(command), 0);
}

static void find_newest(char path[256])
{
    char folder_of[128];
    snprintf(folder_of, sizeof folder_of, "%s/out/checkpoints", test_folder());
    DIR *directory = opendir(folder_of);
    path[0] = '\0';
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry; entry = readdir(directory)) {
        char one[256];
        snprintf(one, sizeof one, "%s/%.40s", folder_of, entry->d_name);
        if (entry->d_name[0] != '.' && strcmp(one, path) > 0) memcpy(path, one, sizeof one);
    }
    if (directory) closedir(directory);
    assert_true(path[0] != '\0');
}

/* The last number of a data set, and a seal that fits. */
static void forge(const char *path, const char *name, double value)
{
    remove_all();
    copy(kept, path);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), data = H5Dopen2(file, name, H5P_DEFAULT),
                space = H5Dget_space(data);
    assert_true(file >= 0 && data >= 0);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    double *all = calloc((size_t)n, sizeof *all);
    assert_true(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0);
    all[n - 1] = value;
    assert_true(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) >= 0);
    free(all);
    H5Sclose(space), H5Dclose(data), H5Fclose(file);
    assert_int_equal(brc_seal_add(context, path), BRC_OK);
}

/* Not of the state: what a report may lack, and when the file was written. */
static bool may_be_nan(const char *name)
{
    return strstr(name, "/regime.") ? !strstr(name, "regime.peak_elastic")
                                    : strcmp(name, "run/history.value") == 0 || strcmp(name, "moment/time") == 0;
}

static void a_number_that_is_not_finite_is_refused_by_the_name_of_its_array(void **state)
{
    (void)state;
    static const char *const known[] = {"parts/0/contact.history",       "parts/0/contact.momentum",
                                        "parts/0/displacement",          "parts/0/velocity",
                                        "parts/0/fracture.lost",         "parts/0/time_step.value",
                                        "parts/0/loads.traction.0.work", "parts/0/strikers.pose"};
    static listed all;
    char arguments[400], path[256];
    bool found = false;
    snprintf(arguments, sizeof arguments, "run %s/scene.yaml --device cpu --threads 1 -o %s/out", test_folder(),
             test_folder());
    if (test_program(arguments) != 0) fail_msg("%s", test_program_stderr());
    find_newest(path);
    snprintf(kept, sizeof kept, "%s/kept.h5", test_folder());
    copy(path, kept);
    list_numbers(path, &all);
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k, found = false) {
        for (int i = 0; i < all.n; ++i)
            found |= strcmp(all.name[i], known[k]) == 0;
        if (!found) fail_msg("the checkpoint has no %s", known[k]);
    }
    strncat(arguments, " --resume", sizeof arguments - strlen(arguments) - 1);
    for (int i = 0; i < all.n; ++i) {
        const bool report = may_be_nan(all.name[i]);
        forge(path, all.name[i], i % 3 == 0 ? NAN : i % 3 == 1 ? INFINITY : -INFINITY);
        const int code = test_program(arguments);
        if (code != (report ? 0 : 2)) fail_msg("%s: exit code %d: %s", all.name[i], code, test_program_stderr());
        if (!report && (!strstr(test_program_stderr(), all.name[i]) || !strstr(test_program_stderr(), "finite")))
            fail_msg("%s is not named: %s", all.name[i], test_program_stderr());
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_number_that_is_not_finite_is_refused_by_the_name_of_its_array),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
