/* Arrays of multigrid on the device. How many nodes and entries its levels have is known as they are made. */
#include "multigrid_internal.h"

/* Rows of the finest level; every rank has all of them. */
BRC_COUNTED(each_finest, w->layout->n_rows)
BRC_COUNTED(each_finest_element, w->domain->n_elements)
BRC_WANTED(of_beams, brc_solves_rotations(w->model))
BRC_WANTED(of_many, w->many_materials && !of_beams(w))
/* A node of coarser levels. */
BRC_WANTED(of_swelling, w->listed_unknowns == 7)
BRC_COUNTED(each_inverse, w->n_listed *(of_swelling(w) ? 28 : 21))
BRC_COUNTED(each_block, w->n_listed *(of_swelling(w) ? 49 : 36))

#define WORDS "multigrid"
#define AT(member) BRC_FIELD_AT(brc_multigrid, member)
static const brc_field_row all_rows[] = {
    {"moduli_of", each_finest, 3, BRC_FIELD_COEFF, of_many, AT(moduli_of), WORDS, "Pa", BRC_NOT_KEPT},
    {"orientation", each_finest, 4, BRC_FIELD_STATE, of_beams, AT(orientation), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_fields, WORDS, BRC_LIFE_GROWS, NULL, all_rows);
static const brc_field_row ground_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(ground_element), WORDS, "-", BRC_NOT_KEPT},
    {"block", brc_each_listed, 36, BRC_FIELD_STATE, NULL, AT(ground), WORDS, "N/m", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_ground_fields, "multigrid: held faces", BRC_LIFE_GROWS, NULL, ground_rows);
static const brc_field_row law_rows[] = {
    {"law_inverse", each_finest, 6, BRC_FIELD_STATE, NULL, AT(law_inverse), WORDS, "m/N", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_law_fields, "multigrid: steps of the law", BRC_LIFE_GROWS, NULL, law_rows);
static const brc_field_row coarsest_rows[] = {
    {"inverse", each_block, 1, BRC_FIELD_STATE, NULL, AT(inverse), WORDS, "m/N", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_coarsest_fields, "multigrid: coarsest level", BRC_LIFE_GROWS, NULL, coarsest_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_level, member)
#define VECTORS(name, member, count)                                                                                   \
    {name, count, 3, BRC_FIELD_STATE, NULL, AT(member.move), WORDS, "-", BRC_NOT_KEPT},                                \
    {                                                                                                                  \
        name "_turn", count, 3, BRC_FIELD_STATE, NULL, AT(member.turn), WORDS, "-", BRC_NOT_KEPT                       \
    }
#define OF_LEVEL(count)                                                                                                \
    VECTORS("right", right, count), VECTORS("x", x, count), VECTORS("left", left, count), VECTORS("step", step, count)
#define SWELLING(name, member)                                                                                         \
    {                                                                                                                  \
        name "_swell", brc_each_listed, 1, BRC_FIELD_STATE, of_swelling, AT(member.swell), WORDS, "-", BRC_NOT_KEPT    \
    }
static const brc_field_row finest_rows[] = {
    {"inverse", each_finest, 21, BRC_FIELD_STATE, NULL, AT(inverse), WORDS, "m/N", BRC_NOT_KEPT},
    OF_LEVEL(each_finest),
    {"free_bits", each_finest, 1, BRC_FIELD_INT, NULL, AT(free_bits), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_finest_fields, "multigrid: finest level", BRC_LIFE_GROWS, NULL, finest_rows);
static const brc_field_row aggregate_rows[] = {
    {"aggregate", each_finest, 1, BRC_FIELD_INT, NULL, AT(aggregate), WORDS, "-", BRC_NOT_KEPT},
    {"arm", each_finest, 3, BRC_FIELD_COEFF, NULL, AT(arm), WORDS, "m", BRC_NOT_KEPT},
    {"member", each_finest_element, 1, BRC_FIELD_INT, NULL, AT(member), WORDS, "-", BRC_NOT_KEPT},
    {"start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(member_start), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_aggregate_fields, "multigrid: aggregates", BRC_LIFE_GROWS, NULL, aggregate_rows);
static const brc_field_row level_rows[] = {
    {"inverse", each_inverse, 1, BRC_FIELD_STATE, NULL, AT(inverse), WORDS, "m/N", BRC_NOT_KEPT},
    OF_LEVEL(brc_each_listed),
    SWELLING("right", right),
    SWELLING("x", x),
    SWELLING("left", left),
    SWELLING("step", step),
    {"start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(start), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_level_fields, "multigrid: nodes of a level", BRC_LIFE_GROWS, NULL, level_rows);
static const brc_field_row matrix_rows[] = {
    {"column", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(column), WORDS, "-", BRC_NOT_KEPT},
    {"block", each_block, 1, BRC_FIELD_STATE, NULL, AT(block), WORDS, "N/m", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_matrix_fields, "multigrid: matrix of a level", BRC_LIFE_GROWS, NULL, matrix_rows);
static const brc_field_row transfer_rows[] = {
    {"column", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(p_column), WORDS, "-", BRC_NOT_KEPT},
    {"block", each_block, 1, BRC_FIELD_STATE, NULL, AT(p_block), WORDS, "-", BRC_NOT_KEPT},
    {"place", brc_each_listed, 2, BRC_FIELD_INT, NULL, AT(p_entry), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_transfer_fields, "multigrid: transfer", BRC_LIFE_GROWS, NULL, transfer_rows);
static const brc_field_row start_rows[] = {
    {"start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(p_start), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_start_fields, "multigrid: transfer by nodes", BRC_LIFE_GROWS, NULL, start_rows);
static const brc_field_row coarse_rows[] = {
    {"column_start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(p_column_start), WORDS, "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_multigrid_coarse_fields, "multigrid: transfer by coarse nodes", BRC_LIFE_GROWS, NULL, coarse_rows);

brc_status brc_multigrid_list(const brc_multigrid *m, const brc_field_table *table, int64_t n, void *owner)
{
    brc_wants wants = brc_wants_listed(&m->s->wants, n);
    wants.listed_unknowns = m->coarse_unknowns;
    return brc_fields_create(m->s->device, table, &wants, owner);
}

void brc_multigrid_fields_free(brc_multigrid *m)
{
    static const brc_field_table *const of_level[] = {&brc_multigrid_finest_fields,   &brc_multigrid_aggregate_fields,
                                                      &brc_multigrid_level_fields,    &brc_multigrid_matrix_fields,
                                                      &brc_multigrid_transfer_fields, &brc_multigrid_start_fields,
                                                      &brc_multigrid_coarse_fields};
    for (int i = 0; i < BRC_MOST_LEVELS; ++i)
        for (size_t k = 0; k < sizeof of_level / sizeof *of_level; ++k)
            brc_fields_free(of_level[k], &m->level[i]);
    brc_fields_free(&brc_multigrid_fields, m);
    brc_fields_free(&brc_multigrid_ground_fields, m);
    brc_fields_free(&brc_multigrid_law_fields, m);
    brc_fields_free(&brc_multigrid_coarsest_fields, m);
}
