"""Closing after a turn: the slow law, and a rim that is met on the way."""

import math

import pytest
from scipy.integrate import quad

from gradhesion.core import Loading
from gradhesion.core.arrays.rate import close_at_speed
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.profile import WAVY
from gradhesion.core.problem.rate import Rate

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.0}
TURN = {"delta_max": 0.05, "a_max_over_R": math.inf, "closing_ratio": 0.6}


@pytest.mark.parametrize("n", [0.6, 1.0])
def test_a_slow_edge_gains_the_share_of_its_lag(n: float) -> None:
    """After the turn it gains c_n l, c_n = int_0^1 x^(1/n)/(1 + x^(1/n)) dx, l the distance behind equilibrium."""
    share = quad(lambda x: x ** (1.0 / n) / (1.0 + x ** (1.0 / n)), 0.0, 1.0)[0]
    assert share == pytest.approx({0.6: 0.238745, 1.0: 1.0 - math.log(2.0)}[n], abs=1e-6)
    eps, k, root = 1e-6 ** (0.6 / n), SCENE["k"], math.sqrt(0.6)
    found = close_at_speed(SCENE | TURN | {"speed_over_reference": eps}, Rate(exponent=n), WAVY, Loading(), 1)
    a = float(found["radius_at_turn"])
    c, M = 0.5 * (1.0 - k), float(stiffness(k, SCENE["nu"], SCENE["modulus"], SCENE["c0_over_R"]))
    pull = root * math.sqrt(2.0 ** (1.0 + k) * math.pi / M) * a**c
    slope = 2.0 * a / (1.0 + k) - c * pull / a
    behind = pull * (eps / slope) ** n / (2.0 * slope)
    assert found["turning_radius"] - a == pytest.approx(share * behind, rel=3.0 * eps**n + 1e-3)


@pytest.mark.parametrize("speed", [1e-3, 0.1, 10.0])
def test_a_rim_on_the_way(speed: float) -> None:
    law, scene = Rate(exponent=0.6), SCENE | {"A": 0.01} | TURN | {"speed_over_reference": speed}
    free = close_at_speed(scene, law, WAVY, Loading(), 1)
    rim = 0.5 * float(free["radius_at_turn"] + free["turning_radius"])
    found = close_at_speed(scene | {"a_max_over_R": rim}, law, WAVY, Loading(), 1)
    assert found["turning_radius"] == rim
    assert found["radius_at_turn"] == pytest.approx(float(free["radius_at_turn"]), rel=1e-13)
    assert 0.0 < found["rho_edge_stops"] < math.sqrt(0.6)
    assert free["coordinate_edge_stops"] < found["coordinate_edge_stops"] < 0.05
    assert found["closing_energy"] < free["closing_energy"]
