"""A run that plays in a notebook."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import anywidget
import numpy as np
import traitlets

from closeranks._native import Error

if TYPE_CHECKING:
    from closeranks._run import Run

FRAMES_MAX = 2_000
"""No more ticks than this are sent to the browser; of a longer run every k-th."""


class RunView(anywidget.AnyWidget):
    """What `Run.view` returns: the robots of a run, drawn as on the page of `closeranks view`, with a button that plays and a slider.

    Liars are squares, a robot with fewer neighbours than it must keep has a broken ring, and colours are values. Of a run in
    space the first two axes are drawn.

    Attributes
    ----------
    frame : int
        Which frame is shown, from 0. Set it to go there; the slider sets it too.
    playing : bool
        True while it plays.
    ticks : list of int
        The tick of each frame.
    """

    _esm = Path(__file__).with_name("view.js")

    frame = traitlets.Int(0).tag(sync=True)
    playing = traitlets.Bool(False).tag(sync=True)
    ticks = traitlets.List(traitlets.Int()).tag(sync=True)
    team = traitlets.Dict().tag(sync=True)
    """What stays: tick_s, radius_m, required degrees, teams, malicious robots, and the interval of colours."""
    numbers = traitlets.Bytes().tag(sync=True)
    """float32, little-endian, (frames, n, 4): x and y, m, value and degree."""

    def __init__(self, run: Run, *, frames: int = 400) -> None:
        if not 1 <= frames <= FRAMES_MAX:
            raise Error(f"frames is {frames}, allowed is 1 to {FRAMES_MAX}")
        last = len(run.h) - 1
        chosen = np.unique(np.linspace(0, last, min(frames, last + 1)).round().astype(np.int64))
        super().__init__(team=_team(run), ticks=chosen.tolist(), numbers=_numbers(run, chosen))

    @traitlets.validate("frame")
    def _inside(self, proposal: dict[str, Any]) -> int:
        frame, count = int(proposal["value"]), len(self.ticks)
        if not 0 <= frame < count:
            raise traitlets.TraitError(f"frame is {frame}, allowed is 0 to {count - 1}")
        return frame


def _team(run: Run) -> dict[str, Any]:
    scenario, normal = run.scenario, run.values[0, ~run.scenario.is_malicious]
    return {
        "name": scenario.name,
        "robots": scenario.robots,
        "malicious": scenario.malicious,
        "tick_s": scenario.tick_s,
        "radius_m": scenario.radius_m,
        "required_degrees": scenario.required_degrees.tolist(),
        "team_of": scenario.team_of.tolist(),
        "values": [float(normal.min()), float(normal.max())],
    }


def _numbers(run: Run, chosen: np.ndarray[Any, np.dtype[np.int64]]) -> bytes:
    places, values, degrees = run.positions[chosen, :, :2], run.values[chosen, :, None], run.degree[chosen, :, None]
    return np.concatenate([places, values, degrees.astype(np.float64)], axis=2).astype("<f4").tobytes()
