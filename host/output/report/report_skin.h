/* What can be seen of the elements of a run: spheres, outer faces of cells, and faces of broken bonds from the frame on
 * at which they are open. Frames number their points anew when bonds break (frame_cells.h); bonds do not heal, so that
 * the last frame has every face that is open in an earlier one. */
#ifndef BRC_OUTPUT_REPORT_SKIN_H
#define BRC_OUTPUT_REPORT_SKIN_H

#include "report_frame.h"

typedef struct brc_report_skin {
    int64_t n_elements;
    int32_t *element; /* [n_elements] those seen, ascending, by their numbers in frames */
    int64_t n_points;
    int64_t *point;       /* [n_points] in the last frame */
    int32_t *point_owner; /* [n_points] an element that has it, by its place in `element` */
    int64_t n_faces;
    int32_t *face_owner;  /* [n_faces] by place in `element` */
    int64_t *face_start;  /* [n_faces + 1] */
    int32_t *face_corner; /* [face_start[n_faces]] counter-clockwise from outside, by place in `point` */
    int32_t *birth;       /* [n_faces] the first of the shown frames where it is open; -1: none yet */
} brc_report_skin;

/* Of the last frame. Owned. BRC_NO_MEMORY. */
brc_status brc_report_skin_make(brc_context *context, const brc_report_frame *last, brc_report_skin *out);
void brc_report_skin_free(brc_report_skin *skin);
/* Where the points of the skin are in another frame: the nearest point, in the reference state, of the same element.
 * place: [n_points], its index there. */
void brc_report_skin_places(const brc_report_skin *skin, const brc_report_frame *last, const brc_report_frame *frame,
                            int64_t *place);
/* Faces that are open in this frame, and were in none before, are born at `shown`. place: as above. BRC_NO_MEMORY. */
brc_status brc_report_skin_births(brc_context *context, brc_report_skin *skin, const brc_report_frame *frame,
                                  const int64_t *place, int32_t shown);

#endif
