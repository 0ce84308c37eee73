/* Shared by the tests of preprocess/: a quiet context for every test, small bodies, and what "near" means. */
#ifndef BRC_TEST_PREPROCESS_SUPPORT_H
#define BRC_TEST_PREPROCESS_SUPPORT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>

#include "../../preprocess/domain/build.h"
#include <stdio.h>

/* cmocka set-up and tear-down: *state is a context that logs errors only. The tear-down fails when memory is still held
 * that the test did not free. */
int test_begin(void **state);
int test_end(void **state);

/* Requests for a cube of 1 m, a cylinder along x (1 m, radius 0.3 m) and a sphere (radius 0.5 m) of about n
 * elements. */
brc_build_request test_box(int64_t n, double spread);
brc_build_request test_cylinder(int64_t n, double spread);
brc_build_request test_sphere(int64_t n, double spread);

/* Build, failing the test with the context's sentence. */
brc_domain *test_build(brc_context *context, const brc_build_request *request);
/* The build is refused with this code and its sentence contains `part`. */
void test_refused(brc_context *context, const brc_build_request *request, brc_status code, const char *part);

/* The two domains write files of equal bytes. */
void test_same_bytes(brc_context *context, const brc_domain *a, const brc_domain *b);

#define assert_near(value, expected, tolerance) test_near_at((value), (expected), (tolerance), __FILE__, __LINE__)
void test_near_at(double value, double expected, double tolerance, const char *file, int line);
/* The context's last sentence contains `part`. */
void test_says(brc_context *context, const char *part);

/* Worst relative error of the two identities every cell obeys: sum of area vectors = 0, sum of C (x) s = V I. */
double test_worst_closure(const brc_domain *domain);
double test_worst_first_moment(const brc_domain *domain);

/* What is said on stderr from here on goes into a file, until it is read and put back: at most room - 1 letters. */
typedef struct test_caught {
    FILE *file;
    int before;
} test_caught;
test_caught test_catch_stderr(void);
void test_release_stderr(test_caught *caught, char *text, size_t room);

#endif
