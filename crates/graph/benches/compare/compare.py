"""Times closeranks-graph, the definition, a MILP and a SAT form on the same graphs; exits with 1 if two answers differ.

    python compare.py             golden graphs, runs, measured.csv, tables on stdout, picture
    python compare.py --redraw    tables and picture of measured.csv
"""

import csv
import json
import math
import resource
import signal
import statistics
import subprocess
import sys
from functools import partial
from pathlib import Path

import matplotlib.pyplot as pyplot

import forms

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
MEASURED = HERE / "measured.csv"
LIMIT_S = 20  # A method that takes longer on a graph is not run on later ones of the family.
START_S = 1  # Allowed for starting a program and building a form, which is not in what is measured.
DEFINITION_NODES = 14  # Four nodes more are 81 times as many pairs.
QUESTIONS = {"r_max": "r_max", "f_max": "F_max"}
METHODS = {  # Colours of Okabe and Ito; each method has its own marker too.
    "definition": ("definition", "#E69F00", "s"),
    "milp": ("MILP (HiGHS)", "#CC79A7", "^"),
    "sat": ("SAT (CaDiCaL)", "#0072B2", "D"),
    "closeranks": ("closeranks", "#000000", "o"),
}


def main():
    if "--redraw" not in sys.argv:
        check_golden()
        measure()
    with MEASURED.open() as file:
        medians = medians_of(list(csv.DictReader(file)))
    print_table(medians)
    draw(medians)


def check_golden():
    graphs = json.loads((ROOT / "crates/graph/tests/golden/robustness.json").read_text())["graphs"]
    for graph in graphs:
        edges = graph["edges"] + ([] if graph["directed"] else [(v, u) for u, v in graph["edges"]])
        heard = [[u for u, v in edges if v == node] for node in range(graph["n"])]
        for question, golden in (("r_max", graph["r_robustness"]), ("f_max", graph["F_max"])):
            answers = {form: forms.run(form, question, heard, patience_s=0)[0] for form in ("milp", "sat")}
            require_equal(answers | {"golden": golden}, f"{question} of {graph['name']}")
    print(f"{len(graphs)} golden graphs agree", file=sys.stderr)


def measure():
    """Runs every method on every graph, smallest first, and writes a row for each run."""
    build = "cargo build --release -p closeranks-graph --example compare --message-format=json".split()
    messages = subprocess.run(build, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    program = next(filter(None, (json.loads(line).get("executable") for line in messages)))
    lines = subprocess.run([program, "graphs"], check=True, capture_output=True, text=True).stdout.splitlines()
    over = set()
    with MEASURED.open("w", newline="", buffering=1) as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["family", "n", "seed", "graph6", "question", "method", "answer", "seconds"])
        for family, n, seed, graph6 in sorted((line.split() for line in lines), key=lambda line: int(line[1])):
            for question in QUESTIONS:
                answers = {}
                for method in METHODS:
                    if (family, question, method) in over or method == "definition" and int(n) > DEFINITION_NODES:
                        continue
                    answer, seconds = run(method, question, graph6, program)
                    table.writerow([family, n, seed, graph6, question, method, answer, f"{seconds:.3e}"])
                    if answer is None:
                        over.add((family, question, method))
                    answers[method] = answer
                require_equal(answers, f"{question} of {family} {graph6}")
            print(f"{family} n={n} seed={seed} agrees", file=sys.stderr)


def run(method, question, graph6, program):
    """(answer, median seconds) of one method on one graph; (None, infinity) if the system ended it for its time."""
    command = [program] if method in ("closeranks", "definition") else [sys.executable, HERE / "forms.py"]
    limit = partial(resource.setrlimit, resource.RLIMIT_CPU, (LIMIT_S + START_S, LIMIT_S + START_S))
    done = subprocess.run([*command, method, question, graph6], stdout=subprocess.PIPE, text=True, preexec_fn=limit)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None, math.inf
    done.check_returncode()
    answer, seconds = done.stdout.split()
    return (int(answer), float(seconds)) if float(seconds) <= LIMIT_S else (None, math.inf)


def require_equal(answers, of):
    if len(set(answers.values()) - {None}) > 1:
        sys.exit(f"the methods disagree on {of}: {answers}")


def medians_of(rows):
    """{(question, method, n, family): seconds}; a graph that was not finished, or not reached, counts as infinity."""
    graphs, times = {}, {}
    for row in rows:
        for place in ((int(row["n"]), row["family"]), (int(row["n"]), "all")):
            graphs.setdefault(place, set()).add((row["family"], row["seed"]))
            times.setdefault((row["question"], row["method"], *place), []).append(float(row["seconds"]))
    missing = {key: [math.inf] * (len(graphs[key[2:]]) - len(seconds)) for key, seconds in times.items()}
    return {key: statistics.median_high(seconds + missing[key]) for key, seconds in times.items()}


def print_table(medians):
    names = [f"{title} {label}" for title in QUESTIONS.values() for label, _, _ in METHODS.values()]
    print("| " + " | ".join(["graphs", "n", *names]) + " |\n| --- | ---: " + "| ---: " * len(names) + "|")
    for n, family in sorted({key[2:] for key in medians}, key=lambda place: (place[1] != "all", place[1], place[0])):
        cells = [in_words(medians.get((question, method, n, family))) for question in QUESTIONS for method in METHODS]
        print("| " + " | ".join([family, str(n), *cells]) + " |")


def in_words(seconds):
    if seconds in (None, math.inf):
        return f"> {LIMIT_S} s" if seconds else "–"
    value, unit = next((seconds * f, u) for f, u in ((1, "s"), (1e3, "ms"), (1e6, "µs")) if seconds * f > 0.99)
    return f"{value:.{0 if value >= 9.95 else 1}f} {unit}"


def draw(medians):
    """A panel for each question and family: median seconds over n, as far as the method goes within the limit."""
    pyplot.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "closeranks", "font.family": "sans-serif"})
    families = sorted({key[3] for key in medians} - {"all"})
    figure, panels = pyplot.subplots(2, len(families), figsize=(12, 6), sharex=True, sharey=True)
    for (question, title), line in zip(QUESTIONS.items(), panels):
        line[0].set_ylabel(f"time for {title}")
        for family, panel in zip(families, line):
            panel.axhline(LIMIT_S, color="#888888", linewidth=0.8)
            for method, (label, colour, marker) in METHODS.items():
                mine = {key[2]: s for key, s in medians.items() if key == (question, method, key[2], family)}
                points = [(n, seconds) for n, seconds in mine.items() if seconds <= LIMIT_S]
                panel.semilogy(*zip(*points), color=colour, marker=marker, markersize=5, label=label)
            panel.set(xticks=sorted({key[2] for key in medians}), title=family if question == "r_max" else "")
            panel.set_xlabel("nodes n" if question == "f_max" else "")
            panel.grid(axis="y", color="#DDDDDD", linewidth=0.6)
            panel.set_yticks([1e-6, 1e-3, 1], ["1 µs", "1 ms", "1 s"])
            panel.minorticks_off()
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="upper center", ncols=len(METHODS), frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 0.94))
    figure.savefig(ROOT / "docs/pictures/robustness-performance.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
