"""Many runs of one scene: `breccia study`, with its tables as rows and data frames."""

from __future__ import annotations

import csv
import json
import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from ._program import call
from .scene import PathLike, quantity

if TYPE_CHECKING:
    import pandas

#: Keys of a scene whose value is a path.
_PATHS = ("file", "domain", "mesh", "points")


@dataclass(frozen=True)
class Sweep:
    """The runs of a study: a dict each, with `run`, `status`, `error`, the keys that vary (all in `set`), the measures."""

    folder: str
    rows: List[Dict[str, Any]]

    def table(self) -> "pandas.DataFrame":
        import pandas

        return pandas.DataFrame(self.rows)

    def means(self, measure: Optional[str] = None) -> List[Dict[str, Any]]:
        """A dict for each group of runs that differ only in what is averaged over, and each measure (or the one
        that is named): the other keys, `measure`, n, mean, deviation, and half the 95 % confidence interval of the mean as `confidence` (NaN for one run).
        """
        rows = _read(os.path.join(self.folder, "means.csv"))
        numbers = ("n", "mean", "deviation", "confidence")
        found = [
            {
                **{key: value for key, value in row.items() if key not in numbers},
                "n": int(row["n"]),
                **{key: _number(row[key]) for key in numbers[1:]},
            }
            for row in rows
        ]
        return [row for row in found if measure in (None, row["measure"])]

    def fits(self) -> List[Dict[str, Any]]:
        """The laws that were asked for, a dict a parameter: the keys that are not averaged over, law, measure, by, n,
        parameter, value, error (standard error; NaN where there is none)."""
        path = os.path.join(self.folder, "fits.csv")
        return [
            {**row, "n": int(row["n"]), "value": _number(row["value"]), "error": _number(row["error"])}
            for row in (_read(path) if os.path.exists(path) else [])
        ]


def _read(path: str) -> List[Dict[str, str]]:
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _number(text: str) -> float:
    return float(text) if text else math.nan


def _word(value: Any) -> str:
    """A value of a scene as the text that `--set` takes: words and quantities as they are, the rest as JSON."""
    return (
        value
        if isinstance(value, str) and value and not set(value) & set("\"'\\{}[]#:&*!|>%@`,\n")
        else json.dumps(value, ensure_ascii=False)
    )


def _absolute(keys: Any, folder: str) -> Any:
    """Keys of a scene with paths that do not depend on where the scene is written."""
    if isinstance(keys, Mapping):
        return {
            key: (
                os.path.abspath(os.path.join(folder, value))
                if key in _PATHS and isinstance(value, str)
                else _absolute(value, folder)
            )
            for key, value in keys.items()
        }
    return [_absolute(item, folder) for item in keys] if isinstance(keys, list) else keys


def _measured(out: str, rows: Sequence[Mapping[str, str]]) -> List[str]:
    """Names of the measures, of the runs that have some."""
    for row in rows:
        if row["status"] == "done":
            with open(os.path.join(out, row["run"], "summary.json"), encoding="utf-8") as file:
                return list(json.load(file)["measures"])
    return []


def _rows(out: str, points: Optional[Sequence[Mapping[str, Any]]]) -> List[Dict[str, Any]]:
    table = _read(os.path.join(out, "table.csv"))
    measures = _measured(out, table)
    found = []
    for k, row in enumerate(table):
        keys = (
            dict(points[k])
            if points
            else {key: value for key, value in row.items() if key not in ("run", "status", "reason", *measures)}
        )
        values = {name: _number(row[name]) for name in measures} if row["status"] == "done" else {}
        found.append(
            {"run": int(row["run"]), "status": row["status"], "error": row["reason"], "set": keys, **keys, **values}
        )
    return found


def study(
    path: PathLike,
    out: PathLike,
    *,
    jobs: Optional[int] = None,
    threads: int = 1,
    device: Optional[str] = None,
    precision: Optional[str] = None,
    progress: bool = False,
    _points: Optional[Sequence[Mapping[str, Any]]] = None,
) -> Sweep:
    """Run the study of a file (docs/reference/study.md) into the folder ``out``, or go on with it: `breccia study`.

    ``jobs`` run at once, each a process with so many ``threads`` (default: as many as there are processors for them).
    A run that is done is not done again; one that fails leaves the others alone, and its row says why. ``progress``: messages go to the terminal.
    """
    options = ["--now", "--jobs", str(jobs or 0), "--threads", str(threads)]
    options += ["--device", device] if device else []
    options += ["--precision", precision] if precision else []
    call(["study", os.fspath(path), "--output", os.fspath(out), *options], progress)
    return Sweep(os.fspath(out), _rows(os.fspath(out), _points))


def _points_of(
    grid: Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]],
) -> Tuple[Dict[str, List[Any]], List[Dict[str, Any]], bool]:
    """Values by key, all points in the order of the study, and whether they are a grid."""
    points: List[Dict[str, Any]]
    if not isinstance(grid, Mapping):
        points = [quantity(point) for point in grid]
        if not points or any(set(point) != set(points[0]) for point in points):
            raise ValueError("a list of points needs one point at least, and the same keys in all")
        return {key: [point[key] for point in points] for key in points[0]}, points, False
    values = {key: quantity(list(value)) for key, value in grid.items()}
    points = [{}]
    for key, one in values.items():
        points = [{**point, key: value} for point in points for value in one]
    return values, points, True


def sweep(
    scene: Union[PathLike, Mapping[str, Any]],
    grid: Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]],
    out: PathLike,
    *,
    average: Sequence[str] = (),
    fit: Sequence[Mapping[str, Any]] = (),
    set: Optional[Mapping[str, Any]] = None,
    jobs: Optional[int] = None,
    threads: int = 1,
    device: Optional[str] = None,
    precision: Optional[str] = None,
    progress: bool = False,
    folder: PathLike = ".",
) -> Sweep:
    """Run a scene (a YAML file, or a dict) for all combinations of a grid, ``{"fracture.seed": range(1, 6), ...}``, or
    for a list of points ``{"fracture.seed": 1, ...}``, all with the same keys.

    Writes ``out/study.yaml`` (and ``out/scene.yaml`` of a dict) and does :func:`study` with it. Means are taken over
    the keys ``average``; ``fit``: laws, as
    ``{"weibull": "strength"}``, ``{"size_effect": "strength", "by": KEY}`` or ``{"fragments": "power"}``. ``set``: values that are replaced in all runs.
    """
    out = os.fspath(out)
    os.makedirs(out, exist_ok=True)
    if isinstance(scene, (str, os.PathLike)):
        path = os.path.abspath(os.fspath(scene))
    else:
        path = os.path.abspath(os.path.join(out, "scene.yaml"))
        with open(path, "w", encoding="utf-8") as file:
            json.dump(_absolute(quantity(scene), os.fspath(folder)), file, indent=1, ensure_ascii=False)
    values, points, is_grid = _points_of(grid)
    fixed = [{"key": key, "values": [_word(value)]} for key, value in quantity(dict(set or {})).items()]
    varied = [
        {"key": key, "values": [_word(value) for value in one], **({"average": True} if key in average else {})}
        for key, one in values.items()
    ]
    told = {"scene": path, "together": not is_grid, "vary": fixed + varied, "fit": [dict(one) for one in fit]}
    with open(os.path.join(out, "study.yaml"), "w", encoding="utf-8") as file:
        json.dump(told, file, indent=1, ensure_ascii=False)
    return study(
        os.path.join(out, "study.yaml"),
        out,
        jobs=jobs,
        threads=threads,
        device=device,
        precision=precision,
        progress=progress,
        _points=points,
    )
