"""Counts the instructions of a tick of teams of equal density, and draws them over the number of robots.

    cargo build --release -p closeranks-sim --example swarm
    python3 crates/sim/benches/swarm.py target/release/examples/swarm docs/pictures/swarm-cost.svg

Needs valgrind. A count is that of 23 ticks less that of 3, over 20, the engine alone: what comes before the third tick is
not in it. Instructions do not depend on what else the machine does.
"""

import math
import re
import subprocess
import sys

SCENARIO = "scenarios/swarm.toml"
ROBOTS = [100, 300, 1_000, 3_000, 10_000]
TICKS = (3, 23)
WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 560, 340, 84, 30, 32, 52
LOOKS = {"links": ("#17507F", ""), "budget": ("#C0562B", "7 4")}


def count(program: str, robots: int, ticks: int, controller: str) -> tuple[int, float]:
    """Instructions of so many ticks, and how many neighbours each robot has."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, SCENARIO]
    command += [str(robots), str(ticks), controller, "alone"]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    neighbors = re.match(r"([\d.]+) neighbours each", done.stdout)
    if collected is None or neighbors is None:
        sys.exit(f"no count in what {command} said:\n{done.stderr}{done.stdout}")
    return int(collected[1]), float(neighbors[1])


def measure(program: str) -> dict[str, list[tuple[int, float, float]]]:
    """For each controller robots, instructions a tick, and neighbours."""
    table: dict[str, list[tuple[int, float, float]]] = {}
    for controller in LOOKS:
        for robots in ROBOTS:
            few, many = (count(program, robots, ticks, controller) for ticks in TICKS)
            each = (many[0] - few[0]) / (TICKS[1] - TICKS[0])
            table.setdefault(controller, []).append((robots, each, many[1]))
            print(f"{controller:7} {robots:6} robots, {many[1]:4.1f} neighbours: {each / 1e6:8.3f} million a tick, "
                  f"{each / robots:6.0f} a robot, {each / robots / many[1]:5.0f} a neighbour", flush=True)
    return table


def draw(table: dict[str, list[tuple[int, float, float]]]) -> str:
    """Instructions a tick and robot over the number of robots, which is level where the cost is linear."""
    most = max(each / robots for rows in table.values() for robots, each, _ in rows)
    top = 2_000 * math.ceil(1.1 * most / 2_000)
    low, high = math.log10(ROBOTS[0]), math.log10(ROBOTS[-1])

    def x(robots: int) -> float:
        return LEFT + (WIDTH - LEFT - RIGHT) * (math.log10(robots) - low) / (high - low)

    def y(instructions: float) -> float:
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * instructions / top

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
             "<title>Instructions of a tick, for each robot, over the number of robots</title>",
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for step in range(5):
        value = top * step / 4
        parts.append(f'<path d="M{LEFT} {y(value):.1f}H{WIDTH - RIGHT}" stroke="#DDD"/>'
                     f'<text x="{LEFT - 8}" y="{y(value) + 4:.1f}" text-anchor="end">{value:,.0f}</text>')
    for robots in ROBOTS:
        parts.append(f'<text x="{x(robots):.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{robots:,}</text>')
    parts.append(f'<text x="{(LEFT + WIDTH) / 2:.0f}" y="{HEIGHT - 10}" text-anchor="middle">robots, at equal density</text>'
                 f'<text x="{LEFT}" y="{TOP - 12}">instructions a tick, for each robot</text>')
    for controller, (colour, dashes) in LOOKS.items():
        places = [(x(robots), y(each / robots)) for robots, each, _ in table[controller]]
        way = "L".join(f"{across:.1f} {down:.1f}" for across, down in places)
        parts.append(f'<path d="M{way}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>')
        parts += [f'<circle cx="{across:.1f}" cy="{down:.1f}" r="3.5" fill="{colour}"/>' for across, down in places]
        across, down = places[-1]
        parts.append(f'<text x="{across:.1f}" y="{down - 10:.1f}" text-anchor="end" fill="{colour}">{controller}</text>')
    return "\n".join([*parts, "</svg>", ""])


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    picture = draw(measure(sys.argv[1]))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(picture)


if __name__ == "__main__":
    main()
