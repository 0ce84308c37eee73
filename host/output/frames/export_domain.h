/* A domain alone, for the eye. */
#ifndef BRC_OUTPUT_EXPORT_DOMAIN_H
#define BRC_OUTPUT_EXPORT_DOMAIN_H

#include "../../../preprocess/domain/domain.h"

/* Write a domain as VTU (vtu.h). Cells are polyhedra (type 42) that share their corners (tessellation.h); spheres are
 * vertices (type 1) with PointData/radius [m], which ParaView's Glyph scales balls with. CellData: element_id, position
 * [m], volume [m^3], region, body, coordination (number of bonds), grain where there are grains. BRC_FILE_FAILED. */
brc_status brc_export_domain_vtu(brc_context *context, const brc_domain *domain, const char *path);

#endif
