#include "awake.h"
#include "core_internal.h"

void brc_awake_choose(brc_simulation *s, int32_t n, const int32_t *groups)
{
    s->core->awake.n = groups ? n : s->n_groups;
    s->core->awake.groups = groups;
}

bool brc_awake_only(brc_simulation *s, bool only)
{
    const bool before = s->core->awake.only;
    s->core->awake.only = only;
    return before;
}

brc_status brc_pass_run_awake(const brc_simulation *s, const brc_pass *pass, int64_t n_items, const void *request,
                              const brc_given *given)
{
    const brc_awake *awake = &s->core->awake;
    if (!awake->groups || !awake->only) return brc_pass_run_on(pass, n_items, request, NULL, given);
    brc_device_choose_groups(s->device, awake->n, awake->groups);
    const brc_status status = brc_pass_run_on(pass, n_items, request, NULL, given);
    brc_device_choose_groups(s->device, 0, NULL);
    return status;
}

brc_status brc_pass_look_awake(brc_simulation *s, const brc_pass *pass, const brc_given *given)
{
    const bool outer = brc_awake_only(s, true);
    const brc_status status = brc_pass_run_awake(s, pass, s->n_groups, NULL, given);
    brc_awake_only(s, outer);
    return status;
}

enum { MOST_PASSES = 8 };
brc_status brc_awake_passes(brc_simulation *s, int n, const brc_pass *const *passes)
{
    int ring[MOST_PASSES];
    if (n > MOST_PASSES)
        return BRC_FAIL(s->context, BRC_INTERNAL, "an evaluation of %d passes, %d at most", n, (int)MOST_PASSES);
    BRC_TRY(brc_passes_rings(n, passes, "displacement orientation", ring));
    s->core->awake.rings = ring[n - 1];
    return BRC_OK;
}

BRC_READ(int, brc_awake_rings, s->core->awake.rings)

void brc_awake_count(brc_simulation *s)
{
    s->core->awake.account.all += s->n_groups;
    if (s->core->awake.groups) s->core->awake.account.left_out += s->n_groups - s->core->awake.n;
}

BRC_READ(brc_rest_account, brc_simulation_at_rest, s->core->awake.account)
