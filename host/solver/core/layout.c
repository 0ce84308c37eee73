#include "layout.h"
#include "../../../preprocess/cells/order.h"
#include "../../base/memory.h"
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Elements are sorted by degree within windows: the smaller, the more padding, and the more of a group's neighbours are
 * its own elements. On a GPU a window is a group (host/device/gpu_layout.h). */
enum { WINDOW_SLICES = 32, WINDOW_OF_GPU = 256 };
/* Kernels index rows of three components with an int (members.cl). */
enum { MOST_ENTRIES = INT32_MAX / 3 };

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
    return domain->free_start && domain->free_start[element + 1] > domain->free_start[element];
}

/* Elements in storage order. */
static brc_status order_elements(brc_context *context, const brc_domain *domain, int32_t slice, sort_item *items)
{
    BRC_LOCAL(context, domain->n_elements, int32_t, order, "storage order");
    BRC_TRY(
        brc_order_hilbert(context, domain->position, domain->n_elements, domain->bounds, omp_get_max_threads(), order));
    /* inside a window: elements with free faces first, then by falling degree, then along the curve */
    const int64_t window = WINDOW_SLICES * slice < WINDOW_OF_GPU ? WINDOW_SLICES * slice : WINDOW_OF_GPU;
    for (int64_t begin = 0; begin < domain->n_elements; begin += window) {
        const int64_t end = begin + window < domain->n_elements ? begin + window : domain->n_elements;
        for (int64_t i = begin; i < end; ++i) {
            const int32_t e = order[i];
            items[i].element = e;
            items[i].key = (uint64_t)(has_free_face(domain, e) ? 0 : 1) << 63 |
                           (uint64_t)(0x7fffffff - degree(domain, e)) << 32 | (uint64_t)(i - begin);
        }
        qsort(items + begin, (size_t)(end - begin), sizeof *items, compare_items);
    }
    return BRC_OK;
}

brc_status brc_layout_create(brc_context *context, const brc_domain *domain, int32_t slice, brc_layout **out)
{
    *out = NULL;
    BRC_ENDS_WITH(brc_layout_free) brc_layout *layout = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &layout, 1, "storage layout"));
    layout->slice = slice;
    layout->n_slices = (int32_t)((domain->n_elements + slice - 1) / slice);
    layout->n_rows = layout->n_slices * slice;
    BRC_LOCAL(context, domain->n_elements, sort_item, items, "storage order");
    BRC_TRY(BRC_ALLOCATE(context, &layout->row_of_element, domain->n_elements, "storage rows"));
    BRC_TRY(BRC_ALLOCATE(context, &layout->element_of_row, layout->n_rows, "storage rows"));
    BRC_TRY(BRC_ALLOCATE(context, &layout->slot_start, layout->n_slices + 1, "slice starts"));
    BRC_TRY(BRC_ALLOCATE(context, &layout->boundary, layout->n_slices, "boundary blocks"));
    BRC_TRY(order_elements(context, domain, slice, items));
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
        if (layout->n_slots * slice > MOST_ENTRIES)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "the domain has %lld elements: more neighbour entries than %d, the most that kernels "
                            "index; use fewer elements",
                            (long long)domain->n_elements, MOST_ENTRIES);
        layout->slot_start[s + 1] = (int32_t)layout->n_slots;
        layout->boundary[s] = boundary ? layout->n_boundary++ : -1;
    }
    BRC_TRY(BRC_ALLOCATE(context, &layout->half_edge, layout->n_slots * slice, "stored half-edges"));
    for (int32_t s = 0; s < layout->n_slices; ++s)
        for (int32_t slot = layout->slot_start[s]; slot < layout->slot_start[s + 1]; ++slot)
            for (int32_t l = 0; l < slice; ++l) {
                const int32_t e = layout->element_of_row[s * slice + l];
                const int32_t k = slot - layout->slot_start[s];
                layout->half_edge[(int64_t)slot * slice + l] =
                    e >= 0 && k < degree(domain, e) ? (int32_t)(domain->row_start[e] + k) : -1;
            }
    BRC_TRY(brc_layout_ahead(context, domain, layout));
    *out = layout;
    layout = NULL;
    return BRC_OK;
}

void brc_layout_all_boundary(brc_layout *layout)
{
    layout->n_boundary = layout->n_slices;
    for (int32_t s = 0; s < layout->n_slices; ++s)
        layout->boundary[s] = s;
}

brc_status brc_layout_twins(brc_context *context, const brc_layout *layout, const brc_domain *domain, int32_t *twin)
{
    const int64_t n = layout->n_slots * layout->slice;
    BRC_LOCAL(context, domain->n_half_edges, int32_t, entry_of, "twins");
    for (int64_t k = 0; k < n; ++k)
        if (layout->half_edge[k] >= 0) entry_of[layout->half_edge[k]] = (int32_t)k;
    for (int64_t k = 0; k < n; ++k)
        twin[k] = layout->half_edge[k] >= 0 ? entry_of[domain->twin[layout->half_edge[k]]] : 0;
    return BRC_OK;
}

void brc_layout_free(brc_layout **layout)
{
    if (!layout || !*layout) return;
    brc_memory_free((*layout)->row_of_element);
    brc_memory_free((*layout)->element_of_row);
    brc_memory_free((*layout)->slot_start);
    brc_memory_free((*layout)->half_edge);
    brc_memory_free((*layout)->ahead);
    brc_memory_free((*layout)->boundary);
    brc_memory_free(*layout);
    *layout = NULL;
}
