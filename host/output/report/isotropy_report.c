#include "isotropy_report.h"
#include "../pictures/isotropy_picture.h"
#include "../text.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>

static brc_status write_bins(brc_context *context, const brc_isotropy *i, const char *path)
{
    brc_text text = {.context = context};
    brc_text_add(&text, "x,y,z,solid_angle_sr,count,density\n");
    for (int64_t b = 0; b < i->n_bins; ++b) {
        const double numbers[6] = {
            i->direction[3 * b], i->direction[3 * b + 1], i->direction[3 * b + 2], i->solid_angle[b], i->count[b],
            i->density[b]};
        for (int k = 0; k < 6; ++k) {
            brc_text_add_number(&text, numbers[k]);
            brc_text_add(&text, k < 5 ? "," : "\n");
        }
    }
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* The three files, each by its own writer. */
static brc_status write_files(brc_context *context, const brc_isotropy *isotropy, const char *dir)
{
    static const struct {
        const char *name;
        brc_status (*write)(brc_context *, const brc_isotropy *, const char *);
    } files[] = {{"isotropy.csv", write_bins},
                 {"isotropy.vtp", brc_isotropy_write_surface},
                 {"isotropy.png", brc_isotropy_picture}};
    BRC_TRY(brc_file_make_folder(context, dir));
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        char *path;
        BRC_TRY(brc_file_join(context, dir, files[k].name, &path));
        const brc_status status = files[k].write(context, isotropy, path);
        brc_memory_free(path);
        BRC_TRY(status);
    }
    return BRC_OK;
}

brc_status brc_isotropy_report(brc_context *context, const brc_domain *domain, int level, const char *dir)
{
    brc_isotropy isotropy;
    BRC_TRY(brc_isotropy_measure(context, domain, level, BRC_ISOTROPY_BONDS, 0, &isotropy));
    printf("Directions, every bond once\n");
    brc_isotropy_print(stdout, &isotropy);
    const brc_status status = write_files(context, &isotropy, dir);
    brc_isotropy_free(&isotropy);
    BRC_TRY(status);
    if (domain->element_kind == BRC_ELEMENT_CELL) {
        BRC_TRY(brc_isotropy_measure(context, domain, level, BRC_ISOTROPY_AREA, 0, &isotropy));
        printf("Directions, weighted with face area\n");
        brc_isotropy_print(stdout, &isotropy);
        brc_isotropy_free(&isotropy);
    }
    printf("%s: isotropy.csv, isotropy.vtp, isotropy.png\n", dir);
    return BRC_OK;
}
