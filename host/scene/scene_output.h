/* What a scene asks to be told of its run: sensors, measures, frames, pictures (scene.h). */
#ifndef BRC_SCENE_SCENE_OUTPUT_H
#define BRC_SCENE_SCENE_OUTPUT_H

#include "../base/status.h"
#include <stdbool.h>
#include <stdint.h>

#define BRC_NAME 64 /* longest name in a scene, with its NUL */

typedef enum brc_sensor_kind {
    BRC_SENSOR_REACTION,  /* force of the loads on the solid, summed over a face or element set with a prescribed motion
                             [N] */
    BRC_SENSOR_FACE_MEAN, /* area mean of u_f over a face set, or mean of u over an element set [m] */
    BRC_SENSOR_FACE_STRAIN, /* (mean u of set - mean u of set2).component over their reference distance along it [-] */
    BRC_SENSOR_FACE_TWIST,  /* area mean rotation angle of a face set about an axis [rad] */
    BRC_SENSOR_STRESS,      /* volume mean of the second Piola-Kirchhoff stress over an element set [Pa] */
    BRC_SENSOR_STRAIN,      /* volume mean of the Green strain over an element set [-] */
    BRC_SENSOR_ENERGY,      /* a term of the ledger by name [J] */
    BRC_SENSOR_POINT,       /* displacement of the element nearest to a point [m] */
    BRC_SENSOR_POINT_VELOCITY, /* its velocity [m/s] */
    BRC_SENSOR_MOMENT, /* moment of the loads on the solid about a point, over a set with a prescribed motion [N m] */
    BRC_SENSOR_TURN,   /* rotation vector of the element nearest to a point; models with rotations [rad] */
    BRC_SENSOR_RADIAL_STRESS, /* element forces of a set along the radius from a point, over the sphere 4 pi R^2 [Pa] */
    BRC_SENSOR_VOLUME_STRAIN, /* 3 times the mean radial displacement of a set over R [-] */
    BRC_SENSOR_FRACTURE,  /* `term`: broken (bonds) [-], crack_area [m^2], fragments [-], largest_fragment (share of the
                           * mass) [-],  failure_ratio (largest stress over limit) [-] */
    BRC_SENSOR_CRACK_TIP, /* farthest broken bond along `axis` from `point` [m]; 0 before the first */
    BRC_SENSOR_SPIN, /* angular velocity of an element set: inverse of its inertia times its angular momentum about its
                        mass centre [rad/s] */
    BRC_SENSOR_STRIKER, /* striker `set`, `term`: position, displacement [m], velocity [m/s], rotation [rad], spin
                         * [rad/s], force and applied [N] and torque [N m] of the elements on it, energy (kinetic) [J];
                         * `component` of the vectors */
    BRC_SENSOR_CONTACT, /* `term`: pairs (touching), sliding (of them) [-], penetration (deepest) [m], force (sum of the
                           magnitudes of normal forces) [N] */
    BRC_SENSOR_OPENING, /* how far two places have moved apart along `axis`: of sets `set` and `set2`, of the elements
                         * nearest to `point` and `point2`, or of the two sides of the crack `set` [m] */
    BRC_SENSOR_MODE     /* frequency of mode `index` (0: lowest elastic) of the last modes stage [Hz] */
} brc_sensor_kind;

/* What is positive: the component along its axis, of stress and strain tension; or what pushes into the solid. */
typedef enum brc_sign { BRC_SIGN_AXIS, BRC_SIGN_COMPRESSION } brc_sign;

typedef struct brc_sensor {
    char name[BRC_NAME];
    brc_sensor_kind kind;
    char set[BRC_NAME],
        set2[BRC_NAME]; /* "" : all elements; of a striker: its name, and of another whose value is taken off */
    int32_t component;  /* vectors: 0 x 1 y 2 z; tensors: 0 xx 1 yy 2 zz 3 yz 4 xz 5 xy */
    double point[3], axis[3];
    brc_sign sign;
    bool of_sets, of_points, of_crack; /* opening: one of them */
    double point2[3];                  /* opening of points: the other end [m] */
    bool is_near;                      /* opening of a crack: only its faces within `within` [m] of `point` */
    double within;
    char term[BRC_NAME]; /* energy: "kinetic", "elastic", "stabilisation", "work", "damping", "numerical", "fracture",
                            "contact", "friction", "impact", "potential", "total", "closure" */
    int32_t index;
    char place[BRC_PLACE_LENGTH]; /* in the scene file, of errors that the built domain shows; "": made in code */
} brc_sensor;

