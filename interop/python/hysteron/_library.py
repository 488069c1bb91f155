"""libhysteron.so as Python sees it: functions, handles that free themselves, errors as exceptions, Ctrl-C.

Pure ctypes, so one wheel serves every Python, and the lock of the interpreter is free while the library works.
"""

from __future__ import annotations

import ctypes
import json
import os
import shutil
import signal
import sys
import tempfile
import threading
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Optional, Sequence, Union

_SONAME = "libhysteron.so.0"
Progress = Union[bool, Callable[[float, str], None]]
_WATCH = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double, ctypes.c_char_p)


def _load() -> ctypes.CDLL:
    asked = os.environ.get("HYSTERON_LIBRARY")
    inside = Path(__file__).parent / _SONAME  # of a wheel
    path = asked or (str(inside) if inside.exists() else _SONAME)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"{error}; install the wheel (pip install interop/python), or say where the library is: "
            "HYSTERON_LIBRARY=/path/libhysteron.so"
        ) from None


def _declare(library: ctypes.CDLL) -> None:
    text, handle, number, whole = ctypes.c_char_p, ctypes.c_void_p, ctypes.c_double, ctypes.c_int
    texts, error = ctypes.POINTER(ctypes.c_char_p), ctypes.POINTER(ctypes.c_void_p)
    numbers = ctypes.POINTER(ctypes.c_void_p)
    for name, result, arguments in (
        ("hy_version", text, []),
        ("hy_free", None, [handle]),
        ("hy_error_json", text, [handle]),
        ("hy_error_code", whole, [handle]),
        ("hy_load", handle, [text, text, error]),
        ("hy_diagram_json", text, [handle]),
        ("hy_diagram_save", whole, [handle, text, error]),
        ("hy_verb", handle, [text, whole, texts, _WATCH, handle, error]),
        ("hy_result_json", text, [handle]),
        ("hy_result_column", ctypes.c_int64, [handle, text, text, numbers]),
        ("hy_result_figure", text, [handle, whole]),
        ("hy_write_table", whole, [text, whole, texts, texts, numbers, ctypes.c_int64, error]),
        ("hy_stepper_new", handle, [handle, text, error]),
        ("hy_stepper_set", whole, [handle, whole, number, error]),
        ("hy_stepper_advance", whole, [handle, number, error]),
        ("hy_stepper_watch", None, [handle, _WATCH, handle]),
        ("hy_stepper_get", whole, [handle, whole, ctypes.POINTER(number), error]),
        ("hy_stepper_time", number, [handle]),
        ("hy_stepper_copy", handle, [handle, error]),
    ):
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments


lib = _load()
_declare(lib)


def version() -> str:
    found: bytes = lib.hy_version()
    return found.decode()


@dataclass(frozen=True)
class Problem:
    """What is wrong, where, and what to do about it."""

    code: str
    path: str
    what: str
    cure: str
    file: str = ""
    line: int = 0

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}: {self.path}" if self.file else self.path
        return f"{place}: {self.what}; {self.cure}"


