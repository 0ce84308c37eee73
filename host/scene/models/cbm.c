/* Model cbm in scenes. */
#include "../schema_internal.h"

static const brc_entry CBM[] = {
    {"nu", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(-1, 0.5), FIELD(brc_model, beam_poisson), .given = "0.3",
     .meaning = "Poisson's ratio of the beams; hardly matters"},
    {"keep_isolated", BRC_TYPE_BOOL, FIELD(brc_model, keep_isolated), .given = "false",
     .meaning = "hold elements without bonds still instead of refusing the body"},
    {"polish", BRC_TYPE_BOOL, FIELD(brc_model, polish), .given = "false",
     .meaning = "correct what the laws give on the sample itself (a box) or on a cube packed like the body, by a few "
                "static solves"},
};
extern const brc_section brc_schema_cbm;
const brc_section brc_schema_cbm = {.title = "model cbm",
                                    .meaning =
                                        "The cohesive beam model of Nguyen, Andre and Huger 2019, in potential form.",
                                    ENTRIES(CBM)};

extern const brc_model_traits brc_cbm_traits;
const brc_model_traits brc_cbm_traits = {.spheres = true};
