"""Turning points of the solver against those of the reference solver, to 30 digits."""

import math

import numpy as np
import pytest

pytest.importorskip("flint")

from gradhesion.core import OUTPUTS, solve
from gradhesion.twin import stated
from gradhesion.twin.turning import TURNS


def scenes(turn: str, seed: int, count: int) -> list[dict[str, float]]:
    rng = np.random.default_rng(seed)
    made = []
    for _ in range(count):
        k = float(rng.choice([0.0, 0.1, 0.3, 0.5, 0.8, 1.0]))
        scene = {
            "k": k,
            "nu": 0.5 if k == 1.0 else float(rng.uniform(-0.5, 0.5)),
            "modulus": 10.0 ** rng.uniform(0.0, 4.0),
            "c0_over_R": 0.01,
            "lambda_over_R": 10.0 ** rng.uniform(-1.3, 0.0),
            "A": float(rng.choice([0.0, 1e-3, 1e-2, 5e-2])) * rng.uniform(0.5, 1.0),
            "a_max_over_R": float(rng.choice([math.inf, 0.3, 1.0])),
        }
        target = rng.uniform(-0.01, 0.3) if turn == TURNS[0] else 10.0 ** rng.uniform(-2.0, 2.0)
        made.append(scene | {turn: float(target)})
    return made


@pytest.mark.parametrize("turn", TURNS)
def test_random_scenes(turn: str) -> None:
    drawn = scenes(turn, 11, 60)
    found = solve({name: [scene[name] for scene in drawn] for name in drawn[0]}, OUTPUTS)
    short = 0
    for i, scene in enumerate(drawn):
        expected = stated.expected(scene, OUTPUTS, "exact")
        short += 0.0 < found["turning_radius"][i] < scene["a_max_over_R"]
        for name in OUTPUTS:
            if not expected[name].near:
                assert stated.deviation(float(found[name][i]), expected[name]) <= expected[name].error, (name, scene)
    assert short > 20


def test_a_long_curve() -> None:
    """Some 200 waves, which the solver does not walk one by one."""
    scene = {"k": 0.3, "nu": 0.3, "modulus": 3000.0, "c0_over_R": 0.01, "lambda_over_R": 0.002, "A": 0.01}
    for turn, target in zip(TURNS, (0.06, 20.0), strict=True):
        one = scene | {"a_max_over_R": math.inf, turn: target}
        found = solve(one, OUTPUTS)
        assert found["turning_radius"] > 85 * 0.002
        expected = stated.expected(one, OUTPUTS, "exact")
        for name in OUTPUTS:
            assert stated.deviation(float(found[name]), expected[name]) <= expected[name].error, name
