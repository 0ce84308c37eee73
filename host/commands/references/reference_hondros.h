/* A disc pressed across its diameter over two arcs, in closed form. */
#ifndef BRC_COMMANDS_REFERENCE_HONDROS_H
#define BRC_COMMANDS_REFERENCE_HONDROS_H

/* Stresses on the loaded diameter of a disc (plane stress) under a uniform radial pressure on two opposite arcs that
 * each span `half_angle` [rad] to either side of it (Hondros 1959; NAH19 eq. 28 prints the first), over the nominal
 * stress 2 P / (pi t D) of NAH19 eq. 27, P the resultant of an arc along the diameter: out[0] across the diameter,
 * out[1] along it [-]; tension positive. rho: distance from the centre over the radius, -1 to 1; half_angle: 0 to pi/2,
 * both outside 0. */
void brc_reference_hondros(double half_angle, double rho, double out[2]);

#endif
