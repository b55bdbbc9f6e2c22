"""W-MSR on arrays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._graphs import read
from closeranks._types import Floats


class WMSRRound(NamedTuple):
    """One round of W-MSR at one robot."""

    value: float
    """The new value."""
    below: int
    """How many of the smallest values were discarded, at most F."""
    above: int
    """How many of the largest values were discarded, at most F."""
    low: float
    """Least value kept, the robot's own included."""
    high: float
    """Greatest value kept, the robot's own included."""
    kept: int
    """How many values of others were kept."""


class WMSR:
    """A mean that up to F liars cannot drag outside of what normal robots hold.

    Of what a robot is told it discards the F largest of the values larger than its own (all, if there are fewer), likewise below,
    and takes the mean of its own value and the rest, with equal weights.

    Parameters
    ----------
    faults : int
        F, 0 to 65535.

    >>> WMSR(faults=1).update(2.0, [9.0, 3.0, 1.0]).value
    2.5
    """

    __slots__ = ("faults",)
    faults: int

    def __init__(self, faults: int) -> None:
        if not 0 <= faults < 1 << 16:
            raise _native.Error(f"faults is {faults}, allowed is 0 to 65535")
        self.faults = faults

    def update(self, own: float, told: npt.ArrayLike) -> WMSRRound:
        """One round at one robot with the value `own` that was told the values `told`, (k,). Those that are not finite count as
        not told.

        Raises
        ------
        Error
            If `own` is not finite.
        """
        return WMSRRound(*_native.wmsr_update(own, np.ascontiguousarray(told, dtype=np.float64).reshape(-1), self.faults))

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
        return _native.wmsr_step(held, heard, self.faults)

    def __repr__(self) -> str:
        return f"WMSR(faults={self.faults})"
