"""What to run."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._native import Scenario as NativeScenario
from closeranks._files import scenario_with_files
from closeranks._progress import bar
from closeranks._types import Attack, Floats, Law, Progress, Start
from closeranks._world import World

if TYPE_CHECKING:
    from closeranks._run import Run

_SLICE_S = 0.05


def controllers() -> dict[str, str]:
    """Every controller that a scenario can name, with what it is in one line.

    >>> list(controllers())[0]
    'budget'
    """
    return dict(_native.controllers())


class Team(NamedTuple):
    """One of several teams of a scenario (docs/teams.md)."""

    name: str
    """Its name."""
    robots: range
    """The numbers of its robots among all robots of the scenario, from 1: robot k of the team is `robots[k - 1]`."""
    faults: int
    """F."""
    required_degree: int
    """F' = F + floor(n/2), of its own n."""


class Scenario:
    """One run, complete: who is in the team, where robots start and want to go, who lies and how, and which controller filters.

    Parameters
    ----------
    settings : str, mapping or None
        A TOML text, or a dict of the same fields. Every field has a default, so without any this is the paper's own experiment:
        eleven robots in the plane, two of them malicious. `scenarios/everything.toml` lists all fields with units and ranges.
    **fields
        Single fields, and tables as dicts: `Scenario(seed=3, team={"robots": 7, "faults": 1})`. Arrays are taken where lists
        are. They win over `settings`.

    Raises
    ------
    ScenarioError
        With every mistake underlined, as on the command line.

    >>> Scenario(team={"robots": 7, "faults": 1, "malicious": [2]}).required_degree
    4
    """

    __slots__ = ("_native",)
    _native: NativeScenario

    def __init__(self, settings: str | Mapping[str, Any] | None = None, /, **fields: Any) -> None:
        if isinstance(settings, str):
            native = _native.Scenario.from_toml(settings, "scenario", [])
        else:
            native = _native.Scenario.from_toml("", "scenario", [])
            native = native.replace({**dict(settings or {}), **fields})
            fields = {}
        self._native = native.replace(fields) if fields else native

    @classmethod
    def _of(cls, native: NativeScenario) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._native = native
        return scenario

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scenario:
        """The scenario of a TOML file; lists in CSV files beside it are read too, and stand in `text` then.

        Raises
        ------
        OSError
            If a file cannot be read.
        ScenarioError
            If it is too long, no text, or wrong.
        """
        text, files = scenario_with_files(Path(path))
        return cls._of(_native.Scenario.from_toml(text, str(path), files))

    @classmethod
    def paper(cls, attack: Attack = "nominal", start: Start = "inside") -> Scenario:
        """One of the paper's three scenarios (section V), from the start in its figure or from ours.

        The start `"published"` lies outside of the paper's own safe set; `"inside"` is ours, where every hypothesis holds.
        """
        return cls._of(_native.Scenario.paper(attack, start))

    def replace(self, **fields: Any) -> Scenario:
        """This scenario with other values for some fields. Fields of tables are replaced one by one; a table that names another
        `kind` replaces the whole table.

        >>> Scenario(seed=3).replace(team={"faults": 1}).seed
        3
        """
        return Scenario._of(self._native.replace(fields))

    def under(self, controller: str) -> Scenario:
        """This scenario under another controller (`controllers()`). What is expected of it is then what that one promises, unless
        `expect` lists something unusual."""
        return Scenario._of(self._native.under(controller))

    @property
    def text(self) -> str:
        """TOML that reads as this scenario. `closeranks run` gives the same bits for it."""
        return self._native.text

    @property
    def fields(self) -> dict[str, Any]:
        """The fields that the text names, as dicts, lists and numbers."""
        return self._native.fields()

    @property
    def name(self) -> str:
        """Name for tables and files."""
        return self._native.name

    @property
    def seed(self) -> int:
        """Seed of every random draw."""
        return self._native.seed

    @property
    def robots(self) -> int:
        """n; of several teams all robots, one team after another."""
        return self._native.robots

    @property
    def faults(self) -> int:
        """F, how many malicious robots the team is prepared for; of several teams the greatest."""
        return self._native.faults

    @property
    def required_degree(self) -> int:
        """F' = F + floor(n/2), how many neighbours every normal robot must keep; of several teams the least. Ranks are not in it: see
        `required_degrees`."""
        return self._native.required_degree

    @property
    def teams(self) -> list[Team]:
        """The teams of `[[teams]]`, in their order; none where there is one team alone."""
        teams, first = [], 1
        for name, robots, faults, required in self._native.teams():
            teams.append(Team(name, range(first, first + robots), faults, required))
            first += robots
        return teams

    @property
    def team_of(self) -> npt.NDArray[np.int64]:
        """Which one of `teams` each robot is of, (n,), from 0; all 0 where there is one team alone."""
        sizes = [len(team.robots) for team in self.teams] or [self.robots]
        return np.repeat(np.arange(len(sizes)), sizes)

    @property
    def required_degrees(self) -> npt.NDArray[np.int64]:
        """How many neighbours each robot must keep, (n,): F' of its team, or where there are ranks as many of those that count for it."""
        return np.array(self._native.required_degrees())

    @property
    def ranks(self) -> npt.NDArray[np.int64] | None:
        """The rank of each robot, (n,), or None where there are no ranks (docs/ranks.md)."""
        ranks = self._native.ranks()
        return None if ranks is None else np.array(ranks)

    @property
    def malicious(self) -> list[int]:
        """Numbers of malicious robots, from 1."""
        return self._native.malicious

    @property
    def is_malicious(self) -> npt.NDArray[np.bool_]:
        """Which robots are malicious, (n,)."""
        return np.isin(np.arange(1, self.robots + 1), self.malicious)

    @property
    def dimension(self) -> int:
        """D, 2 or 3."""
        return self._native.dimension

    @property
    def duration_s(self) -> float:
        """Length of the run, s."""
        return self._native.duration_s

    @property
    def tick_s(self) -> float:
        """tau_1, s."""
        return self._native.tick_s

    @property
    def ticks(self) -> int:
        """Steps of tau_1 in the run; a record has T = ticks + 1 rows."""
        return self._native.ticks

    @property
    def ticks_per_round(self) -> int:
        """Ticks from one consensus round to the next."""
        return self._native.ticks_per_round

    @property
    def controller(self) -> str:
        """Name of the controller."""
        return self._native.controller

    @property
    def radius_m(self) -> float:
        """R, how far a link reaches, m."""
        return self._native.radius_m

    @property
    def distance_min_m(self) -> float:
        """Delta_d, how near two robots may come, m."""
        return self._native.distance_min_m

    @property
    def speed_max_m_s(self) -> Floats:
        """Upper corner of the input box, (D,), m/s."""
        return np.array(self._native.speed_max_m_s)

    @property
    def expect(self) -> list[Law]:
        """Laws that the run must not break."""
        return self._native.expect

    @property
    def positions(self) -> Floats:
        """Where robots start, (n, D), m."""
        return self._native.positions()

    @property
    def obstacles(self) -> Floats:
        """What stands in the way, listed or drawn, (k, 2 D + 1), m: both ends of a segment and how far the obstacle reaches around it.
        Both ends of a disc are its centre; a wall reaches nowhere."""
        return self._native.obstacles()

    @property
    def values(self) -> Floats:
        """Initial values y_i, (n,)."""
        return self._native.values()

    def run(
        self,
        *,
        desired: Callable[[World], npt.ArrayLike] | None = None,
        controller: Callable[[World], npt.ArrayLike] | None = None,
        levels: Callable[[World], npt.ArrayLike] | None = None,
        values: Callable[[World], npt.ArrayLike] | None = None,
        record: bool = True,
        robustness: bool = True,
        progress: Progress = None,
    ) -> Run:
        """Runs it from the first tick to the last. The same scenario gives the same bits everywhere, here and on the command line.

        Parameters
        ----------
        desired : function of a World, optional
            Called once a tick for the whole team: where robots want to go, (n, D), m/s, in place of the scenario's motion.
        controller : function of a World, optional
            Called once a tick for the whole team: the velocities, (n, D), m/s, in place of the scenario's controller; they are
            cut to the input box. `world.desired` is what robots want. Links, values, liars and laws stay; the run is one under
            the controller `none`.
        levels, values : functions of a World, optional
            Called once a tick: what malicious robots tell everybody of their level c_i and of their value y_i, (n,). Entries of
            normal robots are not used.
        record : bool
            Keep every tick. Without, only the summary is there.
        robustness : bool
            Search the network of every consensus round for its exact robustness (teams of up to 128).
        progress : bool, None or function
            A bar: True, False, None (shown if the run takes more than a second), or a function of done and total ticks.

        Raises
        ------
        Error
            If a function gives an array of another shape, or numbers that are not finite.
        KeyboardInterrupt
            Within a twentieth of a second. Long calls let other threads of Python run.
        """
        scenario = self if controller is None else self.under("none")
        world = World(scenario, record=record, robustness=robustness)
        asked = desired is not None or controller is not None or levels is not None or values is not None
        with bar(progress, self.ticks + 1, self.name, "tick") as tell:
            while not world.is_over:
                if asked:
                    want = None if desired is None else desired(world)
                    if controller is not None:
                        world._want(want)
                        want = controller(world)
                    told, said = levels and levels(world), values and values(world)
                    world.step(desired=want, levels=told, values=said)
                else:
                    world._native.advance(_SLICE_S)
                tell(world.tick)
        return world.finish()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scenario) and self._native == other._native

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[type[Scenario], tuple[str]]:
        return (Scenario, (self.text,))

    def __repr__(self) -> str:
        teams = f" of {len(self.teams)} teams" if self.teams else ""
        team = f"{self.robots} robots{teams}, F = {self.faults}, {len(self.malicious)} malicious"
        return f"<Scenario {self.name!r}: {team}, {self.controller}, {self.duration_s:g} s, seed {self.seed}>"
