"""The search for folds: complete, exact, and bounded, for curves with many waves, with few, and at tangency."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import YES, kernel
from gradhesion.core.curve.cosine import Cosine, depth, slope
from gradhesion.core.curve.cosine_folds import first_arch, fold_of_arch, last_arch, survey_arch
from gradhesion.core.struve.arches import inner_edge
from gradhesion.core.struve.table import struve_pair

EPS = 2.0**-52
TWO_PI = 2 * math.pi
EXPONENTS = [0.0, 1e-12, 0.29, 0.64, 1 - 1e-9, 1 - 1e-12, 1.0]


def _folds(table: Any, curve: Any, level: float) -> list[tuple[float, float, bool]]:
    """Give all folds: place, depth and whether D rises."""
    found = []
    i = int(first_arch(table, curve, level))
    final = last_arch(table, curve, level)
    while i <= final:
        survey = survey_arch(table, curve, level, i)
        kind, low, _, high = survey
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for _ in range(abs(kind)):
            place, bottom = fold_of_arch(table, curve, level, i, survey, rising, math.nan)
            assert low <= place <= high
            found.append((place, bottom, rising))
            rising = not rising
        i += 1
    return found


def _tilt(k: float, curve: Any, level: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
    s0, _, d0, _ = struve_pair(k, x)
    z = TWO_PI * x
    value: NDArray[np.float64] = curve[0] * z + curve[1] * (s0 + z * d0) - level * z ** (-0.5 * (1 + k))
    return value


def _curves(seed: int, count: int, k: float) -> list[Cosine]:
    """Draw bends and gains whose folds end within some fifty waves."""
    rng = np.random.default_rng(seed)
    made = []
    while len(made) < count:
        b, g = 10.0 ** rng.uniform(-4, 1.5), 10.0 ** rng.uniform(-3, 1)
        if ((1.35 * g + 2) / b) ** (2 / (1 + k)) < 300:
            made.append(Cosine(b, g, 0.0))
    return made


@pytest.mark.parametrize("k", EXPONENTS)
def test_none_is_missed(k: float, table_of: Callable[[float], Any]) -> None:
    """Against the signs of D on a grid of 400 points a wave: as many folds between any two points, but for pairs."""
    table = table_of(k)
    x = np.concatenate([np.geomspace(1e-9, 0.01, 400), np.arange(0.01, 60.0, 0.0025)])
    for curve in _curves(20, 60, k):
        for level in (0.5 * (1 - k), 0.5 * (3 + k)):
            places = [fold[0] for fold in _folds(table, curve, level)]
            assert places == sorted(places)
            signs = np.sign(_tilt(k, curve, level, x))
            changes = np.flatnonzero(signs[:-1] != signs[1:])
            found = np.searchsorted(x, places) - 1
            inside = [i for i in found.tolist() if 0 <= i < x.size - 1]
            counts = np.bincount(np.array(inside, dtype=np.int64), minlength=x.size)
            if level > 0:  # at k = 1 the first branch starts at zero contact
                assert (found >= 0).all()
            odd = np.flatnonzero(counts % 2)
            np.testing.assert_array_equal(odd, changes)
            # a pair between two points of the grid is a true pair: D between them has the other sign
            for i in np.flatnonzero(counts == 2):
                pair = [place for place in places if x[i] <= place <= x[i + 1]]
                middle = _tilt(k, curve, level, np.array([0.5 * sum(pair)]))
                assert np.sign(middle[0]) == -signs[i]


@pytest.mark.parametrize("k", EXPONENTS)
def test_places_and_depths(k: float, table_of: Callable[[float], Any]) -> None:
    """Each fold is within a few ulp of a zero of D, and its depth is stationary there."""
    table = table_of(k)
    level = 0.5 * (1 - k)
    for curve in _curves(21, 30, k):
        for place, bottom, rising in _folds(table, curve, level):
            d, d1, d2, here = slope(table, curve, level, place)
            z = TWO_PI * place
            size = curve[0] * z + curve[1] * min(z, z ** (0.5 * (1 - k))) + level * z ** (-0.5 * (1 + k))
            # the last step of the iteration leaves 1e-12 of a curvature length, or the rounding of D
            assert abs(d) <= 16 * EPS * size + 1e-11 * d1 * d1 / (abs(d2) + abs(d1))
            assert (d1 > 0.0) == rising or abs(d1) < 1e-6 * size
            depths = 0.5 * curve[0] * z * z + curve[1] * min(z * z, z ** (0.5 * (1 - k))) + z ** (0.5 * (1 - k))
            assert abs(bottom - here) <= 8 * EPS * depths


def test_rising_and_falling_take_turns(table_of: Callable[[float], Any]) -> None:
    for k in EXPONENTS:
        for curve in _curves(22, 40, k):
            kinds = [fold[2] for fold in _folds(table_of(k), curve, 0.5 * (1 - k))]
            # depth falls from zero contact (k < 1) and rises in the end
            assert kinds == [(i % 2 == 0) if k < 1 else (i % 2 == 1) for i in range(len(kinds))]
            assert len(kinds) % 2 == (1 if k < 1 else 0)


def test_folds_of_exponent_one_in_closed_form(table_of: Callable[[float], Any]) -> None:
    """At k = 1, D = b z + g sin z: folds where sin z = -(b/g) z, two in each lower half wave that reaches there."""
    table = table_of(1.0)
    for ratio in [1e-2, 0.037, 0.1284, 0.2172, 0.2173, 0.5, 1.5]:
        found = [TWO_PI * fold[0] for fold in _folds(table, Cosine(0.7 * ratio, 0.7, 0.0), 0.0)]
        exact = []
        half = 1
        while True:
            # the lowest point of sin z + ratio z in half wave number `half`
            bottom = (2 * half - 1) * math.pi + math.acos(min(1.0, ratio))
            if math.sin(bottom) + ratio * bottom >= 0:
                break

            def zero(z: float, ratio: float = ratio) -> float:
                return mpmath.sin(z) + mpmath.mpf(ratio) * z

            exact.append(mpmath.findroot(zero, ((2 * half - 1) * math.pi, bottom), solver="anderson", tol=1e-28))
            exact.append(mpmath.findroot(zero, (bottom, 2 * half * math.pi), solver="anderson", tol=1e-28))
            half += 1
        assert len(found) == len(exact)
        for z, truth in zip(found, exact, strict=True):
            condition = abs(ratio * float(truth)) / abs(math.cos(truth) + ratio)  # the error of the ratio itself
            assert abs(z - truth) <= 8 * EPS * (float(truth) + condition)


def _tangent(k: float, level: float, wave: int, pair: Callable[..., Any]) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Give the bend, at the gain 1, of the line that touches Q near the bottom of a wave, and z: D = D' = 0 there."""
    kappa = mpmath.mpf(k)

    def v(z: mpmath.mpf, order: int) -> mpmath.mpf:
        s0, s1 = pair(k, z)
        d0 = (1 - z * s1) / (1 + kappa)
        return s0 + z * d0 if order == 0 else 2 * d0 + z * (s1 - s0)

    # with g = 1: b z + V - level z^(-n) = 0 and b + V' + n level z^(-n-1) = 0, b from the first
    n = (1 + kappa) / 2

    def touch(z: mpmath.mpf) -> mpmath.mpf:
        b = (level * z**-n - v(z, 0)) / z
        return b + v(z, 1) + n * level * z ** (-n - 1)

    centre = float((1 + kappa) * mpmath.pi / 4 + (2 * wave + 1) * mpmath.pi)
    z = mpmath.findroot(touch, (centre - 0.6, centre + 0.9), solver="anderson", tol=1e-25)
    return (level * z**-n - v(z, 0)) / z, z


