"""Smooth punches in blocks: each as alone, wherever it stands, and as a punch whose waves have died out."""

import math
from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.arrays import cosine as cosine_arrays
from gradhesion.core.kinds import MANY_SMOOTH
from gradhesion.core.problem.curves import Curves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import RESULTS
from gradhesion.core.problem.results import Results
from gradhesion.core.problem.status import JUMP_IN_TO_RIM, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.scene.smooth import ROWS, SCENES, solve_smooth
from gradhesion.core.struve.layout import TABLE

EPS = 2.0**-52


def drawn(number: int, seed: int = 1) -> dict[str, Any]:
    """Draw scenes whose rims are anywhere about the radii that count, some out of range."""
    rng = np.random.default_rng(seed)
    k, modulus = rng.choice([0.0, 0.3, 0.97, 1.0, rng.uniform()], number), 10.0 ** rng.uniform(0.0, 5.0, number)
    material = {"k": k, "nu": 0.5, "modulus": modulus, "c0_over_R": 10.0 ** rng.uniform(-2.0, 1.0, number)}
    radius = stiffness(*material.values()) ** (-1.0 / (3.0 + k))
    rim = radius * 10.0 ** rng.uniform(-2.0, 1.0, number)
    rim[::7] = math.inf
    k[::11] = -0.1
    return {**material, "lambda_over_R": 0.1, "A": 0.0, "a_max_over_R": rim}


