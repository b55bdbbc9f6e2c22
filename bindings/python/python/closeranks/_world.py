"""A team that is stepped from outside."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._native import World as NativeWorld
from closeranks._run import Run, Violation, violations
from closeranks._types import Floats, flat

if TYPE_CHECKING:
    from closeranks._scenario import Scenario


class World:
    """A team in its world, one tick after another.

    `positions` and `desired` are those of the tick that `step` computes next: where robots are now, and where they want to go.
    `velocities`, `degree`, `h`, `levels`, `told`, `values`, `values_told`, `outcomes` and `modes` are what the last tick came to. Arrays are
    copies: a world goes on, and what was read stays.

    Parameters
    ----------
    scenario : Scenario
        What to run.
    record : bool
        Keep every tick for `finish`.
    robustness : bool
        Search the network of every consensus round for its exact robustness.
    one_by_one : bool
        Compute robots one by one, with every message as bytes, where they could be computed at once: the same bits, slower.

    >>> from closeranks import Scenario
    >>> world = World(Scenario())
    >>> world.step(desired=np.zeros((11, 2)))
    >>> world.tick, world.velocities.shape
    (1, (11, 2))
    """

    __slots__ = ("_native", "_scenario", "_wanted")
    _native: NativeWorld
    _scenario: Scenario
    _wanted: Floats | None

    def __init__(
        self, scenario: Scenario, *, record: bool = False, robustness: bool = False, one_by_one: bool = False
    ) -> None:
        self._scenario = scenario
        self._native = _native.World(scenario._native, record, robustness, one_by_one)
        self._native.prepare()
        self._wanted = None

    def step(
        self,
        *,
        desired: npt.ArrayLike | None = None,
        levels: npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
    ) -> None:
        """Computes the next tick. What is not given is as the scenario says. A world can be stepped beyond its scenario's end.

        Parameters
        ----------
        desired : array (n, D), m/s
            Where robots want to go.
        levels : array (n,)
            What malicious robots tell of their level c_i; entries of normal robots are not used.
        values : array (n,)
            What malicious robots tell of their value y_i in a round, at most 1e300; entries of normal robots are not used.

        Raises
        ------
        Error
            If an array has another shape or numbers that are not finite; nothing moves then.
        """
        native, (robots, dimension) = self._native, (self._scenario.robots, self._scenario.dimension)
        want = flat("desired", desired, (robots, dimension))
        told, said = flat("levels", levels, (robots,)), flat("values", values, (robots,))
        native.step(want, told, said)
        self._wanted = None
        if not native.is_over:
            native.prepare()

    def finish(self) -> Run:
        """Ends the run; the world cannot be stepped any more.

        Raises
        ------
        Error
            If no tick was computed, or the world was finished before.
        """
        return Run(self._scenario, self._native.finish())

    def _want(self, desired: npt.ArrayLike | None) -> None:
        """What `desired` says until the next tick."""
        shape = (self._scenario.robots, self._scenario.dimension)
        wanted = flat("desired", desired, shape)
        self._wanted = None if wanted is None else wanted.reshape(shape)

    @property
    def scenario(self) -> Scenario:
        """What is run."""
        return self._scenario

    @property
    def tick(self) -> int:
        """Number of the tick that is computed next: how many were computed."""
        return self._native.ticks_done

    @property
    def time_s(self) -> float:
        """Time of that tick, s."""
        return self.tick * self._scenario.tick_s

    @property
    def is_over(self) -> bool:
        """True once the last tick of the scenario was computed."""
        return self._native.is_over

    @property
    def positions(self) -> Floats:
        """x_i now, (n, D), m."""
        return self._native.positions()

    @property
    def desired(self) -> Floats:
        """Where robots want to go now, (n, D), m/s."""
        return self._native.desired() if self._wanted is None else self._wanted.copy()

    @property
    def velocities(self) -> Floats:
        """u_i since the last tick, (n, D), m/s; 0 before the first."""
        return self._native.velocities()

    @property
    def degree(self) -> npt.NDArray[np.uint16]:
        """delta_i as robots sense it in the last tick, (n,)."""
        return self._native.degree()

    @property
    def h(self) -> Floats:
        """h_i as the controller has it in the last tick, (n,)."""
        return self._native.h()

    @property
    def levels(self) -> Floats:
        """Levels c_i as robots sense them in the last tick, (n,), before any lie."""
        return self._native.levels()

    @property
    def told(self) -> Floats:
        """Levels as told in the last tick, (n,)."""
        return self._native.told()

    @property
    def phi(self) -> Floats:
        """phi_i in the last tick, (n,), which the controller `composed` uses; NaN of a robot that is down."""
        return self._native.phi()

    @property
    def is_up(self) -> npt.NDArray[np.bool_]:
        """Which robots ran in the last tick, (n,): not those that crashed or missed it. All before the first."""
        return ~np.isnan(self._native.phi()) if self.tick else np.ones(self._scenario.robots, dtype=bool)

    @property
    def values(self) -> Floats:
        """y_i as robots hold it, (n,), malicious or not."""
        return self._native.values()

    @property
    def values_told(self) -> Floats:
        """y_i as told, (n,)."""
        return self._native.values_told()

    @property
    def outcomes(self) -> list[str]:
        """What the program of each robot found: "free", "active", "infeasible" or "recovering"."""
        return self._native.outcomes()

    @property
    def modes(self) -> list[str]:
        """What each robot says its answer is worth: "guaranteed", "hold", "stopped", or why it is degraded, such as "late"."""
        return self._native.modes()

    @property
    def violations(self) -> list[Violation]:
        """Laws that were broken so far, expected to hold or not; `composition` and `shares` are about phi, which `composed` alone uses."""
        return violations(self._native.laws())

    def __repr__(self) -> str:
        return f"<World of {self._scenario.name!r} before tick {self.tick} of {self._scenario.ticks}>"
