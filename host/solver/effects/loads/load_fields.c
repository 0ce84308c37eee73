/* What the loads of a stage have on the device: lists of faces and of elements, each of n things. */
#include "loads_internal.h"

#define AT(member) BRC_FIELD_AT(brc_held_faces, member)
static const brc_field_row held_element_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(element), "held elements", "-", BRC_NOT_KEPT},
    {"place", brc_each_listed, 2, BRC_FIELD_INT, NULL, AT(place), "held elements", "-", BRC_NOT_KEPT},
    {"face_start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(face_start), "held elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_held_element_fields, "held elements", BRC_LIFE_STAGE, NULL, held_element_rows);
static const brc_field_row held_face_rows[] = {
    {"area", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(area), "held face areas", "m^2", BRC_NOT_KEPT},
    {"arm", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(arm), "held face arms", "m", BRC_NOT_KEPT},
    {"spring", brc_each_listed, 1, BRC_FIELD_COEFF, NULL, AT(spring), "held face springs", "N/m", BRC_NOT_KEPT},
    {"held", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(held), "held components", "-", BRC_NOT_KEPT},
    {"value", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(value), "held faces", "m", BRC_KEPT("value", BRC_KEEP_ALL)},
    {"zero_value", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(zero_value), "held faces", "m", BRC_NOT_KEPT},
    {"reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(reaction), "reactions of held faces", "N",
     BRC_KEPT("reaction", BRC_KEEP_ALL)},
    {"last", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(last), "held faces", "m", BRC_KEPT("last", BRC_KEEP_ALL)},
    {"last_reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(last_reaction), "reactions of held faces", "N",
     BRC_KEPT("last_reaction", BRC_KEEP_ALL)},
    {"scratch", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(scratch), "reactions of held faces", "N", BRC_NOT_KEPT},
    {"work", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(work), "work of held faces", "J",
     BRC_KEPT("work", BRC_KEEP_ALL)},
    {"energy", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(energy), "energy of held faces", "J", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_held_face_fields, "held faces", BRC_LIFE_STAGE, NULL, held_face_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_held_load, member)
static const brc_field_row held_load_rows[] = {
    {"face", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(face), "held load", "-", BRC_NOT_KEPT},
    {"component", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(component), "held load", "-", BRC_NOT_KEPT},
    {"base", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(base), "held load", "m", BRC_KEPT("base", BRC_KEEP_ALL)},
    {"direction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(direction), "held load", "m", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_held_load_fields, "loads of held faces", BRC_LIFE_STAGE, NULL, held_load_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_traction_load, member)
static const brc_field_row traction_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(element), "traction", "-", BRC_NOT_KEPT},
    {"place", brc_each_listed, 2, BRC_FIELD_INT, NULL, AT(place), "traction", "-", BRC_NOT_KEPT},
    {"total", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(total), "traction", "N", BRC_NOT_KEPT},
    {"moment", brc_each_listed, 9, BRC_FIELD_COEFF, NULL, AT(moment), "traction", "N m", BRC_NOT_KEPT},
    {"last_path", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(last_path), "traction", "J",
     BRC_KEPT("reach", BRC_KEEP_ALL)},
    {"work", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(work), "work of tractions", "J",
     BRC_KEPT("work", BRC_KEEP_ALL)},
};
BRC_FIELD_TABLE(brc_traction_fields, "tractions", BRC_LIFE_STAGE, NULL, traction_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_imposed_load, member)
static const brc_field_row imposed_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(element), "imposed elements", "-", BRC_NOT_KEPT},
    {"component", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(component), "imposed elements", "-", BRC_NOT_KEPT},
    {"base", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(base), "imposed elements", "m",
     BRC_KEPT("base", BRC_KEEP_ALL)},
    {"direction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(direction), "imposed elements", "m", BRC_NOT_KEPT},
    {"reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(reaction), "reactions of imposed elements", "N",
     BRC_KEPT("reaction", BRC_KEEP_ALL)},
    {"last", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(last), "imposed elements", "m",
     BRC_KEPT("last", BRC_KEEP_ALL)},
    {"last_reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(last_reaction), "reactions of imposed elements",
     "N", BRC_KEPT("last_reaction", BRC_KEEP_ALL)},
    {"work", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(work), "work of imposed elements", "J",
     BRC_KEPT("work", BRC_KEEP_ALL)},
};
BRC_FIELD_TABLE(brc_imposed_fields, "imposed elements", BRC_LIFE_STAGE, NULL, imposed_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_push_load, member)
static const brc_field_row push_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(element), "forces on elements", "-", BRC_NOT_KEPT},
    {"total", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(total), "forces on elements", "N", BRC_NOT_KEPT},
    {"last_path", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(last_path), "forces on elements", "J",
     BRC_KEPT("reach", BRC_KEEP_ALL)},
    {"work", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(work), "work of forces on elements", "J",
     BRC_KEPT("work", BRC_KEEP_ALL)},
};
BRC_FIELD_TABLE(brc_push_fields, "forces on elements", BRC_LIFE_STAGE, NULL, push_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_turn_load, member)
static const brc_field_row turn_rows[] = {
    {"element", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(element), "turned elements", "-", BRC_NOT_KEPT},
    {"component", brc_each_listed, 3, BRC_FIELD_COEFF, NULL, AT(component), "turned elements", "-", BRC_NOT_KEPT},
    {"direction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(direction), "turned elements", "rad", BRC_NOT_KEPT},
    {"reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(reaction), "reactions of turned elements", "N m",
     BRC_KEPT("reaction", BRC_KEEP_ALL)},
    {"last_reaction", brc_each_listed, 3, BRC_FIELD_STATE, NULL, AT(last_reaction), "reactions of turned elements",
     "N m", BRC_KEPT("last_reaction", BRC_KEEP_ALL)},
    {"work", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(work), "work of turned elements", "J",
     BRC_KEPT("work", BRC_KEEP_ALL)},
};
BRC_FIELD_TABLE(brc_turn_fields, "turned elements", BRC_LIFE_STAGE, NULL, turn_rows);

brc_status brc_load_fields_create(brc_simulation *s, const brc_field_table *table, int64_t n, void *list)
{
    const brc_wants wants = brc_wants_listed(&s->wants, n);
    return brc_fields_create(s->device, table, &wants, list);
}
