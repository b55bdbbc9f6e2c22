"""The paper's figures in matplotlib.

Normal robots are blue circles, malicious ones orange squares, so that the two are told apart in grey print and by everybody's
eyes. Where there are several teams, normal robots have the colour of theirs. `formations` is the paper's figure 1, `series` its figure 2; `overview` is one run in one figure.

Figures are made without pyplot: they show in notebooks by themselves, and elsewhere `figure.savefig("name.png")` writes them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from closeranks._run import Run

__all__ = ["draw_formation", "draw_h", "draw_values", "formations", "overview", "series"]

_NORMAL, _MALICIOUS, _LINK = "#0072b2", "#d55e00", "#888888"
_OBSTACLE = "#bdb4a7"
_TEAMS = (_NORMAL, "#009e73", "#3c3c3c", "#56b4e9")
"""Colours of teams, in turn."""
_POINTS_MAX = 2_000


def _figure(width_in: float, height_in: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width_in, height_in), layout="constrained")


def _titles(runs: Sequence[Run], titles: Sequence[str] | None) -> list[str]:
    if titles is None:
        return [run.scenario.name for run in runs]
    if len(titles) != len(runs):
        raise ValueError(f"{len(titles)} titles for {len(runs)} runs")
    return list(titles)


def _letter(index: int) -> str:
    return f"({chr(ord('a') + index)})" if index < 26 else f"({index + 1})"


def draw_formation(axes: Axes, run: Run, tick: int = -1, *, ways: bool = False) -> None:
    """Draws robots and links at a tick (negative ones count from the end) in the plane of the first two axes; with `ways`, where
    every robot came from."""
    points, graph = run.positions[tick], run.links(tick)
    _draw_obstacles(axes, run)
    for one, other in graph.edges:
        color = _MALICIOUS if graph.nodes[one]["malicious"] or graph.nodes[other]["malicious"] else _LINK
        ends = points[[one - 1, other - 1]]
        axes.plot(ends[:, 0], ends[:, 1], color=color, linewidth=0.5, linestyle=":", zorder=1)
    if ways:
        stop = range(len(run.h))[tick] + 1
        for way, color in zip(np.moveaxis(run.positions[:stop:_stride(stop)], 1, 0), _colors(run), strict=True):
            axes.plot(way[:, 0], way[:, 1], color=color, linewidth=0.6, alpha=0.4, zorder=1)
    malicious, colors = run.scenario.is_malicious, np.where(run.scenario.is_malicious, _MALICIOUS, _colors(run))
    for those, marker in ((~malicious, "o"), (malicious, "s")):
        axes.scatter(points[those, 0], points[those, 1], color=colors[those].tolist(), marker=marker, s=70, zorder=2)
    for index, point in enumerate(points):
        axes.annotate(str(index + 1), point[:2], color="white", fontsize=6, ha="center", va="center", zorder=3)
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel("x, m")
    axes.set_ylabel("y, m")


def _draw_obstacles(axes: Axes, run: Run) -> None:
    from matplotlib.patches import Circle

    dimension = run.scenario.dimension
    for row in run.scenario.obstacles:
        ends, radius = np.array([row[:2], row[dimension : dimension + 2]]), float(row[-1])
        if radius > 0:
            axes.add_patch(Circle((ends[0, 0], ends[0, 1]), radius, color=_OBSTACLE, zorder=0))
        axes.plot(ends[:, 0], ends[:, 1], color=_OBSTACLE, linewidth=2.0, zorder=0)


def _colors(run: Run) -> list[str]:
    """The colour of the team of each robot."""
    return [_TEAMS[team % len(_TEAMS)] for team in run.scenario.team_of]


def draw_h(axes: Axes, run: Run) -> None:
    """Draws h_i over time; normal robots must stay above 0."""
    _lines(axes, run, run.h)
    axes.axhline(0.0, color="black", linewidth=0.8)
    axes.set_ylabel("$h_i$")


def draw_values(axes: Axes, run: Run) -> None:
    """Draws the values y_i over time at consensus rounds; what malicious robots say is behind."""
    rounds = slice(None, None, run.scenario.ticks_per_round)
    liars = run.scenario.is_malicious
    time, values, told = run.time_s[rounds], run.values[rounds], run.values_told[rounds]
    axes.step(time, told[:, liars], where="post", color=_MALICIOUS, linewidth=0.6, alpha=0.5)
    for index in np.flatnonzero(~liars):
        axes.step(time, values[:, index], where="post", color=_colors(run)[index], linewidth=1.0)
    axes.set_xlabel("time, s")
    axes.set_ylabel("$y_i$")


def _stride(ticks: int) -> int:
    return max(1, ticks // _POINTS_MAX)


def _lines(axes: Axes, run: Run, numbers: np.ndarray[Any, Any]) -> None:
    stride, liars = _stride(len(numbers)), run.scenario.is_malicious
    time, shown = run.time_s[::stride], numbers[::stride]
    for index in np.flatnonzero(~liars):
        axes.plot(time, shown[:, index], color=_colors(run)[index], linewidth=0.9)
    axes.plot(time, shown[:, liars], color=_MALICIOUS, linewidth=0.9, linestyle="--")
    axes.set_xlabel("time, s")


def _legend(figure: Figure, runs: Sequence[Run]) -> None:
    from matplotlib.lines import Line2D

    shown = {"linestyle": "none", "markersize": 7}
    names = [team.name for team in max((run.scenario.teams for run in runs), key=len)] or ["normal"]
    kinds = [(_TEAMS[team % len(_TEAMS)], "o", name) for team, name in enumerate(names)] + [(_MALICIOUS, "s", "malicious")]
    handles = [Line2D([], [], color=color, marker=marker, label=name, **shown) for color, marker, name in kinds]  # type: ignore[arg-type]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)


def formations(runs: Sequence[Run], titles: Sequence[str] | None = None) -> Figure:
    """The paper's figure 1: the start of the first run, and the end of each, side by side and to one scale."""
    figure = _figure(3.0 * (len(runs) + 1), 3.4)
    panels = figure.subplots(1, len(runs) + 1, sharex=True, sharey=True, squeeze=False)[0]
    draw_formation(panels[0], runs[0], 0)
    panels[0].set_title(f"{_letter(0)} start")
    for index, (run, title) in enumerate(zip(runs, _titles(runs, titles), strict=True)):
        draw_formation(panels[index + 1], run)
        panels[index + 1].set_title(f"{_letter(index + 1)} {title}")
    for axes in panels:
        axes.label_outer()
    _legend(figure, runs)
    return figure


