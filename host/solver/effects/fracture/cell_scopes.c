/* What passes over breaking cells find by name. */
#include "cell_breaks_internal.h"

const brc_scope *brc_cell_scopes_make(const brc_simulation *s, const brc_scope *outer, brc_cell_scopes *room)
{
    static const brc_value_row values[] = {{"n_marked", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_cell_breaks, n_marked)}};
    room->breaks = brc_scope_of_breaks(s, outer);
    room->rings = brc_scope_of_rings(s->fracture->cells->rings, &room->breaks);
    room->cells = (brc_scope){.owner = "breaks of cells",
                              .base = s->fracture->cells,
                              .tables = {&brc_cell_break_fields},
                              BRC_VALUES(values),
                              .outer = &room->rings};
    return &room->cells;
}

brc_scope brc_scope_of_deltas(const brc_simulation *s, const brc_scope *outer)
{
    static const brc_value_row values[] = {{"delta", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_cell_breaks, delta)}};
    return (brc_scope){.owner = "changes of the rim", .base = s->fracture->cells, BRC_VALUES(values), .outer = outer};
}

BRC_READ(brc_rings *, brc_cell_breaks_rings, s->fracture && s->fracture->cells ? s->fracture->cells->rings : NULL)

brc_buffer *brc_cell_breaks_array(const brc_simulation *s, const char *name)
{
    return brc_field_named(&brc_cell_break_fields, s->fracture->cells, name);
}
