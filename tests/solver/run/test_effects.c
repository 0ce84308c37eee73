/* Only the effects that a scene asks for exist in a run: the kernels that are launched and the arrays on the device are
 * those of the effects in its list. */
#include "../effects/fracture/cells_case.h"
#include <string.h>

enum { MOST = 128 };

typedef struct parts {
    bench_case c;
    int n_kernels, n_arrays;
    brc_device_item kernel[MOST], array[MOST];
} parts;

/* After 30 steps and a ledger. */
static void run(parts *p, case_options o)
{
    brc_ledger ledger;
    open_case(&p->c, o);
    assert_done(&p->c, brc_simulation_begin_stage(p->c.simulation, 0));
    assert_done(&p->c, brc_simulation_advance(p->c.simulation, 30));
    assert_done(&p->c, brc_simulation_ledger(p->c.simulation, &ledger));
    p->n_kernels = brc_device_launched(p->c.device, MOST, p->kernel);
    p->n_arrays = brc_device_buffers(p->c.device, MOST, p->array);
    assert_true(p->n_kernels <= MOST && p->n_arrays <= MOST);
}

static bool has(int n, const brc_device_item *items, const char *name)
{
    for (int k = 0; k < n; ++k)
        if (strcmp(items[k].name, name) == 0) return true;
    return false;
}

static void assert_exactly(const char *what, int n, const brc_device_item *items, const char *const *names)
{
    int expected = 0;
    for (; names[expected]; ++expected)
        if (!has(n, items, names[expected])) fail_msg("%s: no '%s'", what, names[expected]);
    for (int k = 0; k < n; ++k) {
        bool known = false;
        for (int i = 0; i < expected; ++i)
            known = known || strcmp(items[k].name, names[i]) == 0;
        if (!known) fail_msg("%s: '%s' is not of this scene", what, items[k].name);
    }
}

/* What `more` has and `less` has not is exactly `names`. */
static void assert_added(const char *what, int n_less, const brc_device_item *less, int n_more,
                         const brc_device_item *more, const char *const *names)
{
    brc_device_item added[MOST];
    int n = 0;
    for (int k = 0; k < n_less; ++k)
        if (!has(n_more, more, less[k].name)) fail_msg("%s: '%s' is gone", what, less[k].name);
    for (int k = 0; k < n_more; ++k)
        if (!has(n_less, less, more[k].name)) added[n++] = more[k];
    assert_exactly(what, n, added, names);
}

#define FREE_FLIGHT                                                                                                    \
    "  - name: move\n    solver: {dynamic: {steps: 100}}\n    initial:\n      - velocity: {gradient: {x: [1e-3 1/s, "  \
    "0, 0]}}\n"

/* divide_by_mass, vector_axpy and vector_dot: the search for the critical step. */
static const char *const elastic_kernels[] = {
    "advance",     "divide_by_mass", "dlsm_energy", "dlsm_flux_linear", "dlsm_flux_pass", "dlsm_force", "dlsm_gradient",
    "dlsm_stress", "kinetic_energy", "vector_axpy", "vector_dot",       "vector_sum",     NULL};
static const char *const elastic_arrays[] = {"area vectors",
                                             "block sums",
                                             "boundary blocks",
                                             "displacement gradients",
                                             "displacements",
                                             "elastic energies",
                                             "face offsets",
                                             "fluxes",
                                             "forces",
                                             "inverse volumes",
                                             "kinetic energies",
                                             "least-squares matrices",
                                             "length over area",
                                             "masses",
                                             "neighbours",
                                             "rows asked for ahead",
                                             "slice starts",
                                             "stabilisation energies",
                                             "stresses",
                                             "velocities",
                                             NULL};

static void an_elastic_scene_is_made_of_elastic_kernels_and_arrays_alone(void **state)
{
    (void)state;
    parts p;
    run(&p, (case_options){.stages = FREE_FLIGHT});
    assert_exactly("kernels", p.n_kernels, p.kernel, elastic_kernels);
    assert_exactly("arrays", p.n_arrays, p.array, elastic_arrays);
    close_case(&p.c);
}

/* What a scene has beyond the elastic one. */
static void compare(case_options more, const char *const *kernels, const char *const *arrays)
{
    parts a, b;
    more.stages = FREE_FLIGHT;
    run(&a, (case_options){.stages = FREE_FLIGHT});
    run(&b, more);
    assert_added("kernels", a.n_kernels, a.kernel, b.n_kernels, b.kernel, kernels);
    assert_added("arrays", a.n_arrays, a.array, b.n_arrays, b.array, arrays);
    close_case(&a.c), close_case(&b.c);
}

static void gravity_adds_a_kernel_and_an_array(void **state)
{
    (void)state;
    compare((case_options){.gravity = "gravity: [0 m/s^2, -1e-4 m/s^2, 0 m/s^2]\n"},
            (const char *const[]){"gravity", NULL}, (const char *const[]){"masses in gravity", NULL});
}

static void a_strength_alone_adds_nothing(void **state)
{
    (void)state;
    compare((case_options){.materials = CELLS_STRENGTH("1e-9 Pa")}, (const char *const[]){NULL},
            (const char *const[]){NULL});
}

/* Nothing breaks: the forces of the full law are found with how far bonds are; what happens after breaks is not
 * launched. */
static void fracture_adds_its_check_and_its_arrays(void **state)
{
    (void)state;
    compare((case_options){.materials = CELLS_STRENGTH("1 GPa"), .sets = CELLS_FRACTURE},
            (const char *const[]){"cells_check", "cells_force", NULL},
            (const char *const[]){"limits of bonds",
                                  "unbroken bonds",
                                  "smallest limits",
                                  "twins",
                                  "moduli",
                                  "supports",
                                  "marked bonds",
                                  "changed elements",
                                  "stresses of marked bonds",
                                  "groups to look at",
                                  "weights of broken bonds",
                                  "marks of elements",
                                  "steps of breaks",
                                  "modes of breaks",
                                  "stresses of breaks",
                                  "energies of breaks",
                                  "energy of broken bonds",
                                  "broken bonds",
                                  "lost bonds",
                                  "rings around broken bonds",
                                  "forces around broken bonds",
                                  "rings of elements",
                                  "numerical dissipation",
                                  "broken faces",
                                  "springs of broken faces",
                                  "forces of broken faces",
                                  "energy of broken faces",
                                  "friction of broken faces",
                                  "places of elements",
                                  NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_elastic_scene_is_made_of_elastic_kernels_and_arrays_alone),
        cmocka_unit_test(gravity_adds_a_kernel_and_an_array),
        cmocka_unit_test(a_strength_alone_adds_nothing),
        cmocka_unit_test(fracture_adds_its_check_and_its_arrays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
