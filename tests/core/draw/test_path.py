"""The path of a cycle: stored cycles, energies by its own loop integral, and what a path may do at all."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import draw_curves, solve

TESTS = Path(__file__).parents[2]
UNIT = 1.5 * math.pi
"""P d(delta) in R^2 dgamma."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


def _path(scene: dict[str, float]) -> dict[str, Any]:
    return {name.removeprefix("path_"): values for name, values in draw_curves(scene, ["path"])[0].items()}


def _joined(path: dict[str, Any]) -> Any:
    """Whether a point is reached along the equilibrium curve."""
    moved = np.diff(path["contact_radius"], prepend=0.0) != 0
    return moved & (path["jump"] == 0)


def _loop(scene: dict[str, float], path: dict[str, Any], equation: Callable[..., Any]) -> tuple[float, float]:
    """The integral of P d(delta) over the points: by the curve itself between them, and by chords.

    Along the curve int P d(delta) is the change of P delta less int delta dP, of whichever the smoother is integrated
    the slope of the load: here both by the midpoints of Gauss's rule and the change between them.
    """
    radius, depth, load = path["contact_radius"], path["indentation"], path["load"]
    chords = 0.5 * (load[1:] + load[:-1]) * np.diff(depth)
    exact = chords.copy()
    steps = np.flatnonzero(_joined(path)[1:])
    curve = equation(scene)
    middle, half = 0.5 * (radius[steps + 1] + radius[steps]), 0.5 * (radius[steps + 1] - radius[steps])
    # the depth as the polynomial through the nodes, whose slope there is a matrix
    barycentric = np.array([1.0 / np.prod(np.delete(node - NODES, i)) for i, node in enumerate(NODES)])
    with np.errstate(divide="ignore"):
        slope = barycentric[None, :] / barycentric[:, None] / (NODES[:, None] - NODES[None, :])
    np.fill_diagonal(slope, 0.0)
    np.fill_diagonal(slope, -slope.sum(axis=1))
    states = [curve(middle + half * node) for node in NODES]
    depths, loads = np.array([each[0] for each in states]), np.array([each[1] for each in states])
    exact[steps] = WEIGHTS @ (loads * (slope @ depths))
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


@pytest.mark.parametrize("stored", STORED, ids=range(len(STORED)))
def test_stored_cycles(stored: dict[str, Any], equation: Callable[..., Any]) -> None:
    scene, expected = stored["parameters"], stored["expected"]
    path = _path(scene)
    jumps, unloading, depth = path["jump"] == 1, path["unloading"] == 1, path["indentation"]
    assert (jumps & ~unloading).sum() == expected["loading_jumps"]
    assert (jumps & unloading).sum() == expected["unloading_jumps"]
    assert depth[-1] == pytest.approx(expected["delta_jump_out"], rel=1e-12, abs=1e-14 * np.ptp(depth))
    if scene["a_max_over_R"] < math.inf:
        assert depth.max() == pytest.approx(expected["delta_max"], rel=1e-12, abs=1e-14 * np.ptp(depth))
    energy, chords = _loop(scene, path, equation)
    # Gauss's rule, whose nodes feel a^k near zero contact; what chords cut off is their error times their length
    assert energy == pytest.approx(
        expected["dissipated_energy"], rel=1e-9, abs=1e-12 * UNIT * depth.max() * path["load"].max()
    )
    spans = np.ptp(depth), np.ptp(path["load"])
    length = np.hypot(np.diff(depth) / spans[0], np.diff(path["load"]) / spans[1]).sum()
    assert abs(chords - energy) <= 2e-4 * length * UNIT * spans[0] * spans[1]


def test_chords_are_within_the_contract(
    any_scene: dict[str, float], equation: Callable[..., Any], worst_chord: Callable[..., float]
) -> None:
    path = _path(any_scene)
    points = path["contact_radius"], path["indentation"], path["load"]
    assert worst_chord(equation(any_scene), points, _joined(path)) <= 2e-4


def test_the_path_starts_and_ends_without_contact(any_scene: dict[str, float]) -> None:
    path = _path(any_scene)
    for name in ("contact_radius", "indentation", "load", "branch", "jump", "unloading"):
        assert path[name][0] == 0
    assert path["jump"][1] == 1
    assert path["contact_radius"][-1] == path["load"][-1] == 0
    assert path["unloading"][-1] == 1
    # at k = 1 contact ends along the first branch
    assert (path["branch"][-1], path["jump"][-1]) == ((1, 0) if any_scene["k"] == 1.0 else (0, 1))


def test_loading_goes_deeper_and_outwards_unloading_back(any_scene: dict[str, float]) -> None:
    path, end = _path(any_scene), draw_curves(any_scene, ["equilibrium"])[0]["contact_radius"][-1]
    assert (np.diff(path["unloading"]) >= 0).all()
    turn = int(path["unloading"].argmax())
    assert path["contact_radius"][turn - 1] == end
    for name in ("contact_radius", "indentation"):
        rounding = 1e-14 * np.ptp(path[name])
        assert (np.diff(path[name][:turn]) >= -rounding).all()
        assert (np.diff(path[name][turn - 1 :]) <= rounding).all()


def test_a_jump_keeps_its_depth_and_leaves_its_branch(any_scene: dict[str, float]) -> None:
    path = _path(any_scene)
    jumps = np.flatnonzero(path["jump"])
    np.testing.assert_allclose(
        path["indentation"][jumps], path["indentation"][jumps - 1], rtol=0, atol=1e-14 * np.ptp(path["indentation"])
    )
    assert (path["branch"][jumps] != path["branch"][jumps - 1]).all()


