"""Python's garbage collection while kernels are compiled.

Numba makes millions of small objects for a kernel, and most of them are freed by reference counts. Python searches
for cycles among them after every 700, and after some of these times among all objects there are: a sixth of the time.
"""

import gc
from typing import Any, Final

from numba.core import event

SELDOM: Final = (200_000, 1_000, 1_000)
"""New objects between two collections, and collections between two of older ones: a twentieth more memory."""


class Seldom(event.Listener):  # type: ignore[misc] # numba has no types
    """Collects cycles less often from the start of a compilation to its end, those within it included."""

    def __init__(self) -> None:
        self._depth = 0
        self._usual = gc.get_threshold()

    def on_start(self, _event: Any) -> None:
        """Keep how it was."""
        if self._depth == 0:
            self._usual = gc.get_threshold()
            if 0 < self._usual[0] < SELDOM[0]:  # unless the user's setting is already rarer, or never
                gc.set_threshold(*SELDOM)
        self._depth += 1

    def on_end(self, _event: Any) -> None:
        """Put it back after the outermost."""
        self._depth -= 1
        if self._depth == 0:
            gc.set_threshold(*self._usual)
