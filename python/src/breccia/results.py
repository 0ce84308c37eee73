"""What a run has written (docs/reference/results.md), as tables, arrays and meshes. A folder of the program is read alike."""
from __future__ import annotations

import json
import os
import shutil
import weakref
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Union, cast

import numpy as np

if TYPE_CHECKING:
    import pandas
    import pyvista
    import xarray

#: Components of tensors in frames, as VTK has them.
TENSOR = ("xx", "yy", "zz", "xy", "yz", "xz")


def _need(module: str, extra: str) -> Any:
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError:
        raise ImportError(f"{module} is missing: pip install 'breccia[{extra}]', or the package python3-{module} of Debian") from None


def _cells(vtk: Any) -> Any:
    """Cells as VTK takes them in one array: of a sphere 1 and its point; of a polyhedron how many numbers follow, its number of faces, and of each face its number of points and these."""
    n = len(vtk["Types"])
    first, starts = np.zeros(n + 1, int), np.zeros(1, int)  # faces of each cell, points of each face: none
    points, own = np.zeros(0, int), np.asarray(vtk["Connectivity"])[np.asarray(vtk["Offsets"])[:-1]]
    if "FaceConnectivity" in vtk:
        first, starts, points = (np.asarray(vtk[name]) for name in ("PolyhedronOffsets", "FaceOffsets", "FaceConnectivity"))
    faces = np.insert(points, starts[:-1], np.diff(starts))
    at, is_cell = starts[first] + first, np.diff(first) > 0
    heads = np.stack([np.where(is_cell, np.diff(at) + 1, 1), np.where(is_cell, np.diff(first), own)], axis=1)
    return np.insert(faces, np.repeat(at[:-1], 2), heads.ravel())


@dataclass(frozen=True)
class Frame:
    """The state at one moment, in a VTKHDF file."""

    path: str
    index: int
    time: float  #: of the series [s]

    def _open(self) -> Any:
        return _need("h5py", "fields").File(self.path, "r")

    @property
    def names(self) -> List[str]:
        with self._open() as file:
            return sorted(file["VTKHDF/CellData"])

    def field(self, name: str) -> "np.ndarray[Any, Any]":
        """Of every element: [elements] or [elements][components]; tensors xx yy zz xy yz xz."""
        with self._open() as file:
            data = file["VTKHDF/CellData"]
            if name not in data:
                raise KeyError(f"there is no field '{name}' in {self.path}; there are {', '.join(sorted(data))}")
            return np.asarray(data[name])

    def unit(self, name: str) -> str:
        with self._open() as file:
            unit = file["VTKHDF/CellData"][name].attrs.get("unit", b"")
            return unit.decode() if isinstance(unit, bytes) else str(unit)

    def mesh(self, scale: float = 0.0) -> "pyvista.UnstructuredGrid":
        """Cells (spheres: points) with all fields; moved by `scale` times their displacement."""
        pv = _need("pyvista", "pictures")
        with self._open() as file:
            vtk = file["VTKHDF"]
            points, moved = np.asarray(vtk["Points"], float), np.asarray(vtk["PointData/displacement"], float)
            grid = pv.UnstructuredGrid(_cells(vtk), np.asarray(vtk["Types"]), points + scale * moved)
            for name, data in vtk["CellData"].items():
                grid.cell_data[name] = np.asarray(data)
            for name, data in vtk["PointData"].items():
                grid.point_data[name] = np.asarray(data)
        return cast("pyvista.UnstructuredGrid", grid)

    def cut(self, normal: Any = "z", origin: Any = None, scale: float = 0.0) -> "pyvista.PolyData":
        """A plane through the cells, in the middle or through `origin`, with their fields; of a body of cells."""
        mesh = self.mesh(scale)
        if (mesh.celltypes == 1).all():
            raise ValueError("spheres are points in the mesh and have no cut; take mesh().clip(), or mesh().glyph()")
        return cast("pyvista.PolyData", mesh.slice(normal=normal, origin=origin))

    def cracks(self) -> "pyvista.DataSet":
        """Broken faces as polygons, of a scene with fracture."""
        return cast("pyvista.DataSet", _need("pyvista", "pictures").read(self.path[: -len(".vtkhdf")] + ".cracks.vtu"))


