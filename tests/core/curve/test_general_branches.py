"""Where a branch meets a coordinate: within it, at its ends, and where it ends far away or never."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, coordinate, curve_of
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.curve.window import last_fold_bound
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.shape import depth_factor_of, rows_of

EPS = 2.0**-52


def _punch(k: float, compliance: float) -> tuple[Any, Any, float]:
    """Give a curve, and a place beyond its folds."""
    profile = Profile(exponent=1.5, harmonics=(Harmonic(n=1), Harmonic(n=2, cos=0.3)))
    basis = Basis(*tables_of(k), rows_of(profile))
    curve, _, _ = curve_of(k, 1.5, depth_factor_of(k, 1.5), 0.083, 0.41, 0.027, compliance)
    return basis, curve, 1.01 * last_fold_bound(basis, curve) / TWO_PI


@pytest.mark.parametrize("k", [0.0, 0.4, 0.9])
@pytest.mark.parametrize("compliance", [0.0, 1.0, math.inf])
def test_a_branch_may_end_far_away_or_never(k: float, compliance: float) -> None:
    """The place is that at which the curve has the coordinate, however far away the branch ends."""
    basis, curve, begin = _punch(k, compliance)
    level = coordinate(basis, curve, begin)
    for place in begin * np.array([1.001, 1.3, 10.0, 1e4]):
        target = coordinate(basis, curve, place)
        for end in (1.7 * place, 1e5 * place, 1e12 * place, 1e60 * place, math.inf):
            there = coordinate(basis, curve, end) if end < math.inf else math.inf
            found = find_level(basis, curve, target, (begin, level, end, there))
            # Y grows at least as the root of the place beyond the folds
            assert math.isclose(found, place, rel_tol=64 * EPS)


def test_what_a_branch_does_not_reach_is_at_its_end() -> None:
    """A level below its start, or above its end: at once, not by halving the bracket until it is empty."""
    basis, curve, begin = _punch(0.3, 0.0)
    end = 2.0 * begin
    branch = (begin, coordinate(basis, curve, begin), end, coordinate(basis, curve, end))
    assert find_level(basis, curve, branch[1] - 1.0, branch) == begin
    assert find_level(basis, curve, branch[1], branch) == begin
    assert find_level(basis, curve, branch[3], branch) == end
    assert find_level(basis, curve, branch[3] + 1.0, branch) == end


def test_turning_points_far_from_each_other_are_each_what_they_are_alone() -> None:
    scene = {"k": 0.3, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.01}
    loads = np.array([0.1, 1.0, 100.0, 1e200])
    how: dict[str, Any] = {"loading": Loading(control="load")}
    together = solve(scene | {"a_max_over_R": np.inf, "load_max": loads}, ["turning_radius"], **how)["turning_radius"]
    for load, radius in zip(loads, together, strict=True):
        alone = solve(scene | {"a_max_over_R": np.inf, "load_max": load}, ["turning_radius"], **how)["turning_radius"]
        assert math.isclose(float(alone), radius, rel_tol=64 * EPS)
