"""Scenes, profiles and patterns in one line each, strengths of adhesion and waves, and formulae at many digits."""

import math
from typing import Any

import mpmath

from gradhesion.core import PARAMETERS, Harmonic, Profile
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


def exact_theta(k: Any, nu: Any) -> Any:
    """Give theta as it stands in section 2 of docs/theory.md, with the exact doubles k and nu."""
    k, nu = mpmath.mpf(k), mpmath.mpf(nu)
    beta = mpmath.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    c = 2 ** (1 + k) * mpmath.gamma((3 + k + beta) / 2) * mpmath.gamma((3 + k - beta) / 2) / mpmath.gamma(2 + k)
    c /= mpmath.pi
    front = 2 ** (1 + k) * (1 + k) * mpmath.cos(k * mpmath.pi / 2) * mpmath.gamma(1 + k / 2)
    return front / (mpmath.sqrt(mpmath.pi) * c * beta * mpmath.sin(beta * mpmath.pi / 2) * mpmath.gamma((1 + k) / 2))


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
        def rate(t: Any) -> Any:
            a = mpmath.exp(t)
            return load(pull, a) * (m * front * a**m - pull * c * a**c)

        return mpmath.quad(rate, mpmath.linspace(mpmath.log(first), mpmath.log(last), 9)) if last > first else 0

    rim, loading, unloading = mpmath.mpf(rim), s - up, s + down
    a_in = min(rim, (max(loading, mpmath.mpf(10) ** -40) / front) ** (1 / (m - c)))
    a_out = min(rim, (max(c * unloading, mpmath.mpf(10) ** -40) / (m * front)) ** (1 / (m - c)))
    drop = max(0, depth(loading, rim)) - depth(unloading, rim)
    pinned = drop * load(unloading, rim) + K * rim ** (1 + k) * drop**2 / 2
    return work(loading, a_in, rim) - pinned - work(unloading, a_out, rim)
