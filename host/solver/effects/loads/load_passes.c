/* Passes of loads, in the scopes of their lists. */
#include "loads_internal.h"

/* What passes over two lists at a time are given of the other. */
#define OTHER_MOVED "other_factor other_rate other_element other_component other_base other_direction"
#define OTHER_BOOKED                                                                                                   \
    "other_rate other_last_rate other_element other_component other_direction other_reaction other_last "              \
    "other_last_reaction other_work"

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

brc_scope brc_scope_of_held_faces(const brc_simulation *s, const brc_scope *outer)
{
    return (brc_scope){.owner = "held faces",
                       .base = &s->loads->held,
                       .tables = {&brc_held_element_fields, &brc_held_face_fields},
                       .outer = outer};
}

brc_status brc_load_passes_make(brc_simulation *s)
{
    static const brc_value_row of_traction[] = {
        {"last_factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_traction_load, last_factor)}};
    static const brc_value_row of_prescribed[] = {
        {"last_rate", BRC_VALUE_REAL, BRC_FIELD_AT(brc_prescribed_load, last_rate)}};
    static const brc_value_row of_push[] = {{"factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_push_load, factor)},
                                            {"last_factor", BRC_VALUE_REAL, BRC_FIELD_AT(brc_push_load, last_factor)}};
    static const brc_value_row of_turn[] = {{"last_rate", BRC_VALUE_REAL, BRC_FIELD_AT(brc_turn_load, last_rate)}};
    brc_load_passes *p = &s->loads->pass;
    const bool turns = s->model->turns;
    const brc_scope of_run = brc_scope_of_run(s),
                    of_request = brc_scope_of_request(&of_run), *const run = &of_run, *const request = &of_request;
    const brc_scope held = brc_scope_of_held_faces(s, request), state = brc_scope_of_held_faces(s, run);
    const brc_scope held_load = scope_of_load("held load", &brc_held_load_fields, 0, NULL, &state);
    const brc_scope traction = scope_of_load("traction", &brc_traction_fields, 1, of_traction, request);
    const brc_face_scopes faces = {&held, &state, &held_load, &traction, &p->held_prescribe, &p->held_energy};
    if (s->model->make_face_passes) BRC_TRY(s->model->make_face_passes(s, &faces));
    const brc_scope prescribed = scope_of_load("imposed elements", &brc_prescribed_fields, 1, of_prescribed, request);
    BRC_TRY(BRC_PASSES(s, &prescribed, {&p->impose_book, "impose_book", "n_first rate " OTHER_BOOKED, false}));
    const brc_scope still = scope_of_load("imposed elements", &brc_prescribed_fields, 1, of_prescribed, run);
    BRC_TRY(BRC_PASSES(s, &still,
                       {&p->impose_motion, "impose_motion", "n_first set_displacement factor rate " OTHER_MOVED, false},
                       {&p->zero_prescribed, "impose_zero", "n_first vector other_element other_component", false}));
    const brc_scope push = scope_of_load("forces on elements", &brc_push_fields, 2, of_push, request);
    BRC_TRY(BRC_PASSES(s, &push, {&p->push_elements, "push_elements", NULL, false}));
    const brc_scope turn = scope_of_load("turned elements", &brc_turn_fields, 1, of_turn, request);
    BRC_TRY(BRC_PASSES(s, &turn, {&p->turn_book, "turn_book", "step rate", !turns}));
    const brc_scope turning = scope_of_load("turned elements", &brc_turn_fields, 1, of_turn, run);
    return BRC_PASSES(s, &turning, {&p->impose_turn, "impose_turn", "angle finite rate", !turns},
                      {&p->zero_turned, "impose_zero", "n_first vector other_element other_component", !turns});
}
