"""A task for BenchMARL: its algorithms move the normal robots, and the filter stands below them from the first step on.

`CloseranksTask.PATROL.get_task(...)` is a task like those that BenchMARL ships. What agents see, do and earn is said by
`closeranks.learning.ParallelTeam`.

    pip install benchmarl pettingzoo gymnasium       # brings torch: some gigabytes
    python bindings/python/examples/learn_benchmarl.py [ITERATIONS]

trains MAPPO for so many iterations (20 by default) of 40 episodes on one core, prints what a robot earned in an episode of the first and of the
last, what it earns by going straight to its goal, and how often laws were broken meanwhile, and writes benchmarl.svg.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import torch
from benchmarl.algorithms import MappoConfig
from benchmarl.environments.common import Task, TaskClass
from benchmarl.experiment import Experiment, ExperimentConfig
from benchmarl.models.mlp import MlpConfig
from torchrl.data import Composite
from torchrl.envs import EnvBase, PettingZooWrapper

import closeranks as cr
from closeranks.learning import Episode, ParallelTeam

STEPS, TICKS_PER_STEP = 20, 40
FIELDS: dict[str, Any] = {"duration_s": 4.0, "controller": {"kind": "budget"}}
MADE: list[ParallelTeam] = []
"""Every team that was made, so that their laws can be counted."""


class Team(ParallelTeam):
    """A team that counts the laws that were broken in all of its episodes."""

    broken = 0

    def step(self, actions: dict[str, Any]) -> Any:
        """As `ParallelTeam.step`."""
        told = super().step(actions)
        if not self.agents:
            self.broken += sum(law.expected for law in self.episode.world.violations)
        return told


class CloseranksTaskClass(TaskClass):
    """How BenchMARL makes environments, and what it may know of them. The fields of the task are those of a scenario."""

    def get_env_fun(
        self, num_envs: int, continuous_actions: bool, seed: int | None, device: Any
    ) -> Callable[[], EnvBase]:
        """Makes a team; BenchMARL puts many of them side by side."""
        fields = dict(self.config)
        ticks = fields.pop("ticks_per_step", TICKS_PER_STEP)

        def make() -> EnvBase:
            team = Team(cr.Scenario(**fields), ticks_per_step=ticks)
            MADE.append(team)
            return PettingZooWrapper(env=team, seed=seed, device=device, done_on_any=False)

        return make

    def supports_continuous_actions(self) -> bool:
        """Velocities are continuous,"""
        return True

    def supports_discrete_actions(self) -> bool:
        """and nothing else."""
        return False

    def has_render(self, env: EnvBase) -> bool:
        """`closeranks.plots` draws runs."""
        return False

    def max_steps(self, env: EnvBase) -> int:
        """Steps of an episode, and one to spare."""
        scenario = cr.Scenario(**{name: value for name, value in self.config.items() if name != "ticks_per_step"})
        return 1 + -(-scenario.ticks // self.config.get("ticks_per_step", TICKS_PER_STEP))

    def group_map(self, env: EnvBase) -> dict[str, list[str]]:
        """All normal robots are one group."""
        return env.group_map

    def observation_spec(self, env: EnvBase) -> Composite:
        """What robots see."""
        return self._only(env, "observation") or Composite()

    def info_spec(self, env: EnvBase) -> Composite | None:
        """Which robots run."""
        return self._only(env, "info")

    def _only(self, env: EnvBase, wanted: str) -> Composite | None:
        spec = env.observation_spec.clone()
        for group in self.group_map(env):
            for key in list(spec[group].keys()):
                if key != wanted:
                    del spec[group][key]
            if spec[group].is_empty():
                del spec[group]
        for key in set(spec.keys()) - set(self.group_map(env)):
            del spec[key]
        return None if spec.is_empty() else spec

    def action_spec(self, env: EnvBase) -> Composite:
        """Where robots want to go."""
        return env.full_action_spec

    def state_spec(self, env: EnvBase) -> Composite | None:
        """Nobody sees everything,"""
        return None

    def action_mask_spec(self, env: EnvBase) -> Composite | None:
        """and every action is allowed: the filter makes it safe."""
        return None

    @staticmethod
    def env_name() -> str:
        """The name of the environment."""
        return "closeranks"


class CloseranksTask(Task):
    """Tasks of this environment."""

    PATROL = None
    """Every normal robot gets a goal, and earns the metres by which it comes nearer."""

    @staticmethod
    def associated_class() -> type[TaskClass]:
        """What makes its environments."""
        return CloseranksTaskClass


def config(iterations: int, folder: str) -> ExperimentConfig:
    """A small experiment on one core."""
    made = ExperimentConfig.get_from_yaml()
    made.max_n_iters, made.max_n_frames, made.save_folder = iterations, None, folder
    made.loggers, made.create_json, made.render, made.evaluation = [], False, False, False
    made.on_policy_collected_frames_per_batch, made.on_policy_n_envs_per_worker = 40 * STEPS, 1
    made.on_policy_n_minibatch_iters, made.on_policy_minibatch_size, made.lr = 8, 200, 3e-4
    return made


class Earned(Experiment):
    """An experiment that remembers what robots earned."""

    rewards: list[float]

    def _on_batch_collected(self, batch: Any) -> None:
        super()._on_batch_collected(batch)
        self.__dict__.setdefault("rewards", []).append(float(batch["next", "robot", "reward"].mean()) * STEPS)


def straight(episodes: int) -> float:
    """What a robot earns in an episode in which all go straight to their goals, at full speed until they are near."""
    episode, total = Episode(cr.Scenario(**FIELDS), ticks_per_step=TICKS_PER_STEP), 0.0
    for seed in range(episodes):
        seen, over = episode.begin(seed), False
        while not over:
            seen, earned, over = episode.act(seen[:, :2])
            total += float(earned.mean())
    return total / episodes


def draw(rewards: list[float], best: float) -> None:
    """What robots earned in each iteration."""
    figure, axis = plt.subplots(figsize=(6, 3), layout="constrained")
    axis.plot(range(1, len(rewards) + 1), rewards, marker=".", label="MAPPO, mean of 40 episodes")
    axis.axhline(best, color="tab:grey", linewidth=0.8, label="straight to the goal")
    axis.axhline(0.0, color="black", linewidth=0.5)
    axis.xaxis.get_major_locator().set_params(integer=True)
    axis.set_xlabel("iteration")
    axis.set_ylabel("metres nearer to the goal")
    axis.legend(fontsize="small", loc="lower right")
    figure.savefig("benchmarl.svg", metadata={"Date": None})


def main(iterations: int) -> None:
    """Trains, prints and draws."""
    torch.set_num_threads(1)
    with tempfile.TemporaryDirectory() as folder:
        experiment = Earned(
            task=CloseranksTask.PATROL.get_task(FIELDS | {"ticks_per_step": TICKS_PER_STEP}),
            algorithm_config=MappoConfig.get_from_yaml(),
            model_config=MlpConfig.get_from_yaml(),
            critic_model_config=MlpConfig.get_from_yaml(),
            seed=0,
            config=config(iterations, folder),
        )
        experiment.run()
    first, last, best = experiment.rewards[0], experiment.rewards[-1], straight(100)
    print(f"a robot earned {first:+.3f} m in an episode of iteration 1, {last:+.3f} m in one of iteration {iterations}")
    print(f"straight to the goal: {best:+.3f} m")
    print(f"laws broken: {sum(team.broken for team in MADE)}")
    draw(experiment.rewards, best)


if __name__ == "__main__":
    plt.switch_backend("agg")
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
