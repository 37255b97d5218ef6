"""Ties are flagged where a result jumps, and nowhere else: both sides of every jump that halving can find."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP

COUNTS = ("loading_jumps", "unloading_jumps")
SIZE = 4000


def _draw(seed: int) -> dict[str, Any]:
    rng = np.random.default_rng(seed)
    k = rng.choice([0.0, 0.31, 0.8], SIZE)
    return {
        "k": k,
        "nu": np.full(SIZE, 0.3),
        "modulus": 10 ** rng.uniform(1, 4, SIZE),
        "c0_over_R": 10 ** rng.uniform(-3, 0, SIZE),
        "lambda_over_R": 10 ** rng.uniform(-1.5, -0.2, SIZE),
        "A": 10 ** rng.uniform(-2.5, -0.7, SIZE),
        "a_max_over_R": np.where(rng.uniform(0, 1, SIZE) < 0.9, 10 ** rng.uniform(-0.7, 0.3, SIZE), np.inf),
    }


def _halved(
    scenes: dict[str, Any], name: str, differ: Any, outputs: tuple[str, ...]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Halve steps of 5 % of one parameter down to neighbours on either side of a change; return both, where there is."""
    changed = differ(solve(scenes, outputs), solve(scenes | {name: scenes[name] * 1.05}, outputs), scenes)
    scenes = {key: values[changed] for key, values in scenes.items()}
    first, low, high = solve(scenes, outputs), scenes[name], scenes[name] * 1.05
    for _ in range(50):  # 0.05/2^50 is below the rounding of the first
        middle = 0.5 * (low + high)
        moved = differ(first, solve(scenes | {name: middle}, outputs), scenes)
        low, high = np.where(moved, low, middle), np.where(moved, middle, high)
    return scenes | {name: low}, scenes | {name: high}


def _counts_differ(first: dict[str, Any], other: dict[str, Any], _: Any) -> Any:
    return np.any([first[name] != other[name] for name in COUNTS], axis=0)


def _elsewhere(first: dict[str, Any], other: dict[str, Any], scenes: dict[str, Any]) -> Any:
    return np.abs(first["pull_off_radius"] - other["pull_off_radius"]) > 0.4 * scenes["lambda_over_R"]


def _is_close(scenes: dict[str, Any], outputs: tuple[str, ...]) -> Any:
    return (solve(scenes, outputs)["status"] & CLOSE_TO_A_JUMP) != 0


@pytest.mark.parametrize("name", ["a_max_over_R", "A", "lambda_over_R", "modulus"])
def test_both_sides_of_a_change_of_the_jumps(name: str) -> None:
    for side in _halved(_draw(70), name, _counts_differ, COUNTS):
        close = _is_close(side, COUNTS)
        assert close.size > 100
        assert np.all(close)


def test_both_sides_of_a_change_of_the_pull_off() -> None:
    outputs = ("pull_off_radius",)
    for side in _halved(_draw(71) | {"a_max_over_R": np.full(SIZE, math.inf)}, "A", _elsewhere, outputs):
        close = _is_close(side, outputs)
        assert close.size > 20
        assert np.all(close)


def test_hardly_any_scene_is_close() -> None:
    """A band of 1e-11 around some ten decisions a scene holds fewer than one of 10^6 scenes."""
    for seed in range(72, 76):
        assert not np.any(_is_close(_draw(seed), COUNTS))


def test_what_is_not_flagged_stays() -> None:
    """At 1e-9 off a change the flag is gone, and an error of 1e-12 in each parameter changes no count."""
    low, high = _halved(_draw(83), "A", _counts_differ, COUNTS)
    for side in (low | {"A": low["A"] * (1 - 1e-9)}, high | {"A": high["A"] * (1 + 1e-9)}):
        base = solve(side, COUNTS)
        clear = ~_is_close(side, COUNTS)
        assert np.count_nonzero(clear) > 0.9 * clear.size
        for name in ("A", "a_max_over_R", "lambda_over_R", "modulus"):
            for step in (1 - 1e-12, 1 + 1e-12):
                moved = solve(side | {name: side[name] * step}, COUNTS)
                assert not np.any(_counts_differ(base, moved, side)[clear])
