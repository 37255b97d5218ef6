"""The solver keeps its stated errors on hostile draws, of any kind, over patterns and where it turns."""

import math

import numpy as np
import pytest

from gradhesion.core import OUTPUTS
from gradhesion.core.problem.names import EDGE
from gradhesion.twin.shape import PLAIN
from gradhesion.twin.turning import TURNS
from tests.conformance.kinds import EXACT, one_of
from tests.core.scene import scene_of
from tests.stress.draw import eventful, hostile

from .compare import Case, compare, of_any_kind, of_one_cosine


def turned_or_patterned(count: int) -> list[Case]:
    """Scenes of such kinds, and one of each turn over some 80 waves, which the solver does not walk one by one."""
    made: list[Case] = []
    for number, kind in enumerate(one for one in EXACT if one.turn or one.pattern):
        scenes = kind.draw(np.random.default_rng([11, number]), count)
        made += [(one_of(scenes, i), kind.how, kind.shape) for i in range(count)]
    long = scene_of(0.3, 0.3, 3000.0, 0.01, 0.005, 0.01, math.inf)
    return [*made, *((long | {turn: target}, {}, PLAIN) for turn, target in zip(TURNS, (0.06, 20.0), strict=True))]


DRAWS: dict[str, tuple[list[Case], float, tuple[str, ...], int]] = {  # cases, most waves, outputs, fewest compared
    "hostile": (of_one_cosine(hostile(5, 120)), 20.0, OUTPUTS, 30),
    "eventful": (of_one_cosine(eventful(5, 120)), 20.0, OUTPUTS, 30),
    "of any kind": (of_any_kind(7, 40), 12.0, OUTPUTS, 20),
    "turned or patterned": (turned_or_patterned(6), 90.0, (*OUTPUTS, *EDGE), 40),
}


@pytest.mark.parametrize("draw", DRAWS)
def test_stated_errors_are_kept(draw: str) -> None:
    cases, most_waves, names, fewest = DRAWS[draw]
    made = compare(cases, (0.0, most_waves), names=names)
    assert made.scenes >= fewest
    assert made.unsure <= (0 if "pattern" not in draw else 4), "folds that the edge of a piece cannot be told from"
    assert made.near <= 4
    assert made.worst <= 1.0
