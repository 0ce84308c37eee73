/* How far surfaces moved since the list of pairs was made (contact_motion.cl), and for how many steps it holds. */
#include "contact_internal.h"
#include "../strikers/striker_contact.h"
#include <math.h>

enum { FEWEST_QUIET = 8, MOST_TRUSTED = 8 };

/* Largest of each column of rows [from, to). */
static void largest_of(const double *value, int64_t from, int64_t to, double out[BRC_CONTACT_MOVED])
{
    for (int64_t b = from; b < to; ++b)
        for (int k = 0; k < BRC_CONTACT_MOVED; ++k)
            out[k] = b == from ? value[BRC_CONTACT_MOVED * b + k] : fmax(out[k], value[BRC_CONTACT_MOVED * b + k]);
}

static brc_status enqueue_survey(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int32_t n = s->layout->n_rows, n_blocks = brc_blocks(n, BRC_CONTACT_BLOCK);
    BRC_TRY(BRC_RUN(c->pass.drift, n_blocks, {"n", BRC_INT(n)}));
    BRC_TRY(BRC_RUN(c->pass.drift_mean, 1, {"n_blocks", BRC_INT(n_blocks)}));
    BRC_TRY(BRC_RUN(c->pass.moved, n_blocks, {"n", BRC_INT(n)}));
    return c->n_pieces ? BRC_RUN(c->pass.pieces_moved, c->n_pieces, {"first", BRC_INT(n_blocks)}) : BRC_OK;
}

/* Largest of the columns that a survey left in `moved`, of n_pieces pieces too. */
brc_status brc_contact_read_survey(brc_simulation *s, brc_buffer *moved, int32_t n_pieces, brc_contact_survey *out)
{
    const int64_t n_blocks = brc_blocks(s->layout->n_rows, BRC_CONTACT_BLOCK), rows = n_blocks + n_pieces;
    *out = (brc_contact_survey){.element = {0}};
    BRC_LOCAL(s->context, BRC_CONTACT_MOVED * rows, double, value, "moves since the last search");
    const brc_status status = brc_download(s, moved, brc_state_bytes(s), value, BRC_CONTACT_MOVED * rows);
    largest_of(value, 0, n_blocks, out->element);
    largest_of(value, n_blocks, rows, out->piece);
    return status;
}

brc_status brc_contact_take_survey(brc_simulation *s, brc_contact_survey *out)
{
    BRC_TRY(enqueue_survey(s));
    return brc_contact_read_survey(s, s->contact->moved, s->contact->n_pieces, out);
}

/* What a survey says: steps until the next probe; due, past as brc_contact_probe. pushed: acceleration of strikers. */
static int64_t judge(const brc_simulation *s, const brc_contact_survey *now, double pushed, bool *due, bool *past)
{
    const brc_contact_state *c = s->contact;
    const double dt = brc_simulation_time_step(s).value;
    /* Twice the present speed and acceleration must not use up what is left before the next probe: of half the skin,
     * and of the way to the next piece of a striker. */
    const double left = 0.5 * c->skin - now->element[0], v = 2 * now->element[1] * dt,
                 a = 2 * sqrt(now->element[2]) * dt * dt;
    const double clear = -now->element[3] - now->piece[0], v_piece = 2 * (now->element[4] + sqrt(now->piece[1])) * dt,
                 a_piece = 2 * (sqrt(now->element[5]) + pushed) * dt * dt;
    int64_t steps = 0;
    while (steps < BRC_CONTACT_QUIET) {
        const double t = (double)(steps + 1);
        if (!(t * (v + t * a) < left) || !(t * (v_piece + t * a_piece) < clear)) break;
        ++steps;
    }
    *past = !(left > 0) || !(clear > 0);
    *due = *past || (steps < FEWEST_QUIET && (left < 0.25 * c->skin || clear < 0.5 * c->skin));
    return steps;
}

static double pushed_now(const brc_simulation *s)
{
    return s->contact->n_pieces ? brc_strikers_pushed(s) : 0;
}

/* Looks that are put off from now on: one more each time that nothing was found, none where something was. */
static void trust(brc_contact_state *c, bool calm)
{
    const int more = c->n_trusted > 0 ? 2 * c->n_trusted : 1;
    c->n_trusted = !calm ? 0 : more < MOST_TRUSTED ? more : MOST_TRUSTED;
}

brc_status brc_contact_probe(brc_simulation *s, bool *due, bool *past)
{
    brc_contact_state *c = s->contact;
    brc_contact_survey now;
    BRC_TRY(brc_contact_take_survey(s, &now));
    c->quiet = judge(s, &now, pushed_now(s), due, past);
    trust(c, c->quiet == BRC_CONTACT_QUIET && !*due);
    return BRC_OK;
}

/* ---- probes that are put off (../fracture/ahead.h) ---- */

int64_t brc_contact_quiet_steps(const brc_simulation *s)
{
    const brc_contact_state *c = s->contact;
    if (!c) return INT64_MAX;
    return c->due ? 0 : c->quiet + (int64_t)c->n_trusted * BRC_CONTACT_QUIET;
}

void brc_contact_begin_stretch(brc_simulation *s)
{
    s->contact->n_probes = 0;
    s->contact->most_pushed = 0;
}

/* What would allow BRC_CONTACT_QUIET steps with the largest of every column allows as many with each. */
brc_status brc_contact_put_off_probe(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const int64_t bytes = brc_buffer_bytes(c->moved);
    BRC_TRY(enqueue_survey(s));
    if (!c->most_moved) BRC_TRY(brc_buffer_create(s->device, &c->most_moved, bytes, "moves of the looks so far"));
    if (c->n_probes++ == 0)
        BRC_TRY(brc_buffer_copy(c->most_moved, c->moved, bytes));
    else
        BRC_TRY(brc_pass_run(c->pass.most, bytes / brc_state_bytes(s)));
    c->most_pushed = fmax(c->most_pushed, pushed_now(s));
    c->quiet = BRC_CONTACT_QUIET;
    return BRC_OK;
}

brc_status brc_contact_end_stretch(brc_simulation *s, bool *stands)
{
    brc_contact_state *c = s->contact;
    brc_contact_survey most;
    bool due, past;
    *stands = true;
    if (c->n_probes == 0) return BRC_OK;
    BRC_TRY(brc_contact_read_survey(s, c->most_moved, c->n_pieces, &most));
    *stands = judge(s, &most, c->most_pushed, &due, &past) == BRC_CONTACT_QUIET && !due;
    trust(c, *stands);
    return BRC_OK;
}
