/* What core/ keeps of a simulation: made first, freed last. */
#include "core_internal.h"

brc_status brc_core_create(brc_simulation *s)
{
    return BRC_ALLOCATE(s->context, &s->core, 1, "simulation");
}

void brc_core_free(brc_simulation *s)
{
    if (s->core) brc_passes_free(&s->core->passes);
    brc_vector_kernels_free(s);
    brc_memory_free(s->core);
    s->core = NULL;
}

void brc_want_exposed(brc_simulation *s, int64_t exposed, int64_t buckets)
{
    s->wants.exposed_room = exposed;
    s->wants.bucket_room = buckets;
}
void brc_want_pieces(brc_simulation *s, const brc_convex *pieces)
{
    s->wants.pieces = pieces;
}
