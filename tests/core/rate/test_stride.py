"""Steps against shorter ones, and what they say of themselves."""

import math
from typing import Any

import pytest

from gradhesion.core import Loading, Profile
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.step import Start, advance, room_for_steps
from gradhesion.core.rate.stride import LONGEST, PART, TOLERANCE, errors_of, longest, stride

SCENE = {"k": 0.37, "nu": 0.2, "modulus": 700.0, "c0_over_R": 0.03, "lambda_over_R": 0.17, "A": 0.013}


@pytest.mark.parametrize(("speed", "lag"), [(1e-6, 1e-4), (0.01, 0.02), (1.0, 0.3), (100.0, 2.0)])
@pytest.mark.parametrize("n", [0.1, 0.6, 2.0])
def test_a_step_is_as_exact_as_it_says(case_of: Any, speed: float, lag: float, n: float) -> None:
    case, room = case_of(SCENE | {"a_max_over_R": 0.4}, Profile(), Loading()), room_for_steps()
    law, start = Law(n, 1.0, 1.0, speed * case.length / case.unit), Start(2.3, -1.0, 1.0, 1.0)
    step = stride(case.basis, case.curve, law, start, (0.0, lag), (0.05, 0.05), 100.0, room)
    assert step.good
    assert step.of_rho <= TOLERANCE
    y, end, energy = 0.0, lag, 0.0
    for _ in range(20):
        one = stride(case.basis, case.curve, law, start, (y, end), (0.05 * step.h, 0.05 * step.h), 100.0, room)
        assert one.h == 0.05 * step.h
        y, end, energy = y + one.h, one.lag, energy + one.energy
    assert abs(end - step.lag) < 20 * TOLERANCE * (1.0 + lag)
    assert abs(energy - step.energy) < 20 * TOLERANCE * 400.0


def test_a_step_that_is_too_long_says_so(case_of: Any) -> None:
    case, room = case_of(SCENE | {"a_max_over_R": 0.4}, Profile(), Loading()), room_for_steps()
    law, start = Law(0.6, 1.0, 1.0, case.length / case.unit), Start(2.3, -1.0, 1.0, 1.0)
    assert advance(case.basis, case.curve, law, start, (0.0, 0.3), 0.5, room)
    assert max(errors_of(law, 0.5, 100.0, room)) > 1e3 * TOLERANCE


def test_steps_are_short_against_waves() -> None:
    for sign in (-1.0, 1.0):
        h = longest(50.0, sign, 1.0)
        assert 50.0 * abs(math.expm1(sign * h)) == pytest.approx(PART, rel=1e-12)
        assert longest(0.01, sign, math.inf) == LONGEST
