"""The twin of general scenes, patterns and envelopes: 24 of another program, the twin of one wave, integrals, closed forms."""

import json
import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from flint import arb

from gradhesion.twin import stated
from gradhesion.twin.energy import dissipated, double_exponential, loop
from gradhesion.twin.envelope import solve_envelope
from gradhesion.twin.general import Shape
from gradhesion.twin.general.integrals import Integral
from gradhesion.twin.general.pattern import Pattern
from gradhesion.twin.general.series import Series
from gradhesion.twin.path import cycle
from gradhesion.twin.scene import curve_of, solve, waves_to_follow
from tests.core.scene import scene_of
from tests.exact import envelope_loop, theta

from .compare import general_scene

ULP = 2.0**-52
SCENES = json.loads((Path(__file__).parents[1] / "reference" / "general.json").read_text())["scenes"]


@pytest.mark.parametrize("index", range(len(SCENES)))
def test_reference(index: int) -> None:
    parameters: dict[str, Any] = dict(SCENES[index]["parameters"])
    waves = tuple((wave["n"], wave["cos"], wave["sin"]) for wave in parameters.pop("harmonics"))
    solution = solve(parameters, Shape(parameters.pop("exponent"), waves, parameters.pop("control")))
    for name, value in SCENES[index]["expected"].items():
        if name != "M":
            assert abs(float(getattr(solution, name)) - value) <= 2 * ULP * abs(value), name


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize("y", [0.013, 0.25, 3.3, 41.7, 260.2])
def test_the_cosine_integral_is_its_definition(k: float, y: float) -> None:
    """T0 and its slope by quadrature, with t = 1 - u as in test_twin; k = 1 against elementary functions."""
    exponent, z = arb(k), arb(y)
    value, slope = Integral(exponent, sine=False).at(z)
    if k == 1.0:
        assert abs(value - z.sin() / z) < 1e-40
        assert abs(slope - (z.cos() / z - z.sin() / z**2)) < 1e-40
    elif y < 10:
        rule = double_exponential()
        weight = [(w * (u * (2 - u)) ** ((exponent - 1) / 2), 1 - u) for u, w in rule]
        ends = 1e-12 if k > 0 else 1e-18  # the rule ends at u = 1e-40
        assert abs(value - sum((w * (z * t).cos() for w, t in weight), arb(0))) < ends
        assert abs(slope + sum((w * t * (z * t).sin() for w, t in weight), arb(0))) < ends


def test_the_sum_over_waves_is_that_of_its_terms() -> None:
    waves = ((2, 0.3, -0.2), (7, 0.0, 0.05), (9, -0.4, 0.0))
    series = Series(0.41, waves)
    sine, cosine = Integral(arb(0.41), sine=True), Integral(arb(0.41), sine=False)
    for z in (arb(0), arb(0.02), arb(1) / 3, arb(17.03)):
        w = v = arb(0)
        for n, even, odd in waves:
            (s, s1), (t, t1) = sine.at(n * z), cosine.at(n * z)
            w += n * (even * s + odd * t)
            v += n * (even * (s + n * z * s1) + odd * (t + n * z * t1))
        assert abs(series.w(z) - w) < 1e-40
        assert abs(series.v(z)[0] - v) < 1e-40
    step = arb(2) ** -60
    z = arb(5.5)
    assert abs((series.v(z + step)[0] - series.v(z - step)[0]) / (2 * step) - series.v(z)[1]) < 1e-25
    (s, _), (t, _) = sine.at(z), cosine.at(z)
    alone = [Series(0.41, ((1, 1.0, 0.0),)).pair(z), Series(0.41, ((1, 0.0, 1.0),)).pair(z)]
    assert abs(alone[0][0] - s) < 1e-40
    assert abs(alone[1][0] - t) < 1e-40
    assert abs((1 + arb(0.41)) * cosine.at(z)[1] + z * alone[1][1]) < 1e-40  # T0' = -z T1/(1+k)


def test_loop_integrals() -> None:
    """The drops at the jumps sum to the loop integral of P over what is prescribed, a spring's other end too."""
    rng = np.random.default_rng(31)
    done = 0
    while done < 8:
        scene, shape = general_scene(rng, 3)
        endless = shape.control == "load" or scene["a_max_over_R"] == math.inf
        if endless or waves_to_follow(scene, shape, cycle=True) > 20:
            continue
        curve = curve_of(scene, shape)
        path, _ = cycle(curve)
        drops = [dissipated(curve, jump) for jump in path.loading + path.unloading]
        size = float(sum((abs(drop) for drop in drops), arb(0)))
        assert abs(sum(drops, arb(0)) - loop(curve, path)) < 1e-30 * size
        done += 1


def test_what_has_no_end_is_told() -> None:
    """The waves of an endless cone never cease to fold; its pull-off has a value."""
    scene = scene_of(0.3, 0.2, 100.0, 0.1, 0.1, 0.1, math.inf)
    cone = Shape(1.0, ((1, 1.0, 0.0),))
    with pytest.raises(ArithmeticError, match="no end"):
        solve(scene, cone)
    assert not stated.within_reach(scene, ["dissipated_energy"], "exact", cone)
    assert stated.within_reach(scene, ["pull_off_force"], "exact", cone)
    assert stated.expected(scene, ["pull_off_force"], "exact", cone)["pull_off_force"].value > 0


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_slopes_of_kappa_are_those_of_differences(of: str) -> None:
    lengths = {"toughness_wavelength_over_R": 0.13, "toughness_amplitude": 0.9}
    pattern = Pattern(lengths, Shape(pattern=((1, 0.2, -0.1), (3, 0.05, 0.1)), pattern_of=of))
    a, step = arb(0.37), arb(2) ** -40
    (low, below, _), (kappa, first, second), (high, above, _) = (
        pattern.at(a * (1 + sign * step)) for sign in (-1, 0, 1)
    )
    assert float((high - low) / (2 * step)) == pytest.approx(float(first), rel=1e-10)
    assert float((above - below) / (2 * step)) == pytest.approx(float(second), rel=1e-10)
    assert abs(float(kappa)) <= pattern.greatest


@pytest.mark.parametrize(
    ("k", "chi", "reach"),
    [(0.31, 0.0625, 0.21), (0.31, 0.75, 0.9), (0.31, 1.625, 3.3), *((k, 0.75, 3.3) for k in (0.0, 0.31, 0.875))],
)
def test_the_energy_of_the_envelopes_is_the_loop_integral(k: float, chi: float, reach: float) -> None:
    scene = {"k": k, "nu": 0.5, "modulus": 7.0, "c0_over_R": 1.0, "lambda_over_R": 1e-3}
    with mpmath.workdps(30):
        n, M = (1 + mpmath.mpf(k)) / 2, 7 * theta(k, 0.5)
        s = mpmath.sqrt(2 ** (2 * n) * mpmath.pi / M)
        wave = mpmath.pi ** (1 - n) * mpmath.gamma(n) * mpmath.mpf(1e-3) ** n
        scene |= {"A": float(chi * s / wave), "a_max_over_R": reach * float(M) ** (-1 / (3 + k))}
        r = scene["A"] * wave
        energy = mpmath.mpf(float(solve_envelope(scene).dissipated_energy))
        assert abs(energy / envelope_loop(k, M, 2, r, r, scene["a_max_over_R"]) - 1) < 1e-14
