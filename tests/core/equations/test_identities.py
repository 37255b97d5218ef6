"""Closed forms of others that the equations must be equal to; NaN for each argument out of range, and the broadcast shape."""

import importlib
import inspect
import math
from collections.abc import Callable
from typing import Any, Final

import mpmath
import numpy as np
import pytest
from scipy.special import struve

import gradhesion.core.equations
from gradhesion.core.equations import effective, envelopes, general, hertz, jkr, quadrature, short_waves

EPS: Final = float(np.finfo(float).eps)
M: Final = 210.0
PI: Final = math.pi
A, R = np.linspace(0.05, 0.8, 9), np.linspace(0.0, 0.31, 9)
LOAD: Final = 1.5 * PI
COSINES, SINES = [-0.021, 0.004, 0.0], [0.003, 0.0, -0.002]
H0, H1 = (struve(order, 2 * PI * A / 0.13) for order in (0, 1))
LOG: Final = np.log((1 + A) / (1 - A))
XI: Final = np.linspace(-1.0, 2.0, 61)
NO_COEFFICIENTS: dict[str, tuple[Any, Any, int]] = {
    "terms = 5: 8 samples hold 1 to 3": (general.sampled_coefficients, np.zeros(8), 5),
    "finite": (general.sampled_coefficients, [0.0, math.nan, 0.0], 1),
    "one dimension": (general.sampled_coefficients, np.zeros((2, 8)), 1),
    "terms = 0": (general.coefficients, np.sin, 0),
    "not resolved": (general.coefficients, lambda xi: np.where(xi % 1 < 0.3, 1.0, 0.0), 2),
}
MERGED = [
    ("any_profile", "load", quadrature), ("gap", "series_gap", quadrature), ("pressure", "pressure", quadrature),
    ("early_unloading", "drop", effective), ("energy", "first_part", effective), ("profile", "height", general),
    ("fourier", "coefficients", general), ("stress_intensity", "stress_intensity", general),
    ("pair", "sine_integrals", hertz), ("saturation", "share", short_waves),
]  # fmt: skip


def sphere(r: Any) -> Any:
    return r / np.sqrt((1 - r) * (1 + r))


