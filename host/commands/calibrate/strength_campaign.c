/* The fracture tests of a campaign (sample_campaign.h). */
#include "strength_campaign.h"
#include "sample_campaign.h"
#include "strength_test.h"
#include "../../base/memory.h"
#include <math.h>

/* The paper's cube [m], and nu_m, which hardly matters (0.3 % of E from 0 to 0.45). */
#define EDGE 2e-3
#define BEAM_POISSON 0.3

static const char header[] = "elements,radius_spread,seed,axis,cn,r_m,E_m_Pa,sigma_m_Pa,passages,k,k_first,strain,"
                             "bonds,loose,broken,steps,seconds\n";

static void print_line(const void *row, char *out, size_t room)
{
    const brc_strength_row *r = row;
    snprintf(out, room, "%lld,%.17g,%llu,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%lld,%lld,%lld,%lld,%.3f\n",
             (long long)r->n_elements, r->radius_spread, (unsigned long long)r->seed, r->axis, r->coordination,
             r->radius, r->beam_young, r->limit, r->passages, r->ratio, r->first, r->strain, (long long)r->n_bonds,
             (long long)r->n_loose, (long long)r->n_broken, (long long)r->n_steps, r->seconds);
}

static bool parse_line(const char *line, void *row)
{
    brc_strength_row *r = row;
    long long elements, bonds, loose, broken, steps;
    unsigned long long seed;
    int end = 0;
    const int n =
        sscanf(line, "%lld,%lf,%llu,%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lld,%lld,%lld,%lld,%lf%n", &elements,
               &r->radius_spread, &seed, &r->axis, &r->coordination, &r->radius, &r->beam_young, &r->limit,
               &r->passages, &r->ratio, &r->first, &r->strain, &bonds, &loose, &broken, &steps, &r->seconds, &end);
    r->n_elements = elements;
    r->seed = seed;
    r->n_bonds = bonds;
    r->n_loose = loose;
    r->n_broken = broken;
    r->n_steps = steps;
    return n == 17 && line[end] == '\0' && isfinite(r->ratio) && isfinite(r->first);
}

static int count(const void *plan)
{
    const brc_strength_plan *p = plan;
    return p->samples.n_axes * p->samples.n_radii * p->samples.n_youngs * p->n_limits;
}

static void key(const void *plan, uint64_t seed, double coordination, int k, void *row)
{
    const brc_strength_plan *p = plan;
    const brc_calibration_plan *s = &p->samples;
    const int limit = k % p->n_limits, young = k / p->n_limits % s->n_youngs,
              radius = k / p->n_limits / s->n_youngs % s->n_radii;
    *(brc_strength_row *)row = (brc_strength_row){.n_elements = s->n_elements,
                                                  .radius_spread = s->radius_spread,
                                                  .seed = seed,
                                                  .axis = k / p->n_limits / s->n_youngs / s->n_radii,
                                                  .coordination = coordination,
                                                  .radius = s->radius[radius],
                                                  .beam_young = s->young[young],
                                                  .limit = p->limit[limit],
                                                  .passages = p->passages};
}

static bool same(const void *row, const void *wanted)
{
    const brc_strength_row *a = row, *b = wanted;
    return a->n_elements == b->n_elements && a->radius_spread == b->radius_spread && a->seed == b->seed &&
           a->axis == b->axis && a->coordination == b->coordination && a->radius == b->radius &&
           a->beam_young == b->beam_young && a->limit == b->limit && a->passages == b->passages;
}

static brc_status test(brc_context *context, brc_device *device, const brc_domain *domain, void *row, void **kept)
{
    (void)kept;
    brc_strength_row *r = row;
    brc_strength_answer answer;
    const brc_strength_pull pull = {.axis = r->axis,
                                    .radius_spread = r->radius_spread,
                                    .radius = r->radius,
                                    .beam_poisson = BEAM_POISSON,
                                    .beam_young = r->beam_young,
                                    .limit = r->limit,
                                    .passages = r->passages};
    BRC_TRY(brc_strength_test(context, device, domain, &pull, &answer));
    r->ratio = answer.ratio;
    r->first = answer.first;
    r->strain = answer.strain;
    r->n_bonds = answer.n_bonds;
    r->n_loose = answer.n_loose;
    r->n_broken = answer.n_broken;
    r->n_steps = answer.n_steps;
    r->seconds = answer.seconds;
    return BRC_OK;
}

static int compare(const void *left, const void *right)
{
    const brc_strength_row *a = left, *b = right;
    const double keys[2][6] = {{a->coordination, a->radius, a->beam_young, a->limit, (double)a->seed, a->axis},
                               {b->coordination, b->radius, b->beam_young, b->limit, (double)b->seed, b->axis}};
    for (int k = 0; k < 6; ++k)
        if (keys[0][k] != keys[1][k]) return keys[0][k] < keys[1][k] ? -1 : 1;
    return 0;
}

brc_status brc_strength_campaign(brc_context *context, const brc_strength_plan *plan, const char *folder, bool resume,
                                 brc_strength_rows *out)
{
    static const brc_sample_campaign_kind kind = {.file = "tests.csv",
                                                  .header = header,
                                                  .title = "fracture tests",
                                                  .unit = "tests",
                                                  .edge = EDGE,
                                                  .row_size = sizeof(brc_strength_row),
                                                  .count = count,
                                                  .key = key,
                                                  .same = same,
                                                  .compare = compare,
                                                  .print = print_line,
                                                  .parse = parse_line,
                                                  .test = test};
    brc_sample_campaign_rows rows;
    const brc_status status = brc_sample_campaign_run(context, &kind, &plan->samples, plan, folder, resume, &rows);
    *out = (brc_strength_rows){.n = rows.n, .capacity = rows.capacity, .rows = rows.row};
    return status;
}

void brc_strength_rows_free(brc_strength_rows *rows)
{
    brc_memory_free(rows->rows);
    *rows = (brc_strength_rows){0};
}
