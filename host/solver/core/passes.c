#include "passes.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

enum { MOST_PARAMETERS = 64, NAME_BYTES = 40 };

/* Where an argument comes from. */
typedef enum source { FROM_FIXED, FROM_REQUEST, FROM_ITEM, FROM_EXTENT, FROM_LAUNCH } source;
typedef struct parameter {
    source from;
    brc_value_kind value;
    brc_arg_kind argument;
    brc_use use;
    const char *fixed;            /* FROM_FIXED: where it stands */
    size_t at;                    /* FROM_REQUEST, FROM_ITEM: in the owner */
    const brc_field_table *table; /* that it is a field of; NULL: it is none */
    char name[NAME_BYTES];
} parameter;

struct brc_pass {
    brc_pass *next;       /* of its list */
    brc_context *context; /* borrowed */
    brc_kernel *kernel;
    int n, n_open;
    parameter of[MOST_PARAMETERS];
};

/* ---- looking names up ---- */

static bool find_in(const brc_scope *scope, const char *name, parameter *out)
{
    for (int k = 0; k < scope->n_values; ++k)
        if (strcmp(scope->values[k].name, name) == 0) {
            out->value = scope->values[k].kind;
            out->at = scope->values[k].at;
            return true;
        }
    for (int t = 0; t < BRC_SCOPE_TABLES && scope->tables[t]; ++t)
        for (int k = 0; k < scope->tables[t]->n; ++k)
            if (strcmp(scope->tables[t]->fields[k].name, name) == 0) {
                out->value = BRC_VALUE_BUFFER;
                out->at = scope->tables[t]->fields[k].at;
                out->table = scope->tables[t];
                return true;
            }
    return false;
}

static bool find_name(const brc_scope *scope, parameter *out)
{
    for (; scope; scope = scope->outer) {
        if (!find_in(scope, out->name, out)) continue;
        out->from = scope->kind == BRC_SCOPE_FIXED     ? FROM_FIXED
                    : scope->kind == BRC_SCOPE_REQUEST ? FROM_REQUEST
                                                       : FROM_ITEM;
        if (out->from == FROM_FIXED) out->fixed = (const char *)scope->base + out->at;
        return true;
    }
    return false;
}

/* Whether `name` is one of the words. */
static bool has_word(const char *words, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = words; at && *at; at += strspn(at, " ")) {
        const size_t word = strcspn(at, " ");
        if (word == length && strncmp(at, name, length) == 0) return true;
        at += word;
    }
    return false;
}

static int count_words(const char *words)
{
    int n = 0;
    for (const char *at = words; at && *at; at += strspn(at, " ")) {
        at += strcspn(at, " ");
        ++n;
    }
    return n;
}

/* The owners that a name is looked for in, for sentences. */
static void list_owners(const brc_scope *scope, char *text, size_t room)
{
    text[0] = '\0';
    for (; scope; scope = scope->outer) {
        const size_t at = strlen(text);
        snprintf(text + at, room - at, "%s%s", at ? ", " : "", scope->owner);
    }
}

static bool fits(brc_arg_kind argument, brc_value_kind value)
{
    switch (value) {
    case BRC_VALUE_BUFFER: return argument == BRC_ARG_BUFFER;
    case BRC_VALUE_REAL: return argument != BRC_ARG_BUFFER && argument != BRC_ARG_INT;
    default: return argument == BRC_ARG_INT;
    }
}

