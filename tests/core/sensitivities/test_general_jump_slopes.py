"""The slopes of a general jump between fixed ends: its energy is a polynomial of degree 2 in B, g and its coordinate."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import drop, energy_from_zero, jump_energy, place_left
from gradhesion.core.sensitivities.general_jump_slopes import (
    NOTHING,
    add_drop,
    add_from_zero,
    parts_of,
    rim_slope_of,
    rise_to,
)
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, EXPONENT, GAIN, SHARE, SLOPES

AREA = 4.0 * math.pi**2
PAIR = np.array([[1.0, 1.0, 0.3], [3.0, 0.2, -0.1]])
CONTROLS = {"displacement": (1.0, 0.0), "machine": (0.7, 0.3), "load": (0.0, 1.0)}
JUMPS = [(0.02, 0.9), (1.7, 0.3), (6.2, 7.1), (31.3, 30.1), (3.0, 20.0)]
EPS = 2.0**-52


def made(k: float, exponent: float, control: str) -> tuple[Any, Any, Any]:
    """Give the basis, a curve, and the change of the tables."""
    return Basis(*tables_of(k, PAIR), PAIR), Series(0.02, exponent, 0.4, *CONTROLS[control]), changes_of(k, PAIR)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize("exponent", [1.3, 2.0])
@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(("start", "end"), JUMPS)
def test_against_differences(k: float, exponent: float, control: str, start: float, end: float) -> None:
    basis, curve, change = made(k, exponent, control)
    B, m, g, alpha, beta = curve
    found = np.zeros(SLOPES)
    sign = 1.0 if end > start else -1.0
    add_drop(basis, curve, change, start, 0.0, end, sign, found)

    def energy(b: float = 1.0, gain: float = 1.0, share: float = 1.0) -> float:
        return float(jump_energy(basis, Series(b * B, m, gain * g, alpha, share * beta), start, end, 0.0))

    size = sum(abs(energy(*factors)) for factors in [(1, 1), (2, 1), (1, 2), (0, 1), (1, 0)])
    rounding = 1000 * EPS * size
    assert abs(found[BEND] - (energy(1.5) - energy(0.5))) <= rounding  # exact for a polynomial of degree 2
    assert abs(found[GAIN] - (energy(1, 1.5) - energy(1, 0.5))) <= rounding
    shares = [energy(1, 1, math.exp(i * 2.0**-6)) for i in (-2, -1, 1, 2)]
    by_share = np.dot([1, -8, 8, -1], shares) / (12 * 2.0**-6)
    assert abs(found[SHARE] - by_share) <= 2e-8 * size  # step^4/30 of the fifth derivative
    left = place_left(basis, curve, start, 0.0)
    above, below = (
        AREA * sign * drop(basis, curve, (*left[:4], move, *left[5:]), min(start, end), max(start, end), 0.0)
        for move in (-0.5, 0.5)
    )
    assert abs(found[DEPTH] - (above - below)) <= rounding + 1000 * EPS * (abs(above) + abs(below))
    step = 2.0**-8 if k < 0.5 else -(2.0**-8)
    bases = [Basis(*tables_of(k + i * step, PAIR), PAIR) for i in range(7)]
    weights = np.array([-147, 360, -450, 400, -225, 72, -10]) / 60
    by_k = np.dot(weights, [jump_energy(one, curve, start, end, 0.0) for one in bases]) / step
    assert abs(found[EXPONENT] - by_k) <= 1e-7 * size


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9])
@pytest.mark.parametrize("control", ["displacement", "machine"])
@pytest.mark.parametrize("x", [0.01, 0.7, 5.0, 20.0])
@pytest.mark.parametrize("inwards", [False, True])
def test_from_zero_contact(k: float, control: str, x: float, inwards: bool) -> None:
    basis, curve, change = made(k, 2.0, control)
    B, m, g, alpha, beta = curve
    parts = parts_of(basis, curve, change, x, 0.0) if inwards else NOTHING
    found = np.zeros(SLOPES)
    add_from_zero(basis, curve, change, parts, x, coordinate(basis, curve, x) if inwards else 0.0, 1.0, found)

    def energy(b: float = 1.0, gain: float = 1.0) -> float:
        other = Series(b * B, m, gain * g, alpha, beta)
        return float(energy_from_zero(basis, other, x, coordinate(basis, other, x) if inwards else 0.0))

    size = sum(abs(energy(*factors)) for factors in [(1, 1), (2, 1), (1, 2), (0, 1), (1, 0)])
    assert abs(found[BEND] - (energy(1.5) - energy(0.5))) <= 1000 * EPS * size
    assert abs(found[GAIN] - (energy(1, 1.5) - energy(1, 0.5))) <= 1000 * EPS * size


@pytest.mark.parametrize("control", CONTROLS)
def test_the_end_of_a_jump_that_is_cut(control: str) -> None:
    """Its slope by ln x is that of the energy by its end."""
    basis, curve, change = made(0.37, 2.0, control)
    start, end, step = 6.2, 6.7, 1e-4
    around = [jump_energy(basis, curve, start, end * math.exp(i * step), 0.0) for i in (-2, -1, 1, 2)]
    exact = np.dot([1, -8, 8, -1], around) / (12 * step)
    assert rim_slope_of(basis, curve, coordinate(basis, curve, start), end) == pytest.approx(exact, rel=1e-9)
    u = rise_to(basis, curve, change, start, 0.0, end)
    assert -((2 * math.pi * end) ** 2) * u * (2 + u) == pytest.approx(exact, rel=1e-9)
