#include "live_arrays.h"
#include "core_internal.h"

int brc_simulation_live_arrays(const brc_simulation *s, brc_live_array out[BRC_LIVE_ARRAYS_MOST])
{
    const brc_live_array all[] = {{"displacement", "m", s->core->displacement, 3},
                                  {"velocity", "m/s", s->core->velocity, 3},
                                  {"force", "N", s->core->force, 3},
                                  {"orientation", "-", s->core->orientation, 4},
                                  {"spin", "rad/s", s->core->spin, 3}};
    int n = 0;
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        if (all[k].buffer) out[n++] = all[k];
    for (int k = 0; k < s->core->n_effects && n < BRC_LIVE_ARRAYS_MOST; ++k)
        if (s->core->effect[k]->live && s->core->effect[k]->live(s, out + n)) ++n;
    return n;
}

int32_t brc_simulation_rows(const brc_simulation *s, const int32_t **element_of_row)
{
    *element_of_row = s->layout->element_of_row;
    return s->layout->n_rows;
}
