/* The least that a step must move, from what passes say of their arrays. */
#include "run_internal.h"

enum { MOST_TABLES = 12 };

double brc_simulation_floor_bytes(const brc_simulation *s)
{
    const brc_field_table *tables[MOST_TABLES + 1] = {&brc_state_fields, &brc_geometry_fields};
    brc_step_pass pass[BRC_STEP_PASSES];
    const int n = s->model->step_passes(s, pass);
    double sum = brc_pass_floor(s->run->pass.advance, &s->wants, tables, NULL);
    for (int k = 0; s->model->fields && s->model->fields[k] && k + 2 < MOST_TABLES; ++k)
        tables[k + 2] = s->model->fields[k];
    if (s->model->turns) sum += brc_pass_floor(s->run->pass.advance_rotation, &s->wants, tables, NULL);
    for (int k = 0; k < n; ++k)
        sum += brc_pass_floor(pass[k].pass, &s->wants, tables, pass[k].unread);
    return sum;
}
