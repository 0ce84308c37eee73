"""The C interface of libbreccia.so (host/include/breccia.h) through ctypes. Nothing here is public."""
from __future__ import annotations

import ctypes as c
import os
from typing import Any, Dict, List

INTERFACE = 1


class Problem(c.Structure):
    _fields_ = [("is_warning", c.c_bool), ("file", c.c_char_p), ("line", c.c_int), ("column", c.c_int), ("set", c.c_char_p),
                ("message", c.c_char_p), ("cure", c.c_char_p)]


class Options(c.Structure):
    _fields_ = [("device", c.c_char_p), ("precision", c.c_char_p), ("threads", c.c_int), ("exact", c.c_bool), ("folder", c.c_char_p),
                ("resume", c.c_bool)]


class Price(c.Structure):
    _fields_ = [("n_elements", c.c_int64), ("n_bonds", c.c_int64), ("n_models", c.c_int64), ("device_bytes", c.c_int64),
                ("build_seconds", c.c_double), ("seconds", c.c_double), ("least_seconds", c.c_double), ("most_seconds", c.c_double),
                ("most_device_bytes", c.c_double), ("host_bytes", c.c_double), ("disk_bytes", c.c_double)]


class Moment(c.Structure):
    _fields_ = [("stage", c.c_int), ("n_stages", c.c_int), ("stage_name", c.c_char_p), ("step", c.c_int64), ("planned", c.c_int64),
                ("total_steps", c.c_int64), ("time", c.c_double), ("total_time", c.c_double), ("time_step", c.c_double),
                ("seconds", c.c_double), ("seconds_left", c.c_double)]


class Array(c.Structure):
    _fields_ = [("name", c.c_char_p), ("unit", c.c_char_p), ("data", c.c_void_p), ("precision", c.c_int), ("n_rows", c.c_int64),
                ("width", c.c_int32), ("element", c.POINTER(c.c_int32)), ("is_live", c.c_bool)]


class Device(c.Structure):
    _fields_ = [("selector", c.c_char * 32), ("name", c.c_char * 128), ("usable", c.c_bool), ("why_not", c.c_char * 256)]


class Measure(c.Structure):
    _fields_ = [("name", c.c_char_p), ("unit", c.c_char_p), ("why_not", c.c_char_p), ("value", c.c_double), ("has_target", c.c_bool),
                ("target", c.c_double), ("error", c.c_double)]


class Report(c.Structure):
    _fields_ = [("n_elements", c.c_int64), ("n_bonds", c.c_int64), ("steps", c.c_int64), ("device_bytes", c.c_int64),
                ("build_seconds", c.c_double), ("setup_seconds", c.c_double), ("steps_seconds", c.c_double),
                ("output_seconds", c.c_double), ("total_seconds", c.c_double), ("device", c.c_char_p), ("device_name", c.c_char_p)]


LOOK = c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_void_p, c.POINTER(Moment))
TOLD = c.CFUNCTYPE(c.c_int, c.c_void_p, c.POINTER(Moment))
LINE = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p)


class Observer(c.Structure):
    _fields_ = [("self", c.c_void_p), ("every_steps", c.c_int64), ("every_seconds", c.c_double), ("stage_ends", c.c_bool), ("look", LOOK)]


