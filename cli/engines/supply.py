"""Which blocks are to be handed out, and when to give one up.

A worker that dies takes with it what it works on and what waits in its queue: which of them has killed it is not known.
All of them are suspects then, and wait until everything else is done; then each is tried alone, so that the
guilty one takes nobody along.
"""

from collections import Counter, deque
from collections.abc import Iterable
from typing import Final

SECONDS: Final = 2.0
"""Of a task, if blocks are shorter: a thousand workers then ask for 500 a second, which a scheduler can give."""
SHARES: Final = 4
"""Tasks at least that each thread is to have of what is left, so that none has to wait for another at the end."""
RETURNS: Final = 5
"""Times that a block may come back because of the cluster, not of itself."""


class Supply:
    """The blocks that are left to do."""

    def __init__(self, numbers: Iterable[int]) -> None:
        self._waiting = deque(numbers)
        self._suspects: deque[int] = deque()
        self._returned: Counter[int] = Counter()
        self._seconds = 0.0
        self._blocks = 0

    def __bool__(self) -> bool:
        """Tell whether any is left to be handed out."""
        return bool(self._waiting or self._suspects)

    def take(self, *, threads: int, flying: int) -> tuple[tuple[int, ...], bool]:
        """Give the blocks of the next task, and whether it is to be tried alone; none if it has to wait."""
        if self._waiting:
            many = max(1, min(self._many(), len(self._waiting) // (SHARES * max(1, threads))))
            return tuple(self._waiting.popleft() for _ in range(many)), False
        if self._suspects and not flying:
            return (self._suspects.popleft(),), True
        return (), False

    def done(self, blocks: int, seconds: float) -> None:
        """Learn how long blocks take."""
        self._blocks += blocks
        self._seconds += seconds

    def killed(self, numbers: tuple[int, ...], *, alone: bool) -> tuple[int, ...]:
        """Take back blocks whose workers have died; gives those that are guilty, and do not come back."""
        if alone:
            return numbers
        self._suspects.extend(numbers)
        return ()

    def back(self, numbers: tuple[int, ...]) -> tuple[int, ...]:
        """Take back blocks that the cluster has not done; gives those that have come back too often."""
        self._returned.update(numbers)
        given_up = tuple(number for number in numbers if self._returned[number] > RETURNS)
        self._waiting.extendleft(number for number in reversed(numbers) if number not in given_up)
        return given_up

    def again(self, numbers: tuple[int, ...]) -> None:
        """Take back blocks that nobody has tried."""
        self._waiting.extendleft(reversed(numbers))

    def _many(self) -> int:
        """Tell how many blocks make a task."""
        return int(SECONDS * self._blocks / self._seconds) if self._seconds > 0.0 else 1
