"""The steps in which kernels become code: a choice of numba's, in its order, which leaves out none that matters."""

from typing import Any

import numpy as np
import pytest
from numba.core.compiler import DefaultPassBuilder
from numba.core.errors import NumbaError

from gradhesion.core.compiler import cache, jit
from gradhesion.core.compiler.borrowed import Borrow
from gradhesion.core.compiler.pipeline import STEPS, KernelCompiler
from gradhesion.core.compiler.probe import LAZY


@pytest.fixture(autouse=True)
def _no_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing that a test compiles is kept."""
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))


def steps_of(compiler: Any) -> list[Any]:
    """The steps that a compiler takes for a kernel."""

    @jit.kernel()
    def twice(x: float) -> float:
        return x + x

    found = []

    class Noted(compiler):  # type: ignore[misc]
        def define_pipelines(self) -> list[Any]:
            pipelines: list[Any] = super().define_pipelines()
            found.extend(step for step, _ in pipelines[0].passes)
            return pipelines

    twice._options["pipeline_class"] = Noted
    assert twice(1.5) == 3.0
    return found


@pytest.mark.skipif(not LAZY, reason="numba links in its own way: kernels take its own steps")
def test_they_are_numbas_in_its_order() -> None:
    class Usual(KernelCompiler):  # type: ignore[misc]
        def define_pipelines(self) -> list[Any]:
            return [DefaultPassBuilder.define_nopython_pipeline(self.state)]

    usual = iter(steps_of(Usual))
    assert all(step in usual for step in STEPS if step is not Borrow), "each after the one before it"
    assert steps_of(KernelCompiler) == [*STEPS]


def test_a_branch_that_a_length_excludes_is_not_compiled() -> None:
    @jit.kernel()
    def first_of(pair: Any, default: float) -> Any:
        if len(pair) > 0:
            first, second = pair
            return first - second
        return default

    assert first_of((), 0.5) == 0.5
    assert first_of((3.0, 1.0), 0.5) == 2.0


def test_what_no_kernel_of_ours_has_is_right_or_refused() -> None:
    @jit.kernel()
    def norm_of_sum(a: Any, b: Any) -> Any:
        total = 2.0 * a + b
        return (total * total).sum()

    assert norm_of_sum(np.array([1.0, 2.0]), np.array([0.5, -1.0])) == 2.5**2 + 3.0**2

    @jit.kernel()
    def closes_over(x: float) -> float:
        def inner(y: float) -> float:
            return x + y

        return inner(x)

    with pytest.raises(NumbaError):
        closes_over(1.0)
