"""The package hysteron: arrays without a copy, errors, Ctrl-C, recordings, the wheel, its types."""

import ctypes
import gc
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile
from pathlib import Path

import numpy as np

import hysteron as hy
from hysteron import _library

ROOT = Path(__file__).resolve().parents[3]
STAGE = ROOT / "tests" / "interop" / "stage.json"
DRIVEN = ROOT / "tests" / "interop" / "driven.json"


def memory() -> int:
    """[bytes] of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")


class Arrays(unittest.TestCase):
    def test_a_million_rows_are_not_copied(self) -> None:
        run = hy.load(STAGE).run(every="1 us")
        y = run["y"]
        self.assertEqual(y.shape, (1_000_001,))
        numbers = ctypes.c_void_p()
        rows = _library.lib.hy_result_column(run._handle.pointer, b"signals.csv", b"y", ctypes.byref(numbers))
        self.assertEqual(rows, len(y))
        self.assertEqual(y.ctypes.data, numbers.value)  # the memory of the library itself
        self.assertFalse(y.flags.owndata)
        with self.assertRaises(ValueError):
            y[0] = 1
        before = memory()
        many = [run["y"] for _ in range(100)]
        self.assertLess(memory() - before, 8_000_000)  # one copy would be 8 MB
        self.assertTrue(all(np.shares_memory(y, other) for other in many))

    def test_an_array_outlives_its_result(self) -> None:
        run = hy.load(STAGE).run()
        y, expected = run["y"], run["y"].copy()
        del run
        gc.collect()
        hy.load(STAGE).set({"gain.gain": 2}).run()  # would take the memory
        np.testing.assert_array_equal(y, expected)

    def test_values_are_in_the_unit_that_is_told(self) -> None:
        t = np.arange(1000.0)
        recording = hy.Recording(t=(t, "ms"), u=(t, "mV"), y=(np.zeros(1000), "um"))
        run = hy.load(DRIVEN).run(data=recording)
        self.assertEqual(run.unit("y"), "um")
        # a ramp of 1 V/s on 1 um/V behind a lag of 20 ms; the diagram asks for 1e-9
        np.testing.assert_allclose(run["y"], run.t - 0.02 * (1 - np.exp(-run.t / 0.02)), atol=1e-7)


class Errors(unittest.TestCase):
    def test_they_are_told_with_place_and_cure(self) -> None:
        with self.assertRaises(hy.Error) as caught:
            hy.load("nothing.json")
        self.assertEqual(caught.exception.code, 2)
        problem = caught.exception.problems[0]
        self.assertIn("nothing.json", problem.path + problem.file)
        self.assertTrue(problem.cure)
        with self.assertRaises(hy.Error):
            hy.load(STAGE).run(until="-1 s")
        with self.assertRaises(KeyError):
            hy.load(STAGE).run()["nothing"]
        with self.assertRaises(KeyError):
            hy.load(DRIVEN).stepper().set(v=1)
        with self.assertRaises(ValueError):
            hy.Recording(t=[0, 1, 2], u=[1, 2])
        with self.assertRaises(ValueError):
            hy.Recording(t=[0, 1], u=[[1, 2], [3, 4]])

    def test_a_number_of_recordings_is_no_single_trace(self) -> None:
        run = hy.verb("effects")
        self.assertEqual(run.traces, {})

    def test_what_progress_raises_ends_the_work(self) -> None:
        class Enough(Exception):
            pass

        def progress(fraction: float, what: str) -> None:
            raise Enough

        with self.assertRaises(Enough):
            hy.load(STAGE).run(until="10000 s", every="1 ms", progress=progress)


class Interrupting(unittest.TestCase):
    def setUp(self) -> None:
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts what stands behind & without

    def test_ctrl_c_ends_the_work(self) -> None:
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt) as caught:
            hy.load(STAGE).run(until="1e6 s", every="100 s")  # of hours
        timer.join()
        self.assertIsInstance(caught.exception, hy.Interrupted)
        self.assertEqual(hy.load(STAGE).run().exit_code, 0)  # and the next one works

    def test_ctrl_c_ends_an_advance_which_may_go_on(self) -> None:
        s = hy.load(STAGE).stepper(until="1e6 s")
        handler = signal.getsignal(signal.SIGINT)
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(hy.Interrupted):
            s.advance(1e6)  # of hours
        timer.join()
        self.assertIs(signal.getsignal(signal.SIGINT), handler)
        self.assertGreater(s.t, 0)
        self.assertLess(s.t, 1e6)
        until = s.t + 1
        self.assertEqual(s.advance(until).t, until)

    def test_what_was_found_before_ctrl_c_is_kept(self) -> None:
        demo = ROOT / "diagrams" / "discover" / "demo"

        def progress(fraction: float, what: str) -> None:
            # Something is found. Single messages may be left out, so whichever of these is told first counts.
            if what.startswith(("intervals of", "step 2:", "what is left")):
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(hy.Interrupted) as caught:
            hy.load(demo / "stage.json").verb("discover", data=demo / "dataset.json", progress=progress)
        self.assertIsNotNone(caught.exception.result)

    def test_what_a_handler_of_signals_raises_comes_through(self) -> None:
        class Enough(Exception):
            pass

        def handler(number: int, frame: object) -> None:
            raise Enough

        before = signal.signal(signal.SIGINT, handler)
        try:
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(Enough):
                hy.load(STAGE).stepper(until="1e6 s").advance(1e6)
            timer.join()
        finally:
            signal.signal(signal.SIGINT, before)

    def test_others_go_on_meanwhile(self) -> None:
        counted = 0
        done = threading.Event()

        def count() -> None:
            nonlocal counted
            while not done.is_set():
                counted += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        hy.load(STAGE).run(every="0.5 us")
        done.set()
        thread.join()
        self.assertGreater(counted, 10)  # the interpreter was free


class Values(unittest.TestCase):
    def test_a_diagram_is_a_value(self) -> None:
        one = hy.load(STAGE)
        two = one.set({"gain.gain": 2})
        self.assertEqual(one.parameters["gain.gain"].value, 1)
        self.assertEqual(two.parameters["gain.gain"].value, 2)
        self.assertGreater(np.ptp(two.run()["y"]), np.ptp(one.run()["y"]))

    def test_a_dict_is_a_diagram(self) -> None:
        d = hy.load({"format": 1, "blocks": {"a": {"type": "constant", "value": "2 V"}}, "record": ["a"]})
        self.assertEqual(d.run(until=1)["a"][-1], 2)

    def test_a_copy_of_a_stepper_goes_on_by_itself(self) -> None:
        d = hy.load(STAGE)
        s = d.stepper(until="1 s").advance(0.3)
        c = s.copy()
        s.advance(0.6)
        self.assertEqual((c.t, s.t), (0.3, 0.6))
        c.advance(0.6)
        self.assertAlmostEqual(c["y"], s["y"], places=5)
        row = d.run(every="0.1 s")
        self.assertAlmostEqual(s["y"], row["y"][6], places=5)

    def test_results_show_themselves(self) -> None:
        run = hy.load(STAGE).run()
        self.assertIn("<img", run._repr_html_())
        self.assertIn("simulated 1 s", str(run))
        self.assertTrue(all(figure.lstrip().startswith("<") for figure in run.figures()))
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                self.assertIn("<img", hy.load(STAGE)._repr_html_())
                self.assertEqual(os.listdir("."), [])  # looking at a diagram leaves nothing behind
            finally:
                os.chdir(before)


class Others(unittest.TestCase):
    def test_a_figure_of_matplotlib(self) -> None:
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("matplotlib is not there")
        run = hy.load(DRIVEN).run(data=hy.Recording(t=np.arange(1000.0), u=(np.ones(1000), "V"), y=(np.zeros(1000), "um")))
        figure = run.plot()
        self.assertEqual(len(figure.axes), len(set(run.trace.units.values())) - 1)  # one for each unit but that of t
        line = figure.axes[-1].get_lines()[0]
        np.testing.assert_array_equal(line.get_xdata(), run.t)
        self.assertEqual(len(hy.load(STAGE).run().plot("y").axes[0].get_lines()), 1)

    def test_a_table_of_pandas(self) -> None:
        if importlib.util.find_spec("pandas") is None:
            self.skipTest("pandas is not there")
        run = hy.load(STAGE).run()
        frame = run.to_pandas()
        self.assertEqual(list(frame.columns), ["drive", "y"])
        self.assertEqual(frame.attrs["units"]["y"], "V")
        np.testing.assert_array_equal(frame["y"].to_numpy(), run["y"])


class Distribution(unittest.TestCase):
    def test_the_wheel_is_built_and_works_without_a_network(self) -> None:
        pip = [sys.executable, "-m", "pip"]
        if subprocess.run([*pip, "--version"], capture_output=True).returncode != 0:
            self.skipTest("pip is not there")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [*pip, "install", "--quiet", "--no-index", "--no-deps", "--target", folder, str(ROOT / "interop/python")],
                check=True,
                env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_ROOT_USER_ACTION": "ignore"},
            )
            env = {k: v for k, v in os.environ.items() if k != "HYSTERON_LIBRARY"}
            code = "import hysteron, hysteron._library as l; print(hysteron.__version__, l.lib._name)"
            told = subprocess.run(
                [sys.executable, "-c", code], check=True, capture_output=True, text=True, env={**env, "PYTHONPATH": folder}
            ).stdout.split()
            self.assertEqual(told[0], hy.__version__)
            self.assertTrue(told[1].startswith(folder), told)
            # An FMU: what it runs lies in the wheel, and nothing beside the wheel is looked at.
            code = f"import hysteron; hysteron.verb('export', 'fmu', {str(DRIVEN)!r}, '-o', 'driven.fmu')"
            subprocess.run([sys.executable, "-c", code], check=True, cwd=folder, env={**env, "PYTHONPATH": folder})
            with zipfile.ZipFile(Path(folder) / "driven.fmu") as fmu:
                binary = fmu.read("binaries/linux64/driven.so")
            self.assertEqual(binary, (Path(folder) / "hysteron" / "libhysteron_fmu.so").read_bytes())
            (wheel,) = Path(folder).glob("*.dist-info/WHEEL")
            self.assertIn("Tag: py3-none-linux_", wheel.read_text())

    def test_types_hold(self) -> None:
        mypy = [sys.executable, "-m", "mypy"]
        if subprocess.run([*mypy, "--version"], capture_output=True).returncode != 0:
            self.skipTest("mypy is not there")
        with tempfile.TemporaryDirectory() as cache:
            done = subprocess.run(
                [*mypy, "--strict", "--cache-dir", cache, "hysteron", "build_backend/wheel_of_library.py"],
                cwd=ROOT / "interop/python",
                capture_output=True,
                text=True,
            )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
