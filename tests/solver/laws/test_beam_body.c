/* Bonds inside a body, counted by hand on a lattice. */
#include "../../../host/solver/laws/beam_body.h"
#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../preprocess/packing/beams.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>

static brc_context *context;

static void done(brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

/* l x m x n spheres of radius 1/2 at distance 1 that touch each other and the walls of a box; all contacts bonded. */
static brc_domain *box(int l, int m, int n)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {l, m, n}};
    const int64_t count = (int64_t)l * m * n;
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
        const int64_t at[3] = {e % l, e / l % m, e / l / m};
        for (int c = 0; c < 3; ++c)
            position[3 * e + c] = bounds[0][c] + 0.5 + (double)at[c];
        radius[e] = 0.5;
    }
    done(brc_beams_build(context, solid, position, radius, count, 6 - 2.0 / l - 2.0 / m - 2.0 / n, false, 1, domain));
    done(BRC_ALLOCATE(context, &domain->body, count, "bodies"));
    brc_solid_free(&solid);
    return domain;
}

static brc_domain *lattice(int n)
{
    return box(n, n, n);
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
    for (int32_t s = 0; s < bare->n_sets; ++s)
        bare->sets[s].n_members = 0;
    done(brc_beam_body_of(context, bare, -1, &body));
    assert_true(body.inner == 0);
    brc_domain_free(&small);
    brc_domain_free(&bare);
}

/* The elements of one body alone: the lower half of the lattice given to another one. Inside of both there are still
 * six. */
static void bodies_are_counted_one_by_one(void **state)
{
    (void)state;
    brc_domain *domain = lattice(12);
    brc_beam_body all, body[2];
    for (int64_t e = 0; e < domain->n_elements; ++e)
        domain->body[e] = e < 4 * 144;
    done(brc_beam_body_of(context, domain, -1, &all));
    for (int32_t b = 0; b < 2; ++b) {
        done(brc_beam_body_of(context, domain, b, &body[b]));
        assert_true(body[b].inner == 6);
    }
    assert_true(body[1].coordination < body[0].coordination); /* a wall to fewer layers */
    assert_true(fabs((body[0].coordination * 8 + body[1].coordination * 4) / 12 - all.coordination) < 1e-14);
    brc_domain_free(&domain);
}

/* Edges are whole numbers of diameters: the formula of the header by hand. A turned body is the same; one with a wall
 * less is no box. */
static void the_reading_of_a_box_is_that_of_its_edges(void **state)
{
    (void)state;
    brc_domain *domain = box(24, 8, 12);
    brc_beam_body body, turned;
    done(brc_beam_body_of(context, domain, -1, &body));
    assert_true(fabs(body.reading - (1 + 1.0 / 24 - 0.2 * (1.0 / 8 + 1.0 / 12))) < 1e-14);
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        double *x = domain->position + 3 * e;
        const double y = x[1];
        x[1] = 0.6 * y - 0.8 * x[2];
        x[2] = 0.8 * y + 0.6 * x[2];
    }
    done(brc_beam_body_of(context, domain, -1, &turned));
    assert_true(fabs(turned.reading - body.reading) < 1e-13);
    domain->sets[brc_domain_find_set(domain, "y+")].n_members = 0;
    domain->sets[brc_domain_find_set(domain, "z+")].n_members = 0;
    done(brc_beam_body_of(context, domain, -1, &body));
    assert_true(body.reading == 0);
    brc_domain_free(&domain);
}

/* The same lattice with a name changed: its two other walls as the side of a rod along x; mean distance from the axis
 * by hand. */
static void the_reading_of_a_cylinder_is_that_of_its_side(void **state)
{
    (void)state;
    brc_domain *domain = box(20, 7, 7);
    brc_beam_body body;
    double sum = 0;
    const int32_t w = brc_domain_find_set(domain, "y-");
    for (int32_t s = 0; s < domain->n_walls; ++s)
        if (domain->wall_name[s][0] != 'x' && s != w) domain->wall_name[s][0] = 'u';
    brc_memory_free(domain->wall_name[w]);
    brc_memory_free(domain->sets[w].name);
    done(BRC_ALLOCATE(context, &domain->wall_name[w], 5, "name"));
    done(BRC_ALLOCATE(context, &domain->sets[w].name, 5, "name"));
    strcpy(domain->wall_name[w], "side");
    strcpy(domain->sets[w].name, "side");
    for (int k = 0; k < 7; ++k)
        sum += sqrt(9.0 + (k - 3) * (k - 3)) / 7; /* the face y-, three from the axis */
    done(brc_beam_body_of(context, domain, -1, &body));
    assert_true(fabs(body.reading - (1 + 1.0 / 20 - 0.4 / (2 * sum + 1))) < 1e-13);
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
        cmocka_unit_test(the_reading_of_a_box_is_that_of_its_edges),
        cmocka_unit_test(the_reading_of_a_cylinder_is_that_of_its_side),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
