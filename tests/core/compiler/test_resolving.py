"""What numba's functions give is found once for each types of arguments, for our kernels alone."""

import operator
from typing import Any

import numba
import numpy as np
import pytest
from numba.core import types
from numba.core.registry import cpu_target

from gradhesion.core.compiler import cache, jit
from gradhesion.core.compiler.probe import LAZY

pytestmark = pytest.mark.skipif(not LAZY, reason="numba links in its own way: it remembers nothing")


@pytest.fixture(autouse=True)
def _no_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing that a test compiles is kept."""
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))


def known_of(function: Any) -> dict[Any, Any]:
    """What is remembered of a function of numba's."""
    found = cpu_target.typing_context.resolve_value_type(function)
    assert isinstance(found, types.Function)
    return vars(found).setdefault("_known_calls", {})  # type: ignore[no-any-return]


def test_a_call_is_remembered_with_its_types() -> None:
    known = known_of(operator.add)
    known.clear()

    @jit.kernel()
    def added(x: float, y: float) -> float:
        return x + y

    assert added(1.0, 2.0) == 3.0
    first = known[types.float64, types.float64]
    assert added(1, 2.5) == 3.5
    assert known[types.int64, types.float64].return_type == types.float64
    assert type(added(1, 2)) is int
    assert known[types.int64, types.int64].return_type == types.int64
    np.testing.assert_array_equal(added(np.array([1.0]), 2.0), [3.0])
    assert known[types.float64, types.float64] is first


def test_what_others_compile_is_not() -> None:
    known = known_of(operator.mul)
    known.clear()

    @numba.njit  # type: ignore[untyped-decorator]
    def multiplied(x: float, y: float) -> float:
        return x * y

    assert multiplied(1.5, 2.0) == 3.0
    assert not known


def test_what_cannot_be_done_stays_an_error() -> None:
    @jit.kernel()
    def subtracted(x: Any, y: Any) -> Any:
        return x - y

    for _ in range(2):
        with pytest.raises(numba.TypingError):
            subtracted(1.0, None)
    assert subtracted(1.0, 0.25) == 0.75
