"""Reduced forms: depth and load of each against its definition in slow arithmetic."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.curves.forms import EXACT, PLAIN, Reduced, fill_points, point, ripple
from gradhesion.core.curves.subject import plain_form, subject_of

EPS = 2.0**-52


@pytest.mark.parametrize("a", [1e-7, 0.003, 0.0447, 0.31, 2.9])
@pytest.mark.parametrize("k", [0.0, 0.31, 1.0])
def test_the_exact_form(a: float, k: float, scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    scene |= {"k": k, "nu": 0.5 if k == 1.0 else 0.27, "a_max_over_R": a}
    subject = subject_of(scene)
    assert subject is not None
    form = subject.exact
    assert form.is_one_wave
    depth, load = point(form.table, form.numbers, a / form.radius_scale)
    slow = slow_curve(scene)
    sizes = [abs(term) for term in slow.terms(mpmath.mpf(a))]
    # some forty roundings of each term: the reduction, the phase of a/lambda = 70 waves, and the scales
    allowed = 40 * EPS * float(sum(sizes[:3]))
    assert abs(depth * form.depth_scale - slow.depth(a)) <= allowed
    allowed = 40 * EPS * float(slow.front / slow.unit * (mpmath.mpf(a) ** (1 + slow.k) * sum(sizes[:3]) + sizes[3]))
    assert abs(load * form.load_scale - slow.load(a)) <= allowed


def test_zero_contact_has_no_load(table_of: Callable[[float], Any]) -> None:
    for k in (0.0, 0.6, 1.0):
        numbers = Reduced(EXACT, 0.3, 0.2)
        assert point(table_of(k), numbers, 0.0) == (-1.0 if k == 1.0 else 0.0, 0.0)
        # and is where the form goes to
        assert point(table_of(k), numbers, 1e-100) == pytest.approx((-1.0 if k == 1.0 else 0.0, 0.0), abs=1e-18)


@pytest.mark.parametrize("z", [0.0, 0.07, 1.9, 23.0])
def test_the_plain_form(z: float, table_of: Callable[[float], Any]) -> None:
    k, pull, height = 0.37, 0.83, 0.11
    abscissa = mpmath.mpf(z) ** ((3 + mpmath.mpf(k)) / 2)
    depth = mpmath.mpf(z) ** 2 / 2 - pull * mpmath.mpf(z) ** ((1 - mpmath.mpf(k)) / 2) + height
    found = point(table_of(k), Reduced(PLAIN, k, pull, height), z)
    assert abs(found[0] - depth) <= 4 * EPS * (z * z + pull * (1 + z) + height)
    assert abs(found[1] - abscissa * (abscissa / (3 + mpmath.mpf(k)) - pull)) <= 8 * EPS * float(
        abscissa * (abscissa + 1)
    )


def test_the_ripple_is_what_waves_add(table_of: Callable[[float], Any]) -> None:
    """Half the difference of crest and trough, less what the same curve without waves has; at 50 waves, to lambda/a."""
    table = table_of(0.37)
    waves, plain = Reduced(EXACT, 0.02, 0.5), Reduced(EXACT, 0.02, 0.0)
    half, depth, load = ripple(table, waves, 50.5)
    assert half == 0.5
    added = np.array(
        [np.subtract(point(table, waves, x), point(table, plain, x)) for x in np.linspace(50.0, 51.0, 200)]
    )
    assert 0.5 * np.ptp(added, axis=0) == pytest.approx([depth, load], rel=0.03)


def test_a_plain_form_has_no_ripple(table_of: Callable[[float], Any]) -> None:
    assert ripple(table_of(0.1), Reduced(PLAIN, 0.1, 1.0), 3.0) == (np.inf, 0.0, 0.0)


def test_many_points_are_single_points(table_of: Callable[[float], Any]) -> None:
    numbers = Reduced(EXACT, 0.03, 0.2)
    points = np.zeros((3, 40))
    points[0] = np.linspace(0.0, 21.7, 40)
    fill_points(table_of(0.2), numbers, points)
    for x, depth, load in points.T:
        assert (depth, load) == point(table_of(0.2), numbers, x)


@pytest.mark.parametrize("exact", [True, False])
def test_a_pinned_contact_is_a_flat_punch(
    exact: bool, scene: dict[str, float], slow_curve: Callable[..., Any], table_of: Callable[[float], Any]
) -> None:
    """P = K [a^(1+k) delta - I(a)], with I(a) of the profile (3.10)."""
    a, other = 0.21, 0.0173
    scene |= {"A": scene["A"] if exact else 0.0}
    slow = slow_curve(scene)
    if exact:
        subject = subject_of(scene)
        assert subject is not None
        form = subject.exact
    else:
        form = plain_form(table_of(scene["k"]), float(slow.stretch), 1.0)
    place = a / form.radius_scale
    depth, load = point(form.table, form.numbers, place)
    found = (load + form.flat_stiffness(place) * (other / form.depth_scale - depth)) * form.load_scale
    assert abs(found / slow.pinned(a, other) - 1) <= 100 * EPS  # the terms are of one size at this depth