IDENTITIES: dict[str, tuple[Any, Any, float]] = {
    # name: found, known, absolute error over the largest known value
    "Hertz, surface": (
        quadrature.surface(0.0, 0.31 * (1 + A), 0.31, 0.31**2, 1.0, 0.0),
        0.31**2 * ((2 - (1 + A) ** 2) * np.arcsin(1 / (1 + A)) + np.sqrt((1 + A) ** 2 - 1)) / PI,
        2e-13,
    ),
    # Sneddon (1965): delta = a/2 ln((1+a)/(1-a)), P = E* [(1+a^2)/2 ln((1+a)/(1-a)) - a]
    "a sphere, adhesive load": (
        LOAD * quadrature.load(0.0, M, A, sphere), M * ((1 + A**2) / 2 * LOG - A) - np.sqrt(8 * PI * M * A**3), 1e-12,
    ),
    "a sphere, adhesive depth": (quadrature.indentation(0.0, M, A, sphere), A / 2 * LOG - np.sqrt(2 * PI * A / M), 1e-13),
    # Guduru (2007), homogeneous, H0 and H1 of 2 pi a/lambda
    "Guduru, depth": (
        jkr.indentation(0.0, M, A, 0.13, 0.017), A**2 + PI**2 * 0.017 * A * H0 - np.sqrt(2 * PI * A / M), 1e-14,
    ),
    "Guduru, load": (
        LOAD * jkr.load(0.0, M, A, 0.13, 0.017),
        4 * M * A**3 / 3 + PI * M * 0.017 * A * (2 * PI * A * H0 - 0.13 * H1) - np.sqrt(8 * PI * M * A**3),
        1e-12,
    ),
    "the least load of a smooth punch": (jkr.load(0.6, M, (1.6 * 3.6 / 4 * math.sqrt(2**1.6 * PI / M)) ** (2 / 3.6), 1.0, 0.0), -1.2, 1e-14),
    "pull at its equilibrium": (
        jkr.load(0.37, M, A, 0.13, 0.017),
        jkr.load_at_depth(0.37, M, A, jkr.indentation(0.37, M, A, 0.13, 0.017), 0.13, 0.017),
        1e-12,
    ),
    # at k = 1 every point is a spring
    "springs, depth": (hertz.indentation(1.0, A, 0.37, 0.023), general.height(A, 0.37, 0.023), 40 * EPS),
    "springs, pressure": (
        quadrature.pressure(1.0, M, R, 0.31, 0.02, 0.13, [-0.02]), M / (2 * PI) * (0.02 - general.height(R, 0.13, 0.02)), 1e-12,
    ),
    "springs, gap": (quadrature.gap(1.0, 0.2 + A, 0.2, 0.01, 0.1, 0.03), general.height(0.2 + A, 0.1, 0.03) - 0.01, 1e-14),
    "springs, gap at the edge": (quadrature.gap(1.0, 0.2, 0.2, 0.01, 0.1, 0.03), general.height(0.2, 0.1, 0.03) - 0.01, 1e-14),
    "a height": (general.height(A, 0.13, 0.021, 3.3), A**3.3 / 3.3 + 0.13 * 0.021 * (1 - np.cos(2 * PI * A / 0.13)), 1e-14),
    "a height as a series": (general.height(A, 0.13, 0.021) - A**2 / 2, 0.13 * general.waviness(A / 0.13, [-0.021]), 1e-13),
    "waviness": (
        general.waviness(XI, COSINES, SINES),
        sum(a * (np.cos(2 * PI * n * XI) - 1) + b * np.sin(2 * PI * n * XI) for n, a, b in general.harmonics(COSINES, SINES)),
        1e-13,
    ),
    "the deepest sinc": (general.DEEPEST_SINC, -mpmath.cos(mpmath.findroot(lambda y: mpmath.tan(y) - y, 4.4934)), 2 * EPS),
    "the unit of pressure": (quadrature.pressure_unit(2e-6, 0.05), 25_000.0, EPS),
    # a triangle of height 1: a_n = -4/(pi n)^2 for odd n
    "a triangle": (
        general.coefficients(lambda xi: 2 * np.minimum(xi % 1, 1 - xi % 1), 3)[0], [-4 / PI**2, 0.0, -4 / (9 * PI**2)], 1e-10,
    ),
    "a series gives its coefficients": (
        general.coefficients(lambda xi: general.waviness(xi, COSINES, SINES), 3), (COSINES, SINES), 1e-14,
    ),
    "as few samples as there may be": (
        general.sampled_coefficients(7.0 + general.waviness(np.arange(7) / 7, COSINES, SINES), 3), (COSINES, SINES), 1e-12,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", IDENTITIES)
def test_identity(name: str) -> None:
    found, known, error = IDENTITIES[name]
    known = np.asarray(known, dtype=float)
    np.testing.assert_allclose(found, known, rtol=0.0, atol=error * np.abs(known).max())


@pytest.mark.parametrize("k", [0.0, 0.43, 0.9, 1.0])
def test_flat_and_parabolic_pressures_on_a_graded_half_space(k: float) -> None:
    # Boussinesq's form, of the mean pressure: p = (1+k)/2 P/(pi a^2) (1 - r^2/a^2)^((k-1)/2)
    r, a = np.linspace(0.001, 0.3, 7), 0.31
    load = 1.5 * PI * float(hertz.disc_stiffness(k, M, a)) * 0.02
    expected = 0.5 * (1 + k) * load / (PI * a * a) * (1 - (r / a) ** 2) ** (0.5 * (k - 1))
    np.testing.assert_allclose(quadrature.flat_pressure(k, M, r, a, 0.02), expected, rtol=1e-14)
    parabolic = 2.0 ** (1.0 - k) * M / PI / (1.0 + k) ** 2 * (a * a - r * r) ** (0.5 * (1.0 + k))
    np.testing.assert_allclose(quadrature.hertz_pressure(k, M, r, a, 1.0, []), parabolic, rtol=2e-14)


def test_largest_amplitude_of_a_rising_profile() -> None:
    for wavelength in (0.013, 0.2, 1.7):
        limit = float(general.largest_monotonic_amplitude(wavelength))
        r = np.linspace(0.0, 3 * wavelength, 30001)
        below, above = (general.slope(r, wavelength, limit * share).min() for share in (1 - 1e-6, 1 + 1e-5))
        assert below >= 0.0 > above
        assert general.is_monotonic(wavelength, limit)
        assert not general.is_monotonic(wavelength, np.nextafter(limit, 1.0))


@pytest.mark.parametrize("message", NO_COEFFICIENTS)
def test_no_coefficients(message: str) -> None:
    call, values, terms = NO_COEFFICIENTS[message]
    with pytest.raises(ValueError, match=message):
        call(values, terms)


FUNCTIONS: dict[str, Callable[..., Any]] = {
    f"{module.__name__.rpartition('.')[2]}.{name}": function
    for module in (hertz, jkr, general, quadrature, envelopes, effective, short_waves)
    for name, function in vars(module).items()
    if inspect.isfunction(function) and function.__module__ == module.__name__ and name[0] != "_"
}
GOOD: dict[str, Any] = {
    "k": 0.3, "stiffness": 90.0, "radius": 0.2, "largest_radius": 0.9, "distance": 0.25, "depth": 0.01, "x": 0.7,
    "wavelength": 0.1, "amplitude": 0.01, "cosines": [-0.01], "sines": [0.02], "waves": [(1, -0.01, 0.0)],
    "exponent": 2.0, "mean_height": 0.0, "adhesion": 0.2, "waviness": 0.1, "pull": 0.1, "ratio": 0.5, "alpha": 0.01,
    "slope": np.sinh, "shortest": 1.0, "xi": 0.4, "radius_of_punch": 1.0, "work_of_adhesion": 1.0,
}  # fmt: skip
BAD = {
    "k": [-0.1, 1.1], "stiffness": [0.0, -1.0], "radius": [-0.2], "largest_radius": [-0.9, 1e-3], "x": [-0.1, np.inf],
    "wavelength": [0.0, -0.1], "amplitude": [-0.01], "exponent": [0.99], "waviness": [-0.1], "ratio": [-0.1],
    "depth": [], "alpha": [], "pull": [], "distance": [],
}  # fmt: skip
OF_ARRAYS = {name: one for name, one in FUNCTIONS.items() if not {*inspect.signature(one).parameters} & {"terms"}}
CASES = [(name, bad) for name, one in OF_ARRAYS.items() for bad in inspect.signature(one).parameters if bad in BAD]


def call(name: str, **changed: Any) -> Any:
    """Return what a function gives for good arguments but for some, the last of several arrays."""
    good = GOOD | ({"distance": 0.15} if "pressure" in name else {})
    found = FUNCTIONS[name](**{one: good[one] for one in inspect.signature(FUNCTIONS[name]).parameters} | changed)
    return found[-1] if isinstance(found, tuple) else found


@pytest.mark.parametrize(("name", "bad"), CASES)
def test_nothing_out_of_range(name: str, bad: str) -> None:
    good = np.asarray(call(name), dtype=float)
    assert np.isfinite(good).all()
    if name == "hertz.cosine_wave":
        return
    for value in (*BAD[bad], np.nan):
        found = np.asarray(call(name, **{bad: value}), dtype=float)
        assert found.shape == good.shape
        assert not found.any() if name == "general.is_monotonic" else np.isnan(found).all(), value


def test_where_a_formula_has_no_value_or_a_last_one() -> None:
    for name in ("jkr.energy_release_rate", "jkr.fold_number", "general.stress_intensity", "short_waves.load"):
        assert np.isnan(call(name, radius=0.0)), name
    assert np.isnan(call("quadrature.pressure", distance=0.201))
    assert np.isnan(call("quadrature.series_gap", distance=0.199))
    assert np.isnan(call("effective.jump_in_radius", waviness=0.2))
    for name in ("second_part", "dissipated_energy", "fitted_energy"):
        assert np.isnan(call(f"effective.{name}", amplitude=5.0)), name
    assert call("quadrature.hertz_load", radius=0.0) == call("hertz.load", radius=0.0) == 0.0
    assert call("quadrature.gap", distance=0.2) == 0.0
    assert call("hertz.indentation") == call("jkr.indentation", stiffness=np.inf)
    assert call("effective.jump_out_radius", k=1.0) == 0.0
    s, r = envelopes.adhesion_strength(0.3, 500.0), envelopes.waviness_strength(0.3, 0.1, 0.02)
    assert effective.second_part(0.3, 500.0, 0.1, 0.02, effective.jump_in_radius(0.3, s, r)) == 0.0
    assert call("short_waves.share", ratio=[1.0, 1.5, np.inf]).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", [name for name in OF_ARRAYS if "k" in inspect.signature(FUNCTIONS[name]).parameters])
def test_the_shape_is_the_broadcast_one(name: str) -> None:
    several = [one for one in ("radius", "stiffness", "wavelength", "xi", "pull", "waviness", "ratio", "x")
               if one in inspect.signature(FUNCTIONS[name]).parameters][:1]  # fmt: skip
    found = np.asarray(call(name, k=np.array([[0.3], [0.4]]), **{one: np.full(3, GOOD[one]) for one in several}))
    assert found.shape[-2:] == (2, 3 if several else 1)
    one = np.asarray(call(name, k=0.4))
    np.testing.assert_allclose(found[..., 1, -1], one, rtol=1e-15)  # to the last place of a power


@pytest.mark.parametrize(("old", "function", "new"), MERGED)
def test_names_of_merged_modules_work(old: str, function: str, new: Any) -> None:
    module = importlib.import_module(f"gradhesion.core.equations.{old}")
    assert getattr(module, function) is getattr(getattr(gradhesion.core.equations, old), function)
    assert getattr(module, function) is getattr(new, function)
