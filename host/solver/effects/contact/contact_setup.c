/* What contact knows of the elements from the start: where they are, how far they reach, of what they are, which are
 * exposed; and the laws. */
#include "../../../../preprocess/domain/domain_rows.h"
#include "contact_internal.h"
#include "../strikers/striker_contact.h"
#include <math.h>
#include <string.h>

/* ---- laws ---- */

/* Restitution of an oscillator with the share b of critical damping that lets go when its force becomes zero (F >= 0,
 * surfaces do not pull): x'' + 2 b x' + x = 0 from x = 0 until x'' = 0. With s = sqrt|1 - b^2| that is at s t = atan2(2
 * b s, 2 b^2 - 1), or asinh(2 b s) above critical, with speed exp(-b t). */
static double restitution_of(double b)
{
    const double s = sqrt(fabs(1 - b * b));
    if (s < 1e-9) return exp(-2);
    return exp(-b * (b < 1 ? atan2(2 * b * s, 2 * b * b - 1) : asinh(2 * b * s)) / s);
}

/* Its inverse, by bisection: the restitution falls with b. */
static double damping_of(double restitution)
{
    double low = 0, high = 1;
    if (restitution >= 1) return 0;
    while (restitution_of(high) > restitution)
        high *= 2;
    for (int round = 0; round < 200; ++round) {
        const double middle = 0.5 * (low + high);
        if (restitution_of(middle) > restitution)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

static void fill_law(const brc_material *a, const brc_material *b, const brc_contact_law *law,
                     double out[BRC_CONTACT_LAW])
{
    const double hertz = 1 / ((1 - a->poisson * a->poisson) / a->young + (1 - b->poisson * b->poisson) / b->young);
    const double ga = a->young / (2 * (1 + a->poisson)), gb = b->young / (2 * (1 + b->poisson));
    const double shear = 1 / ((2 - a->poisson) / ga + (2 - b->poisson) / gb);
    out[0] = hertz;
    out[1] = 2 * a->young * b->young / (a->young + b->young);
    out[2] = law->stiffness;
    out[3] = law->tangential > 0 ? law->tangential
                                 : 4 * shear / hertz; /* Mindlin; 2 (1 - nu) / (2 - nu) of equal materials */
    out[4] = law->friction;
    out[5] = law->damping > 0 ? law->damping : law->restitution > 0 ? damping_of(law->restitution) : 0;
}

static brc_status set_laws(brc_simulation *s)
{
    const brc_scene *scene = s->scene;
    const int32_t n = scene->n_materials;
    const int64_t count = (int64_t)n * n * BRC_CONTACT_LAW;
    BRC_TRY(BRC_ALLOCATE(s->context, &s->contact->law_of, count, "laws of contact"));
    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = 0; j < n; ++j) {
            const brc_contact_law *law = &scene->contact.law;
            for (int32_t p = 0; p < scene->contact.n_pairs; ++p) {
                const int32_t *m = scene->contact.pairs[p].material;
                if ((m[0] == i && m[1] == j) || (m[0] == j && m[1] == i)) law = &scene->contact.pairs[p];
            }
            fill_law(&scene->materials[i], &scene->materials[j], law,
                     s->contact->law_of + ((int64_t)i * n + j) * BRC_CONTACT_LAW);
        }
    return brc_upload_state(s, s->contact->law, s->contact->law_of, count);
}

const double *brc_contact_law_of(const brc_simulation *s, int32_t i, int32_t j)
{
    return s->contact->law_of + ((int64_t)i * s->scene->n_materials + j) * BRC_CONTACT_LAW;
}

/* ---- rows ---- */

/* Radius about the place of element e that holds it [m]. */
static double reach_of(const brc_domain *d, int64_t e)
{
    if (d->radius) return d->radius[e];
    double most = 0;
    for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += (d->vertex[3 * v + c] - d->position[3 * e + c]) * (d->vertex[3 * v + c] - d->position[3 * e + c]);
        most = fmax(most, square);
    }
    return sqrt(most);
}

/* Of rows. */
static brc_status find_reaches(const brc_simulation *s, double *value)
{
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, d->n_elements, double, reach, "radii about elements");
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (brc_domain_mine(d, e)) reach[e] = reach_of(d, e);
    if (d->here) BRC_TRY(brc_domain_elements(s->context, d, 1, reach));
    for (int32_t r = 0; r < s->layout->n_rows; ++r)
        value[r] = s->layout->element_of_row[r] < 0 ? 0 : reach[s->layout->element_of_row[r]];
    return BRC_OK;
}

/* Exposed from the start: cells with a free face. Spheres within two radii of a wall of the packing (its sets
 * "<wall>_layer"), since those behind the first row are reached between its spheres, and those with fewer than four
 * bonds; all of a body without walls. */
