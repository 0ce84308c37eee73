/* Which elements the loads of a stage may set in motion: all but those that they hold where they are. */
#include "loads_internal.h"

typedef struct driven {
    brc_simulation *s;
    uint8_t *rows;
} driven;

/* [n][width] numbers of the device: those with one that is not 0 are marked. */
static brc_status mark_moving(const driven *to, brc_buffer *numbers, bool is_state, int32_t width, int32_t n,
                              uint8_t *mark)
{
    const int64_t count = (int64_t)width * n;
    BRC_LOCAL(to->s->context, count, double, value, "loads");
    const int bytes = is_state ? brc_state_bytes(to->s) : brc_coeff_bytes(to->s);
    const brc_status status = brc_download(to->s, numbers, bytes, value, count);
    for (int64_t k = 0; k < count; ++k)
        mark[k / width] |= value[k] != 0;
    return status;
}

static brc_status add_rows(const driven *to, brc_buffer *element, int32_t n, const uint8_t *mark)
{
    BRC_LOCAL(to->s->context, n, int32_t, row, "loads");
    const brc_status status = brc_buffer_read(element, 0, row, n * (int64_t)sizeof *row);
    for (int32_t k = 0; k < n; ++k)
        to->rows[row[k]] |= mark[k];
    return status;
}

/* What `direction` says, and `base` where there is one. */
static brc_status add_list(const driven *to, brc_buffer *element, int32_t n, brc_buffer *direction, bool is_state,
                           brc_buffer *base)
{
    BRC_LOCAL(to->s->context, n, uint8_t, mark, "loads");
    BRC_TRY(mark_moving(to, direction, is_state, 3, n, mark));
    if (base) BRC_TRY(mark_moving(to, base, true, 3, n, mark));
    return add_rows(to, element, n, mark);
}

static brc_status add_held_faces(const driven *to, const brc_held_faces *held)
{
    BRC_LOCAL(to->s->context, held->n_faces, uint8_t, moving, "held faces");
    BRC_LOCAL(to->s->context, held->n_elements, uint8_t, mark, "held faces");
    BRC_LOCAL(to->s->context, held->n_elements + 1, int32_t, start, "held faces");
    for (int32_t l = 0; l < held->n_loads; ++l) {
        const brc_held_load *load = held->loads + l;
        BRC_LOCAL(to->s->context, load->n, uint8_t, own, "held faces");
        BRC_LOCAL(to->s->context, load->n, int32_t, face, "held faces");
        BRC_TRY(mark_moving(to, load->direction, true, 3, load->n, own));
        BRC_TRY(mark_moving(to, load->base, true, 3, load->n, own));
        BRC_TRY(brc_buffer_read(load->face, 0, face, load->n * (int64_t)sizeof *face));
        for (int32_t k = 0; k < load->n; ++k)
            moving[face[k]] |= own[k];
    }
    BRC_TRY(brc_buffer_read(held->face_start, 0, start, (held->n_elements + 1) * (int64_t)sizeof *start));
    for (int32_t h = 0; h < held->n_elements; ++h)
        for (int32_t f = start[h]; f < start[h + 1]; ++f)
            mark[h] |= moving[f];
    return add_rows(to, held->element, held->n_elements, mark);
}

brc_status brc_loads_driven(brc_simulation *s, uint8_t *rows)
{
    const brc_loads *loads = s->loads;
    const driven to = {s, rows};
    if (!loads) return BRC_OK;
    if (loads->held.n_elements > 0) BRC_TRY(add_held_faces(&to, &loads->held));
    for (int32_t k = 0; k < loads->n_tractions; ++k)
        BRC_TRY(
            add_list(&to, loads->tractions[k].element, loads->tractions[k].n, loads->tractions[k].total, false, NULL));
    for (int32_t k = 0; k < loads->n_prescribed; ++k)
        BRC_TRY(add_list(&to, loads->prescribed[k].element, loads->prescribed[k].n, loads->prescribed[k].direction,
                         true, loads->prescribed[k].base));
    for (int32_t k = 0; k < loads->n_pushes; ++k)
        BRC_TRY(add_list(&to, loads->pushes[k].element, loads->pushes[k].n, loads->pushes[k].total, true, NULL));
    for (int32_t k = 0; k < loads->n_turns; ++k)
        BRC_TRY(add_list(&to, loads->turns[k].element, loads->turns[k].n, loads->turns[k].direction, true, NULL));
    return BRC_OK;
}
