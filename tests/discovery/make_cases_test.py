#!/usr/bin/env python3
"""Tests of the case generator: physics against closed forms, layout, strength, determinism.

Exits with 77 (ctest: skipped) where NumPy, SciPy or numba are absent; without numba it would take minutes.
usage: make_cases_test.py [folder of the hidden-effect cases, whose score.py then reads generated cases]
"""
import copy
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

try:
    import numba  # noqa: F401
    import numpy as np
    import scipy.signal  # noqa: F401
except ImportError as missing:
    print("skipped: %s; Debian: apt install python3-numba python3-scipy" % missing)
    sys.exit(77)

import alternatives
import case_files
import cases
import excitations
import hidden
import laws
import make_cases
import plants
from plants import draw_plant, heater_matrices, simulate
from read_cases import read_case

GIVEN = Path(sys.argv.pop(1)) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else Path("not given")
SCORE = GIVEN / "score.py"


def draws(base, seed=5):
    """A plant and short recordings of its whole menu."""
    rng = np.random.default_rng(seed)
    plant = draw_plant(rng, base)
    recordings = cases.draw_recordings(rng, plant, [], words=list(cases.of_plant(cases.MENU, base)))
    for r in recordings:
        r.u, r.temperature = [u[:400] for u in r.u], r.temperature[:400]
    return rng, plant, recordings[:len(cases.of_plant(cases.MENU, base))]


class Campaign(unittest.TestCase):
    def test_every_plant_has_the_same_recordings_in_every_case(self):
        for seed, base, (train, validate) in ((1, "B1", (7, 4)), (2, "B3", (7, 4)), (3, "B4", (6, 6)), (4, "B5", (3, 3))):
            rng = np.random.default_rng(seed)
            recordings = cases.draw_recordings(rng, draw_plant(rng, base), [], campaign=True)
            self.assertEqual([r.role for r in recordings], ["train"] * train + ["validate"] * validate)
            self.assertEqual([r.word for r in recordings[:train]], list(cases.of_plant(cases.CAMPAIGN, base)["train"]))


