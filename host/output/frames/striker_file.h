/* Walls and strikers at one moment, as polygons for ParaView. */
#ifndef BRC_OUTPUT_STRIKER_FILE_H
#define BRC_OUTPUT_STRIKER_FILE_H

#include "../../solver/run/assembly.h"
#include "../../solver/effects/strikers/strikers.h"

/* VTU of polygons (type 7), the faces of all strikers in the scene's order. As in frames Points [m] are those of the
 * start and PointData/displacement [m] moves them
 * ("Warp By Vector"). CellData: striker (index in the scene), velocity [m/s] of its mass centre, spin [rad/s], force
 * [N] and torque [N m] of the elements on it; FieldData TimeValue: of all stages [s]. Written aside, fsynced, renamed.
 * BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_striker_file_write(brc_context *context, const brc_assembly *assembly, const char *path);

/* Displacement [m] of corner k of a striker's surface. */
void brc_striker_corner_moved(const brc_striker_surface *surface, const brc_striker_now *now, int32_t k, double out[3]);

#endif
