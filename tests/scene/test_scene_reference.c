/* The pages of docs/reference/scene are what the table says, and the scene that each of them shows is accepted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/scene/scene_reader.h"

#define FOLDER BRC_SOURCE_DIR_PATH "/docs/reference/scene/"

/* A file of the folder; freed by brc_memory_free. Without it: an empty text. */
static char *text_of(brc_context *context, const char *page, const char *ending, size_t *bytes)
{
    char path[1024], *text = NULL;
    snprintf(path, sizeof path, FOLDER "%s.%s", page, ending);
    if (brc_file_read_whole(context, path, 1 << 20, &text, bytes) != BRC_OK) *bytes = 0;
    return text;
}

static void examples_are_accepted(void **state)
{
    (void)state;
    for (int p = 0; p < brc_scene_n_pages(); ++p) {
        brc_context *context = brc_context_create();
        size_t bytes = 0;
        char *text = text_of(context, brc_scene_page_name(p), "yaml", &bytes);
        brc_scene *scene = NULL;
        if (bytes == 0 || brc_scene_read_text(context, FOLDER "example.yaml", text, bytes, 0, NULL, &scene) != BRC_OK)
            fail_msg("the example of %s: %s", brc_scene_page_name(p), brc_context_message(context));
        brc_scene_free(&scene);
        brc_memory_free(text);
        brc_context_free(&context);
    }
}

/* Compares a page with the one in docs/; the right one is left beside this test when they differ. */
static bool page_is_right(int page)
{
    const char *name = brc_scene_page_name(page);
    brc_context *context = brc_context_create();
    char *made = NULL, path[1024];
    size_t made_bytes = 0, kept_bytes = 0, example_bytes = 0;
    char *kept = text_of(context, name, "md", &kept_bytes), *example = text_of(context, name, "yaml", &example_bytes);
    FILE *file = open_memstream(&made, &made_bytes);
    assert_non_null(file);
    assert_int_equal(brc_scene_write_page(context, page, example_bytes ? example : "", file), BRC_OK);
    fclose(file);
    const bool right = made_bytes == kept_bytes && memcmp(made, kept, made_bytes) == 0;
    snprintf(path, sizeof path, "scene-%s.md", name);
    FILE *fresh = right ? NULL : fopen(path, "w");
    if (fresh) {
        fwrite(made, 1, made_bytes, fresh);
        fclose(fresh);
    }
    free(made);
    brc_memory_free(kept);
    brc_memory_free(example);
    brc_context_free(&context);
    return right;
}

static void pages_in_docs_are_the_table(void **state)
{
    (void)state;
    int wrong = 0;
    for (int p = 0; p < brc_scene_n_pages(); ++p)
        if (!page_is_right(p)) {
            printf("docs/reference/scene/%s.md is not what the table says; scene-%s.md in this folder is\n",
                   brc_scene_page_name(p), brc_scene_page_name(p));
            ++wrong;
        }
    if (wrong)
        fail_msg("%d pages: in the build's folder tests/, run\n"
                 "for f in scene-*.md; do mv $f " FOLDER "${f#scene-}; done",
                 wrong);
}

static void writing_to_a_full_disk_is_an_error(void **state)
{
    (void)state;
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full); /* Linux has it */
    brc_context *context = brc_context_create();
    assert_int_equal(brc_scene_write_page(context, 0, "", full), BRC_FILE_FAILED);
    fclose(full);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(examples_are_accepted),
        cmocka_unit_test(pages_in_docs_are_the_table),
        cmocka_unit_test(writing_to_a_full_disk_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
