#include "cells_case.h"
#include <stdlib.h>
#include <string.h>

typedef struct outcome {
    int64_t n;
    brc_break *events;
} outcome;

static outcome outcome_of(case_options o)
{
    bench_case c;
    const brc_break *events;
    outcome out;
    open_case(&c, o);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 60));
    assert_done(&c, brc_simulation_breaks(c.simulation, &out.n, &events));
    out.events = calloc((size_t)out.n, sizeof *events);
    memcpy(out.events, events, (size_t)out.n * sizeof *events);
    close_case(&c);
    return out;
}

void cells_compare(case_options a, case_options b)
{
    outcome x = outcome_of(a), y = outcome_of(b);
    assert_true(x.n > 20);
    assert_int_equal(x.n, y.n);
    assert_memory_equal(x.events, y.events, (size_t)x.n * sizeof *x.events);
    free(x.events), free(y.events);
}