class Laws(unittest.TestCase):
    def test_a_lag_answers_a_ramp_as_its_closed_form(self):
        # y = t - tau (1 - exp(-t/tau)); exact for straight lines, so rounding is all that differs.
        t = 1e-3 * np.arange(2000)
        self.assertLess(np.abs(laws.lag(t, 1e-3, 0.02) - (t - 0.02 * (1 - np.exp(-t / 0.02)))).max(), 1e-12)

    def test_creep_after_a_step_follows_its_law(self):
        # The step takes one row of 0.01 s, centred half a row late; far from it only that shift remains (second order).
        h, n = 0.01, 4000
        x = np.ones(n)
        x[0] = 0
        t = h * np.arange(n) - h / 2
        want = ((1 + t / 0.02) ** 0.05 - 1) / (0.05 * np.log(10))
        got = laws.power_law_creep(x, h, 0.02, 0.05)
        self.assertLess(np.abs(got - want)[100:].max(), 1e-5)

    def test_preisach_wipes_out_minor_loops_and_closes_them(self):
        table = laws.everett_table(np.random.default_rng(3))
        u = np.interp(np.arange(601), [0, 100, 200, 300, 400, 500, 600], [0, 8, 3, 6, 3, 8, 4])
        y = laws.preisach(table, u, -0.1, 9)
        self.assertAlmostEqual(y[200], y[400], places=12)  # the minor loop closes
        self.assertAlmostEqual(y[100], y[500], places=12)  # return point memory
        self.assertGreater(np.abs(y[200:301] - y[400:299:-1]).max(), 1e-3)  # and encloses an area

    def test_friction_of_a_guide_reaches_its_coulomb_level_and_no_more(self):
        x_free = np.concatenate([np.linspace(0, 10, 4000), np.linspace(10, -10, 8000)])
        x = laws.guided(x_free, 1e-3, 0.5, 0.1, 0.0, 1.0)
        self.assertLess(np.abs(x_free - x).max(), 0.5 + 1e-9)
        self.assertAlmostEqual(x_free[3999] - x[3999], 0.5, places=6)
        self.assertAlmostEqual(x_free[-1] - x[-1], -0.5, places=6)

    def test_a_quick_lag_before_plays_overshoots_within_a_step(self):
        # Eight steps to a row of 70 times the lag miss a tenth of what the lag does; eight times as many as are taken tell.
        rng = np.random.default_rng(5)
        plant = draw_plant(rng, "B2")
        recordings = [r for r in cases.draw_recordings(rng, plant, [], words=["multisine"]) if r.role == "train"]
        e = hidden.draw(rng, "amplifier_lag", plant, recordings)
        e.shape["times"] = (1.0, 0.0)
        e = hidden.with_amount(e, recordings[0].h / 70)
        usual = simulate(plant, recordings[0], [e])[0][0]
        does = usual - simulate(plant, recordings[0])[0][0]
        steps = plants.fine_steps(plant, recordings[0], [e])
        with mock.patch.object(plants, "fine_steps", lambda *_: 8 * steps):
            finer = simulate(plant, recordings[0], [e])[0][0]
        self.assertLess(np.std(finer - usual), 0.01 * np.std(does))

    def test_a_slew_limit_is_reached_and_an_unreached_one_does_nothing(self):
        u = np.interp(np.arange(300), [0, 10, 299], [0, 5, 5])
        v = laws.slew(u, 0.01, 10.0, 10.0, 4)
        self.assertAlmostEqual(np.diff(v).max() / 0.01, 10.0, places=9)
        np.testing.assert_allclose(laws.slew(u, 0.01, 51.0, 51.0, 4), u, atol=1e-12)

    def test_a_cubic_spring_bends_the_static_gain(self):
        # Pulled slowly to f, x + c x^3/scale^2 = f; ten thousandth of f is what slow swings leave.
        f, c = 5.0, 0.2
        h = 1 / (20 * 300)
        pull = np.interp(np.arange(40000), [0, 30000, 40000], [0, f, f])
        x = laws.mass_on_spring(pull, h, laws.propagator(20.0, 0.2, h), c, 0.0, np.zeros(5), np.zeros((3, 3)), 0.0, 0.0, 8.0)
        self.assertAlmostEqual(x[-1] + c * x[-1] ** 3 / 64, f, delta=1e-4 * f)

    def test_a_hysteretic_spring_takes_energy_and_gives_none(self):
        # A slow drive there and back: the area of displacement over drive is the work lost, clockwise in (x, force).
        # Half the drive's own loss in the dashpot would be 1e-3 of it here, so the sign is the spring's.
        h, frequency = 1e-3, 100.0
        t = h * np.arange(8000)
        pull = np.sin(2 * np.pi * 0.25 * t)
        x = laws.mass_on_spring(pull, h, laws.propagator(frequency, 0.3, h), 0.0, 0.0, np.zeros(5),
                                laws.everett_table(np.random.default_rng(3)), 0.05, 1.0, 1.6)
        work = np.sum((pull[4001:] + pull[4000:-1]) / 2 * np.diff(x[4000:]))
        self.assertGreater(work, 0.005)

    def test_halving_the_step_of_a_nonlinear_mass_changes_little(self):
        t = np.arange(6000) / 6000
        def at(steps, **what):
            h = 1 / (20 * 300) / steps
            pull = 6 * np.sin(2 * np.pi * 9 * t) * t
            fine = np.interp(np.arange((len(t) - 1) * steps + 1) / steps, np.arange(len(t)), pull)
            friction = np.array(what.get("friction", np.zeros(5)), dtype=float)
            return laws.mass_on_spring(fine, h, laws.propagator(20.0, 0.1, h), what.get("cubic", 0.0), 0.0, friction,
                                       table, what.get("depth", 0.0), 0.0, 10.0)[::steps]
        table = laws.everett_table(np.random.default_rng(3))
        for what in (dict(cubic=0.3), dict(depth=0.03), dict(friction=[0.1, 0.2, 0.3, 20.0, 0.0])):
            coarse, fine = at(1, **what), at(4, **what)
            effect = np.abs(at(1) - fine).max()
            self.assertLess(np.abs(coarse - fine).max(), 0.02 * effect, what)  # the effect is itself to 2 %


