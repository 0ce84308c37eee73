#include "append.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PIECE_BYTES = 1 << 16 };

struct brc_append {
    char *path;    /* owned, for sentences */
    int file;      /* -1: of a rank that does not write */
    int64_t bytes; /* of whole texts in the file */
};

/* Nothing is open yet. */
static brc_status make(brc_context *context, const char *path, brc_append **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "growing file"));
    (*out)->file = -1;
    BRC_TRY(BRC_ALLOCATE(context, &(*out)->path, (int64_t)strlen(path) + 1, "path"));
    strcpy((*out)->path, path);
    return BRC_OK;
}

brc_status brc_append_create(brc_context *context, const char *path, const char *head, brc_append **out)
{
    brc_append *a = NULL;
    brc_text text = {.context = context};
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, make(context, path, &a));
    if (brc_file_writes()) a->file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (a->file < 0 && brc_file_writes()) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot create: %s", path, strerror(errno));
        goto cleanup;
    }
    brc_text_add_bytes(&text, head, strlen(head));
    BRC_TRY_OR(cleanup, brc_append_add(context, a, &text));
    *out = a;
    a = NULL;
cleanup:
    brc_text_free(&text);
    brc_append_free(&a);
    return status;
}

brc_status brc_append_reopen(brc_context *context, const char *path, int64_t bytes, brc_append **out)
{
    brc_append *a = NULL;
    struct stat information = {0};
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, make(context, path, &a));
    if (brc_file_writes()) a->file = open(path, O_WRONLY | O_CLOEXEC);
    a->bytes = bytes;
    if (!brc_file_writes())
        status = BRC_OK;
    else if (a->file < 0 || fstat(a->file, &information) != 0)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot be opened to go on: %s", path, strerror(errno));
    else if (bytes < 0 || (int64_t)information.st_size < bytes)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: has %lld bytes, the run goes on behind %lld: it was changed",
                          path, (long long)information.st_size, (long long)bytes);
    else if (ftruncate(a->file, bytes) != 0 || lseek(a->file, bytes, SEEK_SET) != bytes)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s", path, strerror(errno));
    if (status != BRC_OK) goto cleanup;
    *out = a;
    a = NULL;
cleanup:
    brc_append_free(&a);
    return status;
}

int64_t brc_append_bytes(const brc_append *a)
{
    return a->bytes;
}

brc_status brc_append_add(brc_context *context, brc_append *a, const brc_text *text)
{
    BRC_TRY(text->status);
    for (size_t done = 0; a->file >= 0 && done < text->length;) {
        const ssize_t written = write(a->file, text->data + done, text->length - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int reason = errno;
            brc_append_cut(a, a->bytes);
            return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s%s", a->path, strerror(reason),
                            reason == ENOSPC ? "; free some space or name another folder" : "");
        }
        done += (size_t)written;
    }
    a->bytes += (int64_t)text->length;
    return BRC_OK;
}

brc_status brc_append_piece(brc_context *context, brc_append *a, brc_text *text)
{
    if (text->status == BRC_OK && text->length < PIECE_BYTES) return BRC_OK;
    BRC_TRY(brc_append_add(context, a, text));
    text->length = 0;
    return BRC_OK;
}

void brc_append_cut(brc_append *a, int64_t bytes)
{
    if (a->file >= 0 && ftruncate(a->file, bytes) == 0) (void)lseek(a->file, bytes, SEEK_SET);
    a->bytes = bytes;
}

brc_status brc_append_finish(brc_context *context, brc_append *a)
{
    if (a->file < 0 || fsync(a->file) == 0 || errno == EINVAL || errno == EROFS)
        return BRC_OK; /* some file systems cannot */
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot reach the disk: %s", a->path, strerror(errno));
}

void brc_append_free(brc_append **file)
{
    brc_append *const a = file ? *file : NULL;
    if (!a) return;
    if (a->file >= 0) close(a->file);
    brc_memory_free(a->path);
    brc_memory_free(a);
    *file = NULL;
}
