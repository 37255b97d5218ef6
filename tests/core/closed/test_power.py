"""The power as plain arithmetic, against mpmath and where floats end."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel

EPS = 2.0**-52


@kernel()
def powers(x: Any, p: Any, found: Any) -> None:
    for i in range(x.size):
        found[i] = power(x[i], p[i])


def of(x: Any, p: Any) -> NDArray[np.float64]:
    bases, exponents = np.broadcast_arrays(np.atleast_1d(np.asarray(x, dtype=float)), np.asarray(p, dtype=float))
    found = np.empty(bases.size)
    powers(bases.copy(), exponents.copy(), found)
    return found


@pytest.mark.parametrize(("low", "high"), [(0.5, 2.0), (1e-4, 1e4), (1e-76, 1e76), (1.0 - 1e-9, 1.0 + 1e-9)])
def test_against_mpmath(low: float, high: float) -> None:
    rng = np.random.default_rng(1)
    x, p = np.exp(rng.uniform(math.log(low), math.log(high), 3000)), rng.uniform(0.0, 4.0, 3000)
    with mpmath.workprec(150):
        exact = [mpmath.mpf(a) ** mpmath.mpf(b) for a, b in zip(x.tolist(), p.tolist(), strict=True)]
        errors = [float(abs(value / true - 1)) for value, true in zip(of(x, p).tolist(), exact, strict=True)]
    # half a unit of the product in the end, as much of 1 + f E(f), and what rounding leaves of the logarithm
    assert max(errors) <= 0.9 * EPS


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0])
def test_near_the_edges_of_binades(p: float) -> None:
    """The mantissa is cut at sqrt(1/2), the exponent at whole powers of 2."""
    cuts = np.array([math.sqrt(0.5), 1.0, math.sqrt(2.0), 2.0, 2.0**-300, 3.0 * 2.0**300])
    x = np.concatenate([cuts, np.nextafter(cuts, 0.0), np.nextafter(cuts, math.inf)])
    assert np.abs(of(x, p) / x**p - 1.0).max() <= 1.5 * EPS  # numpy rounds too


def test_where_floats_end() -> None:
    tiny = [5e-324, 1e-310, 2.0**-1022, 1e-300]
    assert np.abs(of(tiny, 0.3) / np.power(tiny, 0.3) - 1.0).max() <= 1.5 * EPS
    unit = 5e-324
    assert np.abs(of([1e-200, 1e-155, 1e-162], [1.55, 2.0, 2.0]) - [1e-310, 1e-310, 0.0]).max() <= 3 * unit
    assert of([1e200, 1e308, 1.5, math.inf, math.inf], [2.0, 4.0, 4.0, 0.1, 2.0]).tolist() == [
        math.inf,
        math.inf,
        1.5**4,
        math.inf,
        math.inf,
    ]
    assert of([0.0, 0.0, 1e-300, 5e-324], [0.1, 2.0, 4.0, 4.0]).tolist() == [0.0] * 4
    assert of([0.0, 5e-324, 0.7, 1e300, math.inf], 0.0).tolist() == [1.0] * 5
    assert np.isnan(of([math.nan, 1.0], [0.5, math.nan])).all()


def test_whole_powers_are_exact() -> None:
    x = np.arange(1.0, 200.0)
    assert of(x, 1.0).tolist() == x.tolist()
    assert of(2.0 ** np.arange(-100, 100), 2.0).tolist() == (4.0 ** np.arange(-100, 100)).tolist()


def test_alone_and_in_a_row_alike() -> None:
    """A loop is compiled to vector operations and a rest without them: they do the same."""
    rng = np.random.default_rng(2)
    x, p = 10.0 ** rng.uniform(-5.0, 5.0, 101), rng.uniform(0.0, 2.0, 101)
    whole = of(x, p)
    for i in range(101):
        assert of(x[i], p[i])[0] == whole[i]
        assert of(x[: i + 1], p[: i + 1])[-1] == whole[i]
