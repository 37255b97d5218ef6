"""Fitted profiles: exact ones come back to rounding, noisy ones within their errors, and the residual is the noise."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core.answers.profile_fit import FittedProfile, fit_profile

EPS = np.finfo(float).eps
COSINES, SINES = [0.004, -0.0011, 0.0], [0.0013, 0.0, 0.0007]


def heights(rho: Any, wavelength: float = 0.193) -> Any:
    """The profile itself, wave by wave: r^m/(m R^(m-1)) with m = 2.37 and R = 1.7."""
    total = rho**2.37 / (2.37 * 1.7**1.37)
    for n, (c, s) in enumerate(zip(COSINES, SINES, strict=True), 1):
        phase = 2.0 * np.pi * n * rho / wavelength
        total = total + c * (1.0 - np.cos(phase)) + s * np.sin(phase)
    return total


def drawn(noise: float = 0.0, seed: int = 1, *, both: bool = True, points: int = 1500, **more: float) -> Any:
    """A measured line: over both flanks with its centre at 0.031, or over one from the axis on."""
    r = np.linspace(-1.15, 1.1, points) if both else np.linspace(0.0, 1.1, points)
    errors = np.random.default_rng(seed).standard_normal(r.size)
    return r, 5.2 + heights(np.abs(r - 0.031 * both), **more) + noise * errors


@pytest.mark.parametrize("both", [True, False])
@pytest.mark.parametrize("exponent", [None, 2.37])
def test_an_exact_profile_comes_back(both: bool, exponent: float | None) -> None:
    """Its points may stand in any order and twice; the profile has its largest harmonic as unit."""
    r, h = drawn(both=both)
    again = np.random.default_rng(3).permutation(np.append(np.arange(r.size), np.arange(0, r.size, 7)))
    found = fit_profile(r[again], h[again], up_to=1.0, terms=3, exponent=exponent)
    assert found.exponent == pytest.approx(2.37, rel=1e-11)
    assert found.radius == pytest.approx(1.7, rel=1e-11)
    assert found.wavelength == pytest.approx(0.193, rel=1e-12)
    assert found.centre == pytest.approx(0.031 * both, abs=1e-12)
    assert found.height == pytest.approx(5.2, rel=1e-13)
    np.testing.assert_allclose(found.cosines, COSINES, atol=1e-13)
    np.testing.assert_allclose(found.sines, SINES, atol=1e-13)
    assert found.residual_max < 64 * EPS * 6.0, "rounding of the heights"
    waves = found.profile.harmonics
    assert max(math.hypot(wave.cos, wave.sin) for wave in waves) == pytest.approx(1.0, rel=4 * EPS)
    assert waves[1].cos * found.amplitude == pytest.approx(COSINES[1], rel=1e-9)
    rho = np.linspace(0.0, 1.0, 50)
    np.testing.assert_allclose(found.heights(rho), heights(rho), atol=1e-12)


def test_an_exponent_below_2_is_found() -> None:
    r = np.linspace(0.0, 1.1, 1500)
    found = fit_profile(r, heights(r) - r**2.37 / (2.37 * 1.7**1.37) + r**1.3 / 1.3, up_to=1.0, terms=3, exponent=None)
    assert (found.exponent, found.radius) == pytest.approx((1.3, 1.0), rel=1e-9)


def pulls(found: FittedProfile, both: bool) -> list[float]:
    true = {"exponent": 2.37, "radius": 1.7, "wavelength": 0.193, "height": 5.2} | ({"centre": 0.031} if both else {})
    own = [(getattr(found, name) - value) / found.errors[name] for name, value in true.items() if found.errors[name]]
    for name, values in (("cosines", COSINES), ("sines", SINES)):
        padded = np.pad(values, (0, getattr(found, name).size - 3))
        own += list((getattr(found, name) - padded) / found.errors[name])
    return own


@pytest.mark.parametrize("exponent", [None, 2.37])
def test_with_noise_everything_is_within_its_errors_and_the_residual_is_the_noise(exponent: float | None) -> None:
    """Over 8 draws: the squares of errors in units of their standard deviations have the mean 1."""
    noise, squares, residuals = 3e-4, [], []
    for seed in range(8):
        both = bool(seed % 2)
        found = fit_profile(*drawn(noise, seed, both=both), up_to=1.0, terms=5, exponent=exponent)
        squares += [pull**2 for pull in pulls(found, both)]
        residuals.append(found.residual_rms / noise)
    spread = math.sqrt(2.0 / len(squares)) * 2.0  # of a mean of squares; those of one fit are not independent
    assert abs(np.mean(squares) - 1.0) < 3.0 * spread
    assert max(squares) < 25.0, "none is five standard deviations away"
    assert np.mean(residuals) == pytest.approx(1.0, abs=0.02), "but for the dozen of coefficients of 1,300 points"


@pytest.mark.parametrize(("wavelength", "terms"), [(0.02, 4), (0.0618, 4), (0.193, 16), (0.77, 4)])
def test_the_shortest_period_that_fits_is_taken(wavelength: float, terms: int) -> None:
    """And not a multiple, whose series holds it too; of short and of long waves."""
    found = fit_profile(*drawn(1e-4, both=False, wavelength=wavelength), up_to=1.0, terms=terms, exponent=2.37)
    assert found.wavelength == pytest.approx(wavelength, abs=5 * found.errors["wavelength"])


def test_waves_that_never_repeat_fill_the_radius_and_a_smooth_punch_has_those_of_the_noise() -> None:
    r = np.linspace(0.0, 1.0, 900)
    waves = 0.003 * np.cos(31.7 * r**2) + 0.002 * np.sin(11.3 * r)
    found = fit_profile(r, r**2 / 3.4 + waves, terms=30)
    assert 0.3 < found.wavelength <= 1.0
    assert found.residual_rms < 0.2 * np.std(waves)
    smooth = fit_profile(r, r**2 / 3.4 + 1e-4 * np.random.default_rng(5).standard_normal(r.size), terms=4)
    assert smooth.radius == pytest.approx(1.7, rel=1e-2)
    assert smooth.amplitude < 1e-4


def test_units_do_not_matter() -> None:
    r, h = drawn(1e-4)
    one, other = (fit_profile(scale * r, scale * h, up_to=scale, terms=3, exponent=None) for scale in (1.0, 1e-6))
    for name in ("radius", "wavelength", "centre", "amplitude", "residual_rms"):
        assert getattr(other, name) == pytest.approx(1e-6 * getattr(one, name), rel=1e-6)
    assert other.errors["radius"] == pytest.approx(1e-6 * one.errors["radius"], rel=1e-5)
    assert other.exponent == pytest.approx(one.exponent, rel=1e-7)


def test_many_points_are_searched_by_few() -> None:
    found = fit_profile(*drawn(3e-4, points=40_000), up_to=1.0, terms=3, exponent=None)
    assert max(abs(pull) for pull in pulls(found, both=True)) < 4.5


R = np.linspace(0.0, 1.0, 200)
WRONG = {
    "too few": ((R[:9], R[:9] ** 2), {}, "too few for 16 terms"),
    "too few inside": ((R, R**2), {"up_to": 0.1}, "up_to"),
    "falls": ((R, -(R**2)), {"terms": 2}, "reverse its sign"),
    "falls in waves": ((R, -(R**2) - 0.4 * (1.0 - np.cos(8.0 * np.pi * R))), {"terms": 4}, "reverse its sign"),
    "falls on both sides": ((R - 0.5, -((R - 0.5) ** 2)), {"terms": 2}, "reverse its sign"),
    "far from the axis": ((R + 2.5, R**2 + 0.01 * np.cos(30.0 * R)), {"terms": 2}, "axis"),
    "a few far from the axis": ((R[:2] + 2.5, R[:2]), {"terms": 2}, "too few for 2 terms"),
    "terms": ((R, R**2), {"terms": 0}, "terms"),
    "exponent": ((R, R**2), {"exponent": 1.0}, "above 1"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_fitted_is_refused(name: str) -> None:
    arrays, settings, told = WRONG[name]
    with pytest.raises(ValueError, match=told):
        fit_profile(*arrays, **settings)
