#include "reference_hondros.h"
#include <math.h>

/* With the pressure p = P / (2 R t sin(half_angle)); the paper's arctan and alpha are one arctan here. */
void brc_reference_hondros(double half_angle, double rho, double out[2])
{
    const double square = rho * rho, gap = 1 - square;
    const double radial = gap * sin(2 * half_angle) / (1 - 2 * square * cos(2 * half_angle) + square * square);
    const double even = atan2((1 + square) * sin(half_angle), gap * cos(half_angle));
    out[0] = (radial - even) / sin(half_angle);
    out[1] = -(radial + even) / sin(half_angle);
}
