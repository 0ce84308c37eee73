/* See bad.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "bad.h"

brc_scene *good_scene_with(const char *text, const char *override)
{
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    const char *const overrides[1] = {override};
    if (brc_scene_read_text(context, "folder/s.yaml", text, strlen(text), override ? 1 : 0, overrides, &scene) !=
        BRC_OK)
        fail_msg("%s\n%s", brc_context_message(context), text);
    brc_context_free(&context);
    return scene;
}

brc_scene *good_scene(const char *text)
{
    return good_scene_with(text, NULL);
}

void bad_bytes(const char *text, size_t bytes, const char *place, const char *sentence)
{
    char start[64];
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    const brc_status status = brc_scene_read_text(context, "s.yaml", text, bytes, 0, NULL, &scene);
    snprintf(start, sizeof start, "s.yaml:%s: error: ", place);
    bool found = false;
    for (const char *line = brc_context_message(context); (line = strstr(line, start)) != NULL; ++line) {
        const char *end = strchr(line, '\n'), *said = strstr(line, sentence);
        found |= said && (!end || said < end);
    }
    if (status != BRC_BAD_INPUT || !found)
        fail_msg("expected '%s...%s'\nfound status %d, '%s'\nin\n%.2000s", start, sentence, (int)status,
                 brc_context_message(context), text);
    assert_null(scene);
    brc_context_free(&context);
}

void bad_scene(const char *text, const char *place, const char *sentence)
{
    bad_bytes(text, strlen(text), place, sentence);
}

void bad_override(const char *text, const char *override, const char *sentence)
{
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    const char *const overrides[2] = {"version=1", override};
    const brc_status status = brc_scene_read_text(context, "s.yaml", text, strlen(text), 2, overrides, &scene);
    char start[256];
    snprintf(start, sizeof start, "s.yaml: in the override '%s': error: ", override);
    const char *line = strstr(brc_context_message(context), start);
    if (status != BRC_BAD_INPUT || !line || !strstr(line, sentence))
        fail_msg("expected '%s...%s'\nfound status %d, '%s'", start, sentence, (int)status,
                 brc_context_message(context));
    assert_null(scene);
    brc_context_free(&context);
}

const char *warnings_of(const char *text, char *out, size_t room)
{
    FILE *file = tmpfile();
    fflush(stderr);
    const int kept = dup(2);
    dup2(fileno(file), 2);
    brc_scene *scene = good_scene(text);
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    brc_scene_free(&scene);
    rewind(file);
    out[fread(out, 1, room - 1, file)] = '\0';
    fclose(file);
    return out;
}

void warned_scene(const char *text, const char *place, const char *sentence)
{
    char said[4096], start[64];
    snprintf(start, sizeof start, "warning: folder/s.yaml:%s: ", place);
    const char *line = strstr(warnings_of(text, said, sizeof said), start);
    if (!line || !strstr(line, sentence)) fail_msg("expected '%s...%s'\nfound '%s'", start, sentence, said);
}

int count_errors(const char *text)
{
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    brc_scene_read_text(context, "s.yaml", text, strlen(text), 0, NULL, &scene);
    int n = 0;
    for (const char *at = brc_context_message(context); (at = strstr(at, ": error: ")) != NULL; ++at)
        ++n;
    brc_scene_free(&scene);
    brc_context_free(&context);
    return n;
}
