"""A step of the edge: what of a change of its start is left at its end, and that it follows a slow edge."""

import math
from typing import Any

import pytest

from gradhesion.core import Loading, Profile
from gradhesion.core.rate.law import Law, lag_of, slowness
from gradhesion.core.rate.place import place_at
from gradhesion.core.rate.step import Start, advance, room_for_steps

SCENE = {"k": 0.37, "nu": 0.2, "modulus": 700.0, "c0_over_R": 0.03, "lambda_over_R": 0.17, "A": 0.013}


def test_how_a_change_grows(case_of: Any) -> None:
    case, room = case_of(SCENE | {"a_max_over_R": 0.4}, Profile(), Loading()), room_for_steps()
    law, start = Law(0.6, 1.0, 1.0, 0.1 * case.length / case.unit), Start(2.3, -1.0, 1.0, 1.0)
    ends = []
    for lag in (0.05, 0.05 + 1e-7):
        assert advance(case.basis, case.curve, law, start, (0.0, lag), 1e-3, room)
        ends.append((room.lags[-1], room.matrix[-1, -1]))
    assert (ends[1][0] - ends[0][0]) / 1e-7 == pytest.approx(ends[0][1], rel=1e-5)


@pytest.mark.parametrize("n", [0.6, 2.0])
def test_a_slow_edge_moves_as_the_equilibrium_curve(case_of: Any, n: float) -> None:
    """It starts where drag pace u^(-1/n) = q_hat - q0 and keeps to it but for the change of the lag itself."""
    case, room = case_of(SCENE | {"A": 0.0, "a_max_over_R": 0.4}, Profile(), Loading()), room_for_steps()
    law = Law(n, 1.0, 1.0, 1e-6 * case.length / case.unit)
    first, last = (place_at(case.basis, case.curve, 2.3 * math.exp(-s)) for s in (0.0, 1e-2))
    lag = lag_of(law, (first.push - first.level) / (law.pace * first.drag))
    assert advance(case.basis, case.curve, law, Start(2.3, -1.0, 1.0, 1.0), (0.0, lag), 1e-2, room)
    slow, _ = slowness(law, room.lags[-1])
    assert law.pace * last.drag * slow == pytest.approx(last.push - last.level, rel=20.0 * lag)
