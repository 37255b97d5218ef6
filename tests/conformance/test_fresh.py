"""Fresh scenes of every kind, and corners, against a slow solver that shares no line with the core: balls of 51 digits."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.twin import stated
from gradhesion.twin.scene import waves_to_follow

from .kinds import COUNTS, DEPTH, KINDS, LOAD, NO_FIRST, SINES, Kind, Scenes, drawn, for_kinds, one_of, rng_of, some
from .promises import NO_VALUE, agree, errors, has

MOST_WAVES = 25.0  # of the shortest harmonic in a scene: the twin needs some 15 ms for each


def compared(kind: Kind, scene: Scenes, found: dict[str, Any]) -> int:
    """Compare one scene with the twin, within what is promised and what `verify` allows; return how many values were."""
    names = [name for name in kind.outputs if name != "contact_slope"]
    expected = stated.expected(scene, names, kind.solver, kind.shape)
    one = {name: np.reshape(value, 1) for name, value in scene.items()}
    assert not has(found, NO_VALUE), scene
    allowed = errors(kind, one, {name: np.reshape(value, 1) for name, value in found.items()})
    sure = {name: of for name, of in expected.items() if not of.near}  # a tie, or two troughs
    for name, of in sure.items():
        limit = 0.0 if name in COUNTS else min(of.error, np.nan_to_num(float(allowed[name][0]), posinf=0.0))
        off = stated.deviation(float(found[name]), of)
        assert off <= limit, (kind.name, name, float(found[name]), str(of), off, limit, scene)
    return len(sure)


@for_kinds([kind for kind in KINDS if kind.solver != "asymptotic"])
def test_fresh_scenes(kind: Kind) -> None:
    scenes, found = drawn(kind)
    values: list[int] = []
    order = rng_of(f"fresh {kind.name}").permutation(found["status"].size)
    for i in sorted(order, key=lambda i: found["loading_jumps"][i] < 2):
        scene = one_of(scenes, i)
        try:
            if kind.solver != "exact" or waves_to_follow(scene, kind.shape, cycle=True) <= MOST_WAVES:
                values.append(compared(kind, scene, some(found, i)))
        except ArithmeticError:  # one of the folds that even 51 digits do not tell apart
            continue
        if len(values) == (2 if kind.solver == "exact" else 20):
            break
    assert sum(values) > 14


SMOOTH, ULP = {"A": 0.0}, 2.0**-53
ENDLESS = {"a_max_over_R": math.inf, "lambda_over_R": 0.7}
LONG = {"k": 0.3, "nu": 0.3, "modulus": 3000.0, "c0_over_R": 0.01, "lambda_over_R": 0.005, "A": 0.01}
LONG |= {"a_max_over_R": math.inf}  # which the solver does not walk wave by wave
CORNERS: dict[str, tuple[Kind, Scenes]] = {
    "k = 0": (Kind(), {"k": 0.0}),
    "k an ulp above 0": (Kind(), {"k": 5e-324}),
    "k = 1e-16": (Kind(waves=SINES[:2]), {"k": 1e-16}),
    "k an ulp below 1": (Kind(), {"k": 1 - ULP, "nu": 0.5}),
    "k = 1": (Kind(), {"k": 1.0, "nu": 0.5}),
    "k = 1, sines": (Kind(waves=SINES[:2]), {"k": 1.0, "nu": 0.5}),
    "k = 1, load": (Kind(control="load"), {"k": 1.0, "nu": 0.5}),
    "cone": (Kind(exponent=1.0), {}),
    "cone, k = 0": (Kind(exponent=1.0), {"k": 0.0}),
    "cone, k = 1": (Kind(exponent=1.0), {"k": 1.0, "nu": 0.5}),
    "cone with a groove": (Kind(exponent=1.0, waves=((1, -1.0, -0.2),)), {}),
    "exponent 1.5, k = 0": (Kind(exponent=1.5), {"k": 0.0}),
    "exponent 1.5, k = 0, machine": (Kind(exponent=1.5, control="machine"), {"k": 0.0}),
    "exponent 6.5": (Kind(exponent=6.5), {}),
    "no first harmonic": (Kind(waves=NO_FIRST), {"lambda_over_R": 0.7}),
    "a groove": (Kind(waves=((1, -0.8, 0.0),)), {}),
    "smooth": (Kind(), SMOOTH),
    "smooth series, machine": (Kind(waves=SINES, control="machine"), SMOOTH),
    "next to smooth": (Kind(), {"A": 1e-13}),
    "rim in the first bin": (Kind(), {"a_max_over_R": 1e-6}),
    "rim in the first bin, series": (Kind(waves=SINES), {"k": 0.0, "a_max_over_R": 1e-6}),
    "tiny modulus": (Kind(), {"modulus": 1e-7}),
    "huge modulus": (Kind(), {"modulus": 1e11, "A": 1e-5}),
    "unbounded": (Kind(), ENDLESS),
    "unbounded, load": (Kind(control="load"), ENDLESS),
    "unbounded, exponent 4": (Kind(exponent=4.0), ENDLESS),
    "unbounded, exponent 1.5": (Kind(exponent=1.5), ENDLESS | {"k": 0.6, "lambda_over_R": 2.0}),
    "unbounded, envelope": (Kind(exponent=1.4, waves=SINES, solver="envelope"), ENDLESS),
    "unbounded, smooth envelope": (Kind(solver="envelope"), ENDLESS | SMOOTH),
    "ratio 0": (Kind(ratio=True), {"closing_ratio": 0.0}),
    "ratio 1e-12, sines": (Kind(ratio=True, waves=SINES[:2]), {"closing_ratio": 1e-12}),
    "ratio an ulp below 1": (Kind(ratio=True), {"closing_ratio": 1 - ULP}),
    "80 waves, turned at a depth": (Kind(turn=DEPTH), LONG | {DEPTH: 0.06}),
    "80 waves, turned at a load": (Kind(turn=LOAD), LONG | {LOAD: 20.0}),
}


@pytest.mark.parametrize("corner", CORNERS)
def test_corners(corner: str) -> None:
    (kind, special), rng = CORNERS[corner], rng_of(corner)
    scene: Scenes = {"k": 0.25, "nu": 0.21, "modulus": float(rng.uniform(150, 400)), "c0_over_R": 0.13}
    scene |= {"lambda_over_R": 0.17, "A": float(rng.uniform(0.02, 0.04)), "a_max_over_R": float(rng.uniform(0.4, 0.6))}
    scene |= {"machine_stiffness": 0.7} if kind.control == "machine" else {}
    assert compared(kind, scene | special, kind.solve(scene | special)) > 8


def test_as_many_harmonics_as_there_may_be() -> None:
    """A rough series of 64 waves: the loop integral, and the same series on a wavelength twice as long."""
    angle, size = rng_of("64 harmonics").uniform(0, 2 * np.pi, 64), np.arange(1, 65) ** -1.5
    waves = tuple((n + 1, float(size[n] * np.cos(angle[n])), float(size[n] * np.sin(angle[n]))) for n in range(64))
    kind, scenes = Kind("rough", waves=waves), some(drawn(Kind("cosine"))[0], slice(3))
    scenes |= {"A": 0.3 * scenes["A"], "lambda_over_R": 1.1 * scenes["a_max_over_R"]}
    found = kind.solve(scenes, [*kind.outputs, "energy_residual"])
    assert (np.abs(found["energy_residual"]) <= 100 * errors(kind, scenes, found)["dissipated_energy"]).all()
    doubled = replace(kind, waves=tuple((2 * n, even, odd) for n, even, odd in waves))
    other = scenes | {"lambda_over_R": 2 * scenes["lambda_over_R"], "A": scenes["A"] / 2}
    agree(kind, scenes, doubled.solve(other), found)
