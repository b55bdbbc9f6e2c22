"""Several teams in one space (docs/teams.md): runs, worlds, robots and figures."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import closeranks as cr
from conftest import ROOT

FILE = ROOT / "scenarios" / "teams.toml"


@pytest.fixture(scope="module")
def run() -> cr.Run:
    """Two teams that cross each other's way."""
    return cr.Scenario.from_file(FILE).run(progress=False)


def small(kind: str = "budget", **fields: object) -> cr.Scenario:
    """Three robots and two that look at each other, without liars."""
    near = {"kind": "listed", "positions_m": [[0.0, 0.0], [1.0, 0.0], [0.5, 0.8]]}
    far = {"kind": "listed", "positions_m": [[0.5, -0.9], [1.5, -0.9]]}
    teams = [
        {"name": "three", "robots": 3, "faults": 0, "malicious": [], "start": near, "motion": {"kind": "wander"}},
        {"name": "two", "robots": 2, "faults": 0, "malicious": [], "start": far, "values": {"kind": "random", "min": 7.0, "max": 8.0}},
    ]
    return cr.Scenario({"duration_s": 2.0, "seed": 5, "controller": {"kind": kind}, "teams": teams, **fields})


def test_a_scenario_says_who_is_of_which_team(run: cr.Run) -> None:
    scenario = run.scenario
    assert scenario.teams == [cr.Team("seven to the right", range(1, 8), 1, 4), cr.Team("five upwards", range(8, 13), 1, 3)]
    assert scenario.team_of.tolist() == [0] * 7 + [1] * 5 and scenario.malicious == [3, 9]
    assert scenario.required_degrees.tolist() == [4] * 7 + [3] * 5 and scenario.required_degree == 3
    assert scenario.robots == 12 and "12 robots of 2 teams" in repr(scenario)
    alone = cr.Scenario()
    assert alone.teams == [] and alone.team_of.tolist() == [0] * 11 and alone.required_degrees.tolist() == [7] * 11


def test_a_run_has_all_robots_and_says_what_each_team_came_to(run: cr.Run) -> None:
    assert run.ok and run.positions.shape == (701, 12, 2)
    assert np.array_equal(run.positions[0], run.scenario.positions) and np.array_equal(run.values[0], run.scenario.values)
    normal = ~run.scenario.is_malicious
    assert (run.degree >= run.scenario.required_degrees)[:, normal].all()
    for team, low, high in ((0, 0.0, 100.0), (1, -500.0, -400.0)):
        end = run.values[-1, normal & (run.scenario.team_of == team)]
        assert low <= end.min() and end.max() <= high and np.ptp(end) < 1.0
    assert [team["robots"] for team in run.summary["teams"]] == [7, 5]
    rows = str(run).split("\n\n")[0].splitlines()[-3:]
    assert [row.split("  ")[0] for row in rows] == ["two teams", "seven to the right", "five upwards"]
    assert "teams: robots 1 to 7 are `seven to the right` with F = 1, robots 8 to 12 are `five upwards` with F = 1" in str(run)


def test_robots_of_different_teams_have_no_links(run: cr.Run) -> None:
    apart = run.positions[:, :7, None, :] - run.positions[:, None, 7:, :]
    tick = int(np.linalg.norm(apart, axis=3).min(axis=(1, 2)).argmin())
    graph = run.links(tick)
    assert np.linalg.norm(apart[tick], axis=2).min() < run.scenario.radius_m
    assert {graph.nodes[robot]["team"] for robot in range(1, 8)} == {0}
    assert all(graph.nodes[one]["team"] == graph.nodes[other]["team"] for one, other in graph.edges)
    assert [graph.degree[robot] for robot in range(1, 13)] == run.degree[tick].tolist()


def test_teams_have_colours_in_figures_and_in_the_view(run: cr.Run) -> None:
    figure = run.plot()
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["seven to the right", "five upwards", "malicious"]
    axes = Figure().subplots()
    cr.plots.draw_formation(axes, run)
    normal = next(marks for marks in axes.collections if len(marks.get_offsets()) == 10)
    assert len({tuple(color) for color in np.asarray(normal.get_facecolors())}) == 2
    view = run.view(frames=3)
    assert view.team["required_degrees"] == [4] * 7 + [3] * 5 and view.team["team_of"] == [0] * 7 + [1] * 5


