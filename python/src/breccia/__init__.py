"""Fracture of brittle elastic solids by bonded discrete elements.

    import breccia
    results = breccia.Scene.load("scene.yaml").run("results", progress=True)
    results.histories().plot(x="time [s]")

See docs/reference/python.md; the keys of a scene are in docs/reference/scene/README.md.
"""
from ._library import library as _functions, text as _text
from ._program import new
from .errors import BrecciaError, DeviceError, FileError, InputError, Interrupted, PhysicsStopped, Problem, SceneError
from .results import Frame, Results
from .run import Answer, Device, Moment, Observer, Run, devices
from .scene import Price, Scene
from .sweep import Sweep, study, sweep

END_STAGE = Answer.END_STAGE
STOP = Answer.STOP
__version__: str = _text(_functions.version())
commit: str = _text(_functions.commit())

__all__ = ["Answer", "BrecciaError", "Device", "DeviceError", "END_STAGE", "FileError", "Frame", "InputError", "Interrupted", "Moment",
           "Observer", "PhysicsStopped", "Price", "Problem", "Results", "Run", "STOP", "Scene", "SceneError", "Sweep", "commit",
           "devices", "new", "study", "sweep"]
