#!/usr/bin/env python3
"""Tests of the machines: what lies on their wires against closed forms, the form of a case, and that the truth leaves the noise.

Exits with 77 (ctest: skipped) where NumPy, SciPy or numba are absent.
usage: make_machines_test.py [the program hysteron]
"""
import json
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
    import scipy.fft  # noqa: F401
    from numba import njit
except ImportError as missing:
    print("skipped: %s; Debian: apt install python3-scipy python3-numba" % missing)
    sys.exit(77)

import machine_run
import make_machines

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""


@njit
def still(x, v, side, p, dx):
    dx[0] = 0.0


@njit
def passed_on(x, v, side, p, y):
    y[0] = v


def on_a_wire(u, dt, warm=20.0, **entered):
    """What a held drive becomes, 20 fine steps in a row, no plant and no noise."""
    rows = len(u)
    side = np.column_stack([np.full(rows, warm), np.zeros(rows)])
    shown, _ = machine_run.run(
        still,
        passed_on,
        np.zeros(1),
        np.zeros(1),
        np.asarray(u, float),
        np.zeros(rows),
        side,
        np.zeros(rows, np.int64),
        machine_run.settings(entered),
        np.zeros((rows, 1)),
        dt,
        20,
        True,
        np.zeros(0),
        np.zeros(2),
        1,
    )
    return shown[:, 0]


class Wires(unittest.TestCase):
    def setUp(self):
        self.step = np.concatenate([np.zeros(10), np.ones(190)])  # up at row 10; the first fine step of a row shows it
        self.after = (np.arange(190) + 0.025) * 0.01  # its middle, seconds after the step

    def test_a_lag_settles_exponentially(self):
        """The mean over a fine step stands for its middle: wrong by (h/tau)^2/24 = 3e-7 and less."""
        for name in ("lag", "s_lag"):
            y = on_a_wire(self.step, 0.01, **{name: 0.2})[10:]
            moved = self.after if name == "lag" else np.arange(190) * 0.01
            late = 0 if name == "lag" else 0.5 * 0.0005  # a step seen as half of it in the first fine step
            np.testing.assert_allclose(y[1:], 1 - np.exp(-(moved[1:] - late) / 0.2), atol=1e-4)

    def test_a_delay_shifts_and_a_rate_is_not_passed(self):
        self.assertTrue(
            np.array_equal(on_a_wire(self.step, 0.01, delay=0.25), np.concatenate([np.zeros(35), np.ones(165)]))
        )
        y = on_a_wire(self.step, 0.01, rise=2.0)
        self.assertAlmostEqual(y[30], 2.0 * (20 + 1 / 20) * 0.01, places=12)
        self.assertEqual(y[-1], 1.0)

    def test_lost_motion_is_the_gap_and_limits_are_limits(self):
        u = np.concatenate([np.linspace(0, 1, 50), np.linspace(1, -1, 100)])
        y = on_a_wire(u, 0.01, gap=0.4)
        self.assertAlmostEqual(y[49], 0.8, places=12)
        self.assertAlmostEqual(y[-1], -0.8, places=12)
        self.assertEqual(on_a_wire(u, 0.01, low=-0.5, high=0.3).max(), 0.3)
        np.testing.assert_allclose(on_a_wire(u, 0.01, mix=0.5), np.maximum(u, 0), atol=1e-15)

    def test_creep_adds_its_share_each_decade(self):
        """Two relaxations a decade ripple about the logarithm by less than a twentieth of a decade's share."""
        step = np.concatenate([np.zeros(5), np.ones(20000)])
        y = on_a_wire(step, 0.01, creep=0.1, creep_from=0.05)
        self.assertAlmostEqual(y[5 + 10000] - y[5 + 1000], 0.1, delta=0.005)

    def test_a_loop_comes_back_and_warmth_makes_the_gain(self):
        u = np.concatenate([np.linspace(0, 1, 100), *[np.linspace(a, -a, 200) for a in (1, -1, 1, -1)]])
        y = on_a_wire(u, 0.01, loop=0.1)
        self.assertGreater(y[200] - y[400], 0.05)  # down through zero and up: it lags, for it loses energy
        self.assertAlmostEqual(y[99 + 200], y[99 + 600], delta=1e-3)  # and closes, Bouc-Wen's memory fading
        self.assertAlmostEqual(on_a_wire(np.ones(3), 0.01, 30.0, kelvin=0.01, kelvin_at=20.0)[-1], 1.1, places=12)

    def test_what_is_not_known_is_an_error(self):
        with self.assertRaises(KeyError):
            machine_run.settings(dict(lagg=1.0))


