#!/usr/bin/env python3
"""Tests of the benches made anew: Kutta's order, what each device must show by its equations, and that hysteron reads it.

Exits with 77 (ctest: skipped) where NumPy or SciPy are absent.
usage: make_benches_test.py [the program hysteron]
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
    import scipy.signal  # noqa: F401
except ImportError as missing:
    print("skipped: %s; Debian: apt install python3-scipy" % missing)
    sys.exit(77)

import make_benches

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""


def columns(path):
    with path.open() as file:
        names = file.readline().strip().split(",")
    return dict(zip((n.split()[0] for n in names), np.loadtxt(path, delimiter=",", skiprows=1).T))


class Integration(unittest.TestCase):
    def test_kutta_is_of_fourth_order(self):
        """x' = -x + t from 1: x(1) = 2/e; half the step leaves a sixteenth."""
        def error(n):
            x, h = np.array([1.0]), 1 / n
            for i in range(n):
                x = make_benches.kutta(lambda s, u: -s + u, x, h, i * h, (i + 1) * h)
            return abs(x[0] - 2 / np.e)

        self.assertAlmostEqual(error(10) / error(20), 16, delta=1.5)

    def test_a_multisine_has_the_rms_and_the_lines_it_was_asked_for(self):
        x = make_benches.multisine(1000, 100, 5, 20, 3.0, 7)
        lines = np.abs(np.fft.rfft(x)) > 1e-9
        self.assertAlmostEqual(np.std(x), 3.0, places=12)
        self.assertEqual((np.flatnonzero(lines).min(), np.flatnonzero(lines).max()), (50, 200))


class Devices(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.kept.name)
        for name in ("coupled_drives", "tanks", "wiener_hammerstein"):
            make_benches.BENCHES[name](cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_the_speed_of_the_drives_has_no_sign_and_their_input_has(self):
        d = columns(self.folder / "coupled_drives_1.csv")
        self.assertGreater(d["y"].min(), -0.06)  # six deviations of the noise
        self.assertLess(d["u"].min(), -1)

    def test_what_flows_into_the_tanks_leaves_through_both_outlets(self):
        """In the mean 0.06 u = 0.05 sqrt(h); the level at the end differs from that at the start by some metres in
        4096 s: a thousandth of the flow."""
        d = columns(self.folder / "tanks_1.csv")
        self.assertAlmostEqual(0.05 * np.mean(np.sqrt(d["y"])) / (0.06 * np.mean(d["u"])), 1, delta=0.02)

    def test_the_diode_bends_one_side(self):
        """Levels above 0.3 V come through at a quarter: the output is skewed downwards, the input hardly."""
        d = columns(self.folder / "wiener_hammerstein_1.csv")
        skew = {n: np.mean((d[n] - d[n].mean()) ** 3) / d[n].std() ** 3 for n in ("u", "y")}
        self.assertLess(skew["y"], -0.3)
        self.assertLess(abs(skew["u"]), 0.1)

    def test_the_same_bench_is_the_same_to_the_byte(self):
        with tempfile.TemporaryDirectory() as other:
            make_benches.tanks(Path(other))
            for file in ("tanks_2.csv", "tanks.json", "tanks.data.json"):
                self.assertEqual((Path(other) / file).read_bytes(), (self.folder / file).read_bytes())

    @unittest.skipUnless(PROGRAM, "no program was given")
    def test_hysteron_reads_them(self):
        for name in ("coupled_drives", "tanks", "wiener_hammerstein"):
            done = subprocess.run([PROGRAM, "compare", f"{name}.json", "--data", f"{name}.data.json"], cwd=self.folder,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
