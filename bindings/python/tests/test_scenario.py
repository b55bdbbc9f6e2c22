"""Scenarios: made, changed, refused."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import closeranks as cr
from conftest import ROOT


def test_an_empty_scenario_is_the_papers_own() -> None:
    scenario = cr.Scenario()
    assert (scenario.robots, scenario.faults, scenario.required_degree, scenario.dimension) == (11, 2, 7, 2)
    assert (scenario.malicious, scenario.controller, scenario.ticks, scenario.tick_s) == ([1, 2], "composed", 2000, 0.005)
    assert scenario.is_malicious.tolist() == [True, True] + [False] * 9
    assert scenario.expect == ["degree", "distance", "interval", "agreement", "input"]
    assert (scenario.radius_m, scenario.distance_min_m, scenario.duration_s) == (3.0, 0.3, 10.0)
    assert (scenario.seed, scenario.ticks_per_round, scenario.speed_max_m_s.tolist()) == (1, 20, [1.5, 1.5])
    assert scenario.positions.shape == (11, 2) and scenario.values.shape == (11,)


def test_text_dict_keywords_and_file_are_one_scenario(tmp_path: Path) -> None:
    text = 'name = "seven"\nseed = 3\n[team]\nrobots = 7\nfaults = 1\nmalicious = [2]\n[start]\nkind = "hexagon"\nspacing_m = 0.5\n'
    fields = {
        "name": "seven",
        "seed": 3,
        "team": {"robots": 7, "faults": 1, "malicious": [2]},
        "start": {"kind": "hexagon", "spacing_m": 0.5},
    }
    (tmp_path / "seven.toml").write_text(text)
    all_four = [cr.Scenario(text), cr.Scenario(fields), cr.Scenario(**fields), cr.Scenario.from_file(tmp_path / "seven.toml")]
    assert all(one == all_four[0] for one in all_four)
    assert all_four[0].text == text
    assert all_four[0].fields == fields
    assert pickle.loads(pickle.dumps(all_four[1])) == all_four[0]
    assert all_four[0] != cr.Scenario()
    assert repr(all_four[0]) == "<Scenario 'seven': 7 robots, F = 1, 1 malicious, composed, 10 s, seed 3>"


def test_numbers_of_numpy_are_numbers() -> None:
    places = 0.6 * np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
    scenario = cr.Scenario(team={"robots": np.int64(4), "faults": 1}, start={"kind": "listed", "positions_m": places})
    assert np.array_equal(scenario.positions, places)


def test_fields_of_tables_are_replaced_one_by_one_and_kinds_as_a_whole() -> None:
    scenario = cr.Scenario(team={"robots": 7, "faults": 1}, start={"kind": "hexagon", "spacing_m": 0.5})
    assert scenario.replace(team={"malicious": [3]}).robots == 7
    assert scenario.replace(start={"spacing_m": 0.7}).fields["start"] == {"kind": "hexagon", "spacing_m": 0.7}
    other = scenario.replace(start={"kind": "random", "half_side_m": 1.0, "distance_min_m": 0.3}, seed=None)
    assert "spacing_m" not in other.fields["start"]
    tuned = cr.Scenario(controller={"alpha": 2.0}).replace(controller={"kind": "budget"})
    assert tuned.fields["controller"] == {"kind": "budget", "alpha": 2.0}


def test_another_controller_brings_what_it_promises() -> None:
    assert cr.Scenario().under("budget").expect == cr.Scenario(controller={"kind": "budget"}).expect
    strict = cr.Scenario(expect=["degree"])
    assert strict.under("budget").expect == ["degree"]
    usual = cr.Scenario(expect=cr.Scenario().expect)
    assert usual.under("budget").expect == cr.Scenario().under("budget").expect
    assert {"budget", "composed", "none", "orca"} <= set(cr.controllers())
    with pytest.raises(cr.ScenarioError, match='no controller is called "mine", allowed are budget, '):
        cr.Scenario().under("mine")


def test_the_papers_six() -> None:
    for start in ("inside", "published"):
        for attack in ("nominal", "understating", "overstating"):
            scenario = cr.Scenario.paper(attack, start)  # type: ignore[arg-type]
            assert scenario == cr.Scenario.from_file(ROOT / f"scenarios/{start}-{attack}.toml")
    with pytest.raises(cr.ScenarioError, match='no scenario "honest" from the start "inside", allowed are "nominal"'):
        cr.Scenario.paper("honest")  # type: ignore[arg-type]


def test_every_mistake_is_underlined() -> None:
    with pytest.raises(cr.ScenarioError) as refused:
        cr.Scenario("[link]\nepsilon = 0.2\n")
    said = str(refused.value)
    assert "error: `link.epsilon` is 0.2" in said and "^^^ allowed is more than 0 and less than 0.1" in said
    assert " --> scenario:2:11" in said and isinstance(refused.value, cr.ScenarioError)
    with pytest.raises(cr.ScenarioError) as refused:
        cr.Scenario("[link]\nradius = 3\nspeed = 1\n")
    assert "`link.radius` is not a field here" in str(refused.value) and "`link.speed`" in str(refused.value)
    assert isinstance(refused.value, cr.Error) and isinstance(refused.value, ValueError)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"team": {"robots": 1}}, "`team.robots` is 1"),
        ({"team": {3: 1}}, "a field of `team` is called 3, allowed are strings"),
        ({"seed": object()}, "`seed` is a object, allowed are numbers, strings, lists, arrays and dicts"),
        ({"seed": 1 << 70}, "allowed is a whole number of 64 bits"),
        ({"speed": 3}, "`speed`"),
        ({"start": {"kind": "listed", "positions_m": [[0, 0]]}}, "start"),
    ],
)
def test_what_is_wrong_is_named(fields: dict[str, object], words: str) -> None:
    with pytest.raises(cr.ScenarioError) as refused:
        cr.Scenario(fields)
    assert words in str(refused.value)


def test_a_list_that_holds_itself_is_refused() -> None:
    endless: list[object] = []
    endless.append(endless)
    with pytest.raises(cr.ScenarioError, match="nested too deeply"):
        cr.Scenario(expect=endless)


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        cr.Scenario.from_file(tmp_path / "none.toml")
    (tmp_path / "bytes.toml").write_bytes(b"name = \xff")
    with pytest.raises(cr.ScenarioError, match=r"bytes.toml` is not text: byte 7 is not UTF-8"):
        cr.Scenario.from_file(tmp_path / "bytes.toml")
    (tmp_path / "long.toml").write_text("#" * ((1 << 20) + 1))
    with pytest.raises(cr.ScenarioError, match="is too long: allowed is at most 1048576 bytes"):
        cr.Scenario.from_file(tmp_path / "long.toml")
    (tmp_path / "goals.toml").write_text('[motion]\nkind = "goals"\nfile = "goals.csv"\n')
    with pytest.raises(cr.ScenarioError, match="goals.csv"):
        cr.Scenario.from_file(tmp_path / "goals.toml")
    with pytest.raises(cr.ScenarioError, match="draws values, so it is many scenarios"):
        cr.Scenario.from_file(ROOT / "scenarios/campaign.toml")


def test_rows_of_files_stand_in_the_text() -> None:
    patrol = cr.Scenario.from_file(ROOT / "scenarios/patrol.toml")
    assert cr.Scenario(patrol.text) == patrol and "file" not in patrol.fields["motion"]


def test_ranks_say_who_needs_how_many() -> None:
    ranked = cr.Scenario.from_file(ROOT / "scenarios" / "ranks.toml")
    ranks, needed = ranked.ranks, ranked.required_degrees
    assert ranks is not None and ranks.shape == needed.shape == (40,)
    core = int((ranks == 0).sum())
    assert core >= 5 and (needed[ranks > 0] == 2 * ranked.faults + 1).all()
    assert (needed[ranks == 0] == ranked.faults + core // 2).all() and ranked.required_degree == 22
    run = ranked.replace(duration_s=0.2).run(progress=False)
    assert run.summary["ranks"] == ranks.tolist() and (run.degree >= needed)[:, ~ranked.is_malicious].all()
    assert cr.Scenario().ranks is None
