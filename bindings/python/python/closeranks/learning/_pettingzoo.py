"""A team as a PettingZoo parallel environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
import numpy.typing as npt
from pettingzoo import ParallelEnv

from closeranks._native import Error
from closeranks._scenario import Scenario
from closeranks.learning._episode import BOUND, Episode, Observations, Options

if TYPE_CHECKING:
    from typing_extensions import Unpack


class ParallelTeam(ParallelEnv[str, Observations, npt.NDArray[np.float32]]):
    """One agent a normal robot, `robot_3` and so on. `Episode` says what they see and earn, and has the parameters.

    Actions are where a robot wants to go, (D,), each number in [-1, 1] times the greatest speed. An episode is truncated at the end
    of the scenario. A robot that crashed stays an agent: its action is not used and it earns nothing until it returns, and
    `infos[agent]["is_up"]` is False for as long, by which learners mask it.
    """

    metadata: dict[str, Any] = {"name": "closeranks_v0", "render_modes": []}

    def __init__(self, scenario: Scenario, **options: Unpack[Options]) -> None:
        self.episode = Episode(scenario, **options)
        self.possible_agents = [f"robot_{robot}" for robot in self.episode.robots]
        self.agents: list[str] = []
        self.render_mode = None
        shape = (self.episode.size,)
        self.observation_spaces = {
            agent: gymnasium.spaces.Box(-BOUND, BOUND, shape, np.float32) for agent in self.possible_agents
        }
        self.action_spaces = {
            agent: gymnasium.spaces.Box(-1.0, 1.0, (scenario.dimension,), np.float32) for agent in self.possible_agents
        }
        self._random = np.random.default_rng(scenario.seed)

    def observation_space(self, agent: str) -> gymnasium.spaces.Space[Observations]:
        """What the agent can see."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> gymnasium.spaces.Space[npt.NDArray[np.float32]]:
        """What the agent can do."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observations], dict[str, dict[str, Any]]]:
        """Begins an episode. The same seed gives the same one; without, the next of the sequence."""
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self.agents = list(self.possible_agents)
        seen = self.episode.begin(int(self._random.integers(1 << 31)))
        return dict(zip(self.agents, seen, strict=True)), self._infos()

    def step(
        self, actions: dict[str, npt.NDArray[np.float32]]
    ) -> tuple[
        dict[str, Observations], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]
    ]:
        """Holds the actions for a step. An agent without an action wants to stay where it is."""
        if not self.agents:
            raise Error("the episode is over, allowed is reset()")
        still = np.zeros(self.episode.scenario.dimension)
        seen, earned, over = self.episode.act([actions.get(agent, still) for agent in self.agents])
        agents = self.agents
        if over:
            self.agents = []
        return (
            dict(zip(agents, seen, strict=True)),
            dict(zip(agents, earned.tolist(), strict=True)),
            dict.fromkeys(agents, False),
            dict.fromkeys(agents, over),
            self._infos(),
        )

    def _infos(self) -> dict[str, dict[str, Any]]:
        return {agent: {"is_up": bool(up)} for agent, up in zip(self.possible_agents, self.episode.is_up, strict=True)}

    def render(self) -> None:
        """Nothing: `closeranks.plots` draws runs."""

    def close(self) -> None:
        """Nothing is held open."""
