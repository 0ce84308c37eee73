/* Initial fields of a stage, added to the state. */
#include "../../base/file.h"
#include "../../base/random.h"
#include "run_internal.h"
#include <hdf5.h>
#include <math.h>
#include <string.h>

/* value + gradient (X - origin) */
static void affine(const brc_initial *field, const double *x, double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = field->value[i];
        for (int j = 0; j < 3; ++j)
            out[i] += field->gradient[i][j] * (x[j] - field->origin[j]);
    }
}

/* Rotation by rate * height about the axis, minus identity (AGH19 section 8.2.2). */
static void twist(const brc_initial *field, const double *x, double out[3])
{
    double r[3], height = 0, turned[3];
    for (int c = 0; c < 3; ++c) {
        r[c] = x[c] - field->origin[c];
        height += r[c] * field->axis[c];
    }
    const double angle = field->rate * height, sine = sin(angle), versine = 2 * sin(angle / 2) * sin(angle / 2);
    for (int c = 0; c < 3; ++c)
        turned[c] = field->axis[(c + 1) % 3] * r[(c + 2) % 3] - field->axis[(c + 2) % 3] * r[(c + 1) % 3];
    for (int c = 0; c < 3; ++c)
        out[c] = sine * turned[c] - versine * (r[c] - height * field->axis[c]);
}

static void spin(const brc_initial *field, const double *x, double out[3])
{
    for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        out[c] = field->value[a] * (x[b] - field->origin[b]) - field->value[b] * (x[a] - field->origin[a]);
    }
}

/* Add dataset `name` of an HDF5 file, if it is there, to out [n][3] for the marked elements. */
static brc_status add_dataset(brc_simulation *s, const char *path, hid_t file, const char *name, const bool *member,
                              double *out, bool *found)
{
    const int64_t n = s->domain->n_elements;
    if (H5Lexists(file, name, H5P_DEFAULT) <= 0) return BRC_OK;
    *found = true;
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    hsize_t size[2] = {0, 0};
    const bool fits = H5Sget_simple_extent_ndims(space) == 2 && H5Sget_simple_extent_dims(space, size, NULL) == 2 &&
                      size[0] == (hsize_t)n && size[1] == 3;
    double *values = NULL;
    brc_status status = BRC_OK;
    if (!fits)
        status = BRC_FAIL(s->context, BRC_BAD_INPUT,
                          "%s: dataset '%s' is %llu x %llu, expected %lld x 3 (one row per element)", path, name,
                          (unsigned long long)size[0], (unsigned long long)size[1], (long long)n);
    if (status == BRC_OK) status = BRC_ALLOCATE(s->context, &values, 3 * n, "initial field");
    if (status == BRC_OK && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        status = BRC_FAIL(s->context, BRC_BAD_INPUT, "%s: dataset '%s' cannot be read as numbers", path, name);
    if (status == BRC_OK)
        for (int64_t e = 0; e < n; ++e)
            for (int c = 0; c < 3; ++c) {
                if (!isfinite(values[3 * e + c]) && status == BRC_OK)
                    status = BRC_FAIL(s->context, BRC_BAD_INPUT, "%s: dataset '%s' row %lld is not finite", path, name,
                                      (long long)e);
                if (member[e]) out[3 * e + c] += values[3 * e + c];
            }
    brc_memory_free(values);
    H5Sclose(space);
    H5Dclose(set);
    return status;
}

static brc_status from_file(brc_simulation *s, const brc_initial *field, const bool *member, double *u, double *v)
{
    BRC_FREED char *path = NULL;
    if (field->file[0] == '/')
        BRC_TRY(brc_file_join(s->context, "", field->file + 1, &path));
    else
        BRC_TRY(brc_file_join(s->context, s->scene->folder, field->file, &path));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    brc_status status = BRC_OK;
    bool found = false;
    if (file < 0) {
        status = BRC_FAIL(s->context, BRC_BAD_INPUT,
                          "%s: cannot be opened as HDF5; expected datasets displacement or velocity", path);
    } else {
        status = add_dataset(s, path, file, "displacement", member, u, &found);
        if (status == BRC_OK) status = add_dataset(s, path, file, "velocity", member, v, &found);
        if (status == BRC_OK && !found)
            status = BRC_FAIL(s->context, BRC_BAD_INPUT, "%s: holds neither 'displacement' nor 'velocity'", path);
        H5Fclose(file);
    }
    return status;
}

static brc_status mark_members(brc_simulation *s, const brc_stage *stage, const brc_initial *field, bool *member)
{
    const brc_domain *d = s->domain;
    if (field->set[0] == 0) {
        for (int64_t e = 0; e < d->n_elements; ++e)
            member[e] = true;
        return BRC_OK;
    }
    const int32_t index = brc_domain_find_set(d, field->set);
    if (index < 0 || d->sets[index].kind != BRC_SET_ELEMENTS)
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "stage '%s': initial field names '%s', which is no set of elements",
                        stage->name, field->set);
    for (int64_t e = 0; e < d->n_elements; ++e)
        member[e] = false;
    for (int64_t m = 0; m < d->sets[index].n_members; ++m)
        member[d->sets[index].members[m]] = true;
    return BRC_OK;
}

brc_status brc_initial_apply(brc_simulation *s, const brc_stage *stage)
{
    if (stage->n_initials == 0) return BRC_OK;
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, 3 * d->n_elements, double, u, "initial displacement");
    BRC_LOCAL(s->context, 3 * d->n_elements, double, v, "initial velocity");
    BRC_LOCAL(s->context, d->n_elements, bool, member, "initial field");
    BRC_TRY(brc_simulation_displacement(s, u));
    BRC_TRY(brc_simulation_velocity(s, v));
    for (int32_t i = 0; i < stage->n_initials; ++i) {
        const brc_initial *field = stage->initials + i;
        BRC_TRY(mark_members(s, stage, field, member));
        if (field->kind == BRC_INITIAL_FILE) {
            BRC_TRY(from_file(s, field, member, u, v));
            continue;
        }
        for (int64_t e = 0; e < d->n_elements; ++e) {
            if (!member[e]) continue;
            double add[3] = {0, 0, 0}, draws[4];
            const double *x = d->position + 3 * e;
            switch (field->kind) {
            case BRC_INITIAL_TWIST: twist(field, x, add); break;
            case BRC_INITIAL_SPIN: spin(field, x, add); break;
            case BRC_INITIAL_RANDOM:
                brc_random_uniform4(field->seed, BRC_RANDOM_INITIAL_FIELD, (uint64_t)e, (uint64_t)i, draws);
                for (int c = 0; c < 3; ++c)
                    add[c] = field->value[c] * (2 * draws[c] - 1);
                break;
            default: affine(field, x, add);
            }
            double *to = field->kind == BRC_INITIAL_AFFINE || field->kind == BRC_INITIAL_TWIST ? u : v;
            for (int c = 0; c < 3; ++c)
                to[3 * e + c] += add[c];
        }
    }
    BRC_TRY(brc_state_to_rows(s, brc_displacement_of(s), u, 3, 0));
    return brc_state_to_rows(s, brc_velocity_of(s), v, 3, 0);
}
