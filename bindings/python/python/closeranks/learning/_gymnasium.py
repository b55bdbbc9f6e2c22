"""A team as a Gymnasium environment, and many side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from closeranks._native import Error
from closeranks._scenario import Scenario
from closeranks.learning._episode import BOUND, Episode, Observations, Options

if TYPE_CHECKING:
    from typing_extensions import Unpack


def _spaces(episode: Episode) -> tuple[Any, Any]:
    normal = len(episode.robots)
    seen = gymnasium.spaces.Box(-BOUND, BOUND, (normal, episode.size), np.float32)
    return seen, gymnasium.spaces.Box(-1.0, 1.0, (normal, episode.scenario.dimension), np.float32)


class Team(gymnasium.Env[Observations, npt.NDArray[np.float32]]):
    """One policy moves all m normal robots: actions (m, D), observations (m, size). `Episode` says what they see, and has the
    parameters; the reward is the mean of what they earn. `info["is_up"]`, (m,), says which robots did not crash."""

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, scenario: Scenario, *, render_mode: None = None, **options: Unpack[Options]) -> None:
        self.episode = Episode(scenario, **options)
        self.observation_space, self.action_space = _spaces(self.episode)
        self.render_mode = render_mode

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins an episode. The same seed gives the same one; without, the next of the sequence."""
        super().reset(seed=seed)
        seen = self.episode.begin(int(self.np_random.integers(1 << 31)))
        return seen, {"is_up": self.episode.is_up}

    def step(
        self, action: npt.NDArray[np.float32]
    ) -> tuple[Observations, float, bool, bool, dict[str, Any]]:
        """Holds the action for a step."""
        seen, earned, over = self.episode.act(action)
        return seen, float(earned.mean()), False, over, {"is_up": self.episode.is_up}


class VectorTeam(VectorEnv[Observations, npt.NDArray[np.float32], npt.NDArray[Any]]):
    """`num_envs` teams side by side, with the same numbers as Gymnasium's `SyncVectorEnv` of `Team`: an episode that is over
    begins anew in the next step, whose action is not used."""

    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}

    def __init__(self, scenario: Scenario, num_envs: int, **options: Unpack[Options]) -> None:
        if num_envs < 1:
            raise Error(f"num_envs is {num_envs}, allowed is 1 or more")
        self.teams = [Team(scenario, **options) for _ in range(num_envs)]
        self.num_envs, self.render_mode = num_envs, None
        self.single_observation_space, self.single_action_space = _spaces(self.teams[0].episode)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._over = np.zeros(num_envs, dtype=bool)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins an episode of every team; team i of the seed s has the seed s + i."""
        seeds = [seed + index for index in range(self.num_envs)] if isinstance(seed, int) else seed
        seeds = [None] * self.num_envs if seeds is None else seeds
        begun = [team.reset(seed=one) for team, one in zip(self.teams, seeds, strict=True)]
        self._over[:] = False
        return np.stack([seen for seen, _ in begun]), self._infos()

    def step(
        self, actions: npt.NDArray[np.float32]
    ) -> tuple[Observations, npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any], dict[str, Any]]:
        """Holds the actions, (num_envs, m, D), for a step."""
        seen, earned, over = [], np.zeros(self.num_envs), np.zeros(self.num_envs, dtype=bool)
        for index, (team, action) in enumerate(zip(self.teams, actions, strict=True)):
            if self._over[index]:
                seen.append(team.reset()[0])
            else:
                row, earned[index], _, over[index], _ = team.step(action)
                seen.append(row)
        self._over = over
        return np.stack(seen), earned, np.zeros(self.num_envs, dtype=bool), over.copy(), self._infos()

    def _infos(self) -> dict[str, Any]:
        up = np.stack([team.episode.is_up for team in self.teams])
        return {"is_up": up, "_is_up": np.ones(self.num_envs, dtype=bool)}
