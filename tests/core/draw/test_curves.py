"""The equilibrium curve, the path and its jumps, of scenes of every kind: what holds for all, and the corners.

That paths are in equilibrium, turn where they should, enclose what is lost and jump as often as is counted is asserted
of random scenes of every kind in tests/conformance.
"""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import CURVES, Harmonic, Profile, draw_curves, solve
from gradhesion.core.draw.draw import INTEGERS
from gradhesion.core.draw.states import equilibrium_states
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE
from tests.core.scene import ENDLESS, Scene, chord_error, curve_of, scene_of, strengths_of

POINT = ("contact_radius", "indentation", "load")
CONTRACT = 2e-4
"""How far a curve may be from the chords of its points, in spans."""
Curves = dict[str, Any]
CHANGES: list[dict[str, float]] = [{}, {"A": 0.2}, {"A": 0.0}, {"A": 1e-5}, {"lambda_over_R": 1.3}]


def _path(curves: Curves) -> Curves:
    return {name.removeprefix("path_"): values for name, values in curves.items() if name.startswith("path_")}


def test_every_curve_has_its_variables_of_one_length_and_ends_at_the_rim(any_scene: Scene, drawn: Curves) -> None:
    assert list(drawn) == [name for curve in CURVES.values() for name in curve]
    for names in CURVES.values():
        assert len({drawn[name].shape for name in names}) == 1
    for name, values in drawn.items():
        assert values.ndim == 1
        assert (values.dtype.kind == "i") == (name in INTEGERS)
        assert np.isfinite(values).all()
    ends = {name: values.max() for name, values in drawn.items() if name.endswith("contact_radius")}
    turn = ends.pop("effective_contact_radius")  # it turns earlier if there is no rim
    assert len(set(ends.values())) == 1
    if any_scene["a_max_over_R"] < math.inf:
        assert ends["contact_radius"] == turn == any_scene["a_max_over_R"]


def test_a_curve_does_not_depend_on_what_else_is_drawn(scene: dict[str, float]) -> None:
    together, _ = draw_curves(scene, list(CURVES))
    for curve, names in CURVES.items():
        alone, _ = draw_curves(scene, [curve])
        assert list(alone) == list(names)
        assert all(np.array_equal(alone[name], together[name]) for name in names)


def test_chords_are_within_the_contract_with_a_modest_number_of_points(any_scene: Scene, drawn: Curves) -> None:
    """Smooth parts have some hundred; the width of a wave in the picture does the rest, eight points at least."""
    curve, path = curve_of(any_scene), _path(drawn)
    assert chord_error(curve, [drawn[name] for name in POINT]) <= CONTRACT
    along = (np.diff(path["contact_radius"], prepend=0.0) != 0) & (path["jump"] == 0)
    assert chord_error(curve, [path[name] for name in POINT], along) <= CONTRACT
    branches = np.count_nonzero(np.diff(drawn["stable"].astype(int)) == 1)
    assert drawn["load"].size <= 200 + 60 * min(branches, 25) + 8 * branches


def test_the_equilibrium_curve(any_scene: dict[str, float], drawn: Curves) -> None:
    """It goes from zero contact outwards, is stable where the depth rises, and its lowest point is the pull-off."""
    radius, depth, load, stable = (drawn[name] for name in CURVES["equilibrium"])
    assert radius[0] == load[0] == 0.0
    assert depth[0] == pytest.approx(-strengths_of(any_scene)[0] if any_scene["k"] == 1.0 else 0.0)
    assert (np.diff(radius) > 0).all()
    rising = np.diff(depth) > 0
    assert np.array_equal(rising, (stable[1:] | stable[:-1]) == 1)  # a line is stable where one of its ends is
    assert (stable[np.flatnonzero(np.diff(rising)) + 1] == 0).all()
    solved = solve(any_scene, ["pull_off_force", "pull_off_radius"])
    assert -load.min() == pytest.approx(float(solved["pull_off_force"]), rel=1e-12)
    assert radius[load.argmin()] == pytest.approx(float(solved["pull_off_radius"]), rel=1e-8)


