/* What contact has on the device. */
#include "contact_internal.h"
#include "../strikers/striker_contact.h"

/* ---- what is known from the start ---- */

static bool contact(const brc_wants *w)
{
    return w->scene->has_contact;
}
static bool detaching(const brc_wants *w)
{
    return brc_wants_deforming(w) && w->loose;
}

static int64_t each_piece(const brc_wants *w)
{
    return w->pieces ? w->pieces->n : 0;
}
static int64_t each_solid(const brc_wants *w)
{
    return w->layout->n_rows + each_piece(w);
}
static int64_t each_shape(const brc_wants *w)
{
    return w->domain->n_elements + each_piece(w);
}
static int64_t each_shape_end(const brc_wants *w)
{
    return each_shape(w) + 1;
}
static int64_t each_law(const brc_wants *w)
{
    return (int64_t)w->scene->n_materials * w->scene->n_materials;
}

/* Polyhedra of cells, of which a face is a plane with its place in the list of loops, and of pieces. By Euler's formula
 * the loops of V corners and F faces have 2 (V + F - 2) numbers. */
static int64_t cell_corners(const brc_wants *w)
{
    return brc_wants_spheres(w) ? 0 : w->domain->vertex_start[w->domain->n_elements];
}
static int64_t cell_faces(const brc_wants *w)
{
    return brc_wants_spheres(w) ? 0 : w->domain->n_half_edges + w->domain->n_free_faces;
}
static int64_t cell_loops(const brc_wants *w)
{
    return brc_wants_spheres(w) ? 0 : 2 * (cell_corners(w) + cell_faces(w) - 2 * w->domain->n_elements);
}
static int64_t each_corner(const brc_wants *w)
{
    return cell_corners(w) + (each_piece(w) ? w->pieces->corner_start[w->pieces->n] : 0);
}
static int64_t each_face(const brc_wants *w)
{
    return cell_faces(w) + (each_piece(w) ? w->pieces->face_start[w->pieces->n] : 0);
}
static int64_t each_face_end(const brc_wants *w)
{
    return each_face(w) + 1;
}
static int64_t each_loop(const brc_wants *w)
{
    return cell_loops(w) + (each_piece(w) ? w->pieces->loop_start[w->pieces->face_start[w->pieces->n]] : 0);
}

static int64_t each_drift(const brc_wants *w)
{
    return brc_blocks(w->layout->n_rows, BRC_CONTACT_BLOCK);
}
static int64_t each_survey(const brc_wants *w)
{
    return each_drift(w) + each_piece(w);
}
/* Blocks of the largest scan there is: of rows, of the digits of all rows, or of the pairs. */
static int64_t each_sum(const brc_wants *w)
{
    const int64_t n = w->layout->n_rows, digits = BRC_SORT_BINS * brc_scan_blocks(n), rows = n > digits ? n : digits;
    return brc_scan_blocks(w->n_listed > rows ? w->n_listed : rows) + 1;
}

