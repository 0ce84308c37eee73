/* Model spring: central springs between cells, of stiffness E S / L. */
#include "../../core/solver.h"
#include <math.h>

typedef struct springs {
    brc_pass *force, *energy;
    brc_buffer *branch, *stiffness;
} springs;

extern const brc_bond_model brc_spring;

static bool in(const brc_wants *w)
{
    return w->model == &brc_spring;
}

#define AT(member) BRC_FIELD_AT(springs, member)
static const brc_field_row rows[] = {
    {"branch", brc_each_entry, 3, BRC_FIELD_COEFF, NULL, AT(branch), "branches", "m", BRC_NOT_KEPT},
    {"stiffness", brc_each_entry, 1, BRC_FIELD_COEFF, NULL, AT(stiffness), "springs", "N/m", BRC_NOT_KEPT},
};
static BRC_FIELD_TABLE(fields, "springs", BRC_LIFE_RUN, in, rows);

static brc_status create(brc_simulation *s)
{
    return brc_memory_allocate(s->context, &s->of_model, 1, sizeof(springs), "springs");
}

static void release(brc_simulation *s)
{
    if (s->of_model) brc_fields_free(&fields, s->of_model);
    brc_memory_free(s->of_model);
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void stiffness_of(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    const brc_domain *d = s->domain;
    const int64_t j = d->neighbour[h];
    const double own = s->elastic[s->material_of_element[e]].young, other = s->elastic[s->material_of_element[j]].young;
    double branch[3];
    for (int c = 0; c < 3; ++c)
        branch[c] = d->position[3 * j + c] - d->position[3 * e + c];
    out[0] = 2 * own * other / (own + other) * length_of(d->area_vector + 3 * h) / length_of(branch);
}

static brc_status upload(brc_simulation *s)
{
    static const double none[3] = {0, 0, 0}; /* missing neighbours: no stiffness */
    springs *own = s->of_model;
    BRC_TRY(brc_fields_create(s->device, &fields, &s->wants, own));
    BRC_TRY(brc_geometry_branches(s, own->branch));
    return brc_geometry_rows(s, own->stiffness, 1, stiffness_of, none);
}

static brc_status make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    springs *own = s->of_model;
    const brc_scope evaluated = {.owner = "springs", .base = own, .tables = {&fields}, .outer = request},
                    state = {.owner = "springs", .base = own, .tables = {&fields}, .outer = run};
    BRC_TRY(BRC_PASSES(s, &evaluated, BRC_PASS(&own->force, "spring_force", NULL)));
    return BRC_PASSES(s, &state, BRC_PASS(&own->energy, "spring_energy", NULL));
}

static brc_status evaluate(brc_simulation *s, const brc_force_request *r)
{
    const springs *own = s->of_model;
    return brc_pass_run_on(own->force, s->n_groups, r, NULL, NULL);
}

static brc_status energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    const springs *own = s->of_model;
    *stabilisation = 0;
    BRC_TRY(brc_pass_run(own->energy, s->n_groups));
    return brc_vector_sum(s, brc_elastic_energy_of(s), s->layout->n_rows, elastic);
}

static int step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES])
{
    out[0] = (brc_step_pass){((const springs *)s->of_model)->force, NULL};
    return 1;
}

/* Of this example springs have no stress. */
static brc_status strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    double *const out[] = {strain, stress, cauchy};
    for (int k = 0; k < 3; ++k)
        for (int64_t i = 0; out[k] && i < 6 * s->domain->n_elements; ++i)
            out[k][i] = NAN;
    return BRC_OK;
}

/* Faces move with their elements. */
static brc_status face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    double *u = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &u, 3 * s->domain->n_elements, "displacements"));
    const brc_status status = brc_state_from_rows(s, brc_displacement_of(s), u, 3);
    for (int64_t i = 0; status == BRC_OK && i < n; ++i)
        for (int c = 0; c < 3; ++c)
            out[3 * i + c] = u[3 * (int64_t)s->domain->free_element[faces[i]] + c];
    brc_memory_free(u);
    return status;
}

const brc_bond_model brc_spring = {.element = BRC_ELEMENT_CELL,
                                   .surface = BRC_SURFACE_SPHERE,
                                   .effect = {{"central springs", NULL}},
                                   .create = create,
                                   .free = release,
                                   .upload = upload,
                                   .make_passes = make_passes,
                                   .evaluate = evaluate,
                                   .energies = energies,
                                   .step_passes = step_passes,
                                   .strain_stress = strain_stress,
                                   .face_displacement = face_displacement,
                                   .conserves = true,
                                   .fields = (const brc_field_table *const[]){&fields, NULL}};
