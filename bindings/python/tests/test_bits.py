"""The same scenario gives the same bits here, in Rust's own tests and on the command line."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import closeranks as cr
from conftest import ROOT


def mixed() -> cr.Scenario:
    """The scenario of `mixed` in crates/sim/tests/digest.rs."""
    return cr.Scenario(
        name="mixed",
        duration_s=5,
        seed=20_261_122,
        team={"robots": 16, "faults": 3, "malicious": np.array([2, 7, 11])},
        start={"kind": "random", "half_side_m": 1.4, "distance_min_m": 0.42},
        attack={"level": {"kind": "bias", "bias": 1.5}},
        controller={"share": "own"},
    )


def test_the_mixed_run_has_the_digest_of_the_command_line(program: Path, tmp_path: Path) -> None:
    (tmp_path / "mixed.toml").write_text(mixed().text)
    command = [program, "run", tmp_path / "mixed.toml"]
    told = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    digest = re.search(r"^digest: ([0-9a-f]{16})$", told, re.MULTILINE)
    assert digest is not None
    assert mixed().run(progress=False).digest == digest[1]


@pytest.mark.parametrize("file", ["inside-overstating.toml", "patrol.toml", "space.toml", "lossy.toml", "teams.toml", "points.toml"])
def test_the_file_of_every_tick_is_that_of_the_command_line(file: str, program: Path, tmp_path: Path) -> None:
    scenario = ROOT / "scenarios" / file
    out = tmp_path / "out"
    told = subprocess.run([program, "run", scenario, "-o", out, "--json"], capture_output=True, text=True, check=False)
    theirs = json.loads(told.stdout)
    run = cr.Scenario.from_file(scenario).run(progress=False)
    ours = run.summary
    theirs.pop("wall_time_s")
    commits = ours.pop("commit"), theirs.pop("commit")
    assert ours == theirs
    run.to_parquet(tmp_path / "ours.parquet")
    written, expected = (tmp_path / "ours.parquet").read_bytes(), (out / "run.parquet").read_bytes()
    if commits[0] == commits[1]:
        assert written == expected
    pandas = pytest.importorskip("pandas")
    polars = pytest.importorskip("polars")
    assert run.to_polars().equals(polars.read_parquet(tmp_path / "ours.parquet"))
    pandas.testing.assert_frame_equal(
        pandas.read_parquet(tmp_path / "ours.parquet"), pandas.read_parquet(out / "run.parquet"), check_exact=True
    )


def test_the_words_of_a_refusal_are_those_of_the_command_line(program: Path, tmp_path: Path) -> None:
    file = tmp_path / "wrong.toml"
    file.write_text("[link]\nepsilon = 0.2\nradius = 3\n[team]\nfaults = 9\n")
    told = subprocess.run([program, "run", file], capture_output=True, text=True, check=False)
    with pytest.raises(cr.ScenarioError) as refused:
        cr.Scenario.from_file(file)
    assert told.returncode == 2
    assert str(refused.value) == told.stderr.strip()


@pytest.mark.parametrize("name", ["inside-nominal", "teams", "ranks", "shift"])
def test_what_a_run_prints_is_what_the_command_line_prints(name: str, program: Path) -> None:
    file = ROOT / "scenarios" / f"{name}.toml"
    told = subprocess.run([program, "run", file], capture_output=True, text=True, check=False).stdout

    def sentences(text: str) -> list[str]:
        """What stands below the table, without the digest: the table has the time of the run there."""
        return [line for line in text.split("\n\n")[-1].splitlines() if not line.startswith("digest: ")]

    assert sentences(told) == sentences(str(cr.Scenario.from_file(file).run(progress=False))) != []


def test_robots_computed_one_by_one_give_the_same_bits() -> None:
    scenario = cr.Scenario(duration_s=0.5)
    digests = set()
    for one_by_one in (False, True):
        world = cr.World(scenario, record=True, one_by_one=one_by_one)
        while not world.is_over:
            world.step()
        digests.add(world.finish().digest)
    assert digests == {scenario.run(progress=False).digest}
