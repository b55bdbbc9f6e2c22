#!/usr/bin/env python3
"""Measures the tables of docs/comparison.md: every controller from the same random starts, one condition after another.

    docs/comparison/table.py [RUNS]        # 100 starts, with the program of $CLOSERANKS or target/release/closeranks
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTROLLERS = (
    "links budget composed central-composed min-composition fixed-topology pairwise p-choose-r k-connectivity "
    "central-robustness lambda2 orca none"
).split()
BASE = """
duration_s = 10.0
[start]
kind = "random"
half_side_m = 1.0
distance_min_m = 0.31
"""
CONDITIONS = {
    "The paper's task (5 ms ticks)": "",
    "50 ms ticks": "[clock]\ntau_1_s = 0.05\n",
    "Half of all messages lost, the rest up to 0.2 s late (20 ms ticks)": "[clock]\ntau_1_s = 0.02\n[network]\nloss = 0.5\ndelay_max_s = 0.2\n",
    "Liars that tell each neighbour something else (20 ms ticks)": "[clock]\ntau_1_s = 0.02\n"
    '[attack]\nlevel = { kind = "faces" }\nvalue = { kind = "split" }\nlists = { kind = "faces" }\n',
}


def sweep(program, condition, runs):
    """The counts of one condition: a dict for each controller."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "case.toml")
        names = ", ".join(f'"{name}"' for name in CONTROLLERS)
        file.write_text(f'name = "comparison"\n{BASE}[sweep]\ncontrollers = [{names}]\n{condition}')
        command = [program, "sweep", file, "--runs", str(runs), "--seed", "1", "--json", "-o", f"{folder}/out"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in (0, 1):
            sys.exit(done.stderr)
        return json.loads(done.stdout)["controllers"]


def table(counts, runs):
    yield f"| controller | width, m | degree < F' | distance < Delta_d | no agreement | outside the hull | of {runs} infeasible |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for name in CONTROLLERS:
        of = counts[name]
        broken = of["broken_at_all"]
        cells = [broken[law] for law in ("degree", "distance", "agreement", "interval", "feasible")]
        yield f"| `{name}` | {of['gyration_m']:.3f} | " + " | ".join(map(str, cells)) + " |"


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    program = os.environ.get("CLOSERANKS", ROOT / "target/release/closeranks")
    for name, condition in CONDITIONS.items():
        print(f"\n### {name}\n")
        print("\n".join(table(sweep(program, condition, runs), runs)), flush=True)


if __name__ == "__main__":
    main()
