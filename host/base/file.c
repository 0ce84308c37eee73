/* Files that survive a crash: written aside, fsynced, renamed, and the folder fsynced so that the name is safe too. */
#include "file.h"
#include "memory.h"
#include "ranks.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static brc_status copy_bytes(brc_context *context, const char *text, size_t length, char **out)
{
    BRC_TRY(brc_memory_allocate(context, (void **)out, (int64_t)length + 1, 1, "path"));
    memcpy(*out, text, length);
    return BRC_OK;
}

bool brc_file_writes(void)
{
    return brc_ranks_mine() == 0;
}

bool brc_file_exists(const char *path)
{
    struct stat information;
    return stat(path, &information) == 0;
}

brc_status brc_file_join(brc_context *context, const char *folder, const char *name, char **out)
{
    *out = NULL;
    const size_t n_folder = strlen(folder);
    const size_t n_name = strlen(name);
    BRC_TRY(brc_memory_allocate(context, (void **)out, (int64_t)(n_folder + n_name + 2), 1, "path"));
    memcpy(*out, folder, n_folder);
    (*out)[n_folder] = '/';
    memcpy(*out + n_folder + 1, name, n_name);
    return BRC_OK;
}

static brc_status make_one_folder(brc_context *context, const char *path)
{
    if (mkdir(path, 0777) == 0) return BRC_OK;
    const int reason = errno;
    struct stat information;
    if (stat(path, &information) == 0) {
        if (S_ISDIR(information.st_mode)) return BRC_OK;
        return BRC_FAIL(context, BRC_FILE_FAILED,
                        "%s: is a file where a folder is needed; remove it or name another folder", path);
    }
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot create the folder: %s", path, strerror(reason));
}

brc_status brc_file_make_folder(brc_context *context, const char *path)
{
    char *partial = NULL;
    brc_status status = BRC_OK;
    if (!brc_file_writes()) return BRC_OK;
    if (*path == '\0') return BRC_FAIL(context, BRC_FILE_FAILED, "cannot create a folder without a name");
    BRC_TRY(copy_bytes(context, path, strlen(path), &partial));
    for (char *slash = strchr(partial + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        BRC_TRY_OR(cleanup, make_one_folder(context, partial));
        *slash = '/';
    }
    BRC_TRY_OR(cleanup, make_one_folder(context, partial));
cleanup:
    brc_memory_free(partial);
    return status;
}

/* fsync of a path opened for reading only; what cannot be synced (a folder on some file systems) is not an error. */
static brc_status sync_path(brc_context *context, const char *path, bool folder)
{
    const int descriptor = open(path, folder ? O_RDONLY | O_DIRECTORY : O_RDONLY);
    if (descriptor < 0) {
        if (folder) return BRC_OK;
        return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot open: %s", path, strerror(errno));
    }
    brc_status status = BRC_OK;
    if (fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot reach the disk: %s", path, strerror(errno));
    close(descriptor);
    return status;
}

static brc_status sync_parent(brc_context *context, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) return sync_path(context, ".", true);
    if (slash == path) return sync_path(context, "/", true);
    char *parent = NULL;
    BRC_TRY(copy_bytes(context, path, (size_t)(slash - path), &parent));
    const brc_status status = sync_path(context, parent, true);
    brc_memory_free(parent);
    return status;
}

brc_status brc_file_aside(brc_context *context, const char *path, char **aside)
{
    static const char suffix[] = ".part";
    *aside = NULL;
    const size_t length = strlen(path);
    BRC_TRY(brc_memory_allocate(context, (void **)aside, (int64_t)(length + sizeof suffix), 1, "path"));
    memcpy(*aside, path, length);
    memcpy(*aside + length, suffix, sizeof suffix);
    return BRC_OK;
}

brc_status brc_file_commit(brc_context *context, const char *aside, const char *path)
{
    if (!brc_file_writes()) return BRC_OK;
    BRC_TRY(sync_path(context, aside, false));
    if (rename(aside, path) != 0)
        return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot rename to %s: %s", aside, path, strerror(errno));
    return sync_parent(context, path);
}

void brc_file_discard(const char *aside)
{
    if (aside && brc_file_writes()) unlink(aside);
}

static brc_status write_all(brc_context *context, int descriptor, const char *path, const char *data, size_t bytes)
{
    while (bytes > 0) {
        const ssize_t written = write(descriptor, data, bytes);
        if (written < 0) {
            if (errno == EINTR) continue;
            return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s%s", path, strerror(errno),
                            errno == ENOSPC ? "; free some space or name another folder" : "");
        }
        data += written;
        bytes -= (size_t)written;
    }
    return BRC_OK;
}

