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
FORCE = 1.5 * math.pi
"""The unit of forces, 1.5 pi R dgamma."""


def stiffness(k: Any, nu: Any, modulus: Any, c0_over_R: Any) -> Array:
    """M = theta E*/c0^k in dgamma/R^(1+k), equations (3.3) and (4.6); at k = 1 only nu = 1/2 has one, pi E*/c0."""
    k, nu = np.asarray(k, dtype=float), np.asarray(nu, dtype=float)
    with np.errstate(all="ignore"):
        beta = np.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
        C = 2 ** (1 + k) * gamma((3 + k + beta) / 2) * gamma((3 + k - beta) / 2) / (np.pi * gamma(2 + k))
        theta = 2 ** (1 + k) * (1 + k) * np.cos(k * np.pi / 2) * gamma(1 + k / 2)
        theta = theta / (np.sqrt(np.pi) * C * beta * np.sin(beta * np.pi / 2) * gamma((1 + k) / 2))
        result: Array = np.where(k == 1.0, np.pi, theta) * modulus / np.asarray(c0_over_R, dtype=float) ** k
    return result


def stretch(k: Any, M: Any) -> Array:
    """Delta(a)/a^((1-k)/2), section 3."""
    result: Array = np.sqrt(2 ** (1 + np.asarray(k)) * np.pi / M)
    return result


def power_factor(k: Any, m: float) -> Array:
    """depth of the punch r^m/m over a^m, corrected equation (5.5)."""
    k = np.asarray(k, dtype=float)
    result: Array = gamma(m / 2) * gamma((1 + k) / 2) / (2 * gamma((1 + k + m) / 2))
    return result


class Curve:
    """Depth, load and prescribed coordinate of one scene at radii a/R, opening or closing."""

    def __init__(self, kind: Any, scene: Mapping[str, Any], *, closing: bool = False) -> None:
        self.k, self.m, self.waves, self.control = float(scene["k"]), kind.exponent, kind.waves, kind.control
        self.A, self.wavelength = float(scene["A"]), float(scene["lambda_over_R"])
        self.M = float(stiffness(self.k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
        self.K = 2 ** (1 - self.k) * self.M / (1 + self.k)
        self.c = float(power_factor(self.k, self.m))
        self.pull = float(stretch(self.k, self.M)) * math.sqrt(scene.get("closing_ratio", 1.0) if closing else 1.0)
        self.compliance = 0.0
        if self.control == "machine":
            self.compliance = 1 / (float(scene["machine_stiffness"]) * float(scene["modulus"]))
        self.pattern, self.of = kind.pattern_waves, kind.pattern
        self.period = float(scene.get("toughness_wavelength_over_R", 1.0))
        self.height = float(scene.get("toughness_amplitude", 1.0))

    def _pair(self, z: Array, j: int) -> tuple[Array, Array]:
        """S_j and C_j, the integrals of (1-t^2)^((k-1)/2 + j) with sin z t and cos z t over [0, 1]."""
        order = self.k / 2 + j
        front = math.sqrt(math.pi) / 2 * gamma((1 + self.k) / 2 + j) * (z / 2) ** -order
        return front * struve(order, z), front * jv(order, z)

    def _waves(self, a: Array, j: int) -> Array:
        total = np.zeros_like(a)
        for n, even, odd in self.waves:
            first, second = self._pair(2 * np.pi * n * a / self.wavelength, j)
            total += n * (even * first + odd * second)
        result: Array = 2 * np.pi * self.A * a * total
        return result

    def toughness(self, a: Array) -> Array:
        """Kappa of the pattern."""
        t = np.ones_like(a)
        for n, even, odd in self.pattern:
            phase = 2 * np.pi * n * a / self.period
            t += self.height * (even * np.cos(phase) + odd * np.sin(phase))
        return np.sqrt(t) if self.of == "work" else t

    def without_adhesion(self, a: Array) -> Array:
        """delta_H."""
        return np.asarray(self.c * a**self.m + self._waves(a, 0))

    def adhesion(self, a: Array) -> Array:
        """What adhesion takes from the depth in equilibrium."""
        return np.asarray(self.pull * a ** ((1 - self.k) / 2) * self.toughness(a))

    def depth(self, a: Array) -> Array:
        """Depth in equilibrium."""
        return self.without_adhesion(a) - self.adhesion(a)

    def load_at(self, a: Array, depth: Array) -> Array:
        """The load of a contact of radius a at any depth, in 1.5 pi R dgamma."""
        share = (1 + self.k) / (1 + self.k + self.m)
        rest = share * self.c * a**self.m + self._waves(a, 1)
        return np.asarray(self.K * a ** (1 + self.k) * (depth - rest) / FORCE)

    def load(self, a: Array) -> Array:
        """The load in equilibrium, in 1.5 pi R dgamma."""
        return self.load_at(a, self.depth(a))

    def coordinate(self, a: Array) -> Array:
        """What is prescribed: depth, load, or depth + load/stiffness."""
        if self.control == "load":
            return self.load(a)
        return np.asarray(self.depth(a) + self.compliance * FORCE * self.load(a))

    def gaps(self, a: float, depth: float, radii: Array) -> Array:
        """The gap between the surfaces at radii > a, over (2/pi) cos(k pi/2), section 7; at k = 1 the integrand at r."""
        return self._integrated(a, radii, lambda s: self.without_adhesion(s) - depth)

    def edge_gap(self, a: float, pull: float, radii: Array) -> Array:
        """The same with the integrand held at its value at the edge: what the pull of the edge alone opens."""
        return self._integrated(a, radii, lambda s: np.full(s.shape, pull))

    def _integrated(self, a: float, radii: Array, height: Callable[[Array], Array]) -> Array:
        k = self.k
        if k == 1.0:
            return height(radii)
        c = 0.5 * (1 - k)  # r^2 - s^2 = (r^2 - a^2) v takes the end of the integral into the weight v^(c-1)
        places, weights = roots_jacobi(80, 0.0, c - 1)
        v, weights = 0.5 * (1 + places), weights / 2**c
        s = np.sqrt(radii[:, None] ** 2 - (radii[:, None] ** 2 - a * a) * v)
        return np.asarray(0.5 * (radii**2 - a * a) ** c * ((s ** (k - 1) * height(s)) @ weights))

    def loss(self, start: float, end: float, level: float, work: float = 1.0) -> float:
        """What a jump at constant depth loses, section 5: the integral of 2 pi a [work kappa^2 - rho^2]."""
        x, weights = np.polynomial.legendre.leggauss(400)
        low, high = min(start, end), max(start, end)
        a = low + (high - low) * (0.5 + 0.5 * x) ** 4  # the branch point at a = 0
        da = (high - low) * 2.0 * (0.5 + 0.5 * x) ** 3
        delta = float(stretch(self.k, self.M)) * a ** ((1 - self.k) / 2)
        density = work * self.toughness(a) ** 2 - ((self.without_adhesion(a) - level) / delta) ** 2
        return float(math.copysign(1.0, end - start) * np.sum(weights * da * 2 * np.pi * a * density))


def wave_size(k: Any, A: Any, wavelength: Any) -> Array:
    """r of section 6: the crest of the depth of one cosine over a^((1-k)/2); r/s is chi."""
    k = np.asarray(k, dtype=float)
    result: Array = np.pi ** ((1 - k) / 2) * gamma((1 + k) / 2) * A * np.asarray(wavelength) ** ((1 + k) / 2)
    return result

