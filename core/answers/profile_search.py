"""The power and the Fourier series that fit measured heights best: the search for exponent, period and centre.

For each of these the height, the factor of the power and the coefficients are those of linear least squares (variable
projection, Golub & Pereyra 1973). Where the period may lie follows from the spectrum of the residual of a power: the
sum of its density over the harmonics of a period. Every multiple of a period contains the same series, so that the
shortest of those that fit equally well is chosen.

A weight that falls to 0 over the last tenth keeps the edge, where the profile is cut, from ringing through the series.
"""

import math
from typing import Final

import numpy as np
from scipy.optimize import least_squares, minimize_scalar

from gradhesion.core.types import Floats

TAPER: Final = 0.1
"""The part of the radius over which the weight falls at the edge."""
EXPONENTS: Final = (1.05, 10.0)
"""Range in which the exponent is searched: at 1 the radius has no effect."""
_SEARCHED: Final = 3000
"""Most points used in the search; its result is refined on all."""
_PADDING: Final = 8
"""Samples of the spectrum for one wave over the radius."""
_CANDIDATES: Final = 40
"""Peaks of the sum over harmonics that are tried, and the periods that are refined."""
_REFINED: Final = 10
_AS_GOOD: Final = 4.0
"""Standard deviations of a sum of squares within which two periods fit as well."""
_ROUNDING: Final = 64.0 * 2.0**-52
"""Residual, in parts of the range of heights, below which it is rounding."""


