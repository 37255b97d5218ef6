"""Curves of any profile, control, pair of works and interface, where they differ from those of one cosine."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from tests.core.draw.printed import chord_error, curve_of

EPS = float(np.finfo(float).eps)
MODULUS, FORCE = 430.0, 1.5 * math.pi
SCENE: dict[str, Any] = {"k": 0.3, "nu": 0.27, "modulus": MODULUS, "c0_over_R": 0.05, "lambda_over_R": 0.1, "A": 0.02}
SCENE |= {"a_max_over_R": 0.8}
ROUGH = Profile(exponent=1.5, harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=0.2, sin=-0.1)))
PATTERN = Toughness((ToughnessHarmonic(n=1, cos=0.2, sin=0.1), ToughnessHarmonic(n=3, sin=0.1)))
POINT = ("contact_radius", "indentation", "load")


def _path(control: str, stiffness: float | None = None) -> dict[str, Any]:
    scene = SCENE | ({} if stiffness is None else {"machine_stiffness": stiffness})
    drawn, status = draw_curves(scene, ["path"], ROUGH, Loading(control=control))
    assert status & NO_VALUE == 0
    return {name.removeprefix("path_"): values for name, values in drawn.items()}


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


@pytest.mark.parametrize(("control", "stiffness"), [("displacement", None), ("load", None), ("machine", 2.0)])
def test_stability_changes_where_what_is_prescribed_turns(control: str, stiffness: float | None) -> None:
    """P/(S R) with S = 2 E* R: P is in units of 1.5 pi R dgamma and E* in those of dgamma/R."""
    scene = SCENE | ({} if stiffness is None else {"machine_stiffness": stiffness})
    curve, _ = draw_curves(scene, ["equilibrium"], ROUGH, Loading(control=control))
    depth, load = curve["indentation"], curve["load"]
    moved = load if control == "load" else depth + FORCE * load / ((stiffness or math.inf) * MODULUS)
    stable = (curve["stable"][1:] == 1) | (curve["stable"][:-1] == 1)
    assert np.diff(stable).sum() > 5
    assert np.array_equal(np.diff(moved) > 0.0, stable)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 4.0])
def test_the_smooth_punch_of_any_power_is_the_closed_form(exponent: float) -> None:
    profile = replace(ROUGH, exponent=exponent)
    smooth, _ = draw_curves(SCENE, ["smooth"], profile)
    flat, _ = draw_curves(SCENE | {"A": 0.0}, ["equilibrium"], profile)
    assert smooth["smooth_load"].min() == pytest.approx(flat["load"].min(), rel=10 * EPS)
    force = solve(SCENE | {"A": 0.0, "a_max_over_R": math.inf}, ["pull_off_force"], profile=profile)["pull_off_force"]
    assert -smooth["smooth_load"].min() == pytest.approx(float(force), rel=20 * EPS)
    assert set(smooth["smooth_indentation"] > 0.0) == {True, False}


def test_a_machine_holds_its_far_end_in_jumps_and_its_path_keeps_the_contract() -> None:
    path = _path("machine", 2.0)
    moved = path["indentation"] + FORCE * path["load"] / (2.0 * MODULUS)
    jumps, rounding = np.flatnonzero(path["jump"]), 1e3 * EPS * np.abs(moved).max()
    assert np.abs(np.diff(moved)[jumps - 1]).max() <= rounding
    steps, unloading = (np.delete(of, jumps - 1) for of in (np.diff(moved), path["unloading"][1:] == 1))
    assert (np.where(unloading, -steps, steps) >= -rounding).all()
    along = (path["jump"] == 0) & (np.diff(path["branch"], prepend=0) == 0)
    along &= np.diff(path["contact_radius"], prepend=0.0) != 0.0
    assert chord_error(curve_of(SCENE, ROUGH), [path[name] for name in POINT], along) <= 2e-4
    assert path["jump"].size < 1000


def test_a_depth_that_is_passed_within_a_jump_turns_where_that_lands_which_is_no_rim() -> None:
    path, scene = _path("machine", 0.1), SCENE | {"machine_stiffness": 0.1}
    after = int(np.flatnonzero((path["jump"] == 1) & (path["unloading"] == 0))[2])
    assert path["indentation"][after] > path["indentation"][after - 1]
    scene["indentation_max_over_R"] = float(path["indentation"][after - 1 : after + 1].mean())
    found, _ = draw_curves(scene, ["jumps", "path"], ROUGH, Loading(control="machine"))
    assert found["path_contact_radius"].max() == pytest.approx(float(path["contact_radius"][after]), rel=1e-9)
    assert found["jump_radius_after"].max() == found["path_contact_radius"].max()
    assert not found["jump_at_rim"].any()


def test_under_a_load_the_punch_falls_where_it_lets_go() -> None:
    path = _path("load")
    assert path["contact_radius"][-1] == 0.0
    assert path["jump"][-1] == path["unloading"][-1] == 1
    assert path["load"][-1] == path["load"][-2] == path["load"].min() < 0.0
    out = float(solve(SCENE, ["delta_jump_out"], profile=ROUGH, loading=Loading(control="load"))["delta_jump_out"])
    assert path["indentation"][-1] == path["indentation"][-2] == pytest.approx(out, rel=1e-12)


@pytest.mark.parametrize(("control", "stiffness"), [("displacement", 1e13), ("load", 1e-11)])
def test_the_ends_of_stiffness_are_depth_and_load_control(control: str, stiffness: float) -> None:
    """S is 1e-10 of the contact's stiffness from its limit, radii of jumps by some more."""
    both = _path("machine", stiffness), _path(control)
    corners = [np.flatnonzero(path["jump"]) for path in both]
    assert corners[0].size == corners[1].size
    if control == "load":  # the machine's punch falls far, the other without end
        corners = [each[:-1] for each in corners]
    for name in POINT:
        for before in (0, 1):
            found, limit = (path[name][each - before] for path, each in zip(both, corners, strict=True))
            np.testing.assert_allclose(found, limit, atol=1e-8 * np.abs(limit).max())


