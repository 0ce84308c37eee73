#include "layout.h"
#include "../base/memory.h"
#include <stdlib.h>
#include <string.h>

enum { WINDOW_SLICES = 32, CURVE_BITS = 16 };

/* Place of a cell on the Hilbert curve of 2^bits cells a side (Skilling's transposition, AIP Conf. Proc. 707, 2004). */
static uint64_t hilbert_key(const uint32_t cell[3])
{
    uint32_t x[3] = {cell[0], cell[1], cell[2]};
    for (uint32_t q = 1u << (CURVE_BITS - 1); q > 1; q >>= 1) {
        const uint32_t p = q - 1;
        for (int i = 0; i < 3; ++i) {
            if (x[i] & q) {
                x[0] ^= p;
            } else {
                const uint32_t t = (x[0] ^ x[i]) & p;
                x[0] ^= t;
                x[i] ^= t;
            }
        }
    }
    for (int i = 1; i < 3; ++i) x[i] ^= x[i - 1];
    uint32_t t = 0;
    for (uint32_t q = 1u << (CURVE_BITS - 1); q > 1; q >>= 1)
        if (x[2] & q) t ^= q - 1;
    for (int i = 0; i < 3; ++i) x[i] ^= t;
    uint64_t key = 0;
    for (int bit = CURVE_BITS - 1; bit >= 0; --bit)
        for (int i = 0; i < 3; ++i) key = (key << 1) | ((x[i] >> bit) & 1u);
    return key;
}

typedef struct sort_item {
    uint64_t key;
    int32_t element;
} sort_item;

static int compare_items(const void *left, const void *right)
{
    const sort_item *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return a->element < b->element ? -1 : a->element > b->element;
}

static int32_t degree(const brc_domain *domain, int32_t element)
{
    return (int32_t)(domain->row_start[element + 1] - domain->row_start[element]);
}

static bool has_free_face(const brc_domain *domain, int32_t element)
{
    return domain->free_start[element + 1] > domain->free_start[element];
}

/* Elements in storage order. */
static void order_elements(const brc_domain *domain, int32_t slice, sort_item *items)
{
    double scale = 0;
    for (int c = 0; c < 3; ++c) {
        const double width = domain->bounds[1][c] - domain->bounds[0][c];
        if (width > scale) scale = width;
    }
    const double per_cell = scale > 0 ? ((1u << CURVE_BITS) - 1) / scale : 0;
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        uint32_t cell[3];
        for (int c = 0; c < 3; ++c) {
            const double at = (domain->position[3 * e + c] - domain->bounds[0][c]) * per_cell;
            cell[c] = at > 0 ? (uint32_t)at : 0;
            if (cell[c] >= 1u << CURVE_BITS) cell[c] = (1u << CURVE_BITS) - 1;
        }
        items[e] = (sort_item){hilbert_key(cell), (int32_t)e};
    }
    qsort(items, (size_t)domain->n_elements, sizeof *items, compare_items);
    /* inside a window: elements with free faces first, then by falling degree, then along the curve */
    const int64_t window = (int64_t)WINDOW_SLICES * slice;
    for (int64_t begin = 0; begin < domain->n_elements; begin += window) {
        const int64_t end = begin + window < domain->n_elements ? begin + window : domain->n_elements;
        for (int64_t i = begin; i < end; ++i) {
            const int32_t e = items[i].element;
            items[i].key = (uint64_t)(has_free_face(domain, e) ? 0 : 1) << 63 |
                           (uint64_t)(0x7fffffff - degree(domain, e)) << 32 | (uint64_t)(i - begin);
        }
        qsort(items + begin, (size_t)(end - begin), sizeof *items, compare_items);
    }
}

brc_status brc_layout_create(brc_context *context, const brc_domain *domain, int32_t slice, brc_layout **out)
{
    *out = NULL;
    brc_layout *layout = NULL;
    sort_item *items = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &layout, 1, "storage layout"));
    layout->slice = slice;
    layout->n_slices = (int32_t)((domain->n_elements + slice - 1) / slice);
    layout->n_rows = layout->n_slices * slice;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &items, domain->n_elements, "storage order"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->row_of_element, domain->n_elements, "storage rows"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->element_of_row, layout->n_rows, "storage rows"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->slot_start, layout->n_slices + 1, "slice starts"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->boundary, layout->n_slices, "boundary blocks"));
    order_elements(domain, slice, items);
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        layout->element_of_row[r] = r < domain->n_elements ? items[r].element : -1;
        if (r < domain->n_elements) layout->row_of_element[items[r].element] = r;
    }
    for (int32_t s = 0; s < layout->n_slices; ++s) {
        int32_t longest = 0;
        bool boundary = false;
        for (int32_t l = 0; l < slice; ++l) {
            const int32_t e = layout->element_of_row[s * slice + l];
            if (e < 0) continue;
            if (degree(domain, e) > longest) longest = degree(domain, e);
            boundary = boundary || has_free_face(domain, e);
        }
        layout->n_slots += longest;
        if (layout->n_slots * slice > INT32_MAX / 2) {
            status = BRC_FAIL(context, BRC_BAD_INPUT,
                              "the domain has %lld elements: more neighbour entries than 2^30, the most one device array "
                              "indexes; use fewer elements",
                              (long long)domain->n_elements);
            goto cleanup;
        }
        layout->slot_start[s + 1] = (int32_t)layout->n_slots;
        layout->boundary[s] = boundary ? layout->n_boundary++ : -1;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &layout->half_edge, layout->n_slots * slice, "stored half-edges"));
    for (int32_t s = 0; s < layout->n_slices; ++s)
        for (int32_t slot = layout->slot_start[s]; slot < layout->slot_start[s + 1]; ++slot)
            for (int32_t l = 0; l < slice; ++l) {
                const int32_t e = layout->element_of_row[s * slice + l];
                const int32_t k = slot - layout->slot_start[s];
                layout->half_edge[(int64_t)slot * slice + l] =
                    e >= 0 && k < degree(domain, e) ? (int32_t)(domain->row_start[e] + k) : -1;
            }
    *out = layout;
    layout = NULL;
cleanup:
    brc_memory_free(items);
    brc_layout_free(&layout);
    return status;
}

void brc_layout_free(brc_layout **layout)
{
    if (!layout || !*layout) return;
    brc_memory_free((*layout)->row_of_element);
    brc_memory_free((*layout)->element_of_row);
    brc_memory_free((*layout)->slot_start);
    brc_memory_free((*layout)->half_edge);
    brc_memory_free((*layout)->boundary);
    brc_memory_free(*layout);
    *layout = NULL;
}

int64_t brc_layout_estimate_entries(const brc_domain *domain, int32_t slice)
{
    /* sorting by degree in windows leaves about 3 % of padding; the last slice is padded whole */
    return (int64_t)(1.03 * (double)domain->n_half_edges) + 32 * (int64_t)slice;
}