class Plants(unittest.TestCase):
    def test_rest_is_kept(self):
        """At u = 0 nothing moves: all states start in equilibrium."""
        for base in ("B1", "B2", "B3", "B4", "B5"):
            _, plant, recordings = draws(base)
            for r in recordings[:2]:
                r.u = [0 * u for u in r.u]
                r.temperature = np.full(len(r.u[0]), 22.0)
                for y in simulate(plant, r)[0]:
                    self.assertLess(np.ptp(y), 1e-9)

    def test_a_heater_ends_at_power_times_resistance(self):
        _, plant, recordings = draws("B5")
        r = recordings[0]
        r.h = -20 / max(np.linalg.eigvals(heater_matrices(plant.task)[0]).real) / 300
        r.u, r.temperature = [np.append([0.0], np.full(399, 4.0))], np.full(400, 22.0)
        want = 22 + 4 * plant.task["power_per_volt_W"] * plant.task["R2a_K_per_W"]
        self.assertAlmostEqual(simulate(plant, r)[0][0][-1], want, places=6)

    @unittest.skipUnless((GIVEN / "dev").is_dir(), "no cases of others there")
    def test_base_models_are_those_of_cases_that_others_made(self):
        """Their residual on the validate recordings is known to five digits; half a unit of the last is 5e-5."""
        for folder in sorted((GIVEN / "dev").iterdir()):
            plant, recordings = read_case(folder)
            left = [m - b for r in recordings if r.role == "validate" for m, b in zip(r.extra["measured"], r.extra["base"])]
            want = json.loads((folder / "case.json").read_text())["expected"]["validation_rms_before"]
            self.assertAlmostEqual(make_cases.rms(left) / want, 1, delta=1e-4, msg=folder.name)

    def test_nothing_of_an_effect_is_the_base_model(self):
        """Amount 0 exactly, and a ten millionth of the unit to a thousandth of any noise: the law is neutral there."""
        for base in ("B1", "B2", "B3", "B4", "B5"):
            rng, plant, recordings = draws(base)
            for name, law in hidden.EFFECTS.items():
                if base not in law.plants:
                    continue
                e = hidden.draw(rng, name, plant, recordings)
                half = hidden.stroke(plant, recordings)[1]
                for amount in (0.0, 1e-7 * law.unit):
                    trace = hidden.traces(plant, recordings[:4], hidden.with_amount(e, amount))
                    self.assertLess(max(np.abs(x).max() for x in trace), 1e-7 * half, (base, name, amount))

    def test_every_effect_shows_where_it_is_offered(self):
        for name, law in hidden.EFFECTS.items():
            self.assertTrue(all(law.shows[base] for base in law.plants), name)
            self.assertTrue(set(w for base in law.plants for w in law.shows[base]) <=
                            set(w for menu in cases.MENU.values() for w in menu), name)


