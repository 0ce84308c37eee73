/* Numbers that sensors take from the fields of a simulation. */
#ifndef BRC_OUTPUT_SENSOR_MEANS_H
#define BRC_OUTPUT_SENSOR_MEANS_H

#include "sensors_internal.h"

/* The element whose centre is nearest to a point [m]; ties go to the smaller id. */
int32_t brc_sensor_nearest_element(const brc_domain *d, const double point[3]);
/* R of a sphere about the sensor's point by the surface elements of a set [m]. */
double brc_sensor_surface_radius(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set);
/* Sum over a set of the components along the radius from the sensor's point of a vector [n_elements][3]. */
double brc_sensor_radial_sum(const brc_sensors *sensors, const brc_sensor *sensor, const brc_set *set,
                             const double *vector);
/* Mean of a component of a tensor [n_elements][6] over an element set, by volume; set -1: all elements. */
double brc_sensor_volume_mean(const brc_sensors *sensors, const double *tensor, int32_t set, int32_t component);
/* Mean rotation of a patch about the sensor's axis through its point [rad], within +-pi. */
double brc_sensor_twist_angle(const brc_sensors *sensors, const brc_sensor *sensor, const brc_sensor_patch *p);
/* Component of the rotation vector of a unit quaternion (w, x, y, z) [rad]. */
double brc_sensor_turn(const double q[4], int component);

#endif
