"""The filter in VMAS: its vectorised dynamics, and its collision checker as the judge.

Four worlds at once, each with eleven round robots of 0.149 m radius that stand in a patch. By their numbers they want to go east, north,
west and south, through each other; in every world the four directions are dealt anew. VMAS moves bodies of 1 kg by forces, with drag, and
pushes apart those that touch. Each body is driven by the force that gives it the velocity it wants, or the one that its
`closeranks.Robot` allows. VMAS reckons in 32 bits, so the filter is told that bodies do not follow exactly (`tracking_error_m`).

    pip install vmas            # brings torch
    python bindings/python/examples/in_vmas.py

prints both, and writes vmas.png: where the robots of the first world went, from the states that VMAS reports.
"""

from __future__ import annotations

from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
import torch
from vmas import make_env
from vmas.simulator.core import Agent, Sphere, World
from vmas.simulator.scenario import BaseScenario

import closeranks as cr

Array = npt.NDArray[np.float64]

TICK_S, STEPS, WORLDS = 0.05, 100, 4
RADIUS_M, MASS_KG, DRAG, FORCE_MAX_N = 0.149, 1.0, 0.25, 100.0  # the filter keeps 0.3 m: bodies that just touch overlap
N = 11
START = cr.Scenario().positions
DIRECTIONS = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
WANTED = np.stack([DIRECTIONS[(np.arange(N) + world) % 4] for world in range(WORLDS)])
SCENARIO = cr.Scenario(
    duration_s=TICK_S * STEPS,
    clock={"tau_1_s": TICK_S, "tau_2_s": 2 * TICK_S},
    controller={"kind": "budget", "tracking_error_m": 1e-5},
    start={"kind": "listed", "positions_m": START},
)


class Patch(BaseScenario):
    """A patch of robots, as VMAS wants to be told of it."""

    def make_world(self, batch_dim: int, device: torch.device, **_: object) -> World:
        """A world of so many copies."""
        world = World(batch_dim, device, dt=TICK_S, drag=DRAG)
        for number in range(1, N + 1):
            name, shape = f"robot_{number}", Sphere(radius=RADIUS_M)
            world.add_agent(Agent(name=name, shape=shape, mass=MASS_KG, u_range=FORCE_MAX_N, collide=True, rotatable=False))
        return world

    def reset_world_at(self, env_index: int | None = None) -> None:
        """All robots at their starts, at rest."""
        for agent, place in zip(self.world.agents, START.tolist(), strict=True):
            agent.set_pos(torch.tensor(place), batch_index=env_index)

    def observation(self, agent: Agent) -> torch.Tensor:
        """Where it is."""
        return agent.state.pos

    def reward(self, agent: Agent) -> torch.Tensor:
        """Nothing: nobody learns here."""
        return torch.zeros(self.world.batch_dim)


class Played(NamedTuple):
    """What VMAS reports."""

    ways: Array
    """Where robots were, (steps + 1, worlds, n, 2), m."""
    collisions: int
    """Steps, worlds and pairs that its checker found to overlap."""


def filtered(robots: list[cr.Robot], time_s: float, here: Array, wish: Array) -> Array:
    """Safe velocities of one world: every robot senses, tells, hears, and decides."""
    ids = np.arange(1, N + 1)
    for robot in robots:
        others = ids != robot.id
        robot.sense(time_s, here[robot.id - 1])
        robot.observe_all(ids[others], here[others])
    told = [(robot.id, robot.share()) for robot in robots]
    for robot in robots:
        robot.receive_all((other, message) for other, message in told if message is not None and other != robot.id)
    return np.stack([robot.tick(wish[robot.id - 1]).velocity for robot in robots])


def state(world: World, name: str) -> Array:
    """`pos` or `vel` of every robot, (worlds, n, 2)."""
    return np.array(torch.stack([getattr(agent.state, name) for agent in world.agents], dim=1).tolist())


def overlapping(world: World) -> int:
    """Worlds and pairs whose bodies overlap."""
    agents = world.agents
    pairs = [(one, other) for index, one in enumerate(agents) for other in agents[:index]]
    return sum(int(world.is_overlapping(one, other).sum()) for one, other in pairs)


def play(with_filter: bool) -> Played:
    """Five seconds in VMAS."""
    env = make_env(scenario=Patch(), num_envs=WORLDS, device="cpu", continuous_actions=True, seed=0)
    values = SCENARIO.values
    teams = [[cr.Robot(SCENARIO, number, values[number - 1]) for number in range(1, N + 1)] for _ in range(WORLDS)]
    ways, collisions = [state(env.world, "pos")], 0
    for step in range(STEPS):
        moves = WANTED
        if with_filter:
            moves = np.stack([filtered(*one) for one in zip(teams, [step * TICK_S] * WORLDS, ways[-1], WANTED, strict=True)])
        forces = MASS_KG * (moves - (1.0 - DRAG) * state(env.world, "vel")) / TICK_S
        env.step([torch.tensor(forces[:, robot].tolist()) for robot in range(N)])
        ways.append(state(env.world, "pos"))
        collisions += overlapping(env.world)
    return Played(np.stack(ways), collisions)


def degree_min(ways: Array) -> int:
    """Least number of neighbours that a normal robot had in any world."""
    distances = np.linalg.norm(ways[..., :, None, :] - ways[..., None, :, :], axis=-1)
    return int(((distances <= SCENARIO.radius_m).sum(axis=-1) - 1)[..., 2:].min())


def main() -> None:
    """Plays both, and draws the first world."""
    figure, axes = plt.subplots(1, 2, figsize=(7, 3.5), sharex=True, sharey=True, layout="constrained")
    for axis, with_filter in zip(axes, (False, True), strict=True):
        played = play(with_filter)
        name = "with closeranks" if with_filter else "unfiltered"
        print(f"{name}: {played.collisions} collisions in {WORLDS} worlds, least degree {degree_min(played.ways)}")
        axis.plot(played.ways[:, 0, :, 0], played.ways[:, 0, :, 1], linewidth=0.8)
        axis.scatter(*played.ways[-1, 0].T, s=12, zorder=3)
        axis.set_title(f"{name}, first of {WORLDS} worlds", fontsize="medium")
        axis.set_aspect("equal")
    figure.savefig("vmas.png", dpi=120)


if __name__ == "__main__":
    plt.switch_backend("agg")
    main()
