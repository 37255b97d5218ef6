"""Is the contact one disc on a patterned interface, or turned at a depth or a load? The gap by quadrature.

Plain contacts under every control are decided by brute force in tests/conformance. With K = cos(k pi/2) (2/pi) > 0

    gap(r) = K int_a^r s^k (delta_H(s) - delta) (r^2 - s^2)^(-(1+k)/2) ds
"""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gradhesion.core import draw_curves
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC
from tests.conformance.kinds import DEPTH, LOAD, Kind
from tests.conformance.theory import Curve

UNDECIDED = 2e-3
"""Least gaps as near to 0 as this, in parts of the largest, are not decided by 400 radii."""


def least_gap(curve: Curve, without: CubicSpline, a: float, end: float, depth: float) -> float:
    """The least gap outside a contact up to a radius, over the largest."""
    gaps = curve.gaps(a, np.linspace(a, end, 401)[1:], without, -depth)
    return float(gaps.min() / gaps.max())


def depth_without_adhesion(curve: Curve, end: float) -> CubicSpline:
    grid = end * np.linspace(0.0, 1.0, int(300 * end / curve.wavelength) + 60)[1:] ** 1.5
    return CubicSpline(grid, curve.without_adhesion(grid))


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_patterns(of: str) -> None:
    """Outside what loading leaves by a jump. Of 100 such scenes none was told wrong."""
    kind, decided = Kind("patterned", pattern=of), [0, 0]
    for seed in range(12):
        rng = np.random.default_rng(seed)
        scene: dict[str, Any] = {"k": rng.uniform(0.0, 0.9), "nu": 0.3, "modulus": 10 ** rng.uniform(4.0, 7.0)}
        scene |= {"c0_over_R": 0.1, "lambda_over_R": 0.1, "A": 10 ** rng.uniform(-2.2, -1.5), "a_max_over_R": 0.45}
        scene |= {"toughness_wavelength_over_R": 0.07, "toughness_amplitude": rng.uniform(0.5, 2.0)}
        curve = Curve(kind, scene)
        without = depth_without_adhesion(curve, 0.45)
        found, status = draw_curves(scene, ["path", "jumps"], **kind.how)
        ends = (found[f"jump_{name}"] for name in ("radius_before", "radius_after", "indentation", "unloading"))
        jumps = [jump[:3] for jump in zip(*ends, strict=True) if not jump[3] and jump[0] > 0.0]
        least = min((least_gap(curve, without, *jump) for jump in jumps), default=1.0)
        if abs(least) > UNDECIDED:
            flagged = bool(status & LOADING_NOT_ONE_DISC)
            assert flagged == (least < 0.0), (scene, least)
            decided[flagged] += 1
    assert min(decided) >= 3, decided


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_turned(turn: str, control: str) -> None:
    """Of waves of two lengths: the trough between two crests is shallower than that behind them."""
    kind, count = Kind("turned", waves=((1, 1.0, 0.0), (2, 0.3, 0.0)), control=control, turn=turn), 40
    rng = np.random.default_rng(40)
    lam = 10 ** rng.uniform(-1.5, -0.3, count)
    scenes: dict[str, Any] = {"k": rng.choice([0.0, 0.1, 0.5, 0.8], count), "nu": np.full(count, 0.3)}
    scenes |= {"modulus": 10 ** rng.uniform(2.5, 5.0, count), "c0_over_R": 10 ** rng.uniform(-2.0, 0.0, count)}
    scenes |= {"lambda_over_R": lam, "A": lam * 10 ** rng.uniform(-0.7, 0.7, count)}
    scenes["a_max_over_R"] = lam * rng.uniform(1.2, 2.8, count)
    scenes[turn] = 10 ** rng.uniform(-2.0, 1.5, count) if turn == LOAD else lam * 10 ** rng.uniform(-2.5, 0.0, count)
    scenes |= {"machine_stiffness": 10 ** rng.uniform(-2.0, 0.0, count)} if control == "machine" else {}
    found, decided = kind.solve(scenes, ["loading_jumps", "turning_radius", "delta_max"]), [0, 0]
    for i in range(count):
        scene = {name: float(values[i]) for name, values in scenes.items()}
        a, end = float(found["turning_radius"][i]), scene["a_max_over_R"]
        if not 0.0 < a < end or found["loading_jumps"][i] > 1:  # a later jump may be what is flagged
            continue
        curve = Curve(kind, scene)
        least = least_gap(curve, depth_without_adhesion(curve, end), a, end, float(found["delta_max"][i]))
        if abs(least) > UNDECIDED:
            flagged = bool(found["status"][i] & LOADING_NOT_ONE_DISC)
            assert flagged == (least < 0.0), (scene, least)
            decided[flagged] += 1
    assert min(decided) >= 3, decided
