#include "support.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../preprocess/domain/domain_file.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static int64_t held_before;

int test_begin(void **state)
{
    held_before = brc_memory_held();
    brc_context *context = brc_context_create();
    if (!context) return -1;
    brc_log_set_level(context, BRC_LOG_ERROR);
    *state = context;
    return 0;
}

int test_end(void **state)
{
    brc_context_free((brc_context **)state);
    if (brc_memory_held() == held_before) return 0;
    print_error("%lld bytes are still held\n", (long long)(brc_memory_held() - held_before));
    return -1;
}

brc_build_request test_box(int64_t n, double spread)
{
    brc_build_request request = {.n_threads = 1};
    request.shape = (brc_shape){.kind = BRC_SHAPE_BOX, .size = {1.0, 1.0, 1.0}};
    request.fill = (brc_fill){.n_elements = n, .spread = spread, .seed = 7};
    return request;
}

brc_build_request test_cylinder(int64_t n, double spread)
{
    brc_build_request request = test_box(n, spread);
    request.shape = (brc_shape){.kind = BRC_SHAPE_CYLINDER, .length = 1.0, .radius = 0.3};
    return request;
}

brc_build_request test_sphere(int64_t n, double spread)
{
    brc_build_request request = test_box(n, spread);
    request.shape = (brc_shape){.kind = BRC_SHAPE_SPHERE, .radius = 0.5};
    return request;
}

brc_domain *test_build(brc_context *context, const brc_build_request *request)
{
    brc_domain *domain = NULL;
    if (brc_domain_build(context, request, &domain) != BRC_OK) fail_msg("%s", brc_context_message(context));
    return domain;
}

void test_says(brc_context *context, const char *part)
{
    if (!strstr(brc_context_message(context), part))
        fail_msg("expected '%s' in: %s", part, brc_context_message(context));
}

void test_refused(brc_context *context, const brc_build_request *request, brc_status code, const char *part)
{
    brc_domain *domain = NULL;
    brc_context_clear(context);
    assert_int_equal(brc_domain_build(context, request, &domain), code);
    assert_null(domain);
    test_says(context, part);
}

/* Bytes of a whole file, freed by brc_memory_free. */
static char *bytes_of(brc_context *context, const brc_domain *domain, const char *path, size_t *n)
{
    char *bytes = NULL;
    assert_int_equal(brc_domain_write(context, domain, path), BRC_OK);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *n = (size_t)ftell(file);
    rewind(file);
    assert_int_equal(BRC_ALLOCATE(context, &bytes, (int64_t)*n, "file"), BRC_OK);
    assert_int_equal(fread(bytes, 1, *n, file), *n);
    fclose(file);
    remove(path);
    return bytes;
}

void test_same_bytes(brc_context *context, const brc_domain *a, const brc_domain *b)
{
    char path[64];
    size_t n_a, n_b;
    snprintf(path, sizeof path, "same_bytes_%d.h5", (int)getpid()); /* tests run side by side */
    char *bytes_a = bytes_of(context, a, path, &n_a), *bytes_b = bytes_of(context, b, path, &n_b);
    assert_int_equal(n_a, n_b);
    assert_memory_equal(bytes_a, bytes_b, n_a);
    brc_memory_free(bytes_a);
    brc_memory_free(bytes_b);
}

void test_near_at(double value, double expected, double tolerance, const char *file, int line)
{
    if (fabs(value - expected) <= tolerance) return; /* false for nan */
    print_error("%.17g is not %.17g within %g\n", value, expected, tolerance);
    _fail(file, line);
}

double test_worst_closure(const brc_domain *domain)
{
    double worst = 0.0;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        worst = fmax(worst, brc_domain_closure(domain, e));
    return worst;
}

static void add_moment(const double *x, const double *centroid, const double *area, int64_t n, double moment[3][3])
{
    for (int64_t k = 0; k < n; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                moment[i][j] += (centroid[3 * k + i] - x[i]) * area[3 * k + j];
}

double test_worst_first_moment(const brc_domain *d)
{
    double worst = 0.0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double moment[3][3] = {{0.0}};
        const int64_t h = d->row_start[e], f = d->free_start[e];
        add_moment(d->position + 3 * e, d->face_centroid + 3 * h, d->area_vector + 3 * h, d->row_start[e + 1] - h,
                   moment);
        add_moment(d->position + 3 * e, d->free_centroid + 3 * f, d->free_area_vector + 3 * f, d->free_start[e + 1] - f,
                   moment);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                worst = fmax(worst, fabs(moment[i][j] / d->volume[e] - (i == j)));
    }
    return worst;
}

test_caught test_catch_stderr(void)
{
    fflush(stderr);
    test_caught caught = {.file = tmpfile(), .before = dup(2)};
    assert_non_null(caught.file);
    dup2(fileno(caught.file), 2);
    return caught;
}

void test_release_stderr(test_caught *caught, char *text, size_t room)
{
    fflush(stderr);
    dup2(caught->before, 2);
    close(caught->before);
    rewind(caught->file);
    text[fread(text, 1, room - 1, caught->file)] = '\0';
    fclose(caught->file);
}
