"""Verdicts of `closeranks-node fleet --json` as rows of a table, or summed up."""

import json
import sys


def row(path):
    text = open(path).read()
    if not text:
        return f"| {path} | did not start |"
    run = json.loads(text)
    laws = ", ".join(f"{law['law']} {law['count']}" for law in run["violations"]) or "none"
    excused = ", ".join(f"{law['law']} {law['count']}" for law in run["excused"]) or "none"
    cells = [
        run["seed"],
        laws,
        excused,
        run["died"],
        f"{run['degree_min']} of {run['degree_needed']}",
        f"{run['distance_min_m']:.3f}",
        f"{100 * run['timely_share']:.0f} %",
        f"{100 * run['guaranteed_share']:.0f} %",
        run["two_faced"],
        run["injected"],
        " to ".join(f"{kb / 1000:.1f}" for kb in run["memory_kb"]),
        f"{100 * run['cpu_share'][1]:.1f} %",
    ]
    return "| " + " | ".join(map(str, cells)) + " |"


paths = sys.argv[1:]
if paths[0] != "--sum":
    print(*map(row, paths), sep="\n")
    sys.exit()
runs = [json.loads(open(path).read() or "{}") for path in paths[1:]]
runs = [run for run in runs if run]
print(f"{len(runs)} runs, broken laws {sum(len(run['violations']) for run in runs)}, died {sum(run['died'] for run in runs)}")
print("least degree", min(run["degree_min"] for run in runs), "least distance", min(run["distance_min_m"] for run in runs))
print("in time", *sorted(round(100 * run["timely_share"]) for run in runs))
print("guaranteed", *sorted(round(100 * run["guaranteed_share"]) for run in runs))
print("two-faced", [run["two_faced"] for run in runs].count([1]), "injected", sum(run["injected"] for run in runs))
print("memory at most", max(max(run["memory_kb"]) for run in runs), "growth at most", max(b - a for a, b in (run["memory_kb"] for run in runs)))
print("CPU share, middle robot", *sorted(round(100 * run["cpu_share"][1], 1) for run in runs))
