/* Every table of fields there is. */
#include "fields.h"

/* clang-format off: one table a line */
#define TABLES(X)                                                                                                      \
    X(brc_state_fields)                                                                                                \
    X(brc_geometry_fields)                                                                                             \
    X(brc_break_fields)                                                                                                \
    X(brc_criterion_fields)                                                                                            \
    X(brc_cell_break_fields)                                                                                           \
    X(brc_ring_fields)                                                                                                 \
    X(brc_ring_list_fields)                                                                                            \
    X(brc_softening_fields)                                                                                            \
    X(brc_open_list_fields)                                                                                            \
    X(brc_beam_softening_fields)                                                                                       \
    X(brc_closed_face_fields)                                                                                          \
    X(brc_beam_closure_fields)                                                                                         \
    X(brc_striker_fields)                                                                                              \
    X(brc_contact_fields)                                                                                              \
    X(brc_contact_sum_fields)                                                                                          \
    X(brc_contact_slot_fields)                                                                                         \
    X(brc_contact_old_slot_fields)                                                                                     \
    X(brc_contact_grid_fields)                                                                                         \
    X(brc_contact_bucket_fields)                                                                                       \
    X(brc_contact_listed_fields)                                                                                       \
    X(brc_contact_old_listed_fields)                                                                                   \
    X(brc_contact_entry_fields)                                                                                        \
    X(brc_contact_pair_fields)                                                                                         \
    X(brc_contact_result_fields)                                                                                       \
    X(brc_contact_part_fields)                                                                                         \
    X(brc_contact_packed_at_fields)                                                                                    \
    X(brc_contact_packed_fields)                                                                                       \
    X(brc_contact_changed_fields)                                                                                      \
    X(brc_bonded_list_fields)                                                                                          \
    X(brc_noise_fields)                                                                                                \
    X(brc_guard_fields)                                                                                                \
    X(brc_held_element_fields)                                                                                         \
    X(brc_held_face_fields)                                                                                            \
    X(brc_held_load_fields)                                                                                            \
    X(brc_traction_fields)                                                                                             \
    X(brc_imposed_fields)                                                                                              \
    X(brc_push_fields)                                                                                                 \
    X(brc_turn_fields)                                                                                                 \
    X(brc_solve_fields)                                                                                                \
    X(brc_mode_fields)                                                                                                 \
    X(brc_power_fields)
/* clang-format on */
#define DECLARE(table) extern const brc_field_table table;
TABLES(DECLARE)
#define PLACE(table) &table,
static const brc_field_table *const tables[] = {TABLES(PLACE)};

const brc_field_table *const *brc_field_tables(int *n)
{
    *n = (int)(sizeof tables / sizeof *tables);
    return tables;
}

int64_t brc_fields_planned(const brc_wants *wants, brc_field_life life)
{
    int64_t bytes = 0;
    for (size_t k = 0; k < sizeof tables / sizeof *tables; ++k)
        if (tables[k]->life == life) bytes += brc_fields_bytes(tables[k], wants);
    return bytes;
}
