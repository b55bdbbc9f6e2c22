"""The filter alone."""

from __future__ import annotations

import numpy as np
import pytest

import closeranks as cr
from conftest import ROOT


def team(robots: int = 4, **fields: object) -> tuple[cr.Scenario, list[cr.Robot]]:
    scenario = cr.Scenario(team={"robots": robots, "faults": 1 if robots > 2 else 0, "malicious": []}, controller={"kind": "budget"}, **fields)
    return scenario, [cr.Robot(scenario, robot, value=10.0 * robot) for robot in range(1, robots + 1)]


def drive(scenario: cr.Scenario, robots: list[cr.Robot], ticks: int) -> tuple[np.ndarray, list[cr.Output]]:
    positions, ids = scenario.positions.copy(), np.arange(1, len(robots) + 1)
    outputs: list[cr.Output] = []
    for tick in range(ticks):
        sent = []
        for robot in robots:
            robot.sense(tick * scenario.tick_s, positions[robot.id - 1])
            others = ids != robot.id
            robot.observe_all(ids[others], positions[others])
            sent.append(robot.share())
        for robot in robots:
            inbox = [(sender, sent[sender - 1]) for sender in ids if sender != robot.id and sent[sender - 1]]
            assert robot.receive_all(inbox) == len(inbox)
        outputs = [robot.tick(positions[robot.id - 1]) for robot in robots]
        positions = positions + scenario.tick_s * np.array([output.velocity for output in outputs])
    return positions, outputs


def test_robots_that_drive_apart_stay_neighbours_and_agree() -> None:
    scenario, robots = team(start={"kind": "listed", "positions_m": [[0.0, 0.5], [0.5, 0.0], [0.0, -0.5], [-0.5, 0.0]]})
    positions, outputs = drive(scenario, robots, 1000)
    assert all(output.mode == "guaranteed" and output.reason is None for output in outputs)
    assert all(output.degree == 3 and output.degree_margin == 0 and output.h >= 0 for output in outputs)
    assert np.linalg.norm(positions[0] - positions[2]) > 1.5
    assert len({round(robot.value, 6) for robot in robots}) == 1
    assert 20 <= robots[0].value <= 30 and robots[0].neighbors == [2, 3, 4]
    assert outputs[0].phi is None and outputs[0].untold == 0 and outputs[0].told_age_max_s == pytest.approx(0.095)
    assert robots[1].told_level == outputs[1].level and robots[0].poll_at_s == pytest.approx(5.0)
    assert "mode=guaranteed" in repr(outputs[0]) and repr(robots[0]).startswith("<Robot 1: value")


def test_a_world_and_its_robots_give_the_same_velocities() -> None:
    scenario = cr.Scenario(controller={"kind": "budget"}, attack={"value": {"kind": "none"}}, duration_s=0.5)
    run = scenario.run(progress=False)
    robots = [cr.Robot(scenario, robot, value) for robot, value in enumerate(scenario.values, start=1)]
    for tick in range(100):
        sent = []
        for robot in robots:
            robot.sense(tick * scenario.tick_s, run.positions[tick, robot.id - 1])
            for other in range(1, 12):
                if other != robot.id:
                    robot.observe(other, run.positions[tick, other - 1])
            sent.append(robot.share())
        world = cr.World(scenario) if tick == 0 else world
        for robot in robots:
            told = [(sender, message) for sender, message in enumerate(sent, start=1) if message and sender != robot.id]
            assert robot.receive_all(told) == len(told)
        answers = [robot.tick(world.desired[robot.id - 1]) for robot in robots]
        world.step()
        assert np.array_equal(np.array([answer.velocity for answer in answers]), run.velocities[tick])
    assert answers[0].round is None or answers[0].round[0] >= 0


