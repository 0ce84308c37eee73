/* Sums over the first flight, sample by sample. */
#include "reproduce_bounce.h"
#include "reproduce_watched.h"
#include "../../base/memory.h"
#include <math.h>

enum { PUSH, HEIGHT, SPIN, N_NAMES, LEAST_SAMPLES = 16 };
static const char *const NAMES[N_NAMES] = {"push", "height", "spin"};

struct brc_bounce {
    brc_context *context;
    brc_watched watched;
    int32_t sensor[N_NAMES];
    double g;                       /* [m/s^2] */
    double first, release, last;    /* [s] first push, last one of its touch, last one; NAN: none yet */
    bool away; /* the ground felt nothing at the last sample */
    int bounces;
    double n, t, y, tt, ty, spin;   /* sums over the first flight; t since its first sample [s], y = height + g t^2 / 2 [m] */
    double origin;                  /* of t [s] */
};

brc_status brc_bounce_create(brc_context *context, brc_bounce **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "bounces of a run"));
    **out = (brc_bounce){.context = context, .first = NAN, .release = NAN, .last = NAN};
    return BRC_OK;
}

void brc_bounce_free(brc_bounce **bounce)
{
    if (!bounce || !*bounce) return;
    brc_watched_close(&(*bounce)->watched);
    brc_memory_free(*bounce);
    *bounce = NULL;
}

static brc_status prepare(brc_bounce *b, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    bool found = scene->has_gravity && scene->gravity[2] < 0;
    for (int k = 0; k < N_NAMES; ++k) {
        b->sensor[k] = brc_watched_find(scene, NAMES[k]);
        found = found && b->sensor[k] < scene->n_sensors;
    }
    if (!found) return BRC_FAIL(b->context, BRC_BAD_INPUT, "`with: bounce` expects gravity along -z and sensors named push, height and spin");
    b->g = -scene->gravity[2];
    return brc_watched_open(b->context, &b->watched, simulation);
}

static void add_to_flight(brc_bounce *b, double time)
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

static void leave_flight(brc_bounce *b) { b->n = b->t = b->y = b->tt = b->ty = b->spin = 0; }

static brc_status sample(void *self, brc_simulation *simulation)
{
    brc_bounce *b = self;
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

brc_observer brc_bounce_observer(brc_bounce *bounce) { return (brc_observer){.self = bounce, .sample = sample}; }

brc_status brc_bounce_values(const brc_bounce *b, brc_outcome *outcome)
{
    const bool flew = b->n >= LEAST_SAMPLES;
    const double spread = b->tt - b->t * b->t / b->n, speed = (b->ty - b->t * b->y / b->n) / spread, height = (b->y - speed * b->t) / b->n;
    brc_outcome_add(outcome, "first_contact", "s", b->first, NAN);
    brc_outcome_add(outcome, "release", "s", b->release, NAN);
    brc_outcome_add(outcome, "bounces", "-", b->bounces, NAN);
    brc_outcome_add(outcome, "apex", "m", flew ? height + speed * speed / (2 * b->g) : NAN, NAN);
    brc_outcome_add(outcome, "spin_after", "rad/s", flew ? b->spin / b->n : NAN, NAN);
    return BRC_OK;
}
