#include "checkpoint.h"
#include "../../base/ranks.h"
#include "checkpoint_identity.h"
#include "checkpoint_store.h"
#include "../seal.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../solver/effects/guard.h"
#include "../../solver/run/lockstep.h"
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct brc_checkpoints {
    brc_context *context;
    const brc_scene *scene;
    char *folder; /* DIR/checkpoints; owned */
    char *yaml;   /* the scene as read; owned */
    brc_assembly *assembly;
    brc_recorder *recorder;
    int64_t *sums;          /* of the parts' domains, NULL: not taken yet; owned */
    int64_t next, previous; /* numbers of the next file and of the last good one, -1: none */
    int64_t seen;           /* intervals of simulated time passed at the last pause */
    double written_at;      /* brc_clock_s() of the last one, or of the beginning */
    char *last, *from;      /* paths; owned */
    int32_t last_stage;
    int64_t last_step;
    int64_t from_step, n_written, bytes;
    double seconds;
    bool resumed;
    brc_h5_read file; /* that the run goes on from, open while it may be read */
    brc_state_store store;
};

/* ---- files of the folder ---- */

/* Number of "NNNNNN.h5", or of "NNNNNN.h5.part" where a killed run left one; -1: something else. */
static int64_t number_of(const char *name, bool *whole)
{
    const size_t digits = strspn(name, "0123456789");
    *whole = strcmp(name + digits, ".h5") == 0;
    return digits >= 6 && digits < 18 && (*whole || strcmp(name + digits, ".h5.part") == 0) ? strtoll(name, NULL, 10)
                                                                                            : -1;
}

/* Numbers of the whole files in the folder that are below `below`: the largest, -1 where there is none. */
static int64_t largest_below(const char *folder, int64_t below)
{
    int64_t largest = -1;
    bool whole;
    DIR *directory = opendir(folder);
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry; entry = readdir(directory)) {
        const int64_t number = number_of(entry->d_name, &whole);
        if (whole && number < below && number > largest) largest = number;
    }
    if (directory) closedir(directory);
    return largest;
}

/* Remove all checkpoints but these two (-1: none), and what was left half written. */
static brc_status keep_only(brc_checkpoints *c, int64_t one, int64_t two)
{
    brc_status status = BRC_OK;
    bool whole;
    DIR *directory = opendir(c->folder);
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry && status == BRC_OK;
         entry = readdir(directory)) {
        const int64_t number = number_of(entry->d_name, &whole);
        char *path = NULL;
        if (number < 0 || (whole && (number == one || number == two))) continue;
        status = brc_file_join(c->context, c->folder, entry->d_name, &path);
        if (status == BRC_OK && brc_file_writes() && unlink(path) != 0 && errno != ENOENT)
            status =
                BRC_FAIL(c->context, BRC_FILE_FAILED, "%s: cannot remove an old checkpoint: %s", path, strerror(errno));
        brc_memory_free(path);
    }
    if (directory) closedir(directory);
    return status;
}

static brc_status path_of(brc_checkpoints *c, int64_t number, char **path)
{
    char name[40];
    snprintf(name, sizeof name, "%06lld.h5", (long long)number);
    brc_memory_free(*path);
    return brc_file_join(c->context, c->folder, name, path);
}

/* The newest whole one, open in c->file; the next one gets a number that no damaged one has. */
static brc_status find(brc_checkpoints *c)
{
    char why[256];
    int damaged = 0;
    for (int64_t number = largest_below(c->folder, INT64_MAX); number >= 0; number = largest_below(c->folder, number)) {
        bool whole;
        BRC_TRY(path_of(c, number, &c->from));
        if (number >= c->next) c->next = number + 1;
        BRC_TRY(brc_seal_check(c->context, c->from, &whole, why, sizeof why));
        c->previous = number;
        if (whole) return brc_h5_read_open(c->context, c->from, &c->file);
        brc_log(c->context, BRC_LOG_WARNING, "%s is passed over: %s", c->from, why);
        ++damaged;
    }
    return damaged ? BRC_FAIL(c->context, BRC_BAD_INPUT,
                              "%s: none of the %d checkpoints is whole; run without --resume to begin anew", c->folder,
                              damaged)
                   : BRC_FAIL(c->context, BRC_BAD_INPUT,
                              "%s: there is no checkpoint to go on from; run without --resume to begin", c->folder);
}