static brc_status bind(brc_pass *pass, const brc_scope *scope, const char *open)
{
    const char *const kernel = brc_kernel_name(pass->kernel);
    for (int k = 0; k < pass->n; ++k) {
        parameter *p = &pass->of[k];
        p->argument = brc_kernel_parameter(pass->kernel, k, p->name, sizeof p->name);
        p->use = brc_kernel_use(pass->kernel, k);
        if (k == 0 && p->argument == BRC_ARG_INT) {
            p->from = FROM_EXTENT;
            continue;
        }
        if (has_word(open, p->name)) {
            p->from = FROM_LAUNCH;
            ++pass->n_open;
            continue;
        }
        if (!find_name(scope, p)) {
            char owners[256];
            list_owners(scope, owners, sizeof owners);
            return BRC_FAIL(pass->context, BRC_INTERNAL,
                            "kernel %s: nothing provides its parameter '%s' (asked: %s); name a field or a value so "
                            "(fields.h, passes.h), or let launches give it",
                            kernel, p->name, owners);
        }
        if (!fits(p->argument, p->value))
            return BRC_FAIL(pass->context, BRC_INTERNAL,
                            "kernel %s: its parameter '%s' is %s, and what has that name is %s", kernel, p->name,
                            p->argument == BRC_ARG_BUFFER ? "an array"
                            : p->argument == BRC_ARG_INT  ? "an int"
                                                          : "a number",
                            p->value == BRC_VALUE_BUFFER ? "an array"
                            : p->value == BRC_VALUE_REAL ? "a number"
                                                         : "an int");
    }
    if (pass->n_open != count_words(open))
        return BRC_FAIL(pass->context, BRC_INTERNAL,
                        "kernel %s has not all of the parameters '%s', which its launches are to give", kernel, open);
    return BRC_OK;
}

brc_status brc_pass_make(brc_context *context, brc_device *device, const brc_scope *scope, const char *kernel,
                         const char *open, brc_pass **list, brc_pass **out)
{
    *out = NULL;
    brc_pass *pass = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &pass, 1, kernel));
    pass->context = context;
    brc_status status = brc_kernel_find(device, kernel, &pass->kernel);
    if (status == BRC_OK) {
        pass->n = brc_kernel_parameters(pass->kernel);
        status = pass->n > 0 ? bind(pass, scope, open)
                             : BRC_FAIL(context, BRC_INTERNAL, "kernel %s: its parameters cannot be read from its text",
                                        kernel);
    }
    if (status != BRC_OK) {
        brc_memory_free(pass);
        return status;
    }
    pass->next = *list;
    *list = *out = pass;
    return BRC_OK;
}

void brc_passes_free(brc_pass **list)
{
    while (*list) {
        brc_pass *const pass = *list;
        *list = pass->next;
        brc_memory_free(pass);
    }
}

/* ---- rings ---- */

enum { MOST_CHANGED = 32 };
typedef struct changed_array {
    const char *name;
    int ring;
} changed_array;
typedef struct changed_arrays {
    int n;
    changed_array of[MOST_CHANGED];
} changed_arrays;

/* The ring up to which an array has changed; -1: nowhere. */
static int ring_of(const changed_arrays *changed, const char *seeds, const char *name)
{
    int ring = has_word(seeds, name) ? 0 : -1;
    for (int k = 0; k < changed->n; ++k)
        if (strcmp(changed->of[k].name, name) == 0 && changed->of[k].ring > ring) ring = changed->of[k].ring;
    return ring;
}

/* ring(out) = max(ring(own in), ring(gathered in) + 1). */
static int ring_of_pass(const brc_pass *pass, const changed_arrays *changed, const char *seeds)
{
    int out = -1;
    for (int k = 0; k < pass->n; ++k) {
        const brc_use use = pass->of[k].use;
        if (use == BRC_USE_VALUE || use == BRC_USE_PUT) continue;
        const int in = ring_of(changed, seeds, pass->of[k].name);
        const int reached = in < 0 || use == BRC_USE_OWN || use == BRC_USE_UPDATE ? in : in + 1;
        if (reached > out) out = reached;
    }
    return out;
}

brc_status brc_passes_rings(int n, const brc_pass *const *passes, const char *seeds, int *rings)
{
    changed_arrays changed = {0};
    for (int i = 0; i < n; ++i) {
        rings[i] = ring_of_pass(passes[i], &changed, seeds);
        for (int k = 0; k < passes[i]->n && rings[i] >= 0; ++k) {
            if (!brc_use_writes(passes[i]->of[k].use)) continue;
            if (changed.n == MOST_CHANGED)
                return BRC_FAIL(passes[i]->context, BRC_INTERNAL, "rings of passes: more than %d arrays change",
                                (int)MOST_CHANGED);
            changed.of[changed.n++] = (changed_array){passes[i]->of[k].name, rings[i]};
        }
    }
    return BRC_OK;
}

/* ---- launches ---- */

