"""Closing to a rim, and to a turn at the depth at which it met that rim."""

import math

import pytest

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.arrays.rate import close_at_speed
from gradhesion.core.problem.profile import WAVY
from gradhesion.core.problem.rate import Rate

SCENE = {"k": 0.37, "nu": 0.2, "modulus": 700.0, "c0_over_R": 0.03, "lambda_over_R": 0.17, "A": 0.013}
SPRING = {"machine_stiffness": 0.3}


@pytest.mark.parametrize("loading", [Loading(), Loading(control="machine")])
@pytest.mark.parametrize("speed", [1e-4, 0.1, 10.0])
def test_a_turn_where_the_rim_was_met(loading: Loading, speed: float) -> None:
    law, given = Rate(exponent=0.6, closing="same"), SPRING if loading.control == "machine" else {}
    scene = SCENE | given | {"speed_over_reference": speed, "closing_ratio": 0.7}
    rim = close_at_speed(scene | {"a_max_over_R": 0.31}, law, WAVY, loading, 1)
    turn = {"a_max_over_R": math.inf, "delta_max": rim["coordinate_at_turn"]}
    found = close_at_speed(scene | turn, law, WAVY, loading, 1)
    assert found["radius_at_turn"] == pytest.approx(0.31, rel=1e-11)
    assert found["turning_radius"] > 0.31
    assert found["closing_energy"] > rim["closing_energy"]
    assert rim["rho_edge_stops"] < math.sqrt(0.7)


def test_the_edge_follows_at_once_where_rho_is_negative() -> None:
    """On a falling surface of a punch: Y stays while rho < 0, and the energy goes on."""
    profile = Profile(harmonics=(Harmonic(n=1, cos=1.0, sin=0.6),))
    scene = SCENE | {"A": 0.06, "closing_ratio": 0.1, "speed_over_reference": 1.0}
    radii = [0.13, 0.1325, 0.135, 0.1375, 0.14]
    found = close_at_speed(scene | {"a_max_over_R": radii}, Rate(exponent=0.6), profile, Loading(), 1)
    assert (found["rho_edge_stops"] < 0.0).all()
    assert found["coordinate_edge_stops"] == pytest.approx(found["coordinate_edge_stops"][0], rel=1e-10)
    assert (found["closing_energy"][1:] > found["closing_energy"][:-1]).all()
