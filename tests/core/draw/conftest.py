"""What the tests of drawing share: scenes of every kind, the curve in slow arithmetic, and the error of chords."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import Profile
from gradhesion.core.equations import general
from gradhesion.core.problem.material import stiffness

SCENES: dict[str, dict[str, float]] = {
    "wavy": {},
    "homogeneous": {"k": 0.0},
    "half": {"k": 0.5},
    "linear": {"k": 1.0, "nu": 0.5},
    "nearly linear": {"k": 1.0 - 1e-9, "nu": 0.5},
    "smooth": {"A": 0.0},
    "unbounded": {"a_max_over_R": math.inf},
    "unbounded smooth": {"a_max_over_R": math.inf, "A": 0.0},
    "short waves": {"lambda_over_R": 7e-4},
    "one long wave": {"lambda_over_R": 3e4},
    "r > s": {"A": 0.21},
    "r > s, unbounded": {"A": 0.21, "a_max_over_R": math.inf},
    "r > s, linear": {"k": 1.0, "nu": 0.5, "A": 0.4},
    "small rim": {"a_max_over_R": 0.01},
    "smooth with a small rim": {"a_max_over_R": 0.03, "A": 0.0},
    "hardly wavy": {"A": 1e-14},
    "large rim": {"a_max_over_R": 300.0},
    "waves beyond the folds": {
        "k": 0.0164,
        "nu": -0.09,
        "modulus": 88.0,
        "c0_over_R": 0.11,
        "lambda_over_R": 0.128,
        "A": 0.167,
        "a_max_over_R": math.inf,
    },
    "waves beyond the folds, finer": {"lambda_over_R": 0.0031, "A": 0.003, "a_max_over_R": 1.9},
}


@pytest.fixture
def scene() -> dict[str, float]:
    """A scene off every round number, with several jumps both ways."""
    return {
        "k": 0.31,
        "nu": 0.27,
        "modulus": 1730.0,
        "c0_over_R": 0.037,
        "lambda_over_R": 0.043,
        "A": 0.0137,
        "a_max_over_R": 0.47,
    }


@pytest.fixture(autouse=True)
def digits() -> Any:
    """Every test starts at 30 digits."""
    with mpmath.workdps(30):
        yield


@pytest.fixture(params=SCENES, ids=str)
def any_scene(request: pytest.FixtureRequest, scene: dict[str, float]) -> dict[str, float]:
    return scene | SCENES[request.param]


def stretch_of(scene: dict[str, float]) -> float:
    """The strength of adhesion s of a scene."""
    material = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))
    return math.sqrt(2 ** (1 + scene["k"]) * math.pi / material)


def strength_of(scene: dict[str, float]) -> float:
    """The strength r of the waves of a scene."""
    k = scene["k"]
    wave = scene["lambda_over_R"] ** ((1 + k) / 2)
    return math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * scene["A"] * wave


def curve_of(scene: dict[str, float], profile: Profile | None = None) -> Callable[[Any], tuple[Any, Any]]:
    """Depth and load of equilibrium at radii, by the printed equations."""
    shape = profile or Profile()
    material = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))
    count = max(wave.n for wave in shape.harmonics)
    cosines, sines = [0.0] * count, [0.0] * count
    for wave in shape.harmonics:
        cosines[wave.n - 1], sines[wave.n - 1] = -scene["A"] * wave.cos, scene["A"] * wave.sin
    rest = (scene["lambda_over_R"], cosines, sines, shape.exponent)
    return lambda a: (general.indentation(scene["k"], material, a, *rest), general.load(scene["k"], material, a, *rest))


def sine_integral(k: Any, z: Any) -> Any:
    """S0 as a hypergeometric series; S1 is that of k + 2."""
    return z / (1 + k) * mpmath.hyp1f2(1, 1.5, (3 + k) / 2, -z * z / 4)


class SlowCurve:
    """Depth (in R), load (in 1.5 pi R dgamma) and their slopes over the contact radius, in 30 digits; (4.7), (4.8)."""

    def __init__(self, scene: dict[str, float]) -> None:
        self.k = mpmath.mpf(scene["k"])
        self.wavelength, self.amplitude = mpmath.mpf(scene["lambda_over_R"]), mpmath.mpf(scene["A"])
        self.modulus = mpmath.mpf(float(stiffness(*(scene[name] for name in ("k", "nu", "modulus", "c0_over_R")))))
        self.stretch = mpmath.sqrt(2 ** (1 + self.k) * mpmath.pi / self.modulus)
        self.front = 2 ** (1 - self.k) * self.modulus / (1 + self.k)
        self.unit = 3 * mpmath.pi / 2

    def terms(self, a: float) -> tuple[Any, ...]:
        """The paraboloid, the wave and adhesion in the depth, then the integral in the load."""
        k = self.k
        s0, s1 = (sine_integral(k + more, 2 * mpmath.pi * a / self.wavelength) for more in (0, 2))
        wave = 2 * mpmath.pi * self.amplitude * a
        integral = a ** (3 + k) / (3 + k) + wave * a ** (1 + k) * s1
        return a * a / (1 + k), wave * s0, self.stretch * a ** ((1 - k) / 2), integral

    def depth(self, a: float) -> Any:
        paraboloid, wave, pull, _ = self.terms(mpmath.mpf(a))
        return paraboloid + wave - pull

    def pinned(self, a: float, depth: float) -> Any:
        """The load at any depth of a contact that is pinned at a."""
        return self.front * (mpmath.mpf(a) ** (1 + self.k) * depth - self.terms(mpmath.mpf(a))[3]) / self.unit

    def load(self, a: float) -> Any:
        return self.pinned(a, self.depth(a))


@pytest.fixture
def slow_curve() -> Callable[[dict[str, float]], SlowCurve]:
    return SlowCurve


def chord_error(curve: Callable[[Any], tuple[Any, Any]], points: Any, joined: Any = None) -> float:
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
    if not steps.size:
        return worst
    for share in np.arange(1, 48) * 0.6180339887498949 % 1.0:
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


@pytest.fixture(scope="session")
def worst_chord() -> Callable[..., float]:
    return chord_error


@pytest.fixture(scope="session")
def equation() -> Callable[..., Callable[[Any], tuple[Any, Any]]]:
    return curve_of


@pytest.fixture(scope="session")
def strengths() -> Callable[[dict[str, float]], tuple[float, float]]:
    """Give s and r of a scene."""
    return lambda scene: (stretch_of(scene), strength_of(scene))
