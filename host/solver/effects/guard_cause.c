#include "guard_cause.h"
#include "fracture/fracture.h"
#include "../core/sym3.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Neighbours that span their weakest direction by less than this part of the strongest are named as the cause: boundary
 * cells of unrelaxed grids have 0.1 and more. */
static const double weak_span = 0.03;

void brc_text_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, size - used, format, list);
    va_end(list);
}

/* Smallest over largest span of an element's neighbours [-]: eigenvalues of the sum of r (x) r over its bonds. */
static double span_of(const brc_domain *d, int64_t e)
{
    double sum[6] = {0}, values[3];
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        double r[3], square = 0;
        for (int c = 0; c < 3; ++c) {
            r[c] = d->position[3 * (int64_t)d->neighbour[h] + c] - d->position[3 * e + c];
            square += r[c] * r[c];
        }
        for (int c = 0; c < 3; ++c) { /* xx yy zz, yz xz xy */
            sum[c] += r[c] * r[c] / square;
            sum[3 + c] += r[(c + 1) % 3] * r[(c + 2) % 3] / square;
        }
    }
    brc_sym3_eigen(sum, values, NULL);
    return values[2] > 0 ? values[0] / values[2] : 0;
}

void brc_guard_tell_element(brc_simulation *s, int64_t e, char *text, size_t size)
{
    const brc_domain *d = s->domain;
    const double *x = d->position + 3 * e;
    const int64_t n_bonds = d->row_start[e + 1] - d->row_start[e];
    brc_text_append(text, size, "element %lld, at (%.4g, %.4g, %.4g) m when undeformed, body '%s', has %lld bonds",
                    (long long)e, x[0], x[1], x[2], s->scene->bodies[d->body[e]].name, (long long)n_bonds);
    if (n_bonds > 0 && !brc_has_spheres(s))
        brc_text_append(text, size, " (its neighbours span one direction by %.2g of another)", span_of(d, e));
    int64_t n = 0, broken = 0;
    const brc_break *breaks = NULL;
    if (s->fracture && brc_simulation_breaks(s, &n, &breaks) != BRC_OK) n = 0;
    for (int64_t k = 0; k < n; ++k)
        broken += breaks[k].element_i == e || breaks[k].element_j == e;
    if (!s->fracture)
        brc_text_append(text, size, ", which cannot break.");
    else if (broken == 0)
        brc_text_append(text, size, ", none broken.");
    else
        brc_text_append(text, size, ", %lld of them broken, last:", (long long)broken);
    int listed = 0;
    for (int64_t k = n - 1; k >= 0 && listed < 3; --k) {
        const brc_break *b = breaks + k;
        if (b->element_i != e && b->element_j != e) continue;
        brc_text_append(text, size, "%s bond %d to element %d in %s at step %lld", listed++ ? "," : "", b->bond,
                        b->element_i == e ? b->element_j : b->element_i, brc_break_mode_name(b->mode),
                        (long long)b->step);
    }
    if (listed > 0) brc_text_append(text, size, ".");
}

void brc_guard_tell_cause(const brc_simulation *s, int64_t e, double off, char *text, size_t size)
{
    const double safety = brc_simulation_time_step(s).safety;
    /* at whole steps velocity Verlet shows up to s^2 / (1 - s^2) more energy than it keeps, in the highest mode at s of
     * the critical step */
    const double own = safety < 1 ? safety * safety / (1 - safety * safety) : 0;
    if (safety > 1)
        brc_text_append(text, size, "the time step is %.3g times the critical one: use time_step: auto", safety);
    else if (!s->model->conserves)
        s->model->explain_loss(s, text, size);
    else if (off != 0 && fabs(off) < 0.1 * own)
        brc_text_append(
            text, size,
            "time step: velocity Verlet's own oscillation is of this size at %.3g of the critical step; use a smaller "
            "safety, or a wider guard.closure",
            safety);
    else if (s->model->explain_loss)
        s->model->explain_loss(s, text, size);
    else if (e >= 0 && s->domain->row_start[e + 1] > s->domain->row_start[e] && span_of(s->domain, e) < weak_span)
        brc_text_append(
            text, size,
            "geometry: neighbours of element %lld lie nearly in a plane or a line (breccia build prints the quality of "
            "the body); relax the cells (lloyd) or use more of them",
            (long long)e);
    else if (s->scene->has_contact)
        brc_text_append(
            text, size,
            "contact stiffness: a contact stiffer than the cells shortens the critical step; take a softer one, or a "
            "smaller safety than %.3g",
            safety);
    else /* frequencies rise with the stretch e as sqrt(1 + 3 e + 3 e^2 / 2), St. Venant-Kirchhoff's tangent */
        brc_text_append(
            text, size,
            "strain: stretches of %.2g %% or more raise the highest frequency beyond what a step of %.3g of the "
            "critical one bears, and a compression of "
            "more than 40 %% has no stiffness left; use a smaller safety, or a gentler load",
            100 * (sqrt(1 + 2. / 3 * (1 / (safety * safety) - 1)) - 1), safety);
}
