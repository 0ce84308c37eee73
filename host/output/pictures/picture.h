/* Pictures of the deformed sample, coloured by a field: cells by their outer faces, what is open on broken bonds, and
 * what a cut shows; or spheres. */
#ifndef BRC_OUTPUT_PICTURE_H
#define BRC_OUTPUT_PICTURE_H

#include "../../solver/run/assembly.h"
#include "../../solver/effects/strikers/strikers.h"
#include "paint.h"
#include "picture_faces.h"

/* Elements of one kind, all cells or all spheres. */
typedef struct brc_picture_part {
    const brc_domain *domain;
    const uint8_t *whole;       /* [n_half_edges] 1: unbroken; NULL: all are */
    const double *displacement; /* [n_elements][3] [m] */
    const double *value;        /* [n_elements] what is coloured, in `unit` */
} brc_picture_part;

/* A wall or striker, drawn in grey. */
typedef struct brc_picture_striker {
    const brc_striker_body *body;
    brc_striker_now now;
    bool is_plane; /* drawn behind everything, seen from its front only, and no part of what the picture has room for */
} brc_picture_striker;

/* What is drawn; all borrowed for the call. */
typedef struct brc_picture {
    int32_t n;
    const brc_picture_part *part; /* [n] */
    int32_t n_strikers;
    const brc_picture_striker *striker; /* [n_strikers] */
    const char *name;                   /* of the field, beside the colour bar: "von Mises stress" */
    const char *unit;
    const char *title; /* "" : none */
    double scale;      /* factor on the displacement; 0: automatic */
    bool steady;     /* one of a sequence: the view is that of the undeformed sample with strikers where they began, the
                        automatic scale is 1 */
    double range[2]; /* of the colours; equal: that of what is seen */
    const brc_picture_cut *cut; /* NULL: the whole sample */
    const brc_paint_view *view; /* NULL: from above one corner */
} brc_picture;

/* 1200 x 900, without perspective. BRC_FILE_FAILED: cannot be written. */
brc_status brc_picture_draw(brc_context *context, const brc_picture *picture, const char *path);
/* The whole as it is now, as scene.output asks (with picture_frames all pictures of a run have one view, and damage one
 * scale of colours): picture_colour is "von_mises", "displacement[_x|_y|_z]", "velocity[_x|_y|_z]", "stress_xx" ...
 * "stress_xy" (Cauchy) or "strain_xx" ... "strain_xy" (Green). BRC_BAD_INPUT for another word, with the list. */
brc_status brc_picture_write(brc_context *context, const brc_assembly *assembly, const char *path);
/* Factor on the displacement that makes it visible: one of 1, 2, 5 times a power of ten, so that the largest
 * displacement (less its mean) is about 4 % of the sample's diagonal; 1 where it is as large by itself or zero. */
double brc_picture_automatic_scale(int32_t n, const brc_picture_part *part);

#endif