class Cases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def make(self, kind, index, what=None, seed=7, wrong=None, into="a", campaign=False):
        layout = cases.Layout(campaign, wrong == "free")
        make_cases.make((self.root / into, seed, kind, index, what, layout.offered(hidden.EFFECTS), hidden.STRENGTHS, wrong,
                         layout))
        return self.root / into / make_cases.number_of(seed, kind, index)

    def test_the_same_seed_gives_the_same_bytes_and_another_does_not(self):
        a, b = self.make("starved", 0), self.make("starved", 0, into="b")
        self.assertEqual(sorted(f.name for f in a.iterdir()), sorted(f.name for f in b.iterdir()))
        for f in a.iterdir():
            self.assertEqual(f.read_bytes(), (b / f.name).read_bytes(), f.name)
        c = self.make("starved", 0, seed=8)
        self.assertNotEqual((a / "01.csv").read_bytes(), (c / "01.csv").read_bytes())

    def test_strength_is_as_asked(self):
        """The trace, recomputed without the search, stands above the noise by what its strength promises."""
        for index, what in enumerate([("creep", "weak"), ("calibration", "medium"), ("rate_dependence", "strong")]):
            case, _ = cases.build(7, "singles", index, what, list(hidden.EFFECTS), hidden.STRENGTHS)
            most = 0.0
            for r in case.recordings:
                for y, base in zip(simulate(case.plant, r, case.effects)[0], simulate(case.plant, r)[0]):
                    most = max(most, np.sqrt(np.mean((y - base) ** 2)))
            low, high = hidden.TARGETS[what[1]]  # the search stops within a per cent
            self.assertTrue(0.98 * low < most / case_files.total(case.sensor) < 1.02 * high, (what, most))

    def test_a_curve_of_the_drive_is_one_of_the_sensor_where_nothing_moves_fast(self):
        """Of a plant at rest in its own time the sensor's curve is the drive's, whatever shape was drawn; fast, it is not."""
        rng = np.random.default_rng(11)
        plant = draw_plant(rng, "B1")
        slow = cases.draw_recordings(rng, plant, [], words=["triangle", "freq_low"])
        fast = cases.draw_recordings(rng, plant, [], words=["chirp", "multisine", "freq_high"])
        sensor = dict(white=1e-4, flicker=5e-5)
        for recordings, told_apart in ((slow, False), (fast, True)):
            e = hidden.scale(plant, recordings, hidden.draw(rng, "sensor_nonlinearity", plant, recordings), 3e-3)
            gap = alternatives.gap(plant, recordings, e, "asymmetry", sensor)
            whole = alternatives.whitened(hidden.traces(plant, recordings, e), sensor)
            self.assertEqual(gap > max(alternatives.TIE, alternatives.LAW_ERROR**2 * float(whole @ whole)), told_apart)

    def test_effects_that_cannot_stand_together_are_refused(self):
        with self.assertRaisesRegex(cases.Impossible, "calibration, ageing go together"):
            cases.draw_names(np.random.default_rng(1), 2, ["calibration", "ageing"])
        self.assertEqual(sorted(cases.draw_names(np.random.default_rng(1), 2, ["calibration", "creep"])),
                         ["calibration", "creep"])

    def test_noise_is_as_stated(self):
        """White and 1/f add up to the stated rms: 2e5 samples give it to a per cent or so, 1/f to some ten."""
        rng = np.random.default_rng(2)
        sensor = dict(white=1.0, flicker=0.0, exponent=1.0, heavy=False)
        self.assertAlmostEqual(np.std(case_files.noise(rng, sensor, 200000)), 1.0, delta=0.01)
        sensor.update(white=0.0, flicker=1.0)
        pink = np.mean([np.mean(case_files.noise(rng, sensor, 2000) ** 2) for _ in range(400)])
        self.assertAlmostEqual(pink, 1.0, delta=0.1)

    def test_the_layout(self):
        folder = self.make("nothing", 0)
        truth, task = (json.loads((folder / f).read_text()) for f in ("case.json", "task.json"))
        self.assertEqual({k: truth[k] for k in task}, task)
        self.assertTrue(2 <= len(task["files"]) <= 8)
        self.assertEqual({f["role"] for f in task["files"]}, {"train", "validate"})
        for entry in task["files"]:
            head, *rows = (folder / entry["file"]).read_text().splitlines()
            names = head.split(",")
            table = np.array([[float(x) for x in row.split(",")] for row in rows])
            self.assertTrue(450 <= len(table) <= 20000)
            self.assertEqual(table[0, names.index("u [V]")], 0)
            self.assertLess(np.ptp(np.diff(table[:, 0])), 1e-7 * table[-1, 0])
            y = (table[:, names.index(task["outputs"][0])] - task["sensor"]["range"][0]) / task["sensor"]["lsb"]
            self.assertLess(np.abs(y - np.round(y)).max(), 0.2)  # on the converter's grid, but for the printed digits
        before, floor = (truth["expected"][k] for k in ("validation_rms_before", "noise_floor_rms"))
        self.assertEqual(before, floor)  # nothing hidden: the base model leaves the noise

    def test_wrong_parameters_leave_more_than_noise(self):
        folder = self.make("nothing", 1, wrong="held")
        e = json.loads((folder / "case.json").read_text())["expected"]
        self.assertGreater(e["validation_rms_before"], 1.2 * e["noise_floor_rms"])

    def test_of_an_effect_beside_free_numbers_as_much_is_left_as_asked_for(self):
        """What free gains and weights can do is taken out by least squares, here recording by recording stacked anew."""
        layout = cases.Layout(uncertain=True)
        self.assertNotIn("calibration", layout.offered(hidden.EFFECTS))
        case, _ = cases.build(7, "singles", 0, ("creep", "medium"), layout.offered(hidden.EFFECTS), hidden.STRENGTHS, layout)
        effect = [np.array(simulate(case.plant, r, case.effects)[0]) - np.array(simulate(case.plant, r)[0])
                  for r in case.recordings]
        columns = []
        for k, _ in enumerate(plants.uncertain_numbers(case.plant.task)):
            other = copy.deepcopy(case.plant)
            holder, key = list(plants.uncertain_numbers(other.task))[k]
            holder[key] *= 1.01
            columns.append(np.concatenate([(np.array(simulate(other, r)[0]) - np.array(simulate(case.plant, r)[0])).ravel()
                                           for r in case.recordings]))
        y, a = np.concatenate([e.ravel() for e in effect]), np.array(columns).T
        left = y - a @ np.linalg.lstsq(a, y, rcond=None)[0]
        ends = np.cumsum([e.size for e in effect])[:-1]
        most = max(np.sqrt(np.mean(part**2)) for part in np.split(left, ends))  # one output in each recording
        self.assertEqual(case.plant.axes, 1)
        low, high = hidden.TARGETS["medium"]  # the effect is not quite linear in its amount, the search stops at a per cent
        self.assertTrue(0.95 * low < most / case_files.total(case.sensor) < 1.05 * high, most)

    def test_what_is_free_or_roughly_known_stands_in_the_task(self):
        free = json.loads((self.make("nothing", 1, wrong="free") / "task.json").read_text())
        held = json.loads((self.make("nothing", 1, wrong="held", into="b") / "task.json").read_text())
        self.assertTrue(set(free["base_parameters_free"]) <= set(plants.UNCERTAIN) and free["base_parameters_free"])
        self.assertIs(held["base_parameters_exact"], False)
        self.assertNotIn("base_parameters_free", held)
        exact = json.loads((self.make("nothing", 1, into="c") / "task.json").read_text())
        self.assertFalse({"base_parameters_free", "base_parameters_exact"} & set(exact))

    @unittest.skipUnless(SCORE.exists(), "no score.py there")
    def test_score_takes_the_truth_as_right(self):
        made = [self.make("singles", 0, ("creep", "medium")), self.make("pairs", 0), self.make("nothing", 0),
                self.make("starved", 0)] + [self.make("unlisted", k) for k in range(4)]
        results = self.root / "results"
        results.mkdir()
        for folder in made:
            e = json.loads((folder / "case.json").read_text())["expected"]
            location = dict(e.get("location", {}))
            if "jumps" in location:
                location["intervals"] = {k: [[x, x] for x in v] for k, v in location["jumps"].items()}
            (results / (folder.name + ".json")).write_text(json.dumps(dict(
                verdict=e["verdict"], effects=e["effects"], claimed=len(e["effects"]), location=location,
                validation_rms_before=e["validation_rms_before"], validation_rms_after=e["noise_floor_rms"],
                next_experiment=e.get("separating_experiments", [None])[0])))
        subprocess.run([sys.executable, SCORE, "--json", self.root / "score.json", results, self.root / "a"], check=True,
                       capture_output=True)
        s = json.loads((self.root / "score.json").read_text())["summary"]
        self.assertEqual(s["right"], [8, 8])
        self.assertEqual((s["single_all"]["top1"], s["pair"]["full"], s["none"]["false_alarm"]), (1, 1, 0))
        self.assertEqual((s["unknown"]["place"], s["starved"]["next"], s["starved"]["both"]), (1, 1, 1))


if __name__ == "__main__":
    unittest.main()
