#include "../support.h"
#include "../../../host/solver/core/layout.h"
#include <stdlib.h>

static void every_element_and_half_edge_is_stored_once(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [7, 5, 6], spread: 100 %, seed: 4"});
    const int slices[] = {1, 8, 32};
    for (int k = 0; k < 3; ++k) {
        brc_layout *layout;
        assert_done(&c, brc_layout_create(c.context, c.domain, slices[k], &layout));
        int *seen = calloc((size_t)c.domain->n_half_edges, sizeof *seen);
        for (int64_t e = 0; e < c.domain->n_elements; ++e)
            assert_int_equal(layout->element_of_row[layout->row_of_element[e]], e);
        for (int32_t s = 0; s < layout->n_slices; ++s)
            for (int32_t slot = layout->slot_start[s]; slot < layout->slot_start[s + 1]; ++slot)
                for (int l = 0; l < slices[k]; ++l) {
                    const int32_t h = layout->half_edge[(int64_t)slot * slices[k] + l];
                    if (h < 0) continue;
                    const int32_t e = layout->element_of_row[s * slices[k] + l];
                    assert_true(h >= c.domain->row_start[e] && h < c.domain->row_start[e + 1]);
                    seen[h]++;
                }
        for (int64_t h = 0; h < c.domain->n_half_edges; ++h)
            assert_int_equal(seen[h], 1);
        /* sorted by degree in windows: a slice's longest row is near its shortest */
        if (slices[k] == 8) assert_true(layout->n_slots * 8 < 1.12 * (double)c.domain->n_half_edges + 8 * 32);
        free(seen);
        brc_layout_free(&layout);
    }
    close_case(&c);
}

static void elements_with_free_faces_have_a_boundary_block(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){0});
    brc_layout *layout;
    assert_done(&c, brc_layout_create(c.context, c.domain, 8, &layout));
    for (int64_t e = 0; e < c.domain->n_elements; ++e)
        if (c.domain->free_start[e + 1] > c.domain->free_start[e])
            assert_true(layout->boundary[layout->row_of_element[e] / 8] >= 0);
    brc_layout_free(&layout);
    close_case(&c);
}

/* Rows that a slice gathers and that neither it nor the slices before it gathered or went over lately, nor come next,
 * are asked for before: all but a few. */
static void rows_far_away_are_asked_for_before_they_are_gathered(void **state)
{
    (void)state;
    bench_case c;
    open_case(&c, (case_options){.fill = "cells: [24, 24, 24], spread: 50 %, seed: 4"});
    brc_layout *layout;
    assert_done(&c, brc_layout_create(c.context, c.domain, 8, &layout));
    const int n = layout->n_rows;
    int *gathered = malloc((size_t)n * sizeof *gathered), *asked = malloc((size_t)n * sizeof *asked);
    for (int r = 0; r < n; ++r)
        gathered[r] = asked[r] = -n;
    int wanted = 0, missed = 0;
    for (int now = 0; now < n; now += 8) {
        for (int l = 0; l < 8; ++l) {
            assert_in_range(layout->ahead[now + l], 0, n - 1);
            if (layout->ahead[now + l] != now + l) asked[layout->ahead[now + l]] = now;
        }
        for (int k = layout->slot_start[now / 8] * 8; k < layout->slot_start[now / 8 + 1] * 8; ++k) {
            if (layout->half_edge[k] < 0) continue;
            const int row = layout->row_of_element[c.domain->neighbour[layout->half_edge[k]]];
            if (now - gathered[row] > BRC_AHEAD_ROWS && abs(row - now) > BRC_AHEAD_ROWS) {
                wanted++;
                missed += now - asked[row] < BRC_AHEAD_LEAD || now - asked[row] > BRC_AHEAD_LEAD + BRC_AHEAD_ROWS;
            }
            gathered[row] = now;
        }
    }
    assert_true(wanted > 1000);
    assert_true(missed < wanted / 20);
    free(gathered), free(asked);
    brc_layout_free(&layout);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_element_and_half_edge_is_stored_once),
        cmocka_unit_test(elements_with_free_faces_have_a_boundary_block),
        cmocka_unit_test(rows_far_away_are_asked_for_before_they_are_gathered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
