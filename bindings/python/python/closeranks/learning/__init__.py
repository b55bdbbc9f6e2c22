"""Teams that learn: the filter as a safety layer under a policy.

A policy says where each normal robot wants to go; the scenario's controller makes a safe velocity of it, malicious robots do what
the scenario says. `ParallelTeam` is a PettingZoo environment with one agent a normal robot, `Team` a Gymnasium environment whose
policy moves all of them at once, `VectorTeam` many of those side by side. They need `pip install "closeranks[learning]"`.

>>> from closeranks import Scenario
>>> from closeranks.learning import ParallelTeam
>>> env = ParallelTeam(Scenario(controller={"kind": "budget"}))
>>> observations, infos = env.reset(seed=1)
>>> len(env.agents), observations["robot_3"].shape
(9, (37,))
"""

from closeranks.learning._episode import Episode
from closeranks.learning._gymnasium import Team, VectorTeam
from closeranks.learning._pettingzoo import ParallelTeam

__all__ = ["Episode", "ParallelTeam", "Team", "VectorTeam"]
