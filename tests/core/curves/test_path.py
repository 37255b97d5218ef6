"""The path of a cycle: stored cycles, energies by its own loop integral, and what a path may do at all."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.curve.branches import END, START
from gradhesion.core.curve.cosine import slope
from gradhesion.core.curves.forms import fill_points
from gradhesion.core.curves.path import draw_path
from gradhesion.core.curves.subject import Form, Subject, subject_of

TESTS = Path(__file__).parents[2]
UNIT = 1.5 * math.pi
"""P d(delta) in R^2 dgamma."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


def _path(subject: Subject) -> dict[str, Any]:
    return {name.removeprefix("path_"): values for name, values in draw_path(subject).items()}


def _joined(path: dict[str, Any]) -> Any:
    """Whether a point is reached along the equilibrium curve."""
    moved = np.diff(path["contact_radius"], prepend=0.0) != 0
    return moved & (path["jump"] == 0)


def _depth_slopes(form: Form, places: Any) -> Any:
    """The slope of the reduced depth over the place."""
    if form.is_plain:
        _, k, pull, _ = form.numbers
        return places - pull * 0.5 * (1 - k) * places ** (-0.5 * (1 + k))
    level = 0.5 * (1 - float(form.table["k"]))
    return 2 * math.pi * np.array([slope(form.table, form.curve, level, x)[0] for x in places])


def _loop(subject: Subject, path: dict[str, Any]) -> tuple[float, float]:
    """The integral of P d(delta) over the points: by the curve itself between them, and by chords."""
    radius, depth, load = path["contact_radius"], path["indentation"], path["load"]
    chords = 0.5 * (load[1:] + load[:-1]) * np.diff(depth)
    exact = chords.copy()
    steps = np.flatnonzero(_joined(path)[1:])
    form = subject.exact
    middle, half = 0.5 * (radius[steps + 1] + radius[steps]), 0.5 * (radius[steps + 1] - radius[steps])
    exact[steps] = 0.0
    for node, weight in zip(NODES, WEIGHTS, strict=True):
        points = np.empty((3, steps.size))
        points[0] = (middle + half * node) / form.radius_scale
        fill_points(form.table, form.numbers, points)
        rise = _depth_slopes(form, points[0]) * half * form.depth_scale / form.radius_scale
        exact[steps] += weight * form.scaled(points)[2] * rise
    return UNIT * float(exact.sum()), UNIT * float(chords.sum())


def _reference() -> list[dict[str, Any]]:
    scenes: list[dict[str, Any]] = json.loads((TESTS / "reference" / "scenes.json").read_text(encoding="utf-8"))[
        "scenes"
    ]
    assert len(scenes) == 60
    return scenes


def _twin() -> list[dict[str, Any]]:
    file = json.loads((TESTS / "twin" / "scenes.json").read_text(encoding="utf-8"))
    rows = [dict(zip(file["columns"], row, strict=True)) for row in file["scenes"]]
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
    return [
        {"parameters": {name: math.inf if row[name] is None else row[name] for name in names}, "expected": row}
        for row in rows[::20]
        if row["margin_jumps"] >= 1e-12
    ]


STORED = [*_reference(), *_twin()]


@pytest.fixture(params=STORED, ids=range(len(STORED)))
def stored(request: pytest.FixtureRequest) -> tuple[Subject, dict[str, Any], dict[str, Any]]:
    subject = subject_of(request.param["parameters"])
    assert subject is not None
    return subject, _path(subject), request.param["expected"]


def test_stored_cycles(stored: tuple[Subject, dict[str, Any], dict[str, Any]]) -> None:
    subject, path, expected = stored
    jumps, unloading, depth = path["jump"] == 1, path["unloading"] == 1, path["indentation"]
    assert (jumps & ~unloading).sum() == expected["loading_jumps"]
    assert (jumps & unloading).sum() == expected["unloading_jumps"]
    assert depth[-1] == pytest.approx(expected["delta_jump_out"], rel=1e-12, abs=1e-14 * np.ptp(depth))
    if subject.bounded:
        assert depth.max() == pytest.approx(expected["delta_max"], rel=1e-12, abs=1e-14 * np.ptp(depth))
    energy, chords = _loop(subject, path)
    # Gauss's rule, whose nodes feel a^k near zero contact; what chords cut off is their error times their length
    assert energy == pytest.approx(
        expected["dissipated_energy"], rel=1e-9, abs=1e-13 * UNIT * depth.max() * path["load"].max()
    )
    spans = np.ptp(depth), np.ptp(path["load"])
    length = np.hypot(np.diff(depth) / spans[0], np.diff(path["load"]) / spans[1]).sum()
    assert abs(chords - energy) <= 2e-4 * length * UNIT * spans[0] * spans[1]


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    path = _path(any_subject)
    points = path["contact_radius"], path["indentation"], path["load"]
    assert worst_chord(any_subject.exact, points, _joined(path)) <= 2e-4


def test_the_path_starts_and_ends_without_contact(any_subject: Subject) -> None:
    path = _path(any_subject)
    for name in ("contact_radius", "indentation", "load", "branch", "jump", "unloading"):
        assert path[name][0] == 0
    assert path["jump"][1] == 1
    assert path["contact_radius"][-1] == path["load"][-1] == 0
    assert path["unloading"][-1] == 1
    # at k = 1 contact ends along the first branch
    assert (path["branch"][-1], path["jump"][-1]) == ((1, 0) if any_subject.k == 1.0 else (0, 1))


