/* Shared by the tests of host/commands. */
#include "support.h"
#include "../../host/base/log.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

brc_context *test_context;
static char out_text[1 << 16], error_text[1 << 16], folder[64];

static void take(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "r");
    text[file ? fread(text, 1, size - 1, file) : 0] = '\0';
    if (file) fclose(file);
    unlink(path);
}

int test_program(const char *arguments)
{
    const char *program = getenv("BRC_PROGRAM");
    if (!program) program = BRC_PROGRAM_PATH;
    char out_path[64], error_path[64], command[4096];
    snprintf(out_path, sizeof out_path, "program-%d.out", (int)getpid());
    snprintf(error_path, sizeof error_path, "program-%d.err", (int)getpid());
    snprintf(command, sizeof command, "%s %s >%s 2>%s", program, arguments, out_path, error_path);
    const int result = system(command);
    take(out_path, out_text, sizeof out_text);
    take(error_path, error_text, sizeof error_text);
    return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

const char *test_program_stdout(void)
{
    return out_text;
}

const char *test_program_stderr(void)
{
    return error_text;
}

static int make_folder(void)
{
    snprintf(folder, sizeof folder, "test-of-commands-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

int test_make_folder(const char *scene)
{
    char path[128];
    if (make_folder() != 0) return -1;
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    FILE *file = fopen(path, "w");
    if (!file) return -1;
    const int written = fputs(scene, file);
    return fclose(file) == 0 && written >= 0 ? 0 : -1;
}

const char *test_folder(void)
{
    return folder;
}

int test_remove_folder(void **state)
{
    char command[128];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int test_begin(void **state)
{
    (void)state;
    test_context = brc_context_create();
    brc_log_set_level(test_context, BRC_LOG_ERROR);
    return make_folder();
}

int test_end(void **state)
{
    brc_context_free(&test_context);
    return test_remove_folder(state);
}

void test_done(brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(test_context));
}

const char *test_text_of(const char *name)
{
    static char text[1 << 16];
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("no %s", path);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

double test_number_behind(const char *text, const char *mark)
{
    const char *at = text ? strstr(text, mark) : NULL;
    if (!at) fail_msg("no '%s' in '%s'", mark, text ? text : "");
    return strtod(at + strlen(mark), NULL);
}
