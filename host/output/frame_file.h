/* A frame: the whole sample, all parts of it, at one moment, as a VTKHDF file that ParaView 5.11 and newer opens. */
#ifndef BRC_OUTPUT_FRAME_FILE_H
#define BRC_OUTPUT_FRAME_FILE_H

#include "../solver/assembly.h"

#define BRC_FRAME_FORMAT_VERSION 1

/* Static VTKHDF UnstructuredGrid, version 1.0; cells are convex point sets (type 41), each with its own corners.
 *   Points [m], float: corners in the reference state; PointData/displacement [m], float: u_i + H_i (x - X_i), H_i the
 *   least-squares gradient of the element's neighbourhood (deform.h), so that "Warp By Vector" shows deformed cells;
 *   CellData, double: position (of the element, reference) [m], displacement [m], velocity [m/s], stress (Cauchy) [Pa],
 *   strain (Green) [-], von_mises [Pa]; integer: element_id. Tensors in VTK's order XX YY ZZ XY YZ XZ.
 *   Spheres are vertices (type 1): Points their reference positions, PointData/displacement their own, PointData/radius [m], as packed;
 *   CellData/orientation: unit quaternion w x y z, the rotation since the reference.
 *   In scenes of several models parts follow one another, CellData/body and model are the indices of an element's body and part, radius is 0 at
 *   corners and cells without rotations are upright.
 *   FieldData: time [s] (all stages), stage_time [s] (static: load factor), stage, step.
 * Written aside block by block (about 4 MB of buffers and 18 doubles an element), fsynced, renamed. BRC_FILE_FAILED. */
brc_status brc_frame_write(brc_context *context, const brc_assembly *assembly, const char *path);
/* Index of n frames "frames/NNNNNN<suffix>" at these times, for ParaView: JSON, written whole. suffix: ".vtkhdf", ".cracks.vtu". */
brc_status brc_frame_write_series(brc_context *context, int64_t n, const double *time, const char *suffix, const char *path);

#endif
