#include "card.h"
#include <math.h>

/* Numbers of kernels/dlsm_passes.cl, published_passes.cl, cbm.cl and motion.cl, one material, finite strain, nu >= 0.
 */
const brc_card_pass brc_card_passes[] = {
    {"dlsm", "dlsm_gradient", 1, 3, 0, 0, 3, 6 + 9, {[BRC_CARD_PLACE] = 1}, 12},
    {"dlsm", "dlsm_stress", 1, 6, 0, 0, 0, 9 + 1 + 9, {[BRC_CARD_MATRIX] = 1}, 27},
    {"dlsm", "dlsm_flux_pass", 1, 7, 1, 3, 0, 9 + 9 + 6 + 1 + 9, {[BRC_CARD_MATRIX] = 2}, 115},
    {"dlsm", "dlsm_force", 1, 4, 0, 0, 3 + 3, 9, {[BRC_CARD_PLACE] = 1, [BRC_CARD_MATRIX] = 1}, 38},
    {"dlsm", "advance", 0, 0, 0, 0, 16, 0, {0}, 0},
    {"dlsm-published",
     "published_strain_pass",
     1,
     3,
     0,
     0,
     3 + 4,
     6 + 6,
     {[BRC_CARD_PLACE] = 1, [BRC_CARD_ORIENTATION] = 1},
     34},
    {"dlsm-published",
     "published_force_pass",
     1,
     4,
     0,
     0,
     3 + 4 + 6,
     6,
     {[BRC_CARD_PLACE] = 1, [BRC_CARD_ORIENTATION] = 1, [BRC_CARD_STRAIN] = 1},
     443},
    {"dlsm-published", "advance", 0, 0, 0, 0, 16, 0, {0}, 0},
    {"dlsm-published", "advance_rotation", 0, 0, 0, 0, 18, 0, {0}, 0},
    {"cbm", "cbm_force_pass", 1, 4, 0, 0, 3 + 4 + 6, 0, {[BRC_CARD_PLACE] = 1, [BRC_CARD_ORIENTATION] = 1}, 166},
    {"cbm", "advance", 0, 0, 0, 0, 16, 0, {0}, 0},
    {"cbm", "advance_rotation", 0, 0, 0, 0, 18, 0, {0}, 0},
};
const int brc_card_n_passes = sizeof brc_card_passes / sizeof brc_card_passes[0];

/* Launches and memory as measured (bench/results/2026-11-26-nvidia-h200); L2 as measured of an H100, operations of 132
 * multiprocessors at 1.7 GHz. */
const brc_card brc_card_h200 = {.name = "H200",
                                .launch_s = 6.5e-6,
                                .copy = 3.8e12,
                                .memory = 2.27e12,
                                .cache = 5.5e12,
                                .doubles = 14.4e12,
                                .singles = 28.7e12};

double brc_card_seconds(const brc_card *card, const brc_card_traffic *traffic, brc_precision precision,
                        double half_edges)
{
    const double rate = precision == BRC_DOUBLE ? card->doubles : card->singles;
    const double slowest =
        fmax(fmax(traffic->memory / card->memory, traffic->cache / card->cache), traffic->operations / rate);
    return card->launch_s + half_edges * slowest;
}
