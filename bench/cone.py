#!/usr/bin/env python3
"""Where the cracks of an impact along z went, from the cracks.csv and fragments.csv of a run:

    cone.py DIR TOP BOTTOM [X Y]      heights of the struck and of the far side [m], place of the blow (0 0)

In eight layers between a tenth and nine tenths of the thickness: broken area per volume in rings about the axis, a tenth of the thickness wide, and how far from the axis it is still half of that in the
densest ring. A cone shows as a radius that grows with depth: the angle of its side to the surface, by least squares. Then spall: pieces, the largest left out, that are in the far half at
the end and fly away from the largest one, on the far side: their mass and mean speed."""
import csv
import math
import os
import sys


def main():
    folder, top, bottom = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
    x0, y0 = (float(sys.argv[4]), float(sys.argv[5])) if len(sys.argv) > 5 else (0.0, 0.0)
    faces = []
    with open(os.path.join(folder, "cracks.csv")) as file:
        for row in csv.DictReader(file):
            depth = (top - float(row["z [m]"])) / (top - bottom)
            radius = math.hypot(float(row["x [m]"]) - x0, float(row["y [m]"]) - y0)
            faces.append((depth, radius, float(row["area [m^2]"])))
    if not faces:
        sys.exit("no bond broke")
    whole = sum(f[2] for f in faces)
    print("%d broken faces, %.4g mm^2" % (len(faces), 1e6 * whole))
    points = []
    for layer in range(1, 9):
        rings = [0.0] * 20
        for depth, radius, area in faces:
            ring = int(10 * radius / (top - bottom))
            if layer <= 10 * depth < layer + 1 and ring < len(rings):
                rings[ring] += area / (2 * ring + 1)
        # two rings together, so that single faces near the axis do not decide
        smooth = [0.5 * (rings[k] + rings[k + 1]) for k in range(len(rings) - 1)]
        if max(smooth) > 0:
            far = max(k for k in range(len(smooth)) if smooth[k] >= 0.5 * max(smooth)) + 1
            points.append(((layer + 0.5) / 10 * (top - bottom), far / 10 * (top - bottom)))
            print("depth %.3g mm: radius %.3g mm" % (1e3 * points[-1][0], 1e3 * points[-1][1]))
    if len(points) > 2:
        z, r = (sum(p[k] for p in points) / len(points) for k in (0, 1))
        slope = sum((p[0] - z) * (p[1] - r) for p in points) / sum((p[0] - z) ** 2 for p in points)
        print("cone: side at %.0f degrees to the surface, radius %.3g mm on it" % (math.degrees(math.atan2(1, slope)), 1e3 * (r - slope * z)))
    with open(os.path.join(folder, "fragments.csv")) as file:
        rows = list(csv.DictReader(file))
    pieces = [[float(r[k]) for k in ("mass [kg]", "centre_z [m]", "velocity_z [m/s]")] for r in rows if r["frame"] == rows[-1]["frame"]]
    largest = max(pieces)
    away = math.copysign(1, bottom - top)
    spall = [p for p in pieces if p is not largest and away * (p[1] - 0.5 * (top + bottom)) > 0 and away * (p[2] - largest[2]) > 0]
    mass, all_ = sum(p[0] for p in spall), sum(p[0] for p in pieces)
    print("%d pieces, the largest with %.1f %% of the mass" % (len(pieces), 100 * largest[0] / all_))
    if spall:
        print("spall: %d pieces, %.2f %% of the mass, at %.3g m/s from the largest" % (len(spall), 100 * mass / all_, sum(p[0] * abs(p[2] - largest[2]) for p in spall) / mass))


if __name__ == "__main__":
    main()
