/* Kernels are plain text here: the C builds have no other record of what a function pointer takes, and a wrong list
 * handed to libffi would crash or, worse, compute. */
#include "kernel_signature.h"
#include <ctype.h>
#include <string.h>

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

const char *brc_kernel_text(const char *file)
{
    for (int f = 0; f < brc_kernel_file_count; ++f)
        if (strcmp(brc_kernel_files[f].name, file) == 0) return brc_kernel_files[f].text;
    return NULL;
}

/* Whether the word at `text` is this one. */
static bool begins(const char *text, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(text, word, length) == 0 && !is_word(text[length]);
}

/* One parameter, the text [from, to); false when it is none of the vocabulary's. */
static bool read_parameter(const char *from, const char *to, brc_kernel_signature *out)
{
    static const struct {
        const char *word;
        char letter;
        brc_use use;
    } words[] = {{"OWN", 'b', BRC_USE_OWN},         {"GATHER", 'b', BRC_USE_GATHER}, {"PUT", 'b', BRC_USE_PUT},
                 {"UPDATE", 'b', BRC_USE_UPDATE},   {"FLAG", 'b', BRC_USE_FLAG},     {"SPREAD", 'b', BRC_USE_SPREAD},
                 {"SCATTER", 'b', BRC_USE_SCATTER}, {"int", 'i', BRC_USE_VALUE},     {"state", 's', BRC_USE_VALUE},
                 {"coeff", 'c', BRC_USE_VALUE},     {"double", 'd', BRC_USE_VALUE}};
    while (from < to && isspace((unsigned char)*from))
        ++from;
    if (memchr(from, '*', (size_t)(to - from))) return false;
    if (begins(from, "const")) from += sizeof "const";
    for (size_t k = 0; k < sizeof words / sizeof words[0]; ++k) {
        if (!begins(from, words[k].word)) continue;
        while (to > from && !is_word(to[-1]))
            --to;
        while (to > from && is_word(to[-1]))
            --to;
        out->kinds[out->n] = words[k].letter;
        out->use[out->n] = words[k].use;
        out->name[out->n++] = to;
        return to > from;
    }
    return false;
}

/* The items of a pass in one of its two readings: the first, over all elements, or the second, over a list. */
static const char *pass_items(bool listed, const char **end)
{
    static const char define[] = "#define PASS_ITEMS ";
    const char *text = brc_kernel_text("kernels.h");
    text = text ? strstr(text, define) : NULL;
    if (text && listed) text = strstr(text + 1, define);
    if (!text) return NULL;
    text += sizeof define - 1;
    *end = text + strcspn(text, "\n");
    return text;
}

/* Where the list goes on: at its next comma, or at the bracket that closes it or the end of the text. */
static const char *end_of(const char *from, const char *end)
{
    int depth = 0;
    for (; from < end && (depth > 0 || (*from != ',' && *from != ')')); ++from)
        depth += *from == '(' ? 1 : *from == ')' ? -1 : 0;
    return from;
}

/* The list in [from, end), or up to the bracket that closes it. */
static bool read_list(const char *from, const char *end, bool listed, brc_kernel_signature *out)
{
    while (out->n < BRC_KERNEL_MOST_ARGS) {
        const char *const to = end_of(from, end);
        if (begins(from, "PASS_ITEMS")) {
            const char *items_end = NULL, *const items = pass_items(listed, &items_end);
            if (!items || !read_list(items, items_end, listed, out)) return false;
        } else if (!read_parameter(from, to, out)) {
            return false;
        }
        if (to >= end || *to == ')') return true;
        from = to + 1;
    }
    return false;
}

/* By the name of the first parameter; those of passes over all elements are groups. */
static brc_array_of items_of(const brc_kernel_signature *k, bool pass, bool listed)
{
    if (pass) return listed ? BRC_OF_NOTHING : BRC_OF_GROUPS;
    static const struct {
        const char *word;
        brc_array_of items;
    } words[] = {{"n_groups", BRC_OF_GROUPS},
                 {"n_rows", BRC_OF_ROWS},
                 {"n_numbers", BRC_OF_NUMBERS},
                 {"n_blocks", BRC_OF_BLOCKS},
                 {"n_crews", BRC_OF_BLOCKS}};
    for (size_t w = 0; w < sizeof words / sizeof *words; ++w)
        if (begins(k->name[0], words[w].word)) return words[w].items;
    return BRC_OF_NOTHING;
}

static int list_in(const brc_kernel_signature *k)
{
    for (int a = 1; a < k->n; ++a)
        if (k->use[a] == BRC_USE_OWN && begins(k->name[a], "list")) return a;
    return 0;
}

/* What is behind the bracket that opens the parameters, where the text at `word` is the kernel's name. */
static const char *list_of(const char *word, const char *name, bool *listed)
{
    const size_t length = strlen(name);
    *listed = false;
    if (strncmp(word, name, length) == 0 && word[length] == '(') return word + length + 1;
    if (strncmp(word, "PASS(", 5) != 0) return NULL;
    word += 5;
    const size_t base = strcspn(word, ")");
    if (strncmp(word, name, base) != 0 || strncmp(word + base, ")(", 2) != 0) return NULL;
    *listed = strcmp(name + base, "_listed") == 0;
    return *listed || name[base] == '\0' ? word + base + 2 : NULL;
}

void brc_kernel_signature_read(const char *name, brc_kernel_signature *out)
{
    static const char head[] = "KERNEL void";
    int found = 0;
    *out = (brc_kernel_signature){0};
    for (int f = 0; f < brc_kernel_file_count; ++f)
        for (const char *at = strstr(brc_kernel_files[f].text, head); at; at = strstr(at + 1, head)) {
            bool listed = false;
            const char *const word = at + sizeof head - 1 + strspn(at + sizeof head - 1, " \n"), *const list =
                                                                                                     list_of(word, name,
                                                                                                             &listed);
            if (!list) continue;
            if (++found > 1 || !read_list(list, list + strlen(list), listed, out)) {
                *out = (brc_kernel_signature){0};
                return;
            }
            out->list = list_in(out);
            out->crews = begins(out->name[0], "n_crews") || begins(out->name[0], "n_crew_parts");
            out->items = items_of(out, strncmp(word, "PASS(", 5) == 0, listed);
        }
}
