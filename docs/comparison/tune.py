#!/usr/bin/env python3
"""Chooses the parameters of the controllers of others for docs/comparison.md, on starts other than those that are judged.

    docs/comparison/tune.py [RUNS]        # 20 starts, with the program of $CLOSERANKS or target/release/closeranks

The rule: of the values below, each controller gets the one with the greatest score over seeds 10,001, 10,002, ... of two cases of the
benchmark, `task` (5 ms ticks) and `slow` (50 ms ticks). The score is the benchmark's: the mean width at the end, where a run counts 0 in
which at any tick a normal robot had too few neighbours, two robots were too close, or a value or a velocity left its bounds. Of equal
scores the one with the fewest broken runs wins, then the value nearest to the usual one. Judged are seeds 1 to 100.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RATES = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
HORIZONS = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0]
ALPHAS = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0]
# What is chosen for each controller, and its usual value.
CHOICES = {
    "central-composed": ("alpha", ALPHAS, 0.1),
    "central-robustness": ("rate_1_s", RATES, 5.0),
    "composed": ("alpha", ALPHAS, 0.1),
    "fixed-topology": ("rate_1_s", RATES, 5.0),
    "k-connectivity": ("rate_1_s", RATES, 5.0),
    "lambda2": ("rate_1_s", RATES, 5.0),
    "min-composition": ("rate_1_s", RATES, 5.0),
    "orca": ("orca_horizon_s", HORIZONS, 2.0),
    "p-choose-r": ("rate_1_s", RATES, 5.0),
    "pairwise": ("rate_1_s", RATES, 5.0),
}
KEPT = ("degree", "distance", "interval", "input")


def score(program, folder, case, name, field, value, seed):
    """What one run counts."""
    text = (ROOT / f"scenarios/bench/{case}.toml").read_text()
    file = pathlib.Path(folder, "case.toml")
    file.write_text(f'{text}\n[controller]\nkind = "{name}"\n{field} = {value}\n')
    done = subprocess.run([program, "run", file, "--seed", str(seed), "--json"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    run = json.loads(done.stdout)
    run = run.get("runs", [run])[0]
    return 0.0 if any(run["laws"][law]["broken"] for law in KEPT) else run["gyration_m"]


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    program = os.environ.get("CLOSERANKS", ROOT / "target/release/closeranks")
    with tempfile.TemporaryDirectory() as folder:
        for name, (field, values, usual) in CHOICES.items():
            scores = {}
            for value in values:
                widths = [
                    score(program, folder, case, name, field, value, 10_000 + number)
                    for case in ("task", "slow")
                    for number in range(1, runs + 1)
                ]
                broken = sum(width == 0.0 for width in widths)
                scores[value] = (round(sum(widths) / len(widths), 4), -broken, -abs(value - usual))
            best = max(scores, key=scores.get)
            told = ", ".join(f"{value}: {of[0]:.3f}" for value, of in scores.items())
            print(f"{name}: {field} = {best}    ({told})", flush=True)


if __name__ == "__main__":
    main()
