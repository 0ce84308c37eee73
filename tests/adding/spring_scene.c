/* Model spring in scenes: nothing of its own, stiffness comes from E. */
#include "../schema_internal.h"

extern const brc_section brc_schema_spring;
const brc_section brc_schema_spring = {.title = "model spring", .meaning = "Central springs of stiffness E S / L."};

extern const brc_model_traits brc_spring_traits;
const brc_model_traits brc_spring_traits = {.spheres = false};
