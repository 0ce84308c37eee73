/* Sensors `fracture` and `crack_tip` of one simulation: what broke is read again only when more broke. */
#ifndef BRC_OUTPUT_CRACK_SENSORS_H
#define BRC_OUTPUT_CRACK_SENSORS_H

#include "../../solver/effects/fracture/fracture.h"

typedef struct brc_crack_sensors brc_crack_sensors;

/* Scene, domain and context are borrowed until free. */
brc_status brc_crack_sensors_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                    brc_crack_sensors **out);
/* Accepts NULL and a pointer to NULL. */
void brc_crack_sensors_free(brc_crack_sensors **sensors);
/* The sensor now, in its unit; kinds BRC_SENSOR_FRACTURE and BRC_SENSOR_CRACK_TIP. */
brc_status brc_crack_sensors_read(brc_crack_sensors *sensors, brc_simulation *simulation, const brc_sensor *sensor,
                                  double *value);

#endif
