"""The bounds of the waves, which decide where nobody looks, hold for every wave; and all folds stand between them."""

import math

import numpy as np
import pytest
from scipy.special import gamma, roots_jacobi

from gradhesion.core import Harmonic, Profile
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve import window
from gradhesion.core.curve.general import Basis, curve_of, slope
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.harmonics.cosine_bins import integral_at_zero
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.shape import depth_factor_of, rows_of
from gradhesion.core.pull_off import general as pull_off

pytestmark = pytest.mark.slow

EXPONENTS = [0.0, 1e-6, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0 - 1e-9, 1.0]
Y = np.concatenate([np.geomspace(1e-6, 0.5, 200), np.linspace(0.5, 150.0, 20_000)])
PROFILES = [
    Profile(exponent=2.0, harmonics=(Harmonic(n=1, cos=0.7, sin=-0.7),)),
    Profile(exponent=1.3, harmonics=(Harmonic(n=1, cos=0.5), Harmonic(n=4, sin=0.3))),
    Profile(exponent=3.7, harmonics=tuple(Harmonic(n=n, sin=1.0 / n) for n in (1, 3, 5, 7))),
]


def integral(k: float, j: int, y: np.ndarray, derivative: int = 0) -> np.ndarray:
    """Return int_0^1 (1-t^2)^((k-1)/2+j) t^derivative e^(iyt) dt: T + iS, by Gauss-Jacobi quadrature."""
    power = 0.5 * (k - 1.0) + j
    places, weights = roots_jacobi(140, power, 0.0)
    t = 0.5 * (1.0 + places)
    weights = weights * 0.5 ** (1.0 + power) * (1.0 + t) ** power
    values: np.ndarray = np.exp(1j * np.outer(y, t)) @ (weights * t**derivative)
    return values


def amplitude(k: float) -> float:
    """C of the leading term, from the end of the integral at t = 1."""
    return float(2.0 ** (0.5 * (k - 1.0)) * gamma(0.5 * (1.0 + k)))


@pytest.mark.parametrize("k", EXPONENTS)
def test_bounds_of_the_waves_of_the_slope(k: float) -> None:
    """|cos V_S + sin V_T| of any phase is at most |V_T + i V_S|, V = (y (T + i S))'."""
    both = np.abs(integral(k, 0, Y) + 1j * Y * integral(k, 0, Y, 1))
    far = amplitude(k) * Y ** (0.5 * (1.0 - k)) * (1.0 + window._EXCESS / Y**2)
    near = integral_at_zero(k) * (1.0 + Y)
    rounding = 1e-12 * (1.0 + Y)
    assert np.all(both <= far + rounding)
    assert np.all(both <= near + rounding)
    assert np.max(both / far) > 0.99  # and no larger than they need be


@pytest.mark.parametrize("k", EXPONENTS)
def test_bounds_of_the_waves_of_the_load(k: float) -> None:
    c = 0.5 * (1.0 - k)
    waves = Y * (integral(k, 0, Y) - integral(k, 1, Y))
    leading = amplitude(k) * Y**c * np.exp(1j * (Y - 0.25 * math.pi * (1.0 + k)))
    rounding = 1e-12 * (1.0 + Y)
    assert np.all(np.abs(waves) <= amplitude(k) * Y**c * (1.0 + pull_off._EXCESS / Y**2) + rounding)
    assert np.all(np.abs(waves - leading) <= pull_off._REMAINDER * amplitude(k) * Y ** (c - 1.0) + rounding)
    assert np.all(np.abs(waves) <= Y * integral_at_zero(k) / (2.0 + k) + rounding)


@pytest.mark.parametrize("compliance", [0.0, 3.0, math.inf], ids=["displacement", "machine", "load"])
@pytest.mark.parametrize("profile", PROFILES, ids=["phase", "near a cone", "square"])
@pytest.mark.parametrize("k", [0.0, 0.3, 1.0])
def test_all_folds_stand_between_the_bounds(k: float, profile: Profile, compliance: float) -> None:
    """On radii so close that no fold is missed the coordinate falls before the first bound and rises beyond the last."""
    basis = Basis(*tables_of(k), rows_of(profile))
    m = profile.exponent
    for wave in (0.02, 0.3):
        curve, _, _ = curve_of(k, m, depth_factor_of(k, m), 0.1, wave, 0.04, compliance)
        first, last = first_fold_bound(basis, curve), last_fold_bound(basis, curve)
        end = min(4.0 * last, 3000.0)
        assert first < last
        places = np.concatenate([np.geomspace(1e-6, 0.1, 50), np.arange(0.1, end, 0.05)])
        assert ((places < first) | (places > last)).any()
        for z in places[places < first]:
            assert slope(basis, curve, z / TWO_PI)[0] < 0.0, z
        for z in places[places > last]:
            assert slope(basis, curve, z / TWO_PI)[0] > 0.0, z
