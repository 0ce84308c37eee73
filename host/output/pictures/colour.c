/* Colour maps as paths through the OKLab space (Ottosson 2020), whose distances follow the eye. */
#include "colour.h"
#include <math.h>
#include <stdbool.h>

static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* Lightness 0..1, chroma, hue [degree] to sRGB. */
static void from_oklab(double lightness, double chroma, double hue, double rgb[3])
{
    const double a = chroma * cos(hue * M_PI / 180), b = chroma * sin(hue * M_PI / 180);
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    const double linear[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                              -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                              -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    for (int c = 0; c < 3; ++c)
        rgb[c] = encode(fmin(fmax(linear[c], 0), 1));
}

static bool clamp(double *t, double rgb[3])
{
    if (isnan(*t)) {
        rgb[0] = rgb[1] = rgb[2] = 0.6;
        return false;
    }
    *t = fmin(fmax(*t, 0), 1);
    return true;
}

/* The chroma follows, from below, what a screen can show along the path (least at blue-green), so that no colour is cut
 * off and no band stands out. */
void brc_colour_sequential(double t, double rgb[3])
{
    if (clamp(&t, rgb)) from_oklab(0.27 + 0.65 * t, 0.086 + 0.05 * (2 * t - 1) * (2 * t - 1), 295 - 190 * t, rgb);
}

void brc_colour_diverging(double t, double rgb[3])
{
    if (!clamp(&t, rgb)) return;
    const double side = fabs(2 * t - 1);
    from_oklab(0.95 - 0.5 * side, (t < 0.5 ? 0.14 : 0.17) * side, t < 0.5 ? 255 : 30, rgb);
}
