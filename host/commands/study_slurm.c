/* A study as an array job of Slurm. The tasks need no word from each other: each knows its runs by its number. */
#include "study.h"
#include "../base/memory.h"
#include "../base/version.h"
#include "../output/text.h"
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Slurm takes 1001 numbers as it is installed (MaxArraySize). */
enum { TASKS = 1000 };

/* In quotation marks of the shell. */
static void add_word(brc_text *text, const char *word)
{
    brc_text_add(text, " '");
    for (const char *c = word; *c; ++c) {
        if (*c == '\'')
            brc_text_add(text, "'\\''");
        else
            brc_text_add_bytes(text, c, 1);
    }
    brc_text_add(text, "'");
}

static brc_status absolute(brc_context *context, const char *path, char *out)
{
    if (realpath(path, out)) return BRC_OK;
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot be found: %s", path, strerror(errno));
}

static void add_choices(brc_text *text, const brc_study_request *request)
{
    if (request->device) brc_text_add(text, " --device"), add_word(text, request->device);
    if (request->precision) brc_text_add(text, " --precision"), add_word(text, request->precision);
}

brc_status brc_study_write_slurm(brc_context *context, const brc_study *study, const char *path,
                                 const brc_study_request *request)
{
    brc_text text = {.context = context};
    char program[PATH_MAX], file[PATH_MAX], folder[PATH_MAX];
    const int n_tasks = study->n_runs < TASKS ? study->n_runs : TASKS;
    BRC_TRY(absolute(context, "/proc/self/exe", program));
    BRC_TRY(absolute(context, path, file));
    BRC_TRY(absolute(context, request->folder, folder));
    brc_text_add(&text, "#!/bin/sh\n#SBATCH --job-name=breccia-study\n#SBATCH --array=0-%d", n_tasks - 1);
    if (request->jobs > 0) brc_text_add(&text, "%%%d", request->jobs);
    brc_text_add(&text, "\n#SBATCH --cpus-per-task=%d\n#SBATCH --output=\"%s/slurm-%%a.txt\"\n", request->threads,
                 folder);
    brc_text_add(&text, "# breccia %s, %d runs. Time, memory, partition, a GPU: by options of sbatch.\n", brc_version(),
                 study->n_runs);
    brc_text_add(&text, "# When the tasks have ended, put together what they measured:\n#    ");
    add_word(&text, program);
    brc_text_add(&text, " study");
    add_word(&text, file);
    brc_text_add(&text, " -o");
    add_word(&text, folder);
    add_choices(&text, request);
    brc_text_add(&text, " --collect\nexec");
    add_word(&text, program);
    brc_text_add(&text, " study");
    add_word(&text, file);
    brc_text_add(&text, " -o");
    add_word(&text, folder);
    add_choices(&text, request);
    brc_text_add(&text, " --threads %d --task \"${SLURM_ARRAY_TASK_ID:?}/%d\"\n", request->threads, n_tasks);
    return brc_text_write_into(&text, request->folder, "slurm.sh");
}