brc_status brc_file_write_whole(brc_context *context, const char *path, const void *data, size_t bytes)
{
    char *aside = NULL;
    if (!brc_file_writes()) return BRC_OK;
    BRC_TRY(brc_file_aside(context, path, &aside));
    brc_status status = BRC_OK;
    const int descriptor = open(aside, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot create: %s", aside, strerror(errno));
        goto cleanup;
    }
    status = write_all(context, descriptor, path, data, bytes);
    if (close(descriptor) != 0 && status == BRC_OK)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s", path, strerror(errno));
    if (status == BRC_OK) status = brc_file_commit(context, aside, path);
    if (status != BRC_OK) brc_file_discard(aside);
cleanup:
    brc_memory_free(aside);
    return status;
}

brc_status brc_file_check_place(brc_context *context, const char *path)
{
    struct stat information;
    char *folder = NULL;
    brc_status status = BRC_OK;
    if (!brc_file_writes()) return BRC_OK;
    if (stat(path, &information) == 0 && S_ISDIR(information.st_mode))
        return BRC_FAIL(context, BRC_FILE_FAILED, "%s: is a folder, name a file to write", path);
    BRC_TRY(BRC_ALLOCATE(context, &folder, (int64_t)strlen(path) + 2, "path"));
    strcpy(folder, path);
    char *const slash = strrchr(folder, '/');
    if (!slash)
        strcpy(folder, ".");
    else
        slash[slash == folder] = '\0'; /* "/" stays */
    if (access(folder, W_OK | X_OK) != 0)
        status = BRC_FAIL(context, BRC_FILE_FAILED,
                          "%s: cannot be written to %s: %s; name a folder that is there and may be written to", path,
                          folder, strerror(errno));
    brc_memory_free(folder);
    return status;
}

/* Read until the end or `limit` + 1 bytes: a pipe or a device tells its size only by being read. */
static brc_status read_all(brc_context *context, int descriptor, const char *path, size_t limit, char **out,
                           size_t *bytes)
{
    size_t capacity = 65536;
    size_t have = 0;
    struct stat information;
    if (fstat(descriptor, &information) == 0 && S_ISREG(information.st_mode)) capacity = (size_t)information.st_size;
    if (capacity > limit) capacity = limit;
    brc_status status = BRC_OK;
    char *buffer = NULL;
    BRC_TRY(brc_memory_allocate(context, (void **)&buffer, (int64_t)capacity + 2, 1, "contents of a file"));
    for (;;) {
        const ssize_t got = read(descriptor, buffer + have, capacity + 1 - have);
        if (got < 0) {
            if (errno == EINTR) continue;
            status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot read: %s", path, strerror(errno));
            goto cleanup;
        }
        if (got == 0) break;
        have += (size_t)got;
        if (have > limit) {
            status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: is larger than %zu bytes, the most that is read here", path,
                              limit);
            goto cleanup;
        }
        if (have > capacity) {
            capacity = capacity > limit / 2 ? limit : 2 * capacity;
            BRC_TRY_OR(cleanup,
                       brc_memory_resize(context, (void **)&buffer, (int64_t)capacity + 2, 1, "contents of a file"));
        }
    }
    buffer[have] = '\0';
    *out = buffer;
    *bytes = have;
    buffer = NULL;
cleanup:
    brc_memory_free(buffer);
    return status;
}

brc_status brc_file_read_whole(brc_context *context, const char *path, size_t limit, char **out, size_t *bytes)
{
    *out = NULL;
    *bytes = 0;
    const int descriptor = open(path, O_RDONLY);
    if (descriptor < 0) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot open: %s", path, strerror(errno));
    struct stat information;
    brc_status status = BRC_OK;
    if (fstat(descriptor, &information) == 0 && S_ISDIR(information.st_mode))
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: is a folder, a file is expected", path);
    else if (S_ISREG(information.st_mode) && (uintmax_t)information.st_size > limit)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: has %lld bytes, at most %zu are read here", path,
                          (long long)information.st_size, limit);
    else
        status = read_all(context, descriptor, path, limit, out, bytes);
    close(descriptor);
    return status;
}
