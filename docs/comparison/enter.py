#!/usr/bin/env python3
"""Enters a controller of your own in the benchmark of docs/comparison.md, from Python.

    docs/comparison/enter.py mine.py [RUNS]       # mine.py has a function `controller(world)`; 20 runs of each case

`world.positions` is where robots are and `world.desired` where they want to go; it answers velocities, (n, 2), m/s (docs/python.md). A run counts its
width at the end, and 0 if at any tick a normal robot had too few neighbours, two robots were too close, or a value or a velocity
left its bounds: as `closeranks bench` counts.
"""

import pathlib
import runpy
import sys

import closeranks as cr

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = "task slow lossy faces noise lag crowd".split()
KEPT = {"degree", "distance", "interval", "input"}


def width(case, seed, controller):
    """What a run counts."""
    scenario = cr.Scenario.from_file(ROOT / f"scenarios/bench/{case}.toml").replace(seed=seed)
    run = scenario.run(controller=controller)
    broken = {violation.law for violation in run.violations}
    return 0.0 if broken & KEPT else run.summary["gyration_m"]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    controller = runpy.run_path(sys.argv[1])["controller"]
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    means = []
    for case in CASES:
        widths = [width(case, seed, controller) for seed in range(1, runs + 1)]
        means.append(sum(widths) / runs)
        print(f"{case:6} {means[-1]:.3f}", flush=True)
    print(f"score  {sum(means) / len(means):.3f}")


if __name__ == "__main__":
    main()
