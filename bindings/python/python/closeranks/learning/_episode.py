"""What all environments have in common: a world, goals, what robots see, and what they earn."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt

from closeranks._native import Error
from closeranks._scenario import Scenario
from closeranks._types import Floats
from closeranks._world import World

Observations: TypeAlias = npt.NDArray[np.float32]
"""What robots see, one row each."""

BOUND = 10.0
"""No number of an observation is larger than this."""


class Options(TypedDict, total=False):
    """What an `Episode` takes besides its scenario; environments hand it on."""

    ticks_per_step: int
    goal_radius_m: float | None
    reward: Callable[[Episode], npt.ArrayLike] | None


class Episode:
    """One team from start to end.

    Every normal robot gets a goal, drawn evenly from the ball of `goal_radius_m` around the middle of the start. A robot earns the
    metres by which it came nearer to its goal in a step.

    What robot i sees, all numbers cut to 10 in magnitude: the offset to its goal in units of R (D numbers), its velocity in units
    of the greatest speed (D), h_i, its degree margin, whether it is up (1) or down (0), and for every other robot in order of
    numbers the offset in units of R (D) and a 1 if it is within R, else zeros.

    Parameters
    ----------
    scenario : Scenario
        The team, its controller, its liars and its faults; its motion is used for malicious robots alone.
    ticks_per_step : int
        Ticks for which an action is held.
    goal_radius_m : float, optional
        2 R by default, farther than a team can spread.
    reward : function of an Episode, optional
        What each robot of the team earns in a step, (n,), in place of the metres.
    """

    def __init__(
        self,
        scenario: Scenario,
        *,
        ticks_per_step: int = 10,
        goal_radius_m: float | None = None,
        reward: Callable[[Episode], npt.ArrayLike] | None = None,
    ) -> None:
        if ticks_per_step < 1:
            raise Error(f"ticks_per_step is {ticks_per_step}, allowed is 1 or more")
        self.scenario, self.ticks_per_step = scenario, ticks_per_step
        self.goal_radius_m = 2.0 * scenario.radius_m if goal_radius_m is None else goal_radius_m
        self._reward = reward
        self.robots: list[int] = [robot for robot in range(1, scenario.robots + 1) if robot not in scenario.malicious]
        """Numbers of the robots that a policy moves."""
        if not self.robots:
            raise Error("every robot is malicious, allowed is a team with a normal one")
        self._normal = np.array(self.robots) - 1
        self._seed = scenario.seed
        self.begin(scenario.seed)

    @property
    def size(self) -> int:
        """Numbers in what one robot sees."""
        return 2 * self.scenario.dimension + 3 + (self.scenario.robots - 1) * (self.scenario.dimension + 1)

    def begin(self, seed: int) -> Observations:
        """Begins anew; the seed decides the scenario's draws and the goals. What each normal robot sees, (m, size)."""
        self._seed = seed
        self.world = World(self.scenario.replace(seed=seed))
        random, positions = np.random.default_rng(seed), self.world.positions
        ways = random.normal(size=positions.shape)
        far = self.goal_radius_m * random.uniform(size=len(positions)) ** (1.0 / self.scenario.dimension)
        self.goals: Floats = positions.mean(axis=0) + ways * (far / np.linalg.norm(ways, axis=1))[:, None]
        """Where robots want to be, (n, D), m; those of malicious robots are not used."""
        self.before: Floats = positions
        """Where robots were before the last step, (n, D), m."""
        return self.observe()

    def act(self, actions: npt.ArrayLike) -> tuple[Observations, Floats, bool]:
        """Holds `actions`, (m, D), each number in [-1, 1] times the greatest speed, for a step. What normal robots see, what they
        earned, (m,), and whether the episode is over."""
        given = np.asarray(actions, dtype=np.float64).reshape(len(self.robots), self.scenario.dimension)
        speeds = self.scenario.speed_max_m_s * np.clip(given, -1.0, 1.0)
        self.before = self.world.positions
        for _ in range(self.ticks_per_step):
            if self.is_over:
                break
            desired = self.world.desired
            desired[self._normal] = speeds
            self.world.step(desired=desired)
        return self.observe(), self.rewards()[self._normal], self.is_over

    @property
    def is_over(self) -> bool:
        """True once every tick of the scenario was computed and robots are where it ends."""
        return self.world.tick >= self.scenario.ticks

    def rewards(self) -> Floats:
        """What each robot earned in the last step, (n,); nothing while it is down."""
        if self._reward is not None:
            return np.asarray(self._reward(self), dtype=np.float64)
        was, now = (np.linalg.norm(self.goals - there, axis=1) for there in (self.before, self.world.positions))
        return np.where(self.world.is_up, was - now, 0.0)

    @property
    def is_up(self) -> npt.NDArray[np.bool_]:
        """Which of the normal robots ran in the last tick, (m,)."""
        up: npt.NDArray[np.bool_] = self.world.is_up[self._normal]
        return up

    def observe(self) -> Observations:
        """What each normal robot sees, (m, size)."""
        world, scenario = self.world, self.scenario
        positions, radius_m = world.positions, scenario.radius_m
        offsets = (positions[None, :, :] - positions[:, None, :]) / radius_m
        near = np.linalg.norm(offsets, axis=2) <= 1.0
        seen = np.concatenate([np.where(near[:, :, None], offsets, 0.0), near[:, :, None]], axis=2)
        others = ~np.eye(scenario.robots, dtype=bool)
        rows = seen[others].reshape(scenario.robots, -1)
        margin = world.degree.astype(np.float64) - scenario.required_degrees
        goals, speeds = (self.goals - positions) / radius_m, world.velocities / scenario.speed_max_m_s
        own = np.column_stack([goals, speeds, world.h, margin, world.is_up])
        shown: Observations = np.clip(np.column_stack([own, rows])[self._normal], -BOUND, BOUND).astype(np.float32)
        return shown
