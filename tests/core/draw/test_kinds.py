"""Curves of any profile, control, pair of works and interface, and states: where they differ from those of one cosine."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, Profile, draw_curves, solve
from gradhesion.core.draw import states
from gradhesion.core.equations import general, quadrature
from gradhesion.core.problem.status import NO_VALUE
from tests.core.scene import ENDLESS, EPS, material_of, pattern_of, profile_of, scene_of

SCENE = scene_of(0.3, 0.27, 430.0, 0.05, 0.1, 0.02, 0.8)
ROUGH = profile_of(1.5, (1, 1.0, 0.3), (3, 0.2, -0.1))
PATTERN = pattern_of("toughness", (1, 0.2, 0.1), (3, 0.0, 0.1))
BY_LOAD, BY_MACHINE = Loading(control="load"), Loading(control="machine")
SPRINGS: dict[str, dict[str, float]] = {"displacement": {}, "load": {}, "machine": {"machine_stiffness": 2.0}}
WORKS = scene_of(0.1, 0.3, 500.0, 0.01, 0.1, 0.02, 0.5)
LENGTH = {"toughness_wavelength_over_R": 0.1}
REFUSED: list[tuple[dict[str, Any], str, dict[str, Any], str]] = [
    *(({}, curve, {"loading": BY_LOAD}, curve) for curve in ("asymptotic", "envelope", "effective")),
    ({}, "hysteresis", {}, "'hysteresis'"),
    ({"nu": None}, "smooth", {}, "'nu'"),
    ({}, "path", {"loading": BY_MACHINE}, "machine_stiffness"),
    ({"machine_stiffness": 1.0}, "path", {}, "machine_stiffness"),
    (LENGTH, "envelope", {"toughness": PATTERN}, "envelope"),
    (LENGTH, "path", {}, "toughness_wavelength"),
    ({"indentation_max_over_R": 0.1, "load_max": 1.0}, "path", {}, "turns at one of them"),
]
STATE = scene_of(0.1, 0.3, 500.0, 0.01, 0.2, 0.055, 0.45)


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


def test_under_a_load_the_punch_falls_where_it_lets_go() -> None:
    drawn, status = draw_curves(SCENE, ["path"], ROUGH, BY_LOAD)
    assert status & NO_VALUE == 0
    path = {name.removeprefix("path_"): values for name, values in drawn.items()}
    assert path["contact_radius"][-1] == 0.0
    assert path["jump"][-1] == path["unloading"][-1] == 1
    assert path["load"][-1] == path["load"][-2] == path["load"].min() < 0.0
    out = float(solve(SCENE, ["delta_jump_out"], profile=ROUGH, loading=BY_LOAD)["delta_jump_out"])
    assert path["indentation"][-1] == path["indentation"][-2] == pytest.approx(out, rel=1e-12)


def test_the_closing_curve_is_that_of_a_punch_of_that_work() -> None:
    found, _ = draw_curves(WORKS | {"closing_ratio": 0.25}, ["closing_equilibrium", "equilibrium"])
    closing, _ = draw_curves(WORKS | {"modulus": 2000.0}, ["equilibrium"])
    opening, _ = draw_curves(WORKS, ["equilibrium"])
    assert np.array_equal(found["closing_load"], 0.25 * closing["load"])
    assert np.array_equal(found["closing_indentation"], closing["indentation"])
    assert np.array_equal(found["load"], opening["load"])


def test_envelopes_and_the_effective_path_close_at_the_work_of_closing() -> None:
    """Loading is that of a punch of the work of closing, and unloading that of one of the work of opening."""

    def on_the_way(modulus: float, unloading: bool, **more: float) -> tuple[Any, Any]:
        """Radii and loads of one way of the effective path, by rising radii, without its jumps and ends."""
        drawn, _ = draw_curves(WORKS | {"modulus": modulus} | more, ["effective"])
        radius, load = drawn["effective_contact_radius"], drawn["effective_load"]
        if unloading:
            last = radius.size - int(np.argmax(radius[::-1]))
            return radius[last:][::-1], load[last:][::-1]
        on = (np.arange(radius.size) <= int(np.argmax(radius))) & (drawn["effective_jump"] == 0)
        return radius[on][2:], load[on][2:]

    found, _ = draw_curves(WORKS | {"closing_ratio": 0.49}, ["envelope"])
    radii, loads = found["envelope_contact_radius"], found["loading_envelope_load"]
    allowed = 1e-3 * np.ptp(loads)
    alone, closing = on_the_way(500.0 / 0.49, unloading=False), on_the_way(500.0, unloading=False, closing_ratio=0.49)
    for factor, (a, load) in ((0.49, alone), (1.0, closing)):
        assert a.size > 10
        np.testing.assert_allclose(factor * load, np.interp(a, radii, loads), atol=allowed)
    a, load = on_the_way(500.0, unloading=True, closing_ratio=0.49)
    np.testing.assert_allclose(load, np.interp(a, *on_the_way(500.0, unloading=True)), atol=allowed)


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


@pytest.mark.parametrize(("more", "curve", "how", "told"), REFUSED)
def test_what_is_refused(more: dict[str, Any], curve: str, how: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        draw_curves({name: value for name, value in (SCENE | more).items() if value is not None}, [curve], **how)


def test_named_states_lie_on_the_path() -> None:
    found, status = states.named_states(STATE)
    path, _ = draw_curves(STATE, ["path"])
    radius, depth, load = (path[f"path_{name}"] for name in ("contact_radius", "indentation", "load"))
    turn = np.flatnonzero(path["path_unloading"] == 1)[0] - 1
    last = int(np.flatnonzero(path["path_jump"] == 1)[-1]) - 1
    for state, i in zip(found.T, (turn, int(np.argmin(load)), last), strict=True):
        np.testing.assert_allclose(state, [radius[i], depth[i]], rtol=1e-9)
    assert status == int(solve(STATE)["status"])


def test_absent_states_are_nan() -> None:
    unbounded, _ = states.named_states(STATE | ENDLESS)
    assert np.isnan(unbounded[:, 0]).all()
    assert np.isfinite(unbounded[:, 1:]).all()
    linear = STATE | {"k": 1.0, "nu": 0.5, "A": 0.0}  # contact shrinks to a point
    assert np.isnan(states.named_states(linear)[0][:, 2]).all()
    given = states.equilibrium_states(STATE, [0.2, 0.46, 0.0, -1.0])
    assert np.isnan(given[:, 1:]).all()
    drawn = states.draw_states(STATE, given, states.STATE_CURVES)
    assert all(np.isnan(values[1:]).all() and not np.isnan(values[0, 0]) for values in drawn.values())


@pytest.mark.parametrize("profile", [Profile(), profile_of(1.7, (1, 1.0, 0.0), (3, 0.0, 0.2))])
def test_the_pressure_is_that_of_the_equation_up_to_the_edge(profile: Profile) -> None:
    given = states.equilibrium_states(STATE, [0.11, 0.31], profile)
    found = states.draw_states(STATE, given, ["pressure"], profile)
    M, wave = material_of(STATE), (0.2, *states.series_of(0.055, profile), profile.exponent)
    for (a, depth), r, p in zip(given.T, found["pressure_radius"], found["pressure"], strict=True):
        assert depth == pytest.approx(float(general.indentation(0.1, M, a, *wave)), rel=1e-12)
        assert 0.0 <= r[0] < r[-1] < a
        inside = r > 0.0
        np.testing.assert_allclose(p[inside], quadrature.pressure(0.1, M, r[inside], a, depth, *wave), rtol=1e-9)


def test_the_surface_lies_on_the_punch_and_opens_from_it() -> None:
    chosen, _ = states.named_states(STATE)
    found = states.draw_states(STATE, chosen, ["surface"])
    columns = (found[f"surface_{name}"] for name in ("radius", "displacement", "gap"))
    for (a, depth), r, u, gap in zip(chosen.T, *columns, strict=True):
        height = 0.5 * r * r + 0.011 * (1 - np.cos(2 * math.pi * r / 0.2))
        assert a in r
        assert np.array_equal(np.isnan(gap), r > 0.45)
        assert (gap[r <= a] == 0).all()
        shown = ~np.isnan(gap)
        np.testing.assert_allclose(u[shown], (depth - height + gap)[shown], atol=1e-15)
        assert (gap[shown] >= 0).all()  # the scene is one disc
        assert abs(u[-1]) < 0.5 * abs(depth - height[-1])  # far away the surface is at rest