def test_a_path_goes_out_and_back_by_branches(any_scene: dict[str, float], drawn: Curves) -> None:
    path = _path(drawn)
    first, last = ([path[name][i] for name in (*POINT, "branch", "jump", "unloading")] for i in (0, -1))
    assert first == [0, 0, 0, 0, 0, 0]
    # at k = 1 contact ends along the first branch
    assert [last[0], *last[2:]] == [0, 0, *((1, 0) if any_scene["k"] == 1.0 else (0, 1)), 1]
    turn = int(path["unloading"].argmax())
    assert (np.diff(path["unloading"]) >= 0).all()
    assert path["contact_radius"][turn - 1] == drawn["contact_radius"][-1]
    for name in POINT[:2]:
        rounding = 1e-14 * np.ptp(path[name])
        assert (np.diff(path[name][:turn]) >= -rounding).all()
        assert (np.diff(path[name][turn - 1 :]) <= rounding).all()
    jumps = np.flatnonzero(path["jump"])
    assert jumps[0] == 1
    assert np.array_equal(path["indentation"][jumps], path["indentation"][jumps - 1])
    assert (path["branch"][jumps] != path["branch"][jumps - 1]).all()
    # branches are counted outwards on the equilibrium curve: a stable stretch each
    stable, a = np.concatenate([[0], drawn["stable"], [0]]).astype(int), drawn["contact_radius"]
    starts = a[np.maximum(np.flatnonzero(np.diff(stable) == 1) - 1, 0)]
    ends = a[np.minimum(np.flatnonzero(np.diff(stable) == -1), a.size - 1)]
    on = (path["branch"] > 0) & (path["branch"] <= starts.size)
    branch, radius = path["branch"][on] - 1, path["contact_radius"][on]
    assert ((starts[branch] * (1 - 1e-9) <= radius) & (radius <= ends[branch] * (1 + 1e-9))).all()
    assert (path["contact_radius"][path["branch"] == starts.size + 1] == a[-1]).all()


def test_jumps_are_those_of_the_path(drawn: Curves) -> None:
    after, unloading = np.flatnonzero(drawn["path_jump"]), drawn["jump_unloading"] == 1
    for name, of_path in (("radius", "contact_radius"), ("load", "load")):
        for when, points in (("before", after - 1), ("after", after)):
            np.testing.assert_array_equal(drawn[f"jump_{name}_{when}"], drawn[f"path_{of_path}"][points])
    for name in ("indentation", "unloading"):
        np.testing.assert_array_equal(drawn[f"jump_{name}"], drawn[f"path_{name}"][after])
    np.testing.assert_array_equal(drawn["jump_radius_after"] > drawn["jump_radius_before"], ~unloading)
    assert (drawn["jump_energy"][unloading] > 0).all(), "unloading never gains"


@pytest.mark.parametrize("below", [1e-12, 1e-15])
def test_a_contact_next_to_k_1_shrinks_to_a_point(below: float, scene: Scene) -> None:
    """On a cone of waves the fold at which it ends is far smaller than they are: its depth is that of k = 1, not 0."""
    scene, cone = scene | {"k": 1.0 - below, "nu": 0.5}, Profile(harmonics=(Harmonic(n=1, cos=0.6, sin=0.8),))
    path, _ = draw_curves(scene, ["path"], cone)
    ends = [
        float(solve(scene | {"k": k}, ["delta_jump_out"], profile=cone)["delta_jump_out"]) for k in (scene["k"], 1.0)
    ]
    assert path["path_indentation"][-1] == pytest.approx(ends[0], rel=1e-14)
    assert ends == pytest.approx([equilibrium_states(scene | {"k": 1.0}, [1e-15], cone)[1, 0]] * 2, rel=1e-10)
    assert ends[1] == pytest.approx(equilibrium_states(scene | {"k": 1.0}, [1e-15], cone)[1, 0], rel=1e-13, abs=0.0)


@pytest.mark.parametrize(("wavelength", "amplitude", "whole"), [(0.002, 0.01, 4), (0.008, 0.02, 8), (0.008, 0.03, 16)])
def test_whole_waves_without_folds_are_seen(wavelength: float, amplitude: float, whole: int, scene: Scene) -> None:
    """From the last extremum to a rim some whole waves further, middle and quarters are in one phase: on one line."""
    scene |= ENDLESS | {"lambda_over_R": wavelength, "A": amplitude}
    far, _ = draw_curves(scene, ["equilibrium"])
    last = far["contact_radius"][1:-1][np.diff(np.sign(np.diff(far["load"]))) != 0][-1]
    scene["a_max_over_R"] = float(last + whole * wavelength)
    found, _ = draw_curves(scene, ["equilibrium"])
    assert chord_error(curve_of(scene), [found[name] for name in POINT]) <= CONTRACT


@pytest.mark.parametrize("change", [*CHANGES, {"k": 1.0, "nu": 0.5}], ids=str)
def test_an_unbounded_punch_is_drawn_beyond_all_that_happens(change: dict[str, float], scene: dict[str, float]) -> None:
    """1.5 times the zero of the smooth curve, a_1 = [(1+k) R s]^(2/(3+k)), or 5 % beyond the last event; no rim."""
    scene |= ENDLESS | change
    found, _ = draw_curves(scene, ["equilibrium", "jumps"])
    radius, k, events = found["contact_radius"], scene["k"], [float(found["jump_radius_after"].max())]
    for values in (found["indentation"], found["load"]):
        events += radius[1:-1][np.diff(np.sign(np.diff(values))) != 0].tolist()
    zero = ((1 + k) * strengths_of(scene)[0]) ** (2 / (3 + k))
    assert radius[-1] == pytest.approx(max(1.5 * zero, 1.05 * max(events)), rel=1e-12)
    assert not found["jump_at_rim"].any()


