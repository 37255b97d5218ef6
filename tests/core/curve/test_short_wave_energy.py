"""The energy of a jump of the asymptotic form: against quadrature of 30 digits in each of its regimes, and its signs."""

import math

import mpmath
import pytest

from gradhesion.core.curve.short_wave import ShortWave, depth
from gradhesion.core.curve.short_wave_energy import loss_of_jump

pytestmark = pytest.mark.slow

EPS = 2.0**-52


def wave_of(k: float, b: float, chi: float) -> ShortWave:
    return ShortWave(k, b, chi, 0.83 * chi, (1 + k) * math.pi / 4)


def loss(wave: ShortWave, target: float, start: float, end: float) -> tuple[float, float]:
    """Return e, and the integral of the size of its integrand's two terms."""
    k, b, chi, g, phi = map(mpmath.mpf, wave)

    def square(z: mpmath.mpf) -> mpmath.mpf:
        rho = (b * z * z / 2 + g - mpmath.mpf(target)) / z ** ((1 - k) / 2) + chi * mpmath.sin(z - phi)
        return z * rho * rho

    low, high = min(start, end), max(start, end)
    pieces = mpmath.linspace(low, high, int((high - low) / 6) + 2)
    if low == 0:
        pieces = [0, *(pieces[1] * mpmath.mpf(10) ** -j for j in range(8, 0, -1)), *pieces[1:]]
    with mpmath.workdps(20):
        integral = mpmath.quad(square, pieces, method="gauss-legendre")
    plain = (mpmath.mpf(high) ** 2 - mpmath.mpf(low) ** 2) / 2
    return float(plain - integral) * (1 if end > start else -1), float(plain + integral)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize(
    ("b", "chi", "start", "end"),
    [
        (0.7, 0.4, 0.0, 1.3),  # near zero
        (0.03, 0.9, 0.0, 17.0),  # near zero, then panels
        (0.01, 0.6, 2.9, 9.4),
        (0.002, 0.8, 31.0, 36.2),  # one panel
        (0.002, 1.7, 31.0, 101.0),
        (3e-5, 0.2, 0.0, 553.0),  # near zero, panels, antiderivative
        (3e-5, 0.9, 47.0, 677.0),  # antiderivative alone
    ],
)
def test_it_is_the_integral(k: float, b: float, chi: float, start: float, end: float) -> None:
    wave = wave_of(k, b, chi)
    for target in (0.0, -0.2, depth(wave, end)):
        expected, size = loss(wave, target, start, end)
        # the rule in z^(1/4) bears the wave up to z = 4 with 16 nodes; the series of the antiderivative is cut at 1e-12
        share = 1e-8 if start < 4.0 else 1e-12
        assert loss_of_jump(wave, target, start, end) == pytest.approx(expected, abs=share * size)


@pytest.mark.parametrize(("low", "high"), [(0.0, 3.1), (5.5, 44.0), (0.0, 900.0), (60.0, 900.0)])
def test_the_way_back_has_the_other_sign(low: float, high: float) -> None:
    wave = wave_of(0.44, 1e-3, 0.5)
    assert loss_of_jump(wave, 0.3, high, low) == -loss_of_jump(wave, 0.3, low, high)


@pytest.mark.parametrize("middle", [2.2, 4.0, 38.0, 300.0])
def test_jumps_at_one_depth_add_up(middle: float) -> None:
    # beside and across the seams: panels against the antiderivative
    wave = wave_of(0.61, 1e-4, 0.7)
    whole = loss_of_jump(wave, 0.3, 0.0, 800.0)
    parts = loss_of_jump(wave, 0.3, 0.0, middle), loss_of_jump(wave, 0.3, middle, 800.0)
    assert sum(parts) == pytest.approx(whole, abs=1e-11 * (abs(parts[0]) + abs(parts[1])))


def test_no_jump_loses_nothing() -> None:
    wave = wave_of(0.2, 0.1, 0.3)
    for z in (0.3, 1.7, 55.5):
        assert abs(loss_of_jump(wave, 0.1, z, z)) <= EPS * z * z
