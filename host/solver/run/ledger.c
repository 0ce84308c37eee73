/* The energy ledger (docs/notebook/theory.md T4): its terms are named once; closure is relative to the largest
 * energy. */
#include "run_internal.h"
#include <math.h>
#include <string.h>

static brc_status lost(brc_simulation *s, brc_buffer *buffer, double *out)
{
    *out = 0;
    return buffer ? brc_vector_sum(s, buffer, s->layout->n_rows, out) : BRC_OK;
}

brc_status brc_simulation_ledger(brc_simulation *s, brc_ledger *out)
{
    memset(out, 0, sizeof *out);
    const int32_t n = s->layout->n_rows;
    BRC_TRY(BRC_RUN(s->run->pass.kinetic_energy, n, {"velocity", BRC_BUF(brc_velocity_of(s))}));
    if (s->model->turns) BRC_TRY(BRC_RUN(s->run->pass.add_spin_energy, n, {"spin", BRC_BUF(brc_spin_of(s))}));
    BRC_TRY(brc_vector_sum(s, brc_kinetic_of(s), n, &out->kinetic));
    BRC_TRY(brc_force_energies(s, &out->elastic, &out->stabilisation));
    BRC_TRY(lost(s, brc_lost_damping_of(s), &out->damping));
    out->damping += brc_statics_released(s);
    out->work += brc_statics_changing(s);
    BRC_TRY(lost(s, brc_lost_numerical_of(s), &out->numerical));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_LEDGER, &(brc_occasion){.ledger = out}));
    out->initial = s->run->initial_energy;
    if (out->elastic > s->run->peak_elastic) s->run->peak_elastic = out->elastic;
    if (out->kinetic > s->run->peak_kinetic) s->run->peak_kinetic = out->kinetic;
    out->peak_elastic = s->run->peak_elastic;
    out->peak_kinetic = s->run->peak_kinetic;
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
