/* What broke in a run, as values of its rows. */
#ifndef BRC_COMMANDS_REPRODUCE_FRACTURE_H
#define BRC_COMMANDS_REPRODUCE_FRACTURE_H

#include "reproduce.h"

/* At the end of a run whose scene has `fracture`: broken (bonds), crack_area [m^2], fragments, largest_fragment (share
 * of the mass), halves (fragments with at least a quarter of the mass), crumbs (share of the mass in fragments with
 * less than a twentieth of it), halves_parted and crumbs_parted (the same at the first step after which no fragment had
 * more than three quarters of the mass, where there was one); where something broke also first_break_stress (largest of
 * the bonds of the first step or event with breaks, as cracks.csv has it [Pa]), first_break_from_centre (distance of
 * the area-weighted middle of the bonds of the first step or event with breaks from the middle of the first body's
 * domain, of a cylinder in its cross-section [m]), first_break_from_rim (of a cylinder: to its side [m]),
 * first_hundredth_from_rim (the same of the first breaks that make up a hundredth of the broken area, mean by area),
 * plane_x, plane_y, plane_z (angles of the normal of the mean plane of all broken bonds to the axes [degrees]) and
 * plane_rough (root mean square distance from it [m]). */
brc_status brc_fracture_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);

#endif
