"""Runs: all at once or by hand, with observers that see the state where the device keeps it."""
from __future__ import annotations

import ctypes
import enum
import math
import os
import shutil
import signal
import sys
import tempfile
import threading
import warnings
import weakref
from contextlib import contextmanager
from dataclasses import dataclass, fields
from types import TracebackType
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Type, Union

import numpy as np

from . import _library as c
from ._library import library, text
from .errors import Interrupted, InputError, error_of
from .results import Results

if TYPE_CHECKING:
    from .scene import PathLike, Scene


class Answer(enum.IntEnum):
    """What an observer may return; None is GO_ON."""

    GO_ON = 0
    END_STAGE = 1  #: the stage ends here as if it were done, and the next one begins
    STOP = 2  #: the run ends at its next pause, with results, as Ctrl-C ends it


@dataclass(frozen=True)
class Moment:
    """Where a run stands."""

    stage: int  #: from 0
    n_stages: int
    stage_name: str
    step: int  #: of the stage: steps, increments or events so far
    planned: int
    total_steps: int  #: dynamic steps of all stages
    time: float  #: of the stage [s]; of static ones the load factor [-]
    total_time: float  #: [s]
    time_step: float  #: of a dynamic stage [s], else 0
    seconds: float  #: by the clock since the run began
    seconds_left: float  #: of this stage; NaN: not known yet


@dataclass(frozen=True)
class Observer:
    """``look(run)`` is called at step 0 of each stage and every so many steps (increments, events), or seconds of simulated time, or at the ends of stages."""

    look: Callable[["Run"], Any]
    steps: int = 0
    seconds: float = 0.0
    stage_ends: bool = False


@dataclass(frozen=True)
class Device:
    selector: str  #: for ``device=``
    name: str
    usable: bool
    why_not: str


def devices() -> List[Device]:
    """All devices, also those that cannot be used, with the reason."""
    room = (c.Device * 64)()
    n = min(64, library.devices(64, room))
    return [Device(text(d.selector), text(d.name), bool(d.usable), text(d.why_not)) for d in room[:n]]


def _moment(m: Any) -> Moment:
    values: Dict[str, Any] = {f.name: getattr(m, f.name) for f in fields(Moment)}
    return Moment(**{**values, "stage_name": text(m.stage_name)})


