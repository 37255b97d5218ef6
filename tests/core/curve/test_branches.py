"""The branches of a curve: their ends are folds, depth rises between them, and a depth is found on them."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve import branches, cosine_folds
from gradhesion.core.curve.branches import END, END_DEPTH, ROWS, START, START_DEPTH, append_branches, ends, find_depth
from gradhesion.core.curve.cosine import Cosine, depth, slope
from gradhesion.core.curve.cosine_folds import first_arch, last_arch

EPS = 2.0**-52
EXPONENTS = [0.0, 0.29, 0.64, 1 - 1e-12, 1.0]
CURVES = [
    Cosine(0.03, 0.31, 0.0),
    Cosine(0.9, 3.1, 0.0),
    Cosine(0.07, 0.4, 0.0),
    Cosine(2.7, 0.01, 0.0),
    Cosine(0.3, 8.0, 0.0),
]


def _branches(table: Any, curve: Any, furthest: float = math.inf, first: int = 0) -> Any:
    """Give the trace of a curve, cut to its branches."""
    level = 0.5 * (1 - table["k"])
    final = last_arch(table, curve, level)
    trace = branches.room_for(np.full((ROWS, 400), math.nan), final + 8)
    count = append_branches(table, curve, first, final, furthest, trace, 0)
    return trace[:, :count]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_depth_rises_on_every_branch_and_falls_between(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    trace = _branches(table, curve)
    assert trace[END, -1] == math.inf
    assert trace[END_DEPTH, -1] == math.inf
    level = 0.5 * (1 - k)
    for branch in range(trace.shape[1]):
        start, start_depth, end, end_depth = ends(trace, branch)
        assert start < end
        assert start_depth < end_depth
        inside = np.linspace(start, min(end, start + 3.0), 42)[1:-1]
        assert all(slope(table, curve, level, x)[0] > 0.0 for x in inside)
        if branch > 0:
            before, before_depth = trace[END, branch - 1], trace[END_DEPTH, branch - 1]
            assert before < start
            assert before_depth > start_depth
            assert all(slope(table, curve, level, x)[0] < 0.0 for x in np.linspace(before, start, 22)[1:-1])


def test_the_first_branch_of_exponent_one_starts_at_no_contact(table_of: Callable[[float], Any]) -> None:
    for curve in CURVES:
        trace = _branches(table_of(1.0), curve)
        assert (trace[START, 0], trace[START_DEPTH, 0]) == (0.0, -1.0)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_an_early_end_cuts_no_branch(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """Every branch that starts within reach is there, whole."""
    everything = _branches(table_of(k), curve)
    for furthest in (0.01, 0.3, 1.7, 4.4, 12.0):
        part = _branches(table_of(k), curve, furthest)
        np.testing.assert_array_equal(part[: END_DEPTH + 1], everything[: END_DEPTH + 1, : part.shape[1]])
        assert part.shape[1] == np.sum(everything[START] <= furthest)


@pytest.mark.parametrize("k", EXPONENTS)
def test_a_later_beginning_leaves_out_the_first(k: float, table_of: Callable[[float], Any]) -> None:
    curve = Cosine(0.9 / 12.0 ** (1 + k), 0.9, 0.0)
    everything = _branches(table_of(k), curve)
    late = _branches(table_of(k), curve, math.inf, 7)
    # the first of them are found from other guesses
    np.testing.assert_allclose(late[: END_DEPTH + 1], everything[: END_DEPTH + 1, -late.shape[1] :], rtol=1e-11)
    assert 2 <= late.shape[1] < everything.shape[1]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_find_depth(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """The landing is stationary in the loss, so that a distance of 1e-8 is enough; most are within some ulp."""
    table = table_of(k)
    trace = _branches(table, curve)
    rng = np.random.default_rng(60)
    for branch in range(trace.shape[1]):
        start, low, end, high = ends(trace, branch)
        top = min(high, low + 30.0)
        for share in [1e-9, 1e-4, 0.5, 1 - 1e-4, 1 - 1e-9, *rng.uniform(0, 1, 5)]:
            target = low + share * (top - low)
            x = find_depth(table, curve, target, (start, low, end, high))
            assert start <= x <= end
            d, _, _, found = slope(table, curve, 0.5 * (1 - k), x)
            z = 2 * math.pi * x
            size = 0.5 * curve[0] * z * z + curve[1] * min(z * z, z ** (0.5 * (1 - k))) + z ** (0.5 * (1 - k))
            # the error of z, squared, times d is what the loss feels, in units of z
            miss = max(0.0, abs(found - target) - 8 * EPS * (size + abs(target)))
            assert miss * miss <= 1e-15 * d * max(z, 1e-300) ** (1 - k) * max(1.0, z)


def test_a_guess_of_a_half_wave() -> None:
    """Of the place on a half wave of a cosine where a share of its height is reached."""
    guess = cosine_folds.half_wave
    for share in (1e-12, 1e-6, 0.1, 0.4999, 0.5, 0.77, 1 - 1e-9):
        assert abs(guess(share) - math.acos(1.0 - 2.0 * share) / math.pi) <= 3e-5


def test_room(table_of: Callable[[float], Any]) -> None:
    trace = np.zeros((ROWS, 40))
    assert branches.room_for(trace, 40.0) is not None
    assert branches.room_for(trace, 40.0).shape == (ROWS, 40)
    assert branches.room_for(trace, 41.5).shape[1] >= 41
    assert first_arch(table_of(0.3), Cosine(0.3, 8.0, 0.0), 0.35) == 0


def test_depth_of_an_infinite_end_is_found_far_out(table_of: Callable[[float], Any]) -> None:
    for k in EXPONENTS:
        curve = Cosine(0.3, 0.01, 0.0)
        trace = _branches(table_of(k), curve)
        for target in (1.0, 1e4, 1e9):
            x = find_depth(table_of(k), curve, target, ends(trace, trace.shape[1] - 1))
            assert math.isclose(depth(table_of(k), curve, x), target, rel_tol=1e-6)


def test_far_beyond_the_last_fold_the_waves_say_nothing(table_of: Callable[[float], Any]) -> None:
    """k = 1: the bend of the paraboloid is 10^13 times weaker than that of the waves, and the zero 10^5 times further."""
    b, g = 1e-32, 2e-19
    start = 3.53e10
    branch = (start, 0.5 * b * (2 * math.pi * start) ** 2 - 1.0, math.inf, math.inf)
    x = find_depth(table_of(1.0), Cosine(b, g, 0.0), 0.0, branch)
    assert math.isclose(x, math.sqrt(2 / b) / (2 * math.pi), rel_tol=1e-9)
