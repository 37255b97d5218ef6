"""Curves of any profile, control, pair of works and interface, where they differ from those of one cosine."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, draw_curves, solve
from gradhesion.core.problem.status import NO_VALUE
from tests.core.draw.printed import chord_error, curve_of
from tests.core.scene import ENDLESS, pattern_of, profile_of, scene_of

EPS = float(np.finfo(float).eps)
SCENE = scene_of(0.3, 0.27, 430.0, 0.05, 0.1, 0.02, 0.8)
ROUGH = profile_of(1.5, (1, 1.0, 0.3), (3, 0.2, -0.1))
PATTERN = pattern_of("toughness", (1, 0.2, 0.1), (3, 0.0, 0.1))
BY_LOAD, BY_MACHINE = Loading(control="load"), Loading(control="machine")
SPRINGS: dict[str, dict[str, float]] = {"displacement": {}, "load": {}, "machine": {"machine_stiffness": 2.0}}


def _path(control: str, **more: float) -> dict[str, Any]:
    drawn, status = draw_curves(SCENE | more, ["path"], ROUGH, Loading(control=control))
    assert status & NO_VALUE == 0
    return {name.removeprefix("path_"): values for name, values in drawn.items()}


@pytest.mark.parametrize("rim", [0.5, math.inf])
def test_a_third_harmonic_alone_is_a_cosine_of_a_third_of_the_length(rim: float) -> None:
    """Three times the amplitude over the wavelength; the sizes of the terms are the same but for rounding."""
    scene = SCENE | {"a_max_over_R": rim}
    curves = ["equilibrium", "path", "smooth", "jumps", "asymptotic", "envelope", "effective"]
    third, _ = draw_curves(scene, curves, profile_of(2.0, (3, 0.7, 0.0)))
    own, _ = draw_curves(scene | {"lambda_over_R": 0.1 / 3, "A": 3 * 0.7 * 0.02}, curves)
    assert own.keys() == third.keys()
    for name, values in own.items():
        np.testing.assert_allclose(third[name], values, rtol=1e-12, atol=1e3 * EPS * np.abs(values).max(initial=0.0))


@pytest.mark.parametrize("control", SPRINGS)
def test_stability_changes_where_what_is_prescribed_turns(control: str) -> None:
    """P/(S R) with S = 2 E* R: P is in units of 1.5 pi R dgamma and E* in those of dgamma/R."""
    curve, _ = draw_curves(SCENE | SPRINGS[control], ["equilibrium"], ROUGH, Loading(control=control))
    moved = curve["load" if control == "load" else "indentation"]
    if control == "machine":
        moved = moved + 1.5 * math.pi * curve["load"] / (2.0 * 430.0)
    stable = (curve["stable"][1:] == 1) | (curve["stable"][:-1] == 1)
    assert np.diff(stable).sum() > 5
    assert np.array_equal(np.diff(moved) > 0.0, stable)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 4.0])
def test_the_smooth_punch_of_any_power_is_the_closed_form(exponent: float) -> None:
    profile = replace(ROUGH, exponent=exponent)
    smooth, _ = draw_curves(SCENE, ["smooth"], profile)
    flat, _ = draw_curves(SCENE | {"A": 0.0}, ["equilibrium"], profile)
    force = solve(SCENE | ENDLESS | {"A": 0.0}, ["pull_off_force"], profile=profile)["pull_off_force"]
    for lowest in (flat["load"].min(), -float(force)):
        assert smooth["smooth_load"].min() == pytest.approx(lowest, rel=20 * EPS)
    assert set(smooth["smooth_indentation"] > 0.0) == {True, False}


def test_the_path_of_a_machine_keeps_the_contract_and_turns_where_a_jump_over_a_depth_lands() -> None:
    path, scene = _path("machine", **SPRINGS["machine"]), SCENE | {"machine_stiffness": 0.1}
    along = (path["jump"] == 0) & (np.diff(path["branch"], prepend=0) == 0)
    along &= np.diff(path["contact_radius"], prepend=0.0) != 0.0
    points = [path[name] for name in ("contact_radius", "indentation", "load")]
    assert chord_error(curve_of(SCENE, ROUGH), points, along) <= 2e-4
    assert path["jump"].size < 1000
    path = _path("machine", machine_stiffness=0.1)
    after = int(np.flatnonzero((path["jump"] == 1) & (path["unloading"] == 0))[2])
    assert path["indentation"][after] > path["indentation"][after - 1]
    scene["indentation_max_over_R"] = float(path["indentation"][after - 1 : after + 1].mean())
    found, _ = draw_curves(scene, ["jumps", "path"], ROUGH, BY_MACHINE)
    assert found["path_contact_radius"].max() == pytest.approx(float(path["contact_radius"][after]), rel=1e-9)
    assert found["jump_radius_after"].max() == found["path_contact_radius"].max()
    assert not found["jump_at_rim"].any(), "which is no rim"


def test_under_a_load_the_punch_falls_where_it_lets_go() -> None:
    path = _path("load")
    assert path["contact_radius"][-1] == 0.0
    assert path["jump"][-1] == path["unloading"][-1] == 1
    assert path["load"][-1] == path["load"][-2] == path["load"].min() < 0.0
    out = float(solve(SCENE, ["delta_jump_out"], profile=ROUGH, loading=BY_LOAD)["delta_jump_out"])
    assert path["indentation"][-1] == path["indentation"][-2] == pytest.approx(out, rel=1e-12)


WORKS = scene_of(0.1, 0.3, 500.0, 0.01, 0.1, 0.02, 0.5)


def test_the_closing_curve_is_that_of_a_punch_of_that_work() -> None:
    found, _ = draw_curves(WORKS | {"closing_ratio": 0.25}, ["closing_equilibrium", "equilibrium"])
    closing, _ = draw_curves(WORKS | {"modulus": 2000.0}, ["equilibrium"])
    opening, _ = draw_curves(WORKS, ["equilibrium"])
    assert np.array_equal(found["closing_load"], 0.25 * closing["load"])
    assert np.array_equal(found["closing_indentation"], closing["indentation"])
    assert np.array_equal(found["load"], opening["load"])


def _effective(drawn: dict[str, Any], *, unloading: bool) -> tuple[Any, Any]:
    """Radii and loads of one way of the effective path, by rising radii, without its jumps and ends."""
    radius, load = drawn["effective_contact_radius"], drawn["effective_load"]
    if unloading:
        last = radius.size - int(np.argmax(radius[::-1]))
        return radius[last:][::-1], load[last:][::-1]
    on = (np.arange(radius.size) <= int(np.argmax(radius))) & (drawn["effective_jump"] == 0)
    return radius[on][2:], load[on][2:]


def test_envelopes_and_the_effective_path_close_at_the_work_of_closing() -> None:
    found, _ = draw_curves(WORKS | {"closing_ratio": 0.49}, ["envelope", "effective"])
    closing, _ = draw_curves(WORKS | {"modulus": 500.0 / 0.49}, ["effective"])
    opening, _ = draw_curves(WORKS, ["effective"])
    radii, loads = found["envelope_contact_radius"], found["loading_envelope_load"]
    for drawn, factor in ((closing, 0.49), (found, 1.0)):
        a, load = _effective(drawn, unloading=False)
        assert a.size > 10
        np.testing.assert_allclose(factor * load, np.interp(a, radii, loads), atol=1e-3 * np.ptp(loads))
    a, load = _effective(found, unloading=True)
    other = np.interp(a, *_effective(opening, unloading=True))
    np.testing.assert_allclose(load, other, atol=1e-3 * np.ptp(loads))


def test_at_ratio_1_both_curves_are_one() -> None:
    scene = WORKS | ENDLESS | {"indentation_max_over_R": 0.05}
    curves = ["path", "equilibrium", "jumps", "envelope"]
    plain, flags = draw_curves(scene, curves)
    one, own = draw_curves(scene | {"closing_ratio": 1.0}, [*curves, "closing_equilibrium"])
    assert flags == own
    for name, values in plain.items():
        assert np.array_equal(one[name], values)
    assert np.array_equal(one["closing_load"], one["load"])


LENGTH = {"toughness_wavelength_over_R": 0.1}


def test_what_has_no_value() -> None:
    cone = replace(ROUGH, exponent=1.0)  # its waves never cease to fold
    endless, status = draw_curves(SCENE | ENDLESS, ["equilibrium", "smooth"], cone)
    assert status == NO_VALUE
    assert np.isnan(endless["load"]).all()
    assert np.isfinite(endless["smooth_load"]).all()
    for change in ({"toughness_wavelength_over_R": 1e-6}, LENGTH | {"toughness_amplitude": 9.0}):
        drawn, status = draw_curves(SCENE | change, ["equilibrium"], toughness=PATTERN)
        assert status == NO_VALUE
        assert np.isnan(drawn["load"]).all()


REFUSED: list[tuple[dict[str, float], str, dict[str, Any], str]] = [
    *(({}, curve, {"loading": BY_LOAD}, curve) for curve in ("asymptotic", "envelope", "effective")),
    ({}, "path", {"loading": BY_MACHINE}, "machine_stiffness"),
    ({"machine_stiffness": 1.0}, "path", {}, "machine_stiffness"),
    (LENGTH, "envelope", {"toughness": PATTERN}, "envelope"),
    (LENGTH, "path", {}, "toughness_wavelength"),
]


@pytest.mark.parametrize(("more", "curve", "how", "told"), REFUSED)
def test_what_is_refused(more: dict[str, float], curve: str, how: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        draw_curves(SCENE | more, [curve], **how)