class Search:
    """Points in parts of a radius and of the range of their heights, and the search for what is not linear.

    Parameters
    ----------
    places, heights
        The points, in one unit, from left to right; shape (n,).
    reach
        The radius within which they are fitted.
    terms
        Harmonics of the series.
    exponent
        m, None if it is searched.
    centre
        About where the axis is, None if it is at 0.
    """

    def __init__(
        self, places: Floats, heights: Floats, reach: float, terms: int, exponent: float | None, centre: float | None
    ) -> None:
        self.reach, self.terms, self.exponent = reach, terms, exponent
        self.lowest, self.unit = float(heights.min()), float(np.ptp(heights)) or 1.0
        self.x, self.y = places / reach, (heights - self.lowest) / self.unit
        self.centre = 0.0 if centre is None else centre / reach
        searched = {"waves": True, "exponent": exponent is None, "centre": centre is not None}
        self.names = tuple(name for name, own in searched.items() if own)
        """What is searched, in the order of the vectors: waves over the radius, m, and the place of the axis."""
        self.spacing = 1.0 / max(1, np.unique(np.abs(self.x - self.centre)).size - 1)
        self.spacing *= 1.0 if centre is None else 2.0  # flanks are no finer together than one of them

    def split(self, vector: Floats) -> tuple[float, float, float]:
        """Return m, the waves over the radius and the centre of a vector."""
        own = {"exponent": self.exponent, "centre": 0.0} | dict(zip(self.names, vector.tolist(), strict=True))
        return float(own["exponent"]), own["waves"], own["centre"]

    def design(self, vector: Floats, x: Floats) -> tuple[Floats, Floats]:
        """Return the columns of the linear part at places (n,), of shape (n, 2 + waves), and the roots of weights."""
        m, waves, centre = self.split(vector)
        rho = np.abs(x - centre)
        count = max(1, min(self.terms, int(0.5 / (self.spacing * waves))))
        turns = 2.0 * math.pi * waves * np.multiply.outer(rho, np.arange(1, count + 1))
        columns = np.column_stack([np.ones_like(rho), rho**m, 1.0 - np.cos(turns), np.sin(turns)])
        edge = np.clip((1.0 - rho) / TAPER, 0.0, 1.0)
        return columns, np.sin(0.5 * math.pi * edge)

    def best(self) -> Floats:
        """Return the vector that fits best, with the shortest of periods that fit as well."""
        step = -(-self.x.size // _SEARCHED)
        few = (self.x[::step], self.y[::step])
        m = self.exponent or self._exponent_of_power(*few)
        starts = [self._vector(waves, m) for waves in self._periods(m, *few)]
        sizes = [float(np.sum(self._projected(start, *few) ** 2)) for start in starts]
        found = [self._refined(starts[i], *few) for i in np.argsort(sizes)[:_REFINED]]
        floor = _ROUNDING**2 * self.x.size
        as_good = min(size for size, _ in found) * (1.0 + _AS_GOOD * math.sqrt(2.0 / few[0].size)) + floor
        shortest = max(one[0] for size, one in found if size <= as_good)
        _, vector = min((pair for pair in found if abs(pair[1][0] - shortest) < 0.5), key=lambda pair: pair[0])
        return self._refined(vector, self.x, self.y)[1] if step > 1 else vector

    def _vector(self, waves: float, m: float) -> Floats:
        own = {"waves": waves, "exponent": m, "centre": self.centre}
        return np.array([own[name] for name in self.names])

    def _projected(self, vector: Floats, x: Floats, y: Floats) -> Floats:
        """Return the weighted residual of the best linear part at points (n,)."""
        columns, roots = self.design(vector, x)
        q, _ = np.linalg.qr(columns * roots[:, None])
        weighted = y * roots
        left: Floats = weighted - q @ (q.T @ weighted)
        return left

    def _left_of_power(self, m: float, x: Floats, y: Floats) -> Floats:
        """Return the residual of a power alone at points (n,)."""
        rho = np.abs(x - self.centre)
        columns = np.column_stack([np.ones_like(rho), rho**m])
        left: Floats = y - columns @ np.linalg.lstsq(columns, y, rcond=None)[0]
        return left

    def _exponent_of_power(self, x: Floats, y: Floats) -> float:
        """Return the exponent of the power alone that fits points (n,) best."""

        def size(m: float) -> float:
            return float(np.sum(self._left_of_power(m, x, y) ** 2))

        grid = np.geomspace(*EXPONENTS, 30)
        i = int(np.argmin([size(m) for m in grid]))
        return float(minimize_scalar(size, bounds=(grid[max(0, i - 1)], grid[min(29, i + 1)]), method="bounded").x)

    def _periods(self, m: float, x: Floats, y: Floats) -> Floats:
        """Return waves over the radius at which the harmonics of the residual of a power are largest."""
        rho, left = np.abs(x - self.centre), self._left_of_power(m, x, y)
        order = np.argsort(rho)
        count = 1 << max(6, math.ceil(math.log2(1.0 / self.spacing)))
        even = np.interp(np.arange(count) / count, rho[order], left[order])
        density = np.abs(np.fft.rfft(even * np.hanning(count), count * _PADDING)) ** 2
        most = 0.25 / self.spacing  # four points a wave
        waves = np.arange(1.0, most, 1.0 / (_PADDING * self.terms))
        total = np.zeros_like(waves)
        for n in range(1, self.terms + 1):
            at = np.rint(n * waves * _PADDING).astype(int)
            total += np.where(n * waves <= 2.0 * most, density[np.minimum(at, density.size - 1)], 0.0)
        peaks = np.flatnonzero((total[1:-1] >= total[:-2]) & (total[1:-1] > total[2:])) + 1
        best = peaks[np.argsort(-total[peaks])][:_CANDIDATES]
        return np.unique(np.concatenate([[1.0], waves[best]]))

    def _refined(self, start: Floats, x: Floats, y: Floats) -> tuple[float, Floats]:
        """Return the least sum of squares of points (n,) near a start, and the searched numbers there."""
        fewest = max(1.0, float(start[0]) - 0.5)
        ends = {
            "waves": (fewest, fewest + 1.0),
            "exponent": EXPONENTS,
            "centre": (self.centre - 0.2, self.centre + 0.2),
        }
        scales = {"waves": 0.1 / self.terms, "exponent": 0.1, "centre": 0.01}
        low, high = np.array([ends[name] for name in self.names]).T
        done = least_squares(
            lambda vector: self._projected(vector, x, y),
            np.clip(start, low + 1e-9 * (high - low), high - 1e-9 * (high - low)),
            bounds=(low, high),
            x_scale=[scales[name] for name in self.names],
            xtol=1e-12,
            ftol=1e-12,
            gtol=1e-15,
            max_nfev=40,
        )
        return 2.0 * float(done.cost), done.x
