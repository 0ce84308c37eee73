/* A frame: the whole sample, all parts of it, at one moment, as a VTKHDF file that VTK and ParaView open. */
#ifndef BRC_OUTPUT_FRAME_FILE_H
#define BRC_OUTPUT_FRAME_FILE_H

#include "../../solver/run/assembly.h"
#include "../../solver/core/state_store.h"

#define BRC_FRAME_FORMAT_VERSION 2

/* VTKHDF UnstructuredGrid. Cells are polyhedra (type 42, version 2.5) that share their corners wherever a whole bond
 * joins them (tessellation.h).
 *   Points [m], float: corners in the reference state; PointData/displacement [m], float: the mean over the cells that
 *   share the corner of u_i + H_i (x - X_i), H_i the least-squares gradient of the element's neighbourhood (deform.h),
 *   so that "Warp By Vector" shows deformed cells; CellData, float, or double where the scene asks for that
 *   (output.frame_numbers): displacement [m], velocity [m/s], stress (Cauchy) [Pa], strain (Green) [-], von_mises [Pa];
 *   double: position (of the element, reference) [m]; integer: element_id. Tensors in VTK's order XX YY ZZ XY YZ XZ.
 *   Spheres are vertices (type 1): Points their reference positions, PointData/displacement their own, PointData/radius
 *   [m], as packed; CellData/orientation: unit quaternion w x y z, the rotation since the reference. A frame of spheres
 *   alone is of version 1.0. In scenes of several models parts follow one another, CellData/body and model are the
 *   indices of an element's body and part, radius is 0 at corners and cells without rotations are upright. FieldData:
 *   time [s] (all stages), stage_time [s] (static: load factor), stage, step.
 * What an earlier frame has is not written again: element_id, position, Types, body and model are external links to the
 * first frame, points and polyhedra to the last one before which a bond of cells broke. Every frame therefore needs
 * those of its folder that it names. */
typedef struct brc_frames brc_frames;

/* n_threads 0: as OpenMP decides. assembly: borrowed until free. BRC_NO_MEMORY. */
brc_status brc_frames_create(brc_context *context, const brc_assembly *assembly, int n_threads, brc_frames **out);
void brc_frames_free(brc_frames **frames);
/* Write folder/NNNNNN.vtkhdf, numbers ascending: aside, fsynced, renamed. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_frames_write(brc_frames *frames, const char *folder, int64_t number);
/* Which frames have what later ones refer to, for a checkpoint. */
brc_status brc_frames_store(brc_frames *frames, brc_state_store *store);

/* Index of n frames "frames/NNNNNN<suffix>" at these times, for ParaView: JSON, written whole. suffix: ".vtkhdf",
 * ".cracks.vtu". */
brc_status brc_frame_write_series(brc_context *context, int64_t n, const double *time, const char *suffix,
                                  const char *path);

#endif
