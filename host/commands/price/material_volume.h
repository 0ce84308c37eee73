/* Cells are of one material each, so that a boundary between materials runs along cells: a body has a little more of
 * one material and less of another than the scene says. */
#ifndef BRC_COMMANDS_MATERIAL_VOLUME_H
#define BRC_COMMANDS_MATERIAL_VOLUME_H

#include "../setup.h"

/* How far that puts the bodies' means of E (stiff and soft side by side), of 1 / E (one behind the other) and of
 * density off those of the regions as they are in the scene: the largest, relative [-]; 0 without regions. A load sees
 * something between the first two. Regions are measured by points in each cell, four for every face; bodies with phases
 * (whose grains are drawn by number), of spheres, or with regions that are given by a wall, are left out. */
double brc_material_volume_error(const brc_setup *setup);

#endif