# Two works


WORKS = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 0.5}


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
    turn = int(np.argmax(radius))
    if unloading:
        last = radius.size - int(np.argmax(radius[::-1]))
        return radius[last:][::-1], load[last:][::-1]
    on = (np.arange(radius.size) <= turn) & (drawn["effective_jump"] == 0)
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
    scene = WORKS | {"a_max_over_R": np.inf, "indentation_max_over_R": 0.05}
    curves = ["path", "equilibrium", "jumps", "envelope"]
    plain, flags = draw_curves(scene, curves)
    one, own = draw_curves(scene | {"closing_ratio": 1.0}, [*curves, "closing_equilibrium"])
    assert flags == own
    for name, values in plain.items():
        assert np.array_equal(one[name], values)
    assert np.array_equal(one["closing_load"], one["load"])


# What cannot be drawn


def test_what_has_no_value() -> None:
    cone = replace(ROUGH, exponent=1.0)  # its waves never cease to fold
    endless, status = draw_curves(SCENE | {"a_max_over_R": math.inf}, ["equilibrium", "smooth"], cone)
    assert status == NO_VALUE
    assert np.isnan(endless["load"]).all()
    assert np.isfinite(endless["smooth_load"]).all()
    _, status = draw_curves(SCENE | {"machine_stiffness": -1.0}, ["path"], ROUGH, Loading(control="machine"))
    assert status & NO_VALUE
    for change in (
        {"toughness_wavelength_over_R": 1e-6},
        {"toughness_wavelength_over_R": 0.1, "toughness_amplitude": 9.0},
    ):
        drawn, status = draw_curves(SCENE | change, ["equilibrium"], toughness=PATTERN)
        assert status == NO_VALUE
        assert np.isnan(drawn["load"]).all()


BY_LOAD, BY_MACHINE = Loading(control="load"), Loading(control="machine")
LENGTH = {"toughness_wavelength_over_R": 0.1}
REFUSED: list[tuple[dict[str, float], str, dict[str, Any], str]] = [
    *(({}, curve, {"loading": BY_LOAD}, rf"\['{curve}'\]") for curve in ("asymptotic", "envelope", "effective")),
    ({}, "path", {"loading": BY_MACHINE}, "machine_stiffness"),
    ({"machine_stiffness": 1.0}, "path", {}, "machine_stiffness"),
    (LENGTH, "envelope", {"toughness": PATTERN}, "equilibrium, path, jumps"),
    (LENGTH, "path", {}, "belongs to a pattern"),
]


@pytest.mark.parametrize(("more", "curve", "how", "told"), REFUSED)
def test_what_is_refused(more: dict[str, float], curve: str, how: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        draw_curves(SCENE | more, [curve], **how)
