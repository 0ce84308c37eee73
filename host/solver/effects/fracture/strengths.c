#include "strengths.h"
#include "../../../../preprocess/csv.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../../base/file.h"
#include "../../../base/log.h"
#include "../../../base/memory.h"
#include "../../../base/random.h"
#include "interfaces.h"
#include <math.h>
#include <string.h>

/* ---- factors from files ---- */

/* Half-edge from i to j, -1: none. Rows are sorted by neighbour. */
static int64_t find_half_edge(const brc_domain *d, int32_t i, int32_t j)
{
    int64_t low = d->row_start[i], high = d->row_start[i + 1];
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (d->neighbour[middle] < j)
            low = middle + 1;
        else
            high = middle;
    }
    return low < d->row_start[i + 1] && d->neighbour[low] == j ? low : -1;
}

enum { ELEMENT_I, ELEMENT_J, FACTOR, N_ROLES };
static const char *const role_name[N_ROLES] = {"element_i", "element_j", "factor"};

/* Is the value an id of an element? A fault otherwise. */
static bool is_element(brc_lines *lines, const brc_domain *d, const char *name, double value, const char *place)
{
    if (value >= 0 && value < (double)d->n_elements && value == floor(value)) return true;
    brc_lines_bad(lines, place, "%s is %.17g, expected the id of an element, 0 to %lld", name, value,
                  (long long)d->n_elements - 1);
    return false;
}

static void read_row(brc_lines *lines, const brc_csv *csv, const brc_domain *d, double *factor)
{
    double value[N_ROLES];
    const char *place[N_ROLES];
    if (!brc_csv_row(lines, csv, value, place)) return;
    for (int k = ELEMENT_I; k <= ELEMENT_J; ++k)
        if (!is_element(lines, d, role_name[k], value[k], place[k])) return;
    const int64_t h = find_half_edge(d, (int32_t)value[ELEMENT_I], (int32_t)value[ELEMENT_J]);
    if (!(value[FACTOR] > 0))
        brc_lines_bad(lines, place[FACTOR], "factor is %g, must be > 0", value[FACTOR]);
    else if (h < 0)
        brc_lines_bad(lines, place[ELEMENT_I],
                      "no bond joins elements %.0f and %.0f; `breccia build` writes the bonds of a sample",
                      value[ELEMENT_I], value[ELEMENT_J]);
    else if (factor[d->bond[h]] > 0)
        brc_lines_bad(lines, place[ELEMENT_I], "a second factor for the bond of elements %.0f and %.0f",
                      value[ELEMENT_I], value[ELEMENT_J]);
    else
        factor[d->bond[h]] = value[FACTOR];
}

/* *out [n_bonds]: factors of a file, 0 for bonds that are not in it. */
static brc_status read_factors(brc_context *context, const brc_scene *scene, const char *name, const brc_domain *d,
                               double **out)
{
    BRC_FREED char *text = NULL;
    BRC_FREED char *path = NULL;
    size_t bytes = 0;
    BRC_ENDS_WITH(brc_lines_end) brc_lines lines = {0};
    brc_csv csv = {.n_roles = N_ROLES,
                   .n_required = N_ROLES,
                   .role = role_name,
                   .what = "column",
                   .wanted = "a row of names: element_i, element_j and factor, then a row a bond"};
    BRC_TRY(BRC_ALLOCATE(context, out, d->n_bonds, "factors of bonds"));
    if (name[0] == '/')
        BRC_TRY(brc_file_join(context, "", name + 1, &path));
    else
        BRC_TRY(brc_file_join(context, scene->folder, name, &path));
    BRC_TRY(brc_file_read_whole(context, path, (size_t)1 << 40, &text, &bytes));
    BRC_TRY(brc_lines_begin(context, path, text, bytes, &lines));
    if (brc_csv_header(&lines, &csv))
        while (brc_csv_next(&lines))
            read_row(&lines, &csv, d, *out);
    return brc_lines_verdict(&lines);
}

/* ---- draws ---- */

double brc_strengths_volume(const brc_domain *d, int64_t bond)
{
    const int64_t h = d->bond_half_edge[bond], end[2] = {d->neighbour[d->twin[h]], d->neighbour[h]};
    if (d->element_kind == BRC_ELEMENT_SPHERE) {
        double sum = 0;
        for (int k = 0; k < 2; ++k)
            sum += d->volume[end[k]] / (double)(d->row_start[end[k] + 1] - d->row_start[end[k]]);
        return sum;
    }
    double length = 0, area = 0;
    for (int c = 0; c < 3; ++c) {
        const double branch = d->position[3 * end[1] + c] - d->position[3 * end[0] + c], s = d->area_vector[3 * h + c];
        length += branch * branch;
        area += s * s;
    }
    return sqrt(area) * sqrt(length) / 3;
}

