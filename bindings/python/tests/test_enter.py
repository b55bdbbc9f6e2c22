"""Whoever enters the benchmark from Python is scored as docs/comparison.md says."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

import closeranks as cr
from conftest import ROOT


def scored(folder: Path, body: str) -> dict[str, str]:
    """What the script says of a controller with this body, after one run of each case."""
    mine = folder / "mine.py"
    mine.write_text(f"def controller(world):\n    {body}\n")
    command = [sys.executable, ROOT / "docs/comparison/enter.py", mine, "1"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return dict(line.split() for line in done.stdout.splitlines())


def test_a_team_that_stands_still_scores_the_width_of_its_start(tmp_path: Path) -> None:
    told = scored(tmp_path, "return 0.0 * world.desired")
    cases = "task slow lossy faces noise lag crowd".split()
    assert list(told) == [*cases, "score"]
    for case in cases:
        start = cr.Scenario.from_file(ROOT / f"scenarios/bench/{case}.toml").replace(seed=1).positions
        width = np.sqrt(((start - start.mean(axis=0)) ** 2).sum(axis=1).mean())
        assert abs(float(told[case]) - width) < 1e-3, case
    mean = sum(float(told[case]) for case in cases) / len(cases)
    assert abs(float(told["score"]) - mean) < 2e-3


def test_a_controller_that_breaks_something_gets_nothing(tmp_path: Path) -> None:
    assert scored(tmp_path, "return world.desired")["score"] == "0.000"
