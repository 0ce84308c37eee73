/* What accuracy costs, run by run: a point is the error of one run against an exact answer and what the run took. The
 * points of a bench are kept in curves.csv, one line a run, so that a bench that was stopped goes on where it was, and
 * a planner can read them. */
#ifndef BRC_BENCH_ACCURACY_POINT_H
#define BRC_BENCH_ACCURACY_POINT_H

#include "rows.h"

/* Texts hold no comma, quotation mark or newline. Seconds are those of `clock`. NAN: does not apply, or could not be
 * had. */
typedef struct brc_accuracy_point {
    char problem[32];     /* "cube" */
    char run[144];        /* unique within the problem */
    char sweep[32];       /* which sweep of the problem it belongs to: "resolution", "precision" ... */
    char quantity[32];    /* what is held against the exact answer */
    char model[32];       /* "dlsm", "dlsm-simple" (no compaction), "dlsm-published", "cbm" */
    char preparation[48]; /* how elements were made: "lloyd-5", "spread-50", "packing" ... */
    char precision[8];
    char integrator[24]; /* "verlet", "tchamwa-wielgosz"; "" for solves */
    char variant[64];    /* whatever else was varied, "" for none */
    char cost_of[32];    /* what `seconds` is the time of */
    char clock[16];      /* "processor" (of the run's one thread) or "wall" */
    char note[160];      /* why there is no error; "" where there is one */
    double nu;           /* [-] */
    double coordination; /* of beams, as asked; NAN for cells [-] */
    double level;        /* shells of neighbours a stress is averaged over; NAN: none [-] */
    double dt_fraction;  /* of the critical step; of solves: that of the price [-] */
    double phi;          /* of Tchamwa-Wielgosz; NAN otherwise [-] */
    int64_t seed, threads, elements, bonds, steps, iterations;
    double spacing_over_length; /* mean spacing over the longest edge of the bounding box [-] */
    double reference, ours;     /* in the quantity's unit */
    double error;               /* |ours / reference - 1|, or |ours| where the exact answer is 0 [-] */
    double build_s, run_s;      /* seeds to device; the simulation itself [s] */
    double seconds;             /* the cost: what the diagrams show [s] */
    double wall_s;              /* of all of it [s] */
    /* The price of dynamics on these elements: seconds = 1e-9 ns_per_bond_update * bonds * steps_per_crossing *
     * crossings. */
    double ns_per_bond_update; /* [ns] */
    double bonds_per_element;  /* [-] */
    double steps_per_crossing; /* steps at dt_fraction while a pressure wave runs the longest edge of the bounding box
                                  [-] */
    double bytes_per_element;  /* on the device [byte] */
    double host_bytes;         /* held through breccia's own allocations when the run ended [byte] */
    double closure;            /* of the energy ledger [-] */
} brc_accuracy_point;

typedef struct brc_accuracy_points {
    brc_context *context; /* borrowed */
    int64_t n, capacity;
    brc_accuracy_point *items; /* owned */
} brc_accuracy_points;

/* Begins as {.context = context}; points are copied. */
brc_status brc_accuracy_points_add(brc_accuracy_points *points, const brc_accuracy_point *point);
void brc_accuracy_points_free(brc_accuracy_points *points);
/* A point with no number yet: NAN where the struct allows it, 0 elsewhere. */
brc_accuracy_point brc_accuracy_point_empty(void);
/* The point of this problem and run, NULL when there is none. */
const brc_accuracy_point *brc_accuracy_points_find(const brc_accuracy_points *points, const char *problem,
                                                   const char *run);

/* Write all points as CSV: a line of column names (those of the struct), then a line a point; numbers read back to the
 * same bits, NAN is empty. */
brc_status brc_accuracy_points_write(const brc_accuracy_points *points, const char *path);
/* Append the points of a file; columns may be in any order, unknown ones are passed over, missing ones stay empty.
 * BRC_BAD_INPUT with file and line. */
brc_status brc_accuracy_points_read(brc_accuracy_points *points, const char *path);
/* A row of figures for every point (keys: case, quantity, model, unit, reference, ours, error, seconds, ..., and the
 * columns). */
void brc_accuracy_points_rows(const brc_accuracy_points *points, brc_rows *rows);

#endif
