"""Paths of any profile under any control: what they enclose, what their jumps keep, and their limits."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, draw_curves, solve

EPS = float(np.finfo(float).eps)
UNIT = 1.5 * math.pi
MODULUS = 430.0
SCENE = {
    "k": 0.3,
    "nu": 0.27,
    "modulus": MODULUS,
    "c0_over_R": 0.05,
    "lambda_over_R": 0.1,
    "A": 0.02,
    "a_max_over_R": 0.8,
}
ROUGH = Profile(exponent=1.5, harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=0.2, sin=-0.1)))
CONTROLS = [("displacement", None), ("machine", 1e3), ("machine", 2.0), ("machine", 0.1), ("load", None)]


def _drawn(control: str, stiffness: float | None, profile: Profile = ROUGH, **change: float) -> Any:
    scene = SCENE | change | ({} if stiffness is None else {"machine_stiffness": stiffness})
    loading = Loading(control=control)
    outputs = ["dissipated_energy", "loading_jumps", "unloading_jumps", "delta_max", "delta_jump_out"]
    solved = {n: float(v) for n, v in solve(scene, outputs, profile=profile, loading=loading).items()}
    drawn, status = draw_curves(scene, ["path", "jumps"], profile, loading)
    assert status == solved["status"]
    return {name.removeprefix("path_"): values for name, values in drawn.items()}, solved


@pytest.mark.parametrize("rim", [0.03, 0.5, 0.8, 0.83, math.inf])
@pytest.mark.parametrize(("control", "stiffness"), CONTROLS)
@pytest.mark.parametrize("profile", [Profile(), ROUGH], ids=["default", "rough"])
def test_the_loop_is_the_energy(profile: Profile, control: str, stiffness: float | None, rim: float) -> None:
    path, solved = _drawn(control, stiffness, profile, a_max_over_R=rim)
    energy = solved["dissipated_energy"]
    lost = path["jump_energy"]
    assert lost.sum() == pytest.approx(energy, rel=100 * EPS)
    assert (path["jump"] * (1 - path["unloading"])).sum() == solved["loading_jumps"]
    assert (path["jump"] * path["unloading"]).sum() == solved["unloading_jumps"]
    assert path["jump_unloading"].sum() == solved["unloading_jumps"] - (control == "load")
    depth, load = path["indentation"], path["load"]
    if control == "load":
        return  # the loop is open
    area = UNIT * (0.5 * (load[1:] + load[:-1]) * np.diff(depth)).sum()
    # what chords cut off is their error times their length
    spans = np.ptp(depth), np.ptp(load)
    length = np.hypot(np.diff(depth) / spans[0], np.diff(load) / spans[1]).sum()
    assert abs(area - energy) <= 2e-4 * length * UNIT * spans[0] * spans[1]
    if rim < math.inf:
        assert depth[path["unloading"] == 0][-1] == pytest.approx(solved["delta_max"], rel=1e-12)


@pytest.mark.parametrize(("control", "stiffness"), CONTROLS)
@pytest.mark.parametrize("k", [0.0, 0.3, 1.0])
def test_what_is_prescribed_goes_up_and_down_and_is_kept_in_jumps(
    k: float, control: str, stiffness: float | None
) -> None:
    path, _ = _drawn(control, stiffness, k=k, nu=0.5 if k == 1.0 else 0.27)
    depth, load = path["indentation"], path["load"]
    moved = load if control == "load" else depth + UNIT * load / ((stiffness or math.inf) * MODULUS)
    last = path["jump"].size - 1 if control == "load" else path["jump"].size  # the last load is that of the fold
    jumps = np.flatnonzero(path["jump"][:last])
    rounding = 1e3 * EPS * np.abs(moved).max()
    assert np.abs(np.diff(moved)[jumps - 1]).max() <= rounding
    steps = np.delete(np.diff(moved), jumps - 1)
    unloading = np.delete(path["unloading"][1:] == 1, jumps - 1)
    assert (steps[~unloading] >= -rounding).all()
    assert (steps[unloading] <= rounding).all()


def test_without_a_holder_the_punch_falls_where_it_lets_go() -> None:
    path, solved = _drawn("load", None)
    assert path["contact_radius"][-1] == 0.0
    assert path["jump"][-1] == path["unloading"][-1] == 1
    assert path["load"][-1] == path["load"][-2] == path["load"].min() < 0.0
    assert path["indentation"][-1] == path["indentation"][-2] == pytest.approx(solved["delta_jump_out"], rel=1e-12)


@pytest.mark.parametrize(("control", "stiffness"), [("displacement", 1e13), ("load", 1e-11)])
def test_the_ends_of_stiffness_are_depth_and_load_control(control: str, stiffness: float) -> None:
    machine, _ = _drawn("machine", stiffness)
    end, _ = _drawn(control, None)
    corners = [np.flatnonzero(path["jump"]) for path in (machine, end)]
    assert corners[0].size == corners[1].size
    if control == "load":  # the machine's punch falls far, the other without end
        corners = [each[:-1] for each in corners]
    for name in ("contact_radius", "indentation", "load"):
        for before in (0, 1):
            found, limit = (path[name][each - before] for path, each in zip((machine, end), corners, strict=True))
            # S is 1e-10 of the contact's stiffness from its limit, radii of jumps by some more
            np.testing.assert_allclose(found, limit, atol=1e-8 * np.abs(limit).max())


def test_chords_are_within_the_contract(equation: Callable[..., Any], worst_chord: Callable[..., float]) -> None:
    path, _ = _drawn("machine", 2.0)
    along = (path["jump"] == 0) & (np.append(0, np.diff(path["branch"])) == 0)
    along &= np.append(False, np.diff(path["contact_radius"]) != 0.0)
    points = path["contact_radius"], path["indentation"], path["load"]
    assert worst_chord(equation(SCENE, ROUGH), points, along) <= 2e-4
    assert path["jump"].size < 1000
