/* Counting bonds inside and at the walls. */
#include "beam_body.h"
#include "../../preprocess/sets.h"
#include "../base/memory.h"

/* Fewer inner elements than this say too little: the mean of so many scatters by half a percent. */
enum { FEWEST = 200 };

/* Mark the elements of all wall layers; false: there are none. */
static bool mark_layers(const brc_domain *d, uint8_t *at_wall)
{
    bool found = false;
    for (int32_t w = 0; w < d->n_walls; ++w) {
        char layer[BRC_LAYER_NAME];
        brc_sets_layer_name(d->wall_name[w], layer);
        const int32_t s = brc_domain_find_set(d, layer);
        if (s < 0 || d->sets[s].kind != BRC_SET_ELEMENTS) continue;
        found |= d->sets[s].n_members > 0;
        for (int64_t k = 0; k < d->sets[s].n_members; ++k) at_wall[d->sets[s].members[k]] = 1;
    }
    return found;
}

brc_status brc_beam_body_of(brc_context *context, const brc_domain *d, int32_t body, brc_beam_body *out)
{
    uint8_t *at_wall = NULL;
    int64_t n = 0, inside = 0, ends = 0, inner_ends = 0;
    *out = (brc_beam_body){0};
    BRC_TRY(BRC_ALLOCATE(context, &at_wall, d->n_elements, "elements at walls"));
    const bool has_walls = mark_layers(d, at_wall);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (body >= 0 && d->body[e] != body) continue;
        const int64_t own = d->row_start[e + 1] - d->row_start[e];
        ++n;
        ends += own;
        if (at_wall[e]) continue;
        ++inside;
        inner_ends += own;
    }
    if (n > 0) out->coordination = (double)ends / (double)n;
    if (has_walls && inside >= FEWEST) out->inner = (double)inner_ends / (double)inside;
    brc_memory_free(at_wall);
    return BRC_OK;
}
