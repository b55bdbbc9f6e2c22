"""Networks by name, as networkx graphs on the nodes 0 to n - 1, at most 128; `ranked`, `triangular` and `delaunay` have up to four million.

A directed edge u -> v means that v hears u. One seed is one graph, on every machine, and the one of `closeranks graph`. What is not
possible is refused with a `GraphError`.

>>> import closeranks as cr
>>> cr.robustness(cr.graphs.elemental(2)).r_max
5
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from closeranks import _native

if TYPE_CHECKING:
    import networkx as nx

__all__ = [
    "bipartite",
    "circulant",
    "complete",
    "delaunay",
    "elemental",
    "erdos_renyi",
    "geometric",
    "grid",
    "hypercube",
    "k_circulant",
    "kneser",
    "merg",
    "merg_f",
    "multipartite",
    "paley",
    "path",
    "petersen",
    "preferential",
    "ranked",
    "regular",
    "ring",
    "rook_complement",
    "star",
    "tight",
    "triangular",
    "wheel",
]


def _made(name: str, *whole: int, real: float = 0.0, directed: bool = False, seed: int = 0) -> nx.Graph[int]:
    import networkx as nx

    if any(number < 0 for number in (*whole, seed)):
        raise _native.GraphError(f"{name} of {', '.join(map(str, whole))}, allowed are numbers from 0 on")
    nodes, directed, edges = _native.make(name, list(whole), real, directed, seed)
    graph: nx.Graph[int] = nx.DiGraph() if directed else nx.Graph()
    graph.add_nodes_from(range(nodes))
    graph.add_edges_from(edges)
    return graph


def complete(nodes: int) -> nx.Graph[int]:
    """All nodes joined: r_max = ceil(n/2)."""
    return _made("complete", nodes)


def path(nodes: int) -> nx.Graph[int]:
    """Nodes in a row."""
    return _made("path", nodes)


def ring(nodes: int) -> nx.Graph[int]:
    """Nodes in a circle, three or more."""
    return _made("ring", nodes)


def circulant(nodes: int, steps: Iterable[int], *, directed: bool = False) -> nx.Graph[int]:
    """Node i is heard by i + step for each of the steps, 1 to n - 1; undirected, to floor(n/2), they hear each other."""
    return _made("circulant", nodes, *steps, directed=directed)


def k_circulant(nodes: int, reach: int, *, directed: bool = False) -> nx.Graph[int]:
    """The circulant with the steps 1 to `reach`."""
    return _made("k_circulant", nodes, reach, directed=directed)


def wheel(nodes: int) -> nx.Graph[int]:
    """Node 0 joined to all others, which form a ring; four nodes or more."""
    return _made("wheel", nodes)


def star(nodes: int) -> nx.Graph[int]:
    """Node 0 joined to all others."""
    return _made("star", nodes)


def bipartite(left: int, right: int) -> nx.Graph[int]:
    """The first `left` nodes joined to each of the `right` others."""
    return _made("bipartite", left, right)


def grid(rows: int, columns: int) -> nx.Graph[int]:
    """Rows and columns, row by row."""
    return _made("grid", rows, columns)


def hypercube(dimension: int) -> nx.Graph[int]:
    """Corners of a cube of `dimension` 0 to 7; neighbours differ in one bit."""
    return _made("hypercube", dimension)


def petersen() -> nx.Graph[int]:
    """The Petersen graph: 1-robust although 3-connected."""
    return _made("petersen")


def elemental(f: int) -> nx.Graph[int]:
    """n = 4F + 1 nodes of which 2F are joined to all and the others form a path: (2F+1)-robust, on as few nodes as can be."""
    return _made("elemental", f)


def tight(nodes: int, f: int) -> nx.Graph[int]:
    """Two complete graphs joined F times at every node: one degree short of what the paper's condition asks for F liars."""
    return _made("tight", nodes, f)


def erdos_renyi(nodes: int, probability: float, *, directed: bool = False, seed: int = 1) -> nx.Graph[int]:
    """Every edge is there with `probability`, 0 to 1."""
    return _made("erdos_renyi", nodes, real=probability, directed=directed, seed=seed)


def regular(nodes: int, degree: int, *, seed: int = 1) -> nx.Graph[int]:
    """All degrees are `degree`; n times degree is even."""
    return _made("regular", nodes, degree, seed=seed)


def geometric(nodes: int, radius: float, *, seed: int = 1) -> nx.Graph[int]:
    """Points uniform in the unit square, joined if `radius` or less apart."""
    return _made("geometric", nodes, real=radius, seed=seed)


def preferential(nodes: int, start: int, links: int, *, seed: int = 1) -> nx.Graph[int]:
    """`start` nodes joined at first; each newcomer joins `links` of the others, the likelier the higher their degree."""
    return _made("preferential", nodes, start, links, seed=seed)


def multipartite(parts: int, size: int) -> nx.Graph[int]:
    """`parts` parts of `size` nodes, all joined but those of one part."""
    return _made("multipartite", parts, size)


def rook_complement(rows: int, columns: int) -> nx.Graph[int]:
    """Fields of a board, joined if they share neither row nor column."""
    return _made("rook_complement", rows, columns)


def kneser(points: int, chosen: int) -> nx.Graph[int]:
    """All sets of `chosen` of so many points, joined if disjoint."""
    return _made("kneser", points, chosen)


def paley(prime: int) -> nx.Graph[int]:
    """Numbers below a prime of the form 4k + 1, joined if they differ by a square."""
    return _made("paley", prime)


def merg(nodes: int) -> nx.Graph[int]:
    """The largest r that so many nodes can have, ceil(n/2), on the fewest links."""
    return _made("merg", nodes)


def merg_f(nodes: int) -> nx.Graph[int]:
    """The largest F that so many nodes can have, ceil(n/2) - 1, on the fewest links."""
    return _made("merg_f", nodes)


def ranked(nodes: int, f: int, *, seed: int = 1) -> nx.Graph[int]:
    """2F + 1 nodes joined, each newcomer joins 2F + 1 of those before it: survives F liars around each node."""
    return _made("ranked", nodes, f, seed=seed)


def triangular(rows: int, columns: int) -> nx.Graph[int]:
    """Rows and columns of a lattice of triangles."""
    return _made("triangular", rows, columns)


def delaunay(nodes: int, *, seed: int = 1) -> nx.Graph[int]:
    """Points uniform in a square, each joined to those next to it in every direction: the Delaunay triangulation."""
    return _made("delaunay", nodes, seed=seed)
