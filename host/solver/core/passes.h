/* Passes: kernels whose arguments are found by the names that their parameters have in kernels/. A name is looked up
 * once, when the pass is made, in a chain of scopes from the innermost outwards: one thing of many (a load), a request
 * of an evaluation, the arrays and numbers of an effect, those of the run. A launch then reads what stands there at the
 * time. Names that change with every launch are declared as open, and each launch gives all of them. The first
 * parameter of a kernel is its number of work-items. Markers in the signature say whether an array is read or written,
 * and at the rows of which elements (portable.h): rings around breaks follow from them. */
#ifndef BRC_SOLVER_PASSES_H
#define BRC_SOLVER_PASSES_H

#include "fields.h"

/* A number, or an array, of a scope's owner that no table of fields has under this name. */
typedef enum brc_value_kind { BRC_VALUE_BUFFER, BRC_VALUE_INT, BRC_VALUE_BOOL, BRC_VALUE_REAL } brc_value_kind;
typedef struct brc_value_row {
    const char *name; /* as kernels call it */
    brc_value_kind kind;
    size_t at; /* of the brc_buffer *, int32_t (or enum), bool, double in the owner */
} brc_value_row;

/* What gives a scope's owner: itself, or each launch. */
typedef enum brc_scope_kind { BRC_SCOPE_FIXED, BRC_SCOPE_REQUEST, BRC_SCOPE_ITEM } brc_scope_kind;
enum { BRC_SCOPE_TABLES = 8 };
typedef struct brc_scope {
    const char *owner; /* in words */
    brc_scope_kind kind;
    const void *base;                                /* the owner; NULL where launches give it */
    const brc_field_table *tables[BRC_SCOPE_TABLES]; /* of the owner; the rest NULL */
    int n_values;
    const brc_value_row *values; /* [n_values] before the tables */
    const struct brc_scope *outer;
} brc_scope;
#define BRC_VALUES(rows) .n_values = (int)(sizeof(rows) / sizeof *(rows)), .values = (rows)

typedef struct brc_pass brc_pass;
/* kernel, scope: as long as the call; open: names apart by spaces, borrowed, or NULL. BRC_INTERNAL: a parameter that
 * nothing provides, or an open name that the kernel does not have; the sentence says kernel and name. list: the pass is
 * put at its head, and freed with it. */
brc_status brc_pass_make(brc_context *context, brc_device *device, const brc_scope *scope, const char *kernel,
                         const char *open, brc_pass **list, brc_pass **out);
void brc_passes_free(brc_pass **list);

/* Rings of elements around some whose own rows of the arrays `seeds` (names apart by spaces) have changed: up to which
 * ring each of these passes, run in this order, has other results. What is gathered goes one ring on: ring(out) =
 * max(ring(own in), ring(gathered in) + 1). -1: nothing that the pass reads has changed. */
brc_status brc_passes_rings(int n, const brc_pass *const *passes, const char *seeds, int *rings);

/* The least that a launch over all elements moves to and from memory [B]: each array once, by its marker, where it has
 * numbers of elements or half-edges; padding does not count. tables: where names of buffers that are no fields of its
 * scopes are looked up, ends with NULL; the first row that is wanted counts. unread: names (apart by spaces) that this
 * run does not read; NULL: none. */
double brc_pass_floor(const brc_pass *pass, const brc_wants *wants, const brc_field_table *const *tables,
                      const char *unread);

/* Open names of a pass in its reading over a list (rings.h; PASS in kernels/kernels.h). */
#define BRC_LISTED "n list"

/* What one launch gives for open names; ends with a name that is NULL. */
typedef struct brc_given {
    const char *name;
    brc_arg value;
} brc_given;
#define BRC_GIVEN(...)                                                                                                 \
    (const brc_given[])                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__,                                                                                                   \
        {                                                                                                              \
            .name = NULL                                                                                               \
        }                                                                                                              \
    }

/* Launch over n_items work-items. request, item: owners of scopes of these kinds; given: all open names (BRC_GIVEN);
 * each NULL where there is none. */
brc_status brc_pass_run_on(const brc_pass *pass, int64_t n_items, const void *request, const void *item,
                           const brc_given *given);
static inline brc_status brc_pass_run(const brc_pass *pass, int64_t n_items)
{
    return brc_pass_run_on(pass, n_items, NULL, NULL, NULL);
}
#define BRC_RUN(pass, n_items, ...) brc_pass_run_on((pass), (n_items), NULL, NULL, BRC_GIVEN(__VA_ARGS__))
#define BRC_RUN_ON(pass, n_items, request, item, ...)                                                                  \
    brc_pass_run_on((pass), (n_items), (request), (item), BRC_GIVEN(__VA_ARGS__))

/* A table of passes, made together. */
typedef struct brc_pass_wanted {
    brc_pass **slot;
    const char *kernel, *open; /* as for brc_pass_make */
    bool left_out;             /* not in this run: the slot stays NULL */
} brc_pass_wanted;
#define BRC_PASS(to, name, names)                                                                                      \
    {                                                                                                                  \
        .slot = (to), .kernel = (name), .open = (names)                                                                \
    }

#endif
