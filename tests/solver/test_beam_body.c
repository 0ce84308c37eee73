/* Bonds inside a body, counted by hand on a lattice. */
#include "../../host/solver/beam_body.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../preprocess/beams.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>

static brc_context *context;

static void done(brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

/* n^3 spheres of radius 1/2 at distance 1 that touch each other and the walls of a cube; all contacts bonded. */
static brc_domain *lattice(int n)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {n, n, n}};
    const int64_t count = (int64_t)n * n * n;
    brc_solid *solid;
    brc_domain *domain;
    double *position, *radius;
    done(brc_solid_create(context, &shape, 1, &solid));
    done(BRC_ALLOCATE(context, &domain, 1, "domain"));
    done(BRC_ALLOCATE(context, &position, 3 * count, "spheres"));
    done(BRC_ALLOCATE(context, &radius, count, "spheres"));
    double bounds[2][3];
    brc_solid_bounds(solid, bounds);
    for (int64_t e = 0; e < count; ++e) {
        const int64_t at[3] = {e % n, e / n % n, e / n / n};
        for (int c = 0; c < 3; ++c) position[3 * e + c] = bounds[0][c] + 0.5 + (double)at[c];
        radius[e] = 0.5;
    }
    done(brc_beams_build(context, solid, position, radius, count, 6.0 * (n - 1) / n, 1, domain));
    done(BRC_ALLOCATE(context, &domain->body, count, "bodies"));
    brc_solid_free(&solid);
    return domain;
}

/* Every element inside has six neighbours, whatever the size; of all they are 6 (n - 1) / n. Whole numbers: exact. */
static void inside_a_lattice_every_element_has_six_bonds_at_any_size(void **state)
{
    (void)state;
    for (int n = 9; n <= 15; n += 3) {
        brc_domain *domain = lattice(n);
        brc_beam_body body;
        done(brc_beam_body_of(context, domain, -1, &body));
        assert_true(body.inner == 6);
        assert_true(fabs(body.coordination - 6.0 * (n - 1) / n) < 1e-14);
        brc_domain_free(&domain);
    }
}

/* 5^3 has 27 spheres inside: too few to say anything. So has one without walls. */
static void few_elements_inside_or_no_walls_say_nothing(void **state)
{
    (void)state;
    brc_beam_body body;
    brc_domain *small = lattice(5), *bare = lattice(9);
    done(brc_beam_body_of(context, small, -1, &body));
    assert_true(body.inner == 0 && body.coordination > 4);
    for (int32_t s = 0; s < bare->n_sets; ++s) bare->sets[s].n_members = 0;
    done(brc_beam_body_of(context, bare, -1, &body));
    assert_true(body.inner == 0);
    brc_domain_free(&small);
    brc_domain_free(&bare);
}

/* The elements of one body alone: the lower half of the lattice given to another one. Inside of both there are still six. */
static void bodies_are_counted_one_by_one(void **state)
{
    (void)state;
    brc_domain *domain = lattice(12);
    brc_beam_body all, body[2];
    for (int64_t e = 0; e < domain->n_elements; ++e) domain->body[e] = e < 4 * 144;
    done(brc_beam_body_of(context, domain, -1, &all));
    for (int32_t b = 0; b < 2; ++b) {
        done(brc_beam_body_of(context, domain, b, &body[b]));
        assert_true(body[b].inner == 6);
    }
    assert_true(body[1].coordination < body[0].coordination); /* a wall to fewer layers */
    assert_true(fabs((body[0].coordination * 8 + body[1].coordination * 4) / 12 - all.coordination) < 1e-14);
    brc_domain_free(&domain);
}

static int begin(void **state)
{
    (void)state;
    context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    return 0;
}

static int end(void **state)
{
    (void)state;
    brc_context_free(&context);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inside_a_lattice_every_element_has_six_bonds_at_any_size),
        cmocka_unit_test(few_elements_inside_or_no_walls_say_nothing),
        cmocka_unit_test(bodies_are_counted_one_by_one),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
