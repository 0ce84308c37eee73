/* Model dlsm-published in scenes. */
#include "../schema_internal.h"

static const brc_entry PUBLISHED[] = {
    {"area_weights", BRC_TYPE_BOOL, FIELD(brc_model, area_weights), .given = "false",
     .meaning = "least squares weighted with face area over distance instead of 1"},
    {"rotation_stiffness", BRC_TYPE_QUANTITY, "", NOT_NEGATIVE, FIELD(brc_model, rotation_stiffness), .given = "1",
     .meaning = "factor on the published stiffness against spurious rotation"},
    {"couple_modulus", BRC_TYPE_QUANTITY, "", NOT_NEGATIVE, FIELD(brc_model, couple_modulus), .given = "0",
     .meaning = "of mu: holds the frames of elements to the solid as it turns, which the published law (0) does not; "
                "0.5 is enough at strains of 20 %; dynamic stages only"},
    BRC_SMALL_ROTATIONS,
};
extern const brc_section brc_schema_published;
const brc_section brc_schema_published = {.title = "model dlsm-published",
                                          .meaning = "The law as Andre, Girardot and Hubert published it in 2019.",
                                          ENTRIES(PUBLISHED)};

extern const brc_model_traits brc_published_traits;
const brc_model_traits brc_published_traits = {.spheres = false};