class Run:
    """A run of a scene, made by :meth:`Scene.start`. By hand::

        with scene.start("results") as run:
            while run.step(100):
                print(run.moment.time, abs(run.array("velocity")).max())
        run.results.histories()
    """

    def __init__(self, scene: "Scene", options: Any) -> None:
        self._scene = scene  # borrowed by the library until the run is freed
        self._folder = text(options.folder)
        self._handle = library.run_create(scene._handle, ctypes.byref(options))
        if not self._handle:
            raise MemoryError("no memory for a run")
        self._callbacks: List[Any] = []
        self._views: List["weakref.ref[Any]"] = []
        self._told: Optional[Callable[[Moment], Any]] = None
        self._raised: Optional[BaseException] = None
        self._signalled = self._stepped = self._ended = False
        self._listen()

    def __del__(self) -> None:
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            library.run_free(handle)

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        if self._stepped and not self._ended:
            self.end()

    # ---- what is called while it runs ----

    def _answer(self, call: Callable[[], Any]) -> int:
        """The answer of a caller's function; what it raises ends the run and is raised again at its end."""
        if self._raised is not None:
            return int(Answer.STOP)
        try:
            answer = call()
            if answer is None:
                return int(Answer.GO_ON)
            if not isinstance(answer, Answer):
                raise TypeError(f"an observer returns None, breccia.END_STAGE or breccia.STOP, not {answer!r}")
            return int(answer)
        except BaseException as error:  # whatever it is must not pass through C
            self._raised = error
            return int(Answer.STOP)

    def _listen(self) -> None:
        """Python hears signals only while it runs: so it is always asked, ten times a second."""
        me = weakref.ref(self)

        def told(_: Any, m: Any) -> int:
            run = me()
            if run is None:
                return 0
            if run._signalled:
                return int(Answer.STOP)
            function = run._told
            return run._answer(lambda: function(_moment(m.contents))) if function else 0

        self._callbacks.append(c.TOLD(told))
        library.run_progress(self._handle, 0.1, self._callbacks[-1], None)

    def progress(self, told: Callable[[Moment], Any], every: float = 0.1) -> None:
        """``told(moment)`` about every so many seconds; breccia.STOP ends the run. Before it begins."""
        self._told = told
        self._check(library.run_progress(self._handle, float(every), self._callbacks[0], None))

    def log(self, line: Callable[[int, str], Any], level: int = 2) -> None:
        """``line(level, text)`` for the lines of the log up to a level: 0 errors, 1 warnings, 2 news, 3 all."""
        self._callbacks.append(c.LINE(lambda _, at, words: line(at, text(words))))
        self._check(library.run_log(self._handle, level, self._callbacks[-1], None))

    def observe(self, look: Callable[["Run"], Any], *, steps: int = 0, seconds: float = 0.0, stage_ends: bool = False) -> None:
        """Call ``look(run)`` as :class:`Observer` says. Before the run begins. What is looked at is not changed by looking: results are the same bytes."""
        me = weakref.ref(self)

        def call(_: Any, __: Any, ___: Any) -> int:
            run = me()
            return 0 if run is None else run._answer(lambda: look(run))

        self._callbacks.append(c.LOOK(call))
        observer = c.Observer(None, steps, seconds, stage_ends, self._callbacks[-1])
        self._check(library.run_observe(self._handle, ctypes.byref(observer)))

    # ---- running ----

    def _check(self, status: int) -> None:
        if status != 0:
            raise error_of(status, text(library.run_message(self._handle)))

    @contextmanager
    def _hearing(self) -> Iterator[None]:
        """Ctrl-C asks the run to stop instead of leaving it in the middle."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return

        def stop(*_: Any) -> None:
            self._signalled = True
            library.run_interrupt(self._handle)

        before = signal.signal(signal.SIGINT, stop)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before if before is not None else signal.SIG_DFL)

    def _finish(self, status: int) -> None:
        """The run is over."""
        self._ended = True
        if any(view() is not None for view in self._views):
            warnings.warn("views of the state outlive the run, and their memory is gone: use Run.array for copies", RuntimeWarning, stacklevel=4)
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if status != 0 or self._signalled:
            error = error_of(6 if self._signalled else status, text(library.run_message(self._handle)) or "interrupted")
            if isinstance(error, Interrupted) and self._folder:
                error.results = self.results
            raise error

    def go(self) -> None:
        """All that is left to do, and the results."""
        with self._hearing():
            status = library.run_go(self._handle)
        self._finish(status)

    def step(self, n: int = 1) -> int:
        """n steps (increments, events), over the ends of stages; returns how many were made: fewer once all stages are done."""
        done = ctypes.c_int64()
        refused = self._ended
        self._stepped = True
        with self._hearing():
            status = library.run_step(self._handle, n, ctypes.byref(done))
        if status != 0:
            if refused or n < 0:
                self._check(status)
            self._finish(status)
        if self._signalled:
            self._signalled = False  # the steps are done; the run ends where it next pauses
            raise Interrupted("interrupted")
        return done.value

    def end(self) -> None:
        """End a run that was stepped, with the results of what was done. Leaving a ``with`` block does it too."""
        status = library.run_end(self._handle)
        self._finish(0 if status == 6 and not self._signalled else status)

    def interrupt(self) -> None:
        """Ask it to stop at its next pause; from any thread."""
        library.run_interrupt(self._handle)

    # ---- the state, in observers and between steps ----

    @property
    def moment(self) -> Moment:
        m = c.Moment()
        if library.run_moment(self._handle, ctypes.byref(m)) != 0:
            raise InputError("the state is not there: a moment is inside observers and between steps")
        return _moment(m)

    @property
    def n_parts(self) -> int:
        """Models of the scene, each with its elements; 0: the state is not there."""
        return int(library.run_parts(self._handle))

    def names(self, part: int = 0) -> List[str]:
        """Arrays that :meth:`array` and :meth:`view` know."""
        room = (ctypes.c_char_p * 32)()
        n = library.run_array_names(self._handle, part, 32, room)
        return [text(name) for name in room[:n]]

    def _ask(self, name: str, part: int) -> Any:
        array = c.Array()
        self._check(library.run_array(self._handle, name.encode(), part, ctypes.byref(array)))
        return array

    def _view(self, name: str, part: int) -> Tuple[Any, "np.ndarray[Any, Any]"]:
        array = self._ask(name, part)
        number = ctypes.c_double if array.precision == 8 else ctypes.c_float
        memory = (number * (array.n_rows * array.width)).from_address(array.data)
        memory.run = self
        self._views = [view for view in self._views if view() is not None] + [weakref.ref(memory)]
        out = np.frombuffer(memory, dtype=number).reshape(array.n_rows, array.width)
        out.flags.writeable = False
        return array, out

    def view(self, name: str, part: int = 0) -> "np.ndarray[Any, Any]":
        """The array where the library has it, [rows][width], not to be written. displacement, velocity, force, orientation, spin and broken are the
        device's own memory on the cpu and change as the run goes on; the others stand until they are asked for again. All of it is gone when the run
        has ended. :meth:`rows` says whose the rows are."""
        return self._view(name, part)[1]

    def rows(self, part: int = 0) -> "np.ndarray[Any, Any]":
        """Element of each row of the live arrays, -1: none."""
        array = self._ask("displacement", part)
        return np.array(np.ctypeslib.as_array(array.element, shape=(array.n_rows,)))

    def array(self, name: str, part: int = 0) -> "np.ndarray[Any, Any]":
        """A copy in the order of the elements: [elements] or [elements][width]."""
        array, view = self._view(name, part)
        if array.element:
            rows = self.rows(part)
            there = rows >= 0
            out = np.empty((int(there.sum()), array.width), dtype=view.dtype)
            out[rows[there]] = view[there]
        else:
            out = view.copy()
        return out[:, 0] if array.width == 1 else out

    @property
    def bonds(self) -> Tuple[int, int]:
        """Bonds in all, and how many of them are broken."""
        n, broken = ctypes.c_int64(), ctypes.c_int64()
        if library.run_bonds(self._handle, ctypes.byref(n), ctypes.byref(broken)) != 0:
            raise InputError(text(library.run_message(self._handle)) or "the state is not there: bonds are counted inside observers and between steps")
        return n.value, broken.value

    def sensors(self) -> Dict[str, float]:
        """What the scene's sensors read now."""
        n = library.run_sensor_count(self._handle)
        if self.n_parts == 0:
            raise InputError("the state is not there: sensors are read inside observers and between steps")
        value = (ctypes.c_double * max(1, n))()
        self._check(library.run_read_sensors(self._handle, value))
        return {text(library.run_sensor_name(self._handle, k)): value[k] for k in range(n)}

    @property
    def sensor_units(self) -> Dict[str, str]:
        n = library.run_sensor_count(self._handle)
        return {text(library.run_sensor_name(self._handle, k)): text(library.run_sensor_unit(self._handle, k)) for k in range(n)}

    # ---- after the end ----

    @property
    def results(self) -> Results:
        """What the folder holds; of a run with a folder."""
        if not self._folder:
            raise InputError("the run has no folder: name one, `scene.start(out)`")
        return Results(self._folder)

    @property
    def report(self) -> Dict[str, Any]:
        """Counts and seconds of a run that is over."""
        report = c.Report()
        if library.run_report(self._handle, ctypes.byref(report)) != 0:
            raise InputError("the run is not over")
        values = {field[0]: getattr(report, field[0]) for field in c.Report._fields_}
        return {name: text(value) if isinstance(value, bytes) else value for name, value in values.items()}


