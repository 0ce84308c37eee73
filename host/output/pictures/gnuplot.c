/* The script goes to a file beside the picture, gnuplot draws it, the script goes. */
#include "gnuplot.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

void brc_gnuplot_begin(brc_text *script, int width, int height, const char *picture)
{
    brc_text_add(script, "set terminal pngcairo size %d,%d font 'sans,18' linewidth 1.5\nset output '", width, height);
    for (const char *s = picture; *s; ++s)
        brc_text_add(script, *s == '\'' ? "''" : "%c", *s);
    brc_text_add(script, "'\nset grid linecolor rgb '#dddddd' linetype 1\nset border linecolor rgb '#333333'\n");
}

/* Run gnuplot on the script; no shell, so that no path needs quoting. *found: false where there is no gnuplot. */
static bool run_gnuplot(const char *script, bool *found)
{
    char program[] = "gnuplot", *argument = NULL;
    if (asprintf(&argument, "%s", script) < 0) return false;
    char *const arguments[] = {program, argument, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child;
    int state = -1;
    *found = posix_spawnp(&child, program, &actions, NULL, arguments, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    free(argument);
    if (!*found) return false;
    while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
    }
    *found = !(WIFEXITED(state) && WEXITSTATUS(state) == 127);
    return WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

brc_status brc_gnuplot_draw(brc_context *context, brc_text *script, const char *aside, const char *path,
                            const char *numbers, bool *made)
{
    char *name = NULL;
    bool found = false;
    *made = false;
    brc_status status = BRC_OK;
    const int64_t length = (int64_t)strlen(path) + 8;
    if (!brc_file_writes()) return BRC_OK;
    BRC_TRY_OR(cleanup, brc_memory_allocate(context, (void **)&name, length, 1, "path"));
    snprintf(name, (size_t)length, "%s.script", path);
    BRC_TRY_OR(cleanup, brc_text_write(script, name));
    const bool drawn = run_gnuplot(name, &found);
    unlink(name);
    if (drawn && brc_file_exists(aside)) {
        status = brc_file_commit(context, aside, path);
        *made = status == BRC_OK;
    } else {
        brc_log(context, BRC_LOG_WARNING, "no %s: gnuplot %s; the numbers are in %s", path,
                found ? "could not draw it" : "is not installed (Debian package gnuplot-nox)", numbers);
        brc_file_discard(aside);
    }
cleanup:
    brc_memory_free(name);
    return status;
}

brc_status brc_gnuplot_make(brc_context *context, const brc_gnuplot_figure *figure, bool *made)
{
    brc_text script = {.context = context};
    char *path = NULL, *aside = NULL;
    brc_status status = BRC_OK;
    *made = false;
    BRC_TRY_OR(cleanup, brc_file_join(context, figure->folder, figure->name, &path));
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    brc_gnuplot_begin(&script, figure->width, figure->height, aside);
    figure->draw(figure->self, &script);
    status = brc_gnuplot_draw(context, &script, aside, path, figure->numbers, made);
cleanup:
    brc_text_free(&script);
    brc_memory_free(aside);
    brc_memory_free(path);
    return status;
}