@pytest.mark.parametrize("k", [0.0, 0.29, 0.64, 1 - 1e-12, 1.0])
@pytest.mark.parametrize("wave", [1, 4, 19])
@pytest.mark.parametrize("step", [1e-4, 1e-7, 1e-10, 1e-13])
def test_tangency(k: float, wave: int, step: float, table_of: Callable[[float], Any], slow_pair: Any) -> None:
    """A pair of folds about to be born: found while the line cuts the arch, none as soon as it does not."""
    table = table_of(k)
    level = 0.5 * (1 - k)
    bend, place = _tangent(k, level, wave, slow_pair)
    for sign in (-1, 1):
        curve = Cosine(float(bend * (1 + sign * mpmath.mpf(step))), 1.0, 0.0)
        pair = [fold for fold in _folds(table, curve, level) if abs(TWO_PI * fold[0] - place) < 1.0]
        assert len(pair) == (2 if sign < 0 else 0)
        if pair:
            # D = D'' dz^2/2 - b step z: the pair opens as the root of the step
            _, _, d2, _ = slope(table, curve, level, float(place) / TWO_PI)
            opening = math.sqrt(2 * float(bend * place) * step / abs(d2))
            assert math.isclose(TWO_PI * (pair[1][0] - pair[0][0]), 2 * opening, rel_tol=0.02 + 3e-15 / step)


