"""Where drawn curves turn: none missed on a dense scan, and met to rounding in slow arithmetic."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.branches import END, START
from gradhesion.core.curve.cosine import Cosine, slope, wave
from gradhesion.core.curves import knots
from gradhesion.core.curves.subject import Subject, subject_of

EPS = 2.0**-52


def _subject(scene: dict[str, float]) -> Subject:
    subject = subject_of(scene)
    assert subject is not None
    assert subject.trace is not None
    return subject


def _sign_changes(form: Any, level: float, furthest: float) -> int:
    curve = form.curve
    signs = [slope(form.table, curve, level, x)[0] > 0 for x in np.linspace(1e-3, furthest, 40_000)]
    return int(np.count_nonzero(np.diff(signs)))


@pytest.mark.parametrize(
    "change", [{}, {"k": 0.0}, {"k": 1.0, "nu": 0.5}, {"A": 0.19}, {"lambda_over_R": 0.011}], ids=str
)
def test_no_fold_is_missed(change: dict[str, float], scene: dict[str, float]) -> None:
    scene |= change
    subject, k = _subject(scene), scene["k"]
    furthest = subject.rim / subject.wavelength
    assert subject.load_folds.size == _sign_changes(subject.exact, 0.5 * (3 + k), furthest) > 0
    assert subject.trace is not None
    folds = subject.trace[[START, END]].ravel()
    folds = folds[(folds > 0) & (folds < furthest)]
    assert folds.size == _sign_changes(subject.exact, 0.5 * (1 - k), furthest) > 0
    assert (np.diff(subject.load_folds) > 0).all()


@pytest.mark.parametrize(
    "change", [{}, {"k": 0.0}, {"k": 1.0, "nu": 0.5}, {"A": 0.19}, {"lambda_over_R": 0.003}], ids=str
)
def test_folds_are_met_to_rounding(
    change: dict[str, float], scene: dict[str, float], slow_curve: Callable[..., Any]
) -> None:
    scene |= change
    subject, slow = _subject(scene), slow_curve(scene)
    assert subject.trace is not None
    folds = subject.trace[[START, END]].ravel()
    for function, places in ((slow.depth, folds), (slow.load, subject.load_folds)):
        inside = places[(places > 0) & (places < subject.rim / subject.wavelength)]
        assert inside.size
        for x in inside[:: max(1, inside.size // 4)]:
            a = x * subject.wavelength
            # roundings of x = 150 waves and of the terms of the slope, which are ten times what is left beside the turn
            assert abs(slow.turn(function, a)) <= 100 * EPS


def test_a_merging_pair_is_not_thrown_far(table_of: Callable[[float], Any]) -> None:
    """Where slope and curvature vanish together Newton's step has no sense: the place stays what it was."""
    k, x, n = 0.4, 0.45, 0.7
    table = table_of(k)
    z, power, _, _, v, v1, _ = wave(table, 0.0, x)
    bend = -(v1 + n * v / z) / (1 + n)
    level = (bend * z + v) / power
    assert bend > 0 < level
    d, d1, d2, _ = slope(table, Cosine(bend, 1.0, 0.0), level, x)
    assert max(abs(d), abs(d1)) <= 20 * EPS < 1e-3 < abs(d2)
    for guess in (x, x * (1 + 1e-13), x * (1 - 1e-9)):
        assert abs(knots.polished(table, Cosine(bend, 1.0, 0.0), level, guess) - x) <= 1e-6


def test_landed(scene: dict[str, float]) -> None:
    subject = _subject(scene)
    form = subject.exact
    curve = form.curve
    trace = subject.trace
    assert trace is not None
    for branch in range(trace.shape[1] - 1):
        x = 0.3 * trace[START, branch] + 0.7 * trace[END, branch]
        _, _, _, depth = slope(form.table, curve, 0.5 * (1 - scene["k"]), x)
        assert abs(knots.landed(form.table, curve, depth, x * (1 + 1e-9)) / x - 1) <= 20 * EPS


def test_too_many_folds(scene: dict[str, float]) -> None:
    """Two arches a wave: the limit is 50,000 waves."""
    form = _subject(scene).exact
    curve = Cosine(1e-14, form.curve.gain, 0.0)
    assert not knots.folds_too_often(form.table, curve, 49_900.0)
    assert knots.folds_too_often(form.table, curve, 50_100.0)
    assert not knots.folds_too_often(form.table, form.curve, math.inf)
