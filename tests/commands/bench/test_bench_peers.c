/* breccia bench peers with programs that only pretend: shell scripts on PATH that tell known times. */
#include "../support.h"
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[32];

static int begin(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "peers-test-XXXXXX");
    return mkdtemp(folder) && setenv("PATH", folder, 1) == 0 ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "/bin/rm -r %s", folder);
    return system(command);
}

static void make_program(const char *name, const char *text)
{
    char path[64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fprintf(file, "#!/bin/sh\n%s", text) > 0);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(path, 0755), 0);
}

static int run_bench(void)
{
    char arguments[128];
    snprintf(arguments, sizeof arguments, "bench peers --elements 200 --steps 10 -o %s/out", folder);
    return test_program(arguments);
}

/* The line of rows.csv that has both texts, cut into its fields by the names of the first line; 0 for an empty or
 * missing field. */
static double field_of(const char *one, const char *two, const char *key)
{
    char path[64], names[4096], line[4096];
    snprintf(path, sizeof path, "%s/out/rows.csv", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(names, sizeof names, file));
    double value = 0;
    bool found = false;
    while (!found && fgets(line, sizeof line, file)) {
        if (!strstr(line, one) || !strstr(line, two)) continue;
        found = true;
        char *name = names, *field = line;
        for (;;) {
            const size_t length = strcspn(name, ",\n");
            if (length == strlen(key) && memcmp(name, key, length) == 0) break;
            assert_true(name[length] == ',');
            name += length + 1;
            bool quoted = false;
            for (; *field && (quoted || *field != ','); ++field)
                quoted ^= *field == '"';
            ++field;
        }
        value = strtod(field, NULL);
    }
    fclose(file);
    if (!found) fail_msg("no row with %s and %s", one, two);
    return value;
}

static void expect(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("'%s' not in '%s'", part, text);
}

static void without_other_programs_there_are_rows_of_ours_and_what_to_install(void **state)
{
    (void)state;
    assert_int_equal(run_bench(), 0);
    expect(test_program_stderr(), "apt-get install yade");
    expect(test_program_stderr(), "apt-get install lammps");
    expect(test_program_stdout(), "rows.json");
    assert_true(field_of("\"peers-bar\"", "\"breccia\"", "ours") > 0);
    assert_true(field_of("\"peers\"", "\"cbm\"", "bond_updates_per_s") > 0);
    assert_true(field_of("\"peers\"", "\"dlsm\"", "bond_updates_per_s") > 0);
    /* a slender bar of the material: coarse (6 spheres across) and not slender, one part in ten */
    assert_near(field_of("\"peers-bar\"", "\"breccia\"", "error"), 0, 0.1);
}

/* 2.5 s of the processor for 10 steps of 1000 bonds (five a sphere): 4000 a second. */
static void the_rate_and_the_ratio_of_a_program_are_those_of_its_time(void **state)
{
    (void)state;
    make_program("yade",
                 "echo breccia-peer version 9.9\necho breccia-peer seconds 40\necho breccia-peer processor 2.5\n");
    make_program("lmp", "if [ \"$1\" = -h ]; then echo bpm/rotational; exit; fi\necho Loop time of 8 on 1 procs for 10 "
                        "steps with 200 atoms\n"
                        "echo '50% CPU use with 1 MPI tasks x 1 OpenMP threads'\n");
    assert_int_equal(run_bench(), 0);
    const double ours = field_of("\"peers\"", "\"breccia\"", "ours"),
                 ratio = field_of("\"peers\"", "\"yade\"", "ratio");
    assert_true(field_of("\"peers\"", "\"breccia\"", "bonds") == 1000);
    assert_near(field_of("\"peers\"", "\"yade\"", "seconds"), 0.25, 1e-12);
    assert_near(field_of("\"peers\"", "\"yade\"", "peer"), 4000, 1e-8);
    assert_near(field_of("\"peers\"", "\"yade\"", "bond_updates_per_s"), 4000, 1e-8);
    assert_near(field_of("\"peers\"", "\"lmp\"", "peer"), 2500, 1e-8); /* 4 s */
    /* the other program's time is the same in every round, so the median of the ratios is the ratio of the medians:
     * rounding */
    assert_near(ratio * 4000 / ours, 1, 1e-12);
    assert_true(field_of("\"peers\"", "\"yade\"", "ours") == ours);
    expect(test_program_stdout(), "9.9");
    /* neither told how the bar moves */
    expect(test_program_stdout(), "no figures: it told no samples");
}

static void a_program_that_fails_is_a_row_without_figures_and_its_last_words_are_told(void **state)
{
    (void)state;
    make_program("yade", "echo Traceback\necho ImportError: no module\nexit 1\n");
    make_program(
        "lmp",
        "if [ \"$1\" = -h ]; then echo harmonic; exit; fi\necho Loop time of 8 on 1 procs for 10 steps with 200 atoms\n"
        "echo '100% CPU use with 1 MPI tasks x 1 OpenMP threads'\n");
    assert_int_equal(run_bench(), 0);
    expect(test_program_stdout(), "no figures: it told no seconds");
    expect(test_program_stdout(), "springs only");
    expect(test_program_stderr(), "ImportError: no module");
    expect(test_program_stderr(), "lacks package BPM");
    assert_near(field_of("\"peers\"", "\"lmp\"", "peer"), 1250, 1e-8);
    make_program("yade", "echo breccia-peer seconds 1\necho breccia-peer processor 1\necho breccia-peer bonds 999\n");
    assert_int_equal(run_bench(), 0);
    expect(test_program_stdout(), "no figures: it had 999 bonds, not 1000");
}

static void wrong_options_end_with_two(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "bench peers --elements 5",     "bench peers --steps 0",     "bench peers -t none",
        "bench peers --sizes 1000",     "bench peers --devices cpu", "bench throughput --steps 5",
        "bench effects --elements 500", "bench contact --steps 5",   "bench accuracy --elements 500"};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k)
        if (test_program(wrong[k]) != 2) fail_msg("'%s' did not end with 2", wrong[k]);
    assert_int_equal(test_program("bench speed"), 2);
    expect(test_program_stderr(), "peers");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_other_programs_there_are_rows_of_ours_and_what_to_install),
        cmocka_unit_test(the_rate_and_the_ratio_of_a_program_are_those_of_its_time),
        cmocka_unit_test(a_program_that_fails_is_a_row_without_figures_and_its_last_words_are_told),
        cmocka_unit_test(wrong_options_end_with_two),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
