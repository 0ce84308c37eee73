/* Numbers of a page made small before they are packed: each as its difference to the one before it, the bytes of equal
 * weight together. web/data.js undoes it. */
#ifndef BRC_OUTPUT_REPORT_PACK_H
#define BRC_OUTPUT_REPORT_PACK_H

#include "../../base/status.h"
#include <stdint.h>

typedef struct brc_report_pack {
    brc_context *context; /* borrowed */
    unsigned char *data;  /* [n]; owned */
    int64_t n, room;
    brc_status status; /* the first failure; later additions do nothing */
} brc_report_pack;

/* A pack starts as {.context = context}. Numbers of 16 and of 32 bits; differences wrap around. */
void brc_report_pack_int16(brc_report_pack *pack, int64_t n, const int16_t *value);
void brc_report_pack_int32(brc_report_pack *pack, int64_t n, const int32_t *value);
/* Bytes as they are. */
void brc_report_pack_bytes(brc_report_pack *pack, int64_t n, const void *bytes);
/* value in low .. high to 0 .. 255, clamped; what is not finite gives 0. */
void brc_report_pack_levels(brc_report_pack *pack, int64_t n, const float *value, float low, float high);
void brc_report_pack_free(brc_report_pack *pack);

#endif
