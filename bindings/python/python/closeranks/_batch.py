"""Many worlds of one scenario, stepped together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._native import Batch as NativeBatch
from closeranks._run import Violation, violations
from closeranks._scenario import Scenario
from closeranks._types import Floats, flat


class Batch:
    """B worlds that differ in their seeds alone, stepped together on all cores while Python waits outside of its lock.

    World b has the bits of `World(scenario.replace(seed=seeds[b]))`. Arrays begin with the world: (B, n, D) where those of a `World`
    are (n, D), and mean the same. They are copies. Six or more worlds of `composed` or `links` are computed side by side, sixteen together
    on a core; others one by one, each on any core.

    Parameters
    ----------
    scenario : Scenario
        What to run.
    seeds : sequence of int
        One for each world.
    jobs : int, optional
        Threads; by default one a core. No bit depends on it.

    >>> batch = Batch(Scenario(duration_s=1.0), range(4))
    >>> batch.step(desired=np.zeros((4, 11, 2)), ticks=10)
    >>> batch.tick, batch.positions.shape
    (10, (4, 11, 2))
    """

    __slots__ = ("_native", "_scenario", "_seeds")
    _native: NativeBatch
    _scenario: Scenario
    _seeds: list[int]

    def __init__(self, scenario: Scenario, seeds: Sequence[int], *, jobs: int | None = None) -> None:
        self._scenario, self._seeds = scenario, [int(seed) for seed in seeds]
        if not self._seeds:
            raise _native.Error("`seeds` is empty, allowed is one for each world")
        if jobs is not None and jobs < 1:
            raise _native.Error(f"`jobs` is {jobs}, allowed is 1 or more")
        self._native = _native.Batch(scenario._native, self._seeds, jobs or 0)

    def step(
        self,
        *,
        desired: npt.ArrayLike | None = None,
        levels: npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
        ticks: int = 1,
    ) -> None:
        """Computes the next tick of every world, or the next `ticks` ticks with the same arrays, but none beyond the scenario's end.

        Parameters
        ----------
        desired : array (B, n, D), m/s
            Where robots want to go.
        levels : array (B, n)
            What malicious robots tell of their level c_i; entries of normal robots are not used.
        values : array (B, n)
            What malicious robots tell of their value y_i in a round, at most 1e300; entries of normal robots are not used.
        ticks : int
            How many ticks.

        Raises
        ------
        Error
            If an array has another shape or numbers that are not finite; no world moves then.
        """
        if ticks < 1:
            raise _native.Error(f"`ticks` is {ticks}, allowed is 1 or more")
        many, robots = len(self._seeds), self._scenario.robots
        want = flat("desired", desired, (many, robots, self._scenario.dimension))
        told, said = flat("levels", levels, (many, robots)), flat("values", values, (many, robots))
        self._native.step(want, told, said, ticks)

    @property
    def scenario(self) -> Scenario:
        """What is run, but for the seed."""
        return self._scenario

    @property
    def seeds(self) -> list[int]:
        """The seed of each world."""
        return list(self._seeds)

    @property
    def tick(self) -> int:
        """Number of the tick that is computed next: how many were computed."""
        return self._native.ticks_done

    @property
    def is_over(self) -> bool:
        """True once the last tick of the scenario was computed."""
        return self._native.is_over

    @property
    def positions(self) -> Floats:
        """x_i now, (B, n, D), m."""
        return self._vectors(self._native.positions())

    @property
    def desired(self) -> Floats:
        """Where robots want to go now by the scenario, (B, n, D), m/s."""
        return self._vectors(self._native.desired())

    @property
    def velocities(self) -> Floats:
        """u_i since the last tick, (B, n, D), m/s; 0 before the first."""
        return self._vectors(self._native.velocities())

    @property
    def degree(self) -> npt.NDArray[np.uint16]:
        """delta_i in the last tick, (B, n)."""
        return self._native.degree().reshape(len(self._seeds), -1)

    @property
    def h(self) -> Floats:
        """h_i as the controller has it in the last tick, (B, n)."""
        return self._numbers(self._native.h())

    @property
    def levels(self) -> Floats:
        """True levels c_i in the last tick, (B, n)."""
        return self._numbers(self._native.levels())

    @property
    def values(self) -> Floats:
        """y_i as robots hold it, (B, n), malicious or not."""
        return self._numbers(self._native.values())

    @property
    def values_told(self) -> Floats:
        """y_i as told, (B, n)."""
        return self._numbers(self._native.values_told())

    @property
    def is_up(self) -> npt.NDArray[np.bool_]:
        """Which robots ran in the last tick, (B, n). All before the first."""
        phi = self._numbers(self._native.phi())
        return ~np.isnan(phi) if self.tick else np.ones_like(phi, dtype=bool)

    def violations(self, world: int) -> list[Violation]:
        """Laws that were broken so far in a world, expected to hold or not."""
        return violations(self._native.laws(world))

    def __len__(self) -> int:
        return len(self._seeds)

    def __repr__(self) -> str:
        return f"<Batch of {len(self)} worlds of {self._scenario.name!r} before tick {self.tick} of {self._scenario.ticks}>"

    def _vectors(self, flat: Floats) -> Floats:
        return flat.reshape(len(self._seeds), self._scenario.robots, self._scenario.dimension)

    def _numbers(self, flat: Floats) -> Floats:
        return flat.reshape(len(self._seeds), self._scenario.robots)
