"""Is the contact that turns at a depth or a load one disc? Against the gap by quadrature, for waves of two lengths.

With K = cos(k pi/2) (2/pi) > 0

    gap(r) = K int_a^r s^k (delta_H(s) - delta) (r^2 - s^2)^(-(1+k)/2) ds,   delta_H(s) = s^(1-k) int_0^s f'(t) (s^2 - t^2)^((k-1)/2) dt
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import roots_jacobi

from gradhesion.core import FLAGS, Harmonic, Loading, Profile, solve

WAVES = ((1, 1.0), (2, 0.3))
"""Numbers and cosines of the two waves: the trough between two crests is shallower than that behind them."""
PROFILE = Profile(harmonics=tuple(Harmonic(n=n, cos=cos) for n, cos in WAVES))
SCENES = 40
UNDECIDED = 2e-3
"""Least gaps as near to 0 as this, in parts of the largest, are not decided by 400 radii."""


def smooth_depth(k: float, lam: float, A: float, s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return delta_H/R at the radii s/R; with v = (t/s)^2 the integrand is smooth but for (1 - v)^((k-1)/2)."""
    nodes, weights = roots_jacobi(64, 0.5 * (k - 1.0), 0.0)
    v, weights = 0.5 + 0.5 * nodes, weights * 0.5 ** (0.5 * (k + 1.0))
    t = s[..., None] * np.sqrt(v)
    slope = t.copy()  # f' of the paraboloid
    for n, cos in WAVES:
        slope += A * 2.0 * math.pi * n * cos * np.sin(2.0 * math.pi * n * t / lam)
    return np.asarray(s * ((slope / (2.0 * np.sqrt(v))) @ weights))


def least_gap(scene: dict[str, float], a: float, delta: float) -> float:
    """Return the least gap around a contact of radius a/R at the depth delta/R, over the largest."""
    k, lam, A, end = (scene[name] for name in ("k", "lambda_over_R", "A", "a_max_over_R"))
    nodes, weights = roots_jacobi(64, -0.5 * (1.0 + k), 0.0)
    share = 0.5 + 0.5 * nodes
    gaps = []
    for r in np.linspace(a, end, 401)[1:]:
        s = np.sqrt(a * a + (r * r - a * a) * share)
        excess = s ** (k - 1.0) * (smooth_depth(k, lam, A, s) - delta)
        gaps.append((r * r - a * a) ** (0.5 * (1.0 - k)) * float(excess @ weights))
    return float(min(gaps) / max(gaps))


def drawn() -> dict[str, Any]:
    """Draw punches of up to three wavelengths on which some contacts are one disc and some are not."""
    rng = np.random.default_rng(40)
    lam = 10 ** rng.uniform(-1.5, -0.3, SCENES)
    scenes: dict[str, Any] = {"k": rng.choice([0.0, 0.1, 0.5, 0.8], SCENES), "nu": 0.3}
    scenes |= {"modulus": 10 ** rng.uniform(2.5, 5.0, SCENES), "c0_over_R": 10 ** rng.uniform(-2.0, 0.0, SCENES)}
    scenes |= {"lambda_over_R": lam, "A": lam * 10 ** rng.uniform(-0.7, 0.7, SCENES)}
    return scenes | {"a_max_over_R": lam * rng.uniform(1.2, 2.8, SCENES)}


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("turn", ["indentation_max_over_R", "load_max"])
def test_the_flag_is_the_sign_of_the_gap(turn: str, control: str) -> None:
    scenes = drawn()
    rng = np.random.default_rng(41)
    scenes[turn] = scenes["lambda_over_R"] * 10 ** rng.uniform(-2.5, 0.0, SCENES)
    if turn == "load_max":
        scenes[turn] = 10 ** rng.uniform(-2.0, 1.5, SCENES)
    if control == "machine":
        scenes["machine_stiffness"] = 10 ** rng.uniform(-2.0, 0.0, SCENES)
    names = ["loading_jumps", "turning_radius", "delta_max"]
    found = solve(scenes, names, profile=PROFILE, loading=Loading(control=control))
    decided = [0, 0]
    for i in range(SCENES):
        scene = {name: float(np.broadcast_to(values, SCENES)[i]) for name, values in scenes.items()}
        a, depth = float(found["turning_radius"][i]), float(found["delta_max"][i])
        if not 0.0 < a < scene["a_max_over_R"] or found["loading_jumps"][i] > 1:  # a later jump may be what is flagged
            continue
        least = least_gap(scene, a, depth)
        if abs(least) < UNDECIDED:
            continue
        flagged = bool(found["status"][i] & FLAGS["loading_contact_not_one_disc"])
        assert flagged == (least < 0.0), (scene, least)
        decided[flagged] += 1
    assert min(decided) >= 3, decided
