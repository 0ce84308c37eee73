/* What contact has on the device. */
#include "contact_internal.h"
#include "../strikers/striker_contact.h"

/* ---- what is known from the start ---- */

BRC_WANTED(contact, w->scene->has_contact)
BRC_WANTED(detaching, brc_wants_deforming(w) && w->loose)
BRC_COUNTED(each_piece, w->pieces ? w->pieces->n : 0)
BRC_COUNTED(each_solid, w->layout->n_rows + each_piece(w))
BRC_COUNTED(each_shape, w->domain->n_elements + each_piece(w))
BRC_COUNTED(each_shape_end, each_shape(w) + 1)
BRC_COUNTED(each_law, (int64_t)w->scene->n_materials * w->scene->n_materials)

/* Polyhedra of cells, of which a face is a plane with its place in the list of loops, and of pieces. By Euler's formula
 * the loops of V corners and F faces have 2 (V + F - 2) numbers. */
BRC_COUNTED(cell_corners, brc_wants_spheres(w) ? 0 : w->domain->vertex_start[w->domain->n_elements])
BRC_COUNTED(cell_faces, brc_wants_spheres(w) ? 0 : w->domain->n_half_edges + w->domain->n_free_faces)
BRC_COUNTED(cell_loops, brc_wants_spheres(w) ? 0 : 2 * (cell_corners(w) + cell_faces(w) - 2 * w->domain->n_elements))
BRC_COUNTED(each_corner, cell_corners(w) + (each_piece(w) ? w->pieces->corner_start[w->pieces->n] : 0))
BRC_COUNTED(each_face, cell_faces(w) + (each_piece(w) ? w->pieces->face_start[w->pieces->n] : 0))
BRC_COUNTED(each_face_end, each_face(w) + 1)
BRC_COUNTED(each_loop, cell_loops(w) + (each_piece(w) ? w->pieces->loop_start[w->pieces->face_start[w->pieces->n]] : 0))
BRC_COUNTED(each_drift, brc_blocks(w->layout->n_rows, BRC_CONTACT_BLOCK))
BRC_COUNTED(each_survey, each_drift(w) + each_piece(w))
/* Blocks of the largest scan there is: of rows, of the digits of all rows, or of the pairs. */
static int64_t each_sum(const brc_wants *w)
{
    const int64_t n = w->layout->n_rows, digits = BRC_SORT_BINS * brc_scan_blocks(n), rows = n > digits ? n : digits;
    return brc_scan_blocks(w->n_listed > rows ? w->n_listed : rows) + BRC_SCAN_TOTALS;
}

