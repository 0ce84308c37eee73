/* Records asked for ahead of their use. */
#include "layout.h"
#include "../../base/memory.h"

/* What a slice needs that was not at hand lately: rows [n], by slice [start]. */
typedef struct slice_needs {
    int32_t *row;
    int64_t *start; /* [n_slices + 1] */
} slice_needs;

/* Rows are asked for in turn, BRC_AHEAD_ROWS before they are gone over; `used`: the first row of the slice that
 * gathered it last. */
static bool at_hand(int64_t row, int64_t now, int64_t used)
{
    const int64_t in_turn = row - BRC_AHEAD_ROWS;
    return used >= now - BRC_AHEAD_ROWS || (in_turn <= now && in_turn >= now - BRC_AHEAD_ROWS);
}

static void find_needs(const brc_domain *domain, const brc_layout *layout, int64_t *used, slice_needs *out)
{
    int64_t n = 0;
    for (int32_t r = 0; r < layout->n_rows; ++r)
        used[r] = -2 * (int64_t)BRC_AHEAD_ROWS;
    for (int32_t s = 0; s < layout->n_slices; ++s) {
        const int64_t now = (int64_t)s * layout->slice;
        out->start[s] = n;
        for (int32_t l = 0; l < layout->slice; ++l)
            used[now + l] = now;
        for (int64_t k = (int64_t)layout->slot_start[s] * layout->slice,
                     end = (int64_t)layout->slot_start[s + 1] * layout->slice;
             k < end; ++k) {
            if (layout->half_edge[k] < 0) continue;
            const int32_t row = layout->row_of_element[domain->neighbour[layout->half_edge[k]]];
            if (!at_hand(row, now, used[row])) out->row[n++] = row;
            used[row] = now;
        }
    }
    out->start[layout->n_slices] = n;
}

/* Backwards, each slice asks for what is needed BRC_AHEAD_LEAD rows further on or, where that is more than it has rows,
 * leaves the rest to the slices before it, which ask for the latest first. */
static void hand_out(brc_layout *layout, const slice_needs *needs)
{
    const int32_t slice = layout->slice, lead = (BRC_AHEAD_LEAD + slice - 1) / slice;
    int64_t next = needs->start[layout->n_slices] - 1; /* the latest that nobody asks for yet */
    for (int32_t s = layout->n_slices - 1; s >= 0; --s) {
        const int32_t of = s + lead < layout->n_slices ? s + lead : layout->n_slices - 1;
        const int32_t too_late =
            of + BRC_AHEAD_ROWS / slice < layout->n_slices ? of + BRC_AHEAD_ROWS / slice : layout->n_slices;
        while (next >= needs->start[too_late])
            --next; /* would be gone again by then */
        for (int32_t l = 0; l < slice; ++l)
            layout->ahead[s * slice + l] = next >= needs->start[of] ? needs->row[next--] : s * slice + l;
    }
}

brc_status brc_layout_ahead(brc_context *context, const brc_domain *domain, brc_layout *layout)
{
    brc_status status = BRC_OK;
    slice_needs needs = {0};
    int64_t *used = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->ahead, layout->n_rows, "rows asked for ahead"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &used, layout->n_rows, "rows in use"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &needs.start, layout->n_slices + 1, "slices' needs"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &needs.row, layout->n_slots * layout->slice, "rows needed"));
    find_needs(domain, layout, used, &needs);
    hand_out(layout, &needs);
cleanup:
    brc_memory_free(needs.row);
    brc_memory_free(needs.start);
    brc_memory_free(used);
    return status;
}
