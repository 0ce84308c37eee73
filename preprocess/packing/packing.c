/* The driver: how many spheres, at which density to begin, and the search of the one common scale at which the relaxed
 * packing has the wanted number of contacts. What guides the search is measured on packings of soft harmonic spheres
 * made here (docs/notebook/packing.md): relaxed at the volume fraction phi, they overlap by (phi - phi_J) / 3 on the
 * average, and have c_0 + 9.1 sqrt(phi - phi_J) contacts, phi_J being where they just touch (the square root: O'Hern,
 * Silbert, Liu, Nagel, Phys. Rev. E 68, 011306, 2003). So one relaxed packing tells how far the wanted one is away. */
#include "packing_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define DENSITY_PER_OVERLAP 3.0
#define CONTACTS_PER_ROOT 9.1
/* The packing is first relaxed so much denser than it will be: spheres are pressed into place everywhere, also at the
 * far ends of a slender shape, and then only let go. Less of it (0.03) leaves packings looser by 0.001 to 0.002. */
#define PRESSED 0.05
/* Relaxed denser than this beyond first contact, spheres overlap by 3 % and are none any more. */
#define DENSEST 0.09
/* So much overlap [-] is the end where walls or many loose spheres keep the contacts few. */
#define OVERLAP_MOST 0.06
#define OVERLAP_USUAL 0.02
#define PI 3.14159265358979323846
/* Contacts a sphere needs to be held. */
#define HOLD_LEAST 4
#define MOST_DENSITIES 16
#define MOST_ITERATIONS 20000
/* Densities at which the packing may fail to come to rest before the search is given up. */
#define MOST_RESTLESS 2
/* Contacts of spheres that carry, at most, when others lie loose in the holes between them: packings of two radii with
 * half and nine tenths of small ones reach 9.2 and 9.5 when pressed until they overlap by 6 %. */
#define CARRYING_CONTACTS 10.0
/* Forces left over [of the mean contact force] while pressed, and from then on. Less care in the first relaxation
 * (0.05) costs more iterations in the next ones, and density. */
#define TOLERANCE_PRESSED 0.02
#define TOLERANCE 0.01
/* More than this at the end is worth a word; creases of meshes alone leave 0.02. */
#define RESIDUAL_USUAL 0.05
#define DEFAULT_TOLERANCE 0.02
#define BYTES_PER_SPHERE 300.0
/* The least room, in diameters, at the thickest place of the solid. */
#define ACROSS_LEAST 2.0
/* Start points keep this distance from walls [of the mean radius]. */
#define START_MARGIN 0.5

void brc_pack_free(brc_pack **owned)
{
    brc_pack *pack = *owned;
    if (!pack) return;
    brc_progress_finish(&pack->progress);
    brc_memory_free(pack->sphere);
    brc_memory_free(pack->velocity);
    brc_memory_free(pack->force);
    brc_memory_free(pack->cell_start);
    brc_memory_free(pack->member);
    brc_memory_free(pack->place);
    brc_memory_free(pack->in_cells);
    brc_memory_free(pack->listed);
    brc_memory_free(pack->block_list);
    brc_memory_free(pack->block_need);
    brc_memory_free(pack->group_start);
    brc_memory_free(pack->neighbour);
    brc_memory_free(pack->depth_bound);
    brc_memory_free(pack->wall_row);
    brc_memory_free(pack->wall);
    brc_memory_free(pack->block);
    brc_memory_free(pack->block_moved);
    brc_memory_free(pack);
    *owned = NULL;
}

static brc_status make_room(brc_context *context, const brc_solid *solid, int64_t n, int n_threads, brc_pack *pack)
{
    pack->context = context;
    pack->solid = solid;
    pack->n_threads = n_threads;
    pack->n = n;
    pack->n_blocks = (n + BRC_PACK_BLOCK - 1) / BRC_PACK_BLOCK;
    brc_solid_bounds(solid, pack->bounds);
    static const char what[] = "spheres of the packing";
    BRC_TRY(BRC_ALLOCATE(context, &pack->sphere, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->velocity, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->force, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->member, n + BRC_PACK_PIECE, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->place, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->in_cells, 4 * (n + BRC_PACK_PIECE), what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->listed, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->group_start, n / BRC_PACK_LANES + 2 * pack->n_blocks, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->depth_bound, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->wall_row, n, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->block_list, pack->n_blocks + 1, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->block_need, pack->n_blocks, what));
    BRC_TRY(BRC_ALLOCATE(context, &pack->block, pack->n_blocks, what));
    return BRC_ALLOCATE(context, &pack->block_moved, pack->n_blocks, what);
}