#define AT(member) BRC_FIELD_AT(brc_contact_state, member)
static const brc_field_row rows[] = {
    {"id", each_solid, 1, BRC_FIELD_INT, NULL, AT(id), "ids of elements", "-", BRC_NOT_KEPT},
    {"body", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(body), "bodies of elements", "-", BRC_NOT_KEPT},
    {"material", each_solid, 1, BRC_FIELD_INT, NULL, AT(material), "materials of elements", "-", BRC_NOT_KEPT},
    {"mass", each_solid, 1, BRC_FIELD_STATE, NULL, AT(mass), "masses of elements", "kg", BRC_NOT_KEPT},
    {"size", each_solid, 1, BRC_FIELD_STATE, NULL, AT(size_of), "sizes of elements", "m", BRC_NOT_KEPT},
    {"bounding_radius", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(bounding_radius), "radii of elements", "m",
     BRC_NOT_KEPT},
    {"place", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(place), "places of elements", "m", BRC_NOT_KEPT},
    {"exposed", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(exposed), "exposed elements", "-",
     BRC_KEPT("contact.exposed", BRC_KEEP_ALL)},
    {"original", brc_each_entry, 1, BRC_FIELD_INT, NULL, AT(original), "bonds at the start", "-", BRC_NOT_KEPT},
    {"law", each_law, BRC_CONTACT_LAW, BRC_FIELD_STATE, NULL, AT(law), "laws of contact", "-", BRC_NOT_KEPT},
    {"stored", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(stored), "energy of contact", "J",
     BRC_KEPT("contact.stored", BRC_KEEP_ALL)},
    {"lost_friction", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(lost_friction), "energy lost to friction", "J",
     BRC_KEPT("contact.friction", BRC_KEEP_ALL)},
    {"lost_impact", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(lost_impact), "energy lost to damping of contact", "J",
     BRC_KEPT("contact.impact", BRC_KEEP_ALL)},
    {"corner", each_corner, 3, BRC_FIELD_STATE, NULL, AT(corner), "polyhedra", "m", BRC_NOT_KEPT},
    {"plane", each_face, 4, BRC_FIELD_STATE, NULL, AT(plane), "polyhedra", "-, m", BRC_NOT_KEPT},
    {"radius", each_shape, 1, BRC_FIELD_STATE, NULL, AT(radius), "polyhedra", "m", BRC_NOT_KEPT},
    {"corner_start", each_shape_end, 1, BRC_FIELD_INT, NULL, AT(corner_start), "polyhedra", "-", BRC_NOT_KEPT},
    {"face_start", each_shape_end, 1, BRC_FIELD_INT, NULL, AT(face_start), "polyhedra", "-", BRC_NOT_KEPT},
    {"loop_start", each_face_end, 1, BRC_FIELD_INT, NULL, AT(loop_start), "polyhedra", "-", BRC_NOT_KEPT},
    {"loop", each_loop, 1, BRC_FIELD_INT, NULL, AT(loop), "polyhedra", "-", BRC_NOT_KEPT},
    {"piece_striker", each_piece, 1, BRC_FIELD_INT, NULL, AT(piece_striker), "pieces of strikers", "-", BRC_NOT_KEPT},
    {"piece_kind", each_piece, 1, BRC_FIELD_INT, NULL, AT(piece_kind), "pieces of strikers", "-", BRC_NOT_KEPT},
    {"piece_radius", each_piece, 1, BRC_FIELD_STATE, NULL, AT(piece_radius), "pieces of strikers", "m", BRC_NOT_KEPT},
    {"piece_own", each_piece, 4, BRC_FIELD_STATE, NULL, AT(piece_own), "pieces of strikers", "m", BRC_NOT_KEPT},
    {"piece", each_piece, 4, BRC_FIELD_STATE, NULL, AT(piece), "pieces of strikers", "m",
     BRC_KEPT("contact.pieces", BRC_KEEP_ALL)},
    {"rigid", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(rigid), "rigid cells", "-",
     BRC_KEPT("contact.rigid", BRC_KEEP_ALL)},
    {"loaded", brc_each_row, 1, BRC_FIELD_INT, detaching, AT(loaded), "cells with loaded faces", "-", BRC_NOT_KEPT},
    {"inertia", brc_each_row, 6, BRC_FIELD_STATE, detaching, AT(inertia), "inertia of cells", "kg m^2", BRC_NOT_KEPT},
    {"turned", brc_each_row, 4, BRC_FIELD_STATE, detaching, AT(turned), "orientations of cells", "-",
     BRC_KEPT("contact.turned", BRC_KEEP_ALL)},
    {"momentum", brc_each_row, 3, BRC_FIELD_STATE, detaching, AT(momentum), "angular momenta of cells", "kg m^2/s",
     BRC_KEPT("contact.momentum", BRC_KEEP_ALL)},
    {"torque", brc_each_row, 3, BRC_FIELD_STATE, detaching, AT(torque), "torques on cells", "N m",
     BRC_KEPT("contact.torque", BRC_KEEP_ALL)},
    {"way", brc_each_row, 1, BRC_FIELD_STATE, detaching, AT(way), "turning of cells", "m",
     BRC_KEPT("contact.way", BRC_KEEP_ALL)},
    {"built", brc_each_row, 4, BRC_FIELD_STATE, NULL, AT(built), "places of the last search", "m",
     BRC_KEPT("contact.built", BRC_KEEP_ALL)},
    {"posed", brc_each_row, 9, BRC_FIELD_STATE, brc_wants_cells, AT(posed), "poses of the last search", "-",
     BRC_KEPT("contact.posed", BRC_KEEP_ALL)},
    {"clear", brc_each_row, 1, BRC_FIELD_STATE, NULL, AT(clear), "ways to pieces of strikers", "m", BRC_NOT_KEPT},
    {"moved", each_survey, BRC_CONTACT_MOVED, BRC_FIELD_STATE, NULL, AT(moved), "moves since the last search", "-",
     BRC_NOT_KEPT},
    {"part", each_drift, BRC_CONTACT_PART, BRC_FIELD_STATE, NULL, AT(drift_part), "moves since the last search", "-",
     BRC_NOT_KEPT},
    {"drift", brc_each_once, BRC_CONTACT_DRIFT, BRC_FIELD_STATE, NULL, AT(drift), "moves since the last search", "-",
     BRC_NOT_KEPT},
    {"seen", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(seen), "exposed elements", "-", BRC_NOT_KEPT},
    {"fresh", brc_each_row, 1, BRC_FIELD_INT, NULL, AT(fresh), "exposed elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_contact_fields, "contact", BRC_LIFE_RUN, contact, rows);
static const brc_field_row sum_rows[] = {
    {"sum", each_sum, 1, BRC_FIELD_INT, NULL, AT(sums), "running sums", "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_contact_sum_fields, "running sums of contact", BRC_LIFE_RUN, contact, sum_rows);

/* ---- what the search needs for exposed elements ---- */

static int64_t each_exposed(const brc_wants *w)
{
    return w->exposed_room;
}
static int64_t each_exposed_end(const brc_wants *w)
{
    return w->exposed_room + 1;
}
static int64_t digits(const brc_wants *w)
{
    return BRC_SORT_BINS * brc_scan_blocks(w->exposed_room);
}
static int64_t each_digit_end(const brc_wants *w)
{
    return digits(w) + 1;
}
static int64_t each_count(const brc_wants *w)
{
    return w->exposed_room > digits(w) ? w->exposed_room : digits(w);
}
static int64_t each_bucket(const brc_wants *w)
{
    return w->bucket_room;
}

static const brc_field_row grid_rows[] = {
    {"key", each_exposed, 1, BRC_FIELD_INT, NULL, AT(key), "grid of contact", "-", BRC_NOT_KEPT},
    {"key_out", each_exposed, 1, BRC_FIELD_INT, NULL, AT(key) + sizeof(brc_buffer *), "grid of contact", "-",
     BRC_NOT_KEPT},
    {"row", each_exposed, 1, BRC_FIELD_INT, NULL, AT(row), "grid of contact", "-", BRC_NOT_KEPT},
    {"row_out", each_exposed, 1, BRC_FIELD_INT, NULL, AT(row) + sizeof(brc_buffer *), "grid of contact", "-",
     BRC_NOT_KEPT},
    {"count", each_count, 1, BRC_FIELD_INT, NULL, AT(count), "grid of contact", "-", BRC_NOT_KEPT},
    {"digits", each_digit_end, 1, BRC_FIELD_INT, NULL, AT(digits), "grid of contact", "-", BRC_NOT_KEPT},
    {"owned", each_exposed, 1, BRC_FIELD_INT, NULL, AT(owned), "pairs of elements", "-", BRC_NOT_KEPT},
    {"pair_start", each_exposed_end, 1, BRC_FIELD_INT, NULL, AT(pair_start), "pairs of elements", "-", BRC_NOT_KEPT},
    {"again", each_exposed, 1, BRC_FIELD_INT, NULL, AT(again), "pairs of elements", "-", BRC_NOT_KEPT},
    {"redo", each_exposed, 1, BRC_FIELD_INT, NULL, AT(redo), "pairs of elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_contact_grid_fields, "grid of contact", BRC_LIFE_SEARCH, contact, grid_rows);
static const brc_field_row bucket_rows[] = {
    {"first", each_bucket, 1, BRC_FIELD_INT, NULL, AT(first), "grid of contact", "-", BRC_NOT_KEPT},
    {"last", each_bucket, 1, BRC_FIELD_INT, NULL, AT(last), "grid of contact", "-", BRC_NOT_KEPT},
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

static int64_t each_result(const brc_wants *w)
{
    return w->n_listed * (BRC_CONTACT_RESULT + 2 * (brc_wants_deforming(w) ? 9 : 3));
}

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
    {"touch", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(touch), "pairs that touch", "-", BRC_NOT_KEPT},
    {"result", each_result, 1, BRC_FIELD_STATE, NULL, AT(result), "forces of pairs", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_contact_result_fields, "forces of pairs", BRC_LIFE_GROWS, contact, result_rows);
static const brc_field_row part_rows[] = {
    {"part", brc_each_listed, 1, BRC_FIELD_STATE, NULL, AT(part), "forces on strikers", "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_contact_part_fields, "forces on strikers", BRC_LIFE_GROWS, contact, part_rows);
static const brc_field_row packed_at_rows[] = {
    {"packed_at", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(packed_at), "pairs that touch", "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_contact_packed_at_fields, "pairs that go over", BRC_LIFE_GROWS, contact, packed_at_rows);
static const brc_field_row packed_rows[] = {
    {"packed", each_result, 1, BRC_FIELD_STATE, NULL, AT(packed), "forces of pairs that touch", "-", BRC_NOT_KEPT}};
BRC_FIELD_TABLE(brc_contact_packed_fields, "forces of pairs that go over", BRC_LIFE_GROWS, contact, packed_rows);
static const brc_field_row changed_rows[] = {
    {"flag", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(flag), "changed pairs", "-", BRC_NOT_KEPT},
    {"flag_start", brc_each_listed_end, 1, BRC_FIELD_INT, NULL, AT(flag_start), "changed pairs", "-", BRC_NOT_KEPT},
    {"todo", brc_each_listed, 1, BRC_FIELD_INT, NULL, AT(todo), "changed pairs", "-", BRC_NOT_KEPT},
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
                           .outer = &out->contact};
    out->before =
        (brc_scope){.owner = "list of pairs before", .base = &c->before, BRC_VALUES(of_before), .outer = &out->now};
    out->state = brc_scope_of_run(s);
    out->state.outer = &out->before;
}
