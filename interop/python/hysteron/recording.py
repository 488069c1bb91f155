"""Arrays as a data set: what the lab measured, without a file of one's own."""

from __future__ import annotations

import ctypes
import os
from typing import Any, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library as library

Column = Union[ArrayLike, Tuple[ArrayLike, str]]


def _column(name: str, given: Any) -> tuple[NDArray[np.float64], str]:
    values, unit = given if isinstance(given, tuple) and len(given) == 2 and isinstance(given[1], str) else (given, "")
    numbers = np.ascontiguousarray(values, dtype=np.float64)
    if numbers.ndim != 1:
        raise ValueError(f"{name} has the shape {numbers.shape}: give one number for each time")
    return numbers, unit


class Recording:
    """hy.Recording(t=t, u=(u, "V"), y=(y, "um")): columns under the names of the diagram's inputs and outputs.

    t is in s, or in what is written behind it: t=(t, "ms"). A column without a unit is of plain numbers. The numbers
    are copied when it is made, and kept in a file that lives as long as the recording.
    """

    def __init__(self, t: Column, **columns: Column) -> None:
        times, unit = _column("t", t)
        self.columns = {"t": (times, unit or "s")}
        for name, given in columns.items():
            self.columns[name] = _column(name, given)
        for name, (values, _) in self.columns.items():
            if len(values) != len(times):
                raise ValueError(f"{name} has {len(values)} values for {len(times)} times")
        self._folder = library.TemporaryFolder()
        self.path = os.path.join(self._folder.name, "recording.f64")
        self.save(self.path)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the columns: text where the path ends with .csv, numbers as memory holds them where with .f64."""
        count = len(self.columns)
        names = (ctypes.c_char_p * count)(*[name.encode() for name in self.columns])
        units = (ctypes.c_char_p * count)(*[unit.encode() for _, unit in self.columns.values()])
        values = (ctypes.c_void_p * count)(*[numbers.ctypes.data for numbers, _ in self.columns.values()])
        rows = len(self.columns["t"][0])
        library.done(library.lib.hy_write_table, library.encoded(path), count, names, units, values, rows)

    def __repr__(self) -> str:
        columns = ", ".join(f"{name} [{unit}]" if unit else name for name, (_, unit) in self.columns.items())
        return f"<hysteron.Recording of {len(self.columns['t'][0])} rows: {columns}>"