static brc_status find_exposed(brc_simulation *s, int32_t *exposed)
{
    const brc_domain *d = s->domain;
    static const char layer[] = "_layer";
    for (int64_t e = 0; e < d->n_elements; ++e)
        exposed[s->layout->row_of_element[e]] = d->free_start
                                                    ? d->free_start[e + 1] > d->free_start[e]
                                                    : d->n_walls == 0 || d->row_start[e + 1] - d->row_start[e] < 4;
    for (int32_t k = 0; d->radius && k < d->n_sets; ++k) {
        const size_t length = strlen(d->sets[k].name);
        if (d->sets[k].kind != BRC_SET_ELEMENTS || length < sizeof layer ||
            strcmp(d->sets[k].name + length - (sizeof layer - 1), layer) != 0)
            continue;
        for (int64_t m = 0; m < d->sets[k].n_members; ++m)
            exposed[s->layout->row_of_element[d->sets[k].members[m]]] = 1;
    }
    int64_t n_exposed = 0;
    for (int32_t r = 0; r < s->layout->n_rows; ++r)
        n_exposed += exposed[r];
    brc_want_exposed(s, brc_contact_exposed_room(&s->wants, n_exposed), brc_contact_buckets(n_exposed));
    return brc_upload_int(s->contact->exposed, exposed, s->layout->n_rows);
}

/* Rows of the neighbours over all bonds there ever were; entries without one point home. */
static brc_status upload_original(brc_simulation *s)
{
    const brc_layout *layout = s->layout;
    const int64_t entries = layout->n_slots * layout->slice;
    brc_status status = BRC_OK;
    BRC_LOCAL(s->context, entries, int32_t, row, "bonds at the start");
    for (int32_t k = 0; k < layout->n_slices; ++k)
        for (int64_t at = (int64_t)layout->slot_start[k] * layout->slice;
             at < (int64_t)layout->slot_start[k + 1] * layout->slice; ++at) {
            const int32_t h = layout->half_edge[at];
            row[at] = h >= 0 ? layout->row_of_element[s->domain->neighbour[h]]
                             : k * layout->slice + (int32_t)(at % layout->slice);
        }
    status = brc_upload_int(s->contact->original, row, entries);
    return status;
}

/* Of rows, and of the strikers' pieces after them. */
static brc_status upload_rows(brc_simulation *s, int32_t *number, double *value)
{
    brc_contact_state *c = s->contact;
    const brc_domain *d = s->domain;
    const brc_layout *layout = s->layout;
    const int32_t n = layout->n_rows, np = c->n_pieces;
    BRC_TRY(find_exposed(s, number));
    for (int32_t r = 0; r < n; ++r)
        number[r] = layout->element_of_row[r];
    for (int32_t p = 0; p < np; ++p)
        number[n + p] = (int32_t)d->n_elements + p;
    BRC_TRY(brc_upload_int(c->id, number, n + np));
    for (int32_t r = 0; r < n; ++r)
        number[r] = layout->element_of_row[r] < 0 ? -1 : d->body[layout->element_of_row[r]];
    BRC_TRY(brc_upload_int(c->body, number, n));
    for (int32_t r = 0; r < n; ++r)
        number[r] = layout->element_of_row[r] < 0 ? 0 : s->material_of_element[layout->element_of_row[r]];
    for (int32_t p = 0; p < np; ++p)
        number[n + p] = s->scene->strikers[brc_striker_piece_of(s, p).striker].material;
    BRC_TRY(brc_upload_int(c->material, number, n + np));
    for (int32_t r = 0; r < n; ++r) {
        const int32_t e = layout->element_of_row[r];
        value[r] = e < 0 ? 1 : brc_mass_of_element(s, e);
    }
    for (int32_t p = 0; p < np; ++p)
        value[n + p] =
            brc_simulation_striker_body(s, brc_striker_piece_of(s, p).striker)->mass; /* 0 of those that are not free */
    BRC_TRY(brc_upload_state(s, c->mass, value, n + np));
    for (int32_t r = 0; r < n; ++r)
        value[r] = layout->element_of_row[r] < 0 ? 1 : cbrt(brc_domain_own_volume(d, layout->element_of_row[r]));
    for (int32_t p = 0; p < np; ++p)
        value[n + p] = 0;
    BRC_TRY(brc_upload_state(s, c->size_of, value, n + np));
    BRC_TRY(find_reaches(s, value));
    BRC_TRY(brc_upload_state(s, c->bounding_radius, value, n));
    for (int32_t r = 0; r < n; ++r)
        for (int k = 0; k < 3; ++k)
            value[3 * (int64_t)r + k] = layout->element_of_row[r] < 0
                                            ? 0
                                            : d->position[3 * (int64_t)layout->element_of_row[r] + k] - c->middle[k];
    return brc_upload_state(s, c->place, value, 3 * (int64_t)n);
}

brc_status brc_contact_setup(brc_simulation *s)
{
    brc_contact_state *c = s->contact;
    const brc_domain *d = s->domain;
    const int64_t n = s->layout->n_rows;
    double volume = 0;
    for (int k = 0; k < 3; ++k) {
        c->middle[k] = 0.5 * (d->bounds[0][k] + d->bounds[1][k]);
        c->span += 2 * (d->bounds[1][k] - d->bounds[0][k]);
    }
    c->n_pieces = s->wants.pieces ? s->wants.pieces->n : 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        volume += brc_domain_own_volume(d, e);
    c->size = cbrt(volume / (double)d->n_elements);
    BRC_TRY(brc_fields_create(s->device, &brc_contact_fields, &s->wants, c));
    BRC_TRY(set_laws(s));
    BRC_LOCAL(s->context, n + c->n_pieces, int32_t, number, "elements");
    BRC_LOCAL(s->context, 3 * (n + c->n_pieces), double, value, "elements");
    BRC_TRY(upload_rows(s, number, value));
    return upload_original(s);
}
