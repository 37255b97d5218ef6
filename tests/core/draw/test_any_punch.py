"""Curves of any profile and control: they turn where they should, and what cannot be drawn is said."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.problem.status import NO_VALUE

EPS = float(np.finfo(float).eps)
SCENE = {
    "k": 0.3,
    "nu": 0.27,
    "modulus": 430.0,
    "c0_over_R": 0.05,
    "lambda_over_R": 0.1,
    "A": 0.02,
    "a_max_over_R": 0.8,
}
ROUGH = Profile(exponent=1.5, harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=0.2, sin=-0.1)))


@pytest.mark.parametrize("rim", [0.5, math.inf])
def test_a_third_harmonic_alone_is_a_cosine_of_a_third_of_the_length(rim: float) -> None:
    """Three times the amplitude over the wavelength; the sizes of the terms are the same but for rounding."""
    scene = SCENE | {"a_max_over_R": rim}
    curves = ["equilibrium", "path", "smooth", "jumps", "asymptotic", "envelope", "effective"]
    third, _ = draw_curves(scene, curves, Profile(harmonics=(Harmonic(n=3, cos=0.7),)))
    own, _ = draw_curves(scene | {"lambda_over_R": 0.1 / 3, "A": 3 * 0.7 * 0.02}, curves)
    assert own.keys() == third.keys()
    for name, values in own.items():
        np.testing.assert_allclose(third[name], values, rtol=1e-12, atol=1e3 * EPS * np.abs(values).max(initial=0.0))


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_stability_changes_where_what_is_prescribed_turns(control: str) -> None:
    machine = {"machine_stiffness": 2.0} if control == "machine" else {}
    curve, _ = draw_curves(SCENE | machine, ["equilibrium"], ROUGH, Loading(control=control))
    depth, load = curve["indentation"], curve["load"]
    # P/(S R) with S = 2 E* R: P is in units of 1.5 pi R dgamma and E* in those of dgamma/R
    moved = {"displacement": depth, "load": load, "machine": depth + 1.5 * math.pi * load / (2.0 * 430.0)}[control]
    stable = (curve["stable"][1:] == 1) | (curve["stable"][:-1] == 1)
    assert np.diff(stable).sum() > 5
    assert np.array_equal(np.diff(moved) > 0.0, stable)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 4.0])
def test_the_smooth_punch_of_any_power_is_the_closed_form(exponent: float) -> None:
    profile = replace(ROUGH, exponent=exponent)
    smooth, _ = draw_curves(SCENE, ["smooth"], profile)
    flat, _ = draw_curves(SCENE | {"A": 0.0}, ["equilibrium"], profile)
    lowest = smooth["smooth_load"].min()
    assert lowest == pytest.approx(flat["load"].min(), rel=10 * EPS)
    force = solve(SCENE | {"A": 0.0, "a_max_over_R": math.inf}, ["pull_off_force"], profile=profile)["pull_off_force"]
    assert -lowest == pytest.approx(float(force), rel=20 * EPS)
    place = smooth["smooth_indentation"] > 0.0
    assert place.any()
    assert not place.all()


def test_scenes_that_cannot_be_drawn() -> None:
    for wrong in ({"k": 1.1}, {"modulus": -1.0}, {"A": math.nan}, {"lambda_over_R": 0.0}, {"a_max_over_R": 0.0}):
        found, status = draw_curves(SCENE | wrong, ["path", "jumps"], ROUGH)
        assert status & NO_VALUE
        assert np.isnan(found["path_load"]).all()
        assert found["jump_energy"].size == 0
    cone = replace(ROUGH, exponent=1.0)  # its waves never cease to fold
    endless, status = draw_curves(SCENE | {"a_max_over_R": math.inf}, ["equilibrium", "smooth"], cone)
    assert status == NO_VALUE
    assert np.isnan(endless["load"]).all()
    assert np.isfinite(endless["smooth_load"]).all()
    _, status = draw_curves(SCENE | {"machine_stiffness": -1.0}, ["path"], ROUGH, Loading(control="machine"))
    assert status & NO_VALUE


def test_curves_of_short_waves_are_refused_under_a_load() -> None:
    for curve, why in (("asymptotic", "one energy"), ("envelope", "constant depth"), ("effective", "constant depth")):
        expected = rf"\['{curve}'\].*{why}.*there are equilibrium, closing_equilibrium, path, smooth, jumps$"
        with pytest.raises(ValueError, match=expected):
            draw_curves(SCENE, [curve], loading=Loading(control="load"))
    with pytest.raises(ValueError, match="machine_stiffness"):
        draw_curves(SCENE, ["path"], loading=Loading(control="machine"))
    with pytest.raises(ValueError, match="machine_stiffness"):
        draw_curves(SCENE | {"machine_stiffness": 1.0}, ["path"])
