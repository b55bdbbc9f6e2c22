"""Progress bars in notebooks and terminals."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from closeranks._types import Progress

PATIENCE_S = 1.0
"""What takes less time shows no bar unless one was asked for, s."""


def _is_seen() -> bool:
    """True in a notebook, and where standard error is a terminal."""
    return "ipykernel" in sys.modules or sys.stderr.isatty()


@contextmanager
def bar(progress: Progress, total: int | None, what: str, unit: str) -> Iterator[Callable[[int], None]]:
    """A function that is told how many steps are done."""
    if callable(progress):
        tell = progress
        yield lambda done: tell(done, total or 0)
    elif progress is False or (progress is None and not _is_seen()):
        yield lambda done: None
    else:
        from tqdm.auto import tqdm

        delay = PATIENCE_S if progress is None else 0.0
        with tqdm(total=total, desc=what, unit=unit, delay=delay, leave=False) as drawn:
            yield lambda done: (drawn.update(done - drawn.n), None)[1]
