/* libFuzzer target: the scene reader on any bytes. Besides crashes and sanitizer findings, it stops when memory is
 * kept, when a refusal has no sentence, or when a scene that was read does not survive being written and read again. A
 * byte 0xfd (never part of UTF-8) in the input separates an override from the text, so that those are tried too. */
#include "../../host/base/memory.h"
#include "../../host/scene/scene_reader.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "fuzz_scene: %s\n", what);
    abort();
}

/* What was read, written, read and written again must be the same text. */
static void check_round_trip(brc_context *context, const brc_scene *scene)
{
    char *text = NULL, *again = NULL;
    brc_scene *second = NULL;
    demand(brc_scene_to_yaml(context, scene, &text) == BRC_OK, "a scene cannot be written");
    if (brc_scene_read_text(context, "again", text, strlen(text), 0, NULL, &second) != BRC_OK) {
        fprintf(stderr, "%s\n%s\n", brc_context_message(context), text);
        demand(false, "a written scene is refused");
    }
    demand(brc_scene_to_yaml(context, second, &again) == BRC_OK, "a scene cannot be written again");
    demand(strcmp(text, again) == 0, "a scene changes by being written");
    brc_scene_free(&second);
    brc_memory_free(text);
    brc_memory_free(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const int64_t held = brc_memory_held();
    char *override = NULL;
    const uint8_t *separator = size ? memchr(data, 0xfd, size) : NULL;
    if (separator) {
        const size_t length = (size_t)(separator - data);
        override = malloc(length + 1);
        if (!override) return 0;
        memcpy(override, data, length);
        override[length] = '\0';
        data += length + 1;
        size -= length + 1;
    }
    brc_context *context = brc_context_create();
    brc_scene *scene = NULL;
    const char *const overrides[1] = {override};
    const brc_status status =
        brc_scene_read_text(context, "fuzz.yaml", (const char *)data, size, override ? 1 : 0, overrides, &scene);
    if (status == BRC_OK)
        check_round_trip(context, scene);
    else
        demand(brc_context_message(context)[0] != '\0', "a refusal without a sentence");
    brc_scene_free(&scene);
    brc_context_free(&context);
    free(override);
    demand(brc_memory_held() == held, "memory is kept");
    return 0;
}
