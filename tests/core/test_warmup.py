"""What is compiled ahead is all that is used then."""

import math
from typing import Any

import numpy as np
import pytest
from numba.core import event

from gradhesion.core import (
    CURVES,
    OUTPUTS,
    REPORTS,
    SENSITIVITIES,
    Harmonic,
    Loading,
    Profile,
    draw_curves,
    solve,
    warm_up,
)
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic

SCENE: dict[str, Any] = {
    "k": 0.31,
    "nu": 0.27,
    "modulus": 430.0,
    "c0_over_R": 0.013,
    "lambda_over_R": 0.17,
    "A": 0.023,
    "a_max_over_R": 0.7,
}
FAR = {"lambda_over_R": 1.3e-3, "a_max_over_R": 1.0}
DEEP = {"indentation_max_over_R": 0.04}
SPRING = {"machine_stiffness": 3.0}
LENGTH = {"toughness_wavelength_over_R": 0.3}
SLOW = {"speed_over_reference": 0.1}
OTHERS: dict[str, Any] = {
    "profile": Profile(exponent=1.0, harmonics=(Harmonic(n=2, cos=0.3, sin=0.4), Harmonic(n=5, cos=0.1)))
}
BY_LOAD: dict[str, Any] = {"profile": Profile(exponent=2.5), "loading": Loading(control="load")}
BY_MACHINE: dict[str, Any] = {"profile": OTHERS["profile"], "loading": Loading(control="machine")}
OVER: dict[str, Any] = {"toughness": Toughness((ToughnessHarmonic(n=1, cos=0.1), ToughnessHarmonic(n=4, sin=-0.2)))}
MANY_K = {"k": np.linspace(0.1, 0.9, 300)}


@pytest.fixture(scope="module")
def warm() -> list[str]:
    """The kinds of scenes that are solved ahead."""
    names: list[str] = []
    warm_up(lambda name, seconds: names.append(name) if seconds >= 0.0 else None)
    return names


@pytest.mark.slow
def test_nothing_is_left_to_compile(warm: list[str]) -> None:
    assert warm
    with event.install_recorder("numba:compiler_lock") as recorder:
        for change in ({}, {"k": 0.0, "A": 0.0}, {"k": 1.0, "nu": 0.5, "a_max_over_R": math.inf}):
            scene = SCENE | change
            solve(scene, ["pull_off_force", "pull_off_radius"])
            solve(scene, OUTPUTS)
            solve(scene, REPORTS)
            solve(scene, SENSITIVITIES)
            solve(scene | {"load_max": [0.1, 3.0]}, OUTPUTS)
            solve(scene | DEEP, SENSITIVITIES[:1])
            solve(scene | {"a_max_over_R": [0.3, 0.5, math.inf]}, OUTPUTS)
            solve(scene | FAR, OUTPUTS)
            solve(scene | FAR | {"lambda_over_R": [1e-3, 0.1], "a_max_over_R": 0.4}, ["delta_max"])
            solve(scene | {"closing_ratio": 0.7, "a_max_over_R": 0.5}, (*OUTPUTS, "snap_in_force", "front_energy"))
            for solver in ("asymptotic", "envelope"):
                solve(scene, solver=solver)
                solve(scene, solver=solver, **OTHERS)
            solve(scene, OUTPUTS, **OTHERS)
            solve(scene | FAR, SENSITIVITIES, **OTHERS)
            solve(scene, OUTPUTS, **BY_LOAD)
            solve(scene | SPRING, OUTPUTS, **BY_MACHINE)
            solve(scene | SPRING | DEEP, SENSITIVITIES, **BY_MACHINE)
            solve(scene | LENGTH, (*OUTPUTS, *REPORTS), **OVER)
            solve(scene | LENGTH | {"load_max": 1.0}, OUTPUTS, **OVER)
            solve(scene | LENGTH, SENSITIVITIES, **OVER, **OTHERS)
            solve(scene | SLOW | {"a_max_over_R": 0.5}, ["pull_off_force"], rate=Rate(exponent=0.6))
            draw_curves(scene, tuple(CURVES))
            draw_curves(scene, ("path", "jumps"), **OTHERS)
            draw_curves(scene | SPRING, ("equilibrium", "path", "jumps"), **BY_MACHINE)
            draw_curves(scene | LENGTH, ("equilibrium", "path", "jumps"), **OVER)
        solve(SCENE | MANY_K, ["pull_off_force"])
        solve(SCENE | MANY_K, ["pull_off_force"], solver="asymptotic")
    assert recorder.buffer == [], "no kernel is compiled, nor read from the cache: all have been used"


@pytest.mark.slow
def test_less_is_solved_where_not_everything_is_meant(warm: list[str]) -> None:
    names: list[str] = []
    warm_up(lambda name, _: names.append(name), everything=False)
    assert names
    assert {*names} < {*warm}
