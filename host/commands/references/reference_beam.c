/* Slender bars in closed form. */
#include "reference_beam.h"
#include <math.h>

static const double pi = 3.14159265358979323846;

double brc_reference_shear_coefficient(double poisson)
{
    return 10 * (1 + poisson) / (12 + 11 * poisson);
}

double brc_reference_cantilever(double young, double poisson, double length, double width, double height, double force)
{
    const double shear_modulus = young / (2 * (1 + poisson));
    const double moment_of_area = width * height * height * height / 12;
    const double bending = force * length * length * length / (3 * young * moment_of_area);
    return bending + force * length / (brc_reference_shear_coefficient(poisson) * shear_modulus * width * height);
}

double brc_reference_torsion_rectangle(double width, double height)
{
    const double a = fmax(width, height), b = fmin(width, height);
    double sum = 0;
    /* tanh is 1 to rounding beyond 20; the rest of the sum falls as n^-4, so 2000 terms reach 1e-14. */
    for (int n = 3999; n >= 1; n -= 2)
        sum += tanh(n * pi * a / (2 * b)) / pow(n, 5);
    return a * b * b * b * (1.0 / 3 - 64 / pow(pi, 5) * b / a * sum);
}

double brc_reference_torsion_circle(double radius)
{
    return pi * pow(radius, 4) / 2;
}

double brc_reference_torsion_energy(double shear_modulus, double torsion_constant, double length, double twist)
{
    return shear_modulus * torsion_constant * twist * twist / (2 * length);
}

double brc_reference_bar_frequency(double modulus, double density, double length)
{
    return sqrt(modulus / density) / (4 * length);
}
