"""The filter in another simulator, ir-sim: its bodies, its clock, and its collision checker as the judge.

Eleven round robots of 0.149 m radius stand in a patch. By their numbers they want to go east, north, west and south, through each other.
Without a filter they collide, and then the network breaks. With one `closeranks.Robot` each neither happens. Needs `pip install ir-sim`.

    python bindings/python/examples/in_irsim.py

prints both, and writes irsim.png: where robots went, drawn from the states that ir-sim reports.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import NamedTuple

import irsim
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

import closeranks as cr

TICK_S, STEPS, RADIUS_M, CENTRE_M = 0.05, 100, 0.149, 5.0  # the filter keeps 0.3 m: bodies that just touch count as colliding
N = 11
START = cr.Scenario().positions
DIRECTIONS = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
WISH = DIRECTIONS[np.arange(N) % 4]
SCENARIO = cr.Scenario(
    duration_s=TICK_S * STEPS,
    clock={"tau_1_s": TICK_S, "tau_2_s": 2 * TICK_S},
    controller={"kind": "budget"},
    start={"kind": "listed", "positions_m": START},
)
WORLD = f"""
world: {{height: 10, width: 10, step_time: {TICK_S}, collision_mode: unobstructed}}
robot:
  - number: {N}
    kinematics: {{name: omni}}
    shape: {{name: circle, radius: {RADIUS_M}}}
    vel_min: [-1.5, -1.5]
    vel_max: [1.5, 1.5]
    distribution: {{name: manual}}
    state: {(np.column_stack([START + CENTRE_M, np.zeros(N)])).round(9).tolist()}
"""


class Played(NamedTuple):
    """What ir-sim reports."""

    ways: npt.NDArray[np.float64]
    """Where robots were, (steps + 1, n, 2), m."""
    collisions: int
    """Steps and robots that its checker found to touch another."""


Array = npt.NDArray[np.float64]


def filtered(robots: list[cr.Robot], time_s: float, here: Array) -> list[Array]:
    """Safe velocities: every robot senses, tells, hears, and decides."""
    for robot in robots:
        robot.sense(time_s, here[robot.id - 1])
        for other in range(1, N + 1):
            if other != robot.id and np.linalg.norm(here[other - 1] - here[robot.id - 1]) <= SCENARIO.radius_m:
                robot.observe(other, here[other - 1])
    told = [(robot.id, robot.share()) for robot in robots]
    for robot in robots:
        robot.receive_all((other, message) for other, message in told if message is not None and other != robot.id)
    return [np.asarray(robot.tick(WISH[robot.id - 1]).velocity) for robot in robots]


def play(with_filter: bool) -> Played:
    """Five seconds in ir-sim."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "circle.yaml"
        file.write_text(WORLD)
        env = irsim.make(str(file), display=False, headless=True, log_level="ERROR")
    values = SCENARIO.values
    robots = [cr.Robot(SCENARIO, number, values[number - 1]) for number in range(1, N + 1)]
    ways, collisions = [], 0
    for step in range(STEPS + 1):
        here = np.stack([robot.state[:2, 0] for robot in env.robot_list]) - CENTRE_M
        ways.append(here)
        moves = filtered(robots, step * TICK_S, here) if with_filter else list(WISH)
        env.step([move.reshape(2, 1) for move in moves], action_id=list(range(N)))
        collisions += sum(robot.collision for robot in env.robot_list)
    env.end(0)
    return Played(np.stack(ways), collisions)


def degree_min(ways: Array) -> int:
    """Least number of neighbours that a normal robot had."""
    distances = np.linalg.norm(ways[:, :, None] - ways[:, None, :], axis=-1)
    return int(((distances <= SCENARIO.radius_m).sum(axis=2) - 1)[:, 2:].min())


def main() -> None:
    """Plays both, and draws the filtered one."""
    figure, axes = plt.subplots(1, 2, figsize=(7, 3.5), sharex=True, sharey=True, layout="constrained")
    for axis, with_filter in zip(axes, (False, True), strict=True):
        played = play(with_filter)
        name = "with closeranks" if with_filter else "unfiltered"
        print(f"{name}: {played.collisions} collisions, least degree {degree_min(played.ways)}")
        axis.plot(played.ways[:, :, 0], played.ways[:, :, 1], linewidth=0.8)
        axis.scatter(*played.ways[-1].T, s=12, zorder=3)
        axis.set_title(f"{name}: {played.collisions} collisions")
        axis.set_aspect("equal")
    figure.savefig("irsim.png", dpi=120)


if __name__ == "__main__":
    plt.switch_backend("agg")
    main()
