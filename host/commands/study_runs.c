/* The runs of a study: each a process of this program, so that one that fails, or runs out of memory, leaves the
 * others alone. */
#include "price/check_scene.h"
#include "price/pace.h"
#include "study.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../output/text.h"
#include "../scene/node.h"
#include "../scene/scene_reader.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OVERRIDE = 512, FILE_LIMIT = 1 << 26 };

/* What a run is: its overrides, and the whole scene as it resolves. */
typedef struct one_run {
    char set[BRC_STUDY_KEYS][OVERRIDE];
    const char *sets[BRC_STUDY_KEYS];
    char *folder, *identity; /* owned */
    pid_t child;             /* 0: none */
} one_run;

typedef struct pool {
    brc_context *context;
    const brc_study *study;
    const brc_study_request *request;
    one_run *runs;
    brc_study_outcome *outcome;
} pool;

static brc_status path_in(brc_context *context, const char *folder, const char *name, char **out)
{
    brc_memory_free(*out);
    *out = NULL;
    return brc_file_join(context, folder, name, out);
}

static brc_status copy_text(brc_context *context, const char *from, char **out)
{
    const size_t room = strlen(from) + 1;
    brc_memory_free(*out);
    BRC_TRY(BRC_ALLOCATE(context, out, room, "text of a study"));
    memcpy(*out, from, room);
    return BRC_OK;
}

/* Folder, overrides and identity; a scene that cannot be read is the run's own failure. */
static brc_status describe(pool *p, int run)
{
    one_run *one = &p->runs[run];
    brc_context *own = brc_context_create();
    brc_scene *scene = NULL;
    char number[16], value[OVERRIDE / 2], *yaml = NULL;
    brc_status status = own ? BRC_OK : BRC_FAIL(p->context, BRC_NO_MEMORY, "no memory for a context");
    if (status != BRC_OK) return status;
    brc_log_set_level(own, BRC_LOG_ERROR);
    snprintf(number, sizeof number, "%05d", run);
    BRC_TRY_OR(cleanup, path_in(p->context, p->request->folder, number, &one->folder));
    for (int k = 0; k < p->study->n_keys; ++k) {
        snprintf(one->set[k], OVERRIDE, "%s=%s", p->study->keys[k].key,
                 brc_study_value(p->study, run, k, value, sizeof value));
        one->sets[k] = one->set[k];
    }
    if (brc_scene_read(own, p->study->scene, p->study->n_keys, one->sets, &scene) == BRC_OK &&
        brc_scene_to_yaml(own, scene, &yaml) == BRC_OK) {
        brc_text identity = {.context = p->context};
        brc_text_add(&identity, "device %s, precision %s\n%s", p->request->device ? p->request->device : "auto",
                     p->request->precision ? p->request->precision : "double", yaml);
        one->identity = identity.data;
        status = identity.status;
    } else {
        snprintf(p->outcome[run].status, sizeof p->outcome[run].status, "bad_input");
        status = copy_text(p->context, brc_context_message(own), &p->outcome[run].reason);
    }
cleanup:
    brc_memory_free(yaml);
    brc_scene_free(&scene);
    brc_context_free(&own);
    return status;
}

/* ---- what a run has left ---- */

/* summary.json, which is YAML too, into the outcome. */
static brc_status take_summary(brc_context *context, const brc_node *root, brc_study_outcome *out)
{
    const brc_node *end = brc_node_find(root, "end"), *status = end ? brc_node_find(end, "status") : NULL,
                   *reason = end ? brc_node_find(end, "reason") : NULL;
    const brc_node *measures = brc_node_find(root, "measures");
    snprintf(out->status, sizeof out->status, "%.20s", status ? status->text : "missing");
    BRC_TRY(copy_text(context, reason && strcmp(out->status, "done") != 0 ? reason->text : "", &out->reason));
    for (const brc_node *one = measures && measures->kind == BRC_NODE_MAP ? measures->first : NULL;
         one && out->n_measures < BRC_STUDY_MEASURES; one = one->next) {
        const brc_node *value = brc_node_find(one, "value");
        BRC_TRY(copy_text(context, one->key, &out->name[out->n_measures]));
        BRC_TRY(copy_text(context, value && strcmp(value->text, "null") != 0 ? value->text : "",
                          &out->text[out->n_measures]));
        ++out->n_measures;
    }
    return BRC_OK;
}

static brc_status read_summary(brc_context *context, const char *folder, brc_study_outcome *out)
{
    char *path = NULL, *text = NULL;
    size_t bytes;
    brc_tree *tree = NULL;
    brc_problems *problems = NULL;
    brc_node *root = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, path_in(context, folder, "summary.json", &path));
    snprintf(out->status, sizeof out->status, "missing");
    if (!brc_file_exists(path)) goto cleanup;
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, FILE_LIMIT, &text, &bytes));
    BRC_TRY_OR(cleanup, brc_tree_create(context, &tree));
    BRC_TRY_OR(cleanup, brc_problems_create(context, path, 0, NULL, &problems));
    BRC_TRY_OR(cleanup, brc_tree_parse(tree, problems, 0, text, bytes, &root));
    if (root && root->kind == BRC_NODE_MAP) status = take_summary(context, root, out);
