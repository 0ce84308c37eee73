/* What the loads of a stage have on the device: lists of faces and of elements, each of n things. */
#include "loads_internal.h"

#define AT(member) BRC_FIELD_AT(brc_held_faces, member)
static const brc_field_row held_element_rows[] = {
    BRC_FIELD(element, brc_each_listed, 1, INT, NULL, "held elements", "-"),
    BRC_FIELD(place, brc_each_listed, 2, INT, NULL, "held elements", "-"),
    BRC_FIELD(face_start, brc_each_listed_end, 1, INT, NULL, "held elements", "-"),
    BRC_FIELD(held_of, brc_each_boundary, 1, INT, NULL, "held elements", "-"),
};
BRC_FIELD_TABLE(brc_held_element_fields, "held elements", BRC_LIFE_STAGE, NULL, held_element_rows);
static const brc_field_row held_face_rows[] = {
    BRC_FIELD(face_area, brc_each_listed, 3, COEFF, NULL, "held face areas", "m^2"),
    BRC_FIELD(arm, brc_each_listed, 3, COEFF, NULL, "held face arms", "m"),
    BRC_FIELD(spring, brc_each_listed, 1, COEFF, NULL, "held face springs", "N/m"),
    BRC_FIELD(held, brc_each_listed, 3, COEFF, NULL, "held components", "-"),
    BRC_KEPT_FIELD(value, brc_each_listed, 3, STATE, NULL, "held faces", "m", "value"),
    BRC_FIELD(zero_value, brc_each_listed, 3, STATE, NULL, "held faces", "m"),
    BRC_KEPT_FIELD(reaction, brc_each_listed, 3, STATE, NULL, "reactions of held faces", "N", "reaction"),
    BRC_KEPT_FIELD(last, brc_each_listed, 3, STATE, NULL, "held faces", "m", "last"),
    BRC_KEPT_FIELD(last_reaction, brc_each_listed, 3, STATE, NULL, "reactions of held faces", "N", "last_reaction"),
    BRC_FIELD(scratch, brc_each_listed, 3, STATE, NULL, "reactions of held faces", "N"),
    BRC_KEPT_FIELD(work, brc_each_listed, 1, STATE, NULL, "work of held faces", "J", "work"),
    BRC_FIELD(energy, brc_each_listed, 1, STATE, NULL, "energy of held faces", "J"),
};
BRC_FIELD_TABLE(brc_held_face_fields, "held faces", BRC_LIFE_STAGE, NULL, held_face_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_held_load, member)
static const brc_field_row held_load_rows[] = {
    BRC_FIELD(face, brc_each_listed, 1, INT, NULL, "held load", "-"),
    BRC_FIELD(component, brc_each_listed, 3, COEFF, NULL, "held load", "-"),
    BRC_KEPT_FIELD(base, brc_each_listed, 3, STATE, NULL, "held load", "m", "base"),
    BRC_FIELD(direction, brc_each_listed, 3, STATE, NULL, "held load", "m"),
};
BRC_FIELD_TABLE(brc_held_load_fields, "loads of held faces", BRC_LIFE_STAGE, NULL, held_load_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_traction_load, member)
static const brc_field_row traction_rows[] = {
    BRC_FIELD(element, brc_each_listed, 1, INT, NULL, "traction", "-"),
    BRC_FIELD(place, brc_each_listed, 2, INT, NULL, "traction", "-"),
    BRC_FIELD(total, brc_each_listed, 3, COEFF, NULL, "traction", "N"),
    BRC_FIELD(moment, brc_each_listed, 9, COEFF, NULL, "traction", "N m"),
    BRC_KEPT_FIELD(last_path, brc_each_listed, 1, STATE, NULL, "traction", "J", "reach"),
    BRC_KEPT_FIELD(work, brc_each_listed, 1, STATE, NULL, "work of tractions", "J", "work"),
};
BRC_FIELD_TABLE(brc_traction_fields, "tractions", BRC_LIFE_STAGE, NULL, traction_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_prescribed_load, member)
static const brc_field_row prescribed_rows[] = {
    BRC_FIELD(element, brc_each_listed, 1, INT, NULL, "imposed elements", "-"),
    BRC_FIELD(component, brc_each_listed, 3, COEFF, NULL, "imposed elements", "-"),
    BRC_KEPT_FIELD(base, brc_each_listed, 3, STATE, NULL, "imposed elements", "m", "base"),
    BRC_FIELD(direction, brc_each_listed, 3, STATE, NULL, "imposed elements", "m"),
    BRC_KEPT_FIELD(reaction, brc_each_listed, 3, STATE, NULL, "reactions of imposed elements", "N", "reaction"),
    BRC_KEPT_FIELD(last, brc_each_listed, 3, STATE, NULL, "imposed elements", "m", "last"),
    BRC_KEPT_FIELD(last_reaction, brc_each_listed, 3, STATE, NULL, "reactions of imposed elements", "N",
                   "last_reaction"),
    BRC_KEPT_FIELD(work, brc_each_listed, 1, STATE, NULL, "work of imposed elements", "J", "work"),
};
BRC_FIELD_TABLE(brc_prescribed_fields, "imposed elements", BRC_LIFE_STAGE, NULL, prescribed_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_push_load, member)
static const brc_field_row push_rows[] = {
    BRC_FIELD(element, brc_each_listed, 1, INT, NULL, "forces on elements", "-"),
    BRC_FIELD(total, brc_each_listed, 3, STATE, NULL, "forces on elements", "N"),
    BRC_KEPT_FIELD(last_path, brc_each_listed, 1, STATE, NULL, "forces on elements", "J", "reach"),
    BRC_KEPT_FIELD(work, brc_each_listed, 1, STATE, NULL, "work of forces on elements", "J", "work"),
};
BRC_FIELD_TABLE(brc_push_fields, "forces on elements", BRC_LIFE_STAGE, NULL, push_rows);

#undef AT
#define AT(member) BRC_FIELD_AT(brc_turn_load, member)
static const brc_field_row turn_rows[] = {
    BRC_FIELD(element, brc_each_listed, 1, INT, NULL, "turned elements", "-"),
    BRC_FIELD(component, brc_each_listed, 3, COEFF, NULL, "turned elements", "-"),
    BRC_FIELD(direction, brc_each_listed, 3, STATE, NULL, "turned elements", "rad"),
    BRC_KEPT_FIELD(reaction, brc_each_listed, 3, STATE, NULL, "reactions of turned elements", "N m", "reaction"),
    BRC_KEPT_FIELD(last_reaction, brc_each_listed, 3, STATE, NULL, "reactions of turned elements", "N m",
                   "last_reaction"),
    BRC_KEPT_FIELD(work, brc_each_listed, 1, STATE, NULL, "work of turned elements", "J", "work"),
};
BRC_FIELD_TABLE(brc_turn_fields, "turned elements", BRC_LIFE_STAGE, NULL, turn_rows);

brc_status brc_load_fields_create(brc_simulation *s, const brc_field_table *table, int64_t n, void *list)
{
    const brc_wants wants = brc_wants_listed(&s->wants, n);
    return brc_fields_create(s->device, table, &wants, list);
}
