#include "skin_report.h"
#include "../text.h"
#include <math.h>
#include <stdio.h>

/* to: infinite for the core. */
static void add_row(brc_text *text, double from, double to, const brc_skin_layer *layer)
{
    const double numbers[] = {from,
                              to,
                              layer->volume,
                              layer->solid,
                              (double)layer->n_elements,
                              layer->coordination,
                              layer->stiffness[BRC_SKIN_ALONG],
                              layer->stiffness[BRC_SKIN_SHEAR],
                              layer->stiffness[BRC_SKIN_ACROSS]};
    const int n = sizeof numbers / sizeof *numbers;
    for (int k = 0; k < n; ++k) {
        if (isfinite(numbers[k])) brc_text_add_number(text, numbers[k]);
        brc_text_add(text, k < n - 1 ? "," : "\n");
    }
}

static void print_row(const char *depth, const brc_skin_layer *layer)
{
    printf("%-12s %8.3f %10lld %8.2f %8.3f %8.3f %8.3f\n", depth, layer->solid, (long long)layer->n_elements,
           layer->coordination, layer->stiffness[BRC_SKIN_ALONG], layer->stiffness[BRC_SKIN_SHEAR],
           layer->stiffness[BRC_SKIN_ACROSS]);
}

brc_status brc_skin_report(brc_context *context, const brc_skin *skin, const char *path)
{
    brc_text text = {.context = context};
    char depth[32];
    brc_text_add(&text, "from_diameters,to_diameters,volume_m3,solid_fraction,elements,coordination,stiffness_along,"
                        "stiffness_shear,stiffness_across\n");
    printf("Skin: depth below the surface in mean diameters (%.4g m); stiffness of the beams under uniform strain over "
           "that of the core\n",
           skin->diameter);
    printf("%-12s %8s %10s %8s %8s %8s %8s\n", "depth", "solid", "elements", "bonds", "along", "shear", "across");
    for (int k = 0; k < BRC_SKIN_LAYERS; ++k) {
        add_row(&text, k * BRC_SKIN_THICKNESS, (k + 1) * BRC_SKIN_THICKNESS, &skin->layer[k]);
        snprintf(depth, sizeof depth, "%.2f - %.2f", k * BRC_SKIN_THICKNESS, (k + 1) * BRC_SKIN_THICKNESS);
        print_row(depth, &skin->layer[k]);
    }
    add_row(&text, BRC_SKIN_LAYERS * BRC_SKIN_THICKNESS, INFINITY, &skin->core);
    print_row("core", &skin->core);
    printf("missing stiffness, as a layer without beams: along the walls %.3f, shear against the inside %.3f, across "
           "%.3f diameters\n",
           skin->missing[BRC_SKIN_ALONG], skin->missing[BRC_SKIN_SHEAR], skin->missing[BRC_SKIN_ACROSS]);
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    if (status == BRC_OK) printf("%s\n", path);
    return status;
}