def test_points_lie_on_the_branch_that_they_name(any_scene: dict[str, float], equation: Callable[..., Any]) -> None:
    """Branches are counted outwards on the equilibrium curve: a stable stretch each."""
    path = _path(any_scene)
    curve = draw_curves(any_scene, ["equilibrium"])[0]
    stable = np.concatenate([[0], curve["stable"], [0]]).astype(int)
    starts = curve["contact_radius"][np.maximum(np.flatnonzero(np.diff(stable) == 1) - 1, 0)]
    ends = curve["contact_radius"][np.minimum(np.flatnonzero(np.diff(stable) == -1), curve["stable"].size - 1)]
    on = (path["branch"] > 0) & (path["branch"] <= starts.size)
    branch, radius = path["branch"][on] - 1, path["contact_radius"][on]
    assert (radius >= starts[branch] * (1 - 1e-9)).all()
    assert (radius <= ends[branch] * (1 + 1e-9)).all()
    inner = on & (path["contact_radius"] > 0.0)
    depth, load = equation(any_scene)(path["contact_radius"][inner])
    assert np.abs(path["indentation"][inner] - depth).max(initial=0.0) <= 1e-12 * np.ptp(path["indentation"])
    assert np.abs(path["load"][inner] - load).max(initial=0.0) <= 1e-12 * np.ptp(path["load"])
    flat = path["contact_radius"][path["branch"] == starts.size + 1]
    assert (flat == curve["contact_radius"][-1]).all()


def test_a_rim_in_a_jump_pins_the_contact(scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    free = _path(scene | {"a_max_over_R": math.inf})
    third = np.flatnonzero((free["jump"] == 1) & (free["unloading"] == 0))[2]
    rim = float(0.3 * free["contact_radius"][third - 1] + 0.7 * free["contact_radius"][third])
    branch = free["branch"][third - 1]
    path, slow = _path(scene | {"a_max_over_R": rim}), slow_curve(scene)
    pinned = path["contact_radius"] == rim
    assert pinned.sum() == 2
    assert (path["branch"][pinned] == branch + 1).all()
    (before, after) = np.flatnonzero(pinned)
    assert (path["jump"][before], path["unloading"][before]) == (1, 0)
    assert (path["jump"][after], path["unloading"][after]) == (0, 1)
    for i in (before, after):
        assert abs(path["load"][i] / slow.pinned(rim, path["indentation"][i]) - 1) <= 1e-12
    assert path["indentation"][before] > path["indentation"][after]
    assert path["indentation"][after] == pytest.approx(float(slow.depth(rim)), rel=1e-12)
    # it lies on a falling part: unloading goes on with a jump inwards
    assert path["jump"][after + 1] == 1
    assert path["branch"][after + 1] == branch


def test_a_rim_before_any_equilibrium_is_one_jump_there_and_back(scene: dict[str, float]) -> None:
    path = _path(scene | {"a_max_over_R": 0.01})
    assert path["contact_radius"].tolist() == [0.0, 0.01, 0.01, 0.0]
    assert path["branch"].tolist() == [0, 1, 1, 0]
    assert path["jump"].tolist() == [0, 1, 0, 1]
    assert path["unloading"].tolist() == [0, 0, 1, 1]
    depth = path["indentation"]
    assert depth[:2].tolist() == pytest.approx([0.0, 0.0], abs=1e-14 * np.ptp(depth))
    assert 0.0 > depth[2] == pytest.approx(depth[3], rel=1e-14)


def test_an_unbounded_punch_turns_on_its_last_branch(scene: dict[str, float], equation: Callable[..., Any]) -> None:
    scene |= {"a_max_over_R": math.inf, "A": 0.05}
    path = _path(scene)
    turn = int(path["unloading"].argmax()) - 1
    assert path["branch"][turn] == path["branch"][turn + 1] == path["branch"].max()
    assert path["jump"][turn] == path["jump"][turn + 1] == 0
    energy, _ = _loop(scene, path, equation)
    expected = solve(scene, ["dissipated_energy"])["dissipated_energy"]
    assert energy == pytest.approx(float(expected), rel=1e-9)


@pytest.mark.parametrize("turn", [{"indentation_max_over_R": 0.07}, {"load_max": 3.0}], ids=str)
@pytest.mark.parametrize("rim", [0.47, math.inf])
def test_a_cycle_turns_where_a_map_says(scene: dict[str, float], turn: dict[str, float], rim: float) -> None:
    scene |= turn | {"a_max_over_R": rim}
    path, solved = _path(scene), solve(scene, ["turning_radius", "delta_max", "loading_jumps", "unloading_jumps"])
    last = int(path["unloading"].argmax()) - 1
    assert path["contact_radius"][last] == pytest.approx(float(solved["turning_radius"]), rel=1e-11)
    assert path["indentation"][last] == pytest.approx(float(solved["delta_max"]), rel=1e-11)
    target = path["indentation" if "load_max" not in turn else "load"][last]
    assert target == pytest.approx(next(iter(turn.values())), rel=1e-9)
    assert path["jump"].sum() == solved["loading_jumps"] + solved["unloading_jumps"]


def test_without_contact_there_is_one_point(scene: dict[str, float]) -> None:
    found, status = draw_curves(scene | {"indentation_max_over_R": -0.01}, ["path", "jumps"])
    assert status == solve(scene | {"indentation_max_over_R": -0.01})["status"] != 0
    assert found["path_contact_radius"].tolist() == found["path_load"].tolist() == [0.0]
    assert found["path_indentation"].tolist() == [-0.01]
    assert found["jump_energy"].size == 0
