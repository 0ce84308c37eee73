/* What other programs are given and what is read from them, without them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "../../bench/cube.h"
#include "../../bench/peer.h"
#include "../../bench/peer_bar.h"
#include "../../bench/peer_work.h"
#include "../../bench/statics_peer.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"

#define assert_near(value, expected, tolerance) assert_true(fabs((value) - (expected)) <= (tolerance))

static const brc_peer_request timed = {.steps = 100, .n_threads = 1},
                              sampled = {.steps = 100, .every = 10, .n_threads = 1};

static void read_text(brc_context *context, const char *text, const brc_peer_request *request, brc_peer_result *result)
{
    memset(result, 0, sizeof *result);
    assert_int_equal(brc_peer_read(context, text, request, result), BRC_OK);
}

static void the_lines_of_a_timed_run_are_read(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_peer_result r;
    read_text(context,
              "Welcome\nbreccia-peer version 2023.02a\nbreccia-peer seconds 4.5\nbreccia-peer processor "
              "1.25\nbreccia-peer bonds 77\n",
              &timed, &r);
    assert_string_equal(r.version, "2023.02a");
    assert_true(r.wall_s == 4.5 && r.processor_s == 1.25 && r.bonds == 77);
    assert_string_equal(r.note, "");
    brc_peer_result_free(&r);
    brc_context_free(&context);
}

/* 2 s on 1 process at 50 % are 1 s of the processor; the run before, whose loop is longer, was the warming up. */
static void of_lammps_the_last_loop_and_its_share_of_the_processor_count(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_peer_result r;
    const char *text =
        "Loop time of 9.0 on 1 procs for 10 steps with 8 atoms\n\n99.0% CPU use with 1 MPI tasks x 1 OpenMP threads\n"
        "Loop time of 2.0 on 1 procs for 100 steps with 8 atoms\n\n50.0% CPU use with 1 MPI tasks x 1 OpenMP "
        "threads\nTotal\n";
    read_text(context, text, &timed, &r);
    assert_near(r.wall_s, 2, 1e-15);
    assert_near(r.processor_s, 1, 1e-15);
    assert_string_equal(r.note, "");
    const brc_peer_request two = {.steps = 100, .n_threads = 2};
    read_text(context, text, &two, &r);
    assert_non_null(strstr(r.note, "1 processes, not 2"));
    brc_context_free(&context);
}

static void what_is_missing_is_noted(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_peer_result r;
    read_text(context, "", &timed, &r);
    assert_string_equal(r.note, "it told no seconds");
    read_text(context, "breccia-peer seconds 4.5\n", &timed, &r); /* without the processor's */
    assert_string_equal(r.note, "it told no seconds");
    read_text(context, "breccia-peer seconds 4.5\nbreccia-peer processor 4\n", &sampled, &r);
    assert_string_equal(r.note, "it told no samples");
    read_text(context, "breccia-peer sample 0 1.5 2\nbreccia-peer sample 10 -1 3\n", &sampled, &r);
    assert_string_equal(r.note, "");
    assert_int_equal(r.n_samples, 2);
    assert_true(r.samples[1].step == 10 && r.samples[1].momentum == -1 && r.samples[1].kinetic == 3);
    brc_peer_result_free(&r);
    brc_context_free(&context);
}

/* A cosine of 16 steps of 1 ms a period, sampled in every step: 62.5 Hz. Straight lines between samples cross 0 at the
 * right time as the samples lie symmetrically about it; rounding only. */
static void the_frequency_is_that_of_the_changes_of_sign(void **state)
{
    (void)state;
    brc_peer_sample a[65], b[33];
    for (int k = 0; k < 65; ++k)
        a[k] = (brc_peer_sample){k, cos(2 * M_PI * (k - 0.5) / 16), 4 + k};
    for (int k = 0; k < 33; ++k)
        b[k] = (brc_peer_sample){2 * k, 1, 4 + 2 * k + (k == 20 ? 0.5 : 0)};
    const brc_peer_result ours = {.n_samples = 65, .samples = a}, theirs = {.n_samples = 33, .samples = b},
                          short_one = {.n_samples = 8, .samples = a}, none = {.n_samples = 0};
    assert_near(brc_peer_bar_frequency(&ours, 1e-3), 62.5, 1e-10);
    assert_true(isnan(brc_peer_bar_frequency(&short_one, 1e-3)));
    assert_near(brc_peer_bar_difference(&ours, &theirs), 0.125, 1e-15); /* half a joule at one common step, over 4 J */
    assert_true(isnan(brc_peer_bar_difference(&ours, &none)));
}

