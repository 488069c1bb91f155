"""Every diagram of the project that runs by itself: a stepper with steps of 0.1, 1 and 7 times the output step goes where
run() goes. Of each run the first rows: 42."""

import json
import unittest
from pathlib import Path
from typing import Optional

import numpy as np

import hysteron as hy

DIAGRAMS = Path(__file__).resolve().parents[3] / "diagrams"
ROWS = 42
SECONDS = {"us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}


def output_step(file: Path) -> Optional[float]:
    """[s]; None where the file is no diagram that says so."""
    content = json.loads(file.read_text(encoding="utf-8"))
    every = content.get("simulate", {}).get("every") if isinstance(content, dict) and "blocks" in content else None
    if not isinstance(every, str):
        return None
    number, unit = every.split()
    return float(number) * SECONDS[unit]


class Stepping(unittest.TestCase):
    def test_it_goes_where_a_run_goes(self) -> None:
        seen = 0
        for file in sorted(DIAGRAMS.rglob("*.json")):
            step = output_step(file)
            diagram = hy.load(file) if step is not None else None
            if step is None or diagram is None or diagram.inputs:
                continue
            with self.subTest(diagram=str(file.relative_to(DIAGRAMS))):
                self.compare(diagram, step)
                seen += 1
        self.assertGreater(seen, 40)

    def compare(self, diagram: hy.Diagram, step: float) -> None:
        run = diagram.run(until=ROWS * step, every=step)
        numbers = {signal.name for signal in diagram.signals}
        names = [name for name in run.trace.columns if name in numbers]
        # Each way is held to 1e-6 of what signals usually are, and some are rounding beside others of their unit.
        size = {run.unit(name): 0.0 for name in names}
        for name in names:
            size[run.unit(name)] = max(size[run.unit(name)], float(np.abs(run[name]).max()))
        for factor in (0.1, 1.0, 7.0):
            stepper = diagram.stepper(until=ROWS * step)
            for k in range(1, int(round(ROWS / factor)) + 1):
                row = k * factor
                whole = abs(row - round(row)) < 1e-9
                stepper.advance(float(run.t[round(row)]) if whole else row * step)
                if not whole:
                    continue
                for name in names:
                    off = abs(stepper[name] - run[name][round(row)])
                    self.assertLessEqual(off, 1e-4 * size[run.unit(name)], f"{name} at {stepper.t} s, steps {factor}")


if __name__ == "__main__":
    unittest.main()
