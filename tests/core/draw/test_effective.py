"""The effective path: its radii (5.34), (5.35), its energy, and the exact path of short waves beside it."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.curves import draw_curves
from gradhesion.core.curves.effective import draw_effective, turning_place
from gradhesion.core.curves.envelope import envelopes_of
from gradhesion.core.curves.path import draw_path
from gradhesion.core.curves.subject import Subject, subject_of
from gradhesion.core.problem.profile import WAVY, Harmonic, Profile


def _path(subject: Subject) -> dict[str, Any]:
    return {name.removeprefix("effective_"): values for name, values in draw_effective(subject, WAVY).items()}


def _subject(scene: dict[str, float]) -> Subject:
    subject = subject_of(scene)
    assert subject is not None
    return subject


def _radius(subject: Subject, level: float, pull: float) -> float:
    """The contact radius [level R pull]^(2/(3+k)), pulls in s."""
    return float((level * subject.stretch * pull) ** (2 / (3 + subject.k)))


def test_the_radii_of_its_jumps(scene: dict[str, float]) -> None:
    subject = _subject(scene)
    k, chi = subject.k, subject.chi
    assert 0 < chi < 1
    path = _path(subject)
    jumps = np.flatnonzero(path["jump"])
    assert jumps.size == 2
    assert path["contact_radius"][jumps] == pytest.approx([_radius(subject, 1 + k, 1 - chi), 0.0], rel=1e-14)
    assert path["indentation"][jumps[0]] == subject.mean_height
    assert path["contact_radius"][jumps[1] - 1] == pytest.approx(
        _radius(subject, 0.25 * (1 - k * k), 1 + chi), rel=1e-14
    )
    assert jumps[1] == path["load"].size - 1
    assert path["load"].min() == pytest.approx(-(3 + k) / 3 * (1 + chi) ** 2, rel=1e-14)


def test_the_line_of_early_unloading(scene: dict[str, float]) -> None:
    """P = K [a^(1+k) delta - a^(3+k)/((3+k)R)] over a depth 2 r a^((1-k)/2), depth from the mean surface (5.32)."""
    subject = _subject(scene)
    k, a, r = subject.k, subject.rim, subject.chi * subject.stretch
    path = _path(subject)
    (turn,) = np.flatnonzero((path["contact_radius"][1:] == a) & (path["contact_radius"][:-1] == a))
    assert path["indentation"][turn] - path["indentation"][turn + 1] == pytest.approx(
        2 * r * a ** ((1 - k) / 2), rel=1e-12
    )
    front = 4 * math.pi / ((1 + k) * subject.stretch**2) / (1.5 * math.pi)
    for i in (turn, turn + 1):
        depth = path["indentation"][i] - subject.mean_height
        assert path["load"][i] == pytest.approx(front * (a ** (1 + k) * depth - a ** (3 + k) / (3 + k)), rel=1e-12)


def test_its_loop_is_the_energy_of_the_envelopes(any_scene: dict[str, float], any_subject: Subject) -> None:
    path = _path(any_subject)
    loop = 1.5 * math.pi * float(np.sum(0.5 * (path["load"][1:] + path["load"][:-1]) * np.diff(path["indentation"])))
    turned = any_scene | {"a_max_over_R": float(path["contact_radius"].max())}
    expected = float(solve(turned, ["dissipated_energy"], solver="envelope")["dissipated_energy"])
    spans = np.ptp(path["indentation"]), np.ptp(path["load"])
    length = np.hypot(np.diff(path["indentation"]) / spans[0], np.diff(path["load"]) / spans[1]).sum()
    assert abs(loop - expected) <= 2e-4 * length * 1.5 * math.pi * spans[0] * spans[1]
    assert length < 6  # so that the bound means something


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    path = _path(any_subject)
    points = np.array([path["contact_radius"], path["indentation"], path["load"]])
    spans = np.ptp(points, axis=1)
    turn = int(points[0].argmax())
    moved = np.diff(points[0], prepend=0.0) != 0
    joined = moved & (path["jump"] == 0)
    up = any_subject.plain(1.0 - any_subject.chi, any_subject.mean_height)
    down = any_subject.plain(1.0 + any_subject.chi, any_subject.mean_height)
    assert worst_chord(up, points[:, : turn + 1], joined[: turn + 1], spans) <= 2e-4
    assert worst_chord(down, points[:, turn + 1 :], joined[turn + 1 :], spans) <= 2e-4
    assert points.shape[1] <= 300


def test_loading_goes_out_unloading_back(any_subject: Subject) -> None:
    path = _path(any_subject)
    turn = int(path["contact_radius"].argmax())
    for name in ("contact_radius", "indentation"):
        assert (np.diff(path[name][: turn + 1]) >= 0).all()
        assert (np.diff(path[name][turn:]) <= 0).all()
    assert path["contact_radius"][0] == path["indentation"][0] == path["load"][0] == path["load"][-1] == 0
    assert path["contact_radius"][-1] == 0


def test_an_unbounded_punch_turns_at_twice_a_2(scene: dict[str, float]) -> None:
    subject = _subject(scene | {"a_max_over_R": math.inf})
    path = _path(subject)
    a_2 = path["contact_radius"][int(path["jump"].argmax())]
    assert path["contact_radius"].max() == pytest.approx(2 * a_2, rel=1e-14)
    # but never before the pull-off
    subject = _subject(scene | {"a_max_over_R": math.inf, "A": 0.1})
    k, chi = subject.k, subject.chi
    assert turning_place(subject, envelopes_of(subject, WAVY)) * subject.plain(1.0).radius_scale == pytest.approx(
        max(2 * _radius(subject, 1 + k, max(0.0, 1 - chi)), _radius(subject, 0.25 * (1 + k) * (3 + k), 1 + chi)),
        rel=1e-14,
    )
    assert _path(subject)["load"].min() == pytest.approx(-(3 + k) / 3 * (1 + chi) ** 2, rel=1e-14)


def test_for_r_beyond_s_contact_grows_from_a_point(scene: dict[str, float]) -> None:
    for k, nu in ((0.31, 0.27), (1.0, 0.5)):
        subject = _subject(scene | {"k": k, "nu": nu, "A": 0.4})
        assert subject.chi > 1
        path = _path(subject)
        assert path["jump"].sum() == (1 if k < 1 else 0)
        assert path["jump"][0] == path["jump"][1] == 0
        touching = subject.mean_height + ((subject.chi - 1) * subject.stretch if k == 1.0 else 0.0)
        assert path["indentation"][1] == pytest.approx(touching, rel=1e-14)
        assert path["contact_radius"][1] == path["load"][1] == 0
        assert path["load"].max() > 0


def test_a_rim_within_a_2_is_reached_by_the_jump_in(scene: dict[str, float]) -> None:
    subject = _subject(scene | {"a_max_over_R": 0.05})
    assert subject.rim < _radius(subject, 1 + subject.k, 1 - subject.chi)
    path = _path(subject)
    assert path["contact_radius"][:4].tolist() == [0.0, 0.0, 0.05, 0.05]
    assert path["jump"][:4].tolist() == [0, 0, 1, 0]
    height = subject.mean_height
    assert path["indentation"][:3].tolist() == pytest.approx([0.0, height, height])


@pytest.mark.parametrize("wavelength", [4e-3, 1e-3])
def test_short_waves_follow_it(wavelength: float, scene: dict[str, float]) -> None:
    """The exact path turns within one wave of the effective one, and ends with it to the second order."""
    subject = _subject(scene | {"lambda_over_R": wavelength, "A": 0.002 * wavelength ** (-0.5 * (1 + scene["k"]))})
    exact, effective = draw_path(subject)["path_indentation"], _path(subject)["indentation"]
    slope = 2 * subject.rim / (1 + subject.k)
    assert abs(exact.max() - effective.max()) <= wavelength * slope < 0.03 * np.ptp(exact)
    assert abs(exact.min() - effective.min()) <= wavelength**2


@pytest.mark.parametrize("exponent", [1.0, 2.5, 4.0])
@pytest.mark.parametrize("rim", [0.4, math.inf])
def test_the_effective_path_of_any_punch_is_that_of_the_solver(
    scene: dict[str, float], exponent: float, rim: float
) -> None:
    """Radii, lowest load and loop integral are those of `solver = "envelope"`, whose rim is where the path turns."""
    profile = Profile(exponent=exponent, harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=0.2, sin=-0.3)))
    found, status = draw_curves(scene | {"a_max_over_R": rim}, ["effective"], profile)
    assert status == 0
    radius, depth, load = (found[f"effective_{name}"] for name in ("contact_radius", "indentation", "load"))
    turned = scene | {"a_max_over_R": radius.max()}
    outputs = ["pull_off_force", "dissipated_energy", "delta_max", "delta_jump_out"]
    expected = solve(turned, outputs, solver="envelope", profile=profile)
    assert -load.min() == pytest.approx(float(expected["pull_off_force"]), rel=1e-3)
    touched = scene["lambda_over_R"] * scene["A"] * 1.2  # at the mean height, from where a small rim is jumped to
    assert depth.max() == pytest.approx(max(float(expected["delta_max"]), touched), rel=1e-12)
    assert depth[-1] == pytest.approx(float(expected["delta_jump_out"]), rel=1e-12)
    loop = 1.5 * math.pi * float(np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(depth)))
    # chords are within 2e-4 of a path that is four spans long at most: two up and two back
    allowed = 1.5 * math.pi * 8e-4 * np.ptp(load) * np.ptp(depth)
    assert loop == pytest.approx(float(expected["dissipated_energy"]), abs=allowed)