def test_loading_goes_deeper_and_outwards_unloading_back(any_subject: Subject) -> None:
    path = _path(any_subject)
    assert (np.diff(path["unloading"]) >= 0).all()
    turn = int(path["unloading"].argmax())
    assert path["contact_radius"][turn - 1] == any_subject.end
    for name in ("contact_radius", "indentation"):
        assert (np.diff(path[name][:turn]) >= 0).all()
        assert (np.diff(path[name][turn - 1 :]) <= 0).all()


def test_a_jump_keeps_its_depth(any_subject: Subject) -> None:
    path = _path(any_subject)
    jumps = np.flatnonzero(path["jump"])
    assert np.array_equal(path["indentation"][jumps], path["indentation"][jumps - 1])
    assert (path["branch"][jumps] != path["branch"][jumps - 1]).all()


def test_points_lie_on_the_branch_that_they_name(any_subject: Subject) -> None:
    path, form = _path(any_subject), any_subject.exact
    trace = any_subject.trace
    assert trace is not None
    place = path["contact_radius"] / form.radius_scale
    at_rim = 1 + np.count_nonzero(trace[START] <= any_subject.end / form.radius_scale)
    on = (path["branch"] > 0) & (path["branch"] < at_rim)
    branch = path["branch"][on] - 1
    assert (place[on] >= trace[START, branch] * (1 - 1e-15)).all()
    assert (place[on] <= trace[END, branch] * (1 + 1e-15)).all()
    points = np.array([place[on], place[on], place[on]])
    fill_points(form.table, form.numbers, points)
    _, depth, load = form.scaled(points)
    # a corner has the depth of its jump, which is that of the curve to rounding
    assert np.abs(path["indentation"][on] - depth).max(initial=0.0) <= 1e-13 * np.ptp(path["indentation"])
    assert np.abs(path["load"][on] - load).max(initial=0.0) <= 1e-13 * np.ptp(path["load"])
    assert (path["contact_radius"][path["branch"] == at_rim] == any_subject.end).all()


def _rim_in_a_jump(scene: dict[str, float]) -> Subject:
    """A rim between the end of a branch and the next place as deep."""
    subject = subject_of(scene)
    assert subject is not None
    assert subject.trace is not None
    end, start = subject.trace[END, 3], subject.trace[START, 4]
    moved = subject_of(scene | {"a_max_over_R": (0.3 * end + 0.7 * start) * scene["lambda_over_R"]})
    assert moved is not None
    return moved


def test_a_rim_in_a_jump_pins_the_contact(scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    subject = _rim_in_a_jump(scene)
    path, slow = _path(subject), slow_curve(scene)
    pinned = path["branch"] == path["branch"].max()
    assert pinned.sum() == 2
    assert path["branch"].max() == 5
    (before, after) = np.flatnonzero(pinned)
    assert (path["jump"][before], path["unloading"][before]) == (1, 0)
    assert (path["jump"][after], path["unloading"][after]) == (0, 1)
    assert (path["contact_radius"][pinned] == subject.rim).all()
    for i in (before, after):
        assert abs(path["load"][i] / slow.pinned(subject.rim, path["indentation"][i]) - 1) <= 1e-12
    assert path["indentation"][before] > path["indentation"][after]
    assert path["indentation"][after] == pytest.approx(float(slow.depth(subject.rim)), rel=1e-12)
    # it lies on a falling part: unloading goes on with a jump inwards
    assert path["jump"][after + 1] == 1
    assert path["branch"][after + 1] == 4


def test_a_rim_before_any_equilibrium_is_one_jump_there_and_back(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"a_max_over_R": 0.01})
    assert subject is not None
    path = _path(subject)
    assert path["contact_radius"].tolist() == [0.0, 0.01, 0.01, 0.0]
    assert path["branch"].tolist() == [0, 1, 1, 0]
    assert path["jump"].tolist() == [0, 1, 0, 1]
    assert path["unloading"].tolist() == [0, 0, 1, 1]
    assert path["indentation"][0] == path["indentation"][1] == 0.0 > path["indentation"][2] == path["indentation"][3]


def test_an_unbounded_punch_turns_on_its_last_branch(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"a_max_over_R": math.inf, "A": 0.05})
    assert subject is not None
    assert subject.trace is not None
    path = _path(subject)
    turn = int(path["unloading"].argmax()) - 1
    assert path["branch"][turn] == path["branch"][turn + 1] == path["branch"].max() == subject.trace.shape[1]
    assert path["jump"][turn] == path["jump"][turn + 1] == 0
    energy, _ = _loop(subject, path)
    expected = solve(scene | {"a_max_over_R": math.inf, "A": 0.05}, ["dissipated_energy"])["dissipated_energy"]
    assert energy == pytest.approx(float(expected), rel=1e-9)


def test_the_smooth_cycle_is_the_closed_form(scene: dict[str, float]) -> None:
    scene |= {"A": 0.0, "a_max_over_R": math.inf}
    subject = subject_of(scene)
    assert subject is not None
    k = scene["k"]
    a_1 = ((1 + k) * subject.stretch) ** (2 / (3 + k))
    a_2 = (0.25 * (1 - k) * (1 + k) * subject.stretch) ** (2 / (3 + k))
    path = _path(subject)
    jumps = np.flatnonzero(path["jump"])
    assert path["contact_radius"][jumps] == pytest.approx([a_1, 0.0], rel=1e-14)
    assert path["contact_radius"][jumps[1] - 1] == pytest.approx(a_2, rel=1e-14)
    assert path["load"].min() == pytest.approx(-(3 + k) / 3, rel=1e-14)
