/* Walls and strikers: rigid bodies beside the elements, which meet them by contact (scene.strikers). They stand still,
 * are driven along a prescribed path, or are free: then they have mass and inertia, and forces, torques, gravity and a
 * prescribed force on the mass centre move them with the elements, step by step on the device. */
#ifndef BRC_SOLVER_STRIKERS_H
#define BRC_SOLVER_STRIKERS_H

#include "../../simulation.h"

/* Where a striker is and how it moves, in the frame of space. */
typedef struct brc_striker_now {
    double position[3];     /* of its mass centre; of a plane: its point [m] */
    double displacement[3]; /* of that since the start of the scene [m] */
    double orientation[4];  /* since the start of the scene, unit quaternion w x y z */
    double rotation[3];     /* the same as a rotation vector, at most half a turn long [rad] */
    double velocity[3];     /* of the mass centre [m/s] */
    double spin[3];         /* [rad/s] */
    double momentum[3];     /* angular, of a free one about its mass centre; else 0 [kg m^2/s] */
    double force[3];        /* of the elements on it [N] */
    double torque[3];       /* the same, about its mass centre [N m] */
    double applied[3];      /* prescribed force on it [N]; else 0 */
    double kinetic;         /* energy of a free one; else 0 [J] */
} brc_striker_now;

/* Flat faces of a striker, for pictures and files: curved shapes have `facets` around a turn, of an endless plane it is
 * a square as large as the bodies. */
typedef struct brc_striker_surface {
    int32_t n_corners, n_faces;
    double *corner;      /* [n_corners][3] from the mass centre, as the scene starts [m] */
    int32_t *loop_start; /* [n_faces + 1] */
    int32_t *loop;       /* corners of the faces, counter-clockwise from outside */
} brc_striker_surface;

/* What does not change. */
typedef struct brc_striker_body {
    double centre[3];  /* mass centre as the scene starts; of a plane: its point [m] */
    double mass;       /* of a free one [kg]; else 0 */
    double inertia[6]; /* of a free one, about the centre, as the scene starts, xx yy zz yz xz xy [kg m^2]; else 0 */
    double volume;     /* [m^3]; of a plane 0 */
    brc_striker_surface surface;
} brc_striker_body;

int32_t brc_simulation_n_strikers(const brc_simulation *simulation);
const brc_striker_body *brc_simulation_striker_body(const brc_simulation *simulation, int32_t striker);
/* Read from the device. */
brc_status brc_simulation_striker_now(brc_simulation *simulation, int32_t striker, brc_striker_now *out);

/* Energies of all strikers [J]. */
typedef struct brc_striker_energies {
    double kinetic;   /* of free ones */
    double potential; /* of free ones in gravity, 0 where they started */
    double work;      /* that driven ones have done on what they touched, and prescribed forces on free ones */
    double numerical; /* lost to the integrator */
} brc_striker_energies;
brc_status brc_strikers_energies(brc_simulation *simulation, brc_striker_energies *out);

#endif
