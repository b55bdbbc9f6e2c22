"""Worlds that are stepped together are those that are stepped alone."""

from __future__ import annotations

import numpy as np
import pytest

import closeranks as cr

SEEDS = [3, 1, 4, 1, 5, *range(20, 33)]  # of `composed` sixteen side by side, and two alone


@pytest.mark.parametrize("controller", ["composed", "budget", "links", "none"])
def test_every_world_has_the_bits_of_one_that_is_stepped_alone(controller: str) -> None:
    scenario = cr.Scenario(
        duration_s=0.4, controller={"kind": controller}, start={"kind": "random", "half_side_m": 1.3, "distance_min_m": 0.4}
    )
    batch = cr.Batch(scenario, SEEDS, jobs=2)
    worlds = [cr.World(scenario.replace(seed=seed)) for seed in SEEDS]
    assert np.array_equal(batch.positions[1], batch.positions[3]) and not np.array_equal(batch.positions[0], batch.positions[1])
    random = np.random.default_rng(0)
    assert np.array_equal(batch.desired, np.stack([world.desired for world in worlds])) and batch.is_up.all()
    while not batch.is_over:
        desired, levels = random.normal(size=(len(SEEDS), 11, 2)), random.normal(size=(len(SEEDS), 11))
        given = batch.tick // 20 % 2 == 0  # in turns with what the scenario says
        batch.step(desired=desired if given else None, levels=levels if given else None, ticks=20)
        for index, world in enumerate(worlds):
            for _ in range(20):
                if not world.is_over:
                    world.step(desired=desired[index] if given else None, levels=levels[index] if given else None)
        for name in ("positions", "velocities", "degree", "h", "levels", "values", "values_told", "is_up"):
            ours, theirs = getattr(batch, name), np.stack([getattr(world, name) for world in worlds])
            assert ours.shape == theirs.shape and ours.tobytes() == theirs.tobytes(), f"{name} in tick {batch.tick}"
    assert batch.tick == worlds[0].tick == scenario.ticks + 1
    assert [batch.violations(index) for index in range(len(SEEDS))] == [world.violations for world in worlds]


def test_what_is_said_of_a_batch() -> None:
    scenario = cr.Scenario(duration_s=0.1, plant={"crash": {"robot": 4, "from_s": 0.02, "to_s": 0.06}})
    batch = cr.Batch(scenario, range(3))
    assert (len(batch), batch.seeds, batch.scenario, batch.tick) == (3, [0, 1, 2], scenario, 0)
    assert repr(batch) == f"<Batch of 3 worlds of {scenario.name!r} before tick 0 of 20>"
    values = np.full((3, 11), 7.0)
    batch.step(values=values, ticks=6)
    assert not batch.is_up[:, 3].any() and batch.is_up.sum() == 30
    assert (batch.values_told[:, :2] == 7.0).all() and not (batch.values == 7.0).any()
    batch.step(ticks=100)
    assert batch.is_over and batch.tick == 21


def test_what_no_batch_takes_is_refused_and_moves_nobody() -> None:
    batch = cr.Batch(cr.Scenario(duration_s=0.1), [1, 2])
    before = batch.positions
    far, bad = np.zeros((2, 11, 2)), np.zeros((2, 11, 2))
    bad[1, 3, 0] = np.nan
    for words, call in [
        (r"`desired` has the shape \(11, 2\), must have \(2, 11, 2\)", lambda: batch.step(desired=far[0])),
        ("`desired` of robot 4 in world 1 is NaN", lambda: batch.step(desired=bad)),
        ("`values` of robot 2 in world 0 is 1e301", lambda: batch.step(values=np.eye(2, 11, 1) * 1e301)),
        ("`levels` has the shape", lambda: batch.step(levels=np.zeros(11))),
        ("`ticks` is 0, allowed is 1 or more", lambda: batch.step(ticks=0)),
        ("there is no world 2", lambda: batch.violations(2)),
        ("`seeds` is empty", lambda: cr.Batch(cr.Scenario(), [])),
        ("`jobs` is 0, allowed is 1 or more", lambda: cr.Batch(cr.Scenario(), [1], jobs=0)),
        ("robots", lambda: cr.Batch(cr.Scenario(start={"kind": "random", "half_side_m": 1.3, "distance_min_m": 2.0}), [1])),
    ]:
        with pytest.raises(cr.Error, match=words):
            call()
    assert batch.tick == 0 and np.array_equal(batch.positions, before)
