"""Worlds that are stepped, and functions of Python that take part in a run."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import closeranks as cr


def test_a_world_that_is_stepped_is_a_run() -> None:
    scenario = cr.Scenario(duration_s=0.5)
    world = cr.World(scenario, record=True, robustness=True)
    while not world.is_over:
        world.step()
    run = world.finish()
    assert (run.digest, run.summary) == (lambda whole: (whole.digest, whole.summary))(scenario.run(progress=False))


def test_what_a_world_shows_belongs_to_the_tick_that_comes() -> None:
    scenario = cr.Scenario(duration_s=0.1, controller={"kind": "budget"})
    run, world = scenario.run(progress=False), cr.World(scenario)
    for tick in range(20):
        assert (world.tick, world.time_s) == (tick, pytest.approx(0.005 * tick))
        assert np.array_equal(world.positions, run.positions[tick])
        world.step(desired=world.desired)
        assert np.array_equal(world.velocities, run.velocities[tick])
        assert np.array_equal(world.degree, run.degree[tick])
        assert np.array_equal(world.levels, run.levels[tick]) and np.array_equal(world.told, run.told[tick])
        assert np.array_equal(world.values, run.values[tick]) and np.array_equal(world.h, run.h[tick])
        assert np.array_equal(world.values_told, run.values_told[tick])
        assert set(world.outcomes) <= set(run.outcome_names) and len(world.modes) == 11
    assert world.violations == [] and world.scenario == scenario
    assert repr(world) == "<World of 'scenario' before tick 20 of 20>"


def test_a_robot_that_crashes_is_down_for_a_while() -> None:
    world = cr.World(cr.Scenario(duration_s=0.3, plant={"crash": {"robot": 4, "from_s": 0.1, "to_s": 0.2}}))
    assert world.is_up.all()
    down = []
    while not world.is_over:
        world.step()
        down.append((~world.is_up).nonzero()[0].tolist())
        assert np.isnan(world.phi).tolist() == (~world.is_up).tolist()
    assert [index for index, robots in enumerate(down) if robots] == list(range(20, 40))
    assert all(robots == [3] for robots in down[20:40])


def test_a_world_that_is_finished_early_is_a_short_run() -> None:
    world = cr.World(cr.Scenario(), record=True)
    with pytest.raises(cr.Error, match="no tick was computed"):
        world.finish()
    for _ in range(3):
        world.step()
    run = world.finish()
    assert run.positions.shape == (3, 11, 2)
    gyration = np.sqrt(((run.positions[-1] - run.positions[-1].mean(0)) ** 2).sum(1).mean())
    assert run.summary["gyration_m"] == pytest.approx(gyration, rel=1e-12)
    with pytest.raises(cr.Error, match="this world was finished, allowed is a new one"):
        world.step()


def test_the_papers_motion_in_python_gives_the_bits_of_rusts() -> None:
    scenario = cr.Scenario(duration_s=1.0)

    def four_ways(world: cr.World) -> np.ndarray:
        number = np.arange(1, 12)
        way, axis = -world.positions, (number > 5).astype(int)
        way[number - 1, axis] += np.where(number % 2 == 0, 100.0, -100.0)
        return way / np.sqrt(way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1])[:, None]

    assert scenario.run(desired=four_ways, progress=False).digest == scenario.run(progress=False).digest


def test_liars_in_python_tell_what_they_tell_in_rust() -> None:
    biased = cr.Scenario(duration_s=0.5, attack={"level": {"kind": "bias", "bias": -2.5}, "value": {"kind": "constant", "value": 7.0}})
    honest = cr.Scenario(duration_s=0.5, attack={"level": {"kind": "none"}, "value": {"kind": "none"}})
    theirs = biased.run(progress=False)
    ours = honest.run(levels=lambda world: theirs.told[world.tick], values=lambda world: np.full(11, 7.0), progress=False)
    assert np.array_equal(ours.positions, theirs.positions) and np.array_equal(ours.told, theirs.told)
    assert np.array_equal(ours.values, theirs.values)


def test_a_controller_in_python_is_one_among_others() -> None:
    scenario = cr.Scenario(duration_s=0.5)

    def as_they_like(world: cr.World) -> np.ndarray:
        return world.desired

    ours = scenario.run(controller=as_they_like, progress=False)
    assert ours.digest == scenario.under("none").run(progress=False).digest
    still = scenario.run(controller=as_they_like, desired=lambda world: np.zeros((11, 2)), progress=False)
    assert np.array_equal(still.positions[-1], scenario.positions)
    fast = scenario.run(controller=lambda world: np.full((11, 2), 9.0), progress=False)
    assert fast.velocities.max() == 1.5


def test_what_is_given_wrongly_is_named_and_nothing_moves() -> None:
    world = cr.World(cr.Scenario())
    for given, words in [
        ({"desired": np.zeros((11, 3))}, r"`desired` has the shape \(11, 3\), must have \(11, 2\)"),
        ({"levels": np.zeros(3)}, r"`levels` has the shape \(3,\), must have \(11,\)"),
        ({"levels": np.full(11, np.nan)}, "`levels` of robot 1 is not a finite number that can be told"),
        ({"values": np.full(11, 1e301)}, "`values` of robot 1 is not a finite number that can be told"),
    ]:
        with pytest.raises(cr.Error, match=words):
            world.step(**given)  # type: ignore[arg-type]
    assert world.tick == 0 and np.array_equal(world.positions, cr.Scenario().positions)
    with pytest.raises(ValueError, match="robot 4"):
        cr.Scenario().run(desired=lambda world: np.where(np.arange(22).reshape(11, 2) == 7, np.inf, 0.0), progress=False)


def test_an_exception_in_a_function_comes_out() -> None:
    with pytest.raises(ZeroDivisionError):
        cr.Scenario().run(desired=lambda world: 1 // 0, progress=False)  # type: ignore[return-value]


def test_progress_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    told: list[tuple[int, int]] = []
    cr.Scenario(duration_s=0.1).run(desired=lambda world: world.desired, progress=lambda done, total: told.append((done, total)))
    assert told == [(done, 21) for done in range(1, 22)]
    cr.Scenario(duration_s=0.1, name="shown").run(progress=True)
    assert "shown" in capsys.readouterr().err
    cr.Scenario(duration_s=0.1).run(progress=False)
    assert capsys.readouterr().err == ""


def test_two_runs_in_two_threads_are_two_runs() -> None:
    scenario = cr.Scenario(duration_s=1.0)
    digests: list[str] = []
    threads = [threading.Thread(target=lambda: digests.append(scenario.run(progress=False).digest)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(digests) == 3 and set(digests) == {scenario.run(progress=False).digest}
