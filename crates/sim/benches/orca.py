"""Steps the C++ library of ORCA (RVO2, through the package pyrvo) with as many robots, as dense, as scenarios/swarm.toml has.

    python3 -m venv rvo && rvo/bin/pip install pyrvo==0.4.3
    valgrind --tool=callgrind --callgrind-out-file=/dev/null rvo/bin/python crates/sim/benches/orca.py 10000 23

Each robot looks at its ten nearest within 3 m and wants to go outwards at 1 m/s. Instructions of a step are those of 23 steps less
those of 3, over 20. Without valgrind it says the median of the times of a step. Set OMP_NUM_THREADS=1.
"""

import math
import statistics
import sys
import time

import pyrvo

SPACING_M, RADIUS_M, DISTANCE_MIN_M, STEP_S, HORIZON_S, SPEED_MAX_M_S = 1.4, 3.0, 0.3, 0.1, 2.0, 1.5


def lattice(robots: int) -> list[tuple[float, float]]:
    """The places of a hexagonal lattice that are nearest to the origin."""
    reach = math.ceil(math.sqrt(robots)) + 2
    places = []
    for row in range(-reach, reach + 1):
        for column in range(-reach, reach + 1):
            places.append((SPACING_M * (column + 0.5 * row), SPACING_M * math.sqrt(0.75) * row))
    places.sort(key=lambda place: (math.hypot(*place), place))
    return places[:robots]


def main() -> None:
    robots, steps = int(sys.argv[1]), int(sys.argv[2])
    world = pyrvo.RVOSimulator(
        STEP_S, RADIUS_M, 10, HORIZON_S, HORIZON_S, DISTANCE_MIN_M / 2, SPEED_MAX_M_S
    )
    for robot, (x, y) in enumerate(lattice(robots)):
        world.add_agent((x, y))
        size = math.hypot(x, y) or 1.0
        world.set_agent_pref_velocity(robot, (x / size, y / size))
    times_ms = []
    for _ in range(steps):
        begin = time.perf_counter()
        world.do_step()
        times_ms.append(1e3 * (time.perf_counter() - begin))
    print(f"{robots} robots, a step {statistics.median(times_ms):.3f} ms, the fastest {min(times_ms):.3f} ms")


if __name__ == "__main__":
    main()
