"""Robustness of graphs of every kind."""

from __future__ import annotations

import json
import subprocess
import time
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

import closeranks as cr


def test_known_numbers() -> None:
    wheel = cr.robustness(cr.graphs.wheel(9))
    assert (wheel.n, wheel.r_max, wheel.f_max, wheel.connectivity, wheel.exact) == (9, 2, 1, 3, True)
    assert (wheel.degree_min, wheel.degree_max, wheel.f_by_degree, wheel.directed) == (3, 8, None, False)
    assert list(wheel.table) == [1, 2, 3, 4, 5] and wheel.table[3] == (0, "a witness")
    assert wheel.witness_r is not None and wheel.witness_r.holds(cr.graphs.wheel(9)) and wheel.witness_r.r == 3
    assert wheel.witness_f is not None and wheel.witness_f.holds(cr.graphs.wheel(9)) and wheel.witness_f.s == 3
    assert "r_max = 2, F_max = 1" in str(wheel) and wheel.nodes >= 0
    assert cr.robustness(cr.graphs.complete(7)).f_max == 3


def test_a_witness_that_is_none_does_not_hold() -> None:
    graph = cr.graphs.wheel(9)
    found = cr.robustness(graph).witness_r
    assert found is not None
    assert not cr.Witness(1, found.s, found.first, found.second, found.exempt).holds(graph)
    assert not cr.Witness(found.r, found.s, found.first, found.first, found.exempt).holds(graph)


def test_graphs_of_every_library_are_one_graph() -> None:
    graph = cr.graphs.erdos_renyi(10, 0.5, seed=4)
    matrix = nx.to_numpy_array(graph)
    named = nx.relabel_nodes(graph, {node: f"robot {node}" for node in graph})
    all_alike = [graph, matrix, matrix.astype(bool), list(graph.edges), np.array(graph.edges), named]
    sparse = pytest.importorskip("scipy.sparse")
    rustworkx = pytest.importorskip("rustworkx")
    all_alike += [sparse.csr_array(matrix), rustworkx.networkx_converter(graph)]
    found = [cr.robustness(one) for one in all_alike]
    assert len({(one.r_max, one.f_max, str(one.table), one.connectivity, one.directed) for one in found}) == 1
    assert found[-3].witness_f is not None and found[-3].witness_f.holds(named)


def test_directed_graphs_of_every_library_are_one_graph() -> None:
    graph = cr.graphs.erdos_renyi(8, 0.6, directed=True, seed=2)
    rustworkx = pytest.importorskip("rustworkx")
    found = [cr.robustness(one) for one in (graph, nx.to_numpy_array(graph), rustworkx.networkx_converter(graph))]
    found.append(cr.robustness(list(graph.edges), directed=True))
    assert len({(one.r_max, one.f_max, str(one.table), one.directed) for one in found}) == 1
    assert found[0].directed and found[0].witness_f is not None and found[0].witness_f.holds(graph)


def test_one_question() -> None:
    yes = cr.is_robust(cr.graphs.complete(7), 3, 3)
    assert isinstance(yes, cr.Verdict)
    assert yes and yes.robust is True and yes.certificate == "least degree 6" and yes.witness is None
    no = cr.is_robust(cr.graphs.petersen(), 2)
    assert not no and no.witness is not None and no.witness.holds(cr.graphs.petersen()) and (no.r, no.s) == (2, 1)


def test_what_is_not_settled_in_time_is_an_interval_and_no_answer() -> None:
    hard = cr.graphs.regular(100, 40, seed=1)
    start = time.monotonic()
    found = cr.robustness(hard, limit_s=0.2)
    assert time.monotonic() - start < 10
    assert not found.exact and isinstance(found.r_max, tuple) and found.r_max[0] < found.r_max[1]
    asked = cr.is_robust(hard, found.r_max[1], limit_s=0.0)
    with pytest.raises(cr.GraphError, match="was not settled in time"):
        bool(asked)


def test_progress_is_told_and_may_stop_the_search() -> None:
    told: list[int] = []

    def stop(done: int, total: int) -> None:
        told.append(done)
        if len(told) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        cr.robustness(cr.graphs.regular(100, 40, seed=1), progress=stop)
    assert told == sorted(told) and told[0] > 0


