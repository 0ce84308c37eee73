/* What passes over breaking cells find by name. */
#include "cell_breaks_internal.h"

const brc_scope *brc_cell_scopes_make(const brc_simulation *s, const brc_scope *outer, brc_cell_scopes *room)
{
    room->breaks = brc_scope_of_breaks(s, outer);
    room->rings = brc_scope_of_rings(s->fracture->cells->rings, &room->breaks);
    room->cells = (brc_scope){.owner = "breaks of cells",
                              .base = s->fracture->cells,
                              .tables = {&brc_cell_break_fields},
                              .outer = &room->rings};
    return &room->cells;
}
