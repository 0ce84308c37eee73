/* Stepping by hand: the run of the program in a thread that waits where its caller wants it to. Only one of the two
 * ever works on the simulation: the caller while the run stands, the run while the caller waits for it. */
#include "library_internal.h"
#include "../base/log.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* ---- in the thread of the run ---- */

static brc_status stand(breccia_run *run)
{
    brc_by_hand *h = &run->hand;
    pthread_mutex_lock(&h->mutex);
    h->standing = true;
    pthread_cond_broadcast(&h->changed);
    while (h->left == 0 && !h->leave)
        pthread_cond_wait(&h->changed, &h->mutex);
    h->standing = false;
    const bool leave = h->leave;
    pthread_mutex_unlock(&h->mutex);
    const breccia_moment now = brc_library_moment(run);
    if (!leave || (now.stage + 1 == now.n_stages && now.step >= now.planned)) return BRC_OK; /* nothing is left to do */
    return BRC_FAIL(run->context, BRC_INTERRUPTED, "the run was ended at step %lld of stage '%s'", (long long)now.step,
                    now.stage_name);
}

/* So many of the steps that were granted are done. */
static void count(brc_by_hand *h, int64_t steps)
{
    h->made += steps;
    if (h->left != INT64_MAX) h->left = h->left > steps ? h->left - steps : 0;
}

int64_t brc_hand_next(const breccia_run *run, int64_t step)
{
    const brc_by_hand *h = &run->hand;
    if (!h->begun || h->left >= INT64_MAX - h->from) return INT64_MAX;
    return h->from + h->left > step ? h->from + h->left : step + 1;
}

brc_status brc_hand_stage_begin(breccia_run *run)
{
    brc_by_hand *h = &run->hand;
    if (!h->begun) return BRC_OK;
    h->from = brc_simulation_step(run->assembly.part[0]);
    return h->left == 0 ? stand(run) : BRC_OK;
}

brc_status brc_hand_look(breccia_run *run)
{
    brc_by_hand *h = &run->hand;
    const int64_t step = brc_simulation_step(run->assembly.part[0]);
    if (!h->begun || step < brc_hand_next(run, h->from)) return BRC_OK;
    count(h, step - h->from);
    h->from = step;
    return stand(run);
}

void brc_hand_stage_end(breccia_run *run, int64_t step)
{
    const brc_simulation *s = run->assembly.part[0];
    const bool modes = brc_simulation_scene(s)->stages[brc_simulation_stage(s)].solver == BRC_SOLVER_MODES;
    if (run->hand.begun) count(&run->hand, modes ? 1 : step - run->hand.from);
}

void brc_hand_finished(breccia_run *run)
{
    brc_by_hand *h = &run->hand;
    if (!h->begun) return;
    pthread_mutex_lock(&h->mutex);
    h->all_done = true;
    pthread_cond_broadcast(&h->changed);
    while (!h->leave)
        pthread_cond_wait(&h->changed, &h->mutex);
    pthread_mutex_unlock(&h->mutex);
}

static void *run_all(void *self)
{
    breccia_run *run = self;
    const brc_status status = brc_library_run(run);
    pthread_mutex_lock(&run->hand.mutex);
    run->hand.status = status;
    run->hand.over = true;
    pthread_cond_broadcast(&run->hand.changed);
    pthread_mutex_unlock(&run->hand.mutex);
    return NULL;
}

/* ---- in the caller's ---- */

/* Signals stay with the threads that were there. */
static bool begin(breccia_run *run)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    run->hand.begun = run->begun = true;
    const bool there = pthread_create(&run->hand.thread, NULL, run_all, run) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!there) {
        run->hand.begun = false;
        run->ended = true;
    }
    return there;
}

/* With the mutex held, which is let go while the caller is told. What is read of a run that goes on may be a step
 * old. */
static void tell(breccia_run *run)
{
    breccia_moment moment;
    char name[BRC_NAME];
    if (!run->told || run->assembly.n == 0 || brc_clock_s() - run->told_at < run->told_every) return;
    moment = brc_library_moment(run);
    snprintf(name, sizeof name, "%s", moment.stage_name);
    moment.stage_name = name;
    pthread_mutex_unlock(&run->hand.mutex);
    const breccia_answer answer = run->told(run->told_self, &moment);
    pthread_mutex_lock(&run->hand.mutex);
    run->told_at = brc_clock_s();
    if (answer == BRECCIA_STOP) run->asked_to_stop = true;
}

static void await(breccia_run *run)
{
    brc_by_hand *h = &run->hand;
    const long most_ns = 50 * 1000 * 1000, second_ns = 1000 * 1000 * 1000;
    while (!h->standing && !h->over && !h->all_done) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += most_ns;
        until.tv_sec += until.tv_nsec / second_ns;
        until.tv_nsec %= second_ns;
        pthread_cond_timedwait(&h->changed, &h->mutex, &until);
        if (!h->standing && !h->over && !h->all_done) tell(run);
    }
}

static breccia_status join(breccia_run *run)
{
    pthread_join(run->hand.thread, NULL);
    run->ended = true;
    return brc_public_status(run->hand.status);
}

static breccia_status refuse(breccia_run *run, const char *what)
{
    return brc_public_status(BRC_FAIL(run->context, BRC_BAD_INPUT, "%s", what));
}

breccia_status breccia_run_step(breccia_run *run, int64_t n, int64_t *done)
{
    int64_t nowhere, *const made = done ? done : &nowhere;
    *made = 0;
    if (!run) return BRECCIA_NO_MEMORY;
    brc_by_hand *h = &run->hand;
    if (run->ended) return refuse(run, "the run has ended; create another one");
    if (run->begun && !h->begun) return refuse(run, "the run goes on already; a callback of it cannot step it");
    if (n < 0) return refuse(run, "the number of steps is below 0");
    if (run->scene->status != BRC_OK) return refuse(run, "the scene has errors; see breccia_scene_problems");
    if (h->all_done || (h->begun && n == 0)) return BRECCIA_OK;
    if (h->begun && pthread_equal(h->thread, pthread_self()))
        return refuse(run, "an observer cannot step the run that it looks at");
    pthread_mutex_lock(&h->mutex);
    h->left = n;
    h->made = 0;
    h->standing = false;
    if (!h->begun && !begin(run)) {
        pthread_mutex_unlock(&h->mutex);
        return brc_public_status(BRC_FAIL(run->context, BRC_NO_MEMORY, "no thread can be made for the run"));
    }
    pthread_cond_broadcast(&h->changed);
    await(run);
    const bool over = h->over;
    pthread_mutex_unlock(&h->mutex);
    *made = h->made;
    return over ? join(run) : BRECCIA_OK;
}

breccia_status breccia_run_end(breccia_run *run)
{
    if (!run) return BRECCIA_NO_MEMORY;
    brc_by_hand *h = &run->hand;
    if (run->ended || !h->begun) return refuse(run, "only a run that is stepped by hand can be ended");
    if (pthread_equal(h->thread, pthread_self()))
        return refuse(run, "an observer ends the run that it looks at by its answer");
    pthread_mutex_lock(&h->mutex);
    h->leave = true;
    pthread_cond_broadcast(&h->changed);
    pthread_mutex_unlock(&h->mutex);
    return join(run);
}

void brc_hand_close(breccia_run *run)
{
    if (run->hand.begun && !run->ended) (void)breccia_run_end(run);
}
