#include "vtu_read.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

brc_status brc_vtu_read_open(brc_context *context, const char *path, brc_vtu_read *out)
{
    static const char mark[] = "<AppendedData encoding=\"raw\">\n_";
    const size_t length = strlen(path) + 1;
    *out = (brc_vtu_read){.context = context};
    BRC_TRY(BRC_ALLOCATE(context, &out->path, length, "path"));
    memcpy(out->path, path, length);
    const brc_status status = brc_file_read_whole(context, path, (size_t)1 << 32, &out->bytes, &out->n_bytes);
    const char *data = status == BRC_OK ? memmem(out->bytes, out->n_bytes, mark, sizeof mark - 1) : NULL;
    if (data) {
        out->data = (size_t)(data - out->bytes) + sizeof mark - 1;
        return BRC_OK;
    }
    brc_vtu_read_close(out);
    return status != BRC_OK ? status : BRC_FAIL(context, BRC_BAD_INPUT, "%s: no VTU file of breccia", path);
}

void brc_vtu_read_close(brc_vtu_read *vtu)
{
    brc_memory_free(vtu->path);
    brc_memory_free(vtu->bytes);
    *vtu = (brc_vtu_read){0};
}

brc_status brc_vtu_read_array(const brc_vtu_read *vtu, const char *name, int width, int64_t *n, const char **out)
{
    char wanted[80];
    uint64_t bytes = 0;
    snprintf(wanted, sizeof wanted, " Name=\"%s\" ", name);
    const char *head = memmem(vtu->bytes, vtu->data, wanted, strlen(wanted));
    const char *offset = head ? memmem(head, vtu->data - (size_t)(head - vtu->bytes), " offset=\"", 9) : NULL;
    const size_t begin = offset ? vtu->data + strtoull(offset + 9, NULL, 10) : vtu->n_bytes;
    const size_t rest = begin < vtu->n_bytes ? vtu->n_bytes - begin : 0;
    if (rest >= sizeof bytes) memcpy(&bytes, vtu->bytes + begin, sizeof bytes);
    if (rest < sizeof bytes || bytes > rest - sizeof bytes)
        return BRC_FAIL(vtu->context, BRC_BAD_INPUT, "%s: array %s is %s", vtu->path, name,
                        offset ? "cut off" : "missing");
    *out = vtu->bytes + begin + sizeof bytes;
    *n = (int64_t)bytes / width;
    return BRC_OK;
}
