"""The arches: what the search for folds and the search for pull-off rely on, shown for many exponents.

Between the closed forms at small and large z there is no theorem to quote: the number of inflections and summits, and
the two bounds, are shown on a scan that resolves every wave 200 times, up to where the expansion at large z has
settled. Beyond, the leading terms decide: Q'' is a sine of growing amplitude, with one zero in each half wave.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.struve.arches import find_inflection, find_summit, inner_edge, summit
from gradhesion.core.struve.layout import ARCHES
from gradhesion.core.struve.table import struve_pair

TWO_PI = 2 * math.pi
EXPONENTS = [0.0, 1e-16, 1e-12, 1e-6, *np.linspace(0.02, 0.98, 17).tolist(), 1 - 1e-6, 1 - 1e-12, 1.0]
X = np.concatenate([np.geomspace(1e-6, 0.02, 200), np.arange(0.02, 132.0, 0.005), np.arange(4000.0, 4010.0, 0.005)])


def _scan(k: float) -> dict[str, Any]:
    """Give V, Q' and Q'' up to positive factors, on a scan."""
    s0, s1, d0, _ = struve_pair(k, X)
    z = TWO_PI * X
    n = 0.5 * (1 + k)
    v = s0 + z * d0
    v1 = 2 * d0 + z * (s1 - s0)
    v2 = (1 - k) * s1 - (2 - k) * s0 - z * d0
    rate = n * v / z + v1  # z^(-n) dQ/dz
    return {"z": z, "v": v, "rate": rate, "bend": n * v1 - n * v / z + z * v2, "s": s0 - s1}


def _changes(values: Any, x: Any) -> Any:
    """Give the middles of the intervals in which a function changes its sign."""
    at = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))
    return 0.5 * (x[at] + x[at + 1])


@pytest.mark.parametrize("k", EXPONENTS)
def test_every_arch_has_one_summit_between_two_inflections(k: float, table_of: Callable[[float], Any]) -> None:
    scan = _scan(k)
    near = X < 200.0
    inflections = _changes(scan["bend"][near], X[near])
    summits = _changes(scan["rate"][near], X[near])
    count = min(inflections.size, ARCHES)
    assert count > 255
    stored = table_of(k)["arches"]
    # arch 0 begins at z = 0; none of the scan's inflections is missing from the table, and none is twice in it
    np.testing.assert_allclose(inflections[:count], stored[1 : count + 1, 0], rtol=0, atol=0.0026)
    np.testing.assert_allclose(summits[:count], stored[:count, 3], rtol=0, atol=0.0026)
    assert (stored[:-1, 0] < stored[:-1, 3]).all()
    assert (stored[:-1, 3] < stored[1:, 0]).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_even_arches_are_concave_and_odd_ones_convex(k: float, table_of: Callable[[float], Any]) -> None:
    scan, edges = _scan(k), table_of(k)["arches"][:, 0]
    for i in range(ARCHES):
        inside = (edges[i] * (1 + 1e-9) < X) & (edges[i + 1] * (1 - 1e-9) > X)
        sign = 1 if i % 2 == 0 else -1
        assert (sign * scan["bend"][inside] < 0.0).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_far_arches_are_half_waves(k: float, table_of: Callable[[float], Any]) -> None:
    scan, table = _scan(k), table_of(k)
    far = X >= 4000.0
    inflections = _changes(scan["bend"][far], X[far])
    summits = _changes(scan["rate"][far], X[far])
    assert 19 <= inflections.size <= 21
    assert 19 <= summits.size <= 21
    first = round((TWO_PI * inflections[0] - table["phase"]) / math.pi + 0.5)
    assert math.isclose(inner_edge(table, first)[0], inflections[0], abs_tol=0.0026)
    places = [summit(table, i)[0] for i in range(first - 1, first + 21)]
    for place in summits:
        assert min(abs(place - other) for other in places) < 0.0026


