"""Scenes: what the program reads from YAML, as dicts with units or from a file."""
from __future__ import annotations

import ctypes
import json
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, List, Mapping, Optional, Sequence, Union

from ._library import Options, Price as _Price, library, text, texts
from .errors import Problem, SceneError, error_of

if TYPE_CHECKING:
    from .results import Results
    from .run import Moment, Observer, Run

PathLike = Union[str, "os.PathLike[str]"]


def quantity(value: Any) -> Any:
    """A value as JSON, which is YAML: pairs (number, unit) become "number unit", also of each number of a list or array; NumPy's numbers become plain ones."""
    if isinstance(value, Mapping):
        return {str(key): quantity(item) for key, item in value.items()}
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str) and not isinstance(value[0], (str, bool)):
        number = value[0].tolist() if hasattr(value[0], "tolist") else value[0]
        return [quantity((one, value[1])) for one in number] if isinstance(number, (list, tuple)) else f"{float(number):.17g} {value[1]}"
    if hasattr(value, "tolist"):  # NumPy
        return quantity(value.tolist())
    if isinstance(value, (list, tuple)):
        return [quantity(item) for item in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def overrides(set: Optional[Mapping[str, Any]]) -> List[str]:
    return [f"{path}={json.dumps(quantity(value), ensure_ascii=False)}" for path, value in (set or {}).items()]


@dataclass(frozen=True)
class Price:
    """What :meth:`Scene.check` finds. Predictions are NaN without a trial."""

    n_elements: int
    n_bonds: int
    n_models: int
    device_bytes: int  #: of the arrays as the run begins
    build_seconds: float
    seconds: float  #: of the whole run, output included
    least_seconds: float
    most_seconds: float
    most_device_bytes: float
    host_bytes: float
    disk_bytes: float


def make_options(device: Optional[str], precision: Optional[str], threads: int, exact: bool = False, folder: Optional[PathLike] = None,
                 resume: bool = False) -> Options:
    def encoded(value: Optional[str]) -> Optional[bytes]:
        return None if value is None else os.fspath(value).encode()

    return Options(encoded(device), encoded(precision), threads, exact, encoded(folder), resume)  # type: ignore[arg-type]


class Scene:
    """A scene that was read and found to be right; else :class:`SceneError` says what is wrong, where, and the cure.

    ``Scene({"version": 1, "materials": {"glass": {"E": "72 GPa", "nu": 0.23, "density": (2500, "kg/m^3")}}, ...})``: keys as in YAML
    (docs/reference/scene/README.md), quantities as strings with units or as pairs. ``set`` replaces values: ``{"materials.glass.E": "70 GPa"}``.
    Relative paths in a dict are those of ``folder``.
    """

    def __init__(self, keys: Mapping[str, Any], *, set: Optional[Mapping[str, Any]] = None, folder: PathLike = ".") -> None:
        self._set = dict(set or {})
        self._text = json.dumps(quantity(keys), indent=1, ensure_ascii=False) + "\n"
        name = os.path.join(os.fspath(folder), "scene.py")
        body = self._text.encode()
        options = overrides(self._set)
        self._handle = library.scene_text(name.encode(), body, len(body), len(options), texts(options))
        self._remake: Callable[[Mapping[str, Any]], Scene] = lambda more: Scene(keys, set={**self._set, **more}, folder=folder)
        self._see_errors()

    @classmethod
    def load(cls, path: PathLike, *, set: Optional[Mapping[str, Any]] = None) -> "Scene":
        """The scene of a YAML file."""
        scene = cls.__new__(cls)
        scene._set = dict(set or {})
        scene._text = ""
        options = overrides(scene._set)
        scene._handle = library.scene_load(os.fspath(path).encode(), len(options), texts(options))
        scene._remake = lambda more: cls.load(path, set={**scene._set, **more})
        scene._see_errors()
        return scene

    def with_(self, set: Mapping[str, Any]) -> "Scene":
        """The same scene with some values replaced."""
        return self._remake(set)

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            library.scene_free(handle)

    def _see_errors(self) -> None:
        if not self._handle:
            raise MemoryError("no memory for a scene")
        n = ctypes.c_int()
        found = library.scene_problems(self._handle, ctypes.byref(n))
        lines = self._text.split("\n")
        self._problems = [Problem(bool(p.is_warning), text(p.file), p.line, p.column, text(p.set), text(p.message), text(p.cure),
                                  lines[p.line - 1].strip() if self._text and 0 < p.line <= len(lines) else "")
                          for p in found[: n.value]]
        if library.scene_status(self._handle) != 0:
            raise SceneError(self._problems)

    @property
    def warnings(self) -> List[Problem]:
        """What is no error, but hardly meant."""
        return [problem for problem in self._problems if problem.is_warning]

    @property
    def yaml(self) -> str:
        """The scene with all defaults, as YAML that reads back to it."""
        return text(library.scene_yaml(self._handle))

    def check(self, *, trial: bool = True, device: Optional[str] = None, precision: Optional[str] = None, threads: int = 0) -> Price:
        """Build everything as a run would, and price it by a trial of about a second a stage."""
        price = _Price()
        status = library.scene_check(self._handle, ctypes.byref(make_options(device, precision, threads)), trial, ctypes.byref(price))
        if status != 0:
            raise error_of(status, text(library.scene_message(self._handle)))
        return Price(**{field[0]: getattr(price, field[0]) for field in _Price._fields_})

    def start(self, out: Optional[PathLike] = None, *, device: Optional[str] = None, precision: Optional[str] = None, threads: int = 0,
              exact: bool = False, resume: bool = False) -> "Run":
        """A run that has not begun: for stepping by hand and observers. ``out``: folder of the results; None: nothing is written."""
        from .run import Run

        return Run(self, make_options(device, precision, threads, exact, out, resume))

    def run(self, out: Optional[PathLike] = None, *, progress: Union[bool, Callable[["Moment"], Any]] = False,
            observers: Sequence["Observer"] = (), device: Optional[str] = None, precision: Optional[str] = None, threads: int = 0,
            exact: bool = False, resume: bool = False, log: Optional[Callable[[int, str], Any]] = None) -> "Results":
        """Run all stages and return the results.

        ``out``: their folder; None: one that is removed with the results object. ``progress``: True for a line on the terminal, or
        a function of a :class:`Moment`. ``log``: a function of level (0 error, 1 warning, 2 news) and line. Ctrl-C ends the run at
        its next pause and raises :class:`Interrupted`, a KeyboardInterrupt whose ``results`` hold what was done.
        """
        from .run import run_scene

        return run_scene(self, out, progress, observers, log,
                         lambda folder: make_options(device, precision, threads, exact, folder, resume))