brc_status brc_pack_create(brc_context *context, const brc_solid *solid, int64_t n, int n_threads, brc_pack **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "packing"));
    const brc_status status = make_room(context, solid, n, n_threads, *out);
    if (status != BRC_OK) brc_pack_free(out);
    return status;
}

void brc_pack_put(brc_pack *pack, int64_t i, const double x[3], double radius)
{
    memcpy(pack->sphere[i], x, sizeof pack->listed[i]);
    memcpy(pack->listed[i], x, sizeof pack->listed[i]);
    pack->sphere[i][3] = radius;
}

void brc_pack_set_radii(brc_pack *pack, double mean, double largest)
{
    pack->mean_radius = mean;
    pack->largest_radius = largest;
}

double (*brc_pack_spheres(brc_pack *pack))[4]
{
    return pack->sphere;
}

void brc_pack_scale(brc_pack *pack, double factor)
{
    for (int64_t i = 0; i < pack->n; ++i)
        pack->sphere[i][3] *= factor;
    pack->mean_radius *= factor;
    pack->largest_radius *= factor;
}

/* Spheres held by fewer than four contacts, also after the others of their kind are taken away: they carry nothing. */
static brc_status count_rattlers(brc_pack *pack, int64_t *n_rattlers)
{
    int8_t *held = NULL;
    *n_rattlers = 0;
    BRC_TRY(BRC_ALLOCATE(pack->context, &held, pack->n, "rattlers of the packing"));
    memset(held, 1, (size_t)pack->n);
    for (int64_t before = -1; before != *n_rattlers;) {
        before = *n_rattlers;
        for (int64_t i = 0; i < pack->n; ++i)
            if (held[i] && brc_pack_contacts(pack, i, held) < HOLD_LEAST) {
                held[i] = 0;
                ++*n_rattlers;
            }
    }
    brc_memory_free(held);
    return BRC_OK;
}

/* What is asked for, and what one can expect. */
typedef struct pack_plan {
    double volume;    /* of the solid [m^3] */
    double cube;      /* mean of (radius / mean radius)^3 */
    double touch;     /* volume fraction at which the spheres are expected to touch */
    double contacts;  /* wanted coordination number; 0: the volume fraction is wanted */
    double fraction;  /* wanted volume fraction */
    double tolerance; /* of the coordination number */
    double across;    /* diameters across the solid where it is thickest */
} pack_plan;

/* Mean radius [m] at which n spheres fill the fraction. */
static double radius_at(const pack_plan *plan, int64_t n, double fraction)
{
    return cbrt(fraction * plan->volume / ((double)n * 4.0 / 3.0 * PI * plan->cube));
}

/* Volume fraction of first contact. The dependence on the radii is that of Desmond and Weeks, Phys. Rev. E 90, 022204,
 * 2014: standard deviation over mean, and third central moment; the rest is measured here: walls leave gaps in
 * proportion to their area. */
static double expected_touch(const brc_solid *solid, const brc_fill *fill, double volume, double mean_radius)
{
    const double square = brc_pack_mean_square(fill), cube = brc_pack_mean_cube(fill);
    const double deviation = sqrt(fmax(square - 1.0, 0.0)), third = cube - 3.0 * square + 2.0;
    const double skew = deviation > 0.0 ? third / deviation : 0.0; /* skewness times deviation squared */
    const double walls = 2.0 * mean_radius * brc_solid_surface(solid) / volume;
    return fmin(fmax(0.622 + 0.066 * deviation + 0.086 * skew - 0.024 * walls, 0.5), 0.75);
}

static brc_status check_memory(brc_context *context, double n)
{
    const double physical = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (n > INT32_MAX)
        return BRC_FAIL(context, BRC_BAD_INPUT, "fill: packing %.3g spheres, at most %d are possible; use larger ones",
                        n, INT32_MAX);
    if (physical <= 0.0 || BYTES_PER_SPHERE * n <= physical) return BRC_OK;
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "fill: packing %.3g spheres needs about %.3g GB, this machine has %.3g GB; ask for at most %.2g spheres", n,
        BYTES_PER_SPHERE * n * 1e-9, physical * 1e-9, physical / BYTES_PER_SPHERE);
}

