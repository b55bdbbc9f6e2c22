"""The filter on the Robotarium: unicycles with wheels that turn only so fast, in the simulator of Georgia Tech's testbed.

Eight robots stand in a patch; those in the east want to go west, and the others east, through each other. The filter moves a point 6 cm ahead of each robot's axle, which
can go anywhere at once; points that stay 0.24 m apart keep the robots, 0.11 m wide, apart. The simulator counts collisions, wheels that
are too fast, and robots outside of the arena. Needs `pip install robotarium-python-simulator`. The same script is what the testbed takes.

    python bindings/python/examples/on_robotarium.py
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from rps.robotarium import Robotarium

import closeranks as cr

AHEAD_M, TICK_S, STEPS, N, RADIUS_M = 0.06, 0.033, 450, 8, 0.9
SCENARIO = cr.Scenario(
    duration_s=TICK_S * STEPS,
    team={"robots": N, "faults": 1},
    link={"radius_m": RADIUS_M},
    clock={"tau_1_s": TICK_S, "tau_2_s": 3 * TICK_S},
    controller={
        "kind": "budget",
        "distance_min_m": 0.24,
        "input_min_m_s": [-0.1, -0.1],
        "input_max_m_s": [0.1, 0.1],
        "tracking_error_m": 0.005,  # the way of a robot in a step is a chord where the point's is an arc
    },
    start={"kind": "hexagon", "spacing_m": 0.32},
)
WISH = np.where(SCENARIO.positions[:, :1] > 0.0, [[-0.1, 0.0]], [[0.1, 0.0]])
Array = npt.NDArray[np.float64]


def safe(robots: list[cr.Robot], time_s: float, points: Array) -> Array:
    """Safe velocities of the points: every robot senses, tells, hears, and decides."""
    for robot in robots:
        robot.sense(time_s, points[robot.id - 1])
        others = [other for other in range(1, N + 1) if other != robot.id]
        away = np.linalg.norm(points - points[robot.id - 1], axis=1)
        for other in others:
            if away[other - 1] <= RADIUS_M:
                robot.observe(other, points[other - 1])
    told = [(robot.id, robot.share()) for robot in robots]
    for robot in robots:
        robot.receive_all((other, message) for other, message in told if message is not None and other != robot.id)
    return np.stack([robot.tick(WISH[robot.id - 1]).velocity for robot in robots])


def play(with_filter: bool) -> tuple[dict[str, int], int]:
    """Fifteen seconds: what the simulator found wrong, and the least degree of a normal robot."""
    start = SCENARIO.positions
    facing = np.arctan2(WISH[:, 1], WISH[:, 0])
    ahead = AHEAD_M * np.stack([np.cos(facing), np.sin(facing)], axis=1)
    poses = np.vstack([(start - ahead).T, facing])
    arena = Robotarium(number_of_robots=N, show_figure=False, sim_in_real_time=False, initial_conditions=poses)
    robots = [cr.Robot(SCENARIO, number, SCENARIO.values[number - 1]) for number in range(1, N + 1)]
    before, least = dict(arena._validate()), N
    for step in range(STEPS):
        x, y, heading = arena.get_poses()
        along = np.stack([np.cos(heading), np.sin(heading)], axis=1)
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        points = np.stack([x, y], axis=1) + AHEAD_M * along
        distances = np.linalg.norm(points[:, None] - points[None], axis=2)
        least = min(least, int(((distances <= RADIUS_M).sum(axis=1) - 1)[1:].min()))
        moves = safe(robots, step * TICK_S, points) if with_filter else WISH
        arena.set_velocities(np.arange(N), np.stack([(moves * along).sum(axis=1), (moves * across).sum(axis=1) / AHEAD_M]))
        arena.step()
    arena.call_at_scripts_end()
    # The simulator keeps one count for all its runs in a process.
    wrong = {name: count - before.get(name, 0) for name, count in arena._errors.items() if isinstance(count, int)}
    return {name: count for name, count in wrong.items() if count}, least


if __name__ == "__main__":
    plt.switch_backend("agg")
    for name, with_filter in (("unfiltered", False), ("with closeranks", True)):
        wrong, least = play(with_filter)
        print(f"{name}: {wrong.get('collision', 0)} collisions, {wrong.get('boundary', 0)} steps outside, {wrong.get('actuator', 0)} with wheels too fast, least degree {least}")
