#include "crack_records.h"
#include "crack_surface.h"
#include "../../base/memory.h"

struct brc_crack_records {
    const brc_assembly *assembly;
    brc_append *cracks_file, *fragments_file;
    int64_t n_written; /* rows of cracks.csv */
    bool known;        /* state is of some moment */
    int32_t stage;     /* of the last rows of fragments.csv, -1: none */
    int64_t step;
    brc_crack_state state;
};

brc_status brc_crack_records_create(brc_context *context, const brc_assembly *assembly, const char *cracks_path,
                                    const char *fragments_path, brc_crack_records **out)
{
    brc_crack_records *r = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &r, 1, "files of cracks"));
    r->assembly = assembly;
    r->stage = -1;
    BRC_TRY_OR(cleanup, brc_append_create(context, cracks_path, brc_cracks_csv_head(), &r->cracks_file));
    BRC_TRY_OR(cleanup, brc_append_create(context, fragments_path, brc_fragment_table_csv_head(), &r->fragments_file));
cleanup:
    if (status != BRC_OK) brc_crack_records_free(&r);
    *out = r;
    return status;
}

void brc_crack_records_free(brc_crack_records **records)
{
    if (!records || !*records) return;
    brc_crack_records *r = *records;
    brc_append_free(&r->cracks_file);
    brc_append_free(&r->fragments_file);
    brc_cracks_free(&r->state.cracks);
    brc_fragment_table_free(&r->state.fragments);
    brc_crack_report_free(&r->state.report);
    brc_memory_free(r);
    *records = NULL;
}

static brc_status take(brc_context *context, brc_crack_records *r)
{
    brc_crack_state *s = &r->state;
    r->known = false;
    BRC_TRY(brc_cracks_take(context, r->assembly, &s->cracks));
    BRC_TRY(brc_fragment_table_take(context, r->assembly, &s->fragments));
    BRC_TRY(brc_crack_report_find(context, r->assembly, &s->cracks, &s->fragments.sizes, &s->report));
    r->known = true;
    return BRC_OK;
}

/* Rows of fragments.csv are of moments that are gone; those of cracks.csv can be written again. */
static brc_status store_position(brc_crack_records *r, brc_state_store *store, int64_t *bytes)
{
    BRC_TRY(brc_store_index(store, "fragments.stage", &r->stage));
    BRC_TRY(brc_store_integer(store, "fragments.step", &r->step));
    return brc_store_integer(store, "fragments.bytes", bytes);
}

brc_status brc_crack_records_save(brc_context *context, brc_crack_records *r, brc_state_store *store)
{
    int64_t bytes = brc_append_bytes(r->fragments_file);
    BRC_TRY(brc_append_finish(context, r->fragments_file));
    return store_position(r, store, &bytes);
}

brc_status brc_crack_records_resume(brc_context *context, const brc_assembly *assembly, const char *cracks_path,
                                    const char *fragments_path, brc_state_store *store, brc_crack_records **out)
{
    brc_crack_records *r = NULL;
    brc_status status = BRC_OK;
    int64_t bytes;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &r, 1, "files of cracks"));
    r->assembly = assembly;
    BRC_TRY_OR(cleanup, store_position(r, store, &bytes));
    BRC_TRY_OR(cleanup, brc_append_reopen(context, fragments_path, bytes, &r->fragments_file));
    BRC_TRY_OR(cleanup, brc_append_create(context, cracks_path, brc_cracks_csv_head(), &r->cracks_file));
    BRC_TRY_OR(cleanup, take(context, r));
    BRC_TRY_OR(cleanup, brc_cracks_csv_add(context, r->cracks_file, &r->state.cracks, &r->n_written));
cleanup:
    if (status != BRC_OK) brc_crack_records_free(&r);
    *out = r;
    return status;
}

static brc_status add_fragments(brc_context *context, brc_crack_records *r, int64_t frame)
{
    const brc_simulation *first = r->assembly->part[0];
    BRC_TRY(brc_fragment_table_csv_add(context, r->fragments_file, frame, &r->state.fragments));
    r->stage = brc_simulation_stage(first);
    r->step = brc_simulation_step(first);
    return BRC_OK;
}

brc_status brc_crack_records_frame(brc_context *context, brc_crack_records *r, int64_t frame, const char *surface)
{
    BRC_TRY(take(context, r));
    BRC_TRY(brc_cracks_csv_add(context, r->cracks_file, &r->state.cracks, &r->n_written));
    BRC_TRY(add_fragments(context, r, frame));
    return surface ? brc_crack_surface_write(context, r->assembly, surface) : BRC_OK;
}

brc_status brc_crack_records_finish(brc_context *context, brc_crack_records *r, bool alive)
{
    const brc_simulation *first = r->assembly->part[0];
    if (alive) {
        BRC_TRY(take(context, r));
        BRC_TRY(brc_cracks_csv_add(context, r->cracks_file, &r->state.cracks, &r->n_written));
        if (r->stage != brc_simulation_stage(first) || r->step != brc_simulation_step(first))
            BRC_TRY(add_fragments(context, r, -1));
    }
    BRC_TRY(brc_append_finish(context, r->cracks_file));
    return brc_append_finish(context, r->fragments_file);
}

const brc_crack_state *brc_crack_records_state(const brc_crack_records *r)
{
    return r && r->known ? &r->state : NULL;
}