static void read_value(const parameter *p, const char *at, brc_arg *out)
{
    out->kind = p->argument;
    switch (p->value) {
    case BRC_VALUE_BUFFER: out->value.buffer = *(brc_buffer *const *)(const void *)at; break;
    case BRC_VALUE_INT: out->value.integer = *(const int32_t *)(const void *)at; break;
    case BRC_VALUE_BOOL: out->value.integer = *(const bool *)(const void *)at ? 1 : 0; break;
    case BRC_VALUE_REAL: out->value.real = *(const double *)(const void *)at; break;
    }
}

static brc_status refuse(const brc_pass *pass, const parameter *p, const char *what)
{
    return BRC_FAIL(pass->context, BRC_INTERNAL, "kernel %s: a launch without %s, for its parameter '%s'",
                    brc_kernel_name(pass->kernel), what, p->name);
}

brc_status brc_pass_run_on(const brc_pass *pass, int64_t n_items, const void *request, const void *item,
                           const brc_given *given)
{
    brc_arg args[MOST_PARAMETERS];
    for (int k = 0; k < pass->n; ++k) {
        const parameter *p = &pass->of[k];
        switch (p->from) {
        case FROM_FIXED: read_value(p, p->fixed, &args[k]); break;
        case FROM_REQUEST:
            if (!request) return refuse(pass, p, "a request");
            read_value(p, (const char *)request + p->at, &args[k]);
            break;
        case FROM_ITEM:
            if (!item) return refuse(pass, p, "its item");
            read_value(p, (const char *)item + p->at, &args[k]);
            break;
        case FROM_EXTENT: args[k] = BRC_INT(n_items); break;
        case FROM_LAUNCH: {
            const brc_given *found = given;
            while (found && found->name && strcmp(found->name, p->name) != 0)
                ++found;
            if (!found || !found->name) return refuse(pass, p, "a value");
            args[k] = found->value;
            break;
        }
        }
    }
    int n_given = 0;
    while (given && given[n_given].name)
        ++n_given;
    if (n_given != pass->n_open)
        return BRC_FAIL(pass->context, BRC_INTERNAL, "kernel %s: a launch gives %d values, %d are open",
                        brc_kernel_name(pass->kernel), n_given, pass->n_open);
    return brc_kernel_launch(pass->kernel, n_items, pass->n, args);
}

/* ---- the floor ---- */

static const brc_field_row *wanted_row(const brc_field_table *table, const char *name, const brc_wants *wants)
{
    if (table->wanted && !table->wanted(wants)) return NULL;
    for (int k = 0; k < table->n; ++k) {
        const brc_field_row *row = table->fields + k;
        if (strcmp(row->name, name) == 0 && (!row->wanted || row->wanted(wants))) return row;
    }
    return NULL;
}

/* The row of an array: of its own table, or, where a value of a scope stands in for it, of the first that has one. */
static const brc_field_row *row_of(const parameter *p, const brc_field_table *const *tables, const brc_wants *wants)
{
    const brc_field_row *row = NULL;
    if (p->table) return wanted_row(p->table, p->name, wants);
    for (; *tables && !row; ++tables)
        row = wanted_row(*tables, p->name, wants);
    return row;
}

static double bytes_of(const brc_field_row *row, const brc_wants *wants)
{
    const bool entries = row->count == brc_each_entry || row->count == brc_each_record;
    const double n = entries                                                      ? (double)wants->domain->n_half_edges
                     : row->count == brc_each_row || row->count == brc_each_block ? (double)wants->domain->n_elements
                                                                                  : 0;
    const int32_t each = row->number == BRC_FIELD_STATE   ? wants->state_bytes
                         : row->number == BRC_FIELD_COEFF ? wants->coeff_bytes
                                                          : (int32_t)sizeof(int32_t);
    return n * row->width * each;
}

double brc_pass_floor(const brc_pass *pass, const brc_wants *wants, const brc_field_table *const *tables,
                      const char *unread)
{
    double sum = 0;
    for (int k = 0; k < pass->n; ++k) {
        const parameter *p = pass->of + k;
        const brc_field_row *row =
            p->use == BRC_USE_VALUE || has_word(unread, p->name) ? NULL : row_of(p, tables, wants);
        if (row) sum += (p->use == BRC_USE_UPDATE ? 2 : 1) * bytes_of(row, wants);
    }
    return sum;
}
