#include "program_cache.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <dirent.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_PATH = 4096, MOST_BINARY = 1 << 28, MOST_PROGRAMS = 48, NAME_DIGITS = 16 };

/* In front of the key and the binary. */
typedef struct entry_head {
    char what[8];
    uint64_t key_bytes, binary_bytes, digest; /* of key and binary */
} entry_head;
static const char mark[8] = "brcocl1";

static uint64_t digest_of(uint64_t start, const void *data, size_t bytes)
{
    const unsigned char *const p = data;
    for (size_t k = 0; k < bytes; ++k)
        start = (start ^ p[k]) * 1099511628211u; /* FNV-1a */
    return start;
}

static uint64_t digest_of_key(const char *key)
{
    return digest_of(14695981039346656037u, key, strlen(key));
}

/* The folder, "" for none. */
static void find_folder(char folder[MOST_PATH])
{
    const char *const asked = getenv("BRECCIA_OPENCL_CACHE"), *const cache = getenv("XDG_CACHE_HOME"),
                      *const home = getenv("HOME");
    folder[0] = '\0';
    if (asked && strcmp(asked, "off") == 0) return;
    if (asked && asked[0])
        snprintf(folder, MOST_PATH, "%s", asked);
    else if (cache && cache[0] == '/')
        snprintf(folder, MOST_PATH, "%s/breccia/opencl",
                 cache); /* relative ones are to be ignored (XDG Base Directory) */
    else if (home && home[0])
        snprintf(folder, MOST_PATH, "%s/.cache/breccia/opencl", home);
}

static void entry_path(const char *folder, const char *key, char *path, size_t bytes)
{
    snprintf(path, bytes, "%s/%0*llx.bin", folder, NAME_DIGITS, (unsigned long long)digest_of_key(key));
}

/* Is a file of `bytes` bytes the entry of a key? *binary: where it begins. */
static bool is_entry(const char *data, size_t bytes, const char *key, const char **binary, size_t *binary_bytes)
{
    entry_head head;
    const size_t key_bytes = strlen(key);
    if (bytes < sizeof head) return false;
    memcpy(&head, data, sizeof head);
    const char *const rest = data + sizeof head;
    if (memcmp(head.what, mark, sizeof mark) != 0 || head.key_bytes != key_bytes || head.binary_bytes == 0 ||
        head.binary_bytes != bytes - sizeof head - key_bytes || bytes - sizeof head < key_bytes)
        return false;
    if (memcmp(rest, key, key_bytes) != 0 ||
        digest_of(digest_of_key(key), rest + key_bytes, head.binary_bytes) != head.digest)
        return false;
    *binary = rest + key_bytes;
    *binary_bytes = head.binary_bytes;
    return true;
}

unsigned char *brc_program_cache_find(brc_context *context, const char *key, size_t *bytes)
{
    char folder[MOST_PATH], path[MOST_PATH + 64], *data = NULL;
    const char *binary;
    size_t read;
    unsigned char *out = NULL;
    find_folder(folder);
    entry_path(folder, key, path, sizeof path);
    if (!folder[0] || access(path, R_OK) != 0) return NULL;
    brc_context *aside = brc_context_create(); /* its failures are nobody's */
    if (aside && brc_file_read_whole(aside, path, MOST_BINARY, &data, &read) == BRC_OK &&
        is_entry(data, read, key, &binary, bytes) &&
        brc_memory_allocate(aside, (void **)&out, (int64_t)*bytes, 1, "OpenCL program") == BRC_OK) {
        memcpy(out, binary, *bytes);
        (void)utimensat(AT_FDCWD, path, NULL, 0); /* used now */
    }
    if (aside && !out)
        brc_log(context, BRC_LOG_DEBUG,
                "%s is not a whole program of this text, options and driver: it is compiled again", path);
    brc_memory_free(data);
    brc_context_free(&aside);
    return out;
}

static bool is_entry_name(const char *name)
{
    return strspn(name, "0123456789abcdef") == NAME_DIGITS && strcmp(name + NAME_DIGITS, ".bin") == 0;
}

/* The oldest entry of a folder goes while there are too many. */
static void drop_oldest(const char *folder)
{
    for (int n = MOST_PROGRAMS + 1; n > MOST_PROGRAMS;) {
        char oldest[MOST_PATH + 300] = "", path[sizeof oldest];
        struct timespec when = {0};
        DIR *const list = opendir(folder);
        n = 0;
        for (struct dirent *d = list ? readdir(list) : NULL; d; d = readdir(list)) {
            struct stat about;
            if (!is_entry_name(d->d_name)) continue;
            snprintf(path, sizeof path, "%s/%s", folder, d->d_name);
            if (stat(path, &about) != 0) continue;
            const struct timespec t = about.st_mtim;
            if (n++ && (t.tv_sec > when.tv_sec || (t.tv_sec == when.tv_sec && t.tv_nsec >= when.tv_nsec))) continue;
            memcpy(oldest, path, sizeof oldest);
            when = t;
        }
        if (list) closedir(list);
        if (n > MOST_PROGRAMS && unlink(oldest) != 0) return;
    }
}

static brc_status write_entry(brc_context *context, const char *folder, const char *key, const unsigned char *binary,
                              size_t bytes)
{
    char path[MOST_PATH + 64], own[sizeof path + 32], *data = NULL;
    const size_t key_bytes = strlen(key);
    entry_head head = {
        .key_bytes = key_bytes, .binary_bytes = bytes, .digest = digest_of(digest_of_key(key), binary, bytes)};
    memcpy(head.what, mark, sizeof mark);
    BRC_TRY(brc_file_make_folder(context, folder));
    BRC_TRY(
        brc_memory_allocate(context, (void **)&data, (int64_t)(sizeof head + key_bytes + bytes), 1, "OpenCL program"));
    memcpy(data, &head, sizeof head);
    memcpy(data + sizeof head, key, key_bytes);
    memcpy(data + sizeof head + key_bytes, binary, bytes);
    entry_path(folder, key, path, sizeof path);
    snprintf(own, sizeof own, "%s.%ld", path, (long)getpid()); /* several programs may write at once */
    const brc_status status = brc_file_write_whole(context, own, data, sizeof head + key_bytes + bytes);
    brc_memory_free(data);
    BRC_TRY(status);
    if (rename(own, path) == 0) return BRC_OK;
    (void)unlink(own);
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s cannot be renamed to %s", own, path);
}

void brc_program_cache_keep(brc_context *context, const char *key, const unsigned char *binary, size_t bytes)
{
    char folder[MOST_PATH];
    find_folder(folder);
    if (!folder[0] || bytes == 0 || bytes > MOST_BINARY / 2) return;
    brc_context *aside = brc_context_create();
    if (!aside) return;
    if (write_entry(aside, folder, key, binary, bytes) == BRC_OK)
        drop_oldest(folder);
    else
        brc_log(context, BRC_LOG_DEBUG, "the OpenCL program is not kept: %s", brc_context_message(aside));
    brc_context_free(&aside);
}