@pytest.mark.parametrize(
    ("graph", "options", "words"),
    [
        ([(0, 0)], {}, "loop at node 0"),
        ([(0, 1), (1, 0)], {}, "edge 1 - 0 appears twice"),
        (np.eye(3), {}, "loop at node 0"),
        (np.ones((3, 4)), {}, "a matrix of 3 x 4"),
        (np.triu(np.ones((3, 3)), 1), {"directed": False}, "is not symmetric"),
        ([(0, 5)], {"nodes": 3}, "node 5 is not one of 0 to 2"),
        (nx.path_graph(129), {}, "129 nodes, at most 128 are allowed"),
        (nx.MultiGraph([(0, 1), (0, 1)]), {}, "a multigraph"),
        (nx.Graph(), {}, "a graph needs at least one node"),
        (7, {}, "a int is no graph"),
        ([(0, 1)], {"limit_s": -1.0}, "limit_s is -1, allowed is a time from 0 on"),
    ],
)
def test_what_is_no_graph_is_refused(graph: object, options: dict[str, object], words: str) -> None:
    with pytest.raises(cr.GraphError, match=words):
        cr.robustness(graph, **options)  # type: ignore[arg-type]
    with pytest.raises(cr.GraphError):
        cr.is_robust([(0, 1)], -1)


def test_graphs_by_name_are_those_of_the_command_line(program: Path) -> None:
    made = {
        "complete 5": cr.graphs.complete(5),
        "path 5": cr.graphs.path(5),
        "ring 5": cr.graphs.ring(5),
        "circulant 9 1 3": cr.graphs.circulant(9, [1, 3]),
        "circulant 9 1 3 --directed": cr.graphs.circulant(9, [1, 3], directed=True),
        "k-circulant 11 4": cr.graphs.k_circulant(11, 4),
        "wheel 6": cr.graphs.wheel(6),
        "star 6": cr.graphs.star(6),
        "bipartite 3 4": cr.graphs.bipartite(3, 4),
        "grid 3 4": cr.graphs.grid(3, 4),
        "hypercube 3": cr.graphs.hypercube(3),
        "petersen": cr.graphs.petersen(),
        "elemental 2": cr.graphs.elemental(2),
        "tight 10 2": cr.graphs.tight(10, 2),
        "erdos-renyi 12 0.5 --seed 3": cr.graphs.erdos_renyi(12, 0.5, seed=3),
        "regular 12 5 --seed 3": cr.graphs.regular(12, 5, seed=3),
        "geometric 20 0.4 --seed 3": cr.graphs.geometric(20, 0.4, seed=3),
        "preferential 20 5 3 --seed 3": cr.graphs.preferential(20, 5, 3, seed=3),
        "multipartite 3 4": cr.graphs.multipartite(3, 4),
        "rook-complement 4 5": cr.graphs.rook_complement(4, 5),
        "kneser 6 2": cr.graphs.kneser(6, 2),
        "paley 13": cr.graphs.paley(13),
        "merg 10": cr.graphs.merg(10),
        "merg-f 10": cr.graphs.merg_f(10),
        "ranked 30 2 --seed 3": cr.graphs.ranked(30, 2, seed=3),
        "triangular 4 5": cr.graphs.triangular(4, 5),
        "delaunay 30 --seed 3": cr.graphs.delaunay(30, seed=3),
    }
    assert {words.split()[0].replace("-", "_") for words in made} == set(cr.graphs.__all__)
    for words, ours in made.items():
        told = subprocess.run([program, "graph", *words.split(), "--format", "json"], capture_output=True, text=True, check=True)
        links = json.loads(told.stdout)
        edges = links.get("links", links.get("edges"))
        theirs = {(int(edge["source"]), int(edge["target"])) for edge in edges}
        assert theirs == set(ours.edges), words
        assert ours.is_directed() == links["directed"]


def test_a_graph_that_cannot_be_made_says_what_is_allowed() -> None:
    for make, words in [
        (lambda: cr.graphs.ring(2), "node_count must be 3 or more for a ring"),
        (lambda: cr.graphs.erdos_renyi(4, 2.0), "probability must be from 0 to 1"),
        (lambda: cr.graphs.complete(-1), "allowed are numbers from 0 on"),
    ]:
        with pytest.raises(cr.GraphError, match=words):
            make()