class Error(Exception):
    """The input is wrong, or the numerics failed; `problems` are all that were found."""

    def __init__(self, code: int, problems: Sequence[Problem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.code = code  # the exit code of the program: 2 wrong input, 3 the numerics failed
        self.problems = list(problems)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended the work. `result` is what was found until then, or None."""

    def __init__(self, what: str, result: Any = None) -> None:
        super().__init__(what)
        self.result = result


def raise_error(error: ctypes.c_void_p) -> None:
    """Raises what stands behind an error handle, and frees it."""
    try:
        told = json.loads(lib.hy_error_json(error))
    finally:
        lib.hy_free(error)
    if "interrupted" in told:
        raise Interrupted(told["interrupted"])
    raise Error(told["exit_code"], [Problem(**problem) for problem in told["problems"]])


class Handle:
    """Owns one handle of the library."""

    def __init__(self, pointer: int) -> None:
        self.pointer: Optional[int] = pointer

    def __del__(self) -> None:
        if self.pointer is not None and lib is not None:
            lib.hy_free(self.pointer)
            self.pointer = None


def made(function: Any, *arguments: Any) -> Handle:
    """Calls a function that makes a handle."""
    error = ctypes.c_void_p()
    pointer = function(*arguments, ctypes.byref(error))
    if error:
        raise_error(error)
    return Handle(pointer)


def done(function: Any, *arguments: Any) -> None:
    """Calls a function that returns an exit code."""
    error = ctypes.c_void_p()
    function(*arguments, ctypes.byref(error))
    if error:
        raise_error(error)


def encoded(text: Union[str, "os.PathLike[str]"]) -> bytes:
    return os.fsencode(text)


class TemporaryFolder:
    """Goes away with whoever holds it, without a word."""

    def __init__(self) -> None:
        self.name = tempfile.mkdtemp(prefix="hysteron-")
        self._finalizer = weakref.finalize(self, shutil.rmtree, self.name, ignore_errors=True)


class _Line:
    """The line that shows how far the work is."""

    def __init__(self) -> None:
        self.text = ""

    def __call__(self, fraction: float, what: str) -> None:
        text = f"{100 * fraction:3.0f} % {what}" if fraction >= 0 else what
        if text != self.text:
            sys.stderr.write(f"\r{text}\x1b[K")
            sys.stderr.flush()
        self.text = text


class _Watched:
    """What the library tells and asks while it works."""

    def __init__(self, progress: Progress) -> None:
        self.told = _Line() if progress is True else progress
        self.stop = False
        self.failure: Optional[BaseException] = None
        self.function = _WATCH(self._ask)

    def begin(self) -> None:
        self.stop, self.failure = False, None

    def raise_failure(self) -> None:
        if isinstance(self.failure, KeyboardInterrupt):
            raise Interrupted("interrupted")
        if self.failure is not None:
            raise self.failure

    def _ask(self, _context: Any, fraction: float, what: bytes) -> int:
        try:
            if callable(self.told):
                self.told(fraction, what.decode(errors="replace"))
        except BaseException as failure:  # must not be lost in the library
            self.failure = failure
            self.stop = True
        return int(self.stop)


class SteppedWatch:
    """Lets Ctrl-C reach this thread while a stepper works in it: steps are too short for a thread of their own.

    The handler of Python must not raise in the middle of a call of the library, where the exception would be lost: what
    it raises waits until the library has ended.
    """

    def __init__(self, stepper: Handle) -> None:
        self._watched = _Watched(False)
        self._pointer = stepper.pointer
        lib.hy_stepper_watch(self._pointer, self._watched.function, None)

    def advance(self, until: float) -> None:
        before = signal.getsignal(signal.SIGINT) if threading.current_thread() is threading.main_thread() else None
        if not callable(before):
            return done(lib.hy_stepper_advance, self._pointer, until)
        handler = before
        watched = self._watched
        watched.begin()

        def keep(number: int, frame: Any) -> None:
            try:
                handler(number, frame)
            except BaseException as failure:
                watched.failure = failure
                watched.stop = True

        signal.signal(signal.SIGINT, keep)
        try:
            done(lib.hy_stepper_advance, self._pointer, until)
        except Interrupted:
            pass  # told below, as whatever the handler raised
        finally:
            signal.signal(signal.SIGINT, before)
        watched.raise_failure()


def carried_out(name: str, words: Sequence[str], progress: Progress) -> Handle:
    """Carries out a verb in a thread of its own, so that Ctrl-C reaches this one while the library works."""
    array = (ctypes.c_char_p * max(1, len(words)))(*[encoded(word) for word in words])
    watched = _Watched(progress)
    pointer: list[Optional[int]] = [None]
    error = ctypes.c_void_p()

    finished = threading.Event()  # join() of a thread does not survive Ctrl-C before Python 3.13

    def work() -> None:
        try:
            pointer[0] = lib.hy_verb(name.encode(), len(words), array, watched.function, None, ctypes.byref(error))
        finally:
            finished.set()

    thread = threading.Thread(target=work, name=f"hysteron {name}", daemon=True)
    interrupted = False
    thread.start()
    while not finished.is_set():
        try:
            finished.wait()
        except KeyboardInterrupt:
            watched.stop = interrupted = True
    if progress is True:
        sys.stderr.write("\r\x1b[K")
    result = Handle(pointer[0]) if pointer[0] else None
    if watched.failure is not None:
        if error:
            lib.hy_free(error)
        raise watched.failure
    if error:
        raise_error(error)
    assert result is not None
    if interrupted:
        raise Interrupted("interrupted", result)
    return result
