"""Stated errors cover true ones, and are tight: on classes of random scenes, against walking and the reference solver."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.curve.cosine import curve_of, depth
from gradhesion.core.path.cosine import extent, is_long, is_unresolved, walk
from gradhesion.core.path.loading import loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.material import stiffness

LOOSE = 50.0
"""Median of stated over true errors: 30 on the 10,000 scenes of docs/accuracy.md, more or less on some hundred."""


def walked(scene: dict[str, float], table_of: Callable[[float], Any], most: float) -> float | None:
    """The energy of a long curve with every wave walked, which costs half a microsecond each; None if it is not one."""
    material = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))
    stretch = math.sqrt(2.0 ** (1.0 + scene["k"]) * math.pi / material)
    table, wavelength = table_of(scene["k"]), scene["lambda_over_R"]
    curve, length, _ = curve_of(scene["k"], stretch, wavelength, scene["A"] * wavelength)
    arches, x = extent(table, curve), scene["a_max_over_R"] / wavelength
    if is_unresolved(arches, x) or not is_long(table, arches, x) or min(arches[1], 2.0 * x) - arches[0] > most:
        return None
    count, trace = walk(table, curve, arches, min(x, 1e300), np.empty((ROWS, 64)), True)
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    loss, _ = loading_to(table, curve, count, trace, x, True)
    back, _, _ = unloading_from(table, curve, count, trace, x, rim_depth, True)
    return 2.0 * math.pi * length**2 * (loss + back)


def test_sums_over_waves(table_of: Callable[[float], Any]) -> None:
    rng = np.random.default_rng(7)
    ratios = []
    for _ in range(1500):
        k = float(rng.choice([0.0, 1.0, 0.123, 0.3, 0.515, 0.77]))
        scene = {
            "k": k,
            "nu": 0.5 if k == 1.0 else float(rng.uniform(-0.9, 0.5)),
            "modulus": 10.0 ** rng.uniform(-1.0, 5.0),
            "c0_over_R": 10.0 ** rng.uniform(-3.0, 1.0),
            "lambda_over_R": 10.0 ** rng.uniform(-4.5, -1.0),
            "A": 10.0 ** rng.uniform(-4.0, -0.5),
            "a_max_over_R": float(rng.choice([math.inf, 10.0 ** rng.uniform(-1.0, 0.5)])),
        }
        truth = walked(scene, table_of, 4000.0)
        if truth is None:
            continue
        found = solve(scene, ["dissipated_energy", "dissipated_energy_error"], threads=1)
        ratios.append(abs(float(found["dissipated_energy"]) - truth) / float(found["dissipated_energy_error"]))
    assert len(ratios) > 100
    assert max(ratios) <= 1.0
    assert np.median(ratios) > 1.0 / LOOSE


def test_a_sum_that_was_stated_too_well() -> None:
    """A scene whose energy was 3.9e-13 off with 4.5e-16 stated."""
    flint = pytest.importorskip("flint")
    assert flint
    from gradhesion.twin import stated

    scene = {
        "k": 0.5151497773262723,
        "nu": 0.18281866458282015,
        "modulus": 457.6106545971537,
        "c0_over_R": 0.06748618171393445,
        "lambda_over_R": 0.0022015789829432234,
        "A": 0.08375097036821788,
        "a_max_over_R": 0.20490198450986574,
    }
    found = solve(scene, ["dissipated_energy", "dissipated_energy_error"])
    truth = stated.expected(scene, ["dissipated_energy"], "exact")["dissipated_energy"]
    assert stated.deviation(float(found["dissipated_energy"]), truth) <= found["dissipated_energy_error"]


def test_a_smooth_punch_with_its_pull_off_at_the_edge() -> None:
    pytest.importorskip("flint")
    from gradhesion.twin import stated

    rng = np.random.default_rng(5)
    names = ("pull_off_force", "dissipated_energy")
    worst, ratios = dict.fromkeys(names, 0.0), []
    for _ in range(300):
        k = float(rng.choice([0.0, 1.0, rng.uniform(0.0, 1.0)]))
        scene = {
            "k": k,
            "nu": 0.5 if k == 1.0 else float(rng.uniform(-0.9, 0.5)),
            "modulus": 10.0 ** rng.uniform(-3.0, 7.0),
            "c0_over_R": 10.0 ** rng.uniform(-3.0, 3.0),
            "lambda_over_R": 1.0,
            "A": 0.0,
            "a_max_over_R": math.inf,
        }
        free = float(solve(scene, ["pull_off_radius"])["pull_off_radius"])
        scene["a_max_over_R"] = free * 10.0 ** rng.uniform(-2.0, 0.0)
        found = solve(scene, [*names, *(f"{name}_error" for name in names)])
        for name, truth in stated.expected(scene, names, "exact").items():
            if name in names:
                ratio = stated.deviation(float(found[name]), truth) / float(found[f"{name}_error"])
                worst[name] = max(worst[name], ratio)
                ratios.append(ratio)
    assert max(worst.values()) <= 1.0
    assert np.median(ratios) > 1.0 / LOOSE
