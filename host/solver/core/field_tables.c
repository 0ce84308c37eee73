/* Every table of fields there is: those of runs, of effects and of models. */
#include "fields.h"
#include "../effects/effect.h"
#include "../models/model.h"

extern const brc_field_table brc_state_fields, brc_geometry_fields, brc_solve_fields, brc_mode_fields, brc_power_fields,
    brc_multigrid_fields, brc_multigrid_ground_fields, brc_multigrid_law_fields, brc_multigrid_coarsest_fields,
    brc_multigrid_finest_fields, brc_multigrid_aggregate_fields, brc_multigrid_level_fields,
    brc_multigrid_matrix_fields, brc_multigrid_transfer_fields, brc_multigrid_start_fields, brc_multigrid_coarse_fields,
    brc_rigid_parts_fields;
static const brc_field_table *const of_runs[] = {&brc_state_fields,
                                                 &brc_geometry_fields,
                                                 &brc_solve_fields,
                                                 &brc_mode_fields,
                                                 &brc_power_fields,
                                                 &brc_multigrid_fields,
                                                 &brc_multigrid_ground_fields,
                                                 &brc_multigrid_law_fields,
                                                 &brc_multigrid_coarsest_fields,
                                                 &brc_multigrid_finest_fields,
                                                 &brc_multigrid_aggregate_fields,
                                                 &brc_multigrid_level_fields,
                                                 &brc_multigrid_matrix_fields,
                                                 &brc_multigrid_transfer_fields,
                                                 &brc_multigrid_start_fields,
                                                 &brc_multigrid_coarse_fields,
                                                 &brc_rigid_parts_fields,
                                                 NULL};

/* The k-th of the tables, or NULL and k less by their number. */
static const brc_field_table *pick(const brc_field_table *const *tables, int *k)
{
    for (; tables && *tables; ++tables)
        if ((*k)-- == 0) return *tables;
    return NULL;
}

const brc_field_table *brc_field_table_at(int k)
{
    int n_effects, n_models;
    const brc_effect *const *effects = brc_effects(&n_effects);
    const brc_bond_model *const *models = brc_bond_models(&n_models);
    const brc_field_table *found = pick(of_runs, &k);
    for (int i = 0; i < n_effects && !found; ++i)
        found = pick(effects[i]->fields, &k);
    for (int i = 0; i < n_models && !found; ++i)
        found = pick(models[i]->fields, &k);
    return found;
}

int64_t brc_fields_planned(const brc_wants *wants, brc_field_life life)
{
    int64_t bytes = 0;
    const brc_field_table *table;
    for (int k = 0; (table = brc_field_table_at(k)); ++k)
        if (table->life == life) bytes += brc_fields_bytes(table, wants);
    return bytes;
}