#define AT(member) BRC_FIELD_AT(brc_contact_state, member)
static const brc_field_row rows[] = {
    BRC_FIELD(id, each_solid, 1, INT, NULL, "ids of elements", "-"),
    BRC_FIELD(body, brc_each_row, 1, INT, NULL, "bodies of elements", "-"),
    BRC_FIELD(material, each_solid, 1, INT, NULL, "materials of elements", "-"),
    BRC_FIELD(mass, each_solid, 1, STATE, NULL, "masses of elements", "kg"),
    {"size", each_solid, 1, BRC_FIELD_STATE, NULL, AT(size_of), "sizes of elements", "m", BRC_NOT_KEPT},
    BRC_FIELD(bears, each_solid, 4, STATE, brc_wants_cells, "stiffness that surfaces bear", "N/m^5, N/m"),
    BRC_FIELD(bounding_radius, brc_each_row, 1, STATE, NULL, "radii of elements", "m"),
    BRC_FIELD(place, brc_each_row, 3, STATE, NULL, "places of elements", "m"),
    BRC_KEPT_FIELD(exposed, brc_each_row, 1, INT, NULL, "exposed elements", "-", "contact.exposed"),
    BRC_FIELD(original, brc_each_entry, 1, INT, NULL, "bonds at the start", "-"),
    BRC_FIELD(law, each_law, BRC_CONTACT_LAW, STATE, NULL, "laws of contact", "-"),
    BRC_KEPT_FIELD(stored, brc_each_row, 1, STATE, NULL, "energy of contact", "J", "contact.stored"),
    BRC_KEPT_FIELD(lost_friction, brc_each_row, 1, STATE, NULL, "energy lost to friction", "J", "contact.friction"),
    BRC_KEPT_FIELD(lost_impact, brc_each_row, 1, STATE, NULL, "energy lost to damping of contact", "J",
                   "contact.impact"),
    BRC_FIELD(corner, each_corner, 3, STATE, NULL, "polyhedra", "m"),
    BRC_FIELD(plane, each_face, 4, STATE, NULL, "polyhedra", "-, m"),
    BRC_FIELD(radius, each_shape, 1, STATE, NULL, "polyhedra", "m"),
    BRC_FIELD(corner_start, each_shape_end, 1, INT, NULL, "polyhedra", "-"),
    BRC_FIELD(face_start, each_shape_end, 1, INT, NULL, "polyhedra", "-"),
    BRC_FIELD(loop_start, each_face_end, 1, INT, NULL, "polyhedra", "-"),
    BRC_FIELD(loop, each_loop, 1, INT, NULL, "polyhedra", "-"),
    BRC_FIELD(piece_striker, each_piece, 1, INT, NULL, "pieces of strikers", "-"),
    BRC_FIELD(piece_kind, each_piece, 1, INT, NULL, "pieces of strikers", "-"),
    BRC_FIELD(piece_radius, each_piece, 1, STATE, NULL, "pieces of strikers", "m"),
    BRC_FIELD(piece_own, each_piece, 4, STATE, NULL, "pieces of strikers", "m"),
    BRC_KEPT_FIELD(piece, each_piece, 4, STATE, NULL, "pieces of strikers", "m", "contact.pieces"),
    BRC_KEPT_FIELD(rigid, brc_each_row, 1, INT, NULL, "rigid cells", "-", "contact.rigid"),
    BRC_FIELD(loaded, brc_each_row, 1, INT, detaching, "cells with loaded faces", "-"),
    BRC_FIELD(inertia, brc_each_row, 6, STATE, detaching, "inertia of cells", "kg m^2"),
    BRC_KEPT_FIELD(turned, brc_each_row, 4, STATE, detaching, "orientations of cells", "-", "contact.turned"),
    BRC_KEPT_FIELD(momentum, brc_each_row, 3, STATE, detaching, "angular momenta of cells", "kg m^2/s",
                   "contact.momentum"),
    BRC_KEPT_FIELD(torque, brc_each_row, 3, STATE, detaching, "torques on cells", "N m", "contact.torque"),
    BRC_KEPT_FIELD(way, brc_each_row, 1, STATE, detaching, "turning of cells", "m", "contact.way"),
    BRC_KEPT_FIELD(built, brc_each_row, 4, STATE, NULL, "places of the last search", "m", "contact.built"),
    BRC_KEPT_FIELD(posed, brc_each_row, 9, STATE, brc_wants_cells, "poses of the last search", "-", "contact.posed"),
    BRC_FIELD(clear, brc_each_row, 1, STATE, NULL, "ways to pieces of strikers", "m"),
    BRC_FIELD(moved, each_survey, BRC_CONTACT_MOVED, STATE, NULL, "moves since the last search", "-"),
    {"part", each_drift, BRC_CONTACT_PART, BRC_FIELD_STATE, NULL, AT(drift_part), "moves since the last search", "-",
     BRC_NOT_KEPT},
    BRC_FIELD(drift, brc_each_once, BRC_CONTACT_DRIFT, STATE, NULL, "moves since the last search", "-"),
    BRC_FIELD(seen, brc_each_row, 1, INT, NULL, "exposed elements", "-"),
    BRC_FIELD(fresh, brc_each_row, 1, INT, NULL, "exposed elements", "-"),
};
BRC_FIELD_TABLE(brc_contact_fields, "contact", BRC_LIFE_RUN, contact, rows);
static const brc_field_row sum_rows[] = {
    {"sum", each_sum, 1, BRC_FIELD_INT, NULL, AT(sums), "running sums", "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_contact_sum_fields, "running sums of contact", BRC_LIFE_RUN, contact, sum_rows);

/* ---- what the search needs for exposed elements ---- */

BRC_COUNTED(each_exposed, w->exposed_room)
BRC_COUNTED(each_exposed_end, w->exposed_room + 1)
BRC_COUNTED(digits, BRC_SORT_BINS *brc_scan_blocks(w->exposed_room))
BRC_COUNTED(each_digit_end, digits(w) + 1)
BRC_COUNTED(each_count, w->exposed_room > digits(w) ? w->exposed_room : digits(w))
BRC_COUNTED(each_bucket, w->bucket_room)

static const brc_field_row grid_rows[] = {
    BRC_FIELD(key, each_exposed, 1, INT, NULL, "grid of contact", "-"),
    {"key_out", each_exposed, 1, BRC_FIELD_INT, NULL, AT(key) + sizeof(brc_buffer *), "grid of contact", "-",
     BRC_NOT_KEPT},
    BRC_FIELD(row, each_exposed, 1, INT, NULL, "grid of contact", "-"),
    {"row_out", each_exposed, 1, BRC_FIELD_INT, NULL, AT(row) + sizeof(brc_buffer *), "grid of contact", "-",
     BRC_NOT_KEPT},
    BRC_FIELD(count, each_count, 1, INT, NULL, "grid of contact", "-"),
    BRC_FIELD(digits, each_digit_end, 1, INT, NULL, "grid of contact", "-"),
    BRC_FIELD(owned, each_exposed, 1, INT, NULL, "pairs of elements", "-"),
    BRC_FIELD(pair_start, each_exposed_end, 1, INT, NULL, "pairs of elements", "-"),
    BRC_FIELD(again, each_exposed, 1, INT, NULL, "pairs of elements", "-"),
    BRC_FIELD(redo, each_exposed, 1, INT, NULL, "pairs of elements", "-"),
};
BRC_FIELD_TABLE(brc_contact_grid_fields, "grid of contact", BRC_LIFE_SEARCH, contact, grid_rows);
static const brc_field_row bucket_rows[] = {
    BRC_FIELD(first, each_bucket, 1, INT, NULL, "grid of contact", "-"),
    BRC_FIELD(last, each_bucket, 1, INT, NULL, "grid of contact", "-"),
};
BRC_FIELD_TABLE(brc_contact_bucket_fields, "cells of the grid of contact", BRC_LIFE_SEARCH, contact, bucket_rows);

#define OF_LIST(member) BRC_FIELD_AT(brc_contact_list, member)
static const brc_field_row slot_rows[] = {
    {"slot_of", brc_each_row_end, 1, BRC_FIELD_INT, NULL, OF_LIST(slot_of), "exposed elements", "-", BRC_NOT_KEPT}};
static const brc_field_row listed_rows[] = {
    {"list", each_exposed, 1, BRC_FIELD_INT, NULL, OF_LIST(list), "exposed elements", "-", BRC_NOT_KEPT},
    {"with_pairs", each_exposed, 1, BRC_FIELD_INT, NULL, OF_LIST(with_pairs), "exposed elements", "-", BRC_NOT_KEPT},
    {"start", each_exposed_end, 1, BRC_FIELD_INT, NULL, OF_LIST(start), "pairs of elements", "-", BRC_NOT_KEPT},
    {"used", each_exposed, 1, BRC_FIELD_INT, NULL, OF_LIST(used), "pairs of elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_contact_slot_fields, "places in the list", BRC_LIFE_RUN, contact, slot_rows);
BRC_FIELD_TABLE(brc_contact_old_slot_fields, "places in the list before", BRC_LIFE_RUN, contact, slot_rows);
BRC_FIELD_TABLE(brc_contact_listed_fields, "list of exposed elements", BRC_LIFE_SEARCH, contact, listed_rows);
BRC_FIELD_TABLE(brc_contact_old_listed_fields, "list of exposed elements before", BRC_LIFE_SEARCH, contact,
                listed_rows);

/* ---- what is near what: not known before ---- */

BRC_COUNTED(each_result, w->n_listed *(BRC_CONTACT_RESULT + 2 * (brc_wants_deforming(w) ? 9 : 3)))

static const brc_field_row entry_rows[] = {
    {"entry", brc_each_listed, 1, BRC_FIELD_INT, NULL, OF_LIST(entry), "pairs of elements", "-", BRC_NOT_KEPT},
    {"pair", brc_each_listed, 1, BRC_FIELD_INT, NULL, OF_LIST(pair), "pairs of elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_contact_entry_fields, "entries of contact", BRC_LIFE_GROWS, contact, entry_rows);
static const brc_field_row pair_rows[] = {
    {"ends", brc_each_listed, 2, BRC_FIELD_INT, NULL, OF_LIST(ends), "pairs", "-", BRC_NOT_KEPT},
    {"history", brc_each_listed, BRC_CONTACT_HISTORY, BRC_FIELD_STATE, NULL, OF_LIST(history), "history of pairs", "-",
     BRC_KEPT("contact.history", BRC_KEEP_ALL)},
};
BRC_FIELD_TABLE(brc_contact_pair_fields, "pairs", BRC_LIFE_GROWS, contact, pair_rows);
static const brc_field_row result_rows[] = {
    BRC_FIELD(touch, brc_each_listed, 1, INT, NULL, "pairs that touch", "-"),
    BRC_FIELD(result, each_result, 1, STATE, NULL, "forces of pairs", "-"),
};
BRC_FIELD_TABLE(brc_contact_result_fields, "forces of pairs", BRC_LIFE_GROWS, contact, result_rows);
static const brc_field_row part_rows[] = {BRC_FIELD(part, brc_each_listed, 1, STATE, NULL, "forces on strikers", "-")};
BRC_FIELD_TABLE(brc_contact_part_fields, "forces on strikers", BRC_LIFE_GROWS, contact, part_rows);
static const brc_field_row packed_at_rows[] = {
    BRC_FIELD(packed_at, brc_each_listed_end, 1, INT, NULL, "pairs that touch", "-")};
BRC_FIELD_TABLE(brc_contact_packed_at_fields, "pairs that go over", BRC_LIFE_GROWS, contact, packed_at_rows);
static const brc_field_row packed_rows[] = {
    BRC_FIELD(packed, each_result, 1, STATE, NULL, "forces of pairs that touch", "-")};
BRC_FIELD_TABLE(brc_contact_packed_fields, "forces of pairs that go over", BRC_LIFE_GROWS, contact, packed_rows);
static const brc_field_row changed_rows[] = {
    BRC_FIELD(flag, brc_each_listed, 1, INT, NULL, "changed pairs", "-"),
    BRC_FIELD(flag_start, brc_each_listed_end, 1, INT, NULL, "changed pairs", "-"),
    BRC_FIELD(todo, brc_each_listed, 1, INT, NULL, "changed pairs", "-"),
};
BRC_FIELD_TABLE(brc_contact_changed_fields, "changed pairs", BRC_LIFE_GROWS, contact, changed_rows);

void brc_contact_fields_free(brc_contact_state *c)
{
    const brc_field_table *const own[] = {
        &brc_contact_fields,           &brc_contact_sum_fields,    &brc_contact_grid_fields,
        &brc_contact_bucket_fields,    &brc_contact_result_fields, &brc_contact_part_fields,
        &brc_contact_packed_at_fields, &brc_contact_packed_fields, &brc_contact_changed_fields};
    const brc_field_table *const of_list[] = {&brc_contact_slot_fields, &brc_contact_listed_fields,
                                              &brc_contact_entry_fields, &brc_contact_pair_fields};
    for (size_t k = 0; k < sizeof own / sizeof *own; ++k)
        brc_fields_free(own[k], c);
    for (size_t k = 0; k < sizeof of_list / sizeof *of_list; ++k) {
        brc_fields_free(of_list[k], &c->now);
        brc_fields_free(of_list[k], &c->before);
    }
}

int64_t brc_contact_room(int64_t n)
{
    return n + n / 8;
}

int64_t brc_contact_exposed_room(const brc_wants *w, int64_t n)
{
    return brc_contact_room(n) < w->layout->n_rows ? brc_contact_room(n) : w->layout->n_rows;
}

int64_t brc_contact_buckets(int64_t n)
{
    int64_t buckets = BRC_SORT_BINS;
    while (buckets < 2 * n)
        buckets *= 2;
    return buckets;
}

#define OLD(member) BRC_VALUE_BUFFER, OF_LIST(member)
void brc_contact_scopes_make(const brc_simulation *s, brc_contact_scopes *out)
{
    static const brc_value_row of_contact[] = {{"middle_x", BRC_VALUE_REAL, AT(middle[0])},
                                               {"middle_y", BRC_VALUE_REAL, AT(middle[1])},
                                               {"middle_z", BRC_VALUE_REAL, AT(middle[2])},
                                               {"n_pieces", BRC_VALUE_INT, AT(n_pieces)},
                                               {"pose", BRC_VALUE_INT, AT(pose)},
                                               {"skin", BRC_VALUE_REAL, AT(skin)},
                                               {"span", BRC_VALUE_REAL, AT(span)},
                                               {"affine", BRC_VALUE_BOOL, AT(affine)},
                                               {"is_linear", BRC_VALUE_BOOL, AT(is_linear)},
                                               {"turn", BRC_VALUE_BUFFER, AT(torque)}};
    static const brc_value_row of_scene[] = {{"n_materials", BRC_VALUE_INT, offsetof(brc_scene, n_materials)},
                                             {"within", BRC_VALUE_BOOL, offsetof(brc_scene, contact.within)}};
    static const brc_value_row of_before[] = {{"old_slot_of", OLD(slot_of)}, {"old_start", OLD(start)},
                                              {"old_used", OLD(used)},       {"old_entry", OLD(entry)},
                                              {"old_pair", OLD(pair)},       {"old_history", OLD(history)}};
    static const brc_value_row of_now[] = {{"listed", OLD(list)}};
    const brc_contact_state *c = s->contact;
    out->run = brc_scope_of_run(s);
    out->scene = (brc_scope){.owner = "scene", .base = s->scene, BRC_VALUES(of_scene), .outer = &out->run};
    out->strikers = brc_scope_of_strikers(s, &out->scene);
    out->contact =
        (brc_scope){.owner = "contact",
                    .base = c,
                    .tables = {&brc_contact_fields, &brc_contact_sum_fields, &brc_contact_grid_fields,
                               &brc_contact_bucket_fields, &brc_contact_result_fields, &brc_contact_packed_at_fields,
                               &brc_contact_packed_fields, &brc_contact_changed_fields},
                    BRC_VALUES(of_contact),
                    .outer = &out->strikers};
    out->now = (brc_scope){.owner = "list of pairs",
                           .base = &c->now,
                           .tables = {&brc_contact_slot_fields, &brc_contact_listed_fields, &brc_contact_entry_fields,
                                      &brc_contact_pair_fields},
                           BRC_VALUES(of_now),
                           .outer = &out->contact};
    out->before =
        (brc_scope){.owner = "list of pairs before", .base = &c->before, BRC_VALUES(of_before), .outer = &out->now};
    out->state = brc_scope_of_run(s);
    out->state.outer = &out->before;
}
