"""The reference solver over patterns of toughness: kappa and its slopes, and the core within its stated errors."""

from typing import Any

import numpy as np
import pytest
from flint import arb

from gradhesion.core import Loading, solve
from gradhesion.core.problem.names import EDGE, OUTPUTS
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from gradhesion.twin import stated
from gradhesion.twin.general import Shape
from gradhesion.twin.general.pattern import Pattern

ROWS = ((1, 0.2, -0.1), (3, 0.05, 0.1))


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_slopes_of_kappa_are_those_of_differences(of: str) -> None:
    pattern = Pattern(
        {"toughness_wavelength_over_R": 0.13, "toughness_amplitude": 0.9}, Shape(pattern=ROWS, pattern_of=of)
    )
    a, step = arb(0.37), arb(2) ** -40
    (low, below, _), (kappa, first, second), (high, above, _) = (
        pattern.at(a * (1 + sign * step)) for sign in (-1, 0, 1)
    )
    assert float((high - low) / (2 * step)) == pytest.approx(float(first), rel=1e-10)
    assert float((above - below) / (2 * step)) == pytest.approx(float(second), rel=1e-10)
    assert abs(float(kappa)) <= pattern.greatest


def drawn(count: int) -> list[tuple[dict[str, Any], dict[str, Any], Shape]]:
    rng = np.random.default_rng(20261124)
    made = []
    for number in range(count):
        control, of = ("displacement", "load", "machine")[number % 3], ("toughness", "work")[number % 2]
        scene: dict[str, Any] = {
            "k": float(rng.choice([0.0, rng.uniform()])),
            "nu": rng.uniform(0.0, 0.5),
            "modulus": 10 ** rng.uniform(1.0, 3.5),
            "c0_over_R": 10 ** rng.uniform(-2.0, 0.0),
            "lambda_over_R": 10 ** rng.uniform(-0.8, 0.0),
            "A": float(rng.choice([0.0, 0.01])),
            "a_max_over_R": rng.uniform(0.2, 0.7),
            "closing_ratio": float(rng.choice([0.0, rng.uniform(), 1.0])),
            "toughness_wavelength_over_R": 10 ** rng.uniform(-1.0, -0.3),
            "toughness_amplitude": rng.uniform(0.1, 1.0),
        }
        if control == "machine":
            scene["machine_stiffness"] = 10 ** rng.uniform(-2.0, 1.0)
        if number % 4 == 1:
            scene["indentation_max_over_R"] = rng.uniform(0.01, 0.08)
        toughness = Toughness(tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in ROWS), of)
        shape = Shape(control=control, pattern=ROWS, pattern_of=of)
        made.append((scene, {"toughness": toughness, "loading": Loading(control=control)}, shape))
    return made


def test_the_core_keeps_its_stated_errors_over_patterns() -> None:
    names, compared = [*OUTPUTS, *EDGE], 0
    for scene, how, shape in drawn(24):
        try:
            expected = stated.expected(scene, names, "exact", shape)
        except ArithmeticError:  # a fold that the edge of a piece cannot be told from
            continue
        found = solve(scene, names, **how)
        for name in names:
            one = expected[name]
            assert stated.deviation(float(found[name]), one) <= one.error or one.near, (name, scene)
        compared += 1
    assert compared > 18
