"""Garbage collection is rare while kernels are compiled, and as before afterwards."""

import gc
from collections.abc import Iterator
from typing import Any

import numba
import pytest
from numba.core import event

from gradhesion.core.compiler import cache, jit
from gradhesion.core.compiler.collecting import SELDOM


class Seen(event.Listener):  # type: ignore[misc] # numba has no types
    """What is set at the start of each compilation."""

    def __init__(self) -> None:
        self.thresholds: list[tuple[int, int, int]] = []

    def on_start(self, _event: Any) -> None:
        self.thresholds.append(gc.get_threshold())

    def on_end(self, _event: Any) -> None:
        pass


@pytest.fixture(autouse=True)
def nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))
    usual = gc.get_threshold()
    yield
    gc.set_threshold(*usual)


USUAL = (700, 10, 10)


@pytest.mark.parametrize(
    ("usual", "within"), [(USUAL, SELDOM), ((0, 10, 10), (0, 10, 10)), ((10**6, 9, 9), (10**6, 9, 9))]
)
def test_it_is_rare_within_and_as_before_afterwards(usual: tuple[int, int, int], within: tuple[int, int, int]) -> None:
    @jit.kernel()
    def inner(x: float) -> float:
        return x + 1.0

    @jit.kernel()
    def outer(x: float) -> float:
        return inner(x) + 1.0

    seen = Seen()
    gc.set_threshold(*usual)
    with event.install_listener("numba:compile", seen):
        assert outer(1.0) == 3.0
    assert seen.thresholds == [within, within]
    assert gc.get_threshold() == usual


def test_it_is_as_before_after_a_mistake_too() -> None:
    @jit.kernel()
    def wrong(x: float) -> float:
        return x.nothing  # type: ignore[attr-defined, no-any-return]

    gc.set_threshold(*USUAL)
    with pytest.raises(numba.TypingError):
        wrong(1.0)
    assert gc.get_threshold() == USUAL
