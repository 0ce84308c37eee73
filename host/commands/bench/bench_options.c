/* Options of the benches as lists and numbers. */
#include "bench_options.h"
#include "../../../bench/throughput.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

brc_status brc_bench_take_list(brc_context *context, const brc_arguments *arguments, const char *name,
                               const char *otherwise, char *copy, size_t size, const char **pieces, int *n)
{
    const char *text = brc_arguments_value(arguments, name);
    if (!text) text = otherwise;
    if (strlen(text) >= size) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench: --%s is too long", name);
    strcpy(copy, text);
    *n = brc_text_split(copy, BRC_THROUGHPUT_LIST, pieces);
    if (*n < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench: --%s '%s' is not a list such as %s (at most %d pieces)",
                        name, text, otherwise, BRC_THROUGHPUT_LIST);
    return BRC_OK;
}

brc_status brc_bench_take_number(brc_context *context, const char *name, const char *text, double low, double high,
                                 double *out)
{
    char *end;
    errno = 0;
    *out = strtod(text, &end);
    if (end == text || *end || errno == ERANGE || !(*out >= low && *out <= high))
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench: --%s holds '%s', expected a number from %g to %g", name,
                        text, low, high);
    return BRC_OK;
}

brc_status brc_bench_take_models(brc_context *context, int n, const char *const *names, brc_model_kind *out)
{
    for (int k = 0; k < n; ++k) {
        int kind = 0;
        while (kind < BRC_N_MODELS && strcmp(names[k], brc_model_name((brc_model_kind)kind)) != 0)
            ++kind;
        if (kind == BRC_N_MODELS)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "breccia bench: no model '%s', expected dlsm, dlsm-published or cbm", names[k]);
        out[k] = (brc_model_kind)kind;
    }
    return BRC_OK;
}

brc_status brc_bench_refuse_options(brc_context *context, const brc_arguments *arguments, const char *kind, int n,
                                    const char *const *names)
{
    for (int k = 0; k < n; ++k)
        if (brc_arguments_value(arguments, names[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench %s: --%s is not for this bench", kind, names[k]);
    return BRC_OK;
}
