/* Why a run was stopped, in a sentence (guard.c). */
#ifndef BRC_SOLVER_GUARD_CAUSE_H
#define BRC_SOLVER_GUARD_CAUSE_H

#include "../core/solver.h"

/* Element e: where it was, how many bonds it had, how well its neighbours span space, and the last of its bonds that
 * broke. */
void brc_guard_tell_element(brc_simulation *s, int64_t e, char *text, size_t size);
/* The likely cause: time step, law, contact, geometry of element e (-1: none known) or strain. off: the ledger's
 * closure where that alone is wrong [-], else 0. */
void brc_guard_tell_cause(const brc_simulation *s, int64_t e, double off, char *text, size_t size);

/* Words after those that are there. */
void brc_text_append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
