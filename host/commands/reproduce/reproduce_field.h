/* Stresses of a plane problem against its closed form, element by element. */
#ifndef BRC_COMMANDS_REPRODUCE_FIELD_H
#define BRC_COMMANDS_REPRODUCE_FIELD_H

#include "reproduce.h"

/* The field operator, once a run ended. The first body is a cylinder about y through the origin, cut by boxes: a quarter of a disc pressed along z over arcs of
 * run->half_angle (its set `middle`, the cut across the load, gives the load); or with a cylinder removed from it, a quarter of a ring, or all of it, whose outside
 * moves by the gradient of a load. Adds field_error: root of the volume mean of |stress - exact|^2 (in-plane components, at the elements' centroids) over the nominal
 * stress, within 0.6 of the disc's radius or three radii of the hole; and, of a ring, peak_error: the largest principal stress of the elements within 1.25 radii of
 * the hole over the exact one at their centroids, minus 1. Of beams the stress is the virial one, over as many shells of neighbours as the run's label `level` says
 * (1 without it). BRC_BAD_INPUT: no such scene. */
brc_status brc_field_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);

#endif