static brc_status make_plan(brc_context *context, const brc_solid *solid, const brc_fill *fill, pack_plan *plan,
                            int64_t *n)
{
    plan->volume = brc_solid_volume(solid, NULL);
    plan->cube = brc_pack_mean_cube(fill);
    plan->contacts = fill->coordination;
    plan->fraction = fill->coordination > 0.0 ? 0.0 : fill->volume_fraction;
    double radius = fill->radius > 0.0 ? fill->radius : brc_pack_mean_radius(fill), number = (double)fill->n_elements;
    if (fill->n_elements == 0) {
        const double touch = expected_touch(solid, fill, plan->volume, radius);
        const double fraction = plan->contacts > 0.0 ? touch + 0.01 : plan->fraction;
        number =
            fmax(1.0, floor(0.5 + fraction * plan->volume / (4.0 / 3.0 * PI * plan->cube * radius * radius * radius)));
    }
    BRC_TRY(check_memory(context, number));
    *n = (int64_t)number;
    for (int k = 0; k < 3; ++k) {
        plan->touch = expected_touch(solid, fill, plan->volume, radius);
        radius = radius_at(plan, *n, plan->touch);
    }
    /* a contact more or less changes the mean by 2 / n */
    plan->tolerance = fmax(fill->tolerance > 0.0 ? fill->tolerance : DEFAULT_TOLERANCE, 1.01 / (double)*n);
    const double most = plan->touch + DENSEST;
    if (plan->fraction > most)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "fill: volume fraction %.3g cannot be reached: spheres of these radii begin to overlap at about %.2f "
            "here, and above %.2f "
            "they would no longer be spheres; ask for less, or for a coordination number (6.2 is usual)",
            plan->fraction, plan->touch, most);
    if (plan->contacts > BRC_PACK_MOST_CONTACTS)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "fill: coordination number %.3g cannot be reached: random packings have about 6, and up to %.3g when "
            "pressed into each "
            "other; ask for 6.2, and let `beams` choose the number of bonds",
            plan->contacts, BRC_PACK_MOST_CONTACTS);
    const double loose = brc_pack_loose_share(fill);
    if ((1.0 - loose) * CARRYING_CONTACTS < plan->contacts)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fill: coordination number %.3g cannot be reached with this table of radii: %.0f %% of the "
                        "spheres are so small that they lie loose in the holes between the "
                        "others, and all together have at most about %.1f contacts a sphere; leave the smallest out, "
                        "take more of the middle sizes, or ask for a volume fraction",
                        plan->contacts, 100.0 * loose, (1.0 - loose) * CARRYING_CONTACTS);
    return BRC_OK;
}

static brc_status check_room(brc_context *context, const pack_plan *plan, int64_t n)
{
    const double across = plan->across;
    if (across >= ACROSS_LEAST) return BRC_OK;
    const double needed = (double)n * pow(ACROSS_LEAST / fmax(across, 0.01), 3.0);
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "fill: the shape is %.2g diameters of its %lld spheres across where it is thickest, at least %.0f are "
        "needed; use about %.2g "
        "or more elements (or smaller radii)",
        across, (long long)n, ACROSS_LEAST, 1.2 * needed);
}

/* Spheres at the start points, pressed. */
static brc_status place(brc_pack *pack, const brc_fill *fill, pack_plan *plan, double *fraction)
{
    const double expected = radius_at(plan, pack->n, plan->touch);
    *fraction = plan->contacts > 0.0 ? plan->touch + 0.01 + PRESSED : plan->fraction;
    double *start = NULL, deepest = 0.0, cube = 0.0;
    BRC_TRY(brc_pack_start(pack->context, pack->solid, fill, pack->n, START_MARGIN * expected, pack->n_threads, &start,
                           &deepest));
    plan->across = deepest / expected;
    const brc_status status = check_room(pack->context, plan, pack->n);
    for (int64_t i = 0; i < pack->n; ++i) {
        const double radius = brc_pack_radius(fill, i);
        brc_pack_put(pack, i, start + 3 * i, radius);
        cube += radius * radius * radius;
    }
    brc_memory_free(start);
    brc_pack_set_radii(pack, 1.0, brc_pack_largest(fill));
    brc_pack_scale(pack, cbrt(*fraction * plan->volume / (4.0 / 3.0 * PI * cube)));
    return status;
}

static double coordination(const brc_pack *pack, const brc_pack_sums *sums)
{
    return (double)sums->contact_ends / (double)pack->n;
}

static double mean_overlap(const brc_pack_sums *sums)
{
    return sums->contact_ends > 0 ? sums->overlap / (double)sums->contact_ends : 0.0;
}

/* The volume fraction at which a packing like this one is expected to have the wanted contacts. *least: contacts when
 * they just touch. */
