"""Examples run, and come to what their pages say."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT


def said(name: str, folder: Path, *words: str) -> str:
    """What an example prints."""
    command = [sys.executable, ROOT / "bindings/python/examples" / name, *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_policy_learns_and_breaks_nothing_meanwhile(tmp_path: Path) -> None:
    told = said("learn.py", tmp_path, "12")
    at_rest, after, best = (float(number) for number in re.findall(r"([+-]\d+\.\d+) m", told))
    assert at_rest == 0.0 and 0.2 < after < best
    assert told.endswith("laws broken in 222 episodes: 0\n")
    assert "<svg" in (tmp_path / "learn.svg").read_text()


def test_ir_sim_finds_no_collision_with_the_filter(tmp_path: Path) -> None:
    told = said("in_irsim.py", tmp_path)
    unfiltered, filtered = re.findall(r"(\d+) collisions, least degree (\d+)", told)
    assert int(unfiltered[0]) > 0 and int(unfiltered[1]) < 7, told
    assert filtered[0] == "0" and int(filtered[1]) >= 7, told
    assert (tmp_path / "irsim.png").stat().st_size > 10_000


def test_vmas_finds_no_collision_with_the_filter(tmp_path: Path) -> None:
    pytest.importorskip("vmas")
    told = said("in_vmas.py", tmp_path)
    unfiltered, filtered = re.findall(r"(\d+) collisions in 4 worlds, least degree (\d+)", told)
    assert int(unfiltered[0]) > 0 and int(unfiltered[1]) < 7, told
    assert filtered == ("0", "7"), told
    assert (tmp_path / "vmas.png").stat().st_size > 10_000


def test_an_algorithm_of_benchmarl_learns_and_breaks_nothing_meanwhile(tmp_path: Path) -> None:
    pytest.importorskip("benchmarl")
    told = said("learn_benchmarl.py", tmp_path, "3")
    first, last = (float(number) for number in re.findall(r"([+-]\d+\.\d+) m in", told))
    assert last > first + 0.3, told
    assert told.endswith("laws broken: 0\n"), told
    assert "<svg" in (tmp_path / "benchmarl.svg").read_text()


def test_the_robotarium_finds_nothing_wrong_with_the_filter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "agg")  # the simulator imports what draws windows
    told = said("on_robotarium.py", tmp_path)
    unfiltered, filtered = (line for line in told.splitlines() if "least degree" in line)
    assert not unfiltered.startswith("unfiltered: 0 collisions"), told
    assert filtered == "with closeranks: 0 collisions, 0 steps outside, 0 with wheels too fast, least degree 5", told
