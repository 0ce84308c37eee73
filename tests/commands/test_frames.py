"""Frames in VTK: every frame of a run is read, clipped, sliced, thresholded and warped, and nothing of its volume is lost.

    test_frames.py                  what ctest runs: four examples made small
    test_frames.py --all            every example made small
    test_frames.py --as-is NAME ... these examples as they are

Needs Python's vtk: Debian's python3-vtk9 (9.1) reads what `breccia export --format vtu` makes of the frames, VTK 9.6 and newer the frames themselves
(pip install vtk; run this script with the Python that has it). Skipped (77) where there is none.
"""
import argparse
import glob
import json
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import debian
import test_resume as small

vtk, = debian.need("python3-vtk9", "vtk")
VERSION = tuple(int(part) for part in vtk.vtkVersion().GetVTKVersion().split(".")[:2])


def output_of(algorithm, data=None):
    if data is not None:
        algorithm.SetInputData(data)
    algorithm.Update()
    return algorithm.GetOutput()


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith(".vtu") else vtk.vtkHDFReader()
    reader.SetFileName(path)
    return output_of(reader)


def sizes(grid, array):
    """Sum of the volumes or areas of all cells."""
    values = output_of(vtk.vtkCellSizeFilter(), grid).GetCellData().GetArray(array)
    return sum(values.GetValue(k) for k in range(values.GetNumberOfTuples()))


def count(grid, kind):
    return sum(grid.GetCellType(k) == kind for k in range(grid.GetNumberOfCells()))


def half(grid, plane, inside_out):
    clip = vtk.vtkTableBasedClipDataSet()
    clip.SetClipFunction(plane)
    clip.SetInsideOut(inside_out)
    return output_of(clip, grid)


def look_at(path, n_elements):
    """Read, clip, slice, threshold, warp. Returns cells, points, triangles and polygons of the surface."""
    grid = read(path)
    n = grid.GetNumberOfCells()
    assert n == n_elements, f"{path}: {n} cells, {n_elements} elements"
    polyhedra = count(grid, vtk.VTK_POLYHEDRON)
    bounds = grid.GetBounds()
    plane = vtk.vtkPlane()
    plane.SetOrigin([0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)])
    plane.SetNormal(1, 0.3, 0.2)
    volume = sizes(grid, "Volume")
    sides = [half(grid, plane, inside_out) for inside_out in (0, 1)]
    parts = [sizes(side, "Volume") for side in sides]
    assert abs(sum(parts) - volume) <= 1e-4 * volume, f"{path}: clipped into {parts} of {volume}"
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cut = output_of(cutter, grid)
    if polyhedra:
        assert volume > 0 and min(parts) > 0.2 * volume, f"{path}: clipped into {parts} of {volume}"
        assert sizes(cut, "Area") > 0, f"{path}: an empty slice"
    else:
        assert sum(side.GetNumberOfCells() for side in sides) >= n, f"{path}: spheres are lost"
    threshold = vtk.vtkThreshold()
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "element_id")
    threshold.SetLowerThreshold(0)
    threshold.SetUpperThreshold(n // 2)
    kept = output_of(threshold, grid).GetNumberOfCells()
    assert kept == n // 2 + 1, f"{path}: {kept} of {n} cells are up to {n // 2}"
    warp = vtk.vtkWarpVector()
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    assert output_of(warp, grid).GetNumberOfPoints() == grid.GetNumberOfPoints()
    return f"{n} cells, {grid.GetNumberOfPoints()} points, surface of {output_of(vtk.vtkDataSetSurfaceFilter(), grid).GetNumberOfCells()} polygons"


def frames_of(name, folder, sets):
    small.run(small.command(name, folder, sets))
    elements = json.load(open(f"{folder}/summary.json", encoding="utf-8"))["counts"]["elements"]
    frames = sorted(glob.glob(f"{folder}/frames/*.vtkhdf"))
    if not frames:
        return f"{name}: no frames"
    small.run([small.PROGRAM, "export", folder, "--format", "vtu"])
    exported = sorted(path for path in glob.glob(f"{folder}/export/frames/*.vtu") if path.count(".") == folder.count(".") + 1)
    assert len(exported) == len(frames), f"{name}: {len(frames)} frames, {len(exported)} exported"
    for path in exported + (frames if VERSION >= (9, 6) else []):
        said = look_at(path, elements)
    return f"{name}: {len(frames)} frames, {sum(map(os.path.getsize, frames))} bytes; the last: {said}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true", help="every example")
    parser.add_argument("--as-is", nargs="+", metavar="NAME", help="these examples, not made small")
    options = parser.parse_args()
    everything = sorted(name for name in os.listdir(f"{small.SOURCE}/examples") if os.path.exists(f"{small.SOURCE}/examples/{name}/scene.yaml"))
    names = options.as_is or (everything if options.all else ["tension", "beams-fracture", "cells-events", "two-models"])
    print(f"VTK {vtk.vtkVersion().GetVTKVersion()}: VTU" + (" and VTKHDF" if VERSION >= (9, 6) else ""))
    for name in names:
        with tempfile.TemporaryDirectory(prefix="frames-", dir=".") as folder:
            print(frames_of(name, folder, [] if options.as_is else small.overrides(name)), flush=True)


if __name__ == "__main__":
    main()
