"""The equilibrium curve: its chords, its folds, its stable parts, and what a map says of the same scene."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.curves.equilibrium import draw_equilibrium
from gradhesion.core.curves.subject import Subject, subject_of

EPS = 2.0**-52


def _arrays(subject: Subject) -> tuple[Any, Any, Any, Any]:
    variables = draw_equilibrium(subject)
    return variables["contact_radius"], variables["indentation"], variables["load"], variables["stable"]


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    radius, depth, load, _ = _arrays(any_subject)
    assert worst_chord(any_subject.exact, (radius, depth, load)) <= 2e-4


@pytest.mark.parametrize("whole", [4, 8, 16])
@pytest.mark.parametrize(("wavelength", "amplitude"), [(0.002, 0.01), (0.008, 0.02), (0.008, 0.03)])
def test_whole_waves_without_folds_are_seen(
    wavelength: float, amplitude: float, whole: int, scene: dict[str, float], worst_chord: Callable[..., float]
) -> None:
    """From the last extremum to a rim some whole waves further, middle and quarters are in one phase: on one line."""
    scene |= {"lambda_over_R": wavelength, "A": amplitude}
    unbounded = subject_of(scene | {"a_max_over_R": math.inf})
    assert unbounded is not None
    subject = subject_of(scene | {"a_max_over_R": (unbounded.load_folds[-1] + whole) * wavelength})
    assert subject is not None
    radius, depth, load, _ = _arrays(subject)
    assert worst_chord(subject.exact, (radius, depth, load)) <= 2e-4


def test_points_are_modest(any_subject: Subject) -> None:
    """Smooth parts have some hundred; the width of a wave in the picture does the rest, eight points at least."""
    radius, _, _, _ = _arrays(any_subject)
    assert any_subject.trace is not None
    waves = any_subject.trace.shape[1]
    assert radius.size <= 200 + 60 * min(waves, 25) + 8 * waves


def test_the_curve_goes_from_zero_contact_to_the_end(any_subject: Subject) -> None:
    radius, depth, load, _ = _arrays(any_subject)
    assert radius[0] == load[0] == 0.0
    assert depth[0] == pytest.approx(-any_subject.stretch if any_subject.k == 1.0 else 0.0)
    assert radius[-1] == any_subject.end
    assert (np.diff(radius) > 0).all()


def test_points_lie_on_the_curve(scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    subject, slow = subject_of(scene), slow_curve(scene)
    assert subject is not None
    radius, depth, load, _ = _arrays(subject)
    for a, d, p in zip(radius[3::17], depth[3::17], load[3::17], strict=True):
        assert abs(d - slow.depth(a)) <= 1e-14 * np.ptp(depth)
        assert abs(p - slow.load(a)) <= 1e-14 * np.ptp(load)


def test_stable_is_where_depth_rises(any_subject: Subject) -> None:
    _, depth, _, stable = _arrays(any_subject)
    rising = np.diff(depth) > 0
    # a line is stable where one of its ends is
    assert np.array_equal(rising, (stable[1:] | stable[:-1]) == 1)
    turns = np.flatnonzero(np.diff(rising)) + 1
    assert (stable[turns] == 0).all()


def test_folds_are_the_only_points_between_stable_and_not(scene: dict[str, float]) -> None:
    subject = subject_of(scene)
    assert subject is not None
    _, _, _, stable = _arrays(subject)
    edges = np.flatnonzero(np.diff(stable) != 0)
    # inwards of a rise to 1 stands the start of a branch, at a fall to 0 its end; the rim may cut the last branch
    assert subject.trace is not None
    assert 2 * subject.trace.shape[1] - 1 <= edges.size <= 2 * subject.trace.shape[1]


def test_the_lowest_point_is_the_pull_off(any_scene: dict[str, float], any_subject: Subject) -> None:
    radius, _, load, _ = _arrays(any_subject)
    solved = solve(any_scene, ["pull_off_force", "pull_off_radius"])
    lowest = int(load.argmin())
    assert -load[lowest] == pytest.approx(float(solved["pull_off_force"]), rel=1e-13)
    assert radius[lowest] == pytest.approx(float(solved["pull_off_radius"]), rel=1e-9)


def test_many_waves_make_a_long_curve_of_few_points_a_wave(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"lambda_over_R": 2.5e-5, "a_max_over_R": 0.4})
    assert subject is not None
    radius, depth, _, _ = _arrays(subject)
    assert subject.trace is not None
    waves = subject.trace.shape[1]
    assert waves > 15_000
    assert radius.size <= 9 * waves
    turns = np.count_nonzero(np.diff(np.sign(np.diff(depth))))
    assert turns in (2 * waves - 1, 2 * waves, 2 * waves + 1)


def test_a_smooth_curve_is_the_limit_of_a_wavy_one(scene: dict[str, float]) -> None:
    curves = []
    for amplitude in (0.0, 1e-13):
        subject = subject_of(scene | {"A": amplitude, "a_max_over_R": math.inf})
        assert subject is not None
        curves.append(_arrays(subject))
    smooth, wavy = curves
    assert wavy[0].size == smooth[0].size
    for one, other in zip(smooth[:3], wavy[:3], strict=True):
        assert np.abs(one - other).max() <= 1e-9 * np.ptp(one)
    assert np.array_equal(smooth[3], wavy[3])
