"""Reports of general scenes: errors against the twin, the loop integral, saturation, and the gains over a smooth punch."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.names import REPORTS, RESULTS
from gradhesion.core.problem.status import FAILED, PULL_OFF_AT_RIM
from gradhesion.twin import stated
from gradhesion.twin.path import cycle
from gradhesion.twin.scene import curve_of, waves_to_follow
from tests.twin.draw_general import general_scene, known_to_the_core

EPS = float(np.finfo(float).eps)
SCENE = {
    "k": 0.31,
    "nu": 0.2,
    "modulus": 240.0,
    "c0_over_R": 0.1,
    "lambda_over_R": 0.1,
    "A": np.array([0.0, 0.02, 0.2]),
    "a_max_over_R": 0.8,
}
SHAPE = Profile(exponent=1.6, harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2, sin=-0.3)))


def test_the_estimates_cover_the_true_errors() -> None:
    rng = np.random.default_rng(19)
    shares: dict[str, list[float]] = {"pull_off_force": [], "dissipated_energy": []}
    while len(shares["pull_off_force"]) < 40:
        scene, shape = general_scene(rng, 3)
        if waves_to_follow(scene, shape, cycle=True) > 8:
            continue
        reports = [name + "_error" for name in shares]
        values = solve(scene, (*shares, *reports), **known_to_the_core(shape))
        if values["status"] & FAILED:
            continue
        for name, one in stated.expected(scene, shares, "exact", shape).items():
            shares[name].append(stated.deviation(float(values[name]), one) / float(values[name + "_error"]))
    for found in shares.values():
        assert 1e-3 < max(found) <= 1.0, "it covers, and says something"


@pytest.mark.parametrize("control", ["displacement", "machine"])
def test_the_residual_is_that_of_another_computation(control: str) -> None:
    scene = SCENE | ({"machine_stiffness": [[0.05], [40.0]]} if control == "machine" else {})
    names = ("dissipated_energy", "energy_residual")
    values = solve(scene, names, profile=SHAPE, loading=Loading(control=control))
    residual = np.abs(values["energy_residual"] / values["dissipated_energy"])
    # the loads along the branches are up to some thousand times what is left of their loop
    assert np.all(residual <= 1e-11)
    assert np.any(residual > 0.0)
    scene |= {"a_max_over_R": math.inf, "A": SCENE["A"][:2]}
    endless = solve(scene, names, profile=SHAPE, loading=Loading(control=control))
    assert np.all(np.abs(endless["energy_residual"]) <= 1e-10 * endless["dissipated_energy"])


def test_sums_over_waves_are_told_how_good_they_are() -> None:
    """600 waves are summed; the loop integral goes through all of them, and another sum begins elsewhere."""
    shape = Profile(exponent=2.5, harmonics=SHAPE.harmonics)
    scene = SCENE | {"lambda_over_R": 1e-3, "a_max_over_R": 0.6, "A": 0.15}
    names = ("dissipated_energy", "dissipated_energy_error", "energy_residual", "saturation_radius")
    values = solve(scene, names, profile=shape)
    assert 0.0 < values["dissipated_energy_error"] < 1e-12 * values["dissipated_energy"]
    assert 0.0 < abs(values["energy_residual"]) < 1e-10 * values["dissipated_energy"]
    endless = solve(scene | {"a_max_over_R": math.inf}, names, profile=shape)
    assert 0.0 < endless["dissipated_energy_error"] < 1e-9 * endless["dissipated_energy"]
    assert np.isnan(endless["energy_residual"]), "thousands of waves"
    assert endless["saturation_radius"] == values["saturation_radius"]
    # the last fold bounds what a cycle can lose: a larger rim loses no more
    beyond = solve(scene | {"a_max_over_R": 1.01 * endless["saturation_radius"]}, names[:1], profile=shape)
    assert float(beyond["dissipated_energy"]) == pytest.approx(float(endless["dissipated_energy"]), rel=1e-9)


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_the_saturation_radius_is_that_of_the_last_fold(control: str) -> None:
    rng = np.random.default_rng(5)
    done = 0
    while done < 6:
        scene, shape = general_scene(rng, 3)
        scene["a_max_over_R"] = math.inf
        if shape.control != control or shape.exponent < 1.6 or scene["k"] == 1.0:
            continue
        if waves_to_follow(scene, shape, cycle=True) > 8:
            continue
        found = float(solve(scene, ["saturation_radius"], **known_to_the_core(shape))["saturation_radius"])
        curve = curve_of(scene, shape)
        _, branches = cycle(curve)
        assert found == pytest.approx(float(curve.radius(branches[-1].lo)), rel=100 * EPS)
        done += 1
    cone = solve(SCENE, ["saturation_radius"], profile=Profile(exponent=1.0, harmonics=SHAPE.harmonics))
    assert cone["saturation_radius"][0] < 1.0
    assert np.all(cone["saturation_radius"][1:] == math.inf), "the waves of a cone fold without end"


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_gains_are_over_the_smooth_punch_under_the_same_control(control: str) -> None:
    scene = SCENE | ({"machine_stiffness": 3.0} if control == "machine" else {})
    names = ("pull_off_force", "dissipated_energy", "adhesion_gain", "energy_gain", "roughness_parameter")
    values = solve(scene, names, profile=SHAPE, loading=Loading(control=control))
    for gain, name in (("adhesion_gain", "pull_off_force"), ("energy_gain", "dissipated_energy")):
        np.testing.assert_allclose(values[gain], values[name] / values[name][0], rtol=4 * EPS)
        assert np.all(values[gain][1:] > 1.0)
    assert values["roughness_parameter"][0] == 0.0
    assert values["roughness_parameter"][2] == pytest.approx(10.0 * values["roughness_parameter"][1], rel=4 * EPS)
    # of the force on short waves, with the envelope's shape: (1 + chi)^((m+2+k)/(m-c) ...) grows with chi alone
    limit = solve(SCENE, ["pull_off_force"], profile=SHAPE, solver="envelope")["pull_off_force"]
    power = 1.0 + 0.5 * (3.0 + 0.31) / (1.6 - 0.345)
    np.testing.assert_allclose(limit / limit[0], (1.0 + values["roughness_parameter"]) ** power, rtol=100 * EPS)


def test_one_cosine_reports_what_its_own_solver_does() -> None:
    scenes = SCENE | {"a_max_over_R": [[0.3], [math.inf]]}
    plain = solve(scenes, (*OUTPUTS, *REPORTS))
    zero_wave = Profile(harmonics=(Harmonic(n=1), Harmonic(n=2, cos=-0.0, sin=1e-300)))
    other = solve(scenes, (*OUTPUTS, *REPORTS), profile=zero_wave)
    for name in ("roughness_parameter", "saturation_radius", "adhesion_gain", "energy_gain"):
        np.testing.assert_allclose(other[name], plain[name], rtol=1e-12, err_msg=name)
    assert set(solve_general(scenes, RESULTS, zero_wave, Loading(), 1)) == {*RESULTS, "status"}


def test_a_dead_load_has_no_residual_and_scenes_without_value_no_report() -> None:
    with pytest.raises(ValueError, match="under dead load the cycle is not closed"):
        solve(SCENE, ["energy_residual"], profile=SHAPE, loading=Loading(control="load"))
    bad = solve(SCENE | {"A": [-1.0, np.nan, 0.02]}, REPORTS, profile=SHAPE)
    for name in REPORTS:
        assert np.isnan(bad[name]).tolist() == [True, True, False], name


@pytest.mark.parametrize("profile", [Profile(), Profile(harmonics=(Harmonic(n=1, sin=1.0),))])
def test_the_force_where_a_cycle_turns_is_as_good_as_its_place(profile: Profile) -> None:
    """A depth on the first half of the way, in units of 1 and of 5/4: the place where it is reached rounds anew."""
    k, factor = 0.3, 1.25
    for waves in (1e3, 1e5, 1e7, 3e8):
        wavelength = 2.0 ** round(math.log2(0.1 / waves))
        scene: Any = {"k": k, "nu": 0.3, "modulus": 3e4, "c0_over_R": 0.1, "lambda_over_R": wavelength}
        scene["A"] = amplitude_of_ratio(**scene, chi=[[0.7], [1.5]])
        scene |= {"a_max_over_R": 0.1, "indentation_max_over_R": np.geomspace(1e-7, 2e-3, 100)}
        powers = {
            "modulus": -3.0 - k,
            "indentation_max_over_R": 2.0,
            "lambda_over_R": 1.0,
            "a_max_over_R": 1.0,
            "A": 1.0,
        }
        similar = {name: value * factor ** powers.get(name, 0.0) for name, value in scene.items()}
        names = ("pull_off_force", "pull_off_force_error")
        (one, error, status), (other, other_error, _) = (
            solve(each, names, profile=profile).values() for each in (scene, similar)
        )
        assert np.any(status & PULL_OFF_AT_RIM)
        assert np.all(np.abs(one - other) <= error + other_error), waves
