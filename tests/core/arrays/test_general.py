"""General scenes against 24 solved to 30 digits, and against the solver of one cosine wave."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.arrays import tables
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.problem.names import RESULTS
from gradhesion.core.problem.shape import equivalent_wave
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE
from gradhesion.core.struve.interpolated import ROUNDING

EPS = float(np.finfo(float).eps)
SCENES = json.loads((Path(__file__).parents[2] / "reference" / "general.json").read_text())["scenes"]


@pytest.mark.parametrize("stored", SCENES, ids=[str(i) for i in range(len(SCENES))])
def test_scenes_solved_to_thirty_digits(stored: dict[str, Any]) -> None:
    parameters, expected = dict(stored["parameters"]), dict(stored["expected"])
    profile = Profile(
        exponent=parameters.pop("exponent"), harmonics=tuple(Harmonic(**h) for h in parameters.pop("harmonics"))
    )
    loading = Loading(control=parameters.pop("control"))
    expected.pop("M")
    result = solve(parameters, tuple(expected), profile=profile, loading=loading)
    for name, value in expected.items():
        # the reference's energies agree with each other to 11 digits; forces and radii are those of 30 digits
        rel = {"pull_off_force": 20 * EPS, "pull_off_radius": 20 * EPS, "dissipated_energy": 1e-11}.get(name, 0.0)
        assert float(result[name]) == pytest.approx(value, rel=rel, abs=0.0), name


def _draw(count: int, seed: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(seed)
    k = rng.choice([0.0, 1e-7, 0.23, 0.5, 0.71, 0.94, 1.0], count)
    return {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, 0.27),
        "modulus": 10.0 ** rng.uniform(1.5, 4.0, count),
        "c0_over_R": 10.0 ** rng.uniform(-2.0, 0.0, count),
        "lambda_over_R": 10.0 ** rng.uniform(-2.0, 0.0, count),
        "A": 10.0 ** rng.uniform(-3.5, -0.5, count),
        "a_max_over_R": np.where(rng.random(count) < 0.2, np.inf, 10.0 ** rng.uniform(-1.3, 0.3, count)),
    }


def test_one_cosine_is_what_its_own_solver_finds() -> None:
    scenes = _draw(120, 3)
    special = solve(scenes, OUTPUTS)
    general = solve_general(scenes, RESULTS, Profile(), Loading(), 2)
    found = general["status"] & NO_VALUE == 0
    assert found.all()
    walked = special["unloading_jumps"] < 100
    sharp = found & ((special["status"] | general["status"]) & CLOSE_TO_A_JUMP == 0)
    for name in RESULTS:
        exact = name in {"loading_jumps", "unloading_jumps"}
        here = sharp if exact or name == "pull_off_radius" else walked
        # depths are differences of terms up to 50 times larger on these scenes
        rtol, atol = (0.0, 0.0) if exact else (1e-13, 1e-15)
        np.testing.assert_allclose(general[name][here], special[name][here], rtol=rtol, atol=atol, err_msg=name)
    energies = (each["dissipated_energy"] for each in (general, special))
    np.testing.assert_allclose(*energies, rtol=1e-12)  # either sums over waves in ways of its own
    told = np.int8(~CLOSE_TO_A_JUMP)
    assert np.array_equal(general["status"][found] & told, special["status"][found] & told)


def test_a_shorter_cosine_is_one_wave() -> None:
    scenes = _draw(30, 4)
    shorter = Profile(harmonics=(Harmonic(n=4, cos=0.25),))
    assert equivalent_wave(shorter) == (4, 1.0)
    one = solve(scenes | {"lambda_over_R": scenes["lambda_over_R"] / 4}, OUTPUTS)
    other = solve(scenes, OUTPUTS, profile=shorter)
    assert all(np.array_equal(one[name], other[name], equal_nan=True) for name in one)


def test_scenes_without_value() -> None:
    scene = {
        "k": 0.3,
        "nu": 0.2,
        "modulus": 100.0,
        "c0_over_R": 0.1,
        "lambda_over_R": 0.1,
        "A": 0.1,
        "a_max_over_R": 0.5,
    }
    cone = Profile(exponent=1.0)
    bad = solve(scene | {"A": [-1.0, np.nan, 0.1]}, OUTPUTS, profile=cone)
    assert (bad["status"] & NO_VALUE != 0).tolist() == [True, True, False]
    assert np.isnan(bad["pull_off_force"]).tolist() == [True, True, False]
    assert (bad["loading_jumps"] == -1).tolist() == [True, True, False]
    for key, value in [("k", 1.1), ("nu", 0.6), ("modulus", 0.0), ("lambda_over_R", np.inf), ("a_max_over_R", 0.0)]:
        assert solve(scene | {key: value}, profile=cone)["status"] == NO_VALUE, key
    # the waves on an endless cone never cease to fold: its cycle has no value, its pull-off force has
    endless = solve(scene | {"a_max_over_R": np.inf}, ["dissipated_energy"], profile=cone)
    assert endless["status"] == NO_VALUE
    assert np.isfinite(solve(scene | {"a_max_over_R": np.inf}, ["pull_off_force"], profile=cone)["pull_off_force"])
    machine = Loading(control="machine")
    stiffness = np.array([0.0, -1.0, np.nan, 1.0])
    result = solve(scene | {"machine_stiffness": stiffness}, profile=cone, loading=machine)
    assert (result["status"] & NO_VALUE != 0).tolist() == [True, True, True, False]


MANY_EXPONENTS = 160
"""Exponents of one scene each: more than it takes for their tables to be interpolated."""
INTERPOLATED = {
    "exponent 1.5": {"profile": Profile(exponent=1.5)},
    "two cosines": {"profile": Profile(harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2)))},
    "load": {"loading": Loading(control="load")},
}


def _of_many_exponents() -> dict[str, np.ndarray]:
    scenes = _draw(MANY_EXPONENTS, 7)
    return scenes | {"k": np.linspace(0.0, 0.98, MANY_EXPONENTS), "nu": np.full(MANY_EXPONENTS, 0.27)}


@pytest.mark.parametrize("how", INTERPOLATED.values(), ids=list(INTERPOLATED))
def test_many_exponents_are_each_what_they_are_alone(how: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    values, errors = ["pull_off_force", "dissipated_energy"], ["pull_off_force_error", "dissipated_energy_error"]
    scenes = _of_many_exponents()
    some = slice(0, None, 8)
    alone = solve({name: value[some] for name, value in scenes.items()}, [*values, *errors], threads=1, **how)
    monkeypatch.setattr(tables, "_tables", lambda _: pytest.fail("a table of its own"))
    together = solve(scenes, [*values, *errors], threads=2, **how)
    np.testing.assert_array_equal(together["status"][some], alone["status"])
    for name, error in zip(values, errors, strict=True):
        difference = np.abs(together[name][some] - alone[name])
        assert (difference <= together[error][some] + alone[error]).all()
    # the sizes of terms at pull-off count the sines, which are read where a table has them: up to half of a size
    ratio = together[errors[0]][some] / alone[errors[0]]
    assert (ratio > 0.5 * ROUNDING).all()
    assert (ratio <= ROUNDING * (1.0 + 1e-6)).all()


def test_sines_have_tables_of_their_own() -> None:
    profile = Profile(harmonics=(Harmonic(n=1), Harmonic(n=2, sin=0.3)))
    scenes = _of_many_exponents()
    together = solve(scenes, ["pull_off_force"], threads=1, profile=profile)["pull_off_force"]
    alone = solve({name: value[:9] for name, value in scenes.items()}, ["pull_off_force"], threads=1, profile=profile)
    np.testing.assert_array_equal(together[:9], alone["pull_off_force"])
