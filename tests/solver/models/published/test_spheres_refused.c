#include "../../support.h"
#include "../../../../host/base/memory.h"
#include "../../../../preprocess/packing/beams.h"
#include <string.h>

/* Four spheres in a row for a model that needs cells. */
static void the_models_of_cells_refuse_spheres(void **state)
{
    (void)state;
    static const char *const models[] = {"dlsm", "dlsm-published"};
    for (int m = 0; m < 2; ++m) {
        bench_case c;
        open_case(&c, (case_options){.model = models[m], .fill = "cells: [2, 2, 2], spread: 0 %"});
        brc_domain *spheres;
        brc_simulation *simulation;
        double *x, *r;
        assert_done(&c, BRC_ALLOCATE(c.context, &spheres, 1, "domain"));
        assert_done(&c, BRC_ALLOCATE(c.context, &x, 12, "positions"));
        assert_done(&c, BRC_ALLOCATE(c.context, &r, 4, "radii"));
        for (int e = 0; e < 4; ++e) {
            x[3 * e] = e;
            r[e] = 0.5;
        }
        assert_done(&c, brc_beams_bond(c.context, x, r, 4, 1.5, 1, spheres));
        assert_done(&c, BRC_ALLOCATE(c.context, &spheres->region, 4, "regions"));
        assert_done(&c, BRC_ALLOCATE(c.context, &spheres->body, 4, "bodies"));
        assert_int_equal(brc_simulation_create(c.context, c.scene, spheres, c.device, &simulation), BRC_BAD_INPUT);
        assert_null(simulation);
        assert_non_null(strstr(brc_context_message(c.context),
                               "needs cells, the bodies are spheres joined by beams; remove `beams`"));
        assert_non_null(strstr(brc_context_message(c.context), models[m]));
        brc_domain_free(&spheres);
        close_case(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_models_of_cells_refuse_spheres),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
