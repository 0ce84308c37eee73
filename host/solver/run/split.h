/* The parts of a scene: bodies whose models differ are moved by simulations of their own, each of which is given a
 * scene that holds its bodies and what concerns them. A scene of one model is its own only part. */
#ifndef BRC_SOLVER_SPLIT_H
#define BRC_SOLVER_SPLIT_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"

typedef struct brc_scene_part {
    char name[BRC_NAME]; /* of its model; with a number where an earlier part has one of the kind: "dlsm", "cbm",
                            "dlsm-2" */
    brc_scene *scene;    /* the whole where it is the only part; else its own, which borrows from the whole */
    int32_t n_bodies;
    int32_t *body;   /* [n_bodies] index in the whole scene of each of its bodies */
    int32_t *sensor; /* [scene->n_sensors] index in the whole scene of each of its sensors */
} brc_scene_part;

typedef struct brc_split {
    const brc_scene *scene; /* the whole; borrowed */
    int32_t n;              /* parts, in the order of their first bodies */
    brc_scene_part *part;   /* [n] */
} brc_split;

/* One part for every model that moves a body; models with other parameters are others. `scene` is borrowed until the
 * split is freed; where all bodies have one model, that becomes the scene's own. The parts have no loads, initial
 * fields and sensors yet. BRC_BAD_INPUT: a material that two parts of beams would polish differently; BRC_NO_MEMORY. */
brc_status brc_split_create(brc_context *context, brc_scene *scene, brc_split **out);
/* Accepts NULL and a pointer to NULL. */
void brc_split_free(brc_split **split);

/* Hand out loads, initial fields and sensors, once the parts' domains [n] are there (borrowed for the call):
 * - a load or initial field goes to every part in which its set has members, a load per area also where the set's
 *   region cuts faces only (loaded_faces.h); a total force (element_force) is shared by the number of the
 *   elements or their mass; a field without a set goes to all parts;
 * - a sensor goes to the part that owns its set, or the element nearest to its point; sums (reaction, moment, broken
 *   bonds ...) and extremes go to all
 *   that have some of the set. Energies and modes are read from the whole and go to none.
 * What no part can own goes to one that refuses it by its usual sentence. BRC_BAD_INPUT, all in one pass: a mean over
 * bodies of several models, a strain between two models, a file of initial values for all bodies, a measure's area on
 * walls of several models. */
brc_status brc_split_share(brc_context *context, brc_split *split, const brc_domain *const *domain);

/* Do two models move bodies alike, with all their parameters? */
bool brc_split_same_model(const brc_model *a, const brc_model *b);

/* How the values of one sensor in several parts make one. */
typedef enum brc_combine {
    BRC_COMBINE_NONE, /* it belongs to one part */
    BRC_COMBINE_SUM,
    BRC_COMBINE_LARGEST,
    BRC_COMBINE_LARGEST_MASS, /* shares of a part's mass: the largest, as a share of the mass of all */
    BRC_COMBINE_WHOLE         /* no part reads it: the ledger, the modes */
} brc_combine;
brc_combine brc_split_combine(const brc_sensor *sensor);
/* Part whose domain has members in the set; -1: none. */
int32_t brc_split_owner(const brc_split *split, const brc_domain *const *domain, const char *set);
/* Mass of a part's bodies [kg]. */
double brc_split_mass(const brc_scene_part *part, const brc_domain *domain);
/* "'anvil', 'ball'": the bodies of a part, cut where `room` ends. Returns words. */
const char *brc_split_bodies(const brc_split *split, int32_t part, char *words, size_t room);

#endif
