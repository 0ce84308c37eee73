/* Slender bars in closed form: what a cantilever, a twisted bar and a vibrating bar of cells are held against. */
#ifndef BRC_COMMANDS_REFERENCE_BEAM_H
#define BRC_COMMANDS_REFERENCE_BEAM_H

/* Tip deflection [m] of a clamped bar of rectangular section under a force at its end, bending and shear (Timoshenko):
 * F L^3 / (3 E I) + F L / (kappa G A). width: across the force, height: along it [m]. */
double brc_reference_cantilever(double young, double poisson, double length, double width, double height, double force);
/* Shear coefficient kappa [-] of a rectangle (Cowper 1966): 10 (1 + nu) / (12 + 11 nu). */
double brc_reference_shear_coefficient(double poisson);
/* Torsion constant J [m^4] of Saint-Venant, so that the torque is G J times the twist per length. Rectangle: its
 * series, to rounding; sides in any order. */
double brc_reference_torsion_rectangle(double width, double height);
double brc_reference_torsion_circle(double radius);
/* Elastic energy [J] of a bar twisted by `twist` [rad] over its length, ends free to warp: G J twist^2 / (2 L). */
double brc_reference_torsion_energy(double shear_modulus, double torsion_constant, double length, double twist);
/* First frequency [Hz] of a bar clamped at one end (AGH19 eq. 44, 45): sqrt(modulus / rho) / (4 L), modulus E in
 * tension and G in torsion of a round bar. */
double brc_reference_bar_frequency(double modulus, double density, double length);

#endif
