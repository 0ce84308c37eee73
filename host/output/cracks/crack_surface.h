/* Crack surfaces: the faces of all broken bonds at one moment, as polygons for ParaView. */
#ifndef BRC_OUTPUT_CRACK_SURFACE_H
#define BRC_OUTPUT_CRACK_SURFACE_H

#include "../../solver/run/assembly.h"
#include "../../solver/effects/fracture/fracture.h"

/* VTU of polygons (type 7), two for every broken bond, one moving with each of its elements: CellData side 0 is that of
 * element_i, 1 that of element_j. Cells: the corners of the face. Beams: an octagon around the middle of the bond,
 * across it, with the radius of the beam. As in frames Points [m] are those of the undeformed solid and
 * PointData/displacement [m] moves them ("Warp By Vector"), cells strained with what is whole around them (deform.h),
 * spheres turned. CellData: time [s], load [-], stage, mode, bond, element_i, element_j, energy [J], stress [Pa], area
 * [m^2] of the break; FieldData TimeValue: of all stages [s]. Written aside, fsynced, renamed; also where nothing broke
 * yet. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_crack_surface_write(brc_context *context, const brc_assembly *assembly, const char *path);

/* Corners of the face of half-edge h of a domain of cells, in order around it: those of its element that lie in its
 * plane. corner: indices into domain->vertex [room]. Returns their number, 0 where fewer than 3 do. */
int brc_crack_surface_corners(const brc_domain *domain, int64_t h, int room, int64_t *corner);

#endif