typedef enum brc_measure_kind {
    BRC_MEASURE_E,         /* slope at zero strain of reaction / area against strain [Pa] */
    BRC_MEASURE_NU,        /* minus the slope at zero strain of lateral against axial strain [-] */
    BRC_MEASURE_K,         /* bulk: slope of reaction / area (mean pressure) against volume strain, from sensors [Pa] */
    BRC_MEASURE_G,         /* slope of shear stress against shear angle [Pa] */
    BRC_MEASURE_FREQUENCY, /* largest spectral peak of a sensor, Hann window, interpolated [Hz] */
    BRC_MEASURE_PEAK,      /* value of largest magnitude in the window [sensor's unit] */
    BRC_MEASURE_SLOPE,     /* slope at zero of sensor y against sensor x, polynomial fit through the window */
    BRC_MEASURE_MEAN,      /* time mean over the window */
    BRC_MEASURE_RATE,      /* slope of a sensor against time, straight line through the window [sensor's unit/s] */
    BRC_MEASURE_INTEGRAL,  /* of a sensor over time, by trapezoids [sensor's unit s] */
    BRC_MEASURE_DURATION,  /* time during which a sensor's magnitude is above a share of its largest, or the sensor
                              within a share of its first value, straight lines between samples [s] */
    BRC_MEASURE_AT_FIRST_BREAK /* value of a sensor when the first bond of the window breaks, between samples by a
                                  straight line */
} brc_measure_kind;

typedef struct brc_measure {
    char name[BRC_NAME];
    brc_measure_kind kind;
    char y[BRC_NAME], x[BRC_NAME]; /* sensor names; x "" where the operator needs none */
    char area_set[BRC_NAME]; /* E, K, G, peak: face set whose reference area divides y; "" : y is a stress already */
    char stage[BRC_NAME];    /* "" : the last stage */
    double window[2];        /* [s] of the stage; 0 0: all of it */
    bool has_target;
    double target; /* in the unit of the result */
    double above;  /* duration: share of the largest magnitude, in [0, 1) */
    double within; /* duration: share of the first value, in (0, 1), in place of above; 0: not given */
    double scale;  /* result = scale * operator, default 1 (e.g. -1 for a reaction on the other side) */
} brc_measure;

/* Of the fields of frames. */
typedef enum brc_frame_numbers { BRC_FRAME_SINGLE, BRC_FRAME_DOUBLE } brc_frame_numbers;
typedef struct brc_output {
    double frame_interval; /* [s]; 0: frames at the start and end of each stage only */
    int32_t n_frames;      /* number of equal intervals over each stage; 0: by frame_interval; -1: no frames at all */
    brc_frame_numbers frame_numbers; /* of the fields of frames, default single */
    int32_t
        history_every; /* dynamic: steps between sensor samples, default 1/500 of the stage; static: every increment */
    bool picture;      /* render picture.png at the end, default true */
    char picture_colour[BRC_NAME]; /* "stress_xx", "von_mises", "displacement", ... default "von_mises" */
    double picture_scale;          /* factor on the displacement; 0: automatic */
    bool picture_frames;           /* draw every frame too, pictures/NNNNNN.png */
    bool has_picture_cut;          /* elements in front of the plane are not drawn */
    double picture_cut_point[3], picture_cut_normal[3]; /* [m] of the undeformed solid; unit vector */
    char picture_view[BRC_NAME];                /* seen from: "x", "-x", "y", "-y", "z", "-z", or "corner", default */
    bool has_picture_camera;                    /* seen from one point towards another */
    double picture_from[3], picture_towards[3]; /* [m] */
    bool crack_surface;      /* with fracture: broken faces as polygons beside every frame, default true */
    bool has_checkpoint;     /* checkpoints by interval; on a signal and before a stop there is one in any case */
    double checkpoint_every; /* simulated time between them [s]; 0: off */
    double checkpoint_wall;  /* time of the clock between them [s]; 0: off */
    char curve_x[BRC_NAME], curve_y[BRC_NAME]; /* sensors of curve.png; "" : none */
} brc_output;

#endif
