"""hysteron: block diagrams of actuators; simulate, compare with recordings, find what is missing.

    import hysteron as hy
    d = hy.load("stage.json").set(kp="0.5 V/um")
    r = d.run(until="1 s", every="0.1 ms")
    r["stage"], r.unit("stage"), r.t
"""

from ._library import Error, Interrupted, Problem, version
from .diagram import Diagram, Signal, load
from .recording import Recording
from .results import (
    Comparison,
    Discovery,
    Fit,
    FoundStep,
    Metric,
    Parameter,
    Result,
    Run,
    Span,
    Trace,
    verb,
)
from .stepper import Stepper

__version__ = version()
__all__ = [
    "Comparison",
    "Diagram",
    "Discovery",
    "Error",
    "Fit",
    "FoundStep",
    "Interrupted",
    "Metric",
    "Parameter",
    "Problem",
    "Recording",
    "Result",
    "Run",
    "Signal",
    "Span",
    "Stepper",
    "Trace",
    "load",
    "verb",
]
