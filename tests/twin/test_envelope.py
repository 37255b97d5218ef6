"""The envelopes' closed forms against the loop integral of the load, and the solver of the core against them."""

import math

import mpmath
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.twin.envelope import solve_envelope
from gradhesion.twin.stated import deviation, expected
from tests.exact import envelope_loop, theta


@pytest.mark.parametrize("k", [0.0, 0.31, 0.875])
@pytest.mark.parametrize(("chi", "reach"), [(0.0625, 0.21), (0.75, 0.9), (1.625, 3.3), (0.75, 3.3)])
def test_energy_is_the_loop_integral(k: float, chi: float, reach: float) -> None:
    scene = {"k": k, "nu": 0.5, "modulus": 7.0, "c0_over_R": 1.0, "lambda_over_R": 1e-3}
    with mpmath.workdps(30):
        n, M = (1 + mpmath.mpf(k)) / 2, 7 * theta(k, 0.5)
        s = mpmath.sqrt(2 ** (2 * n) * mpmath.pi / M)
        wave = mpmath.pi ** (1 - n) * mpmath.gamma(n) * mpmath.mpf(1e-3) ** n
        scene |= {"A": float(chi * s / wave), "a_max_over_R": reach * float(M) ** (-1 / (3 + k))}
        r = scene["A"] * wave
        energy = mpmath.mpf(float(solve_envelope(scene).dissipated_energy))
        assert abs(energy / envelope_loop(k, M, 2, r, r, scene["a_max_over_R"]) - 1) < 1e-14


def test_the_core_has_the_same_envelopes() -> None:
    scene = {"k": 0.43, "nu": 0.2, "modulus": 310.0, "c0_over_R": 0.07, "lambda_over_R": 0.013, "A": 0.02}
    for rim in (0.01, 0.3, 2.1, math.inf):
        values = solve(scene | {"a_max_over_R": rim}, OUTPUTS, solver="envelope")
        for name, one in expected(scene | {"a_max_over_R": rim}, OUTPUTS, "envelope").items():
            assert deviation(float(values[name]), one) <= one.error, name