brc_status brc_checkpoints_create(brc_context *context, const char *folder, const brc_scene *scene, bool resume,
                                  brc_checkpoints **out)
{
    brc_checkpoints *c = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c, 1, "checkpoints"));
    *c = (brc_checkpoints){.context = context,
                           .scene = scene,
                           .resumed = resume,
                           .previous = -1,
                           .written_at = brc_clock_s(),
                           .file = {.file = H5I_INVALID_HID}};
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "checkpoints", &c->folder));
    BRC_TRY_OR(cleanup, brc_checkpoint_scene(context, scene, &c->yaml));
    if (resume) {
        BRC_TRY_OR(cleanup, find(c));
        BRC_TRY_OR(cleanup, brc_checkpoint_same_scene(context, &c->file, c->yaml));
    } else {
        BRC_TRY_OR(cleanup, keep_only(c, -1, -1));
        rmdir(c->folder); /* where nothing else is in it */
    }
cleanup:
    if (status != BRC_OK) brc_checkpoints_free(&c);
    *out = c;
    return status;
}

void brc_checkpoints_free(brc_checkpoints **handle)
{
    brc_checkpoints *const c = handle ? *handle : NULL;
    if (!c) return;
    if (c->file.file >= 0) brc_h5_read_close(&c->file);
    brc_memory_free(c->folder);
    brc_memory_free(c->yaml);
    brc_memory_free(c->sums);
    brc_memory_free(c->last);
    brc_memory_free(c->from);
    brc_memory_free(c);
    *handle = NULL;
}

/* ---- writing ---- */

static brc_status take_sums(brc_checkpoints *c)
{
    if (c->sums) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(c->context, &c->sums, c->assembly->n, "checksums of domains"));
    brc_checkpoint_sums(c->assembly, c->sums);
    return BRC_OK;
}

static void write_moment(brc_h5 *h5, const brc_simulation *s)
{
    const int64_t stage = brc_simulation_stage(s), step = brc_simulation_step(s), total = brc_simulation_total_steps(s);
    const double time = brc_simulation_total_time(s);
    brc_h5_group(h5, "moment");
    brc_h5_dataset(h5, "moment/stage", H5T_NATIVE_INT64, 1, 0, &stage);
    brc_h5_dataset(h5, "moment/step", H5T_NATIVE_INT64, 1, 0, &step);
    brc_h5_dataset(h5, "moment/total_steps", H5T_NATIVE_INT64, 1, 0, &total);
    brc_h5_dataset(h5, "moment/time", H5T_NATIVE_DOUBLE, 1, 0, &time);
}

static brc_status write_content(brc_checkpoints *c, brc_h5 *h5)
{
    brc_checkpoint_identity_write(h5, c->assembly, c->yaml, c->sums);
    write_moment(h5, c->assembly->part[0]);
    brc_state_store store = brc_checkpoint_store_write(h5, c->assembly->n);
    BRC_TRY(brc_recorder_save(c->recorder, &store));
    return brc_lockstep_save(c->assembly->n, c->assembly->part, &store);
}

static brc_status write_file(brc_checkpoints *c)
{
    const double start = brc_clock_s();
    const brc_simulation *s = c->assembly->part[0];
    struct stat information;
    char *path = NULL;
    brc_h5 h5;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, take_sums(c));
    BRC_TRY_OR(cleanup, brc_file_make_folder(c->context, c->folder));
    BRC_TRY_OR(cleanup, path_of(c, c->next, &path));
    BRC_TRY_OR(cleanup, brc_h5_create(c->context, path, &h5));
    status = write_content(c, &h5);
    if (status == BRC_OK)
        status = brc_h5_commit_sealed(&h5);
    else
        brc_h5_discard(&h5);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, keep_only(c, c->previous, c->next));
    brc_memory_free(c->last);
    c->last = path;
    c->last_stage = brc_simulation_stage(s);
    c->last_step = brc_simulation_step(s);
    path = NULL;
    c->previous = c->next++;
    ++c->n_written;
    c->written_at = brc_clock_s();
    c->seconds += c->written_at - start;
    c->bytes = stat(c->last, &information) == 0 ? (int64_t)information.st_size : 0;
    brc_log(c->context, BRC_LOG_INFO, "checkpoint %s: stage '%s', step %lld, %.3g MB in %.2g s", c->last,
            c->scene->stages[brc_simulation_stage(s)].name, (long long)brc_simulation_step(s), 1e-6 * (double)c->bytes,
            c->written_at - start);
cleanup:
    brc_memory_free(path);
    return status;
}

