"""The curve of one scene straight from its definitions, by SciPy's Struve and Bessel functions: nothing of a solver.

With R = dgamma = 1 and z = 2 pi a/lambda (Jin, Guo & Wan 2013, sections 3 and 4, as corrected in docs/theory.md):

    depth(a) = c a^m + 2 pi A a sum_n n [cos_n S0(n z) + sin_n C0(n z)] - sqrt(Gamma) kappa(a) Delta(a)
    load(a)  = K [a^(1+k) depth - I(a)]
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import gamma, jv, roots_jacobi, struve

Array = NDArray[np.float64]
Waves = tuple[tuple[int, float, float], ...]  # n, cos_n and sin_n of harmonics
FORCE = 1.5 * math.pi  # the unit of forces, 1.5 pi R dgamma


def stiffness(k: Any, nu: Any, modulus: Any, c0_over_R: Any) -> Array:
    """M = theta E*/c0^k in dgamma/R^(1+k), equations (3.3) and (4.6); at k = 1 only nu = 1/2 has one, pi E*/c0."""
    k, nu = np.asarray(k, dtype=float), np.asarray(nu, dtype=float)
    with np.errstate(all="ignore"):
        beta = np.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
        C = 2 ** (1 + k) * gamma((3 + k + beta) / 2) * gamma((3 + k - beta) / 2) / (np.pi * gamma(2 + k))
        theta = 2 ** (1 + k) * (1 + k) * np.cos(k * np.pi / 2) * gamma(1 + k / 2)
        theta = theta / (np.sqrt(np.pi) * C * beta * np.sin(beta * np.pi / 2) * gamma((1 + k) / 2))
        return np.asarray(np.where(k == 1.0, np.pi, theta) * modulus / np.asarray(c0_over_R, dtype=float) ** k)


def stretch(k: Any, M: Any) -> Array:
    """Delta(a)/a^((1-k)/2), section 3."""
    return np.asarray(np.sqrt(2 ** (1 + np.asarray(k)) * np.pi / M))


def jump_density(k: Any, q: Any) -> Any:
    """The energy of a jump of a smooth punch over pi a^2, section 10: q = 1 of the jump in, (1-k)/4 of that out."""
    return 16 * q * q / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1


def power_factor(k: Any, m: float) -> Array:
    """depth of the punch r^m/m over a^m, corrected equation (5.5)."""
    k = np.asarray(k, dtype=float)
    return np.asarray(gamma(m / 2) * gamma((1 + k) / 2) / (2 * gamma((1 + k + m) / 2)))


class Curve:
    """Depth, load and prescribed coordinate of one scene at radii a/R, opening or closing."""

    def __init__(self, kind: Any, scene: Mapping[str, Any], *, closing: bool = False) -> None:
        self.k, self.m, self.waves = float(scene["k"]), kind.exponent, kind.waves
        self.A, self.wavelength = float(scene["A"]), float(scene["lambda_over_R"])
        self.M = float(stiffness(self.k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
        self.K = 2 ** (1 - self.k) * self.M / (1 + self.k)
        self.c = float(power_factor(self.k, self.m))
        self.pull = float(stretch(self.k, self.M)) * math.sqrt(scene.get("closing_ratio", 1.0) if closing else 1.0)
        self.pattern, self.of = kind.pattern_waves, kind.pattern
        self.period = float(scene.get("toughness_wavelength_over_R", 1.0))
        self.height = float(scene.get("toughness_amplitude", 1.0))

    def _waves(self, a: Array, j: int) -> Array:
        """The sum of the equation; S_j and C_j are integrals of (1-t^2)^((k-1)/2 + j) with sin z t and cos z t."""
        order, total = self.k / 2 + j, np.zeros_like(a)
        for n, even, odd in self.waves:
            z = 2 * np.pi * n * a / self.wavelength
            pair = even * struve(order, z) + odd * jv(order, z)
            total += n * math.sqrt(math.pi) / 2 * gamma((1 + self.k) / 2 + j) * (z / 2) ** -order * pair
        return np.asarray(2 * np.pi * self.A * a * total)

    def without_adhesion(self, a: Array) -> Array:
        """delta_H."""
        return np.asarray(self.c * a**self.m + self._waves(a, 0))

    def adhesion(self, a: Array) -> Array:
        """What adhesion takes from the depth in equilibrium: sqrt(Gamma) kappa Delta."""
        t = np.ones_like(a)
        for n, even, odd in self.pattern:
            phase = 2 * np.pi * n * a / self.period
            t += self.height * (even * np.cos(phase) + odd * np.sin(phase))
        return np.asarray(self.pull * a ** ((1 - self.k) / 2) * (np.sqrt(t) if self.of == "work" else t))

    def depth(self, a: Array) -> Array:
        """Depth in equilibrium."""
        return self.without_adhesion(a) - self.adhesion(a)

    def load(self, a: Array) -> Array:
        """Load in equilibrium, in 1.5 pi R dgamma."""
        rest = (1 + self.k) / (1 + self.k + self.m) * self.c * a**self.m + self._waves(a, 1)
        return np.asarray(self.K * a ** (1 + self.k) * (self.depth(a) - rest) / FORCE)

    def gaps(self, a: float, radii: Array, function: Callable[[Array], Array], more: float) -> Array:
        """Gaps at radii > a over (2/pi) cos(k pi/2), section 7, where delta_H less the depth is a function and a number.

        At k = 1 the integrand at r.
        """
        if self.k == 1.0:
            return function(radii) + more
        c = 0.5 * (1 - self.k)  # r^2 - s^2 = (r^2 - a^2) v takes the end of the integral into the weight v^(c-1)
        places, weights = roots_jacobi(80, 0.0, c - 1)
        wide = radii[:, None] ** 2 - a * a
        s = np.sqrt(radii[:, None] ** 2 - 0.5 * (1 + places) * wide)
        return np.asarray(0.5 * wide[:, 0] ** c * ((s ** (self.k - 1) * (function(s) + more)) @ weights) / 2**c)


def wave_size(k: Any, A: Any, wavelength: Any) -> Array:
    """r of section 6: the crest of the depth of one cosine over a^((1-k)/2); r/s is chi."""
    k = np.asarray(k, dtype=float)
    return np.asarray(np.pi ** ((1 - k) / 2) * gamma((1 + k) / 2) * A * np.asarray(wavelength) ** ((1 + k) / 2))