_P = c.c_void_p
_TEXTS = c.POINTER(c.c_char_p)
# name: what it returns, then what it takes
_FUNCTIONS: Dict[str, List[Any]] = {
    "version": [c.c_char_p], "commit": [c.c_char_p], "interface": [c.c_int], "status_text": [c.c_char_p, c.c_int],
    "devices": [c.c_int, c.c_int, c.POINTER(Device)],
    "scene_load": [_P, c.c_char_p, c.c_int, _TEXTS], "scene_text": [_P, c.c_char_p, c.c_char_p, c.c_size_t, c.c_int, _TEXTS],
    "scene_free": [None, _P], "scene_status": [c.c_int, _P], "scene_problems": [c.POINTER(Problem), _P, c.POINTER(c.c_int)],
    "scene_yaml": [c.c_char_p, _P], "scene_check": [c.c_int, _P, c.POINTER(Options), c.c_bool, c.POINTER(Price)],
    "scene_message": [c.c_char_p, _P],
    "run_create": [_P, _P, c.POINTER(Options)], "run_free": [None, _P], "run_observe": [c.c_int, _P, c.POINTER(Observer)],
    "run_progress": [c.c_int, _P, c.c_double, TOLD, c.c_void_p], "run_log": [c.c_int, _P, c.c_int, LINE, c.c_void_p],
    "run_go": [c.c_int, _P], "run_step": [c.c_int, _P, c.c_int64, c.POINTER(c.c_int64)], "run_end": [c.c_int, _P],
    "run_interrupt": [None, _P], "run_message": [c.c_char_p, _P], "run_parts": [c.c_int, _P],
    "run_array_names": [c.c_int, _P, c.c_int, c.c_int, _TEXTS], "run_array": [c.c_int, _P, c.c_char_p, c.c_int, c.POINTER(Array)],
    "run_moment": [c.c_int, _P, c.POINTER(Moment)], "run_bonds": [c.c_int, _P, c.POINTER(c.c_int64), c.POINTER(c.c_int64)],
    "run_sensor_count": [c.c_int, _P], "run_sensor_name": [c.c_char_p, _P, c.c_int], "run_sensor_unit": [c.c_char_p, _P, c.c_int],
    "run_read_sensors": [c.c_int, _P, c.POINTER(c.c_double)], "run_file": [c.c_char_p, _P, c.c_char_p],
    "run_measure_count": [c.c_int, _P], "run_measure": [c.c_int, _P, c.c_int, c.POINTER(Measure)],
    "run_report": [c.c_int, _P, c.POINTER(Report)],
}


def _candidates() -> List[str]:
    """Where the library may be: BRECCIA_LIBRARY alone if it is set, else in the package, else where the loader looks."""
    named = os.environ.get("BRECCIA_LIBRARY")
    if named:
        return [named]
    name = f"libbreccia.so.{INTERFACE}"
    own = os.path.join(os.path.dirname(os.path.abspath(__file__)), "lib", name)
    return ([own] if os.path.exists(own) else []) + [name]


def _open() -> Any:
    # GNU OpenMP reads it as it is loaded; the program asks for the same of itself (docs/notebook/devices.md, "Waiting threads").
    chosen = "GOMP_SPINCOUNT" in os.environ or "OMP_WAIT_POLICY" in os.environ
    if not chosen:
        os.environ["GOMP_SPINCOUNT"] = "1000"
    reasons = []
    try:
        for path in _candidates():
            try:
                return c.CDLL(path)
            except OSError as error:
                reasons.append(str(error))
    finally:
        if not chosen:
            del os.environ["GOMP_SPINCOUNT"]
    raise ImportError("breccia's library cannot be opened: " + "; ".join(reasons) + "; set BRECCIA_LIBRARY to libbreccia.so, or install the "
                      "packages it needs (Debian: libyaml-0-2 libhdf5-103-1 ocl-icd-libopencl1 voro++ libffi8 libcairo2 liblapacke libcminpack1 libgomp1)")


class Library:
    """The functions without their prefix: ``library.run_go(handle)``."""

    def __init__(self) -> None:
        loaded = _open()
        for name, (result, *arguments) in _FUNCTIONS.items():
            function = getattr(loaded, "breccia_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(self, name, function)
        if self.interface() != INTERFACE:
            raise ImportError(f"libbreccia has interface {self.interface()}, this package needs {INTERFACE}; install both of one version")

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"libbreccia has no function breccia_{name}")


library = Library()


def text(value: Any) -> str:
    """A C string; None is empty."""
    return (value or b"").decode("utf-8", "replace")


def texts(values: List[str]) -> Any:
    """A C array of strings."""
    return (c.c_char_p * max(1, len(values)))(*[value.encode() for value in values])
