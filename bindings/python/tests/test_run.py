"""What a run came to."""

from __future__ import annotations

from pathlib import Path

import networkx as nx
import numpy as np
import pytest

import closeranks as cr
from conftest import ROOT


def test_arrays_have_their_shapes_and_agree(nominal: cr.Run) -> None:
    assert nominal.positions.shape == nominal.velocities.shape == (2001, 11, 2)
    for array in (nominal.h, nominal.levels, nominal.told, nominal.phi, nominal.values, nominal.degree, nominal.outcome,
                  nominal.values_told, nominal.degree_sensed, nominal.levels_sensed):
        assert array.shape == (2001, 11)
    assert nominal.time_s[-1] == pytest.approx(10.0)
    assert np.array_equal(nominal.positions[0], nominal.scenario.positions)
    assert np.array_equal(nominal.h, nominal.levels - nominal.scenario.required_degree)
    step = nominal.positions[1:] - nominal.positions[:-1] - 0.005 * nominal.velocities[:-1]
    assert np.abs(step).max() < 1e-12
    assert nominal.outcome_names == ("free", "active", "infeasible", "recovering")
    assert set(np.unique(nominal.outcome)) <= {0, 1, 2, 3}


def test_arrays_are_views_that_cannot_be_written_and_outlive_the_run() -> None:
    run = cr.Scenario(duration_s=0.1).run(progress=False)
    for array in (run.h, run.degree, run.positions, run.outcome):
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.flags.writeable = True
    assert np.shares_memory(run.h, run.h) and np.shares_memory(run.positions, run.positions)
    h, expected = run.h, run.h.copy()
    del run
    assert np.array_equal(h, expected)


def test_links_are_a_graph_of_robots(nominal: cr.Run) -> None:
    for tick in (0, 1000, -1):
        graph = nominal.links(tick)
        assert sorted(graph) == list(range(1, 12))
        assert [graph.degree[robot] for robot in range(1, 12)] == nominal.degree[tick].tolist()
        levels = [sum(graph[robot][other]["weight"] for other in graph[robot]) for robot in range(1, 12)]
        assert np.allclose(levels, nominal.levels[tick])
        assert all(data["distance_m"] <= 3.0 for _, _, data in graph.edges(data=True))
        assert [robot for robot in graph if graph.nodes[robot]["malicious"]] == [1, 2]
        assert graph.nodes[3]["position"] == tuple(nominal.positions[tick, 2])
    assert nx.is_connected(nominal.links(-1))
    with pytest.raises(IndexError, match="tick 2001 is not one of -2001 to 2000"):
        nominal.links(2001)


def test_the_sentence_the_numbers_and_the_laws(nominal: cr.Run) -> None:
    assert nominal.ok and nominal.violations == [] or all(not one.expected for one in nominal.violations)
    assert nominal.summary["degree_min_normal"] == nominal.degree[:, 2:].min()
    assert nominal.summary["version"] == cr.__version__ and nominal.summary["commit"] == cr.__commit__
    assert "held at every tick: degree, distance" in str(nominal)
    assert repr(nominal) == "<Run of 'inside-nominal' under composed, seed 1: every expected law held>"
    assert len(nominal.rounds) == 101
    assert nominal.rounds[0].f_max == 5 and nominal.rounds[0].tick == 0 and nominal.rounds[1].tick == 20
    last = nominal.rounds[-1]
    assert last.spread == np.ptp(nominal.values[-1, 2:]) and last.degree_min == nominal.degree[-1, 2:].min()
    assert isinstance(last, cr.Round) and isinstance(last.r_max, int) and last.r_max >= last.f_max


def test_a_broken_law_says_where() -> None:
    run = cr.Scenario(controller={"kind": "none"}).run(progress=False, robustness=False)
    assert not run.ok and run.rounds == []
    degree = next(one for one in run.violations if one.law == "degree")
    assert isinstance(degree, cr.Violation)
    tick, robot = degree.tick, degree.robots[0] - 1
    assert degree.expected and degree.demanded == 7 and degree.seen == run.degree[tick, robot] < 7
    assert (run.degree[:tick, 2:] >= 7).all() and degree.time_s == pytest.approx(tick * 0.005)
    assert degree.count == (run.degree[:, 2:] < 7).sum() >= degree.count_covered
    assert "BROKEN: degree" in repr(run)


def test_a_run_that_was_not_recorded_has_its_summary_alone() -> None:
    run = cr.Scenario(duration_s=0.5).run(progress=False, record=False)
    assert run.ok and run.summary["ticks"] == 100
    with pytest.raises(cr.Error, match="this run was not recorded, allowed is a run with record=True"):
        _ = run.h


def test_a_file_that_cannot_be_written_is_named(nominal: cr.Run, tmp_path: Path) -> None:
    with pytest.raises(OSError, match="cannot write"):
        nominal.to_parquet(tmp_path / "no-such-folder" / "run.parquet")


def test_frames_have_the_rows_of_the_file(nominal: cr.Run, tmp_path: Path) -> None:
    polars, pandas = pytest.importorskip("polars"), pytest.importorskip("pandas")
    nominal.to_parquet(tmp_path / "run.parquet")
    from polars.testing import assert_frame_equal

    assert_frame_equal(polars.read_parquet(tmp_path / "run.parquet"), nominal.to_polars())
    written = pandas.read_parquet(tmp_path / "run.parquet")
    pandas.testing.assert_frame_equal(written, nominal.to_pandas(), check_dtype=False)
    assert nominal.to_polars()["ux_m_s"].null_count() == 11


def test_three_dimensions() -> None:
    run = cr.Scenario(dimension=3, duration_s=0.2).run(progress=False)
    assert run.positions.shape == (41, 11, 3)
    assert "z_m" in run.to_pandas() and len(run.links(0).nodes[1]["position"]) == 3


def test_values_of_two_numbers_are_points() -> None:
    run = cr.Scenario.from_file(ROOT / "scenarios" / "points.toml").replace(duration_s=0.5).run(progress=False)
    ticks, robots = run.values.shape
    assert run.points.shape == run.points_told.shape == (ticks, robots, 2)
    assert np.array_equal(run.points[:, :, 0], run.values) and not np.array_equal(run.points[:, :, 1], run.values)
    normal = ~run.scenario.is_malicious
    assert np.array_equal(run.points_told[:, normal], run.points[:, normal])
    spread = np.ptp(run.points[:, normal], axis=1)
    assert (spread[-1] < spread[0]).all()
    plain = cr.Scenario(duration_s=0.1).run(progress=False)
    assert np.array_equal(plain.points[:, :, 0], plain.values) and plain.points.shape[2] == 1
