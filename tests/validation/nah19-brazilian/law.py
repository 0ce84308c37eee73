#!/usr/bin/env python3
"""law.py STRENGTHS.csv > disc.h: what discs read over the strength in tension of their packing, fitted by least squares with 1, x, x^2, x^3 (x = cn - 10), r_m and x r_m.

STRENGTHS.csv: material, coordination, r_m, packing, strength_over_target of the rows laws-... of `breccia reproduce nah19-brazilian`, a line a disc."""
import csv
import sys

import numpy

rows = list(csv.DictReader(open(sys.argv[1])))
cn = numpy.array([float(r["coordination"]) for r in rows])
radius = numpy.array([float(r["r_m"]) for r in rows])
ratio = numpy.array([float(r["strength_over_target"]) for r in rows])
x = cn - 10
terms = numpy.stack([x**0, x, x**2, x**3, radius, x * radius], 1)
law, *_ = numpy.linalg.lstsq(terms, ratio, rcond=None)
left = terms @ law / ratio - 1
bands = [[f"{f(radius[cn == c]):.4g}" for f in (min, max)] for c in sorted(set(cn))]
packings = sorted({int(r["packing"]) for r in rows})
print(f"""/* Written by tests/validation/nah19-brazilian/law.py from disc-strengths.csv: {len(rows)} discs of 20 000 spheres, packings {packings[0]} to {packings[-1]}, of {', '.join(sorted(set(r["material"] for r in rows)))}. Relative error left, root mean square over discs:
 * {100 * numpy.sqrt(numpy.mean(left**2)):.2f} %, which is their scatter. */
#ifndef BRC_LAWS_DISC_H
#define BRC_LAWS_DISC_H

#include "strength_law.h"

static const brc_disc_law brc_disc_law_fitted = {{
    .coordination = {{{cn.min():g}, {cn.max():g}}}, .radius = {{{radius.min():.4g}, {radius.max():.4g}}},
    .band = {{{', '.join(f"{{{low}, {high}}}" for low, high in bands)}}},
    .term = {{{', '.join(f'{c:.6g}' for c in law)}}},
}};

#endif""")