/* Factor at probability p. */
static double quantile(const brc_scatter *scatter, double p)
{
    int32_t k = 1;
    while (k < scatter->n_quantiles - 1 && p > scatter->quantiles[k].below)
        ++k;
    const brc_quantile *a = &scatter->quantiles[k - 1], *b = &scatter->quantiles[k];
    if (!(b->below > a->below)) return b->factor;
    return a->factor + (b->factor - a->factor) * ((p - a->below) / (b->below - a->below));
}

/* Volumes of bonds that ranks have between them; *out [n_bonds] stays NULL where no scatter asks, or all are here. */
static brc_status bring_volumes(brc_context *context, const brc_scene *scene, const brc_domain *d, double **out)
{
    bool asked = false;
    for (int32_t m = 0; m < scene->n_materials; ++m)
        asked = asked || scene->materials[m].scatter.volume > 0;
    if (!d->here || !asked) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, out, d->n_bonds, "volumes of bonds"));
    for (int64_t b = 0; b < d->n_bonds; ++b)
        if (brc_domain_mine(d, d->neighbour[d->twin[d->bond_half_edge[b]]])) (*out)[b] = brc_strengths_volume(d, b);
    return brc_domain_bonds(context, d, *out);
}

/* bond_volume: of all bonds, or NULL: the domain has their faces. */
static double draw(const brc_scatter *scatter, uint64_t seed, const brc_domain *d, int64_t bond,
                   const double *bond_volume)
{
    const int64_t h = d->bond_half_edge[bond];
    double p[4];
    brc_random_uniform4(seed, BRC_RANDOM_STRENGTH, (uint64_t)d->neighbour[d->twin[h]], (uint64_t)d->neighbour[h], p);
    if (scatter->kind == BRC_SCATTER_TABLE) return quantile(scatter, p[0]);
    const double volume =
        scatter->volume > 0 ? scatter->volume / (bond_volume ? bond_volume[bond] : brc_strengths_volume(d, bond)) : 1;
    return pow(-log1p(-p[0]) * volume, 1 / scatter->modulus);
}

/* ---- sides and interfaces ---- */

static double strength_of(const brc_material *m)
{
    return m->tension > 0 ? m->tension : m->beam_strength > 0 ? m->beam_strength : INFINITY;
}

static int32_t weaker(const brc_scene *scene, int32_t a, int32_t b)
{
    const brc_material *x = &scene->materials[a], *y = &scene->materials[b];
    if (strength_of(x) != strength_of(y)) return strength_of(x) < strength_of(y) ? a : b;
    if (x->fracture_energy != y->fracture_energy) return x->fracture_energy < y->fracture_energy ? a : b;
    return a < b ? a : b;
}

static brc_status check_interface(brc_context *context, const brc_scene *scene, int32_t k, const brc_material *weak)
{
    const bool of_elements = !brc_scene_breaks_by_bond(scene, scene->model.kind);
    if (!of_elements || weak->tension > 0 || !(scene->interfaces[k].tension > 0)) return BRC_OK;
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "interfaces, number %d: a tension of %g Pa is compared with that of its materials, and '%s' has none; give "
        "it `strength: {tension: ...}`, or the interface a `factor`",
        (int)k + 1, scene->interfaces[k].tension, weak->name);
}

/* ---- all bonds ---- */

/* Of a bond whose strength is not scattered: what its interface makes of that of the weaker side; and its fracture
 * energy. */
static double interface_factor(const brc_interface *at, const brc_material *weak)
{
    const double factor = at && at->factor > 0 ? at->factor : 1;
    return at && at->tension > 0 && weak->tension > 0 ? at->tension / weak->tension : factor;
}
static double bond_energy(const brc_interface *at, const brc_material *weak)
{
    return at && at->fracture_energy > 0 ? at->fracture_energy
                                         : (at && at->factor > 0 ? at->factor : 1) * weak->fracture_energy;
}