class Machines(unittest.TestCase):
    def test_each_machine_has_its_six_cases_of_known_groups(self):
        groups = {"none", "single", "pair", "wrong", "wrong_plus", "outside", "starved"}
        names = set()
        for machine in make_machines.MACHINES.values():
            specs = [make_machines.specification(k, machine) for k in range(len(machine.cases))]
            self.assertEqual(len(specs), make_machines.CASES_EACH)
            self.assertIn("none", [s["group"] for s in specs])
            self.assertLessEqual({s["group"] for s in specs}, groups)
            names |= {s["id"] for s in specs}
            self.assertLessEqual(set(machine.paths), set(machine.numbers))
        self.assertGreaterEqual(len(make_machines.MACHINES), 10)
        self.assertEqual(len(names), make_machines.CASES_EACH * len(make_machines.MACHINES))

    def test_cases_are_chosen_by_machine_and_by_number(self):
        cell = make_machines.MACHINES["cell"]
        self.assertEqual(make_machines.chosen("008,cell"), [(cell, 1)] + [(cell, k) for k in range(6)])
        with self.assertRaisesRegex(ValueError, "'067'.*rod, 001 to 066"):
            make_machines.chosen("067")

    def test_a_number_is_put_where_its_path_says(self):
        diagram = {"blocks": {"cell": {"times": ["3 s", "40 s"], "ratio": 5}}}
        make_machines.put(diagram, "cell.times[1]", 44.5)
        make_machines.put(diagram, "cell.ratio", 6)
        self.assertEqual(diagram["blocks"]["cell"], {"times": ["3 s", "44.5 s"], "ratio": 6})


class OneMachine(unittest.TestCase):
    """The scanner: its first case, in which nothing is hidden, and its sixth."""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder, cls.machine = Path(cls.kept.name), make_machines.MACHINES["galvo"]
        for number in (0, 5):
            make_machines.write_case(cls.folder / str(number), *make_machines.make(cls.machine, number, 1))

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def read(self, number, file):
        return json.loads((self.folder / str(number) / file).read_text())

    def test_a_case_has_what_is_scored(self):
        case, dataset = self.read(5, "case.json"), self.read(5, "dataset.json")
        self.assertEqual((case["group"], case["expected"]["verdicts"]), ("outside", ["unexplained"]))
        self.assertLessEqual(
            {
                "id",
                "device",
                "family",
                "strength",
                "start",
                "noise_stated",
                "closed_loop",
                "wrong_numbers",
                "scale_groups",
                "gains",
                "outputs",
                "noise_floor",
                "moving",
                "outside",
            },
            set(case),
        )
        self.assertTrue(2.0 * 0.9 <= case["effects"][0]["height"] <= 8.0 * 1.15)
        self.assertIn("validate", [r["role"] for r in dataset["recordings"]])
        for r, told in zip(dataset["recordings"], case["recordings"]):
            lines = (self.folder / "5" / r["file"]).read_text().splitlines()
            self.assertEqual(len(lines), told["rows"] + 1)
            self.assertTrue(500 <= told["rows"] <= 20000)

    def test_the_same_case_is_the_same_to_the_byte(self):
        with tempfile.TemporaryDirectory() as other:
            make_machines.write_case(Path(other), *make_machines.make(self.machine, 0, 1))
            for file in (self.folder / "0").iterdir():
                self.assertEqual(file.read_bytes(), (Path(other) / file.name).read_bytes(), file.name)

    @unittest.skipUnless(PROGRAM, "no program was given")
    def test_the_truth_leaves_the_noise(self):
        self.assertIn("truth", make_machines.check(Path(PROGRAM).resolve(), self.folder / "0"))


if __name__ == "__main__":
    unittest.main()
