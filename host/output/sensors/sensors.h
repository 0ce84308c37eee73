/* Sensors: what the scene wants to know about a simulation at each sample. */
#ifndef BRC_OUTPUT_SENSORS_H
#define BRC_OUTPUT_SENSORS_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"
#include "../../solver/simulation.h"

typedef struct brc_sensors brc_sensors;

/* Prepare the scene's sensors: sets looked up, weights and mean positions computed, arrays made only for the fields
 * that some sensor reads. Scene, domain and context are borrowed until free. BRC_BAD_INPUT with one sentence for each
 * sensor that cannot be: unknown set, a face set where elements are averaged, a strain between sets at the same place
 * along the component, a twist without an axis. */
brc_status brc_sensors_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                              brc_sensors **out);
void brc_sensors_free(brc_sensors **sensors);
/* value: [scene->n_sensors], in the sensors' units; NAN for a mode where there is none. Fields are read from the
 * simulation at most once each. */
brc_status brc_sensors_evaluate(brc_sensors *sensors, brc_simulation *simulation, double *value);

#endif
