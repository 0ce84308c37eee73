/* State and work arrays of the elements. */
#include "simulation_internal.h"

static bool tchamwa(const brc_wants *w) { return w->tchamwa; }
static bool damping(const brc_wants *w) { return w->damping; }
static bool held_gradients(const brc_wants *w) { return brc_wants_dlsm(w) && w->face_loads; }
static bool held_moments(const brc_wants *w) { return brc_wants_dlsm(w) && (w->face_loads || w->scene->has_contact); }
static bool bond_parts(const brc_wants *w) { return brc_wants_dlsm(w) && w->many_materials; }
/* What breaks cost velocity Verlet is booked with what damps by itself. */
static bool numerical_losses(const brc_wants *w) { return w->tchamwa || (brc_wants_dlsm(w) && w->scene->has_fracture); }

/* Blocks of a sum over three numbers a row (kernels/vector.cl). */
static int64_t each_partial(const brc_wants *w) { return (3 * (int64_t)w->layout->n_rows + 1023) / 1024 + 1; }

#define AT(member) BRC_FIELD_AT(brc_simulation, member)
static const brc_field rows[] = {
    {"displacement", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(displacement), "displacements", "m"},
    {"velocity", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(velocity), "velocities", "m/s"},
    {"force", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(force), "forces", "N"},
    {"gradient", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_dlsm, AT(gradient), "displacement gradients", "-"},
    {"strain", brc_each_row, 6, BRC_FIELD_COEFF, brc_wants_published, AT(gradient), "strains", "-"},
    {"stress", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_dlsm, AT(stress), "stresses", "Pa"},
    {"flux", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_dlsm, AT(flux), "fluxes", "Pa"},
    {"bond_part", brc_each_row, 9, BRC_FIELD_COEFF, bond_parts, AT(bond_part), "bond parts", "Pa"},
    {"held_gradient", brc_each_boundary, 9, BRC_FIELD_COEFF, held_gradients, AT(held_gradient), "held gradients", "m^3"},
    {"held_moment", brc_each_boundary, 9, BRC_FIELD_COEFF, held_moments, AT(held_moment), "held moments", "N m"},
    {"orientation", brc_each_row, 4, BRC_FIELD_STATE, brc_wants_turning, AT(orientation), "orientations", "-"},
    {"spin", brc_each_row, 3, BRC_FIELD_STATE, brc_wants_turning, AT(spin), "spins", "rad/s"},
    {"torque", brc_each_row, 3, BRC_FIELD_STATE, brc_wants_turning, AT(torque), "torques", "N m"},
    {"moved", brc_each_row, 3, BRC_FIELD_STATE, tchamwa, AT(moved), "moves of a step", "m"},
    {"lost_numerical", brc_each_row, 1, BRC_FIELD_STATE, numerical_losses, AT(lost_numerical), "numerical dissipation", "J"},
    {"lost_damping", brc_each_row, 1, BRC_FIELD_STATE, damping, AT(lost_damping), "damping dissipation", "J"},
    {"elastic", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(elastic_energy), "elastic energies", "J"},
    {"stabilisation", brc_each_row, 1, BRC_FIELD_STATE, brc_wants_dlsm, AT(stabilisation_energy), "stabilisation energies", "J"},
    {"kinetic", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(kinetic), "kinetic energies", "J"},
    {"partial", each_partial, 1, BRC_FIELD_STATE, NULL, AT(partial), "block sums", "-"},
};
BRC_FIELD_TABLE(brc_state_fields, "state", BRC_LIFE_RUN, NULL, rows);

brc_status brc_simulation_fields_create(brc_simulation *s)
{
    double *upright = NULL;
    BRC_TRY(brc_fields_create(s->device, &brc_state_fields, &s->wants, s));
    if (!brc_turns(s)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &upright, 4 * (int64_t)s->layout->n_rows, "orientations"));
    for (int64_t r = 0; r < s->layout->n_rows; ++r) upright[4 * r] = 1;
    const brc_status status = brc_upload_state(s, s->orientation, upright, 4 * (int64_t)s->layout->n_rows);
    brc_memory_free(upright);
    return status;
}

void brc_simulation_fields_free(brc_simulation *s) { brc_fields_free(&brc_state_fields, s); }
