"""Rules of consensus on arrays."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest

import closeranks as cr


def test_the_f_largest_and_smallest_go_and_ties_stay() -> None:
    found = cr.WMSR(2).update(2.0, [9.0, 8.0, 2.0, 2.0, 3.0, 1.0, 0.0])
    assert found == cr.WMSRRound(value=9.0 / 4.0, below=2, above=2, low=2.0, high=3.0, kept=3)
    assert cr.WMSR(0).update(1.0, [2.0, 3.0, -2.0, np.nan]).value == 1.0


def test_a_team_is_its_robots() -> None:
    random = np.random.default_rng(7)
    for directed in (False, True):
        graph, values = cr.graphs.erdos_renyi(9, 0.6, directed=directed, seed=3), random.normal(size=9)
        rule = cr.WMSR(1)
        hears = graph.predecessors if directed else graph.neighbors
        alone = [rule.update(values[node], values[list(hears(node))]).value for node in graph]
        assert np.array_equal(rule.step(values, graph), alone)
        assert np.array_equal(rule.step(values, nx.to_numpy_array(graph)), alone)


def test_liars_with_many_faces_cannot_drag_a_robust_network_out() -> None:
    graph, rule, random = cr.graphs.complete(7), cr.WMSR(2), np.random.default_rng(1)
    values = np.arange(7.0)
    for _ in range(40):
        told = np.broadcast_to(values, (7, 7)).copy()
        told[:, :2] = random.uniform(-1e6, 1e6, size=(7, 2))
        values = rule.step(values, graph, told=told)
    assert 2.0 <= values[2:].min() <= values[2:].max() <= 6.0 and np.ptp(values[2:]) < 1e-6


def test_other_rules_discard_otherwise() -> None:
    told, found = [9.0, 1.0, np.nan, 2.0, 3.0], {}
    for name, needs in cr.rules().items():
        rule = cr.Rule(name, faults=1)
        assert needs and (rule.name, rule.faults) == (name, 1)
        found[name] = rule.update(10.0, told).value
    assert found == {"w-msr": 6.0, "trimmed-mean": 5.0, "median": 3.0, "linear": 5.0}
    values, graph = np.array([0.0, 1.0, 2.0, 900.0]), cr.graphs.complete(4)
    assert cr.Rule("median").step(values, graph).tolist() == [1.5] * 4
    assert cr.Rule("linear").step(values, graph).tolist() == [225.75] * 4
    assert np.array_equal(cr.Rule("w-msr", 1).step(values, graph), cr.WMSR(1).step(values, graph))
    for name in cr.rules():
        scenario = cr.Scenario(consensus={"rule": name}, duration_s=0.3, attack={"value": {"kind": "none"}})
        run = scenario.run(progress=False)
        turn, rule = scenario.ticks_per_round, cr.Rule(name, scenario.faults)
        assert np.allclose(run.values[turn], rule.step(run.values[0], run.links(0)), rtol=1e-12, atol=0.0), name


def test_what_does_not_fit_is_refused() -> None:
    for call, words in [
        (lambda: cr.WMSR(-1), "faults is -1, allowed is 0 to 65535"),
        (lambda: cr.Rule("mean"), 'no rule on arrays is called "mean", allowed are w-msr, trimmed-mean, median, linear'),
        (lambda: cr.WMSR(1).update(np.inf, []), "own is inf, allowed is a finite number"),
        (lambda: cr.WMSR(1).step([1.0, np.nan], [(0, 1)]), "`values` of robot 2 is not finite"),
        (lambda: cr.WMSR(1).step([1.0, 2.0], cr.graphs.ring(3)), "2 values for a graph of 3 nodes"),
        (lambda: cr.WMSR(1).step([1.0, 2.0], [(0, 1)], told=[[1.0]]), r"`told` has the shape \(1, 1\), must have \(2, 2\)"),
    ]:
        with pytest.raises(cr.Error, match=words):
            call()
    assert repr(cr.Rule("median")) == "Rule('median', faults=0)"
    assert repr(cr.WMSR(3)) == "WMSR(faults=3)" and cr.WMSR(3).faults == 3
