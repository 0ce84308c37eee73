/* Colour maps as paths through the OKLab space (Ottosson 2020), whose distances follow the eye. */
#include "colour.h"
#include <math.h>
#include <stdbool.h>

static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* Lightness 0..1, chroma, hue [degree] to sRGB; false where the screen has no such colour. */
static bool from_oklab(double lightness, double chroma, double hue, double rgb[3])
{
    const double a = chroma * cos(hue * M_PI / 180), b = chroma * sin(hue * M_PI / 180);
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    const double linear[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                              -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                              -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    bool inside = true;
    for (int c = 0; c < 3; ++c) {
        inside = inside && linear[c] >= -1e-4 && linear[c] <= 1 + 1e-4;
        rgb[c] = encode(fmin(fmax(linear[c], 0), 1));
    }
    return inside;
}

/* The most colourful one the screen has, up to the chroma asked for. */
static void fit_screen(double lightness, double chroma, double hue, double rgb[3])
{
    for (int k = 20; k >= 0; --k)
        if (from_oklab(lightness, chroma * k / 20, hue, rgb)) return;
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

void brc_colour_sequential(double t, double rgb[3])
{
    if (clamp(&t, rgb)) fit_screen(0.27 + 0.65 * t, 0.155, 295 - 190 * t, rgb);
}

void brc_colour_diverging(double t, double rgb[3])
{
    if (!clamp(&t, rgb)) return;
    const double side = fabs(2 * t - 1);
    fit_screen(0.95 - 0.5 * side, 0.17 * pow(side, 0.8), t < 0.5 ? 255 : 30, rgb);
}
