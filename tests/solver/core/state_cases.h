/* Runs that are left at a pause and taken up by a new simulation, from a store in memory, for the tests of
 * state_store.h. */
#ifndef BRC_TESTS_SOLVER_STATE_CASES_H
#define BRC_TESTS_SOLVER_STATE_CASES_H

#include "../../../host/solver/run/lockstep.h"
#include "../effects/fracture/cells_case.h"
#include "../effects/fracture/fracture_case.h"

/* What was kept, by part and name. */
typedef struct memory_item {
    char name[96];
    int32_t part, columns;
    brc_stored_type type;
    int64_t rows;
    void *data;
} memory_item;
typedef struct memory_store {
    brc_state_store store; /* what the solver is given; its self is this */
    brc_context *context;
    int n;
    memory_item item[400];
} memory_store;
void memory_store_begin(memory_store *memory, brc_context *context);
void memory_store_free(memory_store *memory);
/* The item of this name, NULL: none. */
memory_item *memory_store_find(memory_store *memory, int32_t part, const char *name);
/* The same names with the same bytes; fails the test with the first name that differs. */
void assert_same_store(const memory_store *a, const memory_store *b);

/* One of these makes the simulations: cells (support.h) or beams (fracture_case.h). */
typedef struct state_case {
    const case_options *cells;
    const fracture_options *beams;
} state_case;
/* The run as a whole, and left at each of these pauses (counted from 1, 0 ends the list) and taken up by a new
 * simulation: at the last pause all numbers of the state are the same, byte by byte. Returns the number of pauses of
 * the whole run. */
int state_resumes(state_case c, const int *pauses);
/* A run of cells of so many steps is kept, one of its numbers forged: a new simulation refuses it with these words. */
typedef void (*state_forgery)(memory_item *item, const bench_case *of);
void state_is_refused_forged(case_options options, int64_t steps, const char *name, state_forgery forge,
                             const char *words);
/* The same without one of these numbers, which is named. */
void state_is_refused_without(case_options options, int64_t steps, int n, const char *const *needed);
/* Cells and beams, whole and breaking, dynamic and static, on a device ("cpu", "opencl:0") in a precision. */
void state_resumes_on(const char *device, brc_precision precision);
/* The same for cells and beams that soften and for dlsm-published; and for fragments that meet. */
void softening_resumes_on(const char *device, brc_precision precision);
void contact_resumes_on(const char *device, brc_precision precision);
/* All of it on one device in double, mixed and single; returns the exit code of the test, a skip where it is not
 * usable. */
int state_cases_run(const char *device);

#endif
