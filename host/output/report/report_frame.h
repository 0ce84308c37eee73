/* A frame of a run read back, with what the report page shows of it. */
#ifndef BRC_OUTPUT_REPORT_FRAME_H
#define BRC_OUTPUT_REPORT_FRAME_H

#include "../../base/status.h"
#include <stdint.h>

/* Names are those of the datasets (frame_file.h); all arrays are owned. Element e has the points
 * cell_point[cell_start[e]] .. and the faces cell_face[e] .. cell_face[e + 1] - 1; face f the points
 * face_point[face_start[f]] .. in order around it. A sphere has one point and no face. */
typedef struct brc_report_frame {
    double time, stage_time;                    /* [s]; static stages: stage_time is the load factor */
    int64_t stage, step, n_broken, n_fragments; /* n_broken -1: nothing can break */
    int64_t n_elements, n_points, n_faces;
    float *point, *displacement;                                            /* [n_points][3] [m] */
    float *radius;                                                          /* [n_points] [m]; NULL: no spheres */
    int64_t *cell_start, *cell_point, *cell_face, *face_start, *face_point; /* faces NULL: spheres alone */
    float *von_mises, *speed;                                               /* [n_elements] [Pa], [m/s] */
    float *damage;     /* [n_elements] [-]; NULL: nothing can break */
    int32_t *fragment; /* [n_elements]; NULL as damage */
} brc_report_frame;

/* folder/frames/NNNNNN.vtkhdf is there? */
brc_status brc_report_frame_exists(brc_context *context, const char *folder, int64_t number, bool *exists);
/* BRC_BAD_INPUT: damaged, or a frame that it refers to is not there. BRC_NO_MEMORY. */
brc_status brc_report_frame_read(brc_context *context, const char *folder, int64_t number, brc_report_frame *out);
void brc_report_frame_free(brc_report_frame *frame);
bool brc_report_frame_is_sphere(const brc_report_frame *frame, int64_t element);

#endif
