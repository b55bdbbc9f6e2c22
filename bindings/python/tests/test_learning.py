"""Environments for learners: their projects' checks, and ours of what they say."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import closeranks as cr

gymnasium = pytest.importorskip("gymnasium")
pettingzoo = pytest.importorskip("pettingzoo")

from closeranks.learning import Episode, ParallelTeam, Team, VectorTeam  # noqa: E402

SHORT = cr.Scenario(duration_s=1.0, controller={"kind": "budget"})
CRASH = SHORT.replace(plant={"crash": {"robot": 4, "from_s": 0.3, "to_s": 0.6}})


def played(env: ParallelTeam, seed: int) -> list[tuple[object, ...]]:
    """Everything that an episode of random actions says."""
    random = np.random.default_rng(seed)
    said: list[tuple[object, ...]] = [env.reset(seed=seed)]
    while env.agents:
        actions = {agent: random.uniform(-1, 1, 2).astype(np.float32) for agent in env.agents}
        said.append(env.step(actions))
    return said


def test_pettingzoo_finds_nothing_wrong() -> None:
    from pettingzoo.test import parallel_api_test, parallel_seed_test

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parallel_api_test(ParallelTeam(SHORT), num_cycles=50)
        parallel_seed_test(lambda: ParallelTeam(SHORT))


def test_gymnasium_finds_nothing_wrong() -> None:
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(Team(SHORT), skip_render_check=True)


def test_a_seed_is_an_episode_over_all_its_steps() -> None:
    one, other = played(ParallelTeam(SHORT), 7), played(ParallelTeam(SHORT), 7)
    assert len(one) == len(other) == 21
    assert all(str(mine) == str(theirs) for mine, theirs in zip(one, other, strict=True))
    for mine, theirs in zip(one, other, strict=True):
        for agent, seen in mine[0].items():  # type: ignore[attr-defined]
            assert np.array_equal(seen, theirs[0][agent])  # type: ignore[index]
    again = ParallelTeam(SHORT)
    played(again, 3)
    assert str(played(again, 7)) == str(one) != str(played(again, 8))


def test_the_filter_stands_below_any_policy() -> None:
    env = ParallelTeam(SHORT)
    assert env.possible_agents == [f"robot_{robot}" for robot in range(3, 12)] and env.metadata["name"]
    said = played(env, 5)
    assert [one for one in env.episode.world.violations if one.expected] == [] and env.agents == []
    _, rewards, ended, cut, _ = said[-1]
    assert set(cut.values()) == {True} and set(ended.values()) == {False}  # type: ignore[attr-defined]
    assert env.observation_space("robot_3") is env.observation_space("robot_3")
    assert env.observation_spaces.keys() == env.action_spaces.keys() == set(env.possible_agents)
    assert env.action_space("robot_3").shape == (2,) and env.render() is None and env.close() is None
    with pytest.raises(cr.Error, match=r"the episode is over, allowed is reset\(\)"):
        env.step({})


def test_a_robot_that_crashes_is_masked_and_returns() -> None:
    env = ParallelTeam(CRASH)
    ups, earned = [], []
    env.reset(seed=1)
    while env.agents:
        seen, rewards, _, _, infos = env.step({agent: np.ones(2, dtype=np.float32) for agent in env.agents})
        ups.append(infos["robot_4"]["is_up"])
        earned.append(rewards["robot_4"])
        assert seen["robot_4"][6] == infos["robot_4"]["is_up"] and infos["robot_5"]["is_up"]
    down = [index for index, up in enumerate(ups) if not up]
    assert down == list(range(6, 12)) and ups[-1]
    assert all(earned[index] == 0.0 for index in down) and earned[13] != 0.0


def test_who_goes_to_its_goal_earns_the_way() -> None:
    episode = Episode(SHORT, ticks_per_step=4, goal_radius_m=3.0)
    episode.begin(2)
    away = np.linalg.norm(episode.goals - episode.world.positions, axis=1)
    assert (np.linalg.norm(episode.goals - episode.world.positions.mean(axis=0), axis=1) <= 3.0).all()
    sums = np.zeros(9)
    over = False
    while not over:
        way = (episode.goals - episode.world.positions)[2:]
        seen, earned, over = episode.act(way)
        sums += earned
    left = np.linalg.norm(episode.goals - episode.world.positions, axis=1)
    assert np.allclose(sums, (away - left)[2:]) and sums.sum() > 0.5
    assert seen.shape == (9, episode.size) and np.array_equal(seen, episode.observe())
    assert episode.robots == list(range(3, 12)) and episode.is_up.all() and len(episode.rewards()) == 11
    mine = Episode(SHORT, reward=lambda one: np.arange(11.0))
    assert mine.act(np.zeros((9, 2)))[1].tolist() == list(range(2, 11)) and mine.before.shape == (11, 2)
    assert (mine.scenario, mine.ticks_per_step, mine.goal_radius_m) == (SHORT, 10, 6.0)


def test_many_teams_are_those_of_gymnasium() -> None:
    ours = VectorTeam(CRASH, 3)
    theirs = gymnasium.vector.SyncVectorEnv([lambda: Team(CRASH) for _ in range(3)])
    random = np.random.default_rng(0)
    mine, expected = ours.reset(seed=11), theirs.reset(seed=11)
    assert np.array_equal(mine[0], expected[0]) and mine[0].shape == ours.observation_space.shape
    assert ours.num_envs == 3 and ours.single_action_space.shape == (9, 2) and len(ours.teams) == 3
    for _ in range(50):
        actions = random.uniform(-1, 1, ours.action_space.shape).astype(np.float32)
        mine, expected = ours.step(actions), theirs.step(actions)
        for one, other in zip(mine[:4], expected[:4], strict=True):
            assert np.array_equal(one, other)
        assert np.array_equal(mine[4]["is_up"], np.stack(expected[4]["is_up"]))


def test_what_cannot_be_is_refused() -> None:
    for make, words in [
        (lambda: Episode(SHORT, ticks_per_step=0), "ticks_per_step is 0, allowed is 1 or more"),
        (lambda: VectorTeam(SHORT, 0), "num_envs is 0, allowed is 1 or more"),
        (lambda: Episode(cr.Scenario(team={"robots": 2, "faults": 0, "malicious": [1, 2]})), "every robot is malicious"),
    ]:
        with pytest.raises(cr.Error, match=words):
            make()
