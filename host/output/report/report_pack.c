#include "report_pack.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

/* Where n more bytes go; NULL after a failure. */
static unsigned char *make_room(brc_report_pack *p, int64_t n)
{
    if (p->status != BRC_OK) return NULL;
    if (p->n + n > p->room || !p->data) {
        p->room = 2 * (p->n + n);
        p->status = brc_memory_resize(p->context, (void **)&p->data, p->room, 1, "numbers of a page");
        if (p->status != BRC_OK) return NULL;
    }
    p->n += n;
    return p->data + p->n - n;
}

void brc_report_pack_int16(brc_report_pack *p, int64_t n, const int16_t *value)
{
    unsigned char *out = make_room(p, 2 * n);
    int16_t before = 0;
    for (int64_t k = 0; out && k < n; before = value[k++]) {
        const int16_t step = (int16_t)(uint16_t)((unsigned)value[k] - (unsigned)before);
        const uint16_t small = (uint16_t)((unsigned)step << 1 ^ (unsigned)(step >> 15)); /* signs in the lowest bit */
        out[k] = (unsigned char)(small >> 8);
        out[n + k] = (unsigned char)small;
    }
}

void brc_report_pack_int32(brc_report_pack *p, int64_t n, const int32_t *value)
{
    unsigned char *out = make_room(p, 4 * n);
    int32_t before = 0;
    for (int64_t k = 0; out && k < n; before = value[k++]) {
        const int32_t step = (int32_t)((uint32_t)value[k] - (uint32_t)before);
        const uint32_t small = (uint32_t)step << 1 ^ (uint32_t)(step >> 31);
        for (int byte = 0; byte < 4; ++byte)
            out[byte * n + k] = (unsigned char)(small >> (24 - 8 * byte));
    }
}

void brc_report_pack_bytes(brc_report_pack *p, int64_t n, const void *bytes)
{
    unsigned char *out = make_room(p, n);
    if (out && n > 0) memcpy(out, bytes, (size_t)n);
}

void brc_report_pack_levels(brc_report_pack *p, int64_t n, const float *value, float low, float high)
{
    unsigned char *out = make_room(p, n);
    for (int64_t k = 0; out && k < n; ++k) {
        const float t = (value[k] - low) / (high - low);
        out[k] = isfinite(t) ? (unsigned char)lrintf(255 * fminf(fmaxf(t, 0), 1)) : 0;
    }
}

void brc_report_pack_free(brc_report_pack *p)
{
    brc_memory_free(p->data);
    p->data = NULL;
    p->n = p->room = 0;
}