class Results:
    """The folder of a run."""

    def __init__(self, folder: Union[str, "os.PathLike[str]"], temporary: bool = False) -> None:
        self.folder = os.fspath(folder)
        with open(self.path("summary.json"), encoding="utf-8") as file:
            #: summary.json as a dict.
            self.summary: Dict[str, Any] = json.load(file)
        self._end = weakref.finalize(self, shutil.rmtree, self.folder, True) if temporary else None

    def __repr__(self) -> str:
        return f"<breccia results {self.folder}: {self.status}>"

    def path(self, name: str) -> str:
        """Of a file of the folder, there or not."""
        return os.path.join(self.folder, name)

    @property
    def status(self) -> str:
        """"done", "interrupted", "physics_stopped", ... ."""
        return str(self.summary["end"]["status"])

    @property
    def measures(self) -> Dict[str, float]:
        """Value of each measure, NaN where there is none."""
        measures = self.summary.get("measures") or {}
        return {name: float("nan") if one["value"] is None else float(one["value"]) for name, one in measures.items()}

    # ---- tables ----

    def history(self) -> Dict[str, "np.ndarray[Any, Any]"]:
        """histories.csv without pandas: column by its head, "kinetic [J]"."""
        with open(self.path("histories.csv"), encoding="utf-8") as file:
            heads = file.readline().rstrip("\n").split(",")
        table = np.genfromtxt(self.path("histories.csv"), delimiter=",", skip_header=1, ndmin=2)
        return {head: table[:, k] for k, head in enumerate(heads)}

    def _table(self, name: str) -> "pandas.DataFrame":
        pd = _need("pandas", "tables")
        exact: Dict[str, Any] = {"float_precision": "round_trip"} if int(pd.__version__.split(".")[0]) < 3 else {}  # from 3 on it always is
        return cast("pandas.DataFrame", pd.read_csv(self.path(name), **exact) if os.path.exists(self.path(name)) else pd.DataFrame())

    def histories(self) -> "pandas.DataFrame":
        """A row for each sample, a column for each sensor."""
        return self._table("histories.csv")

    def cracks(self) -> "pandas.DataFrame":
        """A row for each broken bond; without rows where nothing can break."""
        return self._table("cracks.csv")

    def fragments(self) -> "pandas.DataFrame":
        """A row for each fragment of each frame; the smallest are counted, not listed (docs/notebook/fracture.md)."""
        return self._table("fragments.csv")

    # ---- fields ----

    @property
    def frames(self) -> List[Frame]:
        if not os.path.exists(self.path("frames.vtkhdf.series")):
            return []
        with open(self.path("frames.vtkhdf.series"), encoding="utf-8") as file:
            series = json.load(file)["files"]
        return [Frame(self.path(one["name"]), k, float(one["time"])) for k, one in enumerate(series)]

    def fields(self, *names: str, frames: Optional[List[int]] = None) -> "xarray.Dataset":
        """Fields of the elements over the frames, as (frame, element[, component or tensor]); all of them are read into memory. Without names: all that the
        first frame has."""
        xr = _need("xarray", "fields")
        chosen = [frame for frame in self.frames if frames is None or frame.index in frames]
        if not chosen:
            raise ValueError(f"{self.folder} has no such frames; `output: {{frames: 10}}` writes some")
        data = {}
        for name in names or chosen[0].names:
            values = np.stack([frame.field(name) for frame in chosen])
            last = {3: ("component",), 4: ("quaternion",), 6: ("tensor",)}.get(values.shape[-1], ()) if values.ndim == 3 else ()
            data[name] = (("frame", "element") + last, values, {"unit": chosen[0].unit(name)})
        coordinates: Dict[str, Any] = {"frame": [frame.index for frame in chosen], "time": ("frame", [frame.time for frame in chosen])}
        used = {dimension for _, (dimensions, *_) in data.items() for dimension in dimensions}
        coordinates.update({key: value for key, value in (("component", list("xyz")), ("tensor", list(TENSOR)), ("quaternion", list("wxyz"))) if key in used})
        return cast("xarray.Dataset", xr.Dataset(data, coordinates))
