"""The solver keeps its stated errors on hostile draws, of any kind, over patterns and where it turns."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Loading
from gradhesion.core.problem.names import EDGE
from gradhesion.twin.general import PLAIN, Shape
from gradhesion.twin.turning import TURNS
from tests.core.scene import pattern_of, scene_of
from tests.stress.draw import eventful, hostile

from .compare import Case, compare, of_any_kind, of_one_cosine

ROWS = ((1, 0.2, -0.1), (3, 0.05, 0.1))


def over_patterns(count: int) -> list[Case]:
    rng, made = np.random.default_rng(20261124), []
    for number in range(count):
        control, of = ("displacement", "load", "machine")[number % 3], ("toughness", "work")[number % 2]
        material = (
            rng.choice([0.0, rng.uniform()]),
            rng.uniform(0.0, 0.5),
            10 ** rng.uniform(1, 3.5),
            10 ** rng.uniform(-2, 0),
        )
        scene = scene_of(*material, 10 ** rng.uniform(-0.8, 0.0), rng.choice([0.0, 0.01]), rng.uniform(0.2, 0.7))
        scene |= {"closing_ratio": rng.choice([0.0, rng.uniform(), 1.0]), "toughness_amplitude": rng.uniform(0.1, 1.0)}
        scene["toughness_wavelength_over_R"] = 10 ** rng.uniform(-1.0, -0.3)
        scene |= {"machine_stiffness": 10 ** rng.uniform(-2.0, 1.0)} if control == "machine" else {}
        scene |= {TURNS[0]: rng.uniform(0.01, 0.08)} if number % 4 == 1 else {}
        how: dict[str, Any] = {"toughness": pattern_of(of, *ROWS), "loading": Loading(control=control)}
        numbers = {name: float(value) for name, value in scene.items()}
        made.append((numbers, how, Shape(control=control, pattern=ROWS, pattern_of=of)))
    return made


def turned(count: int) -> list[Case]:
    """Scenes that turn at a depth or a load, one of each over some 80 waves, which the solver does not walk one by one."""
    rng, made = np.random.default_rng(11), []
    for number in range(count):
        k = float(rng.choice([0.0, 0.1, 0.3, 0.5, 0.8, 1.0]))
        material = (k, 0.5 if k == 1.0 else float(rng.uniform(-0.5, 0.5)), float(10.0 ** rng.uniform(0.0, 4.0)), 0.01)
        A, rim = float(rng.choice([0.0, 1e-3, 1e-2, 5e-2])), float(rng.choice([math.inf, 0.3, 1.0]))
        scene = scene_of(*material, float(10.0 ** rng.uniform(-1.3, 0.0)), A, rim)
        target = {TURNS[0]: rng.uniform(-0.01, 0.3)} if number % 2 else {TURNS[1]: 10.0 ** rng.uniform(-2.0, 2.0)}
        made.append((scene | {name: float(value) for name, value in target.items()}, {}, PLAIN))
    long = scene_of(0.3, 0.3, 3000.0, 0.01, 0.005, 0.01, math.inf)
    return [*made, *((long | {turn: target}, {}, PLAIN) for turn, target in zip(TURNS, (0.06, 20.0), strict=True))]


DRAWS: dict[
    str, tuple[list[Case], float, tuple[str, ...], int]
] = {  # cases, most waves, outputs, fewest that are compared
    "hostile": (of_one_cosine(hostile(5, 120)), 20.0, OUTPUTS, 30),
    "eventful": (of_one_cosine(eventful(5, 120)), 20.0, OUTPUTS, 30),
    "of any kind": (of_any_kind(7, 40), 12.0, OUTPUTS, 20),
    "over patterns": (over_patterns(16), math.inf, (*OUTPUTS, *EDGE), 11),
    "turned": (turned(40), math.inf, OUTPUTS, 40),
}


@pytest.mark.parametrize("draw", DRAWS)
def test_stated_errors_are_kept(draw: str) -> None:
    cases, most_waves, names, fewest = DRAWS[draw]
    made = compare(cases, (0.0, most_waves), names=names)
    assert made.scenes >= fewest
    assert made.unsure <= (0 if "pattern" not in draw else 4), "folds that the edge of a piece cannot be told from"
    assert made.near <= 4
    assert made.worst <= 1.0