def follow(scenario: cr.Scenario) -> set[int]:
    """Moves robots that send bytes to each other beside the simulator, compares every tick, and returns the lengths of messages."""
    run, world = scenario.run(progress=False), cr.World(scenario)
    ids, lengths = np.arange(1, scenario.robots + 1), set()
    robots = [cr.Robot(scenario, id, value) for id, value in zip(ids, scenario.values)]
    for tick in range(scenario.ticks):
        sent, positions, wishes = {}, run.positions[tick], world.desired
        for robot in robots:
            others = ids != robot.id
            robot.sense(tick * scenario.tick_s, positions[robot.id - 1])
            robot.observe_all(ids[others], positions[others])
            sent[robot.id] = robot.share()
        told = [(sender, message) for sender, message in sent.items() if message]
        lengths |= {len(message) for _, message in told}
        for robot in robots:
            near = set(robot.neighbors)
            inbox = [(sender, message) for sender, message in told if sender in near]
            assert robot.receive_all(inbox) == len(inbox)
        answers = [robot.tick(wishes[robot.id - 1]) for robot in robots]
        world.step()
        assert np.array_equal([answer.velocity for answer in answers], run.velocities[tick])
        assert np.array_equal([answer.h for answer in answers], world.h)
        assert [answer.reason or answer.mode for answer in answers] == world.modes
        assert [robot.value for robot in robots] == world.values.tolist()
    return lengths


