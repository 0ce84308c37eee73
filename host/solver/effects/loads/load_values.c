/* What loads say: factors and rates in time, directions in space, the sets they act on. */
#include "loads_internal.h"
#include <math.h>
#include <string.h>

double brc_load_rate(const brc_load *load, double t)
{
    const brc_table *table = &load->table;
    if (load->kind == BRC_LOAD_FACE_VELOCITY || load->kind == BRC_LOAD_ELEMENT_VELOCITY)
        return brc_table_value(table, t);
    /* derivative of the piecewise linear table; the later piece at a corner */
    for (int32_t i = 0; i + 1 < table->n; ++i)
        if (t >= table->time[i] && t < table->time[i + 1])
            return (table->value[i + 1] - table->value[i]) / (table->time[i + 1] - table->time[i]);
    return 0;
}

double brc_table_integral(const brc_table *table, double t)
{
    if (table->n == 0) return t;
    /* exact by trapezoids between the table's own points */
    double sum = 0, from = 0, value = brc_table_value(table, 0);
    for (int32_t i = 0; i < table->n; ++i) {
        if (table->time[i] <= 0 || table->time[i] >= t) continue;
        sum += 0.5 * (value + table->value[i]) * (table->time[i] - from);
        from = table->time[i];
        value = table->value[i];
    }
    return sum + 0.5 * (value + brc_table_value(table, t)) * (t - from);
}

double brc_load_factor(const brc_load *load, double t, bool is_static)
{
    const brc_table *table = &load->table;
    const bool velocity = load->kind == BRC_LOAD_FACE_VELOCITY || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
    if (!velocity && is_static && table->n > 0 && t > 1)
        return t * brc_table_value(table, 1); /* beyond the whole load: to_failure */
    if (!velocity) return is_static && table->n == 0 ? t : brc_table_value(table, t);
    return brc_table_integral(table, t);
}

/* value + gradient (x - origin) */
void brc_load_direction(const brc_load *load, const double *x, double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = load->value[i];
        for (int j = 0; j < 3; ++j)
            out[i] += load->gradient[i][j] * (x[j] - load->origin[j]);
    }
}

/* The set a load names, with or without members. */
const brc_set *brc_load_find_named(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                   brc_status *status)
{
    const int32_t index = brc_domain_find_set(s->domain, load->set);
    if (index < 0) {
        *status =
            BRC_FAIL(s->context, BRC_BAD_INPUT, "stage '%s': a load names the set '%s', which the domain does not have",
                     stage->name, load->set);
        return NULL;
    }
    const brc_set *set = s->domain->sets + index;
    if (set->kind != kind && kind == BRC_SET_FACES) {
        *status = BRC_FAIL(s->context, BRC_BAD_INPUT,
                           "stage '%s': a face load names the set '%s', which is of elements; name a set of faces",
                           stage->name, load->set);
        return NULL;
    }
    return set;
}

brc_status brc_load_refuse_empty(brc_simulation *s, const brc_stage *stage, const brc_load *load)
{
    return BRC_FAIL(s->context, BRC_BAD_INPUT, "stage '%s': the set '%s' is empty; widen its predicate", stage->name,
                    load->set);
}

const brc_set *brc_load_find_set(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                 brc_status *status)
{
    const brc_set *set = brc_load_find_named(s, stage, load, kind, status);
    if (!set || set->n_members > 0) return set;
    *status = brc_load_refuse_empty(s, stage, load);
    return NULL;
}

bool brc_load_holds_faces(const brc_load *load)
{
    return load->kind == BRC_LOAD_FACE_DISPLACEMENT || load->kind == BRC_LOAD_FACE_VELOCITY;
}
bool brc_load_pulls_faces(const brc_load *load)
{
    return load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE;
}
int brc_load_components(const brc_load *load)
{
    return (load->component[0] ? 1 : 0) | (load->component[1] ? 2 : 0) | (load->component[2] ? 4 : 0);
}

brc_status brc_loads_refuse_twice(brc_simulation *s, const brc_stage *stage, const brc_load *load, int64_t n)
{
    return BRC_FAIL(s->context, BRC_BAD_INPUT,
                    "stage '%s': the %s of '%s' prescribes components of %lld elements that another load of the stage "
                    "prescribes too; give each "
                    "component of an element to one load",
                    stage->name, load->kind == BRC_LOAD_ELEMENT_ROTATION ? "rotation" : "motion", load->set,
                    (long long)n);
}

/* Temporary host arrays of a list of n entries, uploaded in one go. */
brc_status brc_load_upload_components(brc_simulation *s, brc_buffer *out, const int32_t *bits, int32_t n)
{
    BRC_LOCAL(s->context, 3 * (int64_t)n, double, flags, "component flags");
    for (int32_t i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c)
            flags[3 * (int64_t)i + c] = bits[i] >> c & 1;
    return brc_upload_coeff(s, out, flags, 3 * (int64_t)n);
}
