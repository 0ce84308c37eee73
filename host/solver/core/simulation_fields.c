/* State and work arrays of the elements. */
#include "core_internal.h"

static bool tchamwa(const brc_wants *w)
{
    return w->tchamwa;
}
static bool damping(const brc_wants *w)
{
    return w->damping;
}
static bool held_gradients(const brc_wants *w)
{
    return brc_wants_deforming(w) && w->face_loads;
}
static bool held_moments(const brc_wants *w)
{
    return brc_wants_deforming(w) && (w->face_loads || w->scene->has_contact);
}
static bool bond_parts(const brc_wants *w)
{
    return brc_wants_deforming(w) && w->many_materials;
}
/* What breaks cost velocity Verlet is booked with what damps by itself. */
static bool numerical_losses(const brc_wants *w)
{
    return w->tchamwa || (brc_wants_deforming(w) && w->scene->has_fracture);
}

/* Blocks of a sum over three numbers a row (vector.cl). */
static int64_t each_partial(const brc_wants *w)
{
    return (3 * (int64_t)w->layout->n_rows + 1023) / 1024 + 1;
}

#define AT(member) BRC_FIELD_AT(struct brc_core, member)
static const brc_field_row rows[] = {
    {"displacement", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(displacement), "displacements", "m",
     BRC_KEPT("displacement", BRC_KEEP_ALL)},
    {"velocity", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(velocity), "velocities", "m/s",
     BRC_KEPT("velocity", BRC_KEEP_ALL)},
    {"force", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(force), "forces", "N", BRC_KEPT("force", BRC_KEEP_ALL)},
    {"gradient", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_deforming, AT(gradient), "displacement gradients", "-",
     BRC_NOT_KEPT},
    {"strain", brc_each_row, 6, BRC_FIELD_COEFF, brc_wants_rigid_cells, AT(gradient), "strains", "-",
     BRC_KEPT("strain", BRC_KEEP_ALL)},
    {"stress", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_deforming, AT(stress), "stresses", "Pa", BRC_NOT_KEPT},
    {"flux", brc_each_row, 9, BRC_FIELD_COEFF, brc_wants_deforming, AT(flux), "fluxes", "Pa", BRC_NOT_KEPT},
    {"bond_part", brc_each_row, 9, BRC_FIELD_COEFF, bond_parts, AT(bond_part), "bond parts", "Pa", BRC_NOT_KEPT},
    {"held_gradient", brc_each_boundary, 9, BRC_FIELD_COEFF, held_gradients, AT(held_gradient), "held gradients", "m^3",
     BRC_NOT_KEPT},
    {"held_moment", brc_each_boundary, 9, BRC_FIELD_COEFF, held_moments, AT(held_moment), "held moments", "N m",
     BRC_NOT_KEPT},
    {"orientation", brc_each_row, 4, BRC_FIELD_STATE, brc_wants_turning, AT(orientation), "orientations", "-",
     BRC_KEPT("orientation", BRC_KEEP_ALL)},
    {"spin", brc_each_row, 3, BRC_FIELD_STATE, brc_wants_turning, AT(spin), "spins", "rad/s",
     BRC_KEPT("spin", BRC_KEEP_ALL)},
    {"torque", brc_each_row, 3, BRC_FIELD_STATE, brc_wants_turning, AT(torque), "torques", "N m",
     BRC_KEPT("torque", BRC_KEEP_ALL)},
    {"moved", brc_each_row, 3, BRC_FIELD_STATE, tchamwa, AT(moved), "moves of a step", "m", BRC_NOT_KEPT},
    {"lost_numerical", brc_each_row, 1, BRC_FIELD_STATE, numerical_losses, AT(lost_numerical), "numerical dissipation",
     "J", BRC_KEPT("lost_numerical", BRC_KEEP_ALL)},
    {"lost_damping", brc_each_row, 1, BRC_FIELD_STATE, damping, AT(lost_damping), "damping dissipation", "J",
     BRC_KEPT("lost_damping", BRC_KEEP_ALL)},
    {"elastic", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(elastic_energy), "elastic energies", "J", BRC_NOT_KEPT},
    {"stabilisation", brc_each_row, 1, BRC_FIELD_STATE, brc_wants_deforming, AT(stabilisation_energy),
     "stabilisation energies", "J", BRC_NOT_KEPT},
    {"kinetic", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(kinetic), "kinetic energies", "J", BRC_NOT_KEPT},
    {"partial", each_partial, 1, BRC_FIELD_STATE, NULL, AT(partial), "block sums", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_state_fields, "state", BRC_LIFE_RUN, NULL, rows);

brc_status brc_simulation_fields_create(brc_simulation *s)
{
    BRC_TRY(brc_fields_create(s->device, &brc_state_fields, &s->wants, s->core));
    BRC_TRY(brc_buffer_create_scratch(s->core->kinetic, &s->core->listed));
    if (!s->model->turns) return BRC_OK;
    BRC_LOCAL(s->context, 4 * (int64_t)s->layout->n_rows, double, upright, "orientations");
    for (int64_t r = 0; r < s->layout->n_rows; ++r)
        upright[4 * r] = 1;
    return brc_upload_state(s, s->core->orientation, upright, 4 * (int64_t)s->layout->n_rows);
}

void brc_simulation_fields_free(brc_simulation *s)
{
    if (!s->core) return;
    brc_buffer_free(&s->core->listed);
    brc_fields_free(&brc_state_fields, s->core);
}

/* Displacement gradients and stresses of dlsm follow from the displacements; the strains of dlsm-published do so only
 * to rounding, since the half kick that closes a batch normalises its orientations once more. */
brc_status brc_store_elements(brc_simulation *s, brc_state_store *store)
{
    return brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_state_fields, .owner = s->core});
}
