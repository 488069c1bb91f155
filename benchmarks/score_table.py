#!/usr/bin/env python3
"""Whether what a search by models says hangs on the constants of its score.

    benchmarks/score_table.py TABLE.json ...

TABLE.json: written by `hysteron discover --keep-table TABLE.json`, all models that were fitted. The score (docs/discovery.md,
"One score") is worked out here once more, on its own, as it stands and with each constant halved and doubled; told is of how many
tables the first name stays the same, and which change. Needs python3-numpy.
"""
import json
import sys
from pathlib import Path

import numpy as np

AS_IT_IS = dict(least_block=4.0, most_blocks=16, price=1.0, noise=1.0, known_to=1.0, claim=10.0, correlated=True)


def blocks_of(pieces, wanted):
    n = max(1, min(pieces, wanted))
    while pieces % n:
        n -= 1
    return n


class Table:
    """The models of the first round, and what noise and correlation all of them together show."""

    def __init__(self, path):
        self.name = Path(path).stem
        self.models = [m for m in json.loads(Path(path).read_text())["models"] if m["step"] == 1]
        columns = self.models[0]["left"]
        self.outputs = sorted({c["output"] for c in columns})
        self.variance = {}
        for output in self.outputs:
            shown = []
            for m in self.models:
                mine = [c for c in m["left"] if c["output"] == output]
                rows = sum(c["rows"] for c in mine)
                squares = sum(sum(c["squares"]) for c in mine)
                scatters = sum(c["scatter"] * c["rows"] for c in mine)
                shown.append(np.sqrt(squares * scatters) / rows)
            stated = max(c["stated_variance"] for c in columns if c["output"] == output)
            least = max(c["least_variance"] for c in columns if c["output"] == output)
            self.variance[output] = max(stated if stated > 0 else min(shown), least)
        self.tau = [min(m["left"][k]["correlation"] for m in self.models) for k in range(len(columns))]

    def scores(self, c):
        """One for each model."""
        n_eff, fit = 0.0, np.zeros(len(self.models))
        for k, column in enumerate(self.models[0]["left"]):
            rows, pieces = column["rows"], len(column["squares"])
            if rows == 0:
                continue
            tau = self.tau[k] if c["correlated"] else 1.0
            fitting = int(max(1, rows // (c["least_block"] * tau)))
            blocks = blocks_of(pieces, min(int(c["most_blocks"]), fitting))
            edges = [(b * pieces // blocks) for b in range(blocks + 1)]
            row_at = [(p * rows + pieces - 1) // pieces for p in edges]
            s2 = self.variance[column["output"]] * c["noise"] ** 2
            squares = np.array([m["left"][k]["squares"] for m in self.models])
            for b in range(blocks):
                n = row_at[b + 1] - row_at[b]
                if n == 0:
                    continue
                fit -= 0.5 * n / tau * np.log(s2 + squares[:, edges[b]:edges[b + 1]].sum(axis=1) / n)
                n_eff += n / tau
        price = 0.5 * c["price"] * np.log(max(n_eff, 2))
        return np.array([f - price * m["parameters"] - m["ln_tried"] - 0.5 * m["moved"] / c["known_to"] ** 2
                         for f, m in zip(fit, self.models)])

    def name_by(self, **changed):
        c = dict(AS_IT_IS, **changed)
        scores = self.scores(c)
        null = max(s for s, m in zip(scores, self.models) if not m["effect"])
        best, name = max(((s, m["effect"]) for s, m in zip(scores, self.models) if m["effect"]), default=(-np.inf, ""))
        return name if best - null > c["claim"] else "-"


def main():
    tables = [Table(p) for p in sys.argv[1:]]
    tables = [t for t in tables if any(m["effect"] for m in t.models)]
    before = {t.name: t.name_by() for t in tables}
    print("%d tables, %d with a name" % (len(tables), sum(n != "-" for n in before.values())))
    variants = [(key, factor) for key in ("least_block", "most_blocks", "price", "noise", "known_to", "claim") for factor in (0.5, 2)]
    for key, factor in variants + [("correlated", False)]:
        value = factor if key == "correlated" else AS_IT_IS[key] * factor
        now = {t.name: t.name_by(**{key: value}) for t in tables}
        other = ["%s: %s, was %s" % (n, now[n], before[n]) for n in before if now[n] != before[n]]
        print("%-12s %-6s %3d the same  %s" % (key, value, len(tables) - len(other), "; ".join(other)))


if __name__ == "__main__":
    main()
