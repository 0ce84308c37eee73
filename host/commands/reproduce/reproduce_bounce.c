/* Sums over the first flight, sample by sample. */
#include "operators.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

enum { PUSH, HEIGHT, SPIN, N_NAMES, LEAST_SAMPLES = 16 };
static const char *const NAMES[N_NAMES] = {"push", "height", "spin"};

typedef struct bounce {
    brc_context *context;
    brc_watched watched;
    int32_t sensor[N_NAMES];
    double g;                    /* [m/s^2] */
    double first, release, last; /* [s] first push, last one of its touch, last one; NAN: none yet */
    bool away;                   /* the ground felt nothing at the last sample */
    int bounces;
    double n, t, y, tt, ty,
        spin;      /* sums over the first flight; t since its first sample [s], y = height + g t^2 / 2 [m] */
    double origin; /* of t [s] */
} bounce;

static brc_status create(brc_context *context, void **out)
{
    bounce *b = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &b, 1, "bounces of a run"));
    *b = (bounce){.context = context, .first = NAN, .release = NAN, .last = NAN};
    *out = b;
    return BRC_OK;
}

static void release(void *self)
{
    bounce *b = self;
    if (!b) return;
    brc_watched_close(&b->watched);
    brc_memory_free(b);
}

static brc_status prepare(bounce *b, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    bool found = scene->has_gravity && scene->gravity[2] < 0;
    for (int k = 0; k < N_NAMES; ++k) {
        b->sensor[k] = brc_watched_find(scene, NAMES[k]);
        found = found && b->sensor[k] < scene->n_sensors;
    }
    if (!found)
        return BRC_FAIL(b->context, BRC_BAD_INPUT,
                        "`with: bounce` expects gravity along -z and sensors named push, height and spin");
    b->g = -scene->gravity[2];
    return brc_watched_open(b->context, &b->watched, simulation);
}

static void add_to_flight(bounce *b, double time)
{
    if (b->n == 0) b->origin = time;
    const double t = time - b->origin, y = b->watched.value[b->sensor[HEIGHT]] + 0.5 * b->g * t * t;
    b->n += 1;
    b->t += t;
    b->y += y;
    b->tt += t * t;
    b->ty += t * y;
    b->spin += b->watched.value[b->sensor[SPIN]];
}

static void leave_flight(bounce *b)
{
    b->n = b->t = b->y = b->tt = b->ty = b->spin = 0;
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    bounce *b = self;
    const double time = brc_simulation_total_time(simulation);
    if (!b->watched.sensors) BRC_TRY(prepare(b, simulation));
    BRC_TRY(brc_watched_read(&b->watched, simulation));
    if (b->watched.value[b->sensor[PUSH]] != 0) {
        if (isnan(b->first)) b->first = time;
        if (b->bounces == 0 || (b->away && time - b->last > b->first)) b->bounces += 1;
        b->last = time;
        b->away = false;
        if (b->bounces == 1) {
            b->release = time;
            leave_flight(b); /* it had not left the ground yet */
        }
    } else {
        b->away = true;
        if (b->bounces == 1) add_to_flight(b, time);
    }
    return BRC_OK;
}

static brc_observer observer(void *self)
{
    return (brc_observer){.self = self, .sample = sample};
}

static brc_status values(const brc_campaign *campaign, const void *self, brc_outcome *outcome)
{
    const bounce *b = self;
    (void)campaign;
    const bool flew = b->n >= LEAST_SAMPLES;
    const double spread = b->tt - b->t * b->t / b->n, speed = (b->ty - b->t * b->y / b->n) / spread,
                 height = (b->y - speed * b->t) / b->n;
    brc_outcome_add(outcome, "first_contact", "s", b->first, NAN);
    brc_outcome_add(outcome, "release", "s", b->release, NAN);
    brc_outcome_add(outcome, "bounces", "-", b->bounces, NAN);
    brc_outcome_add(outcome, "apex", "m", flew ? height + speed * speed / (2 * b->g) : NAN, NAN);
    brc_outcome_add(outcome, "spin_after", "rad/s", flew ? b->spin / b->n : NAN, NAN);
    return BRC_OK;
}

/* The bounce operator, of a scene with gravity along -z (and across) and three sensors: push (force of the ground),
 * height (mean displacement along z), spin. first_contact and release [s]: first sample at which the ground pushes,
 * and the last of that touch; touches farther apart than first_contact are others: bounces [-] is their number. apex
 * [m]: of free flight after the first one, over the start, from the straight line through height + g t^2 / 2;
 * spin_after: mean of that flight [rad/s]. NAN where a run did not come so far. BRC_BAD_INPUT: no such scene. */
const brc_operator brc_operator_bounce = {
    .name = "bounce", .create = create, .observer = observer, .values = values, .release = release};
