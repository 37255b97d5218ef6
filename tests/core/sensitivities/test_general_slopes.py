"""Sensitivities of series, other exponents and controls: against differences, similarity, and the solver of a cosine."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import PARAMETERS, SENSITIVITIES, TURNS, Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.cosine import SLOPES, solve_cosine
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.problem.results import WHOLE_CYCLE
from gradhesion.core.sensitivities.sensitivity import NEEDED

VALUES = ("pull_off_force", "dissipated_energy")
ROUNDING = 1e-7
"""Of a difference of steps of 2e-5: 10 eps over the step, and of the place at which a jump lands, 1e-9."""
PAIR = Profile(harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=0.2, sin=-0.1)))
MANY = Profile(harmonics=tuple(Harmonic(n=n, cos=1.0 / n, sin=0.3 / n**2) for n in range(1, 9)))
CONE = Profile(exponent=1.3, harmonics=(Harmonic(n=1, sin=1.0), Harmonic(n=2, cos=0.4)))
BLUNT = Profile(exponent=3.0)
LOAD, MACHINE = Loading(control="load"), Loading(control="machine")
Scenes = Callable[..., dict[str, NDArray[np.float64]]]
Differences = Callable[..., tuple[dict[str, NDArray[np.float64]], NDArray[np.bool_]]]
CASES: list[tuple[int, dict[str, Any]]] = [
    (100, {"profile": PAIR}),
    (50, {"profile": PAIR, "loading": LOAD}),
    (50, {"profile": PAIR, "loading": MACHINE}),
    (40, {"profile": MANY, "loading": MACHINE}),
    (60, {"profile": CONE}),
    (40, {"profile": CONE, "loading": LOAD}),
    (40, {"profile": BLUNT, "loading": MACHINE}),
    (60, {"loading": LOAD}),
    (60, {"loading": MACHINE}),
]
"""500 scenes."""


def drawn(count: int, random_scenes: Scenes, settings: dict[str, Any], low: float = -1.5) -> dict[str, Any]:
    """Draw scenes of few exponents, each of which needs tables of its own."""
    scenes = random_scenes(count, 11, low, 0.0)
    rng = np.random.default_rng(12)
    scenes["k"] = rng.choice([0.0, 0.003, 0.137, 0.41, 0.78, 0.9993], count)
    if settings.get("loading") == MACHINE:
        scenes["machine_stiffness"] = 10 ** rng.uniform(-1.5, 2.0, count)
    return scenes


def worst(
    scenes: dict[str, Any], name: str, place: int, settings: dict[str, Any], differences: Differences
) -> tuple[float, int]:
    """Return the largest error of both sensitivities to a parameter, and in how many scenes they could be compared."""
    found = solve(scenes, SENSITIVITIES, check_contact=False, **settings)
    if name == "k":  # the range ends at 0 and at 1
        scenes = {key: values[(scenes["k"] > 0.001) & (scenes["k"] < 0.999)] for key, values in scenes.items()}
        inside = solve(scenes, SENSITIVITIES, check_contact=False, **settings)
        found = inside
    exact, same = differences(scenes, name, **settings)
    errors = [
        np.abs(found[one][..., place] - exact[value])[same] / (1 + np.abs(exact[value][same]))
        for one, value in zip(SENSITIVITIES, VALUES, strict=True)
    ]
    return float(np.max(errors)), int(same.sum())


@pytest.mark.parametrize(("count", "settings"), CASES)
def test_against_differences(
    count: int, settings: dict[str, Any], random_scenes: Scenes, differences: Differences
) -> None:
    scenes = drawn(count, random_scenes, settings)
    for place, name in enumerate([*PARAMETERS, "machine_stiffness"]):
        if name in scenes:
            error, compared = worst(scenes, name, place, settings, differences)
            assert compared > 0.6 * count
            assert error < ROUNDING, name


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("settings", [{"profile": PAIR}, {"loading": MACHINE}, {"profile": CONE, "loading": LOAD}])
def test_cycles_that_turn(turn: str, settings: dict[str, Any], random_scenes: Scenes, differences: Differences) -> None:
    scenes = drawn(40, random_scenes, settings, -1.0)
    low, high = (-3.5, -1.5) if turn == "indentation_max_over_R" else (-1.0, 1.0)
    scenes |= {"a_max_over_R": np.full(40, np.inf), turn: 10 ** np.random.default_rng(4).uniform(low, high, 40)}
    names = [name for name in (*PARAMETERS, "machine_stiffness", turn) if name in scenes]
    for place, name in enumerate(names):
        if name != "a_max_over_R":
            error, compared = worst(scenes, name, place, settings, differences)
            assert compared > 20
            assert error < ROUNDING, name


@pytest.mark.parametrize("settings", [{"profile": PAIR}, {"loading": LOAD}, {"profile": MANY, "loading": LOAD}])
def test_similarity(settings: dict[str, Any], random_scenes: Scenes) -> None:
    scenes = drawn(60, random_scenes, settings, -3.0)
    found = solve(scenes, SENSITIVITIES, check_contact=False, **settings)
    for name, total in zip(SENSITIVITIES, (0.0, 2.0), strict=True):
        parts = found[name][:, 3:7].T  # c0, lambda, A, a_max
        stiffness = found[name][:, 2]
        sizes = 1 + np.sum(np.abs(parts), axis=0) + 3 * np.abs(stiffness)
        assert np.max(np.abs(np.sum(parts, axis=0) - 3 * stiffness - total) / sizes) < 1e-12


def test_a_stiff_machine_prescribes_the_displacement(random_scenes: Scenes) -> None:
    """The displacement is held to 1e-9 of the depths; without a wave nothing depends on the machine but the energy."""
    scenes = random_scenes(40, 3, -1.0, 0.0) | {"k": 0.41}
    held = solve(scenes, SENSITIVITIES)
    stiff = solve(scenes | {"machine_stiffness": 1e9}, SENSITIVITIES, loading=MACHINE)
    for name in SENSITIVITIES:
        np.testing.assert_allclose(stiff[name][:, :7], held[name], rtol=1e-5, atol=1e-5)
        np.testing.assert_allclose(stiff[name][:, 7], 0.0, atol=1e-6)


def test_the_solver_of_one_cosine_has_the_same(random_scenes: Scenes) -> None:
    """By antiderivatives and sums of its own."""
    scenes = random_scenes(60, 5, -4.0, 0.0) | {"k": 0.41}
    outputs = [one for names in NEEDED.values() for one in names]
    one = solve_cosine(scenes, outputs, "exact", 1, slopes=(True, WHOLE_CYCLE))
    other = solve_general(scenes, outputs, Profile(), Loading(), 1, slopes=(True, WHOLE_CYCLE))
    same = np.isclose(one["dissipated_energy"], other["dissipated_energy"], rtol=1e-11)
    assert same.sum() > 55
    sizes = 1 + np.abs(one[SLOPES][:2, :, same])
    assert np.max(np.abs(one[SLOPES] - other[SLOPES])[:2, :, same] / sizes) < 1e-8


@pytest.mark.parametrize("settings", [{"profile": PAIR}, {"loading": LOAD}, {"profile": PAIR, "loading": MACHINE}])
@pytest.mark.parametrize("wavelength", [2e-4, 1e-5])
def test_waves_that_are_summed(
    settings: dict[str, Any], wavelength: float, random_scenes: Scenes, differences: Differences
) -> None:
    """The amplitude moves no wave past the rim, and no jump past another wave where few jumps are cut."""
    scenes = drawn(8, random_scenes, settings) | {"k": np.full(8, 0.41), "lambda_over_R": np.full(8, wavelength)}
    scenes["A"] = 10 ** np.random.default_rng(3).uniform(-4.0, -2.5, 8)
    error, compared = worst(scenes, "A", PARAMETERS.index("A"), settings, differences)
    assert compared > 3
    assert error < ROUNDING


@pytest.mark.parametrize("k", [0.0, 1.0])
def test_the_ends_of_the_range(k: float, scene: dict[str, float]) -> None:
    ends = scene | {"k": k, "nu": 0.5 if k == 1.0 else 0.3}
    for settings in ({"profile": PAIR}, {"loading": LOAD}, {"profile": CONE}):
        found = solve(ends, SENSITIVITIES, **settings)
        for name in SENSITIVITIES:
            rest = [found[name][i] for i in range(7) if not (k == 1.0 and i == 1)]
            assert np.all(np.isfinite(rest))


def test_what_has_no_influence(scene: dict[str, float]) -> None:
    found = solve(scene | {"A": 0.0, "a_max_over_R": np.inf}, SENSITIVITIES, profile=PAIR, loading=LOAD)
    for name in SENSITIVITIES:
        assert np.all(found[name][4:] == 0.0)
    refused = solve(scene | {"modulus": -1.0}, SENSITIVITIES, profile=PAIR)
    assert all(np.all(np.isnan(refused[name])) for name in SENSITIVITIES)


def test_values_are_those_without_them(random_scenes: Scenes) -> None:
    scenes = drawn(20, random_scenes, {})
    for settings in ({}, {"profile": PAIR}, {"loading": LOAD}):
        alone, both = (solve(scenes, outputs, **settings) for outputs in (VALUES, (*VALUES, *SENSITIVITIES)))
        for value in (*VALUES, "status"):
            np.testing.assert_array_equal(alone[value], both[value])


def test_threads_make_no_difference(random_scenes: Scenes) -> None:
    scenes = drawn(40, random_scenes, {})
    one, two = (solve(scenes, SENSITIVITIES, profile=PAIR, threads=threads) for threads in (1, 2))
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(one[name], two[name])