/* ---- the files ---- */

/* A small packing with its beams, and a folder for what is written of it. */
typedef struct peer_case {
    brc_context *context;
    brc_domain *domain;
    double *velocity;
    brc_peer_work work;
    char folder[32];
} peer_case;

static void remove_folder(const char *folder)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

static int open_case(void **state)
{
    peer_case *c = calloc(1, sizeof *c);
    assert_non_null(c);
    *state = c;
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    assert_int_equal(brc_cube_build(c->context, 200, true, &c->domain), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(c->context, &c->velocity, 3 * c->domain->n_elements, "velocities"), BRC_OK);
    for (int64_t k = 0; k < 3 * c->domain->n_elements; ++k)
        c->velocity[k] = 0.01 * (double)k;
    c->work = (brc_peer_work){.domain = c->domain,
                              .velocity = c->velocity,
                              .density = 2500,
                              .axial = 3e8,
                              .bend = 5e3,
                              .twist = 4e3,
                              .time_step = 1e-6};
    snprintf(c->folder, sizeof c->folder, "peer-test-XXXXXX");
    assert_non_null(mkdtemp(c->folder));
    return 0;
}

static int close_case(void **state)
{
    peer_case *c = *state;
    remove_folder(c->folder);
    brc_memory_free(c->velocity);
    brc_domain_free(&c->domain);
    brc_context_free(&c->context);
    free(c);
    return 0;
}

static void read_file(brc_context *context, const char *folder, const char *name, char **text)
{
    char path[128];
    size_t bytes;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(brc_file_read_whole(context, path, 1 << 20, text, &bytes), BRC_OK);
}

/* The energy of a beam by the textbook (Euler and Bernoulli): with theta_k the rotation of section k against the chord,
 * N^2 l / (2 E S) for the elongation, 2 E I / l (theta_1^2 + theta_1 theta_2 + theta_2^2) for each plane of bending and
 * G J tau^2 / (2 l): the same as four springs at the middle of the branch have, by the numbers of the file. Two sums of
 * a dozen products: rounding, 1e-12. */
static void four_springs_at_the_middle_hold_the_energy_of_the_beam(void **state)
{
    const peer_case *c = *state;
    const brc_domain *domain = c->domain;
    const brc_peer_work work = c->work;
    assert_int_equal(brc_peer_work_write_tables(c->context, &work, c->folder), BRC_OK);
    char *text;
    read_file(c->context, c->folder, "bonds.csv", &text);
    char *line = strchr(text, '\n') + 1;
    int64_t n = 0;
    for (; *line; line = strchr(line, '\n') + 1, ++n) {
        int i, j;
        double kn, ks, kr, ktw, l;
        assert_int_equal(sscanf(line, "%d,%d,%lf,%lf,%lf,%lf,%lf", &i, &j, &kn, &ks, &kr, &ktw, &l), 7);
        const double *x = &domain->position[3 * i], *y = &domain->position[3 * j];
        assert_near(l, sqrt(pow(y[0] - x[0], 2) + pow(y[1] - x[1], 2) + pow(y[2] - x[2], 2)), 1e-15);
        assert_true(i < j);
        /* along the axis: stretched and twisted; across: ends displaced by p and q, turned by s and t */
        const double stretch = 1e-5, twist = 2e-4, p = 3e-5, q = -1e-5, s = 4e-4, t = -7e-4;
        const double chord = (q - p) / l, one = s - chord, two = t - chord;
        const double beam = 0.5 * work.axial / l * stretch * stretch + 0.5 * work.twist / l * twist * twist +
                            2 * work.bend / l * (one * one + one * two + two * two);
        const double slip = q - 0.5 * l * t - p - 0.5 * l * s; /* of the two ends' points at the middle */
        const double springs = 0.5 * kn * stretch * stretch + 0.5 * ks * slip * slip + 0.5 * kr * (t - s) * (t - s) +
                               0.5 * ktw * twist * twist;
        assert_near(springs / beam, 1, 1e-12);
    }
    assert_int_equal(n, domain->n_bonds);
    brc_memory_free(text);
    read_file(c->context, c->folder, "elements.csv", &text);
    double mass = 0, volume = 0;
    line = strchr(text, '\n') + 1;
    for (n = 0; *line; line = strchr(line, '\n') + 1, ++n) {
        double radius, m, inertia, v;
        assert_int_equal(sscanf(line, "%*f,%*f,%*f,%lf,%lf,%lf,%lf", &radius, &m, &inertia, &v), 4);
        assert_near(inertia / (0.4 * m * radius * radius), 1, 1e-12); /* a ball's, rounding */
        assert_near(v, 0.03 * (double)n, 1e-12);
        mass += m;
        volume += 4 * M_PI / 3 * radius * radius * radius / domain->quality.volume_fraction;
    }
    assert_int_equal(n, domain->n_elements);
    assert_near(mass / (2500 * volume), 1, 1e-12);
    brc_memory_free(text);
}

