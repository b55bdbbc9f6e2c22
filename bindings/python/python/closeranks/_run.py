"""What a run came to."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from closeranks._frames import pandas_frame, polars_frame
from closeranks._native import Run as NativeRun
from closeranks._types import Floats, Law
from closeranks.plots import overview

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd
    import polars as pl
    from matplotlib.figure import Figure

    from closeranks._scenario import Scenario
    from closeranks._view import RunView


class Violation(NamedTuple):
    """A law that was broken."""

    law: Law
    """Its name."""
    expected: bool
    """True if the scenario expects it to hold: then the run is not `ok`."""
    count: int  # type: ignore[assignment]
    """How often, counted per tick and robot, pair or team."""
    count_covered: int
    """How often although everything held that the law rests on."""
    tick: int
    """Where first."""
    time_s: float
    """When that was, s."""
    robots: tuple[int, ...]
    """Which robots, from 1; none if it is about all."""
    seen: float
    """What was seen there; NaN if it was not finite."""
    demanded: float
    """What was demanded."""


class Round(NamedTuple):
    """Exact robustness of the network in a consensus round, all robots counted."""

    tick: int
    """Tick in which the round began."""
    r_max: int | tuple[int, int]
    """Largest r for which the network is r-robust; least and greatest possible where the search was cut short."""
    f_max: int | tuple[int, int]
    """Largest F for which it is (F+1, F+1)-robust; -1 if not even (1, 1)-robust."""
    degree_min: int
    """Least degree of normal robots."""
    spread: float
    """Greatest less least value of normal robots."""


class Run:
    """A finished run: every tick as arrays, and what became of the laws.

    Arrays have one row a tick, T = ticks + 1, and one column a robot. They are views of the memory of the run that cannot be
    written; of `positions`, `velocities` and `outcome` one copy is made when they are first asked for.
    """

    __slots__ = ("_native", "_scenario", "_summary")
    _native: NativeRun
    _scenario: Scenario
    _summary: dict[str, Any] | None

    def __init__(self, scenario: Scenario, native: NativeRun) -> None:
        self._scenario, self._native, self._summary = scenario, native, None

    @property
    def scenario(self) -> Scenario:
        """What was run."""
        return self._scenario

    @property
    def time_s(self) -> Floats:
        """Time of every tick, (T,), s."""
        return np.arange(len(self.h), dtype=np.float64) * self._scenario.tick_s

    @property
    def positions(self) -> Floats:
        """x_i, (T, n, D), m."""
        return self._vectors(self._native.positions())

    @property
    def velocities(self) -> Floats:
        """u_i, (T, n, D), m/s, held from this tick on; the last row is what would come next."""
        return self._vectors(self._native.velocities())

    def _vectors(self, rows: Floats) -> Floats:
        return rows.reshape(-1, self._scenario.robots, self._scenario.dimension)

    @property
    def degree(self) -> npt.NDArray[np.uint16]:
        """delta_i as it is, (T, n)."""
        return self._native.degree()

    @property
    def degree_sensed(self) -> Floats:
        """delta_i as robots sense it, (T, n); NaN of a robot that is down."""
        return self._native.numbers("degree_sensed")

    @property
    def levels(self) -> Floats:
        """True levels c_i, (T, n)."""
        return self._native.numbers("level")

    @property
    def levels_sensed(self) -> Floats:
        """Levels c_i as robots sense them, (T, n); NaN of a robot that is down."""
        return self._native.numbers("level_sensed")

    @property
    def told(self) -> Floats:
        """Levels as told, (T, n); NaN of a robot that is down, and of one that does not tell all the same."""
        return self._native.numbers("told")

    @property
    def h(self) -> Floats:
        """h_i = c_i - F', (T, n)."""
        return self._native.numbers("h")

    @property
    def phi(self) -> Floats:
        """phi_i, (T, n), which the controller `composed` uses; NaN of a robot that is down."""
        return self._native.numbers("phi")

    @property
    def values(self) -> Floats:
        """y_i as robots hold it, (T, n), malicious or not; the first number of it where it has several, see `points`."""
        return self._native.numbers("value")

    @property
    def values_told(self) -> Floats:
        """y_i as told, (T, n); NaN of a robot that is down, and of one that does not tell all the same."""
        return self._native.numbers("value_told")

    @property
    def points(self) -> Floats:
        """y_i with all its numbers, (T, n, d), where d is `consensus.dimension` of the scenario; a copy."""
        return np.stack([self.values, *self._native.more_values(False)], axis=2)

    @property
    def points_told(self) -> Floats:
        """The same as told; NaN as in `values_told`."""
        return np.stack([self.values_told, *self._native.more_values(True)], axis=2)

    @property
    def outcome(self) -> npt.NDArray[np.uint8]:
        """What programs found, (T, n), as numbers: places in `outcome_names`."""
        return self._native.outcome()

    @property
    def outcome_names(self) -> tuple[str, ...]:
        """Names of the numbers in `outcome`."""
        return tuple(self._native.outcome_names())

    @property
    def rounds(self) -> list[Round]:
        """Exact robustness of the network in every consensus round, of several teams the least; none in teams of more than 128."""
        rows = self._native.rounds()
        return [Round(tick, number(r), number(f), degree, spread) for tick, r, f, degree, spread in rows]

    @property
    def summary(self) -> dict[str, Any]:
        """The numbers that `closeranks run --json` prints, but for the wall time."""
        if self._summary is None:
            self._summary = self._native.summary()
        return dict(self._summary)

    @property
    def violations(self) -> list[Violation]:
        """Laws that were broken, expected to hold or not; `composition` and `shares` are about phi, which `composed` alone uses."""
        return violations(self._native.laws())

    @property
    def ok(self) -> bool:
        """True if no law was broken that the scenario expects to hold."""
        return not self._native.failures()

    @property
    def digest(self) -> str:
        """16 hexadecimal digits made of every bit of every tick: equal digests mean equal runs, here and on the command line."""
        return self._native.digest()

    def links(self, tick: int) -> nx.Graph[int]:
        """The network at a tick (negative ones count from the end), as a networkx graph.

        Nodes are robots, from 1, with `position` (tuple, m), `value`, `degree`, `malicious` and `team` (from 0); edges have `weight`
        a_ij and `distance_m`. Robots of different teams have no links.
        """
        import networkx as nx

        ticks, teams = len(self.h), self._scenario.team_of.tolist()
        if not -ticks <= tick < ticks:
            raise IndexError(f"tick {tick} is not one of {-ticks} to {ticks - 1}")
        row = tick % ticks
        points, graph = self.positions[row], nx.Graph()
        for index, liar in enumerate(self._scenario.is_malicious):
            position, degree = tuple(points[index].tolist()), int(self.degree[row, index])
            value = float(self.values[row, index])
            kind = {"malicious": bool(liar), "team": teams[index]}
            graph.add_node(index + 1, position=position, value=value, degree=degree, **kind)
        pairs, weights = self._native.edges(row)
        for (one, other), weight in zip(pairs.tolist(), weights, strict=True):
            distance = float(np.linalg.norm(points[one] - points[other]))
            graph.add_edge(one + 1, other + 1, weight=weight, distance_m=distance)
        return graph

    def to_polars(self) -> pl.DataFrame:
        """One row a tick and robot, with the columns of `run.parquet`: `tick, time_s, robot, malicious, x_m, y_m, (z_m,) ux_m_s,
        uy_m_s, (uz_m_s,) degree, level, told, h, phi_i, value, value_told, degree_sensed, level_sensed,
        (value_2, value_told_2, value_3, value_told_3,) outcome`; inputs are null at the last tick, and what was not told or sensed is."""
        return polars_frame(self)

    def to_pandas(self) -> pd.DataFrame:
        """The same rows and columns as `to_polars`; inputs are NaN at the last tick."""
        return pandas_frame(self)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Writes the same rows and columns as a Parquet file, byte for byte what `closeranks run -o` writes at the same commit.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        self._native.write_parquet(os.fspath(path))

    def plot(self, title: str | None = None) -> Figure:
        """Start, end and ways of the robots, their h_i and their values, as a figure of matplotlib.

        `closeranks.plots` has the paper's two figures for several runs side by side.
        """
        return overview(self, title=title)

    def view(self, *, frames: int = 400) -> RunView:
        """The run as a widget that plays in a notebook, with at most so many frames (up to 2,000). Needs `pip install
        "closeranks[notebook]"`.

        Robots are drawn as on the page of `closeranks view`. `view.frame` is the frame that is shown and can be set; `view.ticks` says
        the tick of each frame.
        """
        from closeranks._view import RunView

        return RunView(self, frames=frames)

    def __str__(self) -> str:
        return self._native.report()

    def __repr__(self) -> str:
        broken = "every expected law held" if self.ok else f"BROKEN: {', '.join(self._native.failures())}"
        return f"<Run of {self._scenario.name!r} under {self._scenario.controller}, seed {self._scenario.seed}: {broken}>"


def number(interval: tuple[int, int]) -> int | tuple[int, int]:
    """The number, if it is known."""
    return interval[0] if interval[0] == interval[1] else interval


def violations(laws: Mapping[str, Any]) -> list[Violation]:
    """The laws that were broken, of what became of all."""
    broken = []
    for name, law in laws.items():
        first = law["first"]
        if first is None:
            continue
        seen, demanded = (float("nan") if first[key] is None else float(first[key]) for key in ("seen", "demanded"))
        count, covered = law["broken"], law["broken_where_assumptions_hold"]
        where = (first["tick"], first["time_s"], tuple(first["robots"]), seen, demanded)
        broken.append(Violation(name, law["expected"], count, covered, *where))
    return broken
