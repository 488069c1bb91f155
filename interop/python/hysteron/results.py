"""What verbs find: facts as values, traces as arrays without a copy, figures for notebooks."""

from __future__ import annotations

import base64
import ctypes
import html
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library as library

if TYPE_CHECKING:
    from .diagram import Diagram


@dataclass(frozen=True)
class Parameter:
    """A number of a diagram; of a fit with its 95 % interval. None: the data do not determine it."""

    name: str
    value: Optional[float]
    unit: str
    low95: Optional[float] = None
    high95: Optional[float] = None
    start: Optional[float] = None
    determined: bool = True
    at_bound: bool = False


@dataclass(frozen=True)
class Metric:
    """How far an output is from what was measured, in one recording or in "all" of a role."""

    output: str
    recording: str
    role: str
    unit: str
    rms: float
    peak: float
    nrmse: float
    rows: int


@dataclass(frozen=True)
class Span:
    """A part of the samples that holds a share of the squared error: a recording, a range of level, a rate ..."""

    output: str
    by: str
    label: str
    share_of_error: float
    share_of_rows: float
    sentence: str
    seconds: dict[str, list[tuple[float, float]]] = field(default_factory=dict)  # by recording


@dataclass(frozen=True)
class FoundStep:
    """One effect that was found and put into the diagram."""

    effect: str
    place: str
    block: str
    sentence: str
    ties: list[str]
    facts: dict[str, Any]


class Result:
    """The answer of a verb. `facts` is what its result.json says."""

    def __init__(self, handle: library.Handle, answer: dict[str, Any]) -> None:
        self._handle = handle
        self.answer = answer
        self.exit_code: int = answer["exit_code"]
        self.headline: str = answer.get("headline", "")
        self.sentences: list[str] = answer.get("sentences", [])
        self.warnings: list[str] = answer.get("warnings", [])
        self.files: list[str] = answer.get("files", [])
        self.text: str = answer.get("text", "")
        self.facts: dict[str, Any] = answer.get("facts") or {}
        self.traces = {trace["file"]: Trace(handle, trace) for trace in answer.get("traces", [])}

    def figures(self) -> list[str]:
        """The figures of the first screen, as SVG."""
        found = []
        for number in range(self.answer.get("figures", 0)):
            text = library.lib.hy_result_figure(self._handle.pointer, number)
            if text is not None:
                found.append(text.decode())
        return found

    def __str__(self) -> str:
        return "\n  ".join([self.headline or self.text, *self.sentences, *(f"note: {w}" for w in self.warnings)])

    def __repr__(self) -> str:
        return f"<hysteron.{type(self).__name__}: {self.headline or self.answer['verb']}>"

    def _repr_html_(self) -> str:
        head = f"<p><b>{html.escape(self.headline)}</b></p>" if self.headline else ""
        text = f"<pre>{html.escape(self.text)}</pre>" if self.text else ""
        items = "".join(f"<li>{html.escape(s)}</li>" for s in [*self.sentences, *self.warnings])
        # As images, so that the style of one figure is not that of another.
        pictures = "".join(
            f'<img alt="figure" src="data:image/svg+xml;base64,{base64.b64encode(f.encode()).decode()}">'
            for f in self.figures()
        )
        return f"<div>{head}{text}{f'<ul>{items}</ul>' if items else ''}{pictures}</div>"


class Trace:
    """One table of a result: columns by name, in their units, read-only and without a copy."""

    def __init__(self, handle: library.Handle, told: dict[str, Any]) -> None:
        self._handle = handle
        self.file: str = told["file"]
        self.rows: int = told["rows"]
        self.units: dict[str, str] = {column["name"]: column["unit"] for column in told["columns"]}

    @property
    def columns(self) -> list[str]:
        return list(self.units)

    @property
    def t(self) -> NDArray[np.float64]:
        """[s]"""
        return self["t"]

    def unit(self, column: str) -> str:
        self._need(column)
        return self.units[column]

    def _need(self, column: str) -> None:
        if column not in self.units:
            raise KeyError(f"there is no column {column!r}; there are {', '.join(self.units)}")

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        self._need(column)
        numbers = ctypes.c_void_p()
        rows = library.lib.hy_result_column(
            self._handle.pointer, self.file.encode(), column.encode(), ctypes.byref(numbers)
        )
        if not numbers.value:
            return np.empty(0)
        memory = (ctypes.c_double * rows).from_address(numbers.value)
        setattr(memory, "_owner", self._handle)  # lives as long as an array looks at it
        array = np.ctypeslib.as_array(memory)
        array.flags.writeable = False
        return array

    def to_pandas(self) -> Any:
        """A pandas.DataFrame over t, with units in its attrs."""
        import pandas

        frame = pandas.DataFrame({name: self[name] for name in self.columns if name != "t"})
        frame.index = pandas.Index(self.t, name="t")
        frame.attrs["units"] = dict(self.units)
        return frame

    def plot(self, *columns: str) -> Any:
        """A matplotlib.figure.Figure of these columns (all of them), one axis for each unit."""
        from matplotlib.figure import Figure

        names = list(columns) or [name for name in self.columns if name != "t"]
        units = list(dict.fromkeys(self.unit(name) for name in names))
        figure = Figure(figsize=(8, 2.5 * max(1, len(units))), layout="constrained")
        for axis, unit in zip(np.ravel(figure.subplots(len(units), sharex=True)), units):
            for name in names:
                if self.units[name] == unit:
                    axis.plot(self.t, self[name], label=name)
            axis.set_ylabel(f"[{unit or '1'}]")
            axis.legend()
        figure.axes[-1].set_xlabel("t [s]")
        return figure