/* The type of each bond in packing.data, and the first coefficient of each type in bonds.in. */
static void check_types(const peer_case *c, bool turning, int n_types)
{
    assert_int_equal(brc_peer_work_write_lammps(c->context, &c->work, turning, n_types, c->folder), BRC_OK);
    const brc_domain *d = c->domain;
    char *data, *coefficients;
    read_file(c->context, c->folder, "packing.data", &data);
    read_file(c->context, c->folder, "bonds.in", &coefficients);
    const char *line = strstr(data, "\nBonds\n\n");
    assert_non_null(line);
    assert_non_null(strstr(data, turning ? "\nAtoms # bpm/sphere\n" : "\nAtoms # hybrid\n"));
    line += 8;
    int64_t n = 0;
    for (; *line; line = strchr(line, '\n') + 1, ++n) {
        int bond, type, i, j;
        double k, second;
        char mark[32];
        assert_int_equal(sscanf(line, "%d %d %d %d", &bond, &type, &i, &j), 4);
        snprintf(mark, sizeof mark, "bond_coeff %d ", type);
        const char *at = strstr(coefficients, mark);
        assert_non_null(at);
        assert_int_equal(sscanf(at + strlen(mark), "%lf %lf", &k, &second), 2);
        double square = 0;
        for (int axis = 0; axis < 3; ++axis)
            square += pow(d->position[3 * (j - 1) + axis] - d->position[3 * (i - 1) + axis], 2);
        const double exact = (turning ? 1 : 0.5) * c->work.axial / sqrt(square);
        /* a class is as wide as the lengths' range over n_types, and they lie within a factor of 3: half a class is
         * 1/n_types of the least at most */
        assert_near(k / exact, 1, n_types ? 1.0 / n_types : 1e-12);
    }
    assert_int_equal(n, d->n_bonds);
    brc_memory_free(data);
    brc_memory_free(coefficients);
}

static void bonds_of_lammps_have_the_stiffness_of_their_class_or_their_own(void **state)
{
    const peer_case *c = *state;
    check_types(c, true, 0);
    check_types(c, true, 64);
    check_types(c, false, 64);
}

/* ---- programs ---- */

static void make_program(const char *folder, const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(path, 0755), 0);
}

static void programs_are_those_on_the_path_and_lammps_is_asked_for_its_beams(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    brc_peer peers[BRC_PEERS_MOST];
    int n;
    char folder[] = "peer-test-XXXXXX", *before = getenv("PATH");
    assert_non_null(before);
    before = strdup(before);
    assert_non_null(mkdtemp(folder));
    assert_int_equal(setenv("PATH", folder, 1), 0);
    assert_int_equal(brc_peer_find(context, 1, folder, peers, &n), BRC_OK);
    assert_int_equal(n, 0);
    make_program(folder, "lmp", "#!/bin/sh\necho bond styles: harmonic\n");
    assert_int_equal(brc_peer_find(context, 1, folder, peers, &n), BRC_OK);
    assert_int_equal(n, 1);
    assert_int_equal(peers[0].kind, BRC_PEER_LAMMPS_SPRINGS);
    assert_false(peers[0].turning);
    make_program(folder, "lmp", "#!/bin/sh\necho bond styles: harmonic bpm/rotational\n");
    make_program(folder, "yade", "#!/bin/sh\n");
    assert_int_equal(brc_peer_find(context, 1, folder, peers, &n), BRC_OK);
    assert_int_equal(n, 2);
    assert_int_equal(peers[0].kind, BRC_PEER_YADE);
    assert_int_equal(peers[1].kind, BRC_PEER_LAMMPS);
    assert_int_equal(brc_peer_find(context, 2, folder, peers, &n), BRC_OK); /* no mpiexec for two processes */
    assert_int_equal(n, 1);
    assert_int_equal(setenv("PATH", before, 1), 0);
    free(before);
    remove_folder(folder);
    brc_context_free(&context);
}

