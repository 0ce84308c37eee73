/* The elastic tests of a campaign (sample_campaign.h): one static solve a pull. */
#include "sample_campaign.h"
#include "../../base/memory.h"
#include <math.h>

#define BEAM_POISSON 0.3

static const char header[] =
    "elements,radius_spread,seed,axis,cn,r_m,E_m_Pa,E_ratio,nu,nu_y,nu_z,inner,bonds,loose,iterations,seconds\n";

static void print_line(const void *row, char *out, size_t room)
{
    const brc_calibration_row *r = row;
    snprintf(out, room, "%lld,%.17g,%llu,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%lld,%lld,%.3f\n",
             (long long)r->n_elements, r->radius_spread, (unsigned long long)r->seed, r->axis, r->coordination,
             r->radius, r->beam_young, r->young, r->poisson, r->lateral[0], r->lateral[1], r->inner,
             (long long)r->n_bonds, (long long)r->n_loose, (long long)r->iterations, r->seconds);
}

static bool parse_line(const char *line, void *row)
{
    brc_calibration_row *r = row;
    long long elements, bonds, loose, iterations;
    unsigned long long seed;
    int end = 0;
    const int n =
        sscanf(line, "%lld,%lf,%llu,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lld,%lld,%lld,%lf%n", &elements,
               &r->radius_spread, &seed, &r->axis, &r->coordination, &r->radius, &r->beam_young, &r->young, &r->poisson,
               &r->lateral[0], &r->lateral[1], &r->inner, &bonds, &loose, &iterations, &r->seconds, &end);
    r->n_elements = elements;
    r->seed = seed;
    r->n_bonds = bonds;
    r->n_loose = loose;
    r->iterations = iterations;
    return n == 16 && line[end] == '\0' && isfinite(r->young) && isfinite(r->poisson);
}

static int count(const void *plan)
{
    const brc_calibration_plan *p = plan;
    return p->n_axes * p->n_radii * p->n_youngs;
}

static void key(const void *plan, uint64_t seed, double coordination, int k, void *row)
{
    const brc_calibration_plan *p = plan;
    *(brc_calibration_row *)row = (brc_calibration_row){.n_elements = p->n_elements,
                                                        .radius_spread = p->radius_spread,
                                                        .seed = seed,
                                                        .axis = k / p->n_youngs / p->n_radii,
                                                        .coordination = coordination,
                                                        .radius = p->radius[k / p->n_youngs % p->n_radii],
                                                        .beam_young = p->young[k % p->n_youngs]};
}

static bool same(const void *row, const void *wanted)
{
    const brc_calibration_row *a = row, *b = wanted;
    return a->n_elements == b->n_elements && a->radius_spread == b->radius_spread && a->seed == b->seed &&
           a->axis == b->axis && a->coordination == b->coordination && a->radius == b->radius &&
           a->beam_young == b->beam_young;
}

/* States of the pulls along one axis, those of each E_m. */
typedef struct kept_states {
    int axis, n;
    double young[BRC_CALIBRATE_LIST];
    brc_beam_states states[BRC_CALIBRATE_LIST];
} kept_states;

static void forget(void **kept)
{
    kept_states *k = *kept;
    for (int i = 0; i < k->n; ++i)
        brc_beam_states_free(&k->states[i]);
    brc_memory_free(k);
    *kept = NULL;
}

/* Those that a pull begins from: tests run over E_m, then radii, then axes. */
static brc_status states_of(brc_context *context, const brc_calibration_row *r, void **kept, brc_beam_states **out)
{
    if (*kept && ((kept_states *)*kept)->axis != r->axis) forget(kept);
    if (!*kept) BRC_TRY(brc_memory_allocate(context, kept, 1, sizeof(kept_states), "states of a sample"));
    kept_states *k = *kept;
    int i = 0;
    while (i < k->n && k->young[i] != r->beam_young)
        ++i;
    if (i == k->n) k->young[k->n++] = r->beam_young;
    k->axis = r->axis;
    *out = &k->states[i];
    return BRC_OK;
}

static brc_status test(brc_context *context, brc_device *device, const brc_domain *domain, void *row, void **kept)
{
    brc_calibration_row *r = row;
    brc_beam_answer answer;
    brc_beam_pull pull = {
        .axis = r->axis, .radius = r->radius, .beam_poisson = BEAM_POISSON, .beam_young = r->beam_young};
    BRC_TRY(states_of(context, r, kept, &pull.states));
    BRC_TRY(brc_beam_sample_pull(context, device, domain, &pull, &answer));
    r->young = answer.young;
    r->poisson = answer.poisson;
    r->lateral[0] = answer.lateral[0];
    r->lateral[1] = answer.lateral[1];
    r->inner = answer.inner;
    r->n_bonds = answer.n_bonds;
    r->n_loose = answer.n_loose;
    r->iterations = answer.iterations;
    r->seconds = answer.seconds;
    return BRC_OK;
}

static int compare(const void *left, const void *right)
{
    const brc_calibration_row *a = left, *b = right;
    const double keys[2][5] = {{a->coordination, a->radius, a->beam_young, (double)a->seed, a->axis},
                               {b->coordination, b->radius, b->beam_young, (double)b->seed, b->axis}};
    for (int k = 0; k < 5; ++k)
        if (keys[0][k] != keys[1][k]) return keys[0][k] < keys[1][k] ? -1 : 1;
    return 0;
}

brc_status brc_calibrate_campaign(brc_context *context, const brc_calibration_plan *plan, const char *folder,
                                  bool resume, brc_calibration_rows *out)
{
    static const brc_sample_campaign_kind kind = {.file = "solves.csv",
                                                  .header = header,
                                                  .title = "calibration",
                                                  .unit = "solves",
                                                  .edge = 1,
                                                  .row_size = sizeof(brc_calibration_row),
                                                  .count = count,
                                                  .key = key,
                                                  .same = same,
                                                  .compare = compare,
                                                  .print = print_line,
                                                  .parse = parse_line,
                                                  .test = test,
                                                  .forget = forget};
    brc_sample_campaign_rows rows;
    const brc_status status = brc_sample_campaign_run(context, &kind, plan, plan, folder, resume, &rows);
    *out = (brc_calibration_rows){.n = rows.n, .capacity = rows.capacity, .rows = rows.row};
    return status;
}

void brc_calibration_rows_free(brc_calibration_rows *rows)
{
    brc_memory_free(rows->rows);
    *rows = (brc_calibration_rows){0};
}
