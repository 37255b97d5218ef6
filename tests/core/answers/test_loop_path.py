"""Paths of loops are those that curves are drawn by; their motion is that of paths that are drawn again."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import draw_curves, solve
from gradhesion.core.answers.loop_distance import feet
from gradhesion.core.answers.loop_path import LoopModel
from gradhesion.core.answers.loop_points import OFFSETS
from gradhesion.core.problem.profile import Harmonic, Profile

R = 5e-6
FIXED = {"k": 0.0, "nu": 0.3, "R": R}
TRUE = {"E_star": 1e7, "work_of_adhesion": 0.03, "wavelength": 0.5e-6, "A": 0.012}
SHIFT = (2e-9, 1e-8)
SCENE = {"k": 0.0, "nu": 0.3, "modulus": 1e7 * R / 0.03, "c0_over_R": 1.0, "lambda_over_R": 0.1, "A": 0.012}


def vector(names: tuple[str, ...], more: dict[str, float]) -> Any:
    own = TRUE | dict(zip(OFFSETS, SHIFT, strict=True)) | more
    return np.array([own[name] if name in (*OFFSETS, "k") else math.log(own[name]) for name in names])


def model(names: tuple[str, ...], fixed: dict[str, float], **more: Any) -> LoopModel:
    return LoopModel(fixed, names, **({"deepest": 0.05 * R, "first": -0.1 * R, "profile": Profile()} | more))


@pytest.mark.parametrize("rim", [math.inf, 0.2])
def test_a_path_is_that_of_the_curves(rim: float) -> None:
    own = model((*TRUE, *OFFSETS), FIXED | {"a_max": rim * R})
    found = own.path(vector(own.names, {}))
    assert found is not None
    turn = {"indentation_max_over_R": 0.05 - SHIFT[0] / R}
    drawn = draw_curves(SCENE | turn | {"a_max_over_R": rim}, ["path"])[0]
    expected = np.column_stack([R * drawn["path_indentation"], 1.5 * math.pi * R * 0.03 * drawn["path_load"]])
    apart = np.abs(expected[:, None] - (found.places - SHIFT)).max(axis=2).min(axis=1)
    assert apart.max() < 1e-13 * R, "its vertices are among them, with those that halve its chords"
    between = (drawn["path_jump"][1:] == 0) & (np.diff(drawn["path_contact_radius"]) != 0.0)
    pressed = rim < math.inf  # beyond full contact the pinned contact is pressed on to where the data turn
    assert found.places.shape[0] == 2 + len(expected) + np.count_nonzero(between) + pressed
    assert found.places[found.turn, 0] == pytest.approx(0.05 * R, rel=1e-12), "it turns where the data do"


def test_a_path_turns_at_a_preload() -> None:
    own = model(("E_star",), FIXED | {n: v for n, v in TRUE.items() if n != "E_star"} | {"preload": 5e-8})
    found = own.path(vector(own.names, {}))
    assert found is not None
    assert found.places[found.turn, 1] == pytest.approx(5e-8, rel=1e-10)
    assert found.places[:, 1].max() >= 5e-8


def test_a_path_through_a_machine_turns_where_its_far_end_does() -> None:
    own = model((*TRUE, *OFFSETS), FIXED | {"spring_constant": 10.0}, through_machine=True)
    found = own.path(vector(own.names, {}))
    assert found is not None
    assert found.places[found.turn, 0] == pytest.approx(0.05 * R, rel=1e-10)
    before = np.flatnonzero(found.jump) - 1
    np.testing.assert_allclose(found.places[before, 0], found.places[before + 1, 0], atol=1e-12 * R)
    assert np.ptp(found.places[before[0] : before[0] + 2, 1]) > 0.0


def test_no_contact_is_a_line_of_no_load() -> None:
    own = model(("E_star",), FIXED | {n: v for n, v in TRUE.items() if n != "E_star"}, deepest=-0.01 * R)
    found = own.path(vector(own.names, {}))
    assert found is not None
    assert not found.places[:, 1].any()


def test_a_force_of_the_path_is_that_of_the_solver() -> None:
    own = model((*TRUE, *OFFSETS), FIXED)
    found = own.path(vector(own.names, {}))
    assert found is not None
    force = solve(SCENE | {"a_max_over_R": 0.3}, ["pull_off_force"])["pull_off_force"]
    assert SHIFT[1] - found.places[:, 1].min() == pytest.approx(1.5 * math.pi * R * 0.03 * float(force), rel=1e-10)


SERIES = Profile(exponent=2.2, harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=2, sin=0.3)))
CASES: dict[str, tuple[tuple[str, ...], dict[str, float], dict[str, Any]]] = {
    "one cosine": ((*TRUE, *OFFSETS), FIXED, {}),
    "graded, rim": ((*TRUE, *OFFSETS), {**FIXED, "k": 0.3, "c0": 1e-7, "a_max": 0.3 * R}, {}),
    "k too": (("k", *TRUE, *OFFSETS), {**FIXED, "c0": 1e-7}, {}),
    "machine": (("spring_constant", *TRUE, *OFFSETS), FIXED, {"through_machine": True}),
    "series": ((*TRUE, *OFFSETS), FIXED, {"profile": SERIES}),
}


@pytest.mark.parametrize(
    "name", [case if case != "series" else pytest.param(case, marks=pytest.mark.slow) for case in CASES]
)
def test_distances_change_as_those_to_a_path_that_is_drawn_again(name: str) -> None:
    """In thousandths of the spans: chords, off by a fifth of one, change as much as the number they are drawn with."""
    names, fixed, more = CASES[name]
    own = model(names, fixed, **more)
    here = vector(names, {"k": 0.3, "spring_constant": 10.0})
    found = own.path(here)
    assert found is not None
    unit = np.ptp(found.places, axis=0) / 1000
    rng = np.random.default_rng(0)
    moving = own.moving(here, found) / unit[:, None]
    for piece in (slice(0, found.turn + 1), slice(found.turn, None)):
        chain = found.places[piece] / unit
        pieces, share = rng.integers(1, len(chain) - 2, 200), rng.random(200)[:, None]
        points = (1.0 - share) * chain[pieces] + share * chain[pieces + 1] + rng.standard_normal((200, 2))
        exact = feet(points, chain).slopes(moving[piece], found.jump[piece])
        for i, one in enumerate(names):
            step = np.zeros(here.size)
            step[i] = 1e-4 if one not in OFFSETS else 1e-4 * unit[OFFSETS.index(one)]
            ends = []
            for sign in (1.0, -1.0):
                drawn = own.path(here + sign * step)
                assert drawn is not None
                part = slice(0, drawn.turn + 1) if piece.start == 0 else slice(drawn.turn, None)
                ends.append(feet(points, drawn.places[part] / unit).distance)
            apart = np.abs((ends[0] - ends[1]) / (2.0 * step[i]) - exact[:, i])
            size, most = 1.0 if one not in OFFSETS else 0.01 / unit[OFFSETS.index(one)], np.abs(exact[:, i]).max()
            assert np.median(apart) < size + 0.01 * most, one
            assert np.quantile(apart, 0.9) < 3.0 * size + 0.03 * most, one
            assert most > 10.0 * size, one
