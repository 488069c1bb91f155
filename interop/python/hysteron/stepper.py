"""A diagram that is taken along step by step: inputs are set, time is advanced, signals are read."""

from __future__ import annotations

import ctypes
import json
from typing import TYPE_CHECKING

from . import _library as library

if TYPE_CHECKING:
    from .diagram import Diagram


class Stepper:
    """The state is a value: copy() goes on by itself. Inputs and signals are in the units of the diagram."""

    def __init__(self, diagram: Diagram, handle: library.Handle) -> None:
        self._diagram = diagram
        self._handle = handle
        self._watch = library.SteppedWatch(handle)

    @property
    def t(self) -> float:
        """[s]"""
        time: float = library.lib.hy_stepper_time(self._handle.pointer)
        return time

    def set(self, **inputs: float) -> Stepper:
        """From now on; an input that is not set stays as it is, zero at first."""
        names = [signal.name for signal in self._diagram.inputs]
        for name, value in inputs.items():
            if name not in names:
                raise KeyError(f"the diagram has no input {name!r}; it has {', '.join(names) or 'none'}")
            library.done(library.lib.hy_stepper_set, self._handle.pointer, names.index(name), float(value))
        return self

    def advance(self, until: float) -> Stepper:
        """Goes on to `until` [s]. Ctrl-C ends it with Interrupted; it stands at `t` then, and may go on."""
        self._watch.advance(float(until))
        return self

    def __getitem__(self, signal: str) -> float:
        value = ctypes.c_double()
        place = self._diagram.signal_number(signal)
        library.done(library.lib.hy_stepper_get, self._handle.pointer, place, ctypes.byref(value))
        return value.value

    def copy(self) -> Stepper:
        return Stepper(self._diagram, library.made(library.lib.hy_stepper_copy, self._handle.pointer))

    __copy__ = copy

    def __repr__(self) -> str:
        return f"<hysteron.Stepper of {self._diagram.title!r} at {self.t:g} s>"


def stepper_of(diagram: Diagram, handle: library.Handle, until: object) -> Stepper:
    options = json.dumps({"until": until}).encode() if until is not None else None
    return Stepper(diagram, library.made(library.lib.hy_stepper_new, handle.pointer, options))
