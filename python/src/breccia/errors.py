"""What can go wrong."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, List, Optional

if TYPE_CHECKING:
    from .results import Results


@dataclass(frozen=True)
class Problem:
    """An error or warning of a scene."""

    is_warning: bool
    file: str
    line: int  #: from 1; 0: no place in the file
    column: int
    set: str  #: the override it is in; "": none
    message: str  #: what was found, what is expected, the cure
    cure: str  #: the last part of the message
    source: str = ""  #: of scenes from dicts: the line

    def __str__(self) -> str:
        place = f"in '{self.set}': " if self.set else f"{self.file}:{self.line}:{self.column}: " if self.line else ""
        return place + self.message + (f"\n    {self.source}" if self.source else "")


class BrecciaError(Exception):
    """Base of all below but :class:`Interrupted`."""


class SceneError(BrecciaError, ValueError):
    """A scene with errors: ``problems`` has all of them."""

    def __init__(self, problems: List[Problem]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = problems


class InputError(BrecciaError, ValueError):
    """An option, a set, a load... that cannot be, or a call out of place."""


class PhysicsStopped(BrecciaError, ArithmeticError):
    """A value that is not finite, or energy that runs away."""


class DeviceError(BrecciaError, RuntimeError):
    """Device trouble."""


class FileError(BrecciaError, OSError):
    """A file that cannot be read or written."""


class Interrupted(KeyboardInterrupt):
    """A run that was asked to stop. ``results``: what was done until then; None where nothing was written."""

    results: Optional["Results"] = None


_ERRORS = {1: PhysicsStopped, 2: InputError, 3: MemoryError, 4: DeviceError, 5: FileError, 6: Interrupted}


def error_of(status: int, message: str) -> BaseException:
    return _ERRORS.get(status, BrecciaError)(message)
