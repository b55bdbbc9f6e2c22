"""Figures: what is in them, and that they can be written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import closeranks as cr
from conftest import ROOT


def test_the_papers_two_figures(nominal: cr.Run, tmp_path: Path) -> None:
    runs = [nominal, cr.Scenario.paper("understating").run(progress=False)]
    first = cr.plots.formations(runs, ["nominal", "understating"])
    assert [axes.get_title() for axes in first.axes] == ["(a) start", "(b) nominal", "(c) understating"]
    second = cr.plots.series(runs)
    assert [axes.get_title()[:3] for axes in second.axes] == ["(a)", "(b)", "(c)", "(d)"]
    for name, figure in (("figure1", first), ("figure2", second)):
        figure.savefig(tmp_path / f"{name}.png")
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
    with pytest.raises(ValueError, match="1 titles for 2 runs"):
        cr.plots.series(runs, ["one"])


def test_robots_and_links_are_where_they_are(nominal: cr.Run) -> None:
    axes = Figure().subplots()
    cr.plots.draw_formation(axes, nominal, 0)
    normal, malicious = (np.asarray(marks.get_offsets()) for marks in axes.collections)
    assert np.array_equal(malicious, nominal.positions[0, :2]) and np.array_equal(normal, nominal.positions[0, 2:])
    assert len(axes.lines) == nominal.links(0).number_of_edges()


def test_one_run_in_one_figure(nominal: cr.Run) -> None:
    figure = nominal.plot(title="mine")
    assert len(figure.axes) == 4 and figure.get_suptitle() == "mine"
    h, values = Figure().subplots(1, 2)
    cr.plots.draw_h(h, nominal)
    cr.plots.draw_values(values, nominal)
    assert len(h.lines) == 12 and len(values.lines) == 11
    assert np.array_equal(h.lines[0].get_ydata(), nominal.h[:, 2])
    assert len(cr.plots.overview(nominal).axes) == 4


def test_obstacles_are_drawn_where_they_stand() -> None:
    scenario = cr.Scenario.from_file(ROOT / "scenarios" / "obstacles.toml").replace(duration_s=0.1)
    obstacles = scenario.obstacles
    discs = obstacles[obstacles[:, 4] > 0]
    assert obstacles.shape[1] == 5 and 0 < len(discs) < len(obstacles)
    assert np.array_equal(discs[:, :2], discs[:, 2:4])
    run, axes = scenario.run(progress=False), Figure().subplots()
    cr.plots.draw_formation(axes, run)
    drawn = [(*patch.center, patch.radius) for patch in axes.patches]
    assert np.array_equal(drawn, discs[:, [0, 1, 4]])
    assert len(axes.lines) == len(obstacles) + run.links(-1).number_of_edges()
    assert cr.Scenario(dimension=3, controller={"kind": "budget"}, obstacles={"discs": [[9, 0, 0, 0.5]]}).obstacles.shape == (1, 7)
    assert cr.Scenario().obstacles.shape == (0, 5)