static void fill_bond(const brc_scene *scene, const brc_domain *d, int64_t bond, const brc_material *weak,
                      const brc_interface *at, const double *from_file, const double *bond_volume, brc_strengths *out)
{
    const double factor = at && at->factor > 0 ? at->factor : 1;
    double scatter = 1;
    if (weak->scatter.kind == BRC_SCATTER_FILE)
        scatter = from_file[bond] > 0 ? from_file[bond] : 1;
    else if (weak->scatter.kind != BRC_SCATTER_NONE)
        scatter = draw(&weak->scatter, scene->fracture.seed, d, bond, bond_volume);
    const bool given = at && at->tension > 0;
    out->joint[bond] = at != NULL;
    out->tension[bond] = (given ? at->tension : factor * weak->tension) * scatter;
    out->factor[bond] = interface_factor(at, weak) * scatter;
    out->energy[bond] = bond_energy(at, weak);
    out->shear_energy[bond] =
        out->energy[bond] * (weak->shear_fracture_energy > 0 ? weak->shear_fracture_energy / weak->fracture_energy : 1);
    out->softens = out->softens || out->energy[bond] > 0 || brc_scene_slides(scene, scene->model.kind);
    out->exponential[bond] = weak->softening == BRC_SOFTENING_EXPONENTIAL;
}

static void tell_interfaces(brc_context *context, const brc_scene *scene, const brc_domain *d, const int64_t *count)
{
    for (int32_t k = 0; k < scene->n_interfaces; ++k)
        if (count[k] > 0)
            brc_log(context, BRC_LOG_INFO, "interfaces, number %d: %lld of %lld bonds", (int)k + 1, (long long)count[k],
                    (long long)d->n_bonds);
        else
            brc_log(context, BRC_LOG_WARNING, "interfaces, number %d: no bond lies in it%s", (int)k + 1,
                    scene->interfaces[k].kind == BRC_INTERFACE_GRAINS
                        ? "; grains come with `grains: {number: ...}` of a body"
                        : " (later interfaces win)");
}

void brc_strengths_ask(const brc_scene *scene, const brc_domain *d, const int32_t *material, bool *weighted,
                       bool *softens)
{
    *weighted = *softens = false;
    for (int64_t b = 0; b < d->n_bonds && !(*weighted && *softens); ++b) {
        const int64_t h = d->bond_half_edge[b];
        const int32_t i = d->neighbour[d->twin[h]], j = d->neighbour[h], k = brc_interface_of(scene, d, material, i, j);
        const brc_interface *at = k >= 0 ? &scene->interfaces[k] : NULL;
        const brc_material *weak = &scene->materials[weaker(scene, material[i], material[j])];
        *weighted |= weak->scatter.kind != BRC_SCATTER_NONE || interface_factor(at, weak) != 1;
        *softens |= bond_energy(at, weak) > 0 || brc_scene_slides(scene, scene->model.kind);
    }
}

brc_status brc_strengths_create(brc_context *context, const brc_scene *scene, const brc_domain *d,
                                const int32_t *material, brc_strengths *out)
{
    double **from_file = NULL;
    BRC_FREED double *volume = NULL;
    int64_t *count = NULL;
    brc_status status = BRC_OK;
    memset(out, 0, sizeof *out);
    BRC_TRY(bring_volumes(context, scene, d, &volume));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &from_file, scene->n_materials, "factors of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, scene->n_interfaces, "interfaces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->tension, d->n_bonds, "strengths of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->energy, d->n_bonds, "fracture energies of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->joint, d->n_bonds, "interfaces of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->shear_energy, d->n_bonds, "fracture energies of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->factor, d->n_bonds, "factors of bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->exponential, d->n_bonds, "softening of bonds"));
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        const int32_t i = d->neighbour[d->twin[h]], j = d->neighbour[h], m = weaker(scene, material[i], material[j]);
        const int32_t k = brc_interface_of(scene, d, material, i, j);
        const brc_material *weak = &scene->materials[m];
        if (weak->scatter.kind == BRC_SCATTER_FILE && !from_file[m])
            BRC_TRY_OR(cleanup, read_factors(context, scene, weak->scatter.file, d, &from_file[m]));
        if (k >= 0) BRC_TRY_OR(cleanup, check_interface(context, scene, k, weak));
        if (k >= 0) ++count[k];
        fill_bond(scene, d, b, weak, k >= 0 ? &scene->interfaces[k] : NULL, from_file[m], volume, out);
    }
    tell_interfaces(context, scene, d, count);
cleanup:
    for (int32_t m = 0; from_file && m < scene->n_materials; ++m)
        brc_memory_free(from_file[m]);
    brc_memory_free(from_file);
    brc_memory_free(count);
    if (status != BRC_OK) brc_strengths_free(out);
    return status;
}

void brc_strengths_free(brc_strengths *s)
{
    brc_memory_free(s->tension);
    brc_memory_free(s->energy);
    brc_memory_free(s->joint);
    brc_memory_free(s->shear_energy);
    brc_memory_free(s->factor);
    brc_memory_free(s->exponential);
    memset(s, 0, sizeof *s);
}
