/* Forces of soft spheres, and their relaxation to rest by FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006, with
 * the step back of Guenole et al., Comput. Mater. Sci. 175, 109584, 2020): damped motion of unit masses that turns
 * towards the forces while it runs downhill and stops where it would climb. */
#include "packing_internal.h"

#include <math.h>
#include <string.h>

/* Stiffness and mass are 1, so that steps are in units of sqrt(m / k). */
#define STEP_START 0.1
#define STEP_MOST 0.6
#define STEP_GROWS 1.1
#define STEP_SHRINKS 0.5
#define TURN_START 0.1
#define TURN_SHRINKS 0.98
#define DOWNHILL_LEAST 5 /* iterations downhill before the step grows */
/* No sphere moves farther in one iteration [of the mean radius]: nothing jumps a wall or another sphere. */
#define MOVE_MOST 0.1
/* Contacts overlap less than this on the average [-]: nothing carries. */
#define OVERLAP_LEAST 1e-6
/* Reach of the lists beyond contact [of the mean radius] at the start and once the spheres only settle. */
#define SKIN_WIDE 0.3
#define SKIN_NARROW 0.12

static void add_sums(brc_pack_sums *to, const brc_pack_sums *sums)
{
    to->energy += sums->energy;
    to->power += sums->power;
    to->force_square += sums->force_square;
    to->velocity_square += sums->velocity_square;
    to->contact_force += sums->contact_force;
    to->overlap += sums->overlap;
    to->wall_force += sums->wall_force;
    to->wall_overlap += sums->wall_overlap;
    to->contact_ends += sums->contact_ends;
    to->wall_contacts += sums->wall_contacts;
}

/* Forces of block b. */
static brc_pack_sums block_forces(brc_pack *pack, int64_t b, brc_pack_add_contacts *add_contacts)
{
    brc_pack_sums sums = {0};
    const int64_t end = (b + 1) * BRC_PACK_BLOCK < pack->n ? (b + 1) * BRC_PACK_BLOCK : pack->n;
    for (int64_t first = b * BRC_PACK_BLOCK; first < end; first += BRC_PACK_LANES) {
        brc_pack_contact_sums contacts;
        add_contacts(pack, first / BRC_PACK_LANES, &contacts);
        for (int l = 0; l < BRC_PACK_LANES && first + l < end; ++l) {
            const int64_t i = first + l;
            double *const f = pack->force[i], *const v = pack->velocity[i];
            memcpy(f, contacts.force[l], sizeof contacts.force[l]);
            sums.energy += 0.25 * contacts.energy[l]; /* every contact is met from both sides */
            sums.contact_force += contacts.contact_force[l];
            sums.overlap += contacts.overlap[l];
            sums.contact_ends += contacts.n[l];
            brc_pack_add_walls(pack, i, f, &sums);
            sums.power += f[0] * v[0] + f[1] * v[1] + f[2] * v[2];
            sums.force_square += f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
            sums.velocity_square += v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        }
    }
    return sums;
}

brc_pack_sums brc_pack_forces(brc_pack *pack, const double (**force)[3])
{
    brc_pack_add_contacts *const add_contacts = brc_pack_contacts_of_group();
    if (force) *force = (const double(*)[3])pack->force;
#pragma omp parallel for schedule(static) num_threads(pack->n_threads)
    for (int64_t b = 0; b < pack->n_blocks; ++b)
        pack->block[b] = block_forces(pack, b, add_contacts);
    brc_pack_sums all = {0};
    for (int64_t b = 0; b < pack->n_blocks; ++b)
        add_sums(&all, pack->block + b);
    return all;
}

int brc_pack_contacts(const brc_pack *pack, int64_t i, const int8_t *counts)
{
    const double *const a = pack->sphere[i];
    const int32_t *other;
    int64_t step;
    const int64_t n_others = brc_pack_neighbours(pack, i, &other, &step);
    int n = brc_pack_wall_contacts(pack, i);
    for (int64_t k = 0; k < n_others; ++k) {
        const int32_t j = other[k * step];
        const double *const b = pack->sphere[j];
        const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], touch = a[3] + b[3];
        n += counts[j] && x * x + y * y + z * z < touch * touch;
    }
    return n;
}

