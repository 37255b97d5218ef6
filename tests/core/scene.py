"""Scenes, profiles and patterns in one line each, strengths of adhesion and waves, curves by printed equations, formulae at many digits."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np

from gradhesion.core import PARAMETERS, Harmonic, Profile
from gradhesion.core.equations import general
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

Scene = dict[str, Any]
Waves = tuple[tuple[int, float, float], ...]
"""Rows of a number, a cosine and a sine."""
ENDLESS = {"a_max_over_R": math.inf}
EPS = 2.0**-52


def scene_of(*values: Any, **more: Any) -> Scene:
    """The parameters of `solve`: k, nu, E*, c0, lambda, A and the rim, in this order; and others by name."""
    return dict(zip(PARAMETERS, values, strict=True)) | more


def profile_of(exponent: float, *waves: tuple[int, float, float]) -> Profile:
    return Profile(exponent=exponent, harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in waves))


def pattern_of(of: str, *waves: tuple[int, float, float]) -> Toughness:
    return Toughness(tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in waves), of)


def material_of(scene: Scene) -> float:
    """M."""
    return float(stiffness(*(scene[name] for name in PARAMETERS[:4])))


def adhesion(k: float, M: float) -> float:
    """The strength of adhesion, s."""
    return math.sqrt(2 ** (1 + k) * math.pi / M)


def waviness(k: float, wavelength: float, A: float) -> float:
    """The strength of one cosine, r."""
    return math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * A * wavelength ** ((1 + k) / 2)


def strengths_of(scene: Scene) -> tuple[float, float]:
    """The strengths s and r of a scene."""
    k = scene["k"]
    return adhesion(k, material_of(scene)), waviness(k, scene["lambda_over_R"], scene["A"])


def scene_of_ratio(k: float, M: float, wavelength: float, chi: float, a_max: float) -> Scene:
    """A scene of a stiffness M and of a ratio chi = r/s."""
    nu, c0 = 0.5 if k == 1.0 else 0.27, 0.13
    A = chi * adhesion(k, M) / waviness(k, wavelength, 1.0)
    return scene_of(k, nu, M / float(stiffness(k, nu, 1.0, c0)), c0, wavelength, A, a_max)


def envelope_loop(k: float, M: Any, m: float, up: Any, down: Any, rim: Any) -> Any:
    """Integrate P d(delta) along envelopes that are off the mean by r_+ and r_-, and along the line at the rim.

    R = dgamma = 1, depths are counted from the mean surface, and the jumps are at their fixed depth.
    """
    k, c = mpmath.mpf(k), (1 - mpmath.mpf(k)) / 2
    K, s = 2 ** (1 - k) * M / (1 + k), mpmath.sqrt(2 ** (1 + k) * mpmath.pi / M)
    front = mpmath.beta(mpmath.mpf(m) / 2, (1 + k) / 2) / 2

    def depth(pull: Any, a: Any) -> Any:
        return front * a**m - pull * a**c

    def load(pull: Any, a: Any) -> Any:
        return K * a ** (1 + k) * (m / (1 + k + m) * front * a**m - pull * a**c)

    def work(pull: Any, first: Any, last: Any) -> Any:
        def rate(a: Any) -> Any:
            return load(pull, a) * (m * front * a ** (m - 1) - pull * c * a ** (c - 1))

        return mpmath.quad(rate, mpmath.linspace(first, last, 5)) if last > first else 0

    rim, loading, unloading = mpmath.mpf(rim), s - up, s + down
    a_in = min(rim, (max(loading, mpmath.mpf(10) ** -40) / front) ** (1 / (m - c)))
    a_out = min(rim, (max(c * unloading, mpmath.mpf(10) ** -40) / (m * front)) ** (1 / (m - c)))
    drop = max(0, depth(loading, rim)) - depth(unloading, rim)
    pinned = drop * load(unloading, rim) + K * rim ** (1 + k) * drop**2 / 2
    return work(loading, a_in, rim) - pinned - work(unloading, a_out, rim)


def series_of(scene: dict[str, float], profile: Profile | None = None) -> tuple[float, list[float], list[float]]:
    waves = (profile or Profile()).harmonics
    count = max(wave.n for wave in waves)
    cosines, sines = [0.0] * count, [0.0] * count
    for wave in waves:
        cosines[wave.n - 1], sines[wave.n - 1] = -scene["A"] * wave.cos, scene["A"] * wave.sin
    return scene["lambda_over_R"], cosines, sines


def curve_of(scene: dict[str, float], profile: Profile | None = None, of: Any = general) -> Callable[[Any], Any]:
    """Depth and load at radii, by the printed equations of a module."""
    k, M, series = scene["k"], material_of(scene), series_of(scene, profile)
    power = {"exponent": (profile or Profile()).exponent}
    return lambda a: (of.indentation(k, M, a, *series, **power), of.load(k, M, a, *series, **power))


def chord_error(curve: Callable[[Any], Any], points: Any, joined: Any = None) -> float:
    """The largest distance of a curve from the chords of its points, in any plane and in spans, at 48 places a chord.

    Points are rows of radius, depth and load; `joined` tells which are reached along the curve. Of long curves every
    so many chords are looked at.
    """
    points = np.asarray(points)
    spans = np.ptp(points, axis=1)
    scales = np.divide(1.0, spans, out=np.zeros(3), where=spans > 0)
    steps = np.flatnonzero(np.ones(points.shape[1] - 1, dtype=bool) if joined is None else joined[1:])
    steps = steps[:: 1 + steps.size // 800]
    start, end = points[:, steps], points[:, steps + 1]
    worst = 0.0
    for share in np.arange(1, 48) * 0.6180339887498949 % 1.0 if steps.size else ():
        radii = start[0] + share * (end[0] - start[0])
        found = np.array([radii, *curve(radii)])
        for i, j in ((0, 1), (1, 2), (0, 2)):
            u, v = (end - start)[i] * scales[i], (end - start)[j] * scales[j]
            x, y = (found - start)[i] * scales[i], (found - start)[j] * scales[j]
            length = np.hypot(u, v)
            # the nearest point of the chord, not of its line
            along = np.clip((x * u + y * v) / np.where(length > 0, length, 1) ** 2, 0, 1)
            worst = max(worst, float(np.hypot(x - along * u, y - along * v).max()))
    return worst