cleanup:
    brc_problems_free(&problems);
    brc_tree_free(&tree);
    brc_memory_free(text);
    brc_memory_free(path);
    return status;
}

/* A run that is not done and gave no reason was killed. */
static brc_status name_killed(brc_context *context, const char *reason, brc_study_outcome *out)
{
    if (strcmp(out->status, "done") == 0) return BRC_OK;
    if (strcmp(out->status, "running") != 0 && out->reason && out->reason[0]) return BRC_OK;
    snprintf(out->status, sizeof out->status, "killed");
    return copy_text(context, reason, &out->reason);
}

/* Is the folder that of this very run, come to its end? What it has measured is taken then, and of a run that is
 * collected also how else it ended. */
static brc_status is_done(pool *p, int run, bool *done)
{
    char *path = NULL, *text = NULL;
    size_t bytes;
    brc_status status = path_in(p->context, p->runs[run].folder, "study.txt", &path);
    *done = false;
    if (status == BRC_OK && brc_file_exists(path))
        status = brc_file_read_whole(p->context, path, FILE_LIMIT, &text, &bytes);
    brc_study_outcome *out = &p->outcome[run];
    const bool own = status == BRC_OK && text && strcmp(text, p->runs[run].identity) == 0;
    if (own) status = read_summary(p->context, p->runs[run].folder, out);
    *done = own && strcmp(out->status, "done") == 0;
    if (status == BRC_OK && !*done && (!own || !p->request->collect)) {
        out->n_measures = 0;
        snprintf(out->status, sizeof out->status, "missing");
    }
    if (status == BRC_OK && own && p->request->collect)
        status = name_killed(p->context, "it ended without a word; see log.txt", out);
    brc_memory_free(text);
    brc_memory_free(path);
    return status;
}

/* ---- processes ---- */

/* In the child: never returns. It is killed when its parent dies, so that nobody else writes into its folder once the
 * study is taken up. */
static void become_run(const pool *p, const one_run *one, int log, const char *threads)
{
    const char *arguments[16 + 2 * BRC_STUDY_KEYS] = {"breccia",   "run",       p->study->scene, "--output",
                                                      one->folder, "--threads", threads};
    int n = 7;
    if (p->request->device) arguments[n++] = "--device", arguments[n++] = p->request->device;
    if (p->request->precision) arguments[n++] = "--precision", arguments[n++] = p->request->precision;
    for (int k = 0; k < p->study->n_keys; ++k)
        arguments[n++] = "--set", arguments[n++] = one->set[k];
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv("/proc/self/exe", (char *const *)(uintptr_t)arguments);
    _exit(127);
}

static brc_status start(pool *p, int run)
{
    one_run *one = &p->runs[run];
    char threads[16], *path = NULL;
    brc_status status = BRC_OK;
    snprintf(threads, sizeof threads, "%d", p->request->threads > 0 ? p->request->threads : 1);
    BRC_TRY_OR(cleanup, brc_file_make_folder(p->context, one->folder));
    BRC_TRY_OR(cleanup, path_in(p->context, one->folder, "summary.json", &path));
    (void)unlink(path); /* of a run of something else: it must not be taken for this one's */
    BRC_TRY_OR(cleanup, path_in(p->context, one->folder, "study.txt", &path));
    BRC_TRY_OR(cleanup, brc_file_write_whole(p->context, path, one->identity, strlen(one->identity)));
    BRC_TRY_OR(cleanup, path_in(p->context, one->folder, "log.txt", &path));
    const int log = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (log < 0)
        status = BRC_FAIL(p->context, BRC_FILE_FAILED, "%s: cannot be written: %s", path, strerror(errno));
    else {
        one->child = fork();
        if (one->child == 0) become_run(p, one, log, threads);
        if (one->child < 0)
            status = BRC_FAIL(p->context, BRC_NO_MEMORY, "no process for run %d: %s", run, strerror(errno));
        close(log);
    }
cleanup:
    brc_memory_free(path);
    return status;
}

/* Wait for any of them. */
static brc_status gather(pool *p, int *run)
{
    int how = 0;
    pid_t child;
    do
        child = waitpid(-1, &how, 0);
    while (child < 0 && errno == EINTR);
    if (child < 0) return BRC_FAIL(p->context, BRC_INTERNAL, "no run to wait for: %s", strerror(errno));
    for (*run = 0; *run < p->study->n_runs; ++*run)
        if (p->runs[*run].child == child) break;
    if (*run == p->study->n_runs) return BRC_FAIL(p->context, BRC_INTERNAL, "a process that is no run has ended");
    p->runs[*run].child = 0;
    BRC_TRY(read_summary(p->context, p->runs[*run].folder, &p->outcome[*run]));
    if (WIFEXITED(how) && WEXITSTATUS(how) == 0) return BRC_OK;
    return name_killed(p->context, WIFSIGNALED(how) ? strsignal(WTERMSIG(how)) : "it ended without a word; see log.txt",
                       &p->outcome[*run]);
}

