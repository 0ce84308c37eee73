"""Many runs of one scene: grids of keys, several at once, taken up again where they were left."""
from __future__ import annotations

import csv
import itertools
import json
import math
import multiprocessing
import os
import traceback
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from .scene import PathLike, Scene, quantity

if TYPE_CHECKING:
    import pandas

#: 97.5 % points of Student's t for 1, 2, ... degrees of freedom; beyond: 1.96 and what falls off as 1 / n.
_STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086)


def student(freedom: int) -> float:
    """The 97.5 % point of Student's t; beyond 20 degrees of freedom to 0.2 %."""
    return _STUDENT[freedom - 1] if freedom <= len(_STUDENT) else 1.96 + 2.4 / freedom


@dataclass(frozen=True)
class Sweep:
    """The runs of a sweep: a dict each, with the keys that were set, `run`, `status` and `error`, and the measures."""

    folder: str
    rows: List[Dict[str, Any]]

    def table(self) -> "pandas.DataFrame":
        import pandas

        return pandas.DataFrame(self.rows)

    def means(self, measure: str, over: str) -> List[Dict[str, Any]]:
        """Runs that differ only in the key `over` (a seed) together: n, mean, standard deviation and half the 95 % confidence interval of the mean."""
        groups: Dict[Tuple[Any, ...], List[float]] = {}
        keys = [key for key in self.rows[0]["set"] if key != over] if self.rows else []
        for row in self.rows:
            value = row.get(measure, math.nan)
            if row["status"] == "done" and not math.isnan(value):
                groups.setdefault(tuple(json.dumps(row["set"][key]) for key in keys), []).append(value)
        out = []
        for key, values in groups.items():
            n, mean = len(values), math.fsum(values) / len(values)
            deviation = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (n - 1)) if n > 1 else math.nan
            half = student(n - 1) * deviation / math.sqrt(n) if n > 1 else math.nan
            out.append({**{name: json.loads(part) for name, part in zip(keys, key)}, "n": n, "mean": mean, "deviation": deviation, "confidence": half})
        return out


def _points(grid: Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]]) -> List[Dict[str, Any]]:
    if isinstance(grid, Mapping):
        return [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    return [dict(point) for point in grid]


def _state(folder: str, point: Mapping[str, Any], yaml: str) -> Optional[str]:
    """How a run of this point in this folder ended; None: there is none of this scene."""
    try:
        with open(os.path.join(folder, "point.json"), encoding="utf-8") as file:
            told = json.load(file)
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            ended = json.load(file)["end"]["status"]
    except (OSError, ValueError, KeyError):
        return None
    return str(ended) if told == {"set": point, "scene": yaml} else None


def _one(make: Tuple[str, Any, Mapping[str, Any]], point: Mapping[str, Any], folder: str, options: Mapping[str, Any]) -> Tuple[str, str]:
    """One run, in a process of its own: how it ended, and why."""
    try:
        kind, source, fixed = make
        together = {**fixed, **point}
        scene = Scene.load(source, set=together) if kind == "file" else Scene(source[0], set=together, folder=source[1])
        if _state(folder, dict(point), scene.yaml) == "done":
            return "done", ""
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "point.json"), "w", encoding="utf-8") as file:
            json.dump({"set": dict(point), "scene": scene.yaml}, file)
        return scene.run(folder, **options).status, ""
    except KeyboardInterrupt:
        return "interrupted", "interrupted"
    except Exception as error:  # one run that fails does not stop the others
        return "failed", str(error) or traceback.format_exc()


def _row(k: int, point: Mapping[str, Any], folder: str, ended: Tuple[str, str]) -> Dict[str, Any]:
    row: Dict[str, Any] = {"run": k, "set": dict(point), "status": ended[0], "error": ended[1], **{key: value for key, value in point.items()}}
    if ended[0] == "done":
        from .results import Results

        row.update(Results(folder).measures)
    return row


def _write(path: str, rows: List[Dict[str, Any]]) -> None:
    heads = [head for head in dict.fromkeys(head for row in rows for head in row) if head not in ("set", "error")] + ["error"]
    with open(path + ".part", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, heads, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(path + ".part", path)


def sweep(scene: Union[PathLike, Mapping[str, Any]], grid: Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]], out: PathLike, *,
          set: Optional[Mapping[str, Any]] = None, jobs: Optional[int] = None, threads: int = 1, device: Optional[str] = None,
          precision: Optional[str] = None, folder: PathLike = ".") -> Sweep:
    """Run a scene (a YAML file, or a dict) for all combinations of a grid, ``{"bodies.0.fill.packing.seed": range(1, 6), ...}``, or for a list of such points.

    Each run has a folder ``out/00000``, ...; ``out/table.csv`` has a row for each: run, status, the keys of the grid, the measures. ``jobs`` run at once, each with so many
    ``threads`` (default: as many as there are processors for them). A run that is done is not done again, as long as its scene is the same; one that fails leaves the others
    alone. The table does not depend on how often the sweep was stopped and taken up, nor on jobs.
    """
    points = [quantity(point) for point in _points(grid)]
    make = ("file", os.fspath(scene), dict(set or {})) if isinstance(scene, (str, os.PathLike)) else ("keys", (quantity(scene), os.fspath(folder)), dict(set or {}))
    out = os.fspath(out)
    os.makedirs(out, exist_ok=True)
    folders = [os.path.join(out, f"{k:05d}") for k in range(len(points))]
    options = {"threads": threads, "device": device, "precision": precision}
    at_once = jobs or max(1, len(os.sched_getaffinity(0)) // max(1, threads))
    ended: List[Tuple[str, str]] = [("missing", "")] * len(points)
    with ProcessPoolExecutor(min(at_once, max(1, len(points))), mp_context=multiprocessing.get_context("spawn")) as pool:
        waiting = {pool.submit(_one, make, points[k], folders[k], options): k for k in range(len(points))}
        try:
            for one in as_completed(waiting):
                ended[waiting[one]] = one.result()
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    rows = [_row(k, points[k], folders[k], ended[k]) for k in range(len(points))]
    _write(os.path.join(out, "table.csv"), rows)
    return Sweep(out, rows)
