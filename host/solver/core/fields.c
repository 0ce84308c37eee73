/* Counts, and what is done with a table of fields. */
#include "../../device/shares.h"
#include "fields.h"
#include <string.h>

/* Room for LANE_SPARE numbers of portable.h: gathers read whole vectors. */
enum { SPARE = 8 };

BRC_OF_WANTS(int64_t, brc_each_row, w->layout->n_rows)
BRC_OF_WANTS(int64_t, brc_each_block, w->layout->n_rows)
BRC_OF_WANTS(int64_t, brc_each_row_end, (int64_t)w->layout->n_rows + 1)
BRC_OF_WANTS(int64_t, brc_each_entry, w->layout->n_slots * w->layout->slice)
BRC_OF_WANTS(int64_t, brc_each_record, w->layout->n_slots * w->layout->slice)
BRC_OF_WANTS(int64_t, brc_each_slice, w->layout->n_slices)
BRC_OF_WANTS(int64_t, brc_each_slice_end, (int64_t)w->layout->n_slices + 1)
BRC_OF_WANTS(int64_t, brc_each_boundary, (int64_t)w->layout->n_boundary * w->layout->slice)
BRC_OF_WANTS(int64_t, brc_each_group, w->n_groups)
BRC_OF_WANTS(int64_t, brc_each_striker, w->scene->n_strikers)
BRC_OF_WANTS(int64_t, brc_each_listed, w->n_listed)
BRC_OF_WANTS(int64_t, brc_each_listed_end, w->n_listed + 1)
BRC_OF_WANTS(int64_t, brc_each_once, ((void)w, 1))

BRC_OF_WANTS(bool, brc_wants_cells, w->model->element == BRC_ELEMENT_CELL)
BRC_OF_WANTS(bool, brc_wants_spheres, w->model->element == BRC_ELEMENT_SPHERE)
BRC_OF_WANTS(bool, brc_wants_turning, w->model->turns)
BRC_OF_WANTS(bool, brc_wants_deforming, w->model->deforms)
BRC_OF_WANTS(bool, brc_wants_rigid_cells, brc_wants_cells(w) && !w->model->deforms)
BRC_OF_WANTS(bool, brc_wants_many, w->many_materials)
bool brc_wants_solver(const brc_wants *w, brc_solver_kind solver)
{
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        if (w->scene->stages[i].solver == solver) return true;
    return false;
}

int64_t brc_field_bytes(const brc_field_row *field, const brc_wants *wants)
{
    if (field->wanted && !field->wanted(wants)) return 0;
    const int64_t n = field->count(wants) * field->width;
    if (field->number == BRC_FIELD_INT) return n * (int64_t)sizeof(int32_t);
    return (n + SPARE) * (field->number == BRC_FIELD_STATE ? wants->state_bytes : wants->coeff_bytes);
}

int64_t brc_fields_bytes(const brc_field_table *table, const brc_wants *wants)
{
    int64_t bytes = 0;
    for (int k = 0; k < table->n && (!table->wanted || table->wanted(wants)); ++k)
        bytes += brc_field_bytes(&table->fields[k], wants);
    return bytes;
}

static brc_buffer **buffer_of(const brc_field_row *field, void *owner)
{
    return (brc_buffer **)(void *)((char *)owner + field->at);
}

brc_buffer *brc_field_buffer(const brc_field_row *field, const void *owner)
{
    return *(brc_buffer *const *)(const void *)((const char *)owner + field->at);
}

brc_buffer *brc_field_named(const brc_field_table *table, const void *owner, const char *name)
{
    brc_buffer *found = NULL;
    for (int k = 0; !found && k < table->n; ++k)
        if (strcmp(table->fields[k].name, name) == 0) found = brc_field_buffer(&table->fields[k], owner);
    return found;
}

/* How an array of a table lies; what no rank has a share of lies anyhow. */
static void tell_order(brc_buffer *buffer, const brc_field_row *field, const brc_wants *wants)
{
    static const struct {
        int64_t (*count)(const brc_wants *);
        brc_array_of what;
    } orders[] = {{brc_each_row, BRC_OF_ROWS},    {brc_each_block, BRC_OF_SLICES}, {brc_each_group, BRC_OF_GROUPS},
                  {brc_each_entry, BRC_OF_SLOTS}, {brc_each_record, BRC_OF_SLOTS}, {brc_each_boundary, BRC_OF_LOOSE}};
    const int64_t number = field->number == BRC_FIELD_INT     ? (int64_t)sizeof(int32_t)
                           : field->number == BRC_FIELD_STATE ? wants->state_bytes
                                                              : wants->coeff_bytes;
    brc_array_of what = BRC_OF_NOTHING;
    for (size_t k = 0; k < sizeof orders / sizeof *orders; ++k)
        if (field->count == orders[k].count) what = orders[k].what;
    const bool of_slices = what == BRC_OF_SLICES || what == BRC_OF_SLOTS;
    const int64_t thing = field->count == brc_each_record ? number * field->width : number; /* what lies in one piece */
    brc_buffer_is_of(buffer, what, number * field->width * (of_slices ? wants->layout->slice : 1), thing);
}

brc_status brc_fields_create(brc_device *device, const brc_field_table *table, const brc_wants *wants, void *owner)
{
    brc_fields_free(table, owner);
    for (int k = 0; k < table->n; ++k) {
        const brc_field_row *field = &table->fields[k];
        if (field->wanted && !field->wanted(wants)) continue;
        brc_buffer **const buffer = buffer_of(field, owner);
        BRC_TRY(brc_buffer_create(device, buffer, brc_field_bytes(field, wants), field->what));
        tell_order(*buffer, field, wants);
    }
    return BRC_OK;
}

void brc_fields_free(const brc_field_table *table, void *owner)
{
    for (int k = 0; k < table->n; ++k)
        brc_buffer_free(buffer_of(&table->fields[k], owner));
}