def test_a_world_of_teams_is_stepped_from_outside() -> None:
    scenario = small()
    together = scenario.run(desired=lambda world: np.array([1.0, 0.2]) - world.positions, progress=False)
    assert together.ok, together.violations
    apart = together.positions[:, :3, None, :] - together.positions[:, None, 3:, :]
    assert np.linalg.norm(apart, axis=3).min() >= scenario.distance_min_m
    pushed = scenario.run(controller=lambda world: np.array([1.0, 0.2]) - world.positions, progress=False)
    assert "distance" in {law.law for law in pushed.violations}
    with pytest.raises(cr.Error, match=r"`desired` has the shape \(3, 2\), must have \(5, 2\)"):
        cr.World(scenario).step(desired=np.zeros((3, 2)))


@pytest.mark.parametrize("kind", ["budget", "links"])
def test_robots_that_see_strangers_move_as_in_the_simulator(kind: str) -> None:
    scenario = small(kind)
    run, world, firsts = scenario.run(progress=False), cr.World(scenario), [team.robots[0] for team in scenario.teams]
    robots = [
        cr.Robot(scenario, number - first + 1, scenario.values[number - 1], team=team)
        for team, first in enumerate(firsts) for number in scenario.teams[team].robots
    ]
    met = 0
    for tick in range(scenario.ticks):
        sent = []
        for index, robot in enumerate(robots):
            mine, positions = scenario.teams[scenario.team_of[index]], run.positions[tick]
            robot.sense(tick * scenario.tick_s, positions[index])
            strange = len(mine.robots)
            for other in range(5):
                if other + 1 in mine.robots and other != index:
                    robot.observe(other + 2 - mine.robots[0], positions[other])
                elif other + 1 not in mine.robots:
                    strange += 1
                    met += robot.observe_stranger(strange, positions[other]) == "stranger"
            sent.append(robot.share())
        for index, robot in enumerate(robots):
            mine = scenario.teams[scenario.team_of[index]].robots
            told = [(number - mine[0] + 1, sent[number - 1]) for number in mine if number != index + 1 and sent[number - 1]]
            assert robot.receive_all(told) == len(told)
        answers = [robot.tick(wish) for robot, wish in zip(robots, world.desired, strict=True)]
        world.step()
        assert np.array_equal([answer.velocity for answer in answers], run.velocities[tick])
        assert [answer.reason or answer.mode for answer in answers] == world.modes
    assert met > 0


def test_what_knows_one_team_refuses_several() -> None:
    scenario = small()
    for call, error, words in [
        (lambda: cr.Batch(scenario, range(2)), cr.ScenarioError, "teams"),
        (lambda: cr.Robot(scenario, 1), cr.RobotError, "team is None, but the scenario has 2 teams: allowed is 0 to 1"),
        (lambda: cr.Robot(scenario, 1, team=2), cr.RobotError, "team is 2, but the scenario has 2 teams: allowed is 0 to 1"),
        (lambda: cr.Robot(cr.Scenario(), 1, team=0), cr.RobotError, "team is 0, but the scenario has one team alone"),
        (lambda: cr.Robot(scenario, 3, team=1), cr.RobotError, "robot 3 is not one of 1 to 2"),
        (lambda: cr.Robot(scenario, 1, team=1, strangers=-1), cr.RobotError, "strangers is -1, allowed is 0 to 65535"),
        (lambda: small("composed"), cr.ScenarioError, "several teams only under"),
    ]:
        with pytest.raises(error, match=words):
            call()


def test_a_policy_moves_robots_of_several_teams() -> None:
    learning = pytest.importorskip("closeranks.learning")
    episode = learning.Episode(small())
    seen = episode.begin(3)
    assert seen.shape == (5, episode.size) and (seen[:, 5] == np.clip(0.0 - small().required_degrees, -10, 10)).all()
    seen, _, _ = episode.act(np.zeros((5, 2)))
    assert seen[:, 5].tolist() == [1.0, 1.0, 1.0, 0.0, 0.0]