/* Intervals of simulated time that have passed. */
static int64_t intervals(const brc_checkpoints *c)
{
    const double every = c->scene->output.checkpoint_every;
    return every > 0 ? (int64_t)floor(brc_simulation_total_time(c->assembly->part[0]) / every + 1e-9) : 0;
}

static brc_status pause_here(void *self, brc_simulation *simulation, brc_pause why)
{
    brc_checkpoints *c = self;
    const brc_output *output = &c->scene->output;
    const int64_t now = intervals(c);
    int64_t asked =
        now > c->seen || (output->checkpoint_wall > 0 && brc_clock_s() - c->written_at >= output->checkpoint_wall);
    if (output->checkpoint_wall > 0) BRC_TRY(brc_ranks_reduce(c->context, BRC_ANY_BIT, 1, &asked)); /* one clock */
    (void)simulation;
    c->seen = now;
    if (why == BRC_PAUSE_GOING && !asked) return BRC_OK;
    if (why == BRC_PAUSE_DONE && !output->has_checkpoint) return BRC_OK;
    for (int32_t k = 0; k < c->assembly->n; ++k)
        BRC_TRY(brc_guard_vouch(c->assembly->part[k], c->assembly->n > 1));
    return write_file(c);
}

/* ---- a run ---- */

static brc_status take_up(brc_checkpoints *c)
{
    const brc_assembly *a = c->assembly;
    BRC_TRY(take_sums(c));
    BRC_TRY(brc_checkpoint_same_run(c->context, &c->file, a, c->sums));
    c->store = brc_checkpoint_store_read(&c->file);
    BRC_TRY(brc_lockstep_load(a->n, a->part, &c->store));
    c->store.part = -1;
    BRC_TRY(brc_recorder_resume(c->recorder, c->assembly, &c->store));
    BRC_TRY(brc_h5_read_rows(&c->file, "moment/total_steps", H5T_NATIVE_INT64, 0, 1, &c->from_step));
    c->seen = intervals(c);
    brc_log(c->context, BRC_LOG_INFO, "the run goes on from %s: stage '%s', step %lld", c->from,
            c->scene->stages[brc_simulation_stage(a->part[0])].name, (long long)brc_simulation_step(a->part[0]));
    return BRC_OK;
}

brc_status brc_checkpoints_observe(brc_checkpoints *c, brc_assembly *assembly, brc_recorder *recorder)
{
    c->assembly = assembly;
    c->recorder = recorder;
    BRC_TRY(c->resumed ? take_up(c) : brc_recorder_observe(recorder, assembly));
    c->written_at = brc_clock_s();
    const brc_observer observer = {.self = c, .pause = pause_here};
    return brc_simulation_observe(assembly->part[0], &observer);
}

/* The checkpoint that is there when a run ends early. */
static const char *last_path(const brc_checkpoints *c)
{
    return c->last ? c->last : c->resumed ? c->from : NULL;
}

/* What there is to go back to, after the sentence of what went wrong. */
static void tell_last(brc_checkpoints *c, brc_status status)
{
    const int32_t stage = brc_simulation_stage(c->assembly->part[0]);
    if (c->last)
        BRC_FAIL(c->context, status,
                 "the last good checkpoint, of stage '%s' at step %lld, is %s; --resume goes on from there",
                 c->scene->stages[c->last_stage].name, (long long)c->last_step, c->last);
    else if (last_path(c))
        BRC_FAIL(c->context, status, "the last good checkpoint is %s; --resume goes on from there", last_path(c));
    else if (status == BRC_PHYSICS_STOPPED && stage >= 0 && c->scene->stages[stage].solver == BRC_SOLVER_DYNAMIC)
        BRC_FAIL(c->context, status,
                 "there is no checkpoint to go back to, none was written before; `output: {checkpoint: {every: ...}}` "
                 "keeps good states");
}

brc_status brc_checkpoints_run(brc_checkpoints *c)
{
    const brc_assembly *a = c->assembly;
    const brc_status status =
        c->resumed ? brc_lockstep_continue(a->n, a->part, &c->store) : brc_lockstep_run(a->n, a->part);
    if (status != BRC_OK) tell_last(c, status);
    return status;
}

brc_checkpoint_report brc_checkpoints_report(const brc_checkpoints *c)
{
    return (brc_checkpoint_report){.n_written = c->n_written,
                                   .seconds = c->seconds,
                                   .bytes = c->bytes,
                                   .last = last_path(c) ? last_path(c) : "",
                                   .from = c->resumed && c->from ? c->from : "",
                                   .from_step = c->from_step};
}
