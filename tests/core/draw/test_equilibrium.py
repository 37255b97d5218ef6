"""The equilibrium curve: its chords, its folds, its stable parts, how far it goes, and what a map says of the scene."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.status import NO_VALUE


def _drawn(scene: dict[str, float]) -> tuple[Any, Any, Any, Any]:
    found, status = draw_curves(scene, ["equilibrium"])
    assert status == 0
    return found["contact_radius"], found["indentation"], found["load"], found["stable"]


def test_chords_are_within_the_contract(
    any_scene: dict[str, float], equation: Callable[..., Any], worst_chord: Callable[..., float]
) -> None:
    assert worst_chord(equation(any_scene), _drawn(any_scene)[:3]) <= 2e-4


@pytest.mark.parametrize("whole", [4, 8, 16])
@pytest.mark.parametrize(("wavelength", "amplitude"), [(0.002, 0.01), (0.008, 0.02), (0.008, 0.03)])
def test_whole_waves_without_folds_are_seen(
    wavelength: float,
    amplitude: float,
    whole: int,
    scene: dict[str, float],
    equation: Callable[..., Any],
    worst_chord: Callable[..., float],
) -> None:
    """From the last extremum to a rim some whole waves further, middle and quarters are in one phase: on one line."""
    scene |= {"lambda_over_R": wavelength, "A": amplitude}
    radius, _, load, _ = _drawn(scene | {"a_max_over_R": math.inf})
    last = radius[1:-1][np.diff(np.sign(np.diff(load))) != 0][-1]
    scene["a_max_over_R"] = float(last + whole * wavelength)
    assert worst_chord(equation(scene), _drawn(scene)[:3]) <= 2e-4


def test_points_are_modest(any_scene: dict[str, float]) -> None:
    """Smooth parts have some hundred; the width of a wave in the picture does the rest, eight points at least."""
    radius, _, _, stable = _drawn(any_scene)
    branches = np.count_nonzero(np.diff(stable.astype(int)) == 1)
    assert radius.size <= 200 + 60 * min(branches, 25) + 8 * branches


def test_the_curve_goes_from_zero_contact_outwards(
    any_scene: dict[str, float], strengths: Callable[..., tuple[float, float]]
) -> None:
    radius, depth, load, _ = _drawn(any_scene)
    assert radius[0] == load[0] == 0.0
    assert depth[0] == pytest.approx(-strengths(any_scene)[0] if any_scene["k"] == 1.0 else 0.0)
    assert (np.diff(radius) > 0).all()


@pytest.mark.parametrize(
    "change", [{}, {"A": 0.2}, {"A": 0.0}, {"A": 1e-5}, {"lambda_over_R": 1.3}, {"k": 1.0, "nu": 0.5}], ids=str
)
def test_an_unbounded_punch_is_drawn_beyond_all_that_happens(
    change: dict[str, float], scene: dict[str, float], strengths: Callable[..., tuple[float, float]]
) -> None:
    """1.5 times the zero of the smooth curve, a_1 = [(1+k) R s]^(2/(3+k)), or 5 % beyond the last event."""
    scene |= change | {"a_max_over_R": math.inf}
    radius, depth, load, _ = _drawn(scene)
    jumps = draw_curves(scene, ["jumps"])[0]
    events = [float(jumps["jump_radius_after"].max())]
    for values in (depth, load):
        events += radius[1:-1][np.diff(np.sign(np.diff(values))) != 0].tolist()
    k = scene["k"]
    zero = ((1 + k) * strengths(scene)[0]) ** (2 / (3 + k))
    assert radius[-1] == pytest.approx(max(1.5 * zero, 1.05 * max(events)), rel=1e-12)
    # the cycle of a punch that ends there has saturated
    energy = solve(scene | {"a_max_over_R": [radius[-1], math.inf]}, ["dissipated_energy"])["dissipated_energy"]
    assert energy[0] == pytest.approx(energy[1], rel=1e-12)


def test_points_lie_on_the_curve(scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    slow = slow_curve(scene)
    radius, depth, load, _ = _drawn(scene)
    for a, d, p in zip(radius[3::17], depth[3::17], load[3::17], strict=True):
        assert abs(d - slow.depth(a)) <= 1e-14 * np.ptp(depth)
        assert abs(p - slow.load(a)) <= 1e-14 * np.ptp(load)


def test_stable_is_where_depth_rises(any_scene: dict[str, float]) -> None:
    _, depth, _, stable = _drawn(any_scene)
    rising = np.diff(depth) > 0
    # a line is stable where one of its ends is
    assert np.array_equal(rising, (stable[1:] | stable[:-1]) == 1)
    turns = np.flatnonzero(np.diff(rising)) + 1
    assert (stable[turns] == 0).all()


def test_the_lowest_point_is_the_pull_off(any_scene: dict[str, float]) -> None:
    radius, _, load, _ = _drawn(any_scene)
    solved = solve(any_scene, ["pull_off_force", "pull_off_radius"])
    lowest = int(load.argmin())
    assert -load[lowest] == pytest.approx(float(solved["pull_off_force"]), rel=1e-12)
    assert radius[lowest] == pytest.approx(float(solved["pull_off_radius"]), rel=1e-8)


def test_many_waves_make_a_long_curve_of_few_points_a_wave(scene: dict[str, float]) -> None:
    radius, depth, _, _ = _drawn(scene | {"lambda_over_R": 5e-5, "a_max_over_R": 0.4})
    turns = np.count_nonzero(np.diff(np.sign(np.diff(depth))))
    assert turns > 15_000
    assert radius.size <= 4.5 * turns


def test_a_smooth_curve_is_the_limit_of_a_wavy_one(scene: dict[str, float]) -> None:
    smooth, wavy = (_drawn(scene | {"A": amplitude, "a_max_over_R": math.inf}) for amplitude in (0.0, 1e-13))
    for one, other in zip(smooth[1:3], wavy[1:3], strict=True):
        assert np.abs(np.interp(wavy[0], smooth[0], one) - other).max() <= 4e-4 * np.ptp(one)
    assert wavy[0][-1] == pytest.approx(smooth[0][-1], rel=1e-9)
    assert np.diff(smooth[3]).tolist().count(1) == np.diff(wavy[3]).tolist().count(1) == 1


def test_waves_too_long_to_be_resolved_have_no_value(scene: dict[str, float]) -> None:
    found, status = draw_curves(scene | {"lambda_over_R": 1e60}, ["equilibrium", "path"])
    assert status & NO_VALUE
    assert np.isnan(found["load"]).all()
    assert np.isnan(found["path_load"]).all()