def _line(moment: Moment) -> None:
    """The progress line."""
    left = "" if math.isnan(moment.seconds_left) else f", left {moment.seconds_left:.0f} s"
    share = 100 * moment.step / moment.planned if moment.planned else 100
    sys.stderr.write(f"\r\x1b[K{moment.stage_name}: {share:.0f} % ({moment.step} of {moment.planned}){left}")
    sys.stderr.flush()


def run_scene(scene: "Scene", out: Optional["PathLike"], progress: Union[bool, Callable[[Moment], Any]], observers: Sequence[Observer],
              log: Optional[Callable[[int, str], Any]], make_options: Callable[[str], Any]) -> Results:
    """:meth:`Scene.run`."""
    own = out is None
    folder = tempfile.mkdtemp(prefix="breccia-") if out is None else os.fspath(out)
    try:
        run = Run(scene, make_options(folder))
        if progress:
            run.progress(_line if progress is True else progress)
        if log:
            run.log(log)
        for one in observers:
            run.observe(one.look, steps=one.steps, seconds=one.seconds, stage_ends=one.stage_ends)
        try:
            run.go()
        finally:
            if progress is True:
                sys.stderr.write("\n")
    except Interrupted as stopped:
        if own:
            stopped.results = Results(folder, temporary=True)
        raise
    except BaseException:
        if own:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    return Results(folder, temporary=own)
