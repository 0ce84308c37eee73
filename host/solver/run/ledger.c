/* The energy ledger (docs/notebook/theory.md T4): its terms are named once; closure is relative to the largest
 * energy. */
#include "../models/dlsm/cell_softening.h"
#include "../models/dlsm/closed_faces.h"
#include "../effects/contact/contact.h"
#include "../effects/fracture/fracture_internal.h"
#include "../effects/strikers/strikers_internal.h"
#include <math.h>
#include <string.h>

static brc_status lost(brc_simulation *s, brc_buffer *buffer, double *out)
{
    *out = 0;
    return buffer ? brc_vector_sum(s, buffer, s->layout->n_rows, out) : BRC_OK;
}

/* -sum m g.u */
static brc_status gravity_potential(brc_simulation *s, double *out)
{
    *out = 0;
    if (!s->scene->has_gravity) return BRC_OK;
    const brc_domain *d = s->domain;
    double *u = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &u, 3 * d->n_elements, "displacements"));
    const brc_status status = brc_state_from_rows(s, s->displacement, u, 3);
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int c = 0; c < 3; ++c)
            *out -= d->volume[e] * s->elastic[s->material_of_element[e]].density * s->scene->gravity[c] * u[3 * e + c];
    brc_memory_free(u);
    return status;
}

brc_status brc_simulation_ledger(brc_simulation *s, brc_ledger *out)
{
    memset(out, 0, sizeof *out);
    const int32_t n = s->layout->n_rows;
    BRC_TRY(BRC_RUN(s->pass.kinetic_energy, n, {"velocity", BRC_BUF(s->velocity)}));
    if (s->model->turns) BRC_TRY(BRC_RUN(s->pass.add_spin_energy, n, {"spin", BRC_BUF(s->spin)}));
    BRC_TRY(brc_vector_sum(s, s->kinetic, n, &out->kinetic));
    BRC_TRY(brc_force_energies(s, &out->elastic, &out->stabilisation));
    BRC_TRY(gravity_potential(s, &out->potential));
    if (s->stage >= 0) BRC_TRY(brc_loads_work(s, &out->work));
    out->work += s->work_before;
    BRC_TRY(lost(s, s->lost_damping, &out->damping));
    out->damping += s->released;
    BRC_TRY(lost(s, s->lost_numerical, &out->numerical));
    BRC_TRY(brc_fracture_lost(s, &out->fracture));
    if (s->strikers) {
        brc_striker_energies strikers;
        BRC_TRY(brc_strikers_energies(s, &strikers));
        out->kinetic += strikers.kinetic;
        out->potential += strikers.potential;
        out->work += strikers.work;
        out->numerical += strikers.numerical;
    }
    BRC_TRY(brc_contact_ledger(s, out));
    double opened_rubbed, closed_rubbed, closed;
    BRC_TRY(brc_softening_friction(s, &opened_rubbed));
    BRC_TRY(brc_closed_faces_friction(s, &closed_rubbed));
    BRC_TRY(brc_closed_faces_stored(s, &closed));
    out->friction += opened_rubbed + closed_rubbed;
    out->contact += closed;
    out->initial = s->initial_energy;
    if (out->elastic > s->peak_elastic) s->peak_elastic = out->elastic;
    if (out->kinetic > s->peak_kinetic) s->peak_kinetic = out->kinetic;
    out->peak_elastic = s->peak_elastic;
    out->peak_kinetic = s->peak_kinetic;
    brc_ledger_close(out);
    return BRC_OK;
}

double brc_ledger_term(const brc_ledger *ledger, const char *term)
{
    const struct {
        const char *name;
        double value;
    } terms[] = {{"kinetic", ledger->kinetic},
                 {"elastic", ledger->elastic},
                 {"stabilisation", ledger->stabilisation},
                 {"potential", ledger->potential},
                 {"work", ledger->work},
                 {"damping", ledger->damping},
                 {"numerical", ledger->numerical},
                 {"fracture", ledger->fracture},
                 {"contact", ledger->contact},
                 {"friction", ledger->friction},
                 {"impact", ledger->impact},
                 {"initial", ledger->initial},
                 {"total", ledger->total},
                 {"closure", ledger->closure},
                 {"peak_elastic", ledger->peak_elastic},
                 {"peak_kinetic", ledger->peak_kinetic}};
    for (size_t i = 0; i < sizeof terms / sizeof *terms; ++i)
        if (strcmp(term, terms[i].name) == 0) return terms[i].value;
    return NAN;
}