def test_many_waves_make_a_long_curve_of_few_points_a_wave(scene: dict[str, float]) -> None:
    found, _ = draw_curves(scene | {"lambda_over_R": 5e-5, "a_max_over_R": 0.4}, ["equilibrium"])
    turns = np.count_nonzero(np.diff(np.sign(np.diff(found["indentation"]))))
    assert turns > 15_000
    assert found["load"].size <= 4.5 * turns


def test_a_rim_in_a_jump_pins_the_contact(scene: dict[str, float]) -> None:
    free = _path(draw_curves(scene | ENDLESS, ["path"])[0])
    third = np.flatnonzero((free["jump"] == 1) & (free["unloading"] == 0))[2]
    rim = float(0.8 * free["contact_radius"][third - 1] + 0.2 * free["contact_radius"][third])
    found, _ = draw_curves(scene | {"a_max_over_R": rim}, ["path", "jumps"])
    path = _path(found)
    before, after = np.flatnonzero(path["contact_radius"] == rim)
    # the load of the flat punch between: K a^(1+k) is 4 pi a^(1+k)/((1+k) s^2)
    (depth, load), k = curve_of(scene)(rim), scene["k"]
    front = 4 * math.pi / ((1 + k) * strengths_of(scene)[0] ** 2) / (1.5 * math.pi) * rim ** (1 + k)
    for i, flags in ((before, [1, 0]), (after, [0, 1])):
        assert [path[name][i] for name in ("branch", "jump", "unloading")] == [path["branch"].max(), *flags]
        assert path["load"][i] == pytest.approx(float(load + front * (path["indentation"][i] - depth)), rel=1e-11)
    assert path["indentation"][before] > path["indentation"][after] == pytest.approx(float(depth), rel=1e-12)
    # it lies on a falling part: unloading goes on with a jump inwards
    assert path["jump"][after + 1] == 1
    assert path["branch"][after + 1] < path["branch"].max()
    last = int((found["jump_unloading"] == 0).sum()) - 1
    assert np.flatnonzero(found["jump_at_rim"]).tolist() == [last, last + 1]


def test_one_jump_there_and_back_and_none(scene: dict[str, float]) -> None:
    """A rim before any equilibrium, and a depth short of contact."""
    found, _ = draw_curves(scene | {"a_max_over_R": 0.01}, ["path", "jumps"])
    path = _path(found)
    depth = path["indentation"]
    assert path["contact_radius"].tolist() == [0.0, 0.01, 0.01, 0.0]
    flags = [path[name].tolist() for name in ("branch", "jump", "unloading")]
    assert flags == [[0, 1, 1, 0], [0, 1, 0, 1], [0, 0, 1, 1]]
    assert depth[0] == depth[1] == 0.0 > depth[2] == depth[3]
    assert found["jump_at_rim"].tolist() == [1, 1]
    away = scene | {"indentation_max_over_R": -0.01}
    found, status = draw_curves(away, ["path", "jumps", "equilibrium", "effective"])
    assert status == solve(away)["status"] != 0
    for curve in ("path", "effective"):
        assert [found[f"{curve}_{name}"].tolist() for name in POINT] == [[0.0], [-0.01], [0.0]]
    assert found["jump_energy"].size == 0
    assert found["load"].size > 100


def test_what_cannot_be_drawn_has_no_value(scene: dict[str, float]) -> None:
    scene["lambda_over_R"] = 8e-6  # more folds than can be drawn leave what has a closed form
    variables, status = draw_curves(scene, list(CURVES))
    assert status == NO_VALUE
    folded = ("equilibrium", "closing_equilibrium", "path", "asymptotic", "jumps")
    without = {name for name, values in variables.items() if values.size <= 1}
    assert without == {name for curve in folded for name in CURVES[curve]}
    assert draw_curves(scene, ["smooth", "envelope", "effective"])[1] == 0
    assert draw_curves(scene | {"lambda_over_R": 1e60}, ["path"])[1] & NO_VALUE, "a wave too long to be resolved"


def test_what_a_map_reports_of_the_cycle_is_told_with_the_path(scene: dict[str, float]) -> None:
    gains = scene_of(1.0, 0.5, 900.0, 0.1, 0.11, 2.3, 0.16)
    found, status = draw_curves(gains, ["jumps"])
    assert status == draw_curves(gains, ["path"])[1] == LOADING_NOT_ONE_DISC == solve(gains)["status"]
    assert (found["jump_unloading"][found["jump_energy"] < 0.0] == 0).tolist() == [True]
    jumps, _ = draw_curves(scene, ["jumps"])
    scene["a_max_over_R"] = float(jumps["jump_radius_before"][3])  # the end of a branch: an ulp further is a jump more
    assert draw_curves(scene, ["jumps", "path"])[1] == CLOSE_TO_A_JUMP
    for own in (gains, gains | {"load_max": 1e4}, scene):
        assert draw_curves(own, ["equilibrium"])[1] == 0
