/* State and work arrays of the elements. */
#include "core_internal.h"

BRC_WANTED(tchamwa, w->tchamwa)
BRC_WANTED(damping, w->damping)
BRC_WANTED(held_gradients, brc_wants_deforming(w) && w->face_loads)
BRC_WANTED(held_moments, brc_wants_deforming(w) && (w->face_loads || w->scene->has_contact))
BRC_WANTED(bond_parts, brc_wants_deforming(w) && w->many_materials)
/* What breaks cost velocity Verlet is booked with what damps by itself. */
BRC_WANTED(numerical_losses, w->tchamwa || (brc_wants_deforming(w) && w->scene->has_fracture))

/* Blocks of a sum over three numbers a row (vector.cl). */
/* Of sums over blocks of 1024 of as many as 3 n_rows numbers; with fracture of all that a step with breaks asks for. */
BRC_COUNTED(each_partial, (w->scene->has_fracture ? 12 : 3) * (((int64_t)w->layout->n_rows + 1023) / 1024 + 1))

#define AT(member) BRC_FIELD_AT(struct brc_core, member)
static const brc_field_row rows[] = {
    BRC_KEPT_FIELD(displacement, brc_each_row, 3, STATE, NULL, "displacements", "m", "displacement"),
    BRC_KEPT_FIELD(velocity, brc_each_row, 3, STATE, NULL, "velocities", "m/s", "velocity"),
    BRC_KEPT_FIELD(force, brc_each_row, 3, STATE, NULL, "forces", "N", "force"),
    BRC_FIELD(gradient, brc_each_row, 9, COEFF, brc_wants_deforming, "displacement gradients", "-"),
    {"strain", brc_each_row, 6, BRC_FIELD_COEFF, brc_wants_rigid_cells, AT(gradient), "strains", "-",
     BRC_KEPT("strain", BRC_KEEP_ALL)},
    BRC_FIELD(stress, brc_each_row, 9, COEFF, brc_wants_deforming, "stresses", "Pa"),
    BRC_FIELD(flux, brc_each_row, 9, COEFF, brc_wants_deforming, "fluxes", "Pa"),
    BRC_FIELD(bond_part, brc_each_row, 9, COEFF, bond_parts, "bond parts", "Pa"),
    BRC_FIELD(held_gradient, brc_each_boundary, 9, COEFF, held_gradients, "held gradients", "m^3"),
    BRC_FIELD(held_moment, brc_each_boundary, 9, COEFF, held_moments, "held moments", "N m"),
    BRC_KEPT_FIELD(orientation, brc_each_row, 4, STATE, brc_wants_turning, "orientations", "-", "orientation"),
    BRC_KEPT_FIELD(spin, brc_each_row, 3, STATE, brc_wants_turning, "spins", "rad/s", "spin"),
    BRC_KEPT_FIELD(torque, brc_each_row, 3, STATE, brc_wants_turning, "torques", "N m", "torque"),
    BRC_FIELD(moved, brc_each_row, 3, STATE, tchamwa, "moves of a step", "m"),
    BRC_KEPT_FIELD(lost_numerical, brc_each_row, 1, STATE, numerical_losses, "numerical dissipation", "J",
                   "lost_numerical"),
    BRC_KEPT_FIELD(lost_damping, brc_each_row, 1, STATE, damping, "damping dissipation", "J", "lost_damping"),
    {"elastic", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(elastic_energy), "elastic energies", "J", BRC_NOT_KEPT},
    {"stabilisation", brc_each_row, 1, BRC_FIELD_STATE, brc_wants_deforming, AT(stabilisation_energy),
     "stabilisation energies", "J", BRC_NOT_KEPT},
    BRC_FIELD(kinetic, brc_each_row, 1, STATE, NULL, "kinetic energies", "J"),
    BRC_FIELD(partial, each_partial, 1, STATE, NULL, "block sums", "-"),
};
BRC_FIELD_TABLE(brc_state_fields, "state", BRC_LIFE_RUN, NULL, rows);

brc_status brc_simulation_fields_create(brc_simulation *s)
{
    BRC_TRY(brc_fields_create(s->device, &brc_state_fields, &s->wants, s->core));
    return brc_simulation_set_upright(s);
}

brc_status brc_simulation_set_upright(brc_simulation *s)
{
    if (!s->model->turns) return BRC_OK;
    BRC_LOCAL(s->context, 4 * (int64_t)s->layout->n_rows, double, upright, "orientations");
    for (int64_t r = 0; r < s->layout->n_rows; ++r)
        upright[4 * r] = 1;
    return brc_upload_state(s, s->core->orientation, upright, 4 * (int64_t)s->layout->n_rows);
}

void brc_simulation_fields_free(brc_simulation *s)
{
    if (!s->core) return;
    brc_fields_free(&brc_state_fields, s->core);
}

/* Displacement gradients and stresses of dlsm follow from the displacements; the strains of dlsm-published do so only
 * to rounding, since the half kick that closes a batch normalises its orientations once more. */
brc_status brc_store_elements(brc_simulation *s, brc_state_store *store)
{
    return brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_state_fields, .owner = s->core});
}
