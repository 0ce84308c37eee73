/* Sums over the parts of a scene. With one part every function is that of its simulation. */
#include "../core/awake.h"
#include "assembly.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

brc_assembly brc_assembly_make(const brc_scene *scene, const brc_split *split, int32_t n, brc_simulation *const *part)
{
    return (brc_assembly){.scene = scene, .split = n > 1 ? split : NULL, .n = n, .part = part};
}

const char *brc_assembly_part_name(const brc_assembly *a, int32_t part)
{
    return a->split ? a->split->part[part].name : brc_model_name(a->scene->model.kind);
}

const char *brc_assembly_models(const brc_assembly *a, char *words, size_t room)
{
    words[0] = '\0';
    for (int32_t k = 0; k < a->n; ++k) {
        const size_t at = strlen(words);
        snprintf(words + at, room - at, "%s%s", k > 0 ? ", " : "", brc_assembly_part_name(a, k));
    }
    return words;
}

int64_t brc_assembly_first_element(const brc_assembly *a, int32_t part)
{
    int64_t n = 0;
    for (int32_t k = 0; k < part; ++k)
        n += brc_simulation_domain(a->part[k])->n_elements;
    return n;
}

int64_t brc_assembly_first_bond(const brc_assembly *a, int32_t part)
{
    int64_t n = 0;
    for (int32_t k = 0; k < part; ++k)
        n += brc_simulation_domain(a->part[k])->n_bonds;
    return n;
}

int32_t brc_assembly_body(const brc_assembly *a, int32_t part, int64_t element)
{
    const int32_t body = brc_simulation_domain(a->part[part])->body[element];
    return a->split && body < a->split->part[part].n_bodies ? a->split->part[part].body[body] : body;
}

brc_status brc_assembly_ledger(brc_assembly *a, brc_ledger *out)
{
    if (a->n == 1) return brc_simulation_ledger(a->part[0], out);
    brc_ledger sum = {0};
    for (int32_t k = 0; k < a->n; ++k) {
        brc_ledger one;
        BRC_TRY(brc_simulation_ledger(a->part[k], &one));
        sum.kinetic += one.kinetic;
        sum.elastic += one.elastic;
        sum.stabilisation += one.stabilisation;
        sum.potential += one.potential;
        sum.work += one.work;
        sum.damping += one.damping;
        sum.numerical += one.numerical;
        sum.contact += one.contact;
        sum.friction += one.friction;
        sum.impact += one.impact;
        sum.fracture += one.fracture;
        sum.initial += one.initial;
    }
    if (sum.elastic > a->peak_elastic) a->peak_elastic = sum.elastic;
    if (sum.kinetic > a->peak_kinetic) a->peak_kinetic = sum.kinetic;
    sum.peak_elastic = a->peak_elastic;
    sum.peak_kinetic = a->peak_kinetic;
    brc_ledger_close(&sum);
    *out = sum;
    return BRC_OK;
}

/* The smaller of two that are known (above 0). */
static double least(double a, double b)
{
    return !(a > 0) ? b : !(b > 0) ? a : fmin(a, b);
}

brc_time_step brc_assembly_time_step(const brc_assembly *a)
{
    brc_time_step step = brc_simulation_time_step(a->part[0]);
    for (int32_t k = 1; k < a->n; ++k) {
        const brc_time_step one = brc_simulation_time_step(a->part[k]);
        step.critical = least(step.critical, one.critical);
        step.published = least(step.published, one.published);
        if (step.critical > 0) step.safety = step.value / step.critical;
    }
    return step;
}

/* The modes of bodies that do not touch are those of each: the index-th of all, by counting those below. */
double brc_assembly_mode(const brc_assembly *a, int32_t index)
{
    for (int32_t k = 0; k < a->n; ++k) {
        int32_t n;
        const double *omega = brc_simulation_modes(a->part[k], &n);
        for (int32_t i = 0; omega && i < n; ++i) {
            int32_t before = i;
            for (int32_t other = 0; other < a->n; ++other) {
                int32_t m;
                const double *others = brc_simulation_modes(a->part[other], &m);
                for (int32_t j = 0; other != k && others && j < m; ++j)
                    before += others[j] < omega[i] || (others[j] == omega[i] && other < k);
            }
            if (before == index) return omega[i];
        }
    }
    return NAN;
}

double brc_assembly_phase_seconds(const brc_assembly *a, brc_step_phase phase)
{
    double sum = 0;
    for (int32_t k = 0; k < a->n; ++k)
        sum += brc_simulation_phase_seconds(a->part[k], phase);
    return sum;
}

double brc_assembly_at_rest(const brc_assembly *a)
{
    brc_rest_account sum = {0};
    for (int32_t k = 0; k < a->n; ++k) {
        const brc_rest_account part = brc_simulation_at_rest(a->part[k]);
        sum.left_out += part.left_out;
        sum.all += part.all;
    }
    return sum.all > 0 ? sum.left_out / sum.all : 0;
}

double brc_assembly_setup_seconds(const brc_assembly *a)
{
    double sum = 0;
    for (int32_t k = 0; k < a->n; ++k)
        sum += brc_simulation_setup_seconds(a->part[k]);
    return sum;
}

int64_t brc_assembly_device_bytes(const brc_assembly *a)
{
    int64_t sum = 0;
    for (int32_t k = 0; k < a->n; ++k)
        sum += brc_device_bytes(brc_simulation_device(a->part[k]));
    return sum;
}
