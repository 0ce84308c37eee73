/* Kernels are plain text here: the C builds have no other record of what a function pointer takes, and a wrong list
 * handed to libffi would crash or, worse, compute. */
#include "kernel_signature.h"
#include <ctype.h>
#include <string.h>

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Letter of one parameter, the text [from, to); 0 when it is none of the vocabulary's. */
static char letter_of(const char *from, const char *to)
{
    while (from < to && isspace((unsigned char)*from))
        ++from;
    static const struct {
        const char *word;
        char letter;
    } words[] = {{"OWN", 'b'}, {"GATHER", 'b'}, {"PUT", 'b'},   {"UPDATE", 'b'}, {"SCATTER", 'b'},
                 {"int", 'i'}, {"state", 's'},  {"coeff", 'c'}, {"double", 'd'}};
    if (memchr(from, '*', (size_t)(to - from))) return 'b';
    if (to - from > 6 && strncmp(from, "const ", 6) == 0) from += 6;
    for (size_t k = 0; k < sizeof words / sizeof words[0]; ++k) {
        const size_t length = strlen(words[k].word);
        if ((size_t)(to - from) > length && strncmp(from, words[k].word, length) == 0 && !is_word(from[length]))
            return words[k].letter;
    }
    return 0;
}

/* Where the parameter at `from` ends: at its comma, or at the bracket that closes the list. */
static const char *end_of(const char *from)
{
    int depth = 0;
    for (; *from && (depth > 0 || (*from != ',' && *from != ')')); ++from)
        depth += *from == '(' ? 1 : *from == ')' ? -1 : 0;
    return from;
}

/* The list that begins behind '(' at `text`; false when a parameter is not understood. */
static bool read_list(const char *text, char kinds[BRC_KERNEL_MOST_ARGS + 1])
{
    int n = 0;
    for (const char *from = text; n < BRC_KERNEL_MOST_ARGS;) {
        const char *const to = end_of(from);
        const char letter = letter_of(from, to);
        if (!letter) break;
        kinds[n++] = letter;
        if (*to == ')') {
            kinds[n] = '\0';
            return true;
        }
        if (*to != ',') break;
        from = to + 1;
    }
    kinds[0] = '\0';
    return false;
}

void brc_kernel_parameter_name(const char *parameters, int k, char *name, size_t bytes)
{
    const char *from = parameters;
    for (; k > 0; --k)
        from = end_of(from) + 1;
    const char *to = end_of(from);
    while (to > from && !is_word(to[-1]))
        --to;
    for (from = to; is_word(from[-1]);)
        --from;
    const size_t length = (size_t)(to - from) < bytes ? (size_t)(to - from) : bytes - 1;
    memcpy(name, from, length);
    name[length] = '\0';
}

const char *brc_kernel_signature(const char *name, char kinds[2][BRC_KERNEL_MOST_ARGS + 1])
{
    static const char head[] = "KERNEL void";
    const size_t length = strlen(name);
    const char *parameters = NULL;
    int n = 0;
    kinds[0][0] = kinds[1][0] = '\0';
    for (int f = 0; f < brc_kernel_file_count; ++f)
        for (const char *at = strstr(brc_kernel_files[f].text, head); at; at = strstr(at + 1, head)) {
            const char *word = at + sizeof head - 1;
            word += strspn(word, " \n");
            if (strncmp(word, name, length) != 0 || word[length] != '(') continue;
            if (n == 2 || !read_list(word + length + 1, kinds[n])) { /* more than can be told apart: check nothing */
                kinds[0][0] = kinds[1][0] = '\0';
                return NULL;
            }
            if (n == 0) parameters = word + length + 1;
            ++n;
        }
    return parameters;
}