@pytest.mark.parametrize("k", EXPONENTS)
def test_no_fold_function_leaves_its_envelope(k: float, table_of: Callable[[float], Any]) -> None:
    """|V| <= C z^(1-n) (1 + 0.35/z^2): where folds.last_arch ends the search."""
    scan, amplitude = _scan(k), table_of(k)["amplitude"]
    z = scan["z"]
    bound = amplitude * z ** (0.5 * (1 - k)) * (1 + 0.35 / z**2)
    assert (np.abs(scan["v"]) <= bound * (1 + 4e-16)).all()


@pytest.mark.parametrize("k", EXPONENTS)
def test_no_load_lies_below_its_parabola(k: float, table_of: Callable[[float], Any]) -> None:
    """-z (S0 - S1) <= C z^c (1 + 2.1/z^2): where pull_off.lowest_load ends the search."""
    scan, amplitude = _scan(k), table_of(k)["amplitude"]
    z = scan["z"]
    bound = amplitude * z ** (0.5 * (1 - k)) * (1 + 2.1 / z**2)
    assert (-z * scan["s"] <= bound * (1 + 4e-16)).all()


@pytest.mark.parametrize("k", [0.0, 0.37, 1 - 1e-12, 1.0])
def test_edges_and_summits_are_zeros(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    n = 0.5 * (1 + k)
    for i in [1, 2, 5, 30, ARCHES, ARCHES + 1, 3000]:
        for (x, abscissa, height), of_bend in ((inner_edge(table, i), True), (summit(table, i), False)):
            s0, s1, d0, _ = struve_pair(k, x)
            z = TWO_PI * x
            v, v1, v2 = s0 + z * d0, 2 * d0 + z * (s1 - s0), (1 - k) * s1 - (2 - k) * s0 - z * d0
            value = n * v1 - n * v / z + z * v2 if of_bend else n * v / z + v1
            # Newton stops at a step of 1e-12 x, after which the next would be of its square
            # beyond the table two terms of the expansion leave 1e-8
            miss = 1e-11 if i <= ARCHES else 1e-7
            assert abs(value) <= miss * z * z ** (0.5 * (1 - k)) * (z if of_bend else 1)
            assert math.isclose(abscissa, z ** (1 + n), rel_tol=1e-14)
            assert math.isclose(height, z**n * v, rel_tol=1e-13, abs_tol=1e-13 * z)


def test_stored_arches_are_those_that_are_found(table_of: Callable[[float], Any]) -> None:
    table = table_of(0.61)
    for i in (0, 1, 17, ARCHES):
        assert inner_edge(table, i) == find_inflection(table, i)
        assert summit(table, i) == find_summit(table, i)


def test_the_first_arch_begins_at_zero(table_of: Callable[[float], Any]) -> None:
    assert inner_edge(table_of(0.2), 0) == (0.0, 0.0, 0.0)


def test_at_exponent_one_the_fold_function_is_z_sin_z(table_of: Callable[[float], Any]) -> None:
    """Q(X) = z sin z in X = z^2: summits where tan z = -z, inflections where (1 + z^2) sin z = z cos z."""
    table = table_of(1.0)
    for i in range(60):
        z = TWO_PI * summit(table, i)[0]
        assert abs(math.sin(z) + z * math.cos(z)) <= 1e-12 * (1 + z * z)
        assert math.isclose(summit(table, i)[2], z * math.sin(z), abs_tol=1e-12 * z)
        if i > 0:
            z = TWO_PI * inner_edge(table, i)[0]
            assert abs((1 + z * z) * math.sin(z) - z * math.cos(z)) <= 1e-11 * z**3


@pytest.mark.parametrize("k", EXPONENTS)
def test_depth_and_load_stay_within_the_bounds_of_a_turn(k: float, table_of: Callable[[float], Any]) -> None:
    """-z S0 <= C z^c and -C z^c <= -z (S0 - S1) <= 1.06 C z^c: how far out a depth or a load can be met."""
    scan = _scan(k)
    z, depth = scan["z"], struve_pair(k, X)[0]
    bound = table_of(k)["amplitude"] * z ** (0.5 * (1 - k)) * (1 + 4e-16)
    assert (-z * depth <= bound).all()
    assert (z * scan["s"] <= bound).all()
    assert (-z * scan["s"] <= 1.06 * bound).all()
    assert (-z * scan["s"]).max() > 0.0
