"""A slow truth about the contact of any profile: depths by Gauss-Jacobi quadrature of the slope, and the gap of them."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar
from scipy.special import beta as euler_beta
from scipy.special import roots_jacobi

Array = NDArray[np.float64]
_GRID = 300
"""Radii a shortest wave: the splines through them leave 1e-8 of a wave."""


@lru_cache
def _rule(nodes: int, weight: float) -> tuple[Array, Array]:
    """Gauss's rule on [0, 1] with the weight v^weight, as an average."""
    places, weights = roots_jacobi(nodes, 0.0, weight)
    return 0.5 * (1.0 + places), weights / weights.sum()


class Truth:
    """A curve B, m, g, alpha, beta of curve/general.py up to a rim x, in its units: no table, no series, no theorem."""

    def __init__(self, k: float, curve: tuple[float, ...], rows: Array, rim: float) -> None:
        self.k, self.c, self.rows = k, 0.5 * (1.0 - k), rows
        self.B, self.m, self.g, self.alpha, self.beta = curve
        self.highest = float(rows[:, 0].max()) if rows.size else 1.0
        self.end = 2 * math.pi * rim
        count = int(_GRID * rim * self.highest) + 50
        # denser towards zero contact, where stretch and power have a branch point
        grid = self.end * np.linspace(0.0, 1.0, count) ** 1.5
        first, second = self._waves(grid, 0), self._waves(grid, 1)
        self._hertz, self._moment = CubicSpline(grid, first), CubicSpline(grid, second)
        self.z = grid[1:]

    def _waves(self, z: Array, j: int) -> Array:
        """z int_0^1 f'(z t) (1-t^2)^((k-1)/2 + j) dt of the waves."""
        power = 0.5 * (self.k - 1.0) + j
        v, weights = _rule(80, power)
        t = 1.0 - v
        smooth = (1.0 + t) ** power * weights / (1.0 + power)
        y = z[:, None] * t
        slope = np.zeros_like(y)
        for n, even, odd in self.rows:
            slope += n * (even * np.sin(n * y) + odd * np.cos(n * y))
        values: Array = self.g * z * (slope @ smooth)
        return values

    def hertz(self, z: Array) -> Array:
        values: Array = self.B * z**self.m + self._hertz(z)
        return values

    def depth(self, z: Array) -> Array:
        values: Array = self.hertz(z) - z**self.c
        return values

    def load(self, z: Array) -> Array:
        """P = K [a^(1+k) delta - I]."""
        share = (1.0 + self.k) / (1.0 + self.k + self.m)
        values: Array = z ** (1.0 + self.k) * (self.depth(z) - share * self.B * z**self.m - self._moment(z))
        return values

    def coordinate(self, z: Array) -> Array:
        values: Array = self.alpha * self.depth(z) + self.beta * self.load(z)
        return values

    def profile(self, z: Array) -> Array:
        front = 0.5 * float(euler_beta(0.5 * self.m, 0.5 * (1.0 + self.k)))
        values = self.B * z**self.m / (self.m * front)
        for n, even, odd in self.rows:
            values = values + self.g * (even * (1.0 - np.cos(n * z)) + odd * np.sin(n * z))
        return values

    def openings(self, z: float, radii: Array) -> Array:
        """The gap at some radii around the contact z in equilibrium, over that of its edge alone."""
        level = float(self.depth(np.array([z]))[0])
        if self.c == 0.0:
            return self.hertz(radii) - level
        v, weights = _rule(100, self.c - 1.0)
        s = np.sqrt(radii[:, None] ** 2 - (radii[:, None] ** 2 - z * z) * v)
        values: Array = ((self.hertz(s) - level) * (z / s * z / s) ** self.c) @ weights / z**self.c
        return values

    def least(self, *, unloading: bool) -> float:
        """The least opening at all radii up to the rim, over states of the path, those before jumps among them."""
        z, Y = self.z, self.coordinate(self.z)
        if unloading:
            visited = np.minimum.accumulate(Y[::-1])[::-1] >= Y
        else:
            visited = np.maximum.accumulate(np.maximum(Y, 0.0)) <= Y
        index = np.flatnonzero(visited)
        states = [float(z[i]) for i in index[:: max(1, index.size // 8)]]
        sign = 1.0 if unloading else -1.0
        step = -1 if unloading else 1
        for i in index:  # the highest or lowest place between two of the grid
            if 0 < i < z.size - 1 and not visited[i + step]:
                found = minimize_scalar(
                    lambda place: sign * float(self.coordinate(np.array([place]))[0]),
                    bounds=(z[i - 1], z[i + 1]),
                    method="bounded",
                    options={"xatol": 1e-10},
                )
                states.append(float(found.x))
        least = 1.0
        for place in states:
            radii = np.append(np.arange(place * 1.0005, self.end, 2 * math.pi / 45 / self.highest), self.end)
            radii = radii[radii > place]
            if radii.size:
                least = min(least, float(self.openings(place, radii).min()))
        return least
