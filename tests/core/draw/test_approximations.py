"""Curves without single waves, and those of short waves, against printed equations, chords and the solver."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Profile, draw_curves, solve
from gradhesion.core.equations import envelopes, short_waves
from gradhesion.core.problem.status import NO_VALUE
from tests.core.scene import ENDLESS, chord_error, curve_of, material_of, profile_of, strengths_of

TWO = profile_of(3.0, (1, 1.0, 0.0), (3, 0.1, -0.2))
ROUGH = profile_of(2.5, (1, 1.0, 0.0), (3, 0.2, -0.3))
UNEVEN = profile_of(2.0, (1, 1.0, 0.0), (2, 0.3, -0.2))  # its crests are no troughs
CONTRACT = 2e-4


def _drawn(scene: dict[str, float], curve: str, profile: Profile | None = None) -> tuple[Any, ...]:
    found, status = draw_curves(scene, [curve], profile)
    assert status & NO_VALUE == 0
    return tuple(found.values())


def _of(drawn: dict[str, Any], prefix: str) -> list[Any]:
    return [drawn[f"{prefix}_{name}"] for name in ("contact_radius", "indentation", "load")]


def _height(scene: dict[str, float]) -> float:
    return scene["A"] * scene["lambda_over_R"]


def _front(scene: dict[str, float]) -> float:
    """K in units of the load, 4 pi/((1+k) s^2)."""
    return 4 * math.pi / ((1 + scene["k"]) * strengths_of(scene)[0] ** 2) / (1.5 * math.pi)


def test_the_smooth_curve(any_scene: dict[str, float], drawn: dict[str, Any]) -> None:
    """That of the equations; its pull-off (3+k)/3 at a_1 [(3+k)/4]^(2/(3+k)) and the zero of its depth are points."""
    points, curve = _of(drawn, "smooth"), curve_of(any_scene | {"A": 0.0})
    for found, expected in zip(points[1:], curve(points[0][1:]), strict=True):
        assert np.abs(found[1:] - expected).max() <= 1e-13 * np.ptp(found)
    assert chord_error(curve, points) <= CONTRACT
    radius, depth, load = points
    assert radius.size <= 150
    k = any_scene["k"]
    zero = ((1 + k) * strengths_of(any_scene)[0]) ** (2 / (3 + k))
    lowest = zero * (0.25 * (3 + k)) ** (2 / (3 + k))
    if lowest <= radius[-1]:
        assert load.min() == pytest.approx(-(3 + k) / 3, rel=1e-13)
        assert np.abs(radius / lowest - 1).min() <= 1e-12
    if zero <= radius[-1]:
        nearest = int(np.abs(radius - zero).argmin())
        assert radius[nearest] == pytest.approx(zero, rel=1e-12)
        assert abs(depth[nearest]) <= 1e-13 * zero * zero


@pytest.mark.parametrize("profile", [None, TWO])
def test_points_of_short_waves_lie_on_the_curve_of_the_paper(scene: dict[str, float], profile: Profile | None) -> None:
    """And all folds of depth and extrema of load are points."""
    radius, depth, load = _drawn(scene, "asymptotic", profile)
    curve = curve_of(scene, profile, short_waves)
    for found, expected in zip((depth, load), curve(radius[1:]), strict=True):
        assert np.abs(found[1:] - expected).max() <= 1e-12 * np.ptp(found)
    assert depth[0] == pytest.approx((1.0 if profile is None else 1.1) * _height(scene), rel=1e-12)
    assert load[0] == 0.0
    dense = np.linspace(1e-4 * radius[-1], radius[-1], 100_001)
    for found, scan in zip((depth, load), curve(dense), strict=True):
        turns = np.count_nonzero(np.diff(np.sign(np.diff(found))))
        assert turns == np.count_nonzero(np.diff(np.sign(np.diff(scan)))) > 5
        assert found.max() == pytest.approx(scan.max(), abs=1e-7 * np.ptp(scan))


def test_chords_of_short_waves_are_within_the_contract(any_scene: dict[str, float], drawn: dict[str, Any]) -> None:
    points = _of(drawn, "asymptotic")
    if np.ptp(points[1]) > 1e-12 * np.abs(points[1]).max():  # of a long wave the mean height is all
        assert chord_error(curve_of(any_scene, None, short_waves), points) <= CONTRACT


def test_envelopes_are_those_of_the_paper(any_scene: dict[str, float], drawn: dict[str, Any]) -> None:
    """(5.26), (5.27); nothing is lost in the sampling of common radii."""
    k, M, height, (s, r) = any_scene["k"], material_of(any_scene), _height(any_scene), strengths_of(any_scene)
    radius = drawn["envelope_contact_radius"]
    for pull, way in ((s - r, "loading"), (s + r, "unloading")):

        def curve(a: Any, pull: float = pull) -> tuple[Any, Any]:
            return envelopes.indentation(k, a, pull, height), envelopes.load(k, M, a, pull)

        points = [drawn[f"{way}_envelope_{name}"] for name in ("indentation", "load")]
        for found, expected in zip(points, curve(radius[1:]), strict=True):
            assert np.abs(found[1:] - expected).max() <= 1e-13 * max(np.ptp(found), np.abs(found).max())
        assert chord_error(curve, (radius, *points)) <= CONTRACT
    assert radius.size <= 300


def _effective(scene: dict[str, float], profile: Profile | None = None) -> dict[str, Any]:
    names = ("contact_radius", "indentation", "load", "jump")
    return dict(zip(names, _drawn(scene, "effective", profile), strict=True))


def test_the_effective_path_jumps_where_the_paper_says_and_unloads_along_a_line(scene: dict[str, float]) -> None:
    """(5.34), (5.35); P = K [a^(1+k) delta - a^(3+k)/((3+k)R)] over a depth 2 r a^((1-k)/2), see (5.32)."""
    k, (s, r), height, a = scene["k"], strengths_of(scene), _height(scene), scene["a_max_over_R"]
    path = _effective(scene)
    first, last = np.flatnonzero(path["jump"])
    a_2, a_4 = ((level * pull) ** (2 / (3 + k)) for level, pull in ((1 + k, s - r), (0.25 * (1 - k * k), s + r)))
    assert path["contact_radius"][[first, last, last - 1]] == pytest.approx([a_2, 0.0, a_4], rel=1e-12)
    assert path["indentation"][first] == pytest.approx(height, rel=1e-14)
    assert last == path["load"].size - 1
    (turn,) = np.flatnonzero((path["contact_radius"][1:] == a) & (path["contact_radius"][:-1] == a))
    depth, load = (path[name][turn : turn + 2] for name in ("indentation", "load"))
    assert depth[0] - depth[1] == pytest.approx(2 * r * a ** ((1 - k) / 2), rel=1e-12)
    line = a ** (1 + k) * (depth - height) - a ** (3 + k) / (3 + k)
    assert load == pytest.approx(_front(scene) * line, rel=1e-11)


@pytest.mark.parametrize("change", [{"A": 0.005}, {"A": 0.1}, {"A": 0.4}, {"A": 0.4, "k": 1.0, "nu": 0.5}], ids=str)
def test_an_unbounded_path_turns_at_2_a_2_or_at_the_pull_off(change: dict[str, float], scene: dict[str, float]) -> None:
    """For r > s contact grows from a point."""
    scene |= ENDLESS | change
    k, (s, r), path = scene["k"], strengths_of(scene), _effective(scene)
    a_2 = ((1 + k) * max(0.0, s - r)) ** (2 / (3 + k))
    pull_off = (0.25 * (1 + k) * (3 + k) * (s + r)) ** (2 / (3 + k))
    assert path["contact_radius"].max() == pytest.approx(max(2 * a_2, pull_off), rel=1e-12)
    if change["A"] == 0.4:
        assert path["jump"].sum() == (1 if k < 1 else 0)
        assert path["jump"][0] == path["jump"][1] == path["contact_radius"][1] == path["load"][1] == 0
        assert path["indentation"][1] == pytest.approx(_height(scene) + (r - s if k == 1.0 else 0.0), rel=1e-12)


def test_a_rim_within_a_2_is_reached_by_the_jump_in(scene: dict[str, float]) -> None:
    path, height, k = _effective(scene | {"a_max_over_R": 0.05}), _height(scene), scene["k"]
    assert path["contact_radius"][:4].tolist() == [0.0, 0.0, 0.05, 0.05]
    assert path["jump"][:4].tolist() == [0, 0, 1, 0]
    assert path["indentation"][:3].tolist() == pytest.approx([0.0, height, height])
    assert path["load"][2] == pytest.approx(-_front(scene) * 0.05 ** (3 + k) / (3 + k), rel=1e-11)  # at the mean depth


@pytest.mark.parametrize("profile", [None, ROUGH, profile_of(1.0, (1, 1.0, 0.0), (3, 0.2, -0.3)), UNEVEN], ids=range(4))
@pytest.mark.parametrize("rim", [0.4, math.inf])
def test_the_effective_path_is_that_of_the_solver(scene: dict[str, float], profile: Profile | None, rim: float) -> None:
    """Radii, lowest load and loop integral are those of `solver = "envelope"`, whose rim is where the path turns."""
    path = _effective(scene | {"a_max_over_R": rim}, profile)
    depth, load = path["indentation"], path["load"]
    turned = scene | {"a_max_over_R": path["contact_radius"].max()}
    outputs = ["pull_off_force", "dissipated_energy", "delta_max", "delta_jump_out"]
    expected = solve(turned, outputs, solver="envelope", profile=profile)
    touched = _height(scene) * sum(wave.cos for wave in (profile or Profile()).harmonics)
    assert -load.min() == pytest.approx(float(expected["pull_off_force"]), rel=1e-12)
    assert depth.max() == pytest.approx(max(float(expected["delta_max"]), touched), rel=1e-12)
    assert depth[-1] == pytest.approx(float(expected["delta_jump_out"]), rel=1e-12)
    loop = 1.5 * math.pi * float(np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(depth)))
    # chords are within 2e-4 of a path that is four spans long at most: two up and two back
    allowed = 1.5 * math.pi * 8e-4 * np.ptp(load) * np.ptp(depth)
    assert loop == pytest.approx(float(expected["dissipated_energy"]), abs=allowed)
