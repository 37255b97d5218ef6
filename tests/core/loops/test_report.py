"""What the solver says of the cycle of a fit: as of the same scene that turns at the same radius."""

import math

import numpy as np

from gradhesion.core import solve
from gradhesion.core.loops.report import status_of
from gradhesion.core.problem.status import JUMP_IN_TO_RIM
from tests.core.loops.models import CASES, SCENE, R, vector


def test_the_status_is_that_of_the_scene() -> None:
    """Deep waves touch the surface before they should: loading is not one disc."""
    model = CASES["wavy"].model(("A",))
    for height in (0.012, 0.2):
        scene = SCENE | {"A": height, "a_max_over_R": 0.3}
        outputs = ["dissipated_energy", "loading_jumps", "unloading_jumps"]
        expected = int(solve(scene, outputs, threads=1)["status"])
        assert status_of(model, np.array([math.log(height)]), 0.3) == expected & ~JUMP_IN_TO_RIM
    assert expected != 0


def test_a_rim_that_is_met_is_reported_and_a_turn_before_it_is_not() -> None:
    """A jump of loading that reaches the rim is cut short there; that which ends at the turn is not."""
    model = CASES["rim"].model(("A",), {"a_max": 0.02 * R})
    here = vector(model)
    assert status_of(model, here, 0.02) & JUMP_IN_TO_RIM
    assert status_of(model, here, np.nextafter(0.02, 0.0)) & JUMP_IN_TO_RIM, "a radius in m, over R, is rounded"
    free = CASES["wavy"].model(("A",))
    assert not status_of(free, here, 0.02) & JUMP_IN_TO_RIM


def test_out_of_contact_nothing_is_said() -> None:
    model = CASES["wavy"].model(("A",))
    assert status_of(model, vector(model), 0.0) == 0


def test_equal_works_are_so_in_either_order() -> None:
    """Where both works are fitted, noise puts that of closing above the other as often as below."""
    model = CASES["smooth"].model(("work_of_adhesion_closing",))
    for ratio in (0.99, 1.01):
        assert status_of(model, np.log([ratio * 0.03]), 0.3) == 0
