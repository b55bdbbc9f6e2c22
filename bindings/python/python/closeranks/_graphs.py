"""Graphs of other libraries."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np

from closeranks import _native


class Network(NamedTuple):
    """A graph on the nodes 0 to n - 1, with the names that they had."""

    nodes: int
    """n."""
    edges: list[tuple[int, int]]
    """Pairs; u, v means that v hears u."""
    directed: bool
    """Whether edges have a direction; if not, both ends hear each other."""
    names: Sequence[Hashable]
    """What each node was called."""


def read(graph: Any, *, nodes: int | None = None, directed: bool | None = None) -> Network:
    """A graph of networkx or rustworkx, an adjacency matrix, or a list of edges (on `nodes` nodes, if some have none)."""
    if hasattr(graph, "adj") and hasattr(graph, "is_directed"):
        return _networkx(graph)
    if hasattr(graph, "edge_list") and hasattr(graph, "node_indices"):
        return _rustworkx(graph)
    if hasattr(graph, "toarray"):
        graph = graph.toarray()
    if isinstance(graph, np.ndarray) and graph.ndim == 2 and not (graph.shape[1] == 2 and graph.shape[0] != 2):
        return _matrix(graph, directed)
    return _edges(graph, nodes, bool(directed))


def _networkx(graph: Any) -> Network:
    if graph.is_multigraph():
        raise _native.GraphError("a multigraph, allowed is a graph with at most one edge a pair (networkx.Graph(graph))")
    names = list(graph.nodes)
    places = {name: place for place, name in enumerate(names)}
    edges = [(places[one], places[other]) for one, other in graph.edges]
    return Network(len(names), edges, graph.is_directed(), names)


def _rustworkx(graph: Any) -> Network:
    names = list(graph.node_indices())
    places = {name: place for place, name in enumerate(names)}
    edges = [(places[one], places[other]) for one, other in graph.edge_list()]
    return Network(len(names), edges, hasattr(graph, "successors") and hasattr(graph, "in_degree"), names)


def _matrix(matrix: np.ndarray[Any, Any], directed: bool | None) -> Network:
    if matrix.shape[0] != matrix.shape[1]:
        rows, columns = matrix.shape
        raise _native.GraphError(f"a matrix of {rows} x {columns}, allowed is a square one, or edges as k x 2")
    linked = matrix != 0
    symmetric = bool((linked == linked.T).all())
    if directed is None:
        directed = not symmetric
    elif not directed and not symmetric:
        raise _native.GraphError("the matrix of an undirected graph is not symmetric")
    shown = linked if directed else np.triu(linked)
    edges = [(int(one), int(other)) for one, other in np.argwhere(shown)]
    return Network(len(matrix), edges, directed, range(len(matrix)))


def _edges(edges: Any, nodes: int | None, directed: bool) -> Network:
    try:
        pairs = [(one, other) for one, other in edges]
    except (TypeError, ValueError):
        allowed = "a graph of networkx or rustworkx, a square matrix, or pairs of nodes"
        raise _native.GraphError(f"a {type(edges).__name__} is no graph, allowed is {allowed}") from None
    pairs = [tuple(end.item() if isinstance(end, np.generic) else end for end in pair) for pair in pairs]
    ends = [end for pair in pairs for end in pair]
    if nodes is None and all(isinstance(end, int) and end >= 0 for end in ends):
        nodes = max(ends, default=-1) + 1
    names: Sequence[Hashable] = list(dict.fromkeys(ends)) if nodes is None else range(nodes)
    places = {name: place for place, name in enumerate(names)}
    missing = next((end for end in ends if end not in places), None)
    if missing is not None:
        raise _native.GraphError(f"node {missing!r} is not one of 0 to {len(names) - 1}")
    return Network(len(names), [(places[one], places[other]) for one, other in pairs], directed, names)
