"""One robot: the filter alone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from closeranks import _native
from closeranks._native import Output
from closeranks._native import Robot as NativeRobot

if TYPE_CHECKING:
    from closeranks._scenario import Scenario


_STRANGERS_MAX = 65_535


class Robot:
    """The filter between the planner and the motion controller of one robot, for people with their own simulator or robots.

    In every tick its owner calls, in this order, `sense` (time and own position), `observe` or `observe_all` (every robot in
    sight), `share` (bytes to send to everybody, when they are due), `receive` (what came, and from whom), and `tick` (desired
    velocity in, safe velocity out). Share before others receive: a level shared in a tick is used in that tick.

    All positions given to one robot are in m and in one frame that stands still in the world; velocities are along its axes.
    Every robot may have a frame of its own. Any order of calls with any numbers is safe: velocities are finite and in their box,
    and what can be noticed is said by an exception or by `Output.mode`.

    Parameters
    ----------
    scenario : Scenario
        The settings of the team (n, F, R, controller, clock, errors), which must be the same for all robots of a team, and its
        obstacles: where there are any, positions are in the scenario's frame. Of its start nothing is used but the ranks that are
        chosen from it, where there are ranks. Motion, attack and faults are not used.
    id : int
        The robot's number, from 1 to n, in its own team.
    value : float
        Initial value y_i, at most 1e300 in magnitude.
    neighbors : int, optional
        How many neighbours it can have; n - 1 by default.
    team : int, optional
        Which one of `scenario.teams` it is of, from 0, where there are several.
    strangers : int, optional
        How many robots of other teams it can have in sight beside those neighbours; by default all robots of the scenario's other teams.
        They share the room.

    Raises
    ------
    RobotError
        If the number is not one of the team's, the value cannot be told, or a setting is out of its range.
    """

    __slots__ = ("_native",)
    _native: NativeRobot

    def __init__(
        self,
        scenario: Scenario,
        id: int,
        value: float = 0.0,
        *,
        neighbors: int | None = None,
        team: int | None = None,
        strangers: int | None = None,
    ) -> None:
        robots = _robots(scenario, team)
        room = robots - 1 if neighbors is None else neighbors
        if not 0 <= room < robots:
            raise _native.RobotError(f"neighbors is {room}, allowed is 0 to {robots - 1}")
        more = scenario.robots - robots if strangers is None else strangers
        if not 0 <= more <= _STRANGERS_MAX:
            raise _native.RobotError(f"strangers is {more}, allowed is 0 to {_STRANGERS_MAX}")
        if not 1 <= id <= robots:
            raise _native.RobotError(f"robot {id} is not one of 1 to {robots}")
        self._native = _native.Robot(scenario._native, id, value, room + more, team)

    def sense(self, now_s: float, position: npt.ArrayLike) -> None:
        """Begins a tick at `now_s` (s from any fixed start on the robot's own clock, never falling) at `position` (D,), m.

        Raises
        ------
        RobotError
            If the time fell or a number is not finite; the robot stands still until the next good call.
        """
        self._native.sense(now_s, _vector(position))

    def observe(self, id: int, position: npt.ArrayLike) -> str:
        """Takes the sensed position (D,), m, of another robot of the team: "neighbor" (within R), "in view" (perhaps) or "out of range".

        Raises
        ------
        RobotError
            If the number is not one of the team's or its own, there is no own position, or no room is left.
        """
        return self._native.observe(id, _vector(position))

    def observe_stranger(self, id: int, position: npt.ArrayLike) -> str:
        """Takes the sensed position (D,), m, of a robot of another team: "stranger" (within R), "in view" (perhaps) or "out of range".

        It is kept away from and nothing else: it is no neighbour, and what it tells is refused. Whoever owns this robot gives each
        of the others a number above n of its own, for as long as it is sensed; the number of a tracker will do.

        Raises
        ------
        RobotError
            If the number is not above n, there is no own position, or no room is left.
        """
        return self._native.observe_stranger(id, _vector(position))

    def dismiss(self, id: int) -> None:
        """Forgets another robot, which has left: its owner carried it away. Who is only not observed any more is taken for missing.

        This is trusted as positions are, so nothing that a neighbour tells is a reason for it. A robot that is observed again is a
        neighbour as any other.
        """
        self._native.dismiss(id)

    def observe_all(self, ids: npt.ArrayLike, positions: npt.ArrayLike) -> None:
        """As `observe` for many robots of the team: numbers (k,) and positions (k, D), m. Stops at the first that is refused."""
        numbers = np.ascontiguousarray(ids, dtype=np.int64).reshape(-1)
        points = np.ascontiguousarray(positions, dtype=np.float64)
        self._native.observe_all(numbers, points.reshape(len(numbers), -1) if points.size == 0 else points)

    def share(self) -> bytes | None:
        """The bytes to send to everybody now, or None while nothing is due.

        They are 32, or under "links" as many as the list of its neighbours needs: 32 + 8 D + 11 for each of them.
        """
        return self._native.share()

    def receive(self, sender: int, message: bytes) -> None:
        """Takes the bytes of a message from robot `sender`, which the network vouches for; what they say is not trusted.

        Raises
        ------
        MessageError
            If they are no message, the sender was not observed in this tick, or the message is not newer than its last.
        """
        self._native.receive(sender, message)

    def receive_all(self, messages: Iterable[tuple[int, bytes]]) -> int:
        """As `receive` for pairs of sender and bytes, without what is refused; how many were taken."""
        taken = 0
        for sender, message in messages:
            try:
                self._native.receive(sender, message)
                taken += 1
            except _native.MessageError:
                pass
        return taken

    def restate(self, level: float) -> None:
        """Makes the robot hold and tell another level until the next update: for whoever plays a liar. Ignored unless finite."""
        self._native.restate(level)

    def tick(self, desired: npt.ArrayLike) -> Output:
        """Ends the tick: the velocity closest to `desired` (D,), m/s, that the controller allows, with what it is worth."""
        return self._native.tick(_vector(desired))

    def restart(self, value: float) -> None:
        """Begins anew with another value, as after a restart; only the time is kept."""
        self._native.restart(value)

    @property
    def id(self) -> int:
        """The robot's number, from 1."""
        return self._native.id

    @property
    def value(self) -> float:
        """y_i, on which the team agrees."""
        return self._native.value

    @property
    def told_level(self) -> float:
        """c_i as told."""
        return self._native.told_level

    @property
    def poll_at_s(self) -> float:
        """When the next share is due, s."""
        return self._native.poll_at_s

    @property
    def neighbors(self) -> list[int]:
        """Numbers of the neighbours, ascending."""
        return self._native.neighbors

    @property
    def strangers(self) -> list[int]:
        """Numbers of the robots of other teams that it keeps away from, ascending."""
        return self._native.strangers

    @property
    def discarded(self) -> list[int]:
        """Whose values W-MSR discarded in the last round."""
        return self._native.discarded

    def __repr__(self) -> str:
        return f"<Robot {self.id}: value {self.value:g}, {len(self.neighbors)} neighbours>"


def _robots(scenario: Scenario, team: int | None) -> int:
    """n of the team that is meant."""
    teams = scenario.teams
    if not teams and team is None:
        return scenario.robots
    if not teams:
        raise _native.RobotError(f"team is {team}, but the scenario has one team alone")
    if team is None or not 0 <= team < len(teams):
        raise _native.RobotError(f"team is {team}, but the scenario has {len(teams)} teams: allowed is 0 to {len(teams) - 1}")
    return len(teams[team].robots)


def _vector(numbers: npt.ArrayLike) -> list[float]:
    found: list[float] = np.asarray(numbers, dtype=np.float64).reshape(-1).tolist()
    return found
