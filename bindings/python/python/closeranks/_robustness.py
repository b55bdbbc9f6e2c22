"""How many liars a network survives, exactly."""

from __future__ import annotations

from collections.abc import Hashable
from contextlib import contextmanager
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from closeranks import _native
from closeranks._graphs import Network, read
from closeranks._progress import bar
from closeranks._run import number
from closeranks._types import Progress

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class Witness:
    """Two sets of nodes that show that a graph is not (r, s)-robust: if the exempt nodes lie and every other member keeps its
    value, the two never agree."""

    r: int
    """The r of (r, s)."""
    s: int
    """The s of (r, s)."""
    first: frozenset[Hashable]
    """S_1, by the names of the nodes."""
    second: frozenset[Hashable]
    """S_2, disjoint from it."""
    exempt: frozenset[Hashable]
    """Members that hear r nodes or more outside of their set; fewer than s."""

    def holds(self, graph: nx.Graph[Any]) -> bool:
        """True if it is a witness against (r, s)-robustness of this networkx graph, by the definition."""
        reach = [self._exempt(graph, members) for members in (self.first, self.second)]
        apart = bool(self.first) and bool(self.second) and not self.first & self.second
        full = reach[0] == self.first or reach[1] == self.second
        return apart and not full and len(reach[0]) + len(reach[1]) < self.s and reach[0] | reach[1] == self.exempt

    def _exempt(self, graph: nx.Graph[Any], members: frozenset[Hashable]) -> frozenset[Hashable]:
        heard = graph.predecessors if graph.is_directed() else graph.neighbors
        return frozenset(node for node in members if len(set(heard(node)) - members) >= self.r)


@dataclass(frozen=True)
class Verdict:
    """The answer to "is this graph (r, s)-robust?"."""

    r: int
    """The r that was asked about."""
    s: int
    """The s that was asked about."""
    robust: bool | None
    """True, False, or None if the time was up before the answer."""
    certificate: str | None
    """How it is known to be robust, such as "least degree 6"."""
    witness: Witness | None
    """Why it is not."""

    def __bool__(self) -> bool:
        if self.robust is None:
            raise _native.GraphError(f"whether the graph is ({self.r},{self.s})-robust was not settled in time")
        return self.robust


@dataclass(frozen=True)
class Robustness:
    """What is proved about the robustness of a graph. A number that was not settled in time is (least, greatest)."""

    n: int
    """Number of nodes."""
    directed: bool
    """Whether edges have a direction."""
    degree_min: int
    """Least in-degree."""
    degree_max: int
    """Largest in-degree."""
    connectivity: int
    """Least number of nodes whose removal leaves a pair without a path; n - 1 if there is none."""
    f_by_degree: int | None
    """Largest F that the paper's degree condition promises, None if not even 0."""
    r_max: int | tuple[int, int]
    """Largest r with r-robustness, 0 to ceil(n/2)."""
    f_max: int | tuple[int, int]
    """Largest F with (F+1, F+1)-robustness: how many liars W-MSR survives wherever they are; -1 if not even (1, 1)."""
    table: dict[int, tuple[int | tuple[int, int], str]]
    """For r = 1 to ceil(n/2): the largest s with (r, s)-robustness, and how that much is known."""
    witness_r: Witness | None
    """Against (r_max + 1)-robustness."""
    witness_f: Witness | None
    """Against (f_max + 2, f_max + 2)-robustness."""
    exact: bool
    """Whether every number is settled."""
    nodes: int
    """Sets that the search looked at."""

    def __str__(self) -> str:
        rows = [f"  r = {r}: largest s = {s}, proved by {why}" for r, (s, why) in self.table.items()]
        shown = 1 + sum(s != 0 for s, _ in self.table.values())
        return "\n".join([f"n = {self.n}, r_max = {self.r_max}, F_max = {self.f_max}", *rows[:shown]])


def robustness(
    graph: Any,
    *,
    directed: bool | None = None,
    nodes: int | None = None,
    limit_s: float | None = None,
    progress: Progress = None,
) -> Robustness:
    """Everything about one graph, exactly, with witnesses: what `closeranks check` says.

    Parameters
    ----------
    graph : networkx or rustworkx graph, (n, n) array or sparse matrix, or pairs of nodes
        Who hears whom: u -> v (row u, column v of a matrix) means that v hears u. At most 128 nodes.
    directed : bool, optional
        Of matrices and edges: whether they have a direction. By default a matrix has one if it is not symmetric, edges have none.
    nodes : int, optional
        Of edges: n, if some nodes have none.
    limit_s : float, optional
        Stop the search then, s; what is proved by then is told as intervals.
    progress : bool, None or function
        A counter of sets tried: True, False, None (shown if it takes more than a second), or a function that is told how many.

    Raises
    ------
    GraphError
        If it is no graph that can be searched: loops, double edges, too many nodes.
    KeyboardInterrupt
        Within a tenth of a second.

    >>> import closeranks as cr
    >>> found = cr.robustness(cr.graphs.wheel(9))
    >>> found.r_max, found.f_max
    (2, 1)
    """
    network = read(graph, nodes=nodes, directed=directed)
    with _look(progress) as look:
        told = _native.analyze(network.nodes, network.edges, network.directed, limit_s, look)
    rows = enumerate(told.pop("s_max"), start=1)
    told["table"] = {r: (number(s), why if s[1] > 0 else "a witness") for r, (s, why) in rows}
    told["r_max"], told["f_max"] = number(told["r_max"]), number(told["f_max"])
    told["witness_r"] = _witness(network, told["witness_r"])
    told["witness_f"] = _witness(network, told["witness_f"])
    return Robustness(**told)


def is_robust(
    graph: Any,
    r: int,
    s: int = 1,
    *,
    directed: bool | None = None,
    nodes: int | None = None,
    limit_s: float | None = None,
    progress: Progress = None,
) -> Verdict:
    """Is the graph (r, s)-robust? With a certificate or a witness. For F liars ask for r = s = F + 1.

    The parameters are those of `robustness`; r and s are 0 or more. The answer is true or false where it is settled, and asking that
    of one that is not raises a GraphError.

    >>> import closeranks as cr
    >>> bool(cr.is_robust(cr.graphs.petersen(), 2))
    False
    """
    if r < 0 or s < 0:
        raise _native.GraphError(f"r is {r} and s is {s}, allowed are whole numbers from 0 on")
    network = read(graph, nodes=nodes, directed=directed)
    with _look(progress) as look:
        robust, certificate, found = _native.decide(
            network.nodes, network.edges, network.directed, r, s, limit_s, look
        )
    return Verdict(r, s, robust, certificate, _witness(network, found))


@contextmanager
def _look(progress: Progress) -> Iterator[Callable[[int, int, int], None]]:
    with bar(progress, None, "robustness", " sets") as tell:
        yield lambda r, s, sets: tell(sets)


def _witness(network: Network, found: dict[str, Any] | None) -> Witness | None:
    if found is None:
        return None
    sets = [frozenset(network.names[node] for node in found[key]) for key in ("first", "second", "exempt")]
    return Witness(found["r"], found["s"], *sets)