typedef struct fire {
    double step, turn;
    int64_t downhill;
} fire;

/* x += back v, v = keep v + push f, x += step v; returns the largest square of a way since the list was made. */
static double move(brc_pack *pack, double back, double keep, double push, double step)
{
    const double most = MOVE_MOST * pack->mean_radius;
#pragma omp parallel for schedule(static) num_threads(pack->n_threads)
    for (int64_t b = 0; b < pack->n_blocks; ++b) {
        double moved = 0.0;
        const int64_t end = (b + 1) * BRC_PACK_BLOCK < pack->n ? (b + 1) * BRC_PACK_BLOCK : pack->n;
        for (int64_t i = b * BRC_PACK_BLOCK; i < end; ++i) {
            double *const x = pack->sphere[i], *const v = pack->velocity[i];
            const double *const f = pack->force[i], *const from = pack->listed[i];
            double way[3], square = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double fresh = keep * v[c] + push * f[c];
                way[c] = back * v[c] + step * fresh;
                v[c] = fresh;
                square += way[c] * way[c];
            }
            const double shorten = square > most * most ? most / sqrt(square) : 1.0;
            double since = 0.0;
            for (int c = 0; c < 3; ++c) {
                x[c] += shorten * way[c];
                since += (x[c] - from[c]) * (x[c] - from[c]);
            }
            moved = since > moved ? since : moved;
        }
        pack->block_moved[b] = moved;
    }
    double moved = 0.0;
    for (int64_t b = 0; b < pack->n_blocks; ++b)
        moved = fmax(moved, pack->block_moved[b]);
    return moved;
}

/* One step from the forces in `sums`. */
static double fire_step(brc_pack *pack, fire *state, const brc_pack_sums *sums)
{
    double back = 0.0, keep = 1.0;
    if (sums->power > 0.0) {
        if (++state->downhill > DOWNHILL_LEAST) {
            state->step = fmin(state->step * STEP_GROWS, STEP_MOST);
            state->turn *= TURN_SHRINKS;
        }
    } else {
        back = sums->velocity_square > 0.0 ? -0.5 * state->step : 0.0; /* half the last way */
        keep = 0.0;
        if (sums->velocity_square > 0.0) state->step = fmax(state->step * STEP_SHRINKS, 1e-3);
        state->turn = TURN_START;
        state->downhill = 0;
    }
    /* |v + step f| from the sums; the part `turn` of it is laid along the force */
    const double speed = sqrt(keep * sums->velocity_square + 2.0 * keep * state->step * sums->power +
                              state->step * state->step * sums->force_square);
    const double along = sums->force_square > 0.0 ? state->turn * speed / sqrt(sums->force_square) : 0.0;
    return move(pack, back, keep * (1.0 - state->turn), (1.0 - state->turn) * state->step + along, state->step);
}

brc_status brc_pack_relax(brc_pack *pack, double tolerance, int64_t most, brc_pack_sums *sums, bool *converged)
{
    fire state = {.step = STEP_START, .turn = TURN_START};
    double skin = SKIN_WIDE * pack->mean_radius;
    int64_t since_list = 0;
    memset(pack->velocity, 0, (size_t)pack->n * sizeof *pack->velocity);
    BRC_TRY(brc_pack_list(pack, skin));
    *converged = false;
    for (int64_t k = 0; k < most; ++k) {
        *sums = brc_pack_forces(pack, NULL);
        brc_progress_update(pack->progress, ++pack->iterations);
        const double ends = (double)(sums->contact_ends > 0 ? sums->contact_ends : 1);
        const double mean_force = sums->contact_force / ends;
        *converged = sqrt(sums->force_square / (double)pack->n) <= tolerance * mean_force ||
                     sums->overlap / ends < OVERLAP_LEAST;
        if (*converged) break;
        const double moved = fire_step(pack, &state, sums);
        ++since_list;
        if (4.0 * moved < skin * skin) continue;
        if (since_list > 100) skin = SKIN_NARROW * pack->mean_radius;
        since_list = 0;
        BRC_TRY(brc_pack_list(pack, skin));
    }
    return BRC_OK;
}
