/* The part of a free face that lies inside a predicate: what a load per area acts on. Sets hold whole faces, those
 * whose centroid is inside; where a pressed region ends across the faces the total force of a set is off by up to half
 * a face along its rim, and two equal regions opposite one another do not balance. */
#ifndef BRC_PREPROCESS_SET_SHARE_H
#define BRC_PREPROCESS_SET_SHARE_H

#include "build.h"

/* Do the predicate's own planes (of a box or a half-space) cut faces? */
bool brc_predicate_cuts(const brc_predicate *where);
/* Area vector [m^2] and centroid [m] of the part of free face `face` inside, in posed coordinates; returns its share of
 * the face's area [-], 0: nothing. The planes of a box and of a half-space cut the face; walls, normals, spheres and
 * cylinders take it whole by normal and centroid, as sets do. A face that no plane cuts (to 1e-9 of the mean spacing)
 * has the domain's own numbers, to the last bit. */
double brc_predicate_share(const brc_predicate *where, const brc_domain *domain, int64_t face, double area[3],
                           double centroid[3]);

#endif
