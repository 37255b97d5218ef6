"""Folds and places of landing found eight at a time against those found one after the other."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.at_once import find_depths, find_zeros, guess_zeros
from gradhesion.core.curve.branches import find_depth
from gradhesion.core.curve.cosine import Cosine, slope
from gradhesion.core.curve.cosine_folds import fold_of_arch, last_arch, survey_arch
from gradhesion.core.numbers.lanes import LANES, load, store

EXPONENTS = [0.0, 0.29, 0.64, 0.97]
FAR = 14


@kernel()
def folds_at_once(table: Any, curve: Any, level: float, given: Any, out: Any) -> None:
    """Put places and depths of the folds of eight arches into `out`; rows of `given`: arch, sign, bracket."""
    guesses = guess_zeros(table, curve, level, load(given[0], 0), load(given[1], 0))
    places, depths = find_zeros(table, curve, level, load(given[2], 0), load(given[3], 0), guesses)
    store(out[0], 0, places)
    store(out[1], 0, depths)


@kernel()
def landings_at_once(table: Any, curve: Any, targets: Any, given: Any, out: Any) -> None:
    """Put places of landing into `out`; rows of `given`: start, its depth, end, its depth."""
    ends = (load(given[0], 0), load(given[1], 0), load(given[2], 0), load(given[3], 0))
    store(out, 0, find_depths(table, curve, load(targets, 0), *ends))


def _folds(table: Any, curve: Any, level: float) -> np.ndarray:
    """Arch, sign, bracket, place and depth of each fold of the arches from 14 on, in columns."""
    rows = []
    for i in range(FAR, int(last_arch(table, curve, level)) + 1):
        survey = survey_arch(table, curve, level, i)
        kind, low, peak, high = survey
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for j in range(abs(kind)):
            bracket = (low if kind != 2 or j == 0 else peak), (high if kind != 2 or j == 1 else peak)
            found = fold_of_arch(table, curve, level, i, survey, rising, math.nan)
            rows.append((i, 1.0 if rising else -1.0, *bracket, *found))
            rising = not rising
    return np.array(rows).T


def _curve(table: Any, k: float, chi: float, waves: float) -> Cosine:
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / table["amplitude"], 0.0)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("chi", [0.11, 0.8, 3.0])
def test_folds(k: float, chi: float, table_of: Callable[[float], Any]) -> None:
    table, level = table_of(k), 0.5 * (1 - k)
    curve = _curve(table, k, chi, 30.0)
    folds = _folds(table, curve, level)
    out, missed = np.empty((2, LANES)), 0
    for first in range(0, folds.shape[1] - LANES + 1, LANES):
        some = np.ascontiguousarray(folds[:, first : first + LANES])
        folds_at_once(table, curve, level, some, out)
        there = np.isfinite(out[0])
        missed += np.sum(~there)
        # the last step leaves 1e-10 of the place, and of the depth the square of that
        assert np.abs(out[0] - some[4])[there].max(initial=0.0) < 1e-8
        size = 0.5 * curve[0] * (2 * math.pi * some[4]) ** 2 + curve[1]
        assert (np.abs(out[1] - some[5]) / size)[there].max(initial=0.0) < 1e-14
    assert folds.shape[1] > 2 * LANES
    assert missed < 0.05 * folds.shape[1]  # near the place where folds end two of them nearly meet


@pytest.mark.parametrize("k", EXPONENTS)
def test_each_is_found_for_itself(k: float, table_of: Callable[[float], Any]) -> None:
    """In other company it has the same bits."""
    table, level = table_of(k), 0.5 * (1 - k)
    curve = _curve(table, k, 0.8, 30.0)
    some = np.ascontiguousarray(_folds(table, curve, level)[:, :LANES])
    out, other = np.empty((2, LANES)), np.empty((2, LANES))
    folds_at_once(table, curve, level, some, out)
    for lane in range(LANES):
        alone = np.repeat(some[:, lane : lane + 1], LANES, axis=1)
        folds_at_once(table, curve, level, alone, other)
        np.testing.assert_array_equal(other, np.repeat(out[:, lane : lane + 1], LANES, axis=1))


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("chi", [0.3, 0.8, 3.0])
def test_landings(k: float, chi: float, table_of: Callable[[float], Any]) -> None:
    table, level = table_of(k), 0.5 * (1 - k)
    curve = _curve(table, k, chi, 30.0)
    folds = _folds(table, curve, level)
    folds = folds[:, int(folds[1, 0] < 0.0) :]
    starts, stops = folds[4:, 0::2][:, :LANES], folds[4:, 1::2][:, :LANES]
    given = np.ascontiguousarray([*starts, *stops])
    rng, out = np.random.default_rng(3), np.empty(LANES)
    for _ in range(5):
        targets = given[1] + rng.uniform(0.02, 0.98, LANES) * (given[3] - given[1])
        landings_at_once(table, curve, targets, given, out)
        assert np.isfinite(out).all()
        for x, target, branch in zip(out, targets, given.T, strict=True):
            place = find_depth(table, curve, target, tuple(branch))
            # either is within what a step of a hundredth leaves
            assert abs(x - place) < 1e-7
            d, d1, _, depth = slope(table, curve, level, x)
            assert abs(depth - target) < 1e-7 * (abs(d) + abs(d1))
