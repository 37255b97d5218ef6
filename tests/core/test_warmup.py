"""What is compiled ahead is all that is used then."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import (
    CURVES,
    KINDS,
    MANY_SMOOTH,
    NEEDS,
    OUTPUTS,
    REPORTS,
    SENSITIVITIES,
    Harmonic,
    Loading,
    Profile,
    compile_kind,
    compiled_before,
    draw_curves,
    solve,
    watch_compilation,
)
from gradhesion.core.arrays import cosine, general
from gradhesion.core.arrays.rate import close_at_speed, open_at_speed
from gradhesion.core.curves import GENERAL_CURVES
from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.paths.path import LoopModel
from gradhesion.core.problem.names import PATTERN_CURVES
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from gradhesion.core.sweep import How
from gradhesion.core.warmup import FAR, LOOPS, SCENE, SPRING, compile_loop
from gradhesion.core.works.snap_in import pulls_at
from gradhesion.core.works.turn_slopes import turn_slopes

OTHERS = {"profile": Profile(exponent=1.0, harmonics=(Harmonic(n=2, cos=0.3, sin=0.4), Harmonic(n=5, cos=0.1)))}
LAW = Rate(exponent=0.6)
BY_LOAD = {"profile": Profile(exponent=2.5), "loading": Loading(control="load")}
FLAT = {"A": 0.0, "modulus": np.linspace(1.0, 100.0, MANY_SMOOTH)}
BY_MACHINE = {"profile": OTHERS["profile"], "loading": Loading(control="machine")}
DEEP = {"indentation_max_over_R": 0.04}
LENGTH = {"toughness_wavelength_over_R": 0.3}
OVER = {"toughness": Toughness((ToughnessHarmonic(n=1, cos=0.1), ToughnessHarmonic(n=4, sin=-0.2)), "work")}
NOT_OF_A_LOAD = tuple(name for name in REPORTS if name != "energy_residual")


def of_an_edge(scene: dict[str, Any], profile: Profile, loading: Loading) -> None:
    """Find the pull at a rim, and how a turning point there moves."""
    how = How("exact", check_contact=False, threads=1, profile=profile, loading=loading, is_one_wave=False)
    pulls_at(scene, how)
    for by_load in (False, True):
        turn_slopes(scene, by_load, how)


def at_speed(scene: dict[str, Any], profile: Profile, loading: Loading) -> None:
    """Open and close a scene at a speed."""
    for solve_at_speed in (open_at_speed, close_at_speed):
        solve_at_speed(scene | {"speed_over_reference": 0.1, "delta_max": 0.01}, LAW, profile, loading, 1)


def fit_of_a_loop() -> None:
    """Measure the distance of points to the path of a wavy punch, as a fit does."""
    model = LoopModel(
        {"k": 0.0, "nu": 0.3, "R": 5e-6, "E_star": 1e7, "work_of_adhesion": 0.03, "wavelength": 5e-7},
        ("A",), furthest=(2.5e-7, 1e-6), first=-1e-6, profile=Profile(),
    )  # fmt: skip
    points = np.zeros((3, 2))
    data = Data(points, np.array([False, True, True]), (1e-10, 1e-9), np.ones(3))
    Misfit(data, model, np.full(1, -6.0), np.full(1, -3.0)).jacobian(np.full(1, math.log(0.012)))


@pytest.mark.parametrize(
    ("kind", "works"),
    [
        (
            "force",
            [
                lambda s: solve(s, ["pull_off_force", "pull_off_radius"]),
                lambda s: solve(s | {"k": np.linspace(0.1, 0.9, 300)}, ["pull_off_force"]),
            ],
        ),
        ("energy", [solve, lambda s: solve(s | {"a_max_over_R": [0.3, 0.5, math.inf]}, OUTPUTS)]),
        (
            "long",
            [
                lambda s: solve(s | FAR, OUTPUTS),
                lambda s: solve(s | FAR | {"lambda_over_R": [1e-3, 0.1], "a_max_over_R": 0.4}, ["delta_max"]),
            ],
        ),
        ("smooth", [lambda s: solve(s | FLAT, OUTPUTS), lambda s: solve(s | FLAT, ["delta_max"])]),
        ("reports", [lambda s: solve(s, REPORTS), lambda s: solve(s, ["roughness_parameter"])]),
        ("turning", [lambda s: solve(s | {"load_max": [0.1, 3.0]}, OUTPUTS), lambda s: solve(s | DEEP, OUTPUTS)]),
        ("envelope", [lambda s: solve(s, solver="envelope")]),
        ("curves", [lambda s: draw_curves(s, list(CURVES))]),
        ("sensitivities", [lambda s: solve(s, SENSITIVITIES), lambda s: solve(s | DEEP, SENSITIVITIES[:1])]),
        ("long_sensitivities", [lambda s: solve(s | FAR, SENSITIVITIES[1:])]),
        ("general_force", [lambda s: solve(s, ["pull_off_force"], **OTHERS)]),
        ("general_energy", [lambda s: solve(s, OUTPUTS, **OTHERS), lambda s: solve(s, OUTPUTS, **BY_LOAD)]),
        (
            "general_long",
            [lambda s: solve(s | FAR, OUTPUTS, **OTHERS), lambda s: solve(s | FAR | SPRING, OUTPUTS, **BY_MACHINE)],
        ),
        ("general_reports", [lambda s: solve(s, REPORTS, **OTHERS), lambda s: solve(s, NOT_OF_A_LOAD, **BY_LOAD)]),
        ("general_turning", [lambda s: solve(s | DEEP, OUTPUTS, **OTHERS), lambda s: solve(s | DEEP, **BY_LOAD)]),
        (
            "general_sensitivities",
            [
                lambda s: solve(s, SENSITIVITIES, **OTHERS),
                lambda s: solve(s | SPRING, SENSITIVITIES[1:], loading=Loading(control="machine")),
            ],
        ),
        ("general_long_sensitivities", [lambda s: solve(s | FAR, SENSITIVITIES, **OTHERS)]),
        ("general_envelope", [lambda s: solve(s, solver="envelope", **OTHERS)]),
        (
            "general_curves",
            [
                lambda s: draw_curves(s, list(GENERAL_CURVES), **OTHERS),
                lambda s: draw_curves(s | SPRING, list(GENERAL_CURVES), None, Loading(control="machine")),
            ],
        ),
        ("edge", [lambda s: of_an_edge(s, Profile(), Loading()), lambda s: of_an_edge(s | SPRING, **BY_MACHINE)]),
        (
            "asymptotic",
            [
                lambda s: solve(s, solver="asymptotic"),
                lambda s: solve(s, solver="asymptotic", **OTHERS),
                lambda s: solve(s | {"k": np.linspace(0.1, 0.9, 300)}, ["pull_off_force"], solver="asymptotic"),
            ],
        ),
        (
            "patterned",
            [
                lambda s: solve(s | LENGTH, OUTPUTS, **OVER),
                lambda s: solve(s | LENGTH | SPRING, OUTPUTS, **OVER, **BY_MACHINE),
            ],
        ),
        ("patterned_reports", [lambda s: solve(s | LENGTH, REPORTS, **OVER)]),
        (
            "patterned_turning",
            [lambda s, turn=turn: solve(s | LENGTH | turn, OUTPUTS, **OVER) for turn in ({"load_max": 1.0}, DEEP)],
        ),
        ("patterned_sensitivities", [lambda s: solve(s | LENGTH, SENSITIVITIES, **OVER, **OTHERS)]),
        ("patterned_curves", [lambda s: draw_curves(s | LENGTH, list(PATTERN_CURVES), **OVER, **OTHERS)]),
        ("rate", [lambda s: at_speed(s, Profile(), Loading()), lambda s: at_speed(s | SPRING, **BY_MACHINE)]),
        ("loops", [lambda _: fit_of_a_loop()]),
    ],
)
def test_nothing_is_left_to_compile(kind: str, works: list[Any]) -> None:
    for needed in (*NEEDS[kind], kind):
        compile_kind(needed)
    assert compiled_before(kind)
    with watch_compilation(lambda name: pytest.fail(f"{name} is compiled by another scene of the kind")):
        for work in works:
            for change in ({}, {"k": 0.0, "A": 0.0}, {"k": 1.0, "nu": 0.5, "a_max_over_R": math.inf}):
                work(SCENE | change)


def test_the_scene_of_many_waves_is_left_for_their_loops(monkeypatch: pytest.MonkeyPatch) -> None:
    left: list[str] = []
    monkeypatch.setattr(cosine, "LONG_LOOP", lambda *_: left.append("one cosine"))
    monkeypatch.setattr(general, "solve_left", lambda *_: left.append("any profile"))
    solve(SCENE | FAR, OUTPUTS)
    solve(SCENE | FAR, OUTPUTS, **OTHERS)
    solve(SCENE | FAR | SPRING, OUTPUTS, **BY_MACHINE)
    assert left == ["one cosine", "any profile", "any profile"]


@pytest.mark.parametrize("kind", LOOPS)
def test_the_loop_that_is_compiled_before_the_tables_is_that_of_the_kind(kind: str) -> None:
    compile_kind(kind)
    with watch_compilation(lambda name: pytest.fail(f"{name} is another one than the kind has")):
        compile_loop(kind)


def test_an_unknown_kind() -> None:
    with pytest.raises(ValueError, match="kind 'all': it is one of tables, force, energy, "):
        compile_kind("all")


def test_every_kind_has_a_test_above() -> None:
    (mark,) = test_nothing_is_left_to_compile.pytestmark  # type: ignore[attr-defined]
    assert ["tables", *(kind for kind, _ in mark.args[1])] == list(KINDS)
