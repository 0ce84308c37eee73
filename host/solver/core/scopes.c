/* What passes of the run find by name, and which passes those are. */
#include "core_internal.h"

#define OF_RUN(member) BRC_FIELD_AT(struct brc_core, member)
static const brc_value_row run_values[] = {
    {"lambda_one", BRC_VALUE_REAL, OF_RUN(constant.lambda)},
    {"mu_one", BRC_VALUE_REAL, OF_RUN(constant.mu)},
    {"young_one", BRC_VALUE_REAL, OF_RUN(constant.young)},
    {"k_one", BRC_VALUE_REAL, OF_RUN(constant.k)},
    {"ell_one", BRC_VALUE_REAL, OF_RUN(constant.ell)},
    {"axial", BRC_VALUE_REAL, OF_RUN(constant.axial)},
    {"bend", BRC_VALUE_REAL, OF_RUN(constant.bend)},
    {"twist", BRC_VALUE_REAL, OF_RUN(constant.twist)},
    {"beta", BRC_VALUE_REAL, OF_RUN(constant.beta)},
    {"one_plus_tau", BRC_VALUE_REAL, OF_RUN(constant.one_plus_tau)},
    {"rotation_factor", BRC_VALUE_REAL, OF_RUN(constant.rotation_factor)},
    {"couple", BRC_VALUE_REAL, OF_RUN(constant.couple)},
    {"gx", BRC_VALUE_REAL, OF_RUN(constant.gravity[0])},
    {"gy", BRC_VALUE_REAL, OF_RUN(constant.gravity[1])},
    {"gz", BRC_VALUE_REAL, OF_RUN(constant.gravity[2])},
    {"area_weights", BRC_VALUE_BOOL, OF_RUN(constant.area_weights)},
    {"finite", BRC_VALUE_BOOL, OF_RUN(constant.finite)},
    {"turns", BRC_VALUE_BOOL, OF_RUN(constant.turns)},
    {"face_loads", BRC_VALUE_BOOL, OF_RUN(face_loads)},
};

brc_scope brc_scope_of_run(const brc_simulation *s)
{
    return (brc_scope){
        .owner = "run", .base = s->core, .tables = {&brc_state_fields, &brc_geometry_fields}, BRC_VALUES(run_values)};
}

brc_scope brc_scope_of_request(const brc_scope *outer)
{
    static const brc_value_row values[] = {
        {"displacement", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_force_request, displacement)},
        {"force", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_force_request, force)},
        {"orientation", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_force_request, orientation)},
        {"torque", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_force_request, torque)},
        {"finite", BRC_VALUE_BOOL, BRC_FIELD_AT(brc_force_request, finite)},
        {"book", BRC_VALUE_INT, BRC_FIELD_AT(brc_force_request, book)},
    };
    return (brc_scope){.owner = "evaluation", .kind = BRC_SCOPE_REQUEST, BRC_VALUES(values), .outer = outer};
}

brc_scope brc_scope_of_sums(const brc_simulation *s, const brc_scope *outer)
{
    static const brc_value_row values[] = {{"out", BRC_VALUE_BUFFER, OF_RUN(kinetic)},
                                           {"found", BRC_VALUE_BUFFER, OF_RUN(kinetic)}};
    return (brc_scope){.owner = "sums", .base = s->core, BRC_VALUES(values), .outer = outer};
}

/* One array under another name. */
#define SCOPE(function, words, name, member)                                                                           \
    brc_scope function(const brc_simulation *s, const brc_scope *outer)                                                \
    {                                                                                                                  \
        static const brc_value_row values[] = {{name, BRC_VALUE_BUFFER, OF_RUN(member)}};                              \
        return (brc_scope){.owner = words, .base = s->core, BRC_VALUES(values), .outer = outer};                       \
    }
SCOPE(brc_scope_of_velocities, "velocities", "displacement", velocity)
SCOPE(brc_scope_of_damping, "damping", "lost", lost_damping)
SCOPE(brc_scope_of_stresses, "stresses of elements", "stress", stress)

brc_status brc_passes_make(brc_simulation *s, const brc_scope *scope, int n, const brc_pass_wanted *wanted)
{
    for (int k = 0; k < n; ++k)
        if (!wanted[k].left_out)
            BRC_TRY(brc_pass_make(s->context, s->device, scope, wanted[k].kernel, wanted[k].open, &s->core->passes,
                                  wanted[k].slot));
    return BRC_OK;
}

static void fill_constants(brc_simulation *s)
{
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    const brc_model *model = &s->scene->model;
    static const double none[3] = {0};
    const double *g = s->scene->has_gravity ? s->scene->gravity : none;
    s->core->constant = (brc_constants){.lambda = m->lambda,
                                        .mu = m->mu,
                                        .young = m->young,
                                        .k = m->k,
                                        .ell = m->ell,
                                        .beta = model->compaction ? model->beta : 0,
                                        .one_plus_tau = 1 + model->tau,
                                        .rotation_factor = model->rotation_stiffness,
                                        .couple = model->couple_modulus,
                                        .gravity = {g[0], g[1], g[2]},
                                        .area_weights = model->area_weights,
                                        .finite = !model->small_rotations,
                                        .turns = s->model->turns};
}

brc_status brc_core_passes_make(brc_simulation *s)
{
    fill_constants(s);
    BRC_TRY(brc_vector_kernels_find(s));
    const brc_scope run = brc_scope_of_run(s), request = brc_scope_of_request(&run);
    return s->model->make_passes(s, &run, &request);
}

void brc_set_beam(brc_simulation *s, double axial, double bend, double twist)
{
    s->core->constant.axial = axial;
    s->core->constant.bend = bend;
    s->core->constant.twist = twist;
}
brc_status brc_set_face_loads(brc_simulation *s, bool any)
{
    s->core->face_loads = any;
    return any && s->core->held_gradient ? brc_buffer_fill_zero(s->core->held_gradient) : BRC_OK;
}
