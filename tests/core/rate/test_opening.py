"""Opening by similarity: with L = M^(-1/(3+k)) lengths go as L, depths as L^2, energies as L^2, speeds as L."""

import numpy as np
import pytest

from gradhesion.core import Loading
from gradhesion.core.arrays.rate import open_at_speed
from gradhesion.core.problem.profile import WAVY
from gradhesion.core.problem.rate import Rate
from gradhesion.core.rate.opening import smooth_power

SCENE = {"k": 0.37, "nu": 0.2, "modulus": 700.0, "c0_over_R": 0.03, "lambda_over_R": 0.17, "A": 0.013}


@pytest.mark.parametrize("n", [0.1, 0.6, 1.3, 2.0])
def test_similarity(n: float) -> None:
    speeds = np.array([1e-5, 1e-2, 1.0, 50.0])
    scene = SCENE | {"a_max_over_R": 0.5}
    one = open_at_speed(scene | {"speed_over_reference": speeds}, Rate(exponent=n), WAVY, Loading(), 1)
    factor = 3.7 ** (-1.0 / 3.37)
    stiffer = scene | {name: factor * scene[name] for name in ("lambda_over_R", "A", "a_max_over_R")}
    stiffer |= {"modulus": 3.7 * scene["modulus"]}
    other = open_at_speed(stiffer | {"speed_over_reference": factor * speeds}, Rate(exponent=n), WAVY, Loading(), 1)
    for name, power in [
        ("pull_off_force", 0),
        ("pull_off_radius", 1),
        ("delta_jump_out", 2),
        ("opening_energy", 2),
        ("edge_speed_at_pull_off", 0),
        ("rate_coefficient", -n),
    ]:
        assert np.allclose(other[name], factor**power * one[name], rtol=1e-11, atol=0.0), name


def test_the_power_of_the_start_is_smooth_enough() -> None:
    for n in np.linspace(0.1, 2.0, 20):
        assert smooth_power(n) / n >= 3.0