class Run(Result):
    """Traces of a simulation. With one trace its columns are those of the run: r["stage"], r.t."""

    @property
    def trace(self) -> Trace:
        if len(self.traces) != 1:
            raise KeyError(f"there is a trace for each recording: r.traces[...] of {', '.join(self.traces)}")
        return next(iter(self.traces.values()))

    @property
    def t(self) -> NDArray[np.float64]:
        """[s]"""
        return self.trace.t

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        return self.trace[column]

    def unit(self, column: str) -> str:
        return self.trace.unit(column)

    def to_pandas(self) -> Any:
        return self.trace.to_pandas()

    def plot(self, *columns: str) -> Any:
        return self.trace.plot(*columns)


def _metrics(list_of: Sequence[dict[str, Any]]) -> list[Metric]:
    names = Metric.__dataclass_fields__
    return [Metric(**{name: m[name] for name in names}) for m in list_of]


def _judged(metrics: Sequence[Metric]) -> dict[str, Metric]:
    """By output: of the validate recordings together, where there are none of those that train."""
    found: dict[str, Metric] = {}
    for role in ("all", "train", "validate"):  # the last one counts
        found.update({m.output: m for m in metrics if m.recording == "all" and m.role == role})
    for m in metrics:  # a single recording has no "all"
        found.setdefault(m.output, m)
    return found


class Comparison(Result):
    """How far a model is from what was measured. nrmse and rms are by output, of the validate recordings together; where
    there are none of those that train."""

    def __init__(self, handle: library.Handle, answer: dict[str, Any]) -> None:
        super().__init__(handle, answer)
        self.metrics = _metrics(self.facts.get("metrics", []))
        judged = _judged(self.metrics)
        self.nrmse = {output: m.nrmse for output, m in judged.items()}
        self.rms = {output: m.rms for output, m in judged.items()}
        self.spans = _spans(self.facts.get("splits", []))

    @property
    def within_tolerance(self) -> bool:
        """Of each tolerance that was asked for."""
        return self.exit_code == 0


def _spans(splits: Sequence[dict[str, Any]]) -> list[Span]:
    """Where the error lies, those that hold most of it first."""
    spans = []
    for split in splits:
        for part in split["parts"]:
            seconds = {s["recording"]: [(a, b) for a, b in s["seconds"]] for s in part.get("spans", [])}
            shares = part["share_of_squared_error"], part["share_of_rows"]
            spans.append(
                Span(split["output"], split["by"], part["label"], *shares, split.get("sentence", ""), seconds)
            )
    return sorted(spans, key=lambda span: -span.share_of_error)


class Fit(Result):
    """Parameters with their uncertainty; `final` is the diagram with them."""

    def __init__(self, handle: library.Handle, answer: dict[str, Any], final: Diagram) -> None:
        super().__init__(handle, answer)
        self.final = final
        self.parameters = {
            p["parameter"]: Parameter(
                p["parameter"],
                p.get("value"),
                p["unit"],
                p.get("low95"),
                p.get("high95"),
                p.get("start"),
                p["determined"],
                p["at_bound"],
            )
            for p in self.facts["parameters"]
        }
        self.before = _metrics(self.facts.get("before", []))
        self.after = _metrics(self.facts.get("after", []))


class Discovery(Result):
    """Effects that a model lacked; `final` is the diagram with them."""

    def __init__(self, handle: library.Handle, answer: dict[str, Any], final: Diagram) -> None:
        super().__init__(handle, answer)
        self.final = final
        self.verdict: str = answer["verdict"]
        self.steps = [
            FoundStep(
                s["effect"], s["place"], s["block"], s["sentence"], [tie["effect"] for tie in s.get("ties", [])], s
            )
            for s in self.facts.get("steps", [])
        ]
        self.effects = [step.effect for step in self.steps]


def carry_out(name: str, words: Sequence[str], progress: library.Progress) -> dict[str, Any]:
    """What a Result is made of: a handle, and what it says of itself."""
    try:
        handle = library.carried_out(name, words, progress)
    except library.Interrupted as stop:
        if isinstance(stop.result, library.Handle):
            stop.result = Result(**_answered(stop.result))
        raise
    return _answered(handle)


def _answered(handle: library.Handle) -> dict[str, Any]:
    return {"handle": handle, "answer": json.loads(library.lib.hy_result_json(handle.pointer))}


def verb(name: str, *words: str, progress: library.Progress = False) -> Result:
    """Any verb of the program with the words behind it: hy.verb("effects"), hy.verb("new", "--from", "lab.csv", ...)."""
    return Result(**carry_out(name, words, progress))
