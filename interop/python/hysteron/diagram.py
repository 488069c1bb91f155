"""Diagrams: loaded from files, changed as values, asked what they do and how far they are from what was measured."""

from __future__ import annotations

import base64
import html
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

from . import _library as library
from .recording import Recording
from .results import Comparison, Discovery, Fit, Parameter, Result, Run, carry_out
from .stepper import Stepper, stepper_of

Value = Union[str, float]
Data = Union[str, "os.PathLike[str]", Recording]
Time = Union[str, float]


@dataclass(frozen=True)
class Signal:
    """An input or an output of a diagram, or a signal inside of it."""

    name: str
    unit: str


def _time(value: Time) -> str:
    return value if isinstance(value, str) else f"{float(value)!r} s"


def _words(option: str, values: Iterable[object]) -> list[str]:
    return [word for value in values for word in (option, str(value))]


class Diagram:
    """A diagram file with the numbers and choices that were set: a value, which set() and choose() leave as it is."""

    def __init__(
        self,
        path: Union[str, "os.PathLike[str]"],
        numbers: Mapping[str, Value],
        choices: Mapping[str, str],
        allow: Sequence[str],
        keep: object = None,
    ) -> None:
        self.path = os.fspath(path)
        self._numbers = dict(numbers)
        self._choices = dict(choices)
        self._allow = list(allow)
        self._keep = keep  # a folder that has to live as long as the diagram
        overrides = json.dumps({"set": self._numbers, "choose": self._choices, "allow": self._allow})
        self._handle = library.made(library.lib.hy_load, library.encoded(self.path), overrides.encode())
        self._facts: dict[str, Any] = json.loads(library.lib.hy_diagram_json(self._handle.pointer))
        self._signals = {signal["name"]: number for number, signal in enumerate(self._facts["signals"])}
        self._signals.update({output["name"]: output["signal"] for output in self._facts["outputs"]})

    # ---- what it is

    @property
    def title(self) -> str:
        return str(self._facts["title"])

    @property
    def inputs(self) -> list[Signal]:
        return [Signal(i["name"], i["unit"]) for i in self._facts["inputs"]]

    @property
    def outputs(self) -> list[Signal]:
        return [Signal(o["name"], o["unit"]) for o in self._facts["outputs"]]

    @property
    def signals(self) -> list[Signal]:
        return [Signal(s["name"], s["unit"]) for s in self._facts["signals"]]

    @property
    def parameters(self) -> dict[str, Parameter]:
        """By name; values in their units."""
        return {p["name"]: Parameter(p["name"], p["value"], p["unit"]) for p in self._facts["parameters"]}

    @property
    def warnings(self) -> list[str]:
        return list(self._facts["warnings"])

    def signal_number(self, name: str) -> int:
        if name not in self._signals:
            raise KeyError(f"the diagram has no signal {name!r}; it has {', '.join(self._signals)}")
        return self._signals[name]

    def __repr__(self) -> str:
        changes = ", ".join(f"{k}={v}" for k, v in {**self._numbers, **self._choices}.items())
        return f"<hysteron.Diagram {self.path!r}{', ' if changes else ''}{changes}>"

    def _repr_html_(self) -> str:
        place = library.TemporaryFolder()
        file = os.path.join(place.name, "picture.svg")
        self.verb("draw", folder=file)
        picture = base64.b64encode(Path(file).read_bytes()).decode()
        return f'<img alt="{html.escape(self.title)}" src="data:image/svg+xml;base64,{picture}">'

    # ---- changes

    def set(self, names: Optional[Mapping[str, Value]] = None, **numbers: Value) -> Diagram:
        """d.set(kp="0.5 V/um"), d.set({"controller.kp": "0.5 V/um"}): a diagram with these numbers."""
        changed = {**self._numbers, **(names or {}), **numbers}
        return Diagram(self.path, changed, self._choices, self._allow, self._keep)

    def choose(self, names: Optional[Mapping[str, str]] = None, **choices: str) -> Diagram:
        """d.choose(compensator="none"): a diagram in which this is chosen."""
        changed = {**self._choices, **(names or {}), **choices}
        return Diagram(self.path, self._numbers, changed, self._allow, self._keep)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the diagram with all that was set; relative paths in it stay right."""
        library.done(library.lib.hy_diagram_save, self._handle.pointer, library.encoded(path))

    # ---- what it does

    def _overrides(self) -> list[str]:
        return (
            _words("--set", (f"{name}={value}" for name, value in self._numbers.items()))
            + _words("--choose", (f"{name}={value}" for name, value in self._choices.items()))
            + _words("--allow", self._allow)
        )

    def _carry_out(
        self, name: str, data: Optional[Data], words: Sequence[str], folder: object, progress: library.Progress
    ) -> dict[str, Any]:
        """What a Result is made of."""
        all_words = [self.path, *words]
        allow: list[str] = []
        if isinstance(data, Recording):
            all_words += ["--data", data.path]
            allow = ["--allow", str(Path(data.path).parent)]
        elif data is not None:
            all_words += ["--data", os.fspath(data)]
        if folder is not None:
            all_words += ["-o", str(folder)]
        return carry_out(name, [*all_words, *self._overrides(), *allow], progress)

    def run(
        self,
        until: Optional[Time] = None,
        every: Optional[Time] = None,
        *,
        data: Optional[Data] = None,
        folder: Optional[str] = None,
        progress: library.Progress = False,
    ) -> Run:
        """Simulates it; with `data` along the inputs of recordings. `folder`: where results are written, too."""
        words = [] if until is None else ["--until", _time(until)]
        words += [] if every is None else ["--every", _time(every)]
        return Run(**self._carry_out("run", data, words, folder, progress))

    def compare(
        self,
        data: Data,
        tolerance: Union[str, Sequence[str]] = (),
        *,
        folder: Optional[str] = None,
        progress: library.Progress = False,
    ) -> Comparison:
        """How far it is from what was measured, and where."""
        words = _words("--tolerance", [tolerance] if isinstance(tolerance, str) else tolerance)
        return Comparison(**self._carry_out("compare", data, words, folder, progress))

    def fit(
        self,
        data: Data,
        free: Sequence[str] = (),
        *words: str,
        folder: Optional[str] = None,
        progress: library.Progress = False,
    ) -> Fit:
        """Finds the parameters that are free, and these. `words`: further options of `hysteron fit`."""
        place = _Place(folder)
        made = self._carry_out("fit", data, [*_words("--free", free), *words], place.path, progress)
        return Fit(**made, final=place.diagram("fitted.json", self))

    def discover(
        self, data: Data, *words: str, folder: Optional[str] = None, progress: library.Progress = False
    ) -> Discovery:
        """Finds the physical effects that it lacks. `words`: further options of `hysteron discover`."""
        place = _Place(folder)
        made = self._carry_out("discover", data, words, place.path, progress)
        return Discovery(**made, final=place.diagram("final.json", self))

    def verb(
        self,
        name: str,
        *words: str,
        data: Optional[Data] = None,
        folder: Optional[str] = None,
        progress: library.Progress = False,
    ) -> Result:
        """Any other verb of the program on this diagram, `folder` being its -o: d.verb("linearize", "--from", "u", "--to", "y")."""
        return Result(**self._carry_out(name, data, words, folder, progress))

    def stepper(self, until: Optional[Time] = None) -> Stepper:
        """Takes it along step by step; `until`: how long that is going to last, roughly."""
        return stepper_of(self, self._handle, None if until is None else _time(until))


class _Place:
    """A folder of results: the one that was asked for, or one that lives as long as what was found in it."""

    def __init__(self, folder: Optional[str]) -> None:
        self._temporary = None if folder is not None else library.TemporaryFolder()
        self.path = folder if self._temporary is None else os.path.join(self._temporary.name, "results")

    def diagram(self, name: str, origin: Diagram) -> Diagram:
        allow = [*origin._allow, str(Path(origin.path).resolve().parent)]
        return Diagram(os.path.join(str(self.path), name), {}, {}, allow, self)


def load(path: Union[str, "os.PathLike[str]", Mapping[str, Any]], *, allow: Sequence[str] = ()) -> Diagram:
    """Reads and checks a diagram: a file, or what would stand in one as a dict. `allow`: folders beside that of the
    diagram from which it may read, as --allow."""
    if not isinstance(path, Mapping):
        return Diagram(path, {}, {}, allow)
    folder = library.TemporaryFolder()
    file = os.path.join(folder.name, "diagram.json")
    Path(file).write_text(json.dumps(path), encoding="utf-8")
    return Diagram(file, {}, {}, allow, folder)
