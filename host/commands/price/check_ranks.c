#include "check_ranks.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../device/shares.h"
#include "../../solver/core/layout.h"
#include <math.h>

/* What the model of docs/ranks.md assumes of a message. */
static const double latency_s = 2e-6, bytes_a_second = 10e9;
/* What a step brings of a row of others, as `breccia bench ranks` counts it: exchanges, numbers of the state and
 * coefficients. Of elements that deform, that rotate, and of spheres. */
static const struct {
    int exchanges, state, coeff;
} sent[3] = {{4, 3, 27}, {3, 7, 6}, {2, 7, 0}};

/* ---- the cut ---- */

typedef struct cut {
    const brc_domain *domain;
    brc_layout *layout;
    int32_t *owner;         /* [slices] rank */
    int32_t *seen, *beside; /* [elements], [ranks]: the last rank that counted it, from 1 */
    int64_t slots, others;  /* of the rank with most */
    int32_t most_beside;
} cut;

/* As many slots for each; where there are rows enough a rank has whole blocks of sums (host/device/shares_rows.c). */
static void deal(cut *c, int32_t n_ranks)
{
    const brc_layout *l = c->layout;
    int32_t rank = 0;
    int64_t slots = 0;
    for (int32_t slice = 0; slice < l->n_slices; ++slice) {
        for (; rank < n_ranks - 1 && (int64_t)l->slot_start[slice + 1] * n_ranks > l->n_slots * (rank + 1); slots = 0)
            ++rank;
        c->owner[slice] = rank;
        slots += l->slot_start[slice + 1] - l->slot_start[slice];
        if (slots > c->slots) c->slots = slots;
    }
}

static int32_t owner_of(const cut *c, int32_t element)
{
    return c->owner[c->layout->row_of_element[element] / c->layout->slice];
}

/* What a rank gathers from others, row by row in storage order, so rank after rank. */
static void look(cut *c)
{
    const brc_domain *d = c->domain;
    int64_t others = 0;
    int32_t last = -1, n_beside = 0;
    for (int32_t row = 0; row < c->layout->n_rows; ++row) {
        const int32_t e = c->layout->element_of_row[row], mine = e < 0 ? last : owner_of(c, e);
        if (mine != last) others = n_beside = 0;
        last = mine;
        for (int64_t h = e < 0 ? 0 : d->row_start[e]; h < (e < 0 ? 0 : d->row_start[e + 1]); ++h) {
            const int32_t j = d->neighbour[h], owner = owner_of(c, j);
            if (owner == mine) continue;
            others += c->seen[j] != mine + 1;
            n_beside += c->beside[owner] != mine + 1;
            c->seen[j] = c->beside[owner] = mine + 1;
        }
        if (others > c->others) c->others = others;
        if (n_beside > c->most_beside) c->most_beside = n_beside;
    }
}

static brc_status make(brc_context *context, int32_t n_ranks, cut *c)
{
    enum { SLICE = 8 };
    BRC_TRY(brc_layout_create(context, c->domain, SLICE, &c->layout));
    BRC_TRY(BRC_ALLOCATE(context, &c->owner, c->layout->n_slices, "rows of ranks"));
    BRC_TRY(BRC_ALLOCATE(context, &c->seen, c->domain->n_elements, "rows of ranks"));
    BRC_TRY(BRC_ALLOCATE(context, &c->beside, n_ranks, "rows of ranks"));
    deal(c, n_ranks);
    look(c);
    return BRC_OK;
}

static void drop(cut *c)
{
    brc_layout_free(&c->layout);
    brc_memory_free(c->owner);
    brc_memory_free(c->seen);
    brc_memory_free(c->beside);
}

/* ---- of the whole ---- */

static brc_status add_bytes(void *self, void **block)
{
    if (*block) *(double *)self += (double)brc_memory_block_bytes(*block);
    return BRC_OK;
}

static brc_status look_at_part(brc_context *context, const brc_setup *setup, int32_t k, brc_model_kind model,
                               brc_precision precision, brc_check_ranks *ranks)
{
    const brc_model_traits *traits = brc_model_traits_of(model);
    const int of = traits->spheres ? 2 : traits->deforms ? 0 : 1;
    cut c = {.domain = setup->domain[k]};
    const brc_status status = make(context, ranks->n_ranks, &c);
    if (status == BRC_OK) {
        int64_t of_rows, once;
        brc_device_bytes_in_parts(setup->device[k], &of_rows, &once);
        const double own = (double)c.slots / (double)c.layout->n_slots,
                     with_others = own + (double)c.others / (double)c.layout->n_rows,
                     row = sent[of].state * brc_precision_state_bytes(precision) +
                           sent[of].coeff * brc_precision_coeff_bytes(precision);
        ranks->share = fmax(ranks->share, own);
        ranks->rows_of_others += c.others;
        ranks->beside = c.most_beside > ranks->beside ? c.most_beside : ranks->beside;
        ranks->less_bytes += (double)of_rows * fmax(0, 1 - with_others);
        ranks->once_bytes += (double)once;
        ranks->exchange_s += sent[of].exchanges * c.most_beside * latency_s + row * (double)c.others / bytes_a_second;
    }
    drop(&c);
    return status;
}

brc_status brc_check_ranks_look(brc_context *context, const brc_setup *setup, brc_precision precision,
                                brc_check_ranks *ranks)
{
    if (ranks->n_ranks == 1) return BRC_OK;
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_device_info *info = brc_device_get_info(setup->device[k]);
        if (info->kind == BRC_DEVICE_TARGET)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "device %s computes on one rank alone; on several take cpu or opencl devices",
                            info->selector);
        BRC_TRY(look_at_part(context, setup, k, setup->split->part[k].scene->model.kind, precision, ranks));
        if (setup->built[k]) BRC_TRY(brc_domain_each_block(setup->built[k], false, add_bytes, &ranks->domain_bytes));
    }
    ranks->once_bytes += ranks->domain_bytes;
    ranks->exchange_s += 2 * log2((double)ranks->n_ranks) * latency_s;
    return BRC_OK;
}

void brc_check_ranks_tell(FILE *file, const brc_scene *scene, const brc_prediction_told *told,
                          const brc_check_ranks *ranks)
{
    if (ranks->n_ranks == 1 || !told->known) return;
    const double messages = told->steps * ranks->exchange_s, steps = told->step_seconds * ranks->share + messages;
    const double saved = told->step_seconds - steps;
    fprintf(
        file,
        "on %d ranks, each with the threads of this check: %.3g s, of these %.3g s in steps, and of these %.3g s in "
        "messages of %.0f us and %.0f GB/s",
        (int)ranks->n_ranks, told->seconds - saved, steps, messages, 1e6 * latency_s, 1e-9 * bytes_a_second);
    if (scene->has_contact || scene->has_fracture)
        fprintf(file, "; %.3g s if what all ranks do alike (search for pairs, cohesion) were all of a step",
                told->seconds + messages);
    const double own = told->resident_bytes - ranks->once_bytes - ranks->less_bytes,
                 for_files = told->host_bytes - ranks->domain_bytes; /* made by the first alone */
    fprintf(file,
            "\non %d ranks, memory: %.4g MB a rank (the first, which writes; about %.4g MB another) and %.4g MB once a "
            "machine (domain, polyhedra of contact); the most of a rank: %.3g %% of the bonds, %lld rows of %d other "
            "ranks\n",
            (int)ranks->n_ranks, own / 1e6, fmax(0, own - for_files) / 1e6, ranks->once_bytes / 1e6, 100 * ranks->share,
            (long long)ranks->rows_of_others, (int)ranks->beside);
}