@pytest.mark.parametrize("robots", [2, 4])
@pytest.mark.parametrize("kind", ["links", "budget", "composed", "none"])
def test_robots_that_send_bytes_move_as_in_the_simulator(kind: str, robots: int) -> None:
    scenario = cr.Scenario(
        team={"robots": robots, "faults": robots // 4, "malicious": []},
        start={"kind": "listed", "positions_m": [[0.0, 0.5], [0.5, 0.0], [0.0, -0.5], [-0.5, 0.0]][:robots]},
        controller={"kind": kind},
        duration_s=2.0,
    )
    assert follow(scenario) == ({32 + 16 + 11 * (robots - 1)} if kind == "links" else {32})


def test_robots_with_ranks_move_as_in_the_simulator() -> None:
    scenario = cr.Scenario.from_file(ROOT / "scenarios" / "ranks.toml").replace(team={"malicious": []}, duration_s=0.6)
    assert max(follow(scenario)) > 32 + 16


def test_misuse_is_said() -> None:
    _, (robot, *_) = team()
    for call, error, words in [
        (lambda: robot.sense(0.0, [np.nan, 0.0]), cr.RobotError, "own position is not finite"),
        (lambda: robot.sense(-1.0, [0.0, 0.0]), cr.RobotError, "now_s is -1, allowed is a time from 0 on"),
        (lambda: robot.sense(0.0, [0.0]), cr.RobotError, "a vector of 1 numbers, must have 2"),
        (lambda: robot.observe(2, [0.0, 1.0]), cr.RobotError, "own position is unknown"),
        (lambda: robot.receive(2, b"CR"), cr.MessageError, "message of 2 bytes, must be 32"),
        (lambda: robot.receive(2, b"\0" * 32), cr.MessageError, "message does not begin with `CR`"),
    ]:
        with pytest.raises(error, match=words):
            call()
    assert robot.tick([1.0, 0.0]).mode == "stopped"
    robot.sense(1.0, [0.0, 0.0])
    assert (robot.observe(2, [0.0, 1.0]), robot.observe(3, [0.0, 9.0])) == ("neighbor", "out of range")
    for other, words in [(1, "observed itself"), (9, "observed a robot that is not one of 1 to n")]:
        with pytest.raises(cr.RobotError, match=words):
            robot.observe(other, [0.0, 1.0])
    with pytest.raises(cr.RobotError, match="time fell"):
        robot.sense(0.5, [0.0, 0.0])
    with pytest.raises(cr.RobotError, match="2 positions for 1 robots"):
        robot.observe_all([2], np.zeros((2, 2)))
    silent = robot.tick([1.0, 0.0])
    assert (silent.mode, silent.velocity.tolist()) == ("stopped", [0.0, 0.0])


def test_old_messages_and_strangers_are_refused() -> None:
    _, (one, two, *_) = team()
    for robot, place in ((one, 0.0), (two, 1.0)):
        robot.sense(0.0, [place, 0.0])
    two.observe(1, [0.0, 0.0])
    message = two.share()
    assert message is not None and len(message) == 32 and two.share() is None
    with pytest.raises(cr.MessageError, match="sender is not a neighbour"):
        one.receive(2, message)
    one.observe(2, [1.0, 0.0])
    one.share()
    one.receive(2, message)
    with pytest.raises(cr.MessageError, match="message is not newer than the last one"):
        one.receive(2, message)
    assert one.receive_all([(2, message), (2, b"")]) == 0


def test_a_robot_that_cannot_be_made_says_why() -> None:
    scenario = cr.Scenario()
    for make, words in [
        (lambda: cr.Robot(scenario, 12), "robot 12 is not one of 1 to 11"),
        (lambda: cr.Robot(scenario, -1), "robot -1 is not one of 1 to 11"),
        (lambda: cr.Robot(scenario, 1, float("nan")), "initial value is not a number of at most 1e300"),
        (lambda: cr.Robot(scenario, 1, neighbors=11), "neighbors is 11, allowed is 0 to 10"),
    ]:
        with pytest.raises(cr.RobotError, match=words):
            make()


def test_restart_and_restate() -> None:
    _, (robot, *_) = team()
    robot.sense(0.0, [0.0, 0.0])
    robot.share()
    robot.restate(5.0)
    assert robot.told_level == 5.0
    robot.restart(-3.0)
    assert (robot.value, robot.told_level, robot.neighbors, robot.discarded) == (-3.0, 0.0, [], [])


def test_strangers_are_kept_away_from_and_the_dismissed_are_forgotten() -> None:
    scenario, (robot, *_) = team()
    with pytest.raises(cr.RobotError, match="own position is unknown"):
        robot.observe_stranger(5, [0.0, 0.4])
    robot.sense(0.0, [0.0, 0.0])
    with pytest.raises(cr.RobotError, match=r"a robot of another team has a number that is not above n \(robot 4\)"):
        robot.observe_stranger(4, [0.0, 0.4])
    guest = cr.Robot(scenario, 1, 10.0, neighbors=3, strangers=1)
    guest.sense(0.0, [0.0, 0.0])
    for other, place in ((2, [0.6, 0.0]), (3, [-0.6, 0.0]), (4, [0.0, -0.6])):
        assert guest.observe(other, place) == "neighbor"
    assert guest.observe_stranger(5, [0.0, 0.31]) == "stranger"
    assert guest.neighbors == [2, 3, 4] and guest.strangers == [5]
    with pytest.raises(cr.RobotError, match="no slot is left for another neighbour"):
        guest.observe_stranger(9, [0.0, 0.9])
    robot.sense(0.1, [0.0, 0.0])
    told = (guest.share(), robot.share())
    with pytest.raises(cr.MessageError, match="sender is not a neighbour"):
        guest.receive(5, told[1] or b"")
    velocity = guest.tick([0.0, 5.0]).velocity
    assert velocity[1] * scenario.tick_s < 0.31 - scenario.distance_min_m + 1e-9
    guest.dismiss(3)
    guest.dismiss(5)
    assert guest.neighbors == [2, 4] and guest.strangers == []


def test_obstacles_of_the_scenario_stand_in_the_way() -> None:
    scenario = cr.Scenario(
        team={"robots": 2, "faults": 0, "malicious": []},
        start={"kind": "listed", "positions_m": [[0.0, 0.0], [-1.0, 0.0]]},
        controller={"kind": "budget"},
        obstacles={"clearance_m": 0.15, "discs": [[1.0, 0.0, 0.5]]},
    )
    robot, place = cr.Robot(scenario, 1), 0.0
    for tick in range(400):
        robot.sense(tick * scenario.tick_s, [place, 0.0])
        robot.observe(2, [place - 1.0, 0.0])
        robot.share()
        place += scenario.tick_s * robot.tick([1.0, 0.0]).velocity[0]
    assert 0.3 < place <= 1.0 - 0.5 - 0.15


def test_space_has_three_numbers() -> None:
    robot = cr.Robot(cr.Scenario(dimension=3), 1)
    robot.sense(0.0, [0.0, 0.0, 0.0])
    assert robot.tick([0.0, 0.0, 1.0]).velocity.shape == (3,)
