"""One name, a kernel for each kind of curve."""

from typing import Any, NamedTuple

import pytest
from numba.core.errors import NumbaError

from gradhesion.core.compiler import cache, jit
from gradhesion.core.compiler.dispatch import face, face_of


class Line(NamedTuple):
    """A kind."""

    slope: float
    offset: float


class Parabola(NamedTuple):
    """Another one, of the same numbers."""

    bend: float
    offset: float


class Unknown(NamedTuple):
    """One that answers nothing."""

    offset: float


@pytest.fixture(autouse=True)
def _no_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing that a test compiles is kept."""
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))


def made() -> tuple[Any, Any]:
    """Give a face and a kernel that asks it."""

    @face()
    def height(x: float, curve: Any) -> float:
        """Return the height at x."""
        raise NotImplementedError

    @height.answers(Line)
    @jit.kernel()
    def of_line(x: float, curve: Line) -> float:
        return curve.slope * x + curve.offset

    @height.answers(Parabola)
    @jit.kernel()
    def of_parabola(x: float, curve: Parabola) -> float:
        return curve.bend * x * x + curve.offset

    @jit.kernel()
    def rise(curve: Any, x: float) -> float:
        return height(x, curve) - height(0.0, curve)

    return height, rise


def test_the_type_of_the_curve_chooses() -> None:
    height, rise = made()
    assert height(3.0, Line(2.0, 1.0)) == 7.0
    assert height(3.0, Parabola(2.0, 1.0)) == 19.0
    assert rise(Line(2.0, 1.0), 3.0) == 6.0
    assert rise(Parabola(2.0, 1.0), 3.0) == 18.0
    assert height.answered() == (Line, Parabola)
    assert height.__doc__ == "Return the height at x."


def test_a_kind_without_an_answer_is_refused() -> None:
    height, rise = made()
    with pytest.raises(TypeError, match="height has no answer for a curve of the type Unknown"):
        height(1.0, Unknown(1.0))
    with pytest.raises((TypeError, NumbaError), match="height has no answer for a curve of the type Unknown"):
        rise(Unknown(1.0), 1.0)


def test_a_kernel_may_answer_for_one_kind_and_others_elsewhere() -> None:
    @face_of(Line)
    @jit.kernel()
    def steepness(curve: Line, x: float) -> float:
        """Return the slope at x."""
        return curve.slope + 0.0 * x

    @steepness.answers(Parabola)
    @jit.kernel()
    def of_parabola(curve: Parabola, x: float) -> float:
        return 2.0 * curve.bend * x

    @jit.kernel()
    def twice(curve: Any, x: float) -> float:
        return 2.0 * steepness(curve, x)

    assert steepness.answered() == (Line, Parabola)
    assert steepness.__doc__ == "Return the slope at x."
    assert (steepness(Line(2.0, 1.0), 3.0), steepness(Parabola(2.0, 1.0), 3.0)) == (2.0, 12.0)
    assert (twice(Line(2.0, 1.0), 3.0), twice(Parabola(2.0, 1.0), 3.0)) == (4.0, 24.0)
    with pytest.raises((TypeError, NumbaError), match="steepness has no answer for a curve of the type Unknown"):
        twice(Unknown(1.0), 1.0)
