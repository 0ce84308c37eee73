/* What passes of the run find by name, and which passes those are. */
#include "../effects/loads/load_fields.h"

#define OF_RUN(member) BRC_FIELD_AT(brc_simulation, member)
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
    {"face_loads", BRC_VALUE_BOOL, OF_RUN(loads.on_faces)},
};

brc_scope brc_scope_of_run(const brc_simulation *s)
{
    return (brc_scope){
        .owner = "run", .base = s, .tables = {&brc_state_fields, &brc_geometry_fields}, BRC_VALUES(run_values)};
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
    return (brc_scope){.owner = "sums", .base = s, BRC_VALUES(values), .outer = outer};
}

brc_status brc_passes_make(brc_simulation *s, const brc_scope *scope, int n, const brc_pass_wanted *wanted)
{
    for (int k = 0; k < n; ++k)
        if (!wanted[k].left_out)
            BRC_TRY(brc_pass_make(s->context, s->device, scope, wanted[k].kernel, wanted[k].open, &s->passes,
                                  wanted[k].slot));
    return BRC_OK;
}

static void fill_constants(brc_simulation *s)
{
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    const brc_model *model = &s->scene->model;
    static const double none[3] = {0};
    const double *g = s->scene->has_gravity ? s->scene->gravity : none;
    s->constant = (brc_constants){.lambda = m->lambda,
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

/* One thing of many, which each launch gives: a load. */
static brc_scope scope_of_load(const char *owner, const brc_field_table *table, int n_values,
                               const brc_value_row *values, const brc_scope *outer)
{
    return (brc_scope){.owner = owner,
                       .kind = BRC_SCOPE_ITEM,
                       .tables = {table},
                       .n_values = n_values,
                       .values = values,
                       .outer = outer};
}

static brc_status make_load_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request)
{
    static const brc_value_row of_traction[] = {
        {"last_factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_traction_load, last_factor)}};
    static const brc_value_row of_imposed[] = {
        {"last_rate", BRC_VALUE_REAL, BRC_FIELD_AT(brc_imposed_load, last_rate)}};
    static const brc_value_row of_push[] = {{"factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_push_load, factor)},
                                            {"last_factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_push_load, last_factor)}};
    static const brc_value_row of_turn[] = {{"last_rate", BRC_VALUE_REAL, BRC_FIELD_AT(brc_turn_load, last_rate)}};
    brc_run_passes *p = &s->pass;
    const bool turns = s->model->turns;
    const brc_scope held = {.owner = "held faces",
                            .base = &s->loads.held,
                            .tables = {&brc_held_element_fields, &brc_held_face_fields},
                            .outer = request};
    const brc_scope state = {.owner = "held faces",
                             .base = &s->loads.held,
                             .tables = {&brc_held_element_fields, &brc_held_face_fields},
                             .outer = run};
    const brc_scope held_load = scope_of_load("held load", &brc_held_load_fields, 0, NULL, &state);
    const brc_scope traction = scope_of_load("traction", &brc_traction_fields, 1, of_traction, request);
    const brc_face_scopes faces = {&held, &state, &held_load, &traction};
    if (s->model->make_face_passes) BRC_TRY(s->model->make_face_passes(s, &faces));
    const brc_scope imposed = scope_of_load("imposed elements", &brc_imposed_fields, 1, of_imposed, request);
    BRC_TRY(BRC_PASSES(s, &imposed, {&p->impose_book, "impose_book", "rate", false}));
    const brc_scope still = scope_of_load("imposed elements", &brc_imposed_fields, 1, of_imposed, run);
    BRC_TRY(BRC_PASSES(s, &still, {&p->impose_motion, "impose_motion", "factor rate set_displacement", false},
                       {&p->zero_imposed, "impose_zero", "vector", false}));
    const brc_scope push = scope_of_load("forces on elements", &brc_push_fields, 2, of_push, request);
    BRC_TRY(BRC_PASSES(s, &push, {&p->push_elements, "push_elements", NULL, false}));
    const brc_scope turn = scope_of_load("turned elements", &brc_turn_fields, 1, of_turn, request);
    BRC_TRY(BRC_PASSES(s, &turn, {&p->turn_book, "turn_book", "step rate", !turns}));
    const brc_scope turning = scope_of_load("turned elements", &brc_turn_fields, 1, of_turn, run);
    return BRC_PASSES(s, &turning, {&p->impose_turn, "impose_turn", "angle finite rate", !turns},
                      {&p->zero_turned, "impose_zero", "vector", !turns});
}

brc_status brc_run_passes_make(brc_simulation *s)
{
    brc_run_passes *p = &s->pass;
    const bool turns = s->model->turns;
    fill_constants(s);
    BRC_TRY(brc_vector_kernels_find(s));
    const brc_scope run = brc_scope_of_run(s), request = brc_scope_of_request(&run), sums = brc_scope_of_sums(s, &run);
    BRC_TRY(s->model->make_passes(s, &run, &request));
    const brc_pass_wanted of_state[] = {
        {&p->advance, "advance", "kick drift", false},
        {&p->advance_rotation, "advance_rotation", "kick drift extra", !turns},
        {&p->divide_by_mass, "divide_by_mass", "mass vector", false},
        {&p->advance_tchamwa, "advance_tchamwa", "dt phi lost", false},
        {&p->numerical_close, "numerical_close", "lost", false},
    };
    BRC_TRY(BRC_PASSES_MAKE(s, &run, of_state));
    const brc_pass_wanted of_sums[] = {{&p->kinetic_energy, "kinetic_energy", "velocity", false},
                                       {&p->add_spin_energy, "add_spin_energy", "spin", !turns}};
    BRC_TRY(BRC_PASSES_MAKE(s, &sums, of_sums));
    return make_load_passes(s, &run, &request);
}
