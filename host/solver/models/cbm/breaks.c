/* Beams that break by the virial stress of their elements: limits, and the order of the passes. */
#include "beam_alone.h"
#include "beam_bridges.h"
#include "beam_closure.h"
#include "../../core/awake.h"
#include "../../laws/beam_law.h"
#include "beam_softening.h"
#include "../../effects/contact/contact.h"
#include "../../effects/fracture/breaking.h"
#include "../../laws/strength_law.h"
#include "cbm_internal.h"
#include <math.h>

/* k of one body's beams; and nominal, what the test that the material's strength is from reads over the strength in
 * tension, 1 where that is tension [-, both]. Refused by the body's own coordination number; taken at that of the cube
 * of 10 000 spheres with as many bonds inside, since a body's walls should no more change its strength than its
 * stiffness. */
static brc_status strength_ratio(brc_simulation *s, const brc_material *m, int32_t body, double radius_ratio, double *k,
                                 double *nominal)
{
    const brc_domain *d = s->domain;
    const brc_strength_law *law = brc_strength_law_default();
    brc_beam_body bonds;
    double least = INFINITY, most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (d->body[e] != body) continue;
        least = fmin(least, d->radius[e]);
        most = fmax(most, d->radius[e]);
    }
    BRC_TRY(brc_beam_body_of(s->context, d, body, &bonds));
    BRC_TRY(brc_strength_law_find(s->context, law, bonds.coordination, radius_ratio, k));
    const double coordination =
        brc_beam_law_coordination(brc_beam_law_for(most > 0 ? (most - least) / (most + least) : 0), &bonds);
    *k = brc_strength_law_ratio(law, coordination, radius_ratio);
    brc_log(s->context, BRC_LOG_INFO,
            "material '%s': limits are the strengths over k = %.4f (%s, r_m %.4g, coordination number %.4g, as of "
            "cubes of 10 000 spheres with %.4g; %s: %.4f)",
            m->name, *k, law->name, radius_ratio, bonds.coordination, coordination, brc_strength_law_published()->name,
            brc_strength_law_ratio(brc_strength_law_published(), coordination, radius_ratio));
    *nominal = 1;
    if (m->measured_by == BRC_STRENGTH_BY_TENSION) return BRC_OK;
    double disc;
    BRC_TRY(brc_strength_law_disc(s->context, coordination, radius_ratio, &disc));
    *nominal = m->measured_by == BRC_STRENGTH_BY_EITHER ? brc_strength_law_either(disc) : disc;
    brc_log(s->context, BRC_LOG_INFO,
            "material '%s': discs of its packing split at %.4g of the strength in tension, which is taken as %.4g Pa "
            "for %.4g Pa measured by %s",
            m->name, disc, m->tension / *nominal, m->tension,
            m->measured_by == BRC_STRENGTH_BY_EITHER ? "either test" : "them");
    return BRC_OK;
}

/* Limits of the virial stress of one material in one body. */
brc_status brc_cbm_limits(brc_simulation *s, const brc_limit_case *of, double limit[3])
{
    const brc_material *m = of->material;
    const double shear = of->shear,
                 radius_ratio = brc_beam_of_element(s, of->element)->radius * of->n_elements / of->radii;
    double k = 1, nominal = 1;
    limit[0] = limit[1] = limit[2] = 0;
    const bool by_law =
        (m->tension > 0 && !(m->beam_strength > 0)) || (m->compression > 0 && !(m->beam_compression > 0)) || shear > 0;
    if (by_law) {
        BRC_TRY(strength_ratio(s, m, of->body, radius_ratio, &k, &nominal));
        if (s->scene->fracture.level != 1)
            brc_log(s->context, BRC_LOG_WARNING,
                    "fracture: the law for strength was fitted for level 1, the scene asks for level %d; give "
                    "beam: {strength: ...} where that matters",
                    (int)s->scene->fracture.level);
    }
    limit[0] = m->beam_strength > 0 ? m->beam_strength : m->tension / (k * nominal);
    limit[1] = m->beam_compression > 0 ? m->beam_compression : m->compression / k;
    limit[2] = shear / k;
    return BRC_OK;
}

brc_status brc_cbm_create_fracture(brc_simulation *s)
{
    brc_cbm_own *own = brc_cbm_own_of(s);
    BRC_TRY(brc_fracture_create_elements(s, brc_offset_of(s)));
    const brc_scope run = brc_scope_of_run(s), request = brc_scope_of_request(&run),
                    breaks = brc_scope_of_breaks(s, &run), criterion = brc_scope_of_criterion(s, &breaks),
                    evaluation = brc_scope_of_criterion(s, &request);
    BRC_TRY(BRC_PASSES(s, &criterion, BRC_PASS(&own->break_pass, "fracture_break", "level step half_kick")));
    BRC_TRY(BRC_PASSES(s, &evaluation, BRC_PASS(&own->breaking_force, "fracture_force", "shuts rubs other bears")));
    BRC_TRY(brc_beam_alone_create(s));
    BRC_TRY(brc_beam_bridges_create(s));
    return brc_beam_closure_create(s);
}

brc_status brc_cbm_breaking_force(brc_simulation *s, const brc_force_request *r)
{
    brc_buffer *rubs = NULL, *other = NULL, *bears = NULL;
    const bool shuts = brc_beam_closure_within(s, &rubs, &other, &bears);
    BRC_TRY(brc_pass_run_awake(s, brc_cbm_own_of(s)->breaking_force, s->n_groups, r,
                               BRC_GIVEN({"shuts", BRC_INT(shuts)}, {"rubs", BRC_BUF(rubs)}, {"other", BRC_BUF(other)},
                                         {"bears", BRC_BUF(bears)})));
    BRC_TRY(brc_beam_softening_force(s, r));
    return brc_beam_closure_force(s, r);
}

brc_status brc_cbm_break_bonds(brc_simulation *s, double half_kick)
{
    const int32_t moment = (int32_t)brc_fracture_moment(s);
    BRC_TRY(brc_fracture_choose(s, moment));
    BRC_TRY(brc_beam_alone_choose(s, moment));
    BRC_TRY(brc_beam_bridges_choose(s, moment, half_kick));
    BRC_TRY(brc_beam_softening_begin(s, moment));
    BRC_TRY(BRC_RUN(brc_cbm_own_of(s)->break_pass, s->n_groups, {"level", BRC_INT(s->scene->fracture.level)},
                    {"step", BRC_INT(moment)}, {"half_kick", BRC_STATE(half_kick)}));
    BRC_TRY(brc_beam_softening_end(s, moment));
    BRC_TRY(brc_beam_closure_begin(s, moment, half_kick));
    BRC_TRY(brc_constrain(s, NULL, brc_torque_of(s))); /* prescribed rotations balance theirs */
    const brc_step_phase before = brc_phase_within(s, BRC_PHASE_SEARCH);
    BRC_TRY(brc_contact_broken(s, half_kick));
    brc_phase_within(s, before);
    return BRC_OK;
}
