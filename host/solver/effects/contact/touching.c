/* What touches, counted from the results of the pairs. */
#include "touching.h"
#include "contact_internal.h"
#include <math.h>

brc_status brc_simulation_touching(brc_simulation *s, brc_touching *out)
{
    *out = (brc_touching){0};
    if (!s->contact)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "the scene has no `interactions: {contact: ...}`, so nothing touches");
    const brc_contact_list *l = &s->contact->now;
    const int64_t stride = BRC_CONTACT_RESULT + 2 * s->contact->width, n = l->n_pairs;
    const int bytes = brc_state_bytes(s);
    if (n == 0) return BRC_OK;
    BRC_TRY(brc_contact_bring_pairs(s));
    BRC_LOCAL(s->context, stride * n, double, result, "forces of pairs");
    BRC_LOCAL(s->context, BRC_CONTACT_HISTORY * n, double, history, "pairs");
    BRC_LOCAL(s->context, n, int32_t, touch, "pairs");
    BRC_TRY(brc_buffer_read(s->contact->touch, 0, touch, 4 * n));
    BRC_TRY(brc_download(s, s->contact->result, bytes, result, stride * n));
    BRC_TRY(brc_download(s, l->history, bytes, history, BRC_CONTACT_HISTORY * n));
    for (int64_t p = 0; p < n; ++p) {
        const double *one = result + stride * p;
        if (!touch[p]) continue;
        out->pairs += 1;
        out->sliding += history[BRC_CONTACT_HISTORY * p + 13] > 0;
        out->force += one[6];
        out->penetration = fmax(out->penetration, one[7]);
    }
    return BRC_OK;
}

int64_t brc_simulation_pair_bytes(const brc_simulation *s)
{
    if (!s->contact) return 0;
    const int64_t state = brc_state_bytes(s);
    const int64_t result = (BRC_CONTACT_RESULT + 2 * s->contact->width) * state,
                  lists = 2 * (2 * 4 + BRC_CONTACT_HISTORY * state); /* ends and history, now and before */
    const int64_t breaks = s->fracture ? 4 * 4 + result : 0; /* packed, its place; flags and list of changed pairs */
    return (lists + 4 + result + breaks) * 9 / 8;            /* arrays grow by an eighth at once */
}

brc_contact_report brc_simulation_contact_report(const brc_simulation *s)
{
    const brc_contact_state *c = s->contact;
    brc_buffer *const all[] = {c->now.ends, c->now.history, c->before.ends, c->before.history, c->touch, c->result,
                               c->packed,   c->packed_at,   c->flag,        c->flag_start,     c->todo};
    brc_contact_report out = {c->now.n_pairs, c->now.n_listed, c->searches, c->n_rigid, 0};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        out.pair_bytes += all[k] ? brc_buffer_bytes(all[k]) : 0;
    return out;
}

brc_status brc_contact_read_pairs(brc_simulation *s, int32_t *ends, double *history)
{
    const brc_contact_list *l = &s->contact->now;
    const int bytes = brc_state_bytes(s);
    if (l->n_pairs == 0) return BRC_OK;
    if (history) BRC_TRY(brc_contact_bring_pairs(s));
    if (ends) BRC_TRY(brc_buffer_read(l->ends, 0, ends, 8 * (int64_t)l->n_pairs));
    return history ? brc_download(s, l->history, bytes, history, BRC_CONTACT_HISTORY * (int64_t)l->n_pairs) : BRC_OK;
}

brc_status brc_contact_write_pairs(brc_simulation *s, const double *history)
{
    const brc_contact_list *l = &s->contact->now;
    return l->n_pairs == 0 ? BRC_OK
                           : brc_upload_state(s, l->history, history, BRC_CONTACT_HISTORY * (int64_t)l->n_pairs);
}

void brc_contact_always_whole(brc_simulation *s, bool whole)
{
    s->contact->always_whole = whole;
}

brc_status brc_contact_momenta(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->contact->momentum, out, 3);
}