static double aim(const brc_pack *pack, const pack_plan *plan, const brc_pack_sums *sums, double fraction,
                  double *least)
{
    const double beyond = DENSITY_PER_OVERLAP * mean_overlap(sums), now = coordination(pack, sums);
    *least = now - CONTACTS_PER_ROOT * sqrt(beyond);
    const double root = fmax((plan->contacts - *least) / CONTACTS_PER_ROOT, 0.0);
    const double change = root * root - beyond;
    return fraction + fmin(change, 0.01);
}

/* Why the wanted number of contacts does not come, and what to change. */
static brc_status not_reached(brc_pack *pack, const pack_plan *plan, const brc_pack_sums *sums, int32_t relaxations,
                              double least)
{
    const double now = coordination(pack, sums);
    if (mean_overlap(sums) > OVERLAP_MOST)
        return BRC_FAIL(
            pack->context, BRC_BAD_INPUT,
            "fill: coordination number %.3g cannot be reached: pressed until they overlap by %.1f %%, the spheres "
            "have %.2f contacts (walls "
            "have no part in the number, and the shape is only %.2g diameters across where it is thickest); use more "
            "and so smaller "
            "spheres, or ask for a smaller number or a volume fraction",
            plan->contacts, 100.0 * mean_overlap(sums), now, plan->across);
    if (plan->contacts < least)
        return BRC_FAIL(
            pack->context, BRC_BAD_INPUT,
            "fill: coordination number %.3g cannot be reached: at rest a packing in this shape has at least about "
            "%.2f contacts a sphere, "
            "with fewer it falls apart; ask for 6.2, or for a volume fraction below %.2f",
            plan->contacts, least, plan->touch);
    return BRC_FAIL(
        pack->context, BRC_BAD_INPUT,
        "fill: coordination number %.3g was not met within %.2g in %d relaxations, but %.3f: with %lld spheres it "
        "changes in jumps; use "
        "more spheres, a larger tolerance or another seed",
        plan->contacts, plan->tolerance, relaxations, now, (long long)pack->n);
}

/* Relax at the wanted volume fraction, or search the one with the wanted contacts. */
static brc_status search(brc_pack *pack, const pack_plan *plan, double fraction, brc_packing *out)
{
    int restless = 0;
    for (out->relaxations = 1;; ++out->relaxations) {
        const bool strict = out->relaxations > 1;
        brc_pack_sums sums;
        bool converged;
        BRC_TRY(brc_pack_relax(pack, strict ? TOLERANCE : TOLERANCE_PRESSED, MOST_ITERATIONS, &sums, &converged));
        out->coordination = coordination(pack, &sums);
        brc_log(pack->context, BRC_LOG_DEBUG,
                "packing: volume fraction %.5f gives coordination %.3f, overlaps %.3f %%, after %lld iterations",
                fraction, out->coordination, 100.0 * mean_overlap(&sums), (long long)pack->iterations);
        const bool there = plan->contacts == 0.0 || fabs(out->coordination - plan->contacts) <= plan->tolerance;
        if (there && strict) return BRC_OK;
        if (there) continue;
        restless += !converged;
        /* not even as dense as spheres may be it would have enough */
        const bool hopeless = !converged && out->coordination + CONTACTS_PER_ROOT * sqrt(DENSEST) < plan->contacts;
        if (restless > MOST_RESTLESS || hopeless)
            return BRC_FAIL(
                pack->context, BRC_BAD_INPUT,
                "fill: coordination number %.3g was not found: %d times the packing did not come to rest in %d "
                "iterations (it has %.3f); use "
                "radii that differ less (the largest is %.3g times the mean), more spheres, or a volume fraction",
                plan->contacts, restless, MOST_ITERATIONS, out->coordination, pack->largest_radius / pack->mean_radius);
        double least;
        const double next = aim(pack, plan, &sums, fraction, &least);
        if (out->relaxations >= MOST_DENSITIES ||
            (strict && (plan->contacts < least || mean_overlap(&sums) > OVERLAP_MOST)))
            return not_reached(pack, plan, &sums, out->relaxations, least);
        brc_pack_scale(pack, cbrt(next / fraction));
        fraction = next;
    }
}

