"""Rules of consensus on arrays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._graphs import read
from closeranks._types import Floats


def rules() -> dict[str, str]:
    """Every rule that robots can run, with the graph that it needs so that up to F liars cannot keep the others from agreeing.

    >>> list(rules())
    ['w-msr', 'trimmed-mean', 'median', 'linear']
    """
    return dict(_native.rules())


class WMSRRound(NamedTuple):
    """One round of a rule at one robot."""

    value: float
    """The new value."""
    below: int
    """How many of the smallest values were discarded."""
    above: int
    """How many of the largest values were discarded."""
    low: float
    """Least value kept; of W-MSR the robot's own is among them."""
    high: float
    """Greatest value kept; of W-MSR the robot's own is among them."""
    kept: int
    """How many values of others were kept."""


class Rule:
    """How a robot makes its new value of its own and of those that it was told, of which up to F are lies.

    Parameters
    ----------
    name : str
        - `"w-msr"`: the mean without the F largest of the values above the own one and the F smallest below it (all, if there are
          fewer), with equal weights.
        - `"trimmed-mean"`: the mean of the own value and of those told without the F largest and the F smallest.
        - `"median"`: the middle of the own value and of those told; F makes no difference.
        - `"linear"`: the plain mean, which one liar leads anywhere; F makes no difference.

        Scenarios know more of them (docs/comparison.md): those remember rounds or pass on what others told, so they are no function of
        one round and not here.
    faults : int
        F, 0 to 65535.

    >>> [Rule(name, faults=1).update(2.0, [9.0, 3.0, 1.0]).value for name in rules()]
    [2.5, 2.5, 2.5, 3.75]
    """

    __slots__ = ("faults", "name")
    name: str
    faults: int

    def __init__(self, name: str, faults: int = 0) -> None:
        if not 0 <= faults < 1 << 16:
            raise _native.Error(f"faults is {faults}, allowed is 0 to 65535")
        if name not in rules():
            raise _native.Error(f'no rule on arrays is called "{name}", allowed are {", ".join(rules())}')
        self.name, self.faults = name, faults

    def update(self, own: float, told: npt.ArrayLike) -> WMSRRound:
        """One round at one robot with the value `own` that was told the values `told`, (k,). Those that are not finite count as
        not told.

        Raises
        ------
        Error
            If `own` is not finite.
        """
        said = np.ascontiguousarray(told, dtype=np.float64).reshape(-1)
        return WMSRRound(*_native.rule_update(self.name, own, said, self.faults))

    def step(self, values: npt.ArrayLike, graph: Any, told: npt.ArrayLike | None = None) -> Floats:
        """One round of a whole team, (n,).

        Parameters
        ----------
        values : array (n,)
            What each robot holds; liars are robots like others here: set their entries to what they tell.
        graph : networkx or rustworkx graph, (n, n) array, or list of edges
            Who hears whom: u -> v means that v hears u. Nodes are in the order of the graph.
        told : array (n, n), optional
            What robot i is told by robot j at [i, j], for liars with many faces; NaN where nothing is told. `values` by default.

        Raises
        ------
        Error
            If shapes do not fit, or a value is not finite.
        """
        held = np.ascontiguousarray(values, dtype=np.float64).reshape(-1)
        network = read(graph, nodes=len(held))
        if network.nodes != len(held):
            raise _native.Error(f"{len(held)} values for a graph of {network.nodes} nodes")
        said = np.broadcast_to(held, (len(held), len(held))) if told is None else np.asarray(told, dtype=np.float64)
        heard = np.full((len(held), len(held)), np.nan)
        if said.shape != heard.shape:
            raise _native.Error(f"`told` has the shape {said.shape}, must have {heard.shape}")
        for one, other in network.edges:
            heard[other, one] = said[other, one]
            if not network.directed:
                heard[one, other] = said[one, other]
        return _native.rule_step(self.name, held, heard, self.faults)

    def __repr__(self) -> str:
        return f"Rule({self.name!r}, faults={self.faults})"


class WMSR(Rule):
    """The rule `"w-msr"`: a mean that up to F liars cannot drag outside of what normal robots hold.

    Of what a robot is told it discards the F largest of the values larger than its own (all, if there are fewer), likewise below,
    and takes the mean of its own value and the rest, with equal weights.

    Parameters
    ----------
    faults : int
        F, 0 to 65535.

    >>> WMSR(faults=1).update(2.0, [9.0, 3.0, 1.0]).value
    2.5
    """

    __slots__ = ()

    def __init__(self, faults: int) -> None:
        super().__init__("w-msr", faults)

    def __repr__(self) -> str:
        return f"WMSR(faults={self.faults})"
