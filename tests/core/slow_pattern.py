"""Cycles of a punch whose toughness varies with the radius, slowly, from the integrals of the theory and a grid of radii.

It shares no line with the package: Struve functions are SciPy's, loading is the running maximum and unloading the
running minimum of what is prescribed on a fine grid, jumps are where they leave the curve, and their ends and energies
are found by bisection and by quadrature there. R = dgamma = 1.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import mpmath
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar
from scipy.special import gamma, jv, struve


def _struve(order: float, z: Any) -> Any:
    """SciPy's, and mpmath's where that is not a number."""
    value = np.array(struve(order, z))
    for i in np.argwhere(np.isnan(value)):
        place = tuple(i)
        value[place] = float(mpmath.struveh(order, np.asarray(z)[place]))
    return value


@dataclass
class SlowScene:
    """A scene; `waves` and `pattern` are rows (n, cos, sin), `spring` is S in dgamma, inf and 0 for depth and load."""

    k: float
    nu: float
    modulus: float
    c0: float
    wavelength: float
    amplitude: float
    pattern: Any
    pattern_wavelength: float
    of: str = "toughness"
    exponent: float = 2.0
    waves: Any = ((1.0, 1.0, 0.0),)
    spring: float = math.inf
    points: int = 400_000

    def __post_init__(self) -> None:
        """Find M and K."""
        k, nu = self.k, self.nu
        b = math.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
        C = 2 ** (1 + k) * gamma((3 + k + b) / 2) * gamma((3 + k - b) / 2) / (math.pi * gamma(2 + k))
        theta = math.pi
        if k < 1.0:
            theta = 2 ** (1 + k) * (1 + k) * math.cos(k * math.pi / 2) * gamma(1 + k / 2)
            theta /= math.sqrt(math.pi) * C * b * math.sin(b * math.pi / 2) * gamma((1 + k) / 2)
        self.M = theta * self.modulus / self.c0**k
        self.K = 2 ** (1 - k) * self.M / (1 + k)

    def kappa(self, a: Any) -> Any:
        """Toughness over its mean."""
        t = 1.0 + 0.0 * a
        for n, even, odd in self.pattern:
            phase = 2 * math.pi * n * a / self.pattern_wavelength
            t = t + even * np.cos(phase) + odd * np.sin(phase)
        return np.sqrt(t) if self.of == "work" else t

    def delta(self, a: Any) -> Any:
        """(3.10)."""
        return np.sqrt(2 ** (1 + self.k) * math.pi * a ** (1 - self.k) / self.M)

    def pair(self, a: Any) -> tuple[Any, Any]:
        """Depth and load of the punch without adhesion, (3.9)."""
        k, m, R = self.k, self.exponent, 1.0
        depth = gamma(m / 2) * gamma((1 + k) / 2) / (2 * gamma((1 + k + m) / 2)) * a**m / R ** (m - 1)
        rest = gamma(m / 2) * gamma((3 + k) / 2) / (2 * gamma((3 + k + m) / 2)) * a ** (1 + k + m) / R ** (m - 1)
        for n, even, odd in self.waves if self.amplitude else ():
            z = 2 * math.pi * n * a / self.wavelength
            first = math.sqrt(math.pi) / 2 * gamma((1 + k) / 2) * (z / 2) ** (-k / 2)
            second = math.sqrt(math.pi) / 2 * gamma((3 + k) / 2) * (z / 2) ** (-1 - k / 2)
            front = 2 * math.pi * self.amplitude * a * n
            depth = depth + front * first * (even * _struve(k / 2, z) + odd * jv(k / 2, z))
            rest = rest + front * a ** (1 + k) * second * (even * _struve(1 + k / 2, z) + odd * jv(1 + k / 2, z))
        return depth, self.K * (a ** (1 + k) * depth - rest)

    def state(self, a: Any) -> tuple[Any, Any]:
        """Depth and load."""
        depth, load = self.pair(a)
        pull = self.kappa(a) * self.delta(a)
        return depth - pull, load - self.K * a ** (1 + self.k) * pull

    def prescribed(self, a: Any) -> Any:
        """Y."""
        depth, load = self.state(a)
        return load if self.spring == 0.0 else depth + load / self.spring

    def loss(self, start: float, end: float, level: float) -> float:
        """Of a jump, by quadrature."""

        def integrand(a: float) -> float:
            depth, load = self.pair(a)
            front = self.K * a ** (1 + self.k)
            x = (load - level) / front
            if self.spring > 0.0:
                x = (depth + load / self.spring - level) / (1 + front / self.spring)
            return float(2 * math.pi * a * (self.kappa(a) ** 2 - (x / self.delta(a)) ** 2))

        low, high = min(start, end), max(start, end)
        wave = min(
            self.pattern_wavelength / max(n for n, _, _ in self.pattern), self.wavelength if self.amplitude else 9.0
        )
        ends = np.linspace(low, high, 2 + math.ceil((high - low) / wave))
        total = 0.0
        for left, right in pairwise(ends):
            if left == 0.0:  # powers of the radius
                total += quad(
                    lambda t, r=right: 7 * r * t**6 * integrand(r * t**7), 0, 1, epsabs=0, epsrel=1e-13, limit=500
                )[0]
            else:
                total += quad(integrand, left, right, epsabs=1e-16, epsrel=1e-13, limit=500)[0]
        return total if end > start else -total

    def _crossing(self, level: float, low: float, high: float) -> float:
        if not (float(self.prescribed(low)) - level) * (float(self.prescribed(high)) - level) < 0.0:
            return low if abs(float(self.prescribed(low)) - level) < abs(float(self.prescribed(high)) - level) else high
        return float(brentq(lambda a: float(self.prescribed(a)) - level, low, high, xtol=1e-15, rtol=1e-14))

    def _extremum(self, grid: Any, i: int) -> float:
        """Radius of a maximum or a minimum of Y beside grid[i], where differences of the fourth order vanish."""
        low, high = float(grid[max(i - 1, 0)]), float(grid[min(i + 1, grid.size - 1)])
        step = 0.2 * (high - low)

        def slope(a: float) -> float:
            return float(self.prescribed(a + np.array([-2, -1, 1, 2]) * step) @ [1, -8, 8, -1])

        if slope(low) * slope(high) < 0.0:
            return float(brentq(slope, low, high, xtol=1e-15, rtol=1e-14))
        return float(grid[i])

    def grid(self, rim: float) -> Any:
        """Radii, dense towards zero as well."""
        inner = np.geomspace(1e-9 * rim, 1e-3 * rim, self.points // 10, endpoint=False)
        return np.concatenate([inner, np.linspace(1e-3 * rim, rim, self.points)])

    def turning(self, target: float, by_load: bool, search: float) -> float:
        """Where loading first reaches a depth or a load: by the running maximum."""
        grid = self.grid(search)
        Y = self.prescribed(grid)
        top = np.maximum.accumulate(np.maximum(Y, 0.0))
        depth, load = self.state(grid)
        on = (top <= Y) & (Y > 0.0)
        measured = load if by_load else depth
        if not np.any(on & (measured >= target)):
            return search
        i, which = int(np.argmax(on & (measured >= target))), 1 if by_load else 0
        low = grid[i - 1]
        if not on[i - 1]:  # within a jump
            level = 0.0
            if top[i - 1] > 0.0:
                level = float(self.prescribed(self._extremum(grid, int(np.argmax(top[i - 1] <= Y)))))
            low = self._crossing(level, grid[i - 1], grid[i])
            if float(self.state(low)[which]) >= target - 1e-12 * abs(target):
                return float(low)
        return float(brentq(lambda a: float(self.state(a)[which]) - target, low, grid[i], xtol=1e-15, rtol=1e-14))

    def cycle(self, rim: float) -> dict[str, float]:
        """All results of a cycle up to a rim."""
        grid = self.grid(rim)
        Y = self.prescribed(grid)
        loaded, jumps, left, level, i = 0.0, 0, 0.0, 0.0, 0
        highest = 0.0
        while True:  # outwards: from a fold, or zero contact, to the next radius where Y is above
            above = np.nonzero(Y[i:] > level)[0]
            reached = i + int(above[0]) if above.size else grid.size - 1
            end = self._crossing(level, grid[max(reached - 1, 0)], grid[reached]) if above.size else rim
            loaded += self.loss(left, end, level)
            jumps += 1
            if not above.size:
                break
            falls = np.nonzero(np.diff(Y[reached:]) < 0)[0]
            if not falls.size:
                highest = max(highest, float(Y[-1]))
                break
            i = reached + int(falls[0])
            left = self._extremum(grid, i)
            level = float(self.prescribed(left))
            highest = max(highest, level)
            i += 1
        unloaded, jumps_back, i, left, level = 0.0, 0, grid.size - 1, rim, float(Y[-1])
        if Y[-2] < Y[-1]:
            rises = np.nonzero(np.diff(Y) < 0)[0]
            i = int(rises[-1]) + 1 if rises.size else 0
            left = self._extremum(grid, i)
            level = float(self.prescribed(left))
        last = left
        while i > 0:
            below = np.nonzero(Y[:i] < level)[0]
            reached = int(below[-1]) if below.size else -1
            end = self._crossing(level, grid[reached], grid[reached + 1]) if below.size else 0.0
            jumps_back += 1
            last = left
            if end == 0.0:
                unloaded += 0.0 if self.spring == 0.0 else self.loss(left, 0.0, level)
                break
            unloaded += self.loss(left, end, level)
            drops = np.nonzero(np.diff(Y[: reached + 1]) < 0)[0]
            if not drops.size:
                last = 0.0
                break
            i = int(drops[-1]) + 1
            left = self._extremum(grid, i)
            level = float(self.prescribed(left))
        load = self.state(grid)[1]
        i = int(np.argmin(load))
        found = minimize_scalar(
            lambda a: float(self.state(a)[1]),
            bounds=(grid[max(0, i - 1)], grid[min(i + 1, grid.size - 1)]),
            method="bounded",
            options={"xatol": 1e-12 * rim},
        )
        lowest, place = min((float(load[i]), float(grid[i])), (float(found.fun), float(found.x)))
        depth, _ = self.state(rim)
        at_rim = float(Y[-1])
        front = self.K * rim ** (1 + self.k)
        rise = max(highest, 0.0) - at_rim
        share = 1 / front if self.spring == 0.0 else 1 / (1 + front / self.spring)
        return {
            "pull_off_force": -lowest / (1.5 * math.pi),
            "pull_off_radius": place,
            "dissipated_energy": loaded + unloaded,
            "loading_jumps": jumps,
            "unloading_jumps": jumps_back,
            "delta_max": float(depth) + max(0.0, rise) * share,
            "delta_jump_out": float(self.state(last)[0])
            if last > 0.0
            else (-float(self.kappa(0.0) * self.delta(0.0)) if self.k == 1.0 else 0.0),
            "loading_energy": loaded,
            "unloading_energy": unloaded,
        }
