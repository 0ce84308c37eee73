/* Model cbm: spheres joined by beams, NAH19 (docs/notebook/beams.md). */
#include "../../effects/guard_cause.h"
#include "../../effects/effect.h"
#include "beam_alone.h"
#include "beam_bridges.h"
#include "beam_closure.h"
#include "beam_softening.h"
#include "cbm_internal.h"

static const brc_model_statics statics = {
    .rotations = true, .symmetric = true, .blocks = brc_beams_precondition_blocks, .bond = brc_cbm_bond};
static const brc_model_step_bound step_bound = {brc_beams_node_bound, "auto: node bound",
                                                "auto: node bound and contact"};

static void explain_loss(const brc_simulation *s, char *text, size_t size)
{
    (void)s;
    brc_text_append(
        text, size,
        "beams that were stretched or bent far beyond their law (sections turned by more than a right angle)");
}

static double bond_radius(const brc_simulation *s, int64_t e)
{
    return brc_beam_of_element(s, e)->radius;
}

/* Friction of broken interfaces. */
static brc_status energies(brc_simulation *s, const brc_occasion *now)
{
    double rubbed;
    BRC_TRY(brc_beam_closure_friction(s, &rubbed));
    BRC_TRY(brc_vector_sums(s));
    now->ledger->friction += rubbed;
    return BRC_OK;
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_MOVED,
                                     .order = BRC_MOVED_BONDS,
                                     .phase = BRC_PHASE_FRACTURE,
                                     .plain = brc_beam_softening_move,
                                     .due = brc_beam_softening_is_on},
                                    {.hook = BRC_HOOK_MOVED, .order = BRC_MOVED_BONDS, .plain = brc_beam_closure_move},
                                    {.hook = BRC_HOOK_LEDGER, .call = energies}};
static const brc_field_table *const fields[] = {&brc_beam_softening_fields, &brc_beam_closure_fields,
                                                &brc_beam_alone_fields, &brc_beam_bridge_fields, NULL};

extern const brc_bond_model brc_cbm;
const brc_bond_model brc_cbm = {
    .element = BRC_ELEMENT_SPHERE,
    .turns = true,
    .surface = BRC_SURFACE_SPHERE,
    .effect = {{"beams and element rotations (cbm)", NULL}},
    .make_passes = brc_cbm_make_passes,
    .evaluate = brc_cbm_evaluate,
    .energies = brc_cbm_energies,
    .step_passes = brc_cbm_step_passes,
    .strain_stress = brc_cbm_strain_stress,
    .virial_stress = brc_beams_stress,
    .create = brc_cbm_create,
    .free = brc_cbm_free,
    .upload = brc_cbm_upload,
    .renew = brc_cbm_renew,
    .create_fracture = brc_cbm_create_fracture,
    .break_bonds = brc_cbm_break_bonds,
    .cohesion = &brc_cbm_cohesion,
    .limits = brc_cbm_limits,
    .bond_radius = bond_radius,
    .statics = &statics,
    .step_bound = &step_bound,
    .conserves = true,
    .explain_loss = explain_loss,
    .fields = fields,
    BRC_HOOKED(hooked),
};
