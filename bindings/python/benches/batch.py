"""Steps of many worlds from Python: a `World` after the other against one `Batch`, on one core.

    python bindings/python/benches/batch.py [WORLDS [TICKS [TURNS]]]

64 worlds, 100 ticks and 7 turns by default. Both get the wishes of every robot as arrays and read all positions in every tick, as a policy
would. They take turns, and what is told is processor time, which does not depend on who else uses the machine as much as time on the clock
does: medians of all turns, and of the ratios within each.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable

import numpy as np

import closeranks as cr


def scenario(kind: str) -> cr.Scenario:
    """The paper's team from drawn starts."""
    start = {"kind": "random", "half_side_m": 1.3, "distance_min_m": 0.4}
    return cr.Scenario(duration_s=10.0, controller={"kind": kind}, start=start)


def one_by_one(kind: str, worlds: int) -> Callable[[], None]:
    """A tick of worlds that are stepped one after another."""
    made = [cr.World(scenario(kind).replace(seed=seed)) for seed in range(worlds)]

    def tick() -> None:
        for world in made:
            world.step(desired=-world.positions)

    return tick


def together(kind: str, worlds: int) -> Callable[[], None]:
    """The same of a batch, on the thread that calls."""
    batch = cr.Batch(scenario(kind), range(worlds), jobs=1)
    return lambda: batch.step(desired=-batch.positions)


def held(kind: str, worlds: int) -> Callable[[], None]:
    """The same with wishes that are held for ten ticks, a tenth of it told."""
    batch, count = cr.Batch(scenario(kind), range(worlds), jobs=1), iter(range(1 << 30))

    def tick() -> None:
        if next(count) % 10 == 0:
            batch.step(desired=-batch.positions, ticks=10)

    return tick


def us(tick: Callable[[], None], worlds: int, ticks: int) -> float:
    """Processor time of a world's step, us."""
    began = time.process_time_ns()
    for _ in range(ticks):
        tick()
    return (time.process_time_ns() - began) / 1e3 / worlds / ticks


def main(worlds: int, ticks: int, turns: int) -> None:
    """Measures in turns and prints a row a controller."""
    print(f"{worlds} worlds, {turns} turns of {ticks} ticks: processor time of a world's step, us, and how many times less in a batch")
    for kind in ("composed", "links", "budget"):
        rows = []
        for _ in range(turns):
            ways = [make(kind, worlds) for make in (one_by_one, together, held)]
            rows.append([us(way, worlds, ticks) for way in ways])
        alone, batch, long = (statistics.median(column) for column in zip(*rows, strict=True))
        gains = [statistics.median(row[0] / row[way] for row in rows) for way in (1, 2)]
        print(f"{kind:9} one by one {alone:6.2f}, batch {batch:6.2f} ({gains[0]:.2f}), batch of ten ticks a call {long:6.2f} ({gains[1]:.2f})")


if __name__ == "__main__":
    main(*(int(word) for word in (sys.argv[1:] + ["64", "100", "7"][len(sys.argv) - 1 :])))