static brc_status run_all(pool *p, int n_missing, const int *missing, int jobs)
{
    brc_status status = BRC_OK;
    int next = 0, running = 0, run = 0;
    while (status == BRC_OK && (next < n_missing || running > 0)) {
        if (next < n_missing && running < jobs) {
            status = start(p, missing[next++]);
            running += status == BRC_OK;
            continue;
        }
        status = gather(p, &run);
        --running;
        if (status == BRC_OK)
            brc_log(p->context, BRC_LOG_INFO, "run %05d: %s%s%s", run, p->outcome[run].status,
                    p->outcome[run].reason[0] ? ": " : "", p->outcome[run].reason);
    }
    for (run = 0; status != BRC_OK && run < p->study->n_runs; ++run) /* nobody would hear of them any more */
        if (p->runs[run].child > 0) kill(p->runs[run].child, SIGTERM), waitpid(p->runs[run].child, NULL, 0);
    return status;
}

/* ---- before ---- */

/* What is told of the first missing run stands for all. */
static brc_status tell_budget(pool *p, int n_missing, int first, int jobs)
{
    const brc_study_request *q = p->request;
    brc_device_request request = {.selector = q->device ? q->device : "auto",
                                  .n_threads = q->threads > 0 ? q->threads : 1};
    brc_check check = {0};
    brc_scene *scene = NULL;
    for (int k = BRC_DOUBLE; q->precision && k <= BRC_SINGLE; ++k)
        if (strcmp(q->precision, brc_precision_name((brc_precision)k)) == 0) request.precision = (brc_precision)k;
    brc_status status = brc_scene_read(p->context, p->study->scene, p->study->n_keys, p->runs[first].sets, &scene);
    if (status == BRC_OK) status = brc_check_build(p->context, scene, &request, brc_pace_clock_s(&request), &check);
    if (status == BRC_OK) status = brc_check_try(p->context, &request, false, &check);
    if (status == BRC_OK) status = brc_check_price(p->context, scene, &request, &check);
    if (status == BRC_OK && check.told.known)
        printf("budget: %d runs of about %.3g s, %d at once: about %.3g s; %.3g MB on disk\n", n_missing,
               check.told.seconds, jobs, check.told.seconds * ceil((double)n_missing / jobs),
               1e-6 * check.told.disk_bytes * n_missing);
    else
        printf("budget: %d runs, %d at once; the first could not be priced\n", n_missing, jobs);
    fflush(stdout);
    if (status != BRC_OK) brc_context_clear(p->context); /* its own run will tell */
    brc_check_free(&check);
    brc_scene_free(&scene);
    return BRC_OK;
}

brc_status brc_study_run(brc_context *context, const brc_study *study, const brc_study_request *request,
                         brc_study_outcome **outcome)
{
    pool p = {.context = context, .study = study, .request = request};
    const int threads = request->threads > 0 ? request->threads : 1;
    const int jobs = request->jobs > 0               ? request->jobs
                     : omp_get_num_procs() > threads ? omp_get_num_procs() / threads
                                                     : 1;
    const int stride = request->n_tasks > 0 ? request->n_tasks : 1;
    int *missing = NULL, n_missing = 0, n_done = 0, n_runs = 0;
    brc_status status = BRC_OK;
    *outcome = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, outcome, study->n_runs, "outcomes of a study"));
    p.outcome = *outcome;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &p.runs, study->n_runs, "runs of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &missing, study->n_runs, "runs of a study"));
    for (int run = request->task; run < study->n_runs; run += stride, ++n_runs) {
        bool done = false;
        BRC_TRY_OR(cleanup, describe(&p, run));
        if (!p.runs[run].identity) continue;
        BRC_TRY_OR(cleanup, is_done(&p, run, &done));
        n_done += done;
        if (!done) missing[n_missing++] = run;
    }
    printf("study: %d runs, %d of them done, %d refused\n", n_runs, n_done, n_runs - n_done - n_missing);
    if (request->collect) goto cleanup;
    if (n_missing > 0 && !request->now) BRC_TRY_OR(cleanup, tell_budget(&p, n_missing, missing[0], jobs));
    status = run_all(&p, n_missing, missing, jobs);
cleanup:
    for (int run = 0; p.runs && run < study->n_runs; ++run) {
        brc_memory_free(p.runs[run].folder);
        brc_memory_free(p.runs[run].identity);
    }
    brc_memory_free(p.runs);
    brc_memory_free(missing);
    return status;
}

void brc_study_outcomes_free(int n, brc_study_outcome **outcome)
{
    for (int run = 0; *outcome && run < n; ++run) {
        brc_study_outcome *o = &(*outcome)[run];
        brc_memory_free(o->reason);
        for (int k = 0; k < BRC_STUDY_MEASURES; ++k) {
            brc_memory_free(o->name[k]);
            brc_memory_free(o->text[k]);
        }
    }
    brc_memory_free(*outcome);
    *outcome = NULL;
}