/* Final numbers; positions and radii change hands. */
static brc_status finish(brc_pack *pack, const brc_fill *fill, const pack_plan *plan, brc_packing *out)
{
    BRC_TRY(brc_pack_list(pack, 0.01 * pack->mean_radius));
    const brc_pack_sums sums = brc_pack_forces(pack, NULL);
    int64_t n_rattlers;
    BRC_TRY(count_rattlers(pack, &n_rattlers));
    out->rattlers = (double)n_rattlers / (double)pack->n;
    out->coordination = coordination(pack, &sums);
    out->overlap_mean = mean_overlap(&sums);
    out->wall_overlap_mean = sums.wall_contacts > 0 ? sums.wall_overlap / (double)sums.wall_contacts : 0.0;
    out->residual = sums.contact_force > 0.0
                        ? sqrt(sums.force_square / (double)pack->n) * (double)sums.contact_ends / sums.contact_force
                        : 0.0;
    out->crystal = -1.0;
    if (fill->check_crystal) BRC_TRY(brc_pack_crystal(pack, &out->crystal));
    out->n = pack->n;
    out->iterations = (int32_t)pack->iterations;
    brc_memory_free(pack->velocity); /* what comes now is the last to be allocated: not on top of what is done */
    brc_memory_free(pack->force);
    pack->velocity = pack->force = NULL;
    BRC_TRY(BRC_ALLOCATE(pack->context, &out->position, 3 * pack->n, "packing"));
    BRC_TRY(BRC_ALLOCATE(pack->context, &out->radius, pack->n, "packing"));
    double cube = 0.0, radius = 0.0;
    for (int64_t i = 0; i < pack->n; ++i) {
        const double *const x = pack->sphere[i];
        if (!brc_solid_inside(pack->solid, x, 0.0))
            return BRC_FAIL(pack->context, BRC_INTERNAL, "sphere %lld at %g %g %g m was packed outside the shape",
                            (long long)i, x[0], x[1], x[2]);
        memcpy(out->position + 3 * i, x, 3 * sizeof *x);
        out->radius[i] = x[3];
        radius += x[3];
        cube += x[3] * x[3] * x[3];
    }
    out->volume_fraction = 4.0 / 3.0 * PI * cube / plan->volume;
    brc_log(pack->context, BRC_LOG_INFO,
            "packing: %lld spheres of %.4g m mean radius, coordination %.3f, volume fraction %.4f, mean overlap %.2g "
            "%%, %.3g %% loose",
            (long long)pack->n, radius / (double)pack->n, out->coordination, out->volume_fraction,
            100.0 * out->overlap_mean, 100.0 * out->rattlers);
    if (out->overlap_mean > OVERLAP_USUAL)
        brc_log(
            pack->context, BRC_LOG_WARNING,
            "packing: spheres overlap by %.2g %% in the mean (usual: below %.0f %%): the shape is only %.2g diameters "
            "across where it is thickest, the radii "
            "vary much, or too many contacts or too much volume was asked for",
            100.0 * out->overlap_mean, 100.0 * OVERLAP_USUAL, plan->across);
    if (out->residual > RESIDUAL_USUAL && out->overlap_mean > 1e-5)
        brc_log(
            pack->context, BRC_LOG_WARNING,
            "packing: forces of %.2g %% of the mean contact force are left over after %d iterations (wanted: %.0f %%)",
            100.0 * out->residual, (int)out->iterations, 100.0 * TOLERANCE);
    if (out->crystal >= 0.0)
        brc_log(pack->context, BRC_LOG_INFO, "packing: %.2g %% in ordered surroundings", 100.0 * out->crystal);
    return BRC_OK;
}

brc_status brc_packing_make(brc_context *context, const brc_solid *solid, const brc_fill *fill, int n_threads,
                            brc_packing *out)
{
    memset(out, 0, sizeof *out);
    brc_pack *pack = NULL;
    pack_plan plan = {0};
    int64_t n;
    double fraction;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, make_plan(context, solid, fill, &plan, &n));
    BRC_TRY_OR(cleanup, brc_pack_create(context, solid, n, n_threads, &pack));
    BRC_TRY_OR(cleanup, place(pack, fill, &plan, &fraction));
    BRC_TRY_OR(cleanup, brc_progress_create(context, &pack->progress, "packing", 0, "iterations", (double)n,
                                            "sphere updates/s"));
    BRC_TRY_OR(cleanup, search(pack, &plan, fraction, out));
    brc_progress_finish(&pack->progress);
    status = finish(pack, fill, &plan, out);
cleanup:
    brc_pack_free(&pack);
    if (status != BRC_OK) brc_packing_free(out);
    return status;
}

void brc_packing_free(brc_packing *packing)
{
    brc_memory_free(packing->position);
    brc_memory_free(packing->radius);
    memset(packing, 0, sizeof *packing);
}
