/* What a step moves and computes on a card, by its passes, and the price of that where the card is not at hand:
 * part of `breccia bench sectors`. */
#ifndef BRC_BENCH_CARD_H
#define BRC_BENCH_CARD_H

#include "../host/device/device.h"

/* Records that passes gather from neighbours. */
typedef enum brc_card_record {
    BRC_CARD_PLACE,       /* u [3], state */
    BRC_CARD_ORIENTATION, /* [4], state */
    BRC_CARD_MATRIX,      /* H, P or B [9], coeff */
    BRC_CARD_STRAIN,      /* [6], coeff */
    BRC_CARD_RECORDS
} brc_card_record;

typedef struct brc_card_pass {
    const char *model; /* as in scenes */
    const char *name;
    int row_ints, row_coeffs;     /* a half-edge: int, coeff */
    int again_ints, again_coeffs; /* of these, read by a second loop */
    int states, coeffs;           /* an element: read at its own row, and written */
    int gathers[BRC_CARD_RECORDS];
    int operations; /* of floating point a half-edge (SASS of sm_90, multiply-add one) */
} brc_card_pass;
extern const brc_card_pass brc_card_passes[];
extern const int brc_card_n_passes;

typedef struct brc_card {
    const char *name;
    double launch_s;         /* of a kernel in a long queue */
    double copy;             /* [byte/s] of its memory by a copy */
    double memory, cache;    /* [byte/s] of its memory by passes, and of its L2 */
    double doubles, singles; /* [operation/s] */
} brc_card;
extern const brc_card brc_card_h200;

/* Bytes and operations of a half-edge in a pass. */
typedef struct brc_card_traffic {
    double least;      /* rows once, elements at their own rows, without padding */
    double memory;     /* the same with padding: what memory gives */
    double cache;      /* rows as often as they are read, and what gathers fetch: what L2 gives */
    double operations; /* in doubles or singles */
} brc_card_traffic;

/* Seconds of a pass over so many half-edges. */
double brc_card_seconds(const brc_card *card, const brc_card_traffic *traffic, brc_precision precision,
                        double half_edges);

#endif