@pytest.mark.parametrize("k", [0.0, 0.29, 1 - 1e-12, 1.0])
def test_tangency_within_rounding(k: float, table_of: Callable[[float], Any], slow_pair: Any) -> None:
    """At the last bit a pair may be there or not, but never a single fold."""
    table = table_of(k)
    level = 0.5 * (1 - k)
    bend, place = _tangent(k, level, 6, slow_pair)
    value = float(bend)
    for _ in range(8):
        value = np.nextafter(value, 0.0)
    for _ in range(16):
        value = np.nextafter(value, 1e9)
        near = [f for f in _folds(table, Cosine(value, 1.0, 0.0), level) if abs(TWO_PI * f[0] - place) < 1.0]
        assert len(near) in {0, 2}


@pytest.mark.parametrize("k", EXPONENTS)
def test_no_fold_beyond_the_last_arch_or_before_the_first(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    level = 0.5 * (1 - k)
    for curve in [*_curves(23, 40, k), Cosine(1e-6, 2e-3, 0.0), Cosine(1e-7, 1e-3, 0.0)]:
        final = min(last_arch(table, curve, level), 4000.0)
        outside = inner_edge(table, int(final) + 1)[0] + np.arange(1, 4000) * 0.0125
        if final < 4000.0:
            assert (_tilt(k, curve, level, outside) > 0.0).all()
        first = int(first_arch(table, curve, level))
        if first > 0:
            before = np.linspace(1e-3, inner_edge(table, first)[0], 20_000)
            assert (_tilt(k, curve, level, before) < 0.0).all()


def test_the_window_is_tight(table_of: Callable[[float], Any]) -> None:
    """Few arches beyond the last fold are looked at, and few before the first: the work of a search is its folds."""
    for k in (0.0, 0.29, 0.64, 1.0):
        for curve in _curves(24, 60, k):
            level = 0.5 * (1 - k)
            folds = _folds(table_of(k), curve, level)
            if len(folds) > 1:
                end = inner_edge(table_of(k), int(last_arch(table_of(k), curve, level)))[0]
                assert end - folds[-1][0] < 2.5


def test_smooth_curve_has_one_fold(table_of: Callable[[float], Any]) -> None:
    """A vanishing gain leaves the fold of the smooth punch, b z^((3+k)/2) = (1-k)/2."""
    for k in (0.0, 0.29, 0.64):
        for b in (1e-2, 0.3, 40.0):
            folds = _folds(table_of(k), Cosine(b, 1e-300, 0.0), 0.5 * (1 - k))
            assert len(folds) == 1
            assert math.isclose(TWO_PI * folds[0][0], (0.5 * (1 - k) / b) ** (2 / (3 + k)), rel_tol=1e-12)


def test_depth_of_a_fold_is_that_of_the_curve(table_of: Callable[[float], Any]) -> None:
    for place, bottom, _ in _folds(table_of(0.29), Cosine(0.01, 0.9, 0.0), 0.355):
        assert math.isclose(bottom, depth(table_of(0.29), Cosine(0.01, 0.9, 0.0), place), rel_tol=1e-14, abs_tol=1e-14)


@kernel()
def folds_from(table: Any, curve: Cosine, level: float, survey: Any, guesses: Any) -> Any:
    """Return places and depths of the fold of the first arch, from each of some guesses."""
    found = np.empty((2, guesses.size))
    for i in range(guesses.size):
        found[0, i], found[1, i] = fold_of_arch(table, curve, level, 0, survey, YES, guesses[i])
    return found


@pytest.mark.parametrize(("k", "b", "g"), [(0.0, 0.237, 0.112), (0.29, 0.575, 0.3645), (0.64, 0.655, 0.454)])
def test_the_first_fold_is_found_from_any_guess(k: float, b: float, g: float, table_of: Callable[[float], Any]) -> None:
    """From one in some thousands the step of the fourth order vanishes, at places where D D'' = 2 D'^2."""
    table, curve, level = table_of(k), Cosine(b, g, 0.0), 0.5 * (1.0 - k)
    survey = survey_arch(table, curve, level, 0)
    kind, low, _, high = survey
    assert kind == 1
    guesses = np.linspace(low, high, 20_002)[1:-1]
    places, depths = folds_from(table, curve, level, survey, guesses)
    np.testing.assert_allclose(places, np.median(places), rtol=1e-9)
    np.testing.assert_allclose(depths, np.median(depths), rtol=1e-12)
