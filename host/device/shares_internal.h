/* Shares of ranks inside of a device: which rows a rank owns and exchanges (shares_rows.c), how rows come
 * (shares_bring.c), what the host writes and reads (shares_host.c), and what a launch asks for (shares.c). */
#ifndef BRC_DEVICE_SHARES_INTERNAL_H
#define BRC_DEVICE_SHARES_INTERNAL_H

#include "../base/ranks.h"
#include "device_internal.h"
#include "shares.h"

/* Bytes of an array whose pages are worth a call (device_cpu.c). */
enum { BRC_LARGE_ARRAY = 2 << 20 };

/* Where the rows of an array are right: of all ranks; own ones and those that own bonds reach; own ones. */
enum { BRC_EVERYWHERE, BRC_NEAR, BRC_MINE };

/* Rows that go from rank to rank, ascending, those of a rank beside another after one another. */
typedef struct brc_rows_beside {
    int64_t *start; /* [n_beside + 1] where those of a rank begin */
    int32_t *row;   /* [start[n_beside]] */
    int64_t *slots; /* [start[n_beside] + 1] slots of the rows before */
} brc_rows_beside;

/* Messages of one kind, made at the first use. */
typedef struct brc_messages {
    struct brc_messages *next;
    int64_t bytes; /* of a row, or of one of its slots */
    bool of_slots; /* as many as the rows have slots */
    bool back;     /* from those that read rows to those that compute them */
    bool flying;   /* begun, and not finished */
    char *send, *receive;
    brc_exchange *exchange;
} brc_messages;

/* An array whose rows of others are on their way. */
typedef struct brc_flight {
    brc_buffer *buffer;
    brc_messages *messages;
    char *image; /* as in shares_bring.c */
} brc_flight;

/* Slices [first, end) of this rank whose rows bonds join to own rows alone. */
typedef struct brc_inside {
    int32_t first, end;
} brc_inside;
enum { BRC_MOST_INSIDE = 16 };

struct brc_shares {
    brc_rows_of_device rows;
    int32_t *slot_start; /* [n_slices + 1] */
    int32_t n_ranks, mine;
    int32_t *first_slice; /* [n_ranks + 1] */
    uint8_t *slice_here;  /* [n_slices] it has own rows, or some that own bonds reach */
    int32_t n_beside;     /* ranks that rows are exchanged with */
    int32_t *beside;      /* [n_beside] */
    brc_rows_beside give, take;
    int32_t n_inside; /* the longest such ranges, in order */
    brc_inside inside[BRC_MOST_INSIDE];
    brc_messages *messages;
    int64_t n_launches, n_sets;
    bool ranks_meet;       /* some machine has several ranks, which see one another's memory */
    brc_rows_among *among; /* of the launches now; NULL: none */
};

/* Rows that launches keep to, of all ranks. */
struct brc_rows_among {
    int64_t number; /* of the sets so far */
    int32_t n;
    int32_t *row;             /* [n] ascending */
    char *mark;               /* [n_rows] 0 */
    int64_t *slots;           /* [n + 1] slots of the rows before */
    int64_t *n_of, *slots_of; /* [n_ranks] rows of each rank, and their slots */
    int64_t first;            /* place of the first of this rank */
    int64_t room;             /* bytes of the next */
    char *image;              /* what they bring, one after another */
};

/* ---- shares_rows.c ---- */
/* Things of a kind before a slice; of BRC_OF_NOTHING none. */
int64_t brc_share_before(const struct brc_shares *h, brc_array_of what, int32_t slice);
void brc_shares_free(brc_device *device);

/* ---- shares_bring.c: all ranks alike ---- */
/* The rows and slots that own bonds reach, of those that compute them. */
brc_status brc_share_bring_near(brc_buffer *buffer);
/* The same in two steps: what is computed between them reads own rows. */
brc_status brc_share_begin_near(brc_buffer *buffer, brc_flight *flight);
brc_status brc_share_finish_near(brc_flight *flight);
/* Rows of a set, to all ranks, unless they came since they were written; where the array is right stays as it was. Of
 * a set of most rows the whole array comes, which then is right everywhere. */
brc_status brc_share_bring_among(brc_buffer *buffer, brc_rows_among *among);
/* Marks that others have set at own rows. */
brc_status brc_share_settle(brc_buffer *buffer);
/* The whole array is on every rank. */
brc_status brc_share_gather(brc_buffer *buffer);
/* Before the first `bytes` of an array are copied to another: rows of arrays that lie alike stay where they are. */
brc_status brc_share_copy(brc_buffer *to, brc_buffer *from, int64_t bytes);

/* ---- shares_host.c ---- */
/* Large pages for own rows, when it is known how the array lies. */
void brc_share_pages(const brc_buffer *buffer);
/* Pages of rows of others, which are out of date; not every time. */
void brc_share_give_back(brc_buffer *buffer);
/* A whole array, or zeros, from the host: own parts alone. false: it is not of parts, or not whole. */
bool brc_share_write(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes);
/* A large array of no parts, which the ranks of a machine have once. */
bool brc_share_once(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes);
bool brc_share_zero(brc_buffer *buffer);
/* All ranks: a whole array to the host, which the device need not have, for_file to that of the first rank alone;
 * *done: it was. */
brc_status brc_share_read(brc_buffer *buffer, int64_t offset, void *data, int64_t bytes, bool for_file, bool *done);

/* ---- shares.c ---- */
/* Whether others may launch with items where this rank has none. */
bool brc_share_waits(const brc_device *device);
/* Launch what of the items this rank does, with what it reads there. */
brc_status brc_share_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args);

#endif