def solve_all(scenes: dict[str, Any], outputs: Sequence[str], **how: Any) -> dict[str, NDArray[Any]]:
    """Solve scenes in blocks, however few they are."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cosine_arrays, "MANY_SMOOTH", 1)
        return solve(scenes, outputs, **how)


@pytest.mark.parametrize("number", [1, 7, SCENES, 3 * SCENES + 5])
def test_each_is_solved_as_alone(number: int) -> None:
    scenes = drawn(number)
    whole = solve_all(scenes, OUTPUTS, threads=1)
    some = np.unique(np.linspace(0, number - 1, 20, dtype=int))
    for i in some.tolist():
        alone = solve({name: np.broadcast_to(values, number)[i] for name, values in scenes.items()}, OUTPUTS)
        for name, values in alone.items():
            np.testing.assert_array_equal(values, whole[name][i], err_msg=name)
    assert np.array_equal(whole["status"] == NO_VALUE, ~(scenes["k"] >= 0.0))


@pytest.mark.parametrize(("curves", "rims"), [(1, 1000), (5, SCENES), (70, 3), (300, 2), (3, SCENES + 1), (2, 2000)])
@pytest.mark.parametrize("outputs", [OUTPUTS, [name for name in OUTPUTS if name != "delta_max"]], ids=["all", "most"])
def test_rims_of_curves(curves: int, rims: int, outputs: Sequence[str]) -> None:
    """Of the same rims for all curves, and of their own; and far out, where they do not matter, in runs too."""
    scenes = {name: values if np.ndim(values) == 0 else values[:, None] for name, values in drawn(curves).items()}
    uniform = np.random.default_rng(2).uniform
    runs = np.where(np.arange(rims) % 700 < 500, np.linspace(4.0, 9.0, rims), 0.01)[None]
    runs[0, 2::90] = math.inf
    for own in (
        np.geomspace(0.01, 3.0, rims)[None],
        uniform(0.01, 1.0, (curves, rims)),
        uniform(3.0, 9.0, (1, rims)),
        runs,
    ):
        found = solve_all(scenes | {"a_max_over_R": own}, outputs, threads=1)
        flat = {name: np.broadcast_to(values, (curves, rims)).ravel() for name, values in scenes.items()}
        expected = solve(flat | {"a_max_over_R": np.broadcast_to(own, (curves, rims)).ravel()}, outputs, threads=1)
        for name, values in found.items():
            np.testing.assert_array_equal(values.ravel(), expected[name], err_msg=name)


def test_nothing_but_what_is_asked_for() -> None:
    scenes = drawn(500)
    whole = solve_all(scenes, OUTPUTS)
    for name in RESULTS:
        np.testing.assert_array_equal(solve_all(scenes, [name])[name], whole[name], err_msg=name)


def test_flags_are_of_what_is_asked_for() -> None:
    scene = {"k": 0.2, "nu": 0.3, "modulus": 90.0, "c0_over_R": 1.1, "lambda_over_R": 0.1, "A": 0.0}
    scene |= {"a_max_over_R": [0.05, 10.0]}
    both = PULL_OFF_AT_RIM | JUMP_IN_TO_RIM
    assert solve_all(scene, ["pull_off_radius"])["status"].tolist() == [PULL_OFF_AT_RIM, 0]
    assert solve_all(scene, ["delta_max"])["status"].tolist() == [JUMP_IN_TO_RIM, 0]
    assert solve_all(scene, ["pull_off_force", "loading_jumps"])["status"].tolist() == [both, 0]


@pytest.mark.parametrize(
    "change",
    [
        {"A": -1.0},
        {"A": math.nan},
        {"lambda_over_R": 0.0},
        {"lambda_over_R": -1.0},
        {"lambda_over_R": math.inf},
        {"nu": 0.6},
        {"k": 1.1},
        {"modulus": 0.0},
        {"c0_over_R": math.inf},
        {"a_max_over_R": 0.0},
    ],
)
def test_out_of_range(change: dict[str, float]) -> None:
    scene = {"k": 0.2, "nu": 0.3, "modulus": 90.0, "c0_over_R": 1.1, "lambda_over_R": 0.1, "A": 0.0}
    found = solve_all(scene | {"a_max_over_R": 1.0} | change, OUTPUTS)
    assert found["status"] == NO_VALUE
    assert np.isnan(found["pull_off_force"])
    assert np.isnan(found["delta_max"])
    assert found["loading_jumps"] == -1


def test_among_punches_with_waves() -> None:
    rng = np.random.default_rng(3)
    scenes = {**drawn(300), "A": rng.choice([0.0, 1e-30, 0.02], 300), "lambda_over_R": 0.3}
    whole = solve_all(scenes, OUTPUTS, threads=2)
    for amplitude in (0.0, 1e-30, 0.02):
        some = scenes["A"] == amplitude
        part = solve({name: np.broadcast_to(values, 300)[some] for name, values in scenes.items()}, OUTPUTS)
        for name, values in part.items():
            np.testing.assert_array_equal(values, whole[name][some], err_msg=name)


def test_material_and_rim_act_through_powers_that_are_right() -> None:
    """Depth and force at rims below the jump-out, of which mpmath has the powers: a^2/(1+k) - s a^((1-k)/2)."""
    rng = np.random.default_rng(4)
    for k in (0.0, 0.37, 0.9):
        for rim in (10.0 ** rng.uniform(-8.0, -2.0, 20)).tolist():
            scene = {"k": k, "nu": 0.3, "modulus": 50.0, "c0_over_R": 0.7, "lambda_over_R": 1.0, "A": 0.0}
            found = solve_all(scene | {"a_max_over_R": rim}, OUTPUTS)
            kappa, a = mpmath.mpf(k), mpmath.mpf(rim)
            s = mpmath.sqrt(2 ** (1 + kappa) * mpmath.pi / float(stiffness(k, 0.3, 50.0, 0.7)))
            depth = a**2 / (1 + kappa) - s * a ** ((1 - kappa) / 2)
            X = 2 * a ** ((3 + kappa) / 2) / ((1 + kappa) * s)
            assert abs(float(found["delta_jump_out"] / depth) - 1) <= 4 * EPS
            force = 4 * X / 3 * (1 - X / (3 + kappa))
            assert abs(float(found["pull_off_force"] / force) - 1) <= 6 * EPS


def test_kernel_takes_a_part_of_the_curves() -> None:
    k, material = np.full(9, 0.3), np.full(9, 40.0)
    out, status = np.full((len(RESULTS), 9, 2), -7.0), np.full((9, 2), -1, dtype=np.int8)
    slots, index = np.array([*range(len(RESULTS)), -1, 0, -1]), np.array([1, 8])
    which, rims = np.zeros(2, dtype=np.int64), np.array([[0.3, 0.5]])
    curves = Curves(np.empty(1, TABLE), which, index, material, np.ones(9), np.zeros(9), rims)
    solve_smooth(k, curves, Results(slots, out, status), np.empty((2, ROWS, 4)))
    others: NDArray[np.bool_] = ~np.isin(np.arange(9), index)
    assert (out[:, others] == -7.0).all()
    assert (status[others] == -1).all()
    assert np.isfinite(out[:, index]).all()


def test_many_are_solved_in_blocks_and_few_are_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """A call that compiles nothing for a few scenes more: which kernel it is shows in no value."""
    taken: list[int] = []

    def noted(k: NDArray[np.float64], curves: Curves, *others: Any) -> None:
        taken.append(curves.numbers.size)
        solve_smooth(k, curves, *others)

    monkeypatch.setattr(cosine_arrays, "solve_smooth", noted)
    scenes = drawn(MANY_SMOOTH + 1, seed=6)
    whole = solve(scenes, OUTPUTS, threads=1)
    assert sum(taken) == MANY_SMOOTH + 1
    parts = [slice(0, 1000), slice(1000, None)]
    found = [
        solve({name: values if np.ndim(values) == 0 else values[part] for name, values in scenes.items()}, OUTPUTS)
        for part in parts
    ]
    assert sum(taken) == MANY_SMOOTH + 1
    for name, values in whole.items():
        np.testing.assert_array_equal(np.concatenate([part[name] for part in found]), values, err_msg=name)


def test_sensitivities_and_other_solvers_know_no_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cosine_arrays, "MANY_SMOOTH", 1)
    monkeypatch.setattr(cosine_arrays, "solve_smooth", None)
    scenes = drawn(5)
    solve(scenes, ["pull_off_force_sensitivity"])
    solve(scenes, ["pull_off_force"], solver="envelope")


def test_reports_of_smooth_punches() -> None:
    scenes = drawn(50)
    reports = ["pull_off_force_error", "dissipated_energy_error", "saturation_radius", "energy_gain"]
    found, expected = solve_all(scenes, reports), solve(scenes, reports)
    for name, values in found.items():
        np.testing.assert_array_equal(values, expected[name], err_msg=name)


def test_an_exponent_for_each() -> None:
    """Many are solved in their order by interpolated tables, of which the stiffness is right to some units."""
    rng, number = np.random.default_rng(7), MANY_SMOOTH
    scenes = drawn(number) | {"k": rng.uniform(0.0, 1.0, number)}
    whole = solve(scenes, RESULTS, threads=1)
    for first in range(0, number, 512):
        part = {name: values if np.ndim(values) == 0 else values[first : first + 60] for name, values in scenes.items()}
        for name, values in solve(part, RESULTS).items():
            found, finite = whole[name][first : first + 60], np.isfinite(values)
            np.testing.assert_array_equal(found[~finite], values[~finite])
            # of the largest depth a difference of two terms is left, of which the rim's is the larger
            size = np.maximum(np.abs(values), part["a_max_over_R"] ** 2 if name == "delta_max" else 0.0)
            assert np.all(np.abs(found[finite] - values[finite]) <= 32 * EPS * size[finite]), name
