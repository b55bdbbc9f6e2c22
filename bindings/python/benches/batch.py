"""Steps of many worlds from Python: a `World` after the other against one `Batch`, on one core.

    python bindings/python/benches/batch.py [WORLDS [TICKS [TURNS]]]

64 worlds, 100 ticks (a multiple of ten) and 7 turns by default. All get the wishes of every robot as arrays and are asked for all positions, in
every tick or in every tenth, as by a policy. Fewer than six worlds are not computed side by side. They take turns, and what is told is
processor time, which depends less than time on the clock on who else uses the machine: medians of all turns, and of the ratios within each.
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


def held(kind: str, worlds: int, size: int) -> Callable[[], None]:
    """The same of batches of `size` worlds, with wishes that are held for ten ticks."""
    parts = [range(first, min(first + size, worlds)) for first in range(0, worlds, size)]
    made, count = [cr.Batch(scenario(kind), seeds, jobs=1) for seeds in parts], iter(range(1 << 30))

    def tick() -> None:
        if next(count) % 10 == 0:
            for batch in made:
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
    ways = {
        "World.step, one by one": one_by_one,
        "Batch.step": together,
        "Batch.step of ten ticks": lambda kind, worlds: held(kind, worlds, worlds),
        "the same, four worlds a batch": lambda kind, worlds: held(kind, worlds, 4),
    }
    print(f"{worlds} worlds, {turns} turns of {ticks} ticks: processor time of a world's step, us, and how many times less than one by one")
    for kind in ("composed", "links", "budget"):
        turned = [[us(make(kind, worlds), worlds, ticks) for make in ways.values()] for _ in range(turns)]
        for place, way in enumerate(ways):
            own = statistics.median(turn[place] for turn in turned)
            gain = statistics.median(turn[0] / turn[place] for turn in turned)
            print(f"{kind:9} {way:30} {own:6.2f}  {gain:.2f}")


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    main(*given, *(64, 100, 7)[len(given) :])
