"""Rims of a long curve: what is said of one does not depend on the others."""

import numpy as np

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP

MANY_WAVES = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.0005}
"""Loading jumps from its beginning to the 389th wave or so, and then from wave to wave."""
RIMS = np.linspace(0.19, 0.21, 161)
"""Four a wave, about the place to which it jumps."""


def jumps_up_to(amplitude: float, rims: float) -> int:
    return int(solve(MANY_WAVES | {"A": amplitude, "a_max_over_R": rims}, ["loading_jumps"])["loading_jumps"])


def test_a_jump_that_hardly_misses_a_wave_is_close_for_each_rim_from_there_on() -> None:
    below, above = 0.01, 0.015
    jumps = jumps_up_to(below, 0.3)
    assert jumps_up_to(above, 0.3) == jumps + 1
    while np.nextafter(below, 1.0) < above:
        middle = 0.5 * (below + above)
        below, above = (middle, above) if jumps_up_to(middle, 0.3) == jumps else (below, middle)
    for amplitude in (below, above):
        scene = MANY_WAVES | {"A": amplitude}
        among = solve(scene | {"a_max_over_R": RIMS}, ["loading_jumps"])["status"] & CLOSE_TO_A_JUMP
        alone = [solve(scene | {"a_max_over_R": rim}, ["loading_jumps"])["status"] & CLOSE_TO_A_JUMP for rim in RIMS]
        np.testing.assert_array_equal(among, alone)
        assert among[-1]
        assert not among[0]


def test_rims_near_and_far_are_those_solved_alone() -> None:
    """Rims near and far on one curve: the same bits as each by itself."""
    rng = np.random.default_rng(20261124)
    scenes = {
        "k": rng.choice([0.0, 0.2, 0.7], (12, 1)),
        "nu": 0.5,
        "modulus": 10.0 ** rng.uniform(0.0, 6.0, (12, 1)),
        "c0_over_R": 10.0 ** rng.uniform(-2.0, 1.0, (12, 1)),
        "lambda_over_R": 10.0 ** rng.uniform(-7.0, -2.0, (12, 1)),
        "A": 10.0 ** rng.uniform(-3.0, -1.0, (12, 1)),
        "a_max_over_R": 10.0 ** np.linspace(-4.0, 1.0, 6)[None, :],
    }
    found = solve(scenes, OUTPUTS)
    assert np.any(found["loading_jumps"] > 200)
    for i, j in np.ndindex(12, 6):
        alone = {name: np.broadcast_to(values, (12, 6))[i, j] for name, values in scenes.items()}
        for name, value in solve(alone, OUTPUTS, threads=1).items():
            np.testing.assert_array_equal(value, found[name][i, j])
