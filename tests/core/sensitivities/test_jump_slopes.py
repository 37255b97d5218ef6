"""The slopes of the energy of a jump between fixed ends: it is a polynomial of degree 2 in b, g and the depth."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.sensitivities.jump_slopes import (
    BEND,
    DEPTH,
    EXPONENT,
    GAIN,
    SLOPES,
    add_slopes,
    add_slopes_to_zero,
)
from gradhesion.core.sensitivities.neighbours import exponents_beside

WORK = np.empty(48)
CURVE = Cosine(0.02, 0.9, 0.0)
JUMPS = [(0.02, 0.9), (0.3, 1.7), (6.2, 7.1), (7.1, 5.9), (9.3, 12.9), (31.3, 30.1), (3.0, 80.0), (90.0, 4.0)]


def near_of(k: float, table_of: Callable[[float], Any], curve: Any) -> Any:
    """Neighbours on the same curve: what the slope by k is then is that of the functions alone."""
    exponents, weights = exponents_beside(k)
    tables = np.array([table_of(exponent) for exponent in exponents])
    return (tables, np.array([curve[:2]] * weights.size), weights)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize(("start", "end"), JUMPS)
def test_against_the_polynomial(k: float, start: float, end: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    near = near_of(k, table_of, CURVE)
    found = np.zeros(SLOPES)
    add_slopes(table, CURVE, near, start, end, WORK, found)

    def energy(b: float, g: float) -> float:
        return float(jump_energy(table, Cosine(b, g, 0.0), start, end, WORK))

    b, g, _ = CURVE
    whole = energy(b, g)
    by_bend = (energy(1.5 * b, g) - energy(0.5 * b, g)) / b  # exact for a polynomial of degree 2
    by_gain = (energy(b, 1.5 * g) - energy(b, 0.5 * g)) / g
    size = abs(whole) + abs(energy(2 * b, g)) + abs(energy(b, 2 * g)) + abs(energy(0.0, g)) + abs(energy(b, 0.0))
    rounding = 400 * 2.0**-52 * size * (1.0 + 100.0 * (abs(end - start) > 64.0))  # the antiderivative cancels there
    assert abs(b * (found[BEND] - by_bend)) <= rounding
    assert abs(g * (found[GAIN] - by_gain)) <= rounding
    step = 0.013 if k < 0.5 else -0.013
    tables = [table_of(k + i * step) for i in range(5)]
    energies = [float(jump_energy(one, CURVE, start, end, WORK)) for one in tables]
    coarse = np.dot([-25 / 12, 4, -3, 4 / 3, -1 / 4], energies) / step
    assert found[EXPONENT] == pytest.approx(coarse, rel=1e-4, abs=1e-4 * size)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9])
@pytest.mark.parametrize("x", [0.01, 0.7, 5.0, 20.0])
def test_to_and_from_zero(k: float, x: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    near = near_of(k, table_of, CURVE)
    b, g, _ = CURVE
    for inwards in (False, True):
        found = np.zeros(SLOPES)
        add_slopes_to_zero(table, CURVE, near, x, inwards, found)

        def energy(b: float, g: float, inwards: bool = inwards, more: float = 0.0) -> float:
            curve = Cosine(b, g, 0.0)
            level = (float(depth(table, curve, x)) if inwards else 0.0) + more
            return float(energy_from_zero(table, curve, x, level)) * (-1.0 if inwards else 1.0)

        size = abs(energy(2 * b, g)) + abs(energy(b, 2 * g)) + abs(energy(b, g)) + abs(energy(0.0, g))
        rounding = 400 * 2.0**-52 * size
        assert abs(b * found[BEND] - (energy(1.5 * b, g) - energy(0.5 * b, g))) <= rounding
        assert abs(g * found[GAIN] - (energy(b, 1.5 * g) - energy(b, 0.5 * g))) <= rounding
        by_depth = 0.5 * (energy(b, g, more=1.0) - energy(b, g, more=-1.0))
        assert found[DEPTH] == pytest.approx(by_depth, rel=1e-11)
