"""The peer of fits: closed forms of Johnson, Kendall & Roberts (1971), distances, and their derivatives."""

import importlib
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

E_STAR, WORK, R = 2e4, 0.01, 5e-6


@pytest.fixture
def script(root: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(root)
    return importlib.import_module("benchmarks.jkr_script")


def test_the_least_load_is_that_of_johnson_kendall_and_roberts(script: Any) -> None:
    a = np.linspace(0.2, 3.0, 20_001) * (math.pi * WORK * R**2 / E_STAR) ** (1 / 3)
    assert script.load_at(a, E_STAR, WORK, R).min() == pytest.approx(-1.5 * math.pi * WORK * R, rel=1e-8)
    out, begin, turn = script.radii(E_STAR, WORK, R, 2e-6)
    assert a[np.argmin(script.depth_at(a, E_STAR, WORK, R))] == pytest.approx(out, rel=1e-3)
    assert script.depth_at(np.array([begin, turn]), E_STAR, WORK, R) == pytest.approx([0.0, 2e-6], abs=1e-16)


@pytest.mark.parametrize("number", range(3))
def test_distances_are_the_least_ones_and_move_as_their_derivatives_say(script: Any, number: int) -> None:
    branch = script.draw(3, number)
    misfit = script.Misfit(branch)
    vector = misfit.vector(branch.true)
    found = misfit.residual(vector)
    assert abs(np.mean(found**2) - 1.0) < 6.0 * math.sqrt(2.0 / found.size)
    out, begin, turn = script.radii(branch.true[0], branch.true[1], branch.R, misfit.deepest - branch.true[2])
    points = np.column_stack([branch.depth, branch.load]) / branch.noise - vector[2:]
    for way, first in ((False, begin), (True, out)):
        a = np.geomspace(first, turn, 40_000)
        curve = (
            np.column_stack([law(a, *branch.true[:2], branch.R) for law in (script.depth_at, script.load_at)])
            / branch.noise
        )
        for i in np.flatnonzero(branch.unloading == way)[::37]:
            assert abs(found[i]) <= np.min(np.hypot(*(curve - points[i]).T)) + 1e-6
    for i, step in enumerate((1e-6, 1e-6, 1e-4, 1e-4)):
        moved = np.eye(4)[i] * step
        slope = (misfit.residual(vector + moved) - misfit.residual(vector - moved)) / (2.0 * step)
        assert misfit.jacobian(vector)[:, i] == pytest.approx(slope, rel=1e-3, abs=1e-3)


def test_a_branch_gives_its_modulus_and_work_of_adhesion_back(script: Any) -> None:
    branch = script.draw(3, 2)
    values, size, _ = script.scipy_fit(branch, starts=16)
    unit = np.array([*branch.true[:2], 1.0, 1.0])
    assert np.all(np.abs(values - branch.true) / unit < 5.0 * size)
