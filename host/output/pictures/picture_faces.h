/* What of cells a picture shows: their outer faces, what is open on broken bonds, and, where a plane cuts the solid
 * open, the faces behind it. */
#ifndef BRC_OUTPUT_PICTURE_FACES_H
#define BRC_OUTPUT_PICTURE_FACES_H

#include "../../../preprocess/domain/domain.h"

/* Elements whose place in the undeformed solid is in front of a plane are left out. */
typedef struct brc_picture_cut {
    double point[3], normal[3]; /* [m]; towards what is left out */
} brc_picture_cut;
/* cut: NULL, nothing is. */
bool brc_picture_hides(const brc_picture_cut *cut, const double place[3]);

/* Faces by ascending element. Owned. */
typedef struct brc_picture_faces {
    int64_t n;
    int32_t *element; /* [n] */
    int64_t *start;   /* [n + 1] */
    int32_t *corner;  /* [start[n]] counter-clockwise from outside: indices into domain.vertex */
} brc_picture_faces;
/* Of a domain of cells: free faces; faces of broken bonds from both sides (whole: [n_half_edges] 1: unbroken; NULL: all
 * are); faces next to what is left out. BRC_NO_MEMORY. */
brc_status brc_picture_faces_make(brc_context *context, const brc_domain *domain, const uint8_t *whole,
                                  const brc_picture_cut *cut, brc_picture_faces *out);
void brc_picture_faces_free(brc_picture_faces *faces);

#endif
