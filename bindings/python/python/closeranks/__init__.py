"""Closeranks: software that keeps a team of robots agreeing while some of them lie.

What to run is a `Scenario`, what it came to a `Run`; a `World` is stepped tick by tick from outside, a `Batch` is many of those. `Robot` is the filter alone,
for people with their own simulator or robots. `WMSR` is the consensus rule on arrays, `Rule` any other. `robustness` says how many liars a network
survives, exactly, and `graphs` makes networks by name. `sweep` runs thousands of scenarios drawn from one file. `plots` draws the paper's figures.

Robots are numbered from 1, as in the paper: index 0 of an array is robot 1. Lengths are in m, speeds in m/s, times in s; units end
the names of numbers. Whatever is refused is refused with an `Error` (a ValueError) that names the place, the value and what is allowed.

>>> import closeranks as cr
>>> run = cr.Scenario.paper("understating").run(progress=False)
>>> run.positions.shape, bool(run.degree[:, 2:].min() >= run.scenario.required_degree)
((2001, 11, 2), True)
"""

from closeranks import graphs, plots
from closeranks._batch import Batch
from closeranks._native import COMMIT as __commit__
from closeranks._native import VERSION as __version__
from closeranks._native import Error, GraphError, MessageError, Output, RobotError, ScenarioError
from closeranks._robot import Robot
from closeranks._robustness import Robustness, Verdict, Witness, is_robust, robustness
from closeranks._rule import WMSR, Rule, WMSRRound, rules
from closeranks._run import Round, Run, Violation
from closeranks._scenario import Scenario, Team, controllers
from closeranks._sweep import Sweep, sweep
from closeranks._world import World

__all__ = [
    "WMSR",
    "Batch",
    "Error",
    "GraphError",
    "MessageError",
    "Output",
    "Robot",
    "RobotError",
    "Robustness",
    "Round",
    "Rule",
    "Run",
    "Scenario",
    "ScenarioError",
    "Sweep",
    "Team",
    "Verdict",
    "Violation",
    "WMSRRound",
    "Witness",
    "World",
    "__commit__",
    "__version__",
    "controllers",
    "graphs",
    "is_robust",
    "plots",
    "robustness",
    "rules",
    "sweep",
]