static void the_lines_of_finite_elements_are_read(void **state)
{
    (void)state;
    brc_statics_peer_result r;
    brc_statics_peer_read("INFO:root:gcc\nbreccia-peer version 0.5.2\nbreccia-peer nodes 1250\nbreccia-peer iterations "
                          "24\nbreccia-peer setup 0.25\nbreccia-peer seconds 1.5\nbreccia-peer answer 2e-5\n",
                          &r);
    assert_string_equal(r.version, "0.5.2");
    assert_near(r.nodes, 1250, 0);
    assert_near(r.iterations, 24, 0);
    assert_near(r.setup, 0.25, 0);
    assert_near(r.seconds, 1.5, 0);
    assert_true(isnan(r.assembly) && isnan(r.resident)); /* not told */
    brc_statics_peer_read("Traceback\nModuleNotFoundError: no module\n", &r);
    assert_true(isnan(r.seconds));
}

/* A python3 of our own stands for one that has FEniCSx: what it is asked, and what becomes of what it says. */
static void finite_elements_are_asked_and_their_row_added(void **state)
{
    (void)state;
    const brc_statics_peer_body body = {"cube", 8000, 0.3, 2};
    char folder[] = "peer-test-XXXXXX", *before = getenv("PATH"), path[4096];
    brc_context *context = brc_context_create();
    brc_rows rows = {.context = context};
    brc_statics_peer *peer = NULL;
    assert_non_null(before);
    before = strdup(before);
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s:%s", folder, before);
    assert_int_equal(setenv("PATH", path, 1), 0);
    make_program(folder, "python3",
                 "#!/bin/sh\n[ $1 = -c ] && exit 0\necho breccia-peer nodes $3\necho breccia-peer iterations 17\n"
                 "echo breccia-peer seconds 3\n");
    assert_int_equal(brc_statics_peer_find(context, folder, "fe.py", "text", &peer), BRC_OK);
    assert_non_null(peer);
    assert_int_equal(brc_statics_peer_row(context, peer, &body, &rows), BRC_OK);
    assert_string_equal(brc_row_text(&rows.rows[0], "program"), "fenicsx");
    assert_near(brc_row_number(&rows.rows[0], "elements"), 8000, 0);
    assert_near(brc_row_number(&rows.rows[0], "iterations"), 17, 0);
    assert_near(brc_row_number(&rows.rows[0], "ratio"), 1.5, 0);
    make_program(folder, "python3", "#!/bin/sh\necho out of memory\nexit 1\n");
    assert_int_equal(brc_statics_peer_row(context, peer, &body, &rows), BRC_OK);
    assert_string_equal(brc_row_text(&rows.rows[1], "note"), "out of memory");
    assert_true(isnan(brc_row_number(&rows.rows[1], "seconds")));
    brc_statics_peer_free(&peer);
    assert_int_equal(setenv("PATH", before, 1), 0);
    free(before);
    remove_folder(folder);
    brc_rows_free(&rows);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lines_of_a_timed_run_are_read),
        cmocka_unit_test(of_lammps_the_last_loop_and_its_share_of_the_processor_count),
        cmocka_unit_test(what_is_missing_is_noted),
        cmocka_unit_test(the_frequency_is_that_of_the_changes_of_sign),
        cmocka_unit_test_setup_teardown(four_springs_at_the_middle_hold_the_energy_of_the_beam, open_case, close_case),
        cmocka_unit_test_setup_teardown(bonds_of_lammps_have_the_stiffness_of_their_class_or_their_own, open_case,
                                        close_case),
        cmocka_unit_test(programs_are_those_on_the_path_and_lammps_is_asked_for_its_beams),
        cmocka_unit_test(the_lines_of_finite_elements_are_read),
        cmocka_unit_test(finite_elements_are_asked_and_their_row_added),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
