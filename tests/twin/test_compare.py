"""The solver keeps its stated errors on hostile draws: the short form of `python -m tests.twin.compare`."""

from collections.abc import Callable

import pytest

from tests.stress.draw import Scenes, eventful, hostile

from .compare import compare


@pytest.mark.parametrize("draw", [hostile, eventful])
def test_stated_errors_are_kept(draw: Callable[[int, int], Scenes]) -> None:
    made = compare(draw(5, 200), (0.0, 20.0))
    assert made.scenes >= 50
    assert made.unsure == 0
    assert made.near <= 2
    assert made.worst <= 1.0
