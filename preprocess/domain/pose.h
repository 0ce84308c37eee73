/* Where a body stands: the rotation and translation of a finished domain. */
#ifndef BRC_PREPROCESS_POSE_H
#define BRC_PREPROCESS_POSE_H

#include "domain.h"

/* Matrix of the rotation vector (axis times angle [rad]); exactly the unit matrix for the zero vector. */
void brc_pose_matrix(const double rotation[3], double m[3][3]);
/* Rotate everything about `origin` by the rotation vector (axis times angle [rad]), then translate [m]; sets bounds. */
void brc_pose_apply(const double origin[3], const double rotation[3], const double translation[3], brc_domain *domain);

#endif
