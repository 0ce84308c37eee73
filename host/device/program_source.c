#include "program_source.h"
#include "kernel_signature.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <stdio.h>
#include <string.h>

enum { MOST_FILES = 96, MOST_FILE_BYTES = 1 << 20, HEAD_BYTES = 64 };

typedef struct paste {
    brc_context *context;
    const char *folder; /* NULL: embedded */
    char *text;
    size_t length, capacity;
    char names[MOST_FILES][64]; /* pasted or being pasted */
    int n_names;
    const brc_program_part *part; /* NULL: all kernels */
    char behind[16];              /* what PASS now puts behind names (kernels.h) */
} paste;

static brc_status append(paste *p, const char *text, size_t length)
{
    if (p->length + length + 1 > p->capacity) {
        p->capacity = 2 * (p->length + length + 1);
        BRC_TRY(brc_memory_resize(p->context, (void **)&p->text, (int64_t)p->capacity, 1, "kernel text"));
    }
    memcpy(p->text + p->length, text, length);
    p->length += length;
    p->text[p->length] = '\0';
    return BRC_OK;
}

/* The text of one file; *owned is what the caller frees (NULL for an embedded one). */
static brc_status load(paste *p, const char *name, const char **text, char **owned)
{
    *owned = NULL;
    if (!p->folder) {
        *text = brc_kernel_text(name);
        return *text ? BRC_OK
                     : BRC_FAIL(p->context, BRC_INTERNAL, "kernel text %s is not embedded in this program", name);
    }
    char *path = NULL;
    size_t bytes;
    BRC_TRY(brc_file_join(p->context, p->folder, name, &path));
    const brc_status status = brc_file_read_whole(p->context, path, MOST_FILE_BYTES, owned, &bytes);
    brc_memory_free(path);
    *text = *owned;
    return status;
}

/* The file that `#include "path"` at the start of a line names, seen from the folder of the file `by`; or nothing. */
static bool included_name(const char *line, const char *by, char name[64])
{
    static const char head[] = "#include \"", up[] = "../";
    if (strncmp(line, head, sizeof head - 1) != 0) return false;
    const char *from = line + sizeof head - 1;
    const char *const end = from + strcspn(from, "\"\n");
    const char *const slash = strrchr(by, '/');
    size_t inside = slash ? (size_t)(slash + 1 - by) : 0; /* of `by`, the folder that is left */
    for (; inside > 0 && strncmp(from, up, sizeof up - 1) == 0; from += sizeof up - 1)
        for (--inside; inside > 0 && by[inside - 1] != '/';)
            --inside;
    if (*end != '"' || end == from || inside + (size_t)(end - from) >= 64) return false;
    snprintf(name, 64, "%.*s%.*s", (int)inside, by, (int)(end - from), from);
    return true;
}

/* Loops (.cl) as often as they are included, for passes are read twice (kernels.h); all else once. */
static bool is_pasted(const paste *p, const char *name)
{
    const char *const ending = strrchr(name, '.');
    for (int k = 0; k < p->n_names; ++k)
        if (strcmp(p->names[k], name) == 0) return !ending || strcmp(ending, ".cl") != 0;
    return false;
}

/* What follows `head` in the line, else NULL. */
static const char *after(const char *line, const char *head)
{
    const size_t length = strlen(head);
    return strncmp(line, head, length) == 0 ? line + length : NULL;
}

static size_t word_length(const char *text)
{
    return strspn(text, "abcdefghijklmnopqrstuvwxyz_0123456789");
}

/* `#define PASS(name) name##_listed`. */
static void note_pass(paste *p, const char *line)
{
    const char *behind = after(line, "#define PASS(name) name");
    if (!behind) return;
    if (after(behind, "##")) behind += 2;
    snprintf(p->behind, sizeof p->behind, "%.*s", (int)word_length(behind), behind);
}

/* Whether a kernel begins in this line that the program is to do without. */
static bool is_left_out(const paste *p, const char *line)
{
    const char *name = p->part ? after(line, "KERNEL void") : NULL;
    char whole[96];
    if (!name) return false;
    name += strspn(name, " \n");
    const char *const passed = after(name, "PASS(");
    if (passed) name = passed;
    snprintf(whole, sizeof whole, "%.*s%s", (int)word_length(name), name, passed ? p->behind : "");
    for (int k = 0; k < p->part->n; ++k)
        if (strcmp(p->part->kernels[k], whole) == 0) return false;
    return true;
}

/* A line that is no include; *skips: it belongs to a kernel that is left out, up to the bracket in the first column.
 * Such lines are empty ones: the others keep their numbers. */
static brc_status paste_line(paste *p, const char *line, size_t length, bool *skips)
{
    note_pass(p, line);
    if (!*skips && !is_left_out(p, line)) return append(p, line, length);
    *skips = *line != '}';
    return append(p, "\n", 1);
}

static brc_status paste_file(paste *p, const char *name)
{
    brc_status status = BRC_OK;
    char *owned = NULL;
    const char *text = NULL;
    char mark[96];
    bool skips = false;
    if (is_pasted(p, name)) return BRC_OK;
    if (p->n_names == MOST_FILES)
        return BRC_FAIL(p->context, BRC_BAD_INPUT, "kernel text %s: more than %d files", name, (int)MOST_FILES);
    snprintf(p->names[p->n_names++], sizeof p->names[0], "%s", name);
    BRC_TRY_OR(cleanup, load(p, name, &text, &owned));
    snprintf(mark, sizeof mark, "#line 1 \"%s\"\n", name);
    BRC_TRY_OR(cleanup, append(p, mark, strlen(mark)));
    int line_number = 1;
    for (const char *line = text; *line; ++line_number) {
        const char *const newline = strchr(line, '\n');
        const size_t length = newline ? (size_t)(newline - line) + 1 : strlen(line);
        char other[64];
        if (included_name(line, name, other)) {
            BRC_TRY_OR(cleanup, paste_file(p, other));
            snprintf(mark, sizeof mark, "\n#line %d \"%s\"\n", line_number + 1, name);
            BRC_TRY_OR(cleanup, append(p, mark, strlen(mark)));
        } else {
            BRC_TRY_OR(cleanup, paste_line(p, line, length, &skips));
        }
        line += length;
    }
cleanup:
    brc_memory_free(owned);
    return status;
}

brc_status brc_program_source(brc_context *context, const char *folder, const brc_program_part *part, char **out)
{
    brc_status status = BRC_OK;
    paste p = {.context = context, .folder = folder, .part = part};
    char head[HEAD_BYTES + 1];
    *out = NULL;
    /* room for the hash, which is known at the end */
    snprintf(head, sizeof head, "%-*s\n", HEAD_BYTES - 1, "");
    BRC_TRY_OR(cleanup, append(&p, head, HEAD_BYTES));
    BRC_TRY_OR(cleanup, paste_file(&p, "kernels.h"));
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    for (size_t k = HEAD_BYTES; k < p.length; ++k)
        hash = (hash ^ (unsigned char)p.text[k]) * 1099511628211u;
    const int length = snprintf(head, sizeof head, "#define BRC_KERNELS_HASH 0x%016llxUL", (unsigned long long)hash);
    memcpy(p.text, head, (size_t)length);
    *out = p.text;
    p.text = NULL;
cleanup:
    brc_memory_free(p.text);
    return status;
}
