"""The envelopes' closed forms against the loop integral of the load, and the solver of the core against them."""

import math

import mpmath
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.twin.envelope import solve_envelope
from gradhesion.twin.stated import deviation, expected


def loop(k: float, reach: float, chi: float) -> mpmath.mpf:
    """Integrate P d(delta) along (5.26), (5.27), (5.32) with s = R = dgamma = 1 and K = 4 pi/(1+k)."""
    stiffness, c = 4 * mpmath.pi / (1 + mpmath.mpf(k)), (1 - mpmath.mpf(k)) / 2
    rim = mpmath.mpf(reach)

    def depth(pull: float, a: mpmath.mpf) -> mpmath.mpf:
        return a**2 / (1 + k) - pull * a**c

    def load(pull: float, a: mpmath.mpf) -> mpmath.mpf:
        return stiffness * (2 * a ** (3 + k) / ((1 + k) * (3 + k)) - pull * a ** ((3 + mpmath.mpf(k)) / 2))

    def work(pull: float, low: mpmath.mpf, high: mpmath.mpf) -> mpmath.mpf:
        def rate(t: mpmath.mpf) -> mpmath.mpf:
            a = mpmath.exp(t)
            return load(pull, a) * (2 * a**2 / (1 + k) - pull * c * a**c)

        return mpmath.quad(rate, mpmath.linspace(mpmath.log(low), mpmath.log(high), 7)) if low < high else mpmath.mpf(0)

    power = 2 / (3 + mpmath.mpf(k))
    a_in = min(rim, ((1 + k) * max(1 - chi, mpmath.mpf("1e-40"))) ** power)
    a_out = min(rim, ((1 - mpmath.mpf(k) ** 2) / 4 * (1 + chi)) ** power)
    top, bottom = max(mpmath.mpf(0), depth(1 - chi, rim)), depth(1 + chi, rim)
    held = stiffness * (rim ** (1 + k) * (top + bottom) / 2 - rim ** (3 + k) / (3 + k))
    return work(1 - chi, a_in, rim) - held * (top - bottom) - work(1 + chi, a_out, rim)


@pytest.mark.parametrize("k", [0.0, 0.31, 0.875])
@pytest.mark.parametrize("chi", [0.0625, 0.75, 1.625])
@pytest.mark.parametrize("reach", [0.21, 0.9, 3.3])
def test_energy_is_the_loop_integral(k: float, chi: float, reach: float) -> None:
    """In units of s = 1: M = 2^(1+k) pi."""
    with mpmath.workdps(30):
        beta = mpmath.sqrt((1 + mpmath.mpf(k)) * (1 - mpmath.mpf(k)))  # nu = 1/2
        unit = (
            2 ** (1 + mpmath.mpf(k)) / mpmath.pi * mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2)
        )
        unit /= mpmath.gamma(2 + k)
        theta = 2 ** (1 + mpmath.mpf(k)) * (1 + k) * mpmath.cos(k * mpmath.pi / 2) * mpmath.gamma(1 + mpmath.mpf(k) / 2)
        theta /= (
            mpmath.sqrt(mpmath.pi)
            * unit
            * beta
            * mpmath.sin(beta * mpmath.pi / 2)
            * mpmath.gamma((1 + mpmath.mpf(k)) / 2)
        )
        modulus = float(2 ** (1 + mpmath.mpf(k)) * mpmath.pi / theta)
        wave = (
            mpmath.pi ** ((1 - mpmath.mpf(k)) / 2)
            * mpmath.gamma((1 + mpmath.mpf(k)) / 2)
            * mpmath.mpf(1e-3) ** ((1 + mpmath.mpf(k)) / 2)
        )
        scene = {"k": k, "nu": 0.5, "modulus": modulus, "c0_over_R": 1.0, "lambda_over_R": 1e-3}
        scene |= {"A": float(chi / wave), "a_max_over_R": reach}
        energy = mpmath.mpf(float(solve_envelope(scene).dissipated_energy))
        assert abs(energy / loop(k, reach, chi) - 1) < 1e-14


def test_the_core_has_the_same_envelopes() -> None:
    scene = {"k": 0.43, "nu": 0.2, "modulus": 310.0, "c0_over_R": 0.07, "lambda_over_R": 0.013, "A": 0.02}
    for rim in (0.01, 0.3, 2.1, math.inf):
        values = solve(scene | {"a_max_over_R": rim}, OUTPUTS, solver="envelope")
        for name, one in expected(scene | {"a_max_over_R": rim}, OUTPUTS, "envelope").items():
            assert deviation(float(values[name]), one) <= one.error, name
