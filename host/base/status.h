/* Status codes, the context that keeps the sentence of a failure, and the two macros every fallible function uses.
 *
 * Every function that can fail returns brc_status; results leave through its last arguments. The sentence (what was
 * found, what was expected, the cure) is kept by the context and printed once, by main. Two grades: a *refused* call
 * leaves its object untouched; after a *broken* call the object may only be freed. A header says which. */
#ifndef BRC_BASE_STATUS_H
#define BRC_BASE_STATUS_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/* One list, expanded twice (codes here, texts in status.c): name, exit code of the program, text. */
#define BRC_STATUS_LIST(X)                                                                                             \
    X(BRC_OK, 0, "done")                                                                                               \
    X(BRC_PHYSICS_STOPPED, 1, "the physics was stopped (energy ledger or non-finite value)")                           \
    X(BRC_BOUND_MISSED, 1, "a row missed its bound")                                                                   \
    X(BRC_BAD_INPUT, 2, "the input is wrong")                                                                          \
    X(BRC_NO_MEMORY, 3, "out of memory")                                                                               \
    X(BRC_DEVICE_FAILED, 3, "device trouble")                                                                          \
    X(BRC_FILE_FAILED, 3, "file trouble")                                                                              \
    X(BRC_INTERRUPTED, 3, "interrupted by a signal")                                                                   \
    X(BRC_INTERNAL, 3, "internal error, please report")

typedef enum brc_status {
#define BRC_STATUS_ENUM(name, exit_code, text) name,
    BRC_STATUS_LIST(BRC_STATUS_ENUM)
#undef BRC_STATUS_ENUM
} brc_status;

/* Text of a code, static storage. */
const char *brc_status_text(brc_status status);
/* Exit code of the program for a code: 0 done, 1 physics stopped or bound missed, 2 wrong input, 3 device or file. */
int brc_status_exit_code(brc_status status);

/* Where messages go and how much of them. Opaque; one per program or per independent simulation; not thread safe. */
typedef struct brc_context brc_context;

/* Create a context that logs to stderr at level `info`. Returns NULL only when memory is exhausted. Caller frees. */
brc_context *brc_context_create(void);
/* Free; accepts NULL and a pointer to NULL; sets *context to NULL. */
void brc_context_free(brc_context **context);
/* Sentences of the last failure(s), '\n' between them, "" when there was none. Owned by the context, valid until the
 * next failure is recorded or brc_context_clear. */
const char *brc_context_message(const brc_context *context);
void brc_context_clear(brc_context *context);

/* Record one failure sentence and return `code`. Several may be recorded before returning (all errors in one pass).
 * where: "file:line function" of the program, shown only at log level debug. */
brc_status brc_context_fail(brc_context *context, brc_status code, const char *where, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Wrong input that is found from now on is at this place: failures of BRC_BAD_INPUT begin with it. NULL or "": at none.
 * Borrowed. */
void brc_context_set_place(brc_context *context, const char *place);
/* Room for a place, "file:line:col: error: ". */
#define BRC_PLACE_LENGTH 768

#define BRC_STRING_(x) #x
#define BRC_STRING(x) BRC_STRING_(x)
#define BRC_FAIL(context, code, ...) brc_context_fail((context), (code), __FILE__ ":" BRC_STRING(__LINE__), __VA_ARGS__)
/* Hand a failure upward. A function that holds resources uses BRC_TRY_OR with its one `cleanup:` label instead. */
#define BRC_TRY(call)                                                                                                  \
    do {                                                                                                               \
        const brc_status brc_try_status_ = (call);                                                                     \
        if (brc_try_status_ != BRC_OK) return brc_try_status_;                                                         \
    } while (0)
/* `status` is the function's own variable of type brc_status. */
#define BRC_TRY_OR(label, call)                                                                                        \
    do {                                                                                                               \
        status = (call);                                                                                               \
        if (status != BRC_OK) goto label;                                                                              \
    } while (0)

#endif
