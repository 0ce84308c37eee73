/* Vectors of static solves, on the device. */
#include "multigrid/multigrid.h"
#include "statics_internal.h"

BRC_WANTED(solves_rotations, brc_solves_rotations(w->model))
BRC_WANTED(solves_moves, !brc_solves_rotations(w->model))
BRC_WANTED(settles_rotations, w->model->statics && w->model->statics->torques)
static bool statics(const brc_wants *w)
{
    bool any = false;
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        any |= w->scene->stages[i].solver == BRC_SOLVER_STATIC;
    return any;
}

#define AT(member) BRC_FIELD_AT(brc_solve_vectors, member)
#define UNKNOWNS(name, member)                                                                                         \
    {name, brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(member.move), "static solver", "-", BRC_NOT_KEPT},               \
    {                                                                                                                  \
        name "_turn", brc_each_row, 3, BRC_FIELD_STATE, solves_rotations, AT(member.turn), "static solver", "-",       \
            BRC_NOT_KEPT                                                                                               \
    }
static const brc_field_row rows[] = {
    UNKNOWNS("x", x),
    UNKNOWNS("r", r),
    UNKNOWNS("z", z),
    UNKNOWNS("p", p),
    UNKNOWNS("kp", kp),
    BRC_KEPT_FIELD(before, brc_each_row, 3, STATE, NULL, "static solver", "m", "static.before"),
    BRC_FIELD(zero, brc_each_row, 3, STATE, settles_rotations, "static solver", "-"),
    BRC_FIELD(orientation, brc_each_row, 4, STATE, brc_wants_turning, "static solver", "-"),
    BRC_FIELD(theta, brc_each_row, 3, STATE, solves_rotations, "static solver", "rad"),
    BRC_FIELD(kept, brc_each_row, 4, STATE, solves_rotations, "static solver", "-"),
    {"block", brc_each_row, 6, BRC_FIELD_STATE, solves_moves, AT(preconditioner.blocks), "preconditioner", "-",
     BRC_NOT_KEPT},
    {"block", brc_each_row, 21, BRC_FIELD_STATE, solves_rotations, AT(preconditioner.blocks), "preconditioner", "-",
     BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_solve_fields, "static solver", BRC_LIFE_SOLVE, statics, rows);

brc_status brc_solve_vectors_create(brc_simulation *s, brc_solve_vectors *v)
{
    v->state_bytes = brc_state_bytes(s);
    v->arm = 1;
    BRC_TRY(brc_fields_create(s->device, &brc_solve_fields, &s->wants, v));
    if (s->domain->radius) {
        double sum = 0;
        for (int64_t e = 0; e < s->domain->n_elements; ++e)
            sum += s->domain->radius[e];
        v->arm = sum / (double)s->domain->n_elements;
    }
    BRC_TRY(brc_statics_find_pieces(s, v));
    return brc_preconditioner_create(s, v);
}

void brc_solve_vectors_free(brc_solve_vectors *v)
{
    brc_fields_free(&brc_solve_fields, v);
    brc_pieces_free(&v->pieces);
    brc_multigrid_free(&v->preconditioner.multigrid);
    brc_rigid_parts_free(&v->preconditioner.parts);
}
