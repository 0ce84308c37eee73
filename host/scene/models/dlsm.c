/* Model dlsm in scenes. */
#include "../schema_internal.h"

static const brc_entry DLSM[] = {
    {"compaction", BRC_TYPE_BOOL, FIELD(brc_model, compaction), .given = "true",
     .meaning = "the cross term beta that makes near-incompressible and auxetic solids accurate"},
    {"beta", BRC_TYPE_QUANTITY, "", WITHIN(0, 2), FIELD(brc_model, beta), .given = "1.06",
     .meaning = "weight of the cross term; without effect when compaction is false"},
    {"tau", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 10), FIELD(brc_model, tau), .given = "0.15",
     .why = "without it modes of the grid cost no energy", .meaning = "weight of the stabilisation"},
    BRC_SMALL_ROTATIONS,
};
extern const brc_section brc_schema_dlsm;
const brc_section brc_schema_dlsm = {.title = "model dlsm", .meaning = "The conservative law.", ENTRIES(DLSM)};

extern const brc_model_traits brc_dlsm_traits;
const brc_model_traits brc_dlsm_traits = {.deforms = true, .cohesion = true};
