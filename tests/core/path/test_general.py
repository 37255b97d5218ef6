"""The cycle under any control: its limits, its loop integral, pairs of folds about to be born, and what it costs."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve import general_energy as energy
from gradhesion.core.curve import general_folds as folds
from gradhesion.core.curve.general import Basis, coordinate, curve_of, slope
from gradhesion.core.curve.general_folds import find_folds, room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.equations import general
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.shape import depth_factor_of, rows_of

pytestmark = pytest.mark.slow

SCENES = json.loads((Path(__file__).parents[2] / "reference" / "general.json").read_text())["scenes"]
MACHINE = Loading(control="machine")


def _parts(index: int) -> tuple[dict[str, Any], Profile]:
    parameters = dict(SCENES[index]["parameters"])
    profile = Profile(
        exponent=parameters.pop("exponent"), harmonics=tuple(Harmonic(**h) for h in parameters.pop("harmonics"))
    )
    parameters.pop("control")
    parameters.pop("machine_stiffness", None)
    return parameters, profile


@pytest.mark.parametrize("index", [0, 1, 3, 5, 9, 12, 14, 20, 21])
def test_a_stiff_machine_prescribes_the_displacement(index: int) -> None:
    parameters, profile = _parts(index)
    stiff = solve(parameters | {"machine_stiffness": 1e14}, OUTPUTS, profile=profile, loading=MACHINE)
    rigid = solve(parameters, OUTPUTS, profile=profile)
    for name in OUTPUTS:
        assert float(stiff[name]) == pytest.approx(float(rigid[name]), rel=1e-10), name


@pytest.mark.parametrize("index", [0, 1, 3, 5, 9, 12, 14, 20, 21])
def test_a_soft_machine_prescribes_the_load(index: int) -> None:
    parameters, profile = _parts(index)
    softness = 1e-14
    soft = solve(parameters | {"machine_stiffness": softness}, OUTPUTS, profile=profile, loading=MACHINE)
    dead = solve(parameters, OUTPUTS, profile=profile, loading=Loading(control="load"))
    for name in OUTPUTS:
        if name not in ("dissipated_energy", "unloading_energy"):
            assert float(soft[name]) == pytest.approx(float(dead[name]), rel=1e-10), name
    # the jump-out loses the energy of the spring, P^2/(2 S), and what is bounded
    spring = (1.5 * math.pi * float(dead["pull_off_force"])) ** 2 / (2.0 * softness * parameters["modulus"])
    assert float(soft["dissipated_energy"]) == pytest.approx(spring, rel=1e-10)


@pytest.mark.parametrize("index", [0, 3, 9, 12, 15, 21])
@pytest.mark.parametrize("machine", [math.inf, 0.9, 0.05])
def test_jumps_lose_the_loop_integral(index: int, machine: float) -> None:
    """A dense grid of radii, the running maximum and minimum of D, and the trapezoidal rule for P dD."""
    p, profile = _parts(index)
    loading = MACHINE if machine < math.inf else Loading()
    result = solve(p | ({"machine_stiffness": machine} if machine < math.inf else {}), profile=profile, loading=loading)
    count = max(h.n for h in profile.harmonics)
    cosines, sines = [0.0] * count, [0.0] * count
    for h in profile.harmonics:
        cosines[h.n - 1], sines[h.n - 1] = -p["A"] * h.cos, p["A"] * h.sin
    k, M = p["k"], float(stiffness(p["k"], p["nu"], p["modulus"], p["c0_over_R"]))
    grid = np.concatenate([np.geomspace(1e-6, 1e-2, 2000, endpoint=False), np.linspace(1e-2, 1.0, 40_001)])
    a = grid * p["a_max_over_R"]
    wave = (p["lambda_over_R"], cosines, sines, profile.exponent)
    P = 1.5 * math.pi * general.load(k, M, a, *wave)
    spring = 1.0 / (machine * p["modulus"])
    D = general.indentation(k, M, a, *wave) + P * spring
    load = np.maximum.accumulate(np.maximum(D, 0.0))
    unload = np.minimum.accumulate(D[::-1])[::-1]
    mean = 0.5 * (P[1:] + P[:-1])
    pinned = 1.0 / ((1.0 + k) / (2.0 ** (1.0 - k) * M * a[-1] ** (1.0 + k)) + spring)
    beyond = load[-1] - D[-1]
    loop = np.sum(mean * np.diff(load)) - np.sum(mean * np.diff(unload))
    loop -= beyond * (P[-1] + 0.5 * pinned * beyond)
    # steps of 1/40,000 miss a fold by their square: 1e-5 of a jump at most
    assert float(result["dissipated_energy"]) == pytest.approx(loop, rel=3e-4)


def _count(k: float, m: float, profile: Profile, gain: float, compliance: float) -> tuple[int, float]:
    basis = Basis(*tables_of(k), rows_of(profile))
    curve, _, _ = curve_of(k, m, depth_factor_of(k, m), 0.08, 0.2, gain, compliance)
    zeros = np.empty(folds.MOST_FOLDS)
    first, last = first_fold_bound(basis, curve) / TWO_PI, last_fold_bound(basis, curve) / TWO_PI
    count, _, tangency = find_folds(basis, curve, first, last, room(), zeros)
    return count, tangency


@pytest.mark.parametrize("compliance", [0.0, 2.0, math.inf])
@pytest.mark.parametrize(("k", "m"), [(0.0, 2.0), (0.4, 3.0), (1.0, 1.5)])
def test_a_pair_about_to_be_born(k: float, m: float, compliance: float) -> None:
    """D is linear in A: a pair is born at the extrema of -D(A=0)/(dD/dA) over the radius, which a fine scan finds."""
    profile = Profile(exponent=m, harmonics=(Harmonic(n=1, cos=0.7, sin=0.3), Harmonic(n=3, cos=-0.11, sin=0.05)))
    basis = Basis(*tables_of(k), rows_of(profile))

    def critical(x: float) -> float:
        smooth, _, _ = slope(basis, curve_of(k, m, depth_factor_of(k, m), 0.08, 0.2, 0.0, compliance)[0], x)
        whole, _, _ = slope(basis, curve_of(k, m, depth_factor_of(k, m), 0.08, 0.2, 1.0, compliance)[0], x)
        return -smooth / (whole - smooth)

    grid = np.linspace(0.3, 6.0, 3001)
    values = np.array([critical(x) for x in grid])
    births = [
        i
        for i in range(1, grid.size - 1)
        if values[i] > 1e-4 and values[i] < min(values[i - 1], values[i + 1]) and values[i] < 0.2
    ]
    assert births
    for i in births:
        low, high = grid[i - 1], grid[i + 1]
        for _ in range(80):  # golden section
            one, other = low + 0.381966 * (high - low), low + 0.618034 * (high - low)
            low, high = (low, other) if critical(one) < critical(other) else (one, high)
        gain = critical(0.5 * (low + high))
        before, _ = _count(k, m, profile, gain * (1.0 - 1e-11), compliance)
        after, _ = _count(k, m, profile, gain * (1.0 + 1e-11), compliance)
        assert after == before + 2
        count, tangency = _count(k, m, profile, gain * (1.0 - 1e-14), compliance)
        assert tangency < math.inf or count == after


def test_bounds_of_the_window() -> None:
    """Beyond the bounds D has one sign, and the bounds of V hold on a scan of 50 points a wave over 60 waves."""
    profile = Profile(harmonics=(Harmonic(n=1, cos=0.7, sin=-0.3), Harmonic(n=4, cos=0.2, sin=0.1)))
    for k in (0.0, 0.3, 0.8, 1.0):
        for m in (1.6, 2.0, 5.0):
            for compliance in (0.0, 3.0, math.inf):
                basis = Basis(*tables_of(k), rows_of(profile))
                curve, _, _ = curve_of(k, m, depth_factor_of(k, m), 0.08, 0.2, 0.02, compliance)
                first, last = first_fold_bound(basis, curve) / TWO_PI, last_fold_bound(basis, curve) / TWO_PI
                if first > 1e-20:
                    assert all(slope(basis, curve, first * t)[0] < 0.0 for t in np.geomspace(1e-6, 1.0, 200))
                assert all(slope(basis, curve, last + t)[0] > 0.0 for t in np.linspace(0.0, 60.0, 3001))


def test_cost_is_linear_in_the_number_of_harmonics(monkeypatch: pytest.MonkeyPatch) -> None:
    """The radii that are looked at depend on the shortest wave; each costs one term for each harmonic."""
    calls = []
    counted = slope

    def count(*arguments: Any) -> Any:
        calls.append(1)
        return counted(*arguments)

    basis = Basis(*tables_of(0.3), rows_of(Profile(harmonics=(Harmonic(n=16, cos=0.1),))))
    curve, _, _ = curve_of(0.3, 2.0, depth_factor_of(0.3, 2.0), 0.08, 0.2, 0.05, 0.0)
    folds.refine(basis, curve, 0.3, 0.2, 0.4, True, 0.0)  # compiled with what it calls, before that is replaced
    monkeypatch.setattr(folds, "slope", count)
    for name in ("folds_of_cell", "refine"):
        monkeypatch.setattr(folds, name, getattr(folds, name).py_func)
    radii = []
    for harmonics in (1, 2, 4, 8):
        series = (*(Harmonic(n=n, cos=1e-3) for n in range(2, harmonics + 1)), Harmonic(n=16, cos=0.1))
        basis = Basis(*tables_of(0.3), rows_of(Profile(harmonics=series)))
        curve, _, _ = curve_of(0.3, 2.0, depth_factor_of(0.3, 2.0), 0.08, 0.2, 0.05, 0.0)
        calls.clear()
        find_folds.py_func(basis, curve, 0.01, 2.0, room(), np.empty(1000))
        radii.append(len(calls))
    assert max(radii) < 1.2 * min(radii), "the folds are not as many, and each is refined"
    assert max(radii) < 8 * (4 * 16 * 2.0 + 20), "those of the refinement among them"


def test_a_jump_is_the_sum_of_its_parts() -> None:
    """The energy is additive along the radius, whether it is taken from zero contact or from the curve."""
    basis = Basis(*tables_of(0.4), rows_of(Profile(harmonics=(Harmonic(n=3, cos=0.5, sin=0.4),))))
    for compliance in (0.0, 0.6, 50.0):
        curve, _, _ = curve_of(0.4, 2.7, depth_factor_of(0.4, 2.7), 0.08, 0.2, 0.03, compliance)
        start = 1.1
        level_there = coordinate(basis, curve, start)
        whole = energy.energy_from_zero(basis, curve, 2.3, level_there)
        inner = energy.energy_from_zero(basis, curve, start, level_there)
        assert energy.jump_energy(basis, curve, start, 2.3) == pytest.approx(whole - inner, rel=1e-12)
