#!/usr/bin/env python3
"""Measures the tables of docs/comparison.md: every controller from the same random starts, one condition after another.

    docs/comparison/table.py [RUNS [CONDITION]]   # 100 starts, all conditions, with $CLOSERANKS or target/release/closeranks

Conditions: paper, task, slow, lossy, faces. The runs are those of `closeranks compare FILE --seed 1`, 2, ... (--json).
"""

import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTROLLERS = (
    "links budget composed central-composed min-composition fixed-topology pairwise p-choose-r k-connectivity "
    "central-robustness lambda2 orca none"
).split()
PAPER = [f"inside-{lie}" for lie in ("nominal", "understating", "overstating")]
CONDITIONS = {
    "paper": ("The paper's three scenarios, from a start inside (5 ms ticks)", PAPER),
    "task": ("The paper's task from random starts (5 ms ticks)", ["bench/task"]),
    "slow": ("50 ms ticks", ["bench/slow"]),
    "lossy": ("Half of all messages lost, the rest up to 0.2 s late (20 ms ticks)", ["bench/lossy"]),
    "faces": ("Liars that tell each neighbour something else (20 ms ticks)", ["bench/faces"]),
}
BROKEN = ("degree", "distance", "agreement", "interval", "feasible")


def compare(program, file, seed):
    """What `closeranks compare` says of one start: a dict for each controller."""
    names = ",".join(CONTROLLERS)
    command = [program, "compare", ROOT / f"scenarios/{file}.toml", "--controllers", names, "--json"]
    done = subprocess.run(command + ([] if seed is None else ["--seed", str(seed)]), capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    return dict(zip(CONTROLLERS, json.loads(done.stdout)["runs"]))


def mean(numbers):
    numbers = [number for number in numbers if number is not None]
    return sum(numbers) / len(numbers) if numbers else float("nan")


def least(runs, key):
    return min(run[key] for run in runs)


def row(name, runs):
    """One line of a table."""
    of = lambda key: mean([run[key] for run in runs])
    broken = [sum(run["laws"][law]["broken"] > 0 for run in runs) for law in BROKEN]
    rounds = of("rounds_to_agree")
    cells = [
        f"{least(runs, 'h_min_normal'):.2f}",
        f"{least(runs, 'distance_min_m'):.3f}",
        *map(str, broken),
        "-" if rounds != rounds else f"{rounds:.1f}",
        f"{of('gyration_m'):.3f}",
        f"{of('progress_m'):.2f}",
        f"{of('deviation_m_s'):.2f}",
        f"{of('blocked_s'):.2f}",
        str(sum(run["deadlocked"] for run in runs)),
        f"{of('jerk_m_s3'):.0f}",
    ]
    return f"| `{name}` | " + " | ".join(cells) + " |"


def table(program, files, runs):
    seeds = [None] if len(files) > 1 else range(1, runs + 1)
    done = [compare(program, file, seed) for file in files for seed in seeds]
    yield (
        f"| controller | least h | least distance, m | degree < F' | too close | no agreement | outside the hull | infeasible "
        f"| rounds | width, m | progress, m | off wish, m/s | blocked, s | deadlocks | jerk, m/s^3 |"
    )
    yield "| --- " * 15 + "|"
    for name in CONTROLLERS:
        yield row(name, [of[name] for of in done])


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    program = os.environ.get("CLOSERANKS", ROOT / "target/release/closeranks")
    for key in sys.argv[2:] or CONDITIONS:
        name, files = CONDITIONS[key]
        count = len(files) if len(files) > 1 else runs
        print(f"\n### {name}: {count} runs\n")
        print("\n".join(table(program, files, runs)), flush=True)


if __name__ == "__main__":
    main()