def series(runs: Sequence[Run], titles: Sequence[str] | None = None) -> Figure:
    """The paper's figure 2: h_i of each run above, its values y_i below."""
    figure = _figure(3.6 * len(runs), 5.2)
    panels = figure.subplots(2, len(runs), sharex="col", sharey="row", squeeze=False)
    for index, (run, title) in enumerate(zip(runs, _titles(runs, titles), strict=True)):
        draw_h(panels[0, index], run)
        draw_values(panels[1, index], run)
        panels[0, index].set_title(f"{_letter(index)} {title}")
        panels[1, index].set_title(_letter(len(runs) + index))
    for axes in panels.flat:
        axes.label_outer()
    _legend(figure, runs)
    return figure


def overview(run: Run, title: str | None = None) -> Figure:
    """One run: start, end with the ways that robots took, h_i and values."""
    figure = _figure(9.0, 7.0)
    (start, end), (h, values) = figure.subplots(2, 2)
    start.sharex(end)
    start.sharey(end)
    draw_formation(start, run, 0)
    draw_formation(end, run, ways=True)
    draw_h(h, run)
    draw_values(values, run)
    for axes, what in ((start, "start"), (end, "end, and the ways there"), (h, "h"), (values, "values")):
        axes.set_title(what)
    figure.suptitle(run.scenario.name if title is None else title)
    _legend(figure, [run])
    return figure
