"""Types that several files name, and arrays that are checked for their shape."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeAlias, Union

import numpy as np
import numpy.typing as npt

from closeranks._native import Error

Floats: TypeAlias = npt.NDArray[np.float64]
"""An array of numbers."""

Law: TypeAlias = str
"""Name of something that a run can be expected to keep, such as "degree"."""

Progress: TypeAlias = Union[bool, None, Callable[[int, int], Any]]
"""Whether a bar is shown: True, False, None (if it takes more than a second and somebody can see it), or a function that is told
how many steps are done, and of how many."""

Attack: TypeAlias = Literal["nominal", "understating", "overstating"]
"""The paper's three attacks on levels."""

Start: TypeAlias = Literal["inside", "published"]
"""The paper's start as published, which lies outside of its safe set, and ours, which lies inside."""


def flat(name: str, numbers: npt.ArrayLike | None, shape: tuple[int, ...]) -> Floats | None:
    """The numbers, one after another, if they have this shape."""
    if numbers is None:
        return None
    array = np.ascontiguousarray(numbers, dtype=np.float64)
    if array.shape != shape:
        raise Error(f"`{name}` has the shape {array.shape}, must have {shape}")
    return array.reshape(-1)
