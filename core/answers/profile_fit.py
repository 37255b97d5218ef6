"""The profile of a punch from measured heights: a power and a Fourier series, by variable projection.

    h(r) = h0 + rho^m/(m R^(m-1)) + sum_n [c_n (1 - cos 2 pi n x) + s_n sin 2 pi n x],   rho = |r - r0|, x = rho/lambda

Height, factor of the power and coefficients are linear: for each exponent m, period lambda and centre r0 they are those
of linear least squares, and only these three are searched (Golub & Pereyra 1973). Where the period may lie follows from
the spectrum of the residual of a power: the sum of its density over the harmonics of a period. Every multiple of a
period contains the same series, so that the shortest of those that fit equally well is chosen.

A weight that falls to 0 over the last tenth keeps the edge, where the profile is cut, from ringing through the series.
"""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares, minimize_scalar
from threadpoolctl import threadpool_limits

from gradhesion.core.problem.profile import MOST_HARMONICS, Harmonic, Profile
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
_ALIKE: Final = 4.0
"""Standard deviations of a sum of squares within which two periods fit as well."""
_ROUNDING: Final = 64.0 * 2.0**-52
"""Residual, in parts of the range of heights, below which it is rounding."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedProfile:
    """A profile with how well it fits; lengths are in the unit of the measurement.

    Attributes
    ----------
    exponent, radius, wavelength
        m, R and lambda.
    cosines, sines
        lambda A kappa_n and lambda A sigma_n for n = 1, 2, ...: amplitudes, as lengths.
    centre, height
        r0 and h0.
    up_to
        The distance from the centre up to which it is fitted.
    errors
        The standard deviations of all these by name, as the residual implies them; 0 for what was not fitted.
    residual
        Measured less fitted height of every point within `up_to` of the centre, in the order of `distance`.
    distance
        rho of these points, ascending.
    """

    exponent: float
    radius: float
    wavelength: float
    cosines: Floats
    sines: Floats
    centre: float
    height: float
    up_to: float
    errors: dict[str, Any]
    distance: Floats
    residual: Floats

    @property
    def amplitude(self) -> float:
        """The amplitude of the largest harmonic."""
        return float(np.max(np.hypot(self.cosines, self.sines)))

    @property
    def residual_rms(self) -> float:
        """The root of the mean square of the residual."""
        return float(np.sqrt(np.mean(self.residual**2)))

    @property
    def residual_max(self) -> float:
        """The largest residual."""
        return float(np.max(np.abs(self.residual)))

    @property
    def profile(self) -> Profile:
        """The shape, its harmonics in units of the amplitude."""
        unit = self.amplitude or 1.0
        waves = (
            Harmonic(n=n, cos=float(c / unit), sin=float(s / unit))
            for n, (c, s) in enumerate(zip(self.cosines, self.sines, strict=True), start=1)
        )
        return Profile(exponent=self.exponent, harmonics=tuple(waves))

    def heights(self, distance: ArrayLike) -> Floats:
        """Return the fitted height above that of the centre at distances from it."""
        rho = np.asarray(distance, dtype=float)
        turns = 2.0 * math.pi * np.multiply.outer(rho / self.wavelength, np.arange(1, self.cosines.size + 1))
        waves = (1.0 - np.cos(turns)) @ self.cosines + np.sin(turns) @ self.sines
        return rho**self.exponent / (self.exponent * self.radius ** (self.exponent - 1.0)) + waves


def fit_profile(
    r: ArrayLike, height: ArrayLike, *, up_to: float | None = None, terms: int = 16, exponent: float | None = 2.0
) -> FittedProfile:
    """Fit a power and a Fourier series to measured heights of a punch.

    Parameters
    ----------
    r
        Places along a line through the axis, in any unit. Where some are negative, or both ends are well above the
        lowest height, it is a line over both flanks, whose centre is fitted; otherwise the axis is at 0.
    height
        Height of the punch above them, in the same unit: it grows away from the half-space.
    up_to
        The distance from the centre up to which it is fitted; all of it if not given.
    terms
        Harmonics of the series, 1 to 64. Those shorter than two spacings of the points are left out (0).
    exponent
        m > 1, or None to fit it between 1.05 and 10.

    Returns
    -------
    The profile. Its period is the shortest, of two spacings to `up_to`, that fits as well as the best. With noise of a
    standard deviation s the residual is s, and coefficients are within their errors; without, they are good to rounding
    times the condition of the fit.

    Raises
    ------
    ValueError
        For values that are not finite, too few points, a position given twice with different heights, or heights
        that do not grow with the distance; the message says what to do.

    Examples
    --------
    A paraboloid of R = 2 with a wave of 0.002 (1 - cos):

    >>> r = np.linspace(0.0, 1.0, 801)
    >>> found = fit_profile(r, r**2 / 4.0 + 0.002 * (1.0 - np.cos(2.0 * np.pi * r / 0.13)), terms=3)
    >>> round(found.radius, 9), round(found.wavelength, 9), round(float(found.cosines[0]), 9)
    (2.0, 0.13, 0.002)
    """
    places, heights = np.asarray(r, dtype=float), np.asarray(height, dtype=float)
    if not 1 <= terms <= MOST_HARMONICS:
        raise ValueError(f"terms = {terms}: a series has 1 to {MOST_HARMONICS} terms")
    if exponent is not None and not 1.0 < exponent < math.inf:
        raise ValueError(f'exponent = {exponent}: it is above 1 (a cone of any slope has exponent = "fit"), and finite')
    places, heights = _in_order(places, heights)
    both = bool(places[0] < 0.0) or _is_lowest_inside(heights)
    centre = _vertex(places, heights) if both else 0.0
    reach = float(np.max(np.abs(places - centre))) if up_to is None else float(up_to)
    inside = np.abs(places - centre) <= reach * (1.0 + 0.05 * both)  # the centre moves by less
    places, heights = places[inside], heights[inside]
    unknown = 2 + 2 * terms + 1 + (exponent is None) + both
    if places.size < max(8, 2 * unknown):
        raise ValueError(
            f"{places.size:,} points within {reach:g} of the centre are too few for {terms} terms, which take "
            f"{2 * unknown}; use fewer terms or a larger up_to"
        )
    fit = _Fit(places, heights, reach, terms, exponent, centre if both else None)
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        return fit.found()


def _in_order(places: Floats, heights: Floats) -> tuple[Floats, Floats]:
    """Return points, of shape (n,), from left to right, each place once."""
    if places.shape != heights.shape or places.ndim != 1 or not places.size:
        raise ValueError("places and heights are two lists of one length")
    if not (np.isfinite(places).all() and np.isfinite(heights).all()):
        raise ValueError("places and heights are to be finite numbers; leave the others out")
    order = np.argsort(places, kind="stable")
    places, heights = places[order], heights[order]
    again = np.flatnonzero(np.diff(places) == 0.0)
    if np.any(heights[again] != heights[again + 1]):
        at = places[again[heights[again] != heights[again + 1]][0]]
        raise ValueError(f"not a function of r: r = {at:g} stands twice with different heights; leave one of them out")
    keep = np.concatenate([[True], np.diff(places) > 0.0])
    return places[keep], heights[keep]


def _is_lowest_inside(heights: Floats) -> bool:
    """Return whether a line, of shape (n,), has two flanks: at both its ends it is well above its lowest point."""
    few = max(1, heights.size // 50)
    ends = min(float(np.median(heights[:few])), float(np.median(heights[-few:])))
    return ends - float(heights.min()) > 0.25 * float(np.ptp(heights))


def _vertex(places: Floats, heights: Floats) -> float:
    """Return the vertex of the parabola that fits points (n,) best; an end of the line if it has none within."""
    middle, half = 0.5 * (places[0] + places[-1]), 0.5 * (places[-1] - places[0]) or 1.0
    bend, slope, _ = np.polyfit((places - middle) / half, heights, 2)
    x = -0.5 * slope / bend if bend > 0.0 else (1.0 if slope < 0.0 else -1.0)
    return float(middle + half * np.clip(x, -1.0, 1.0))


class _Fit:
    """Points within a radius, in its unit, and the search for the numbers that are not linear."""

    def __init__(
        self, places: Floats, heights: Floats, reach: float, terms: int, exponent: float | None, centre: float | None
    ) -> None:
        self.reach, self.exponent, self.both = reach, exponent, centre is not None
        self.x = places / reach
        self.unit = float(np.ptp(heights)) or 1.0
        self.lowest = float(heights.min())
        self.y = (heights - self.lowest) / self.unit
        self.start_centre = 0.0 if centre is None else centre / reach
        self.spacing = 1.0 / max(1, np.unique(np.abs(self.x - self.start_centre)).size - 1)
        self.spacing *= 2.0 if self.both else 1.0  # flanks are no finer together than one of them
        self.terms = terms
        self.floor = (_ROUNDING**2) * self.x.size

    def design(self, m: float, waves: float, centre: float, x: Floats) -> tuple[Floats, Floats]:
        """Return the columns of the linear part at some points, and the roots of their weights."""
        rho = np.abs(x - centre)
        count = max(1, min(self.terms, int(0.5 / (self.spacing * waves))))
        turns = 2.0 * math.pi * waves * np.multiply.outer(rho, np.arange(1, count + 1))
        columns = np.column_stack([np.ones_like(rho), rho**m, 1.0 - np.cos(turns), np.sin(turns)])
        edge = np.clip((1.0 - rho) / TAPER, 0.0, 1.0)
        return columns, np.sin(0.5 * math.pi * edge)

    def projected(self, vector: Floats, x: Floats, y: Floats) -> Floats:
        """Return the residual of the best linear part, weighted."""
        m, waves, centre = self.split(vector)
        columns, roots = self.design(m, waves, centre, x)
        q, _ = np.linalg.qr(columns * roots[:, None])
        weighted = y * roots
        left: Floats = weighted - q @ (q.T @ weighted)
        return left

    def split(self, vector: Floats) -> tuple[float, float, float]:
        """Name the numbers that are searched."""
        rest = list(vector[1:])
        m = float(rest.pop(0)) if self.exponent is None else self.exponent
        return m, float(vector[0]), float(rest[0]) if self.both else 0.0

    def found(self) -> FittedProfile:
        """Search, refine and describe."""
        step = -(-self.x.size // _SEARCHED)
        few = (self.x[::step], self.y[::step])
        m = self.exponent or self._exponent_of_power(*few)
        starts = [self._vector(waves, m) for waves in self._periods(m, *few)]
        sizes = [float(np.sum(self.projected(start, *few) ** 2)) for start in starts]
        best = [self._refined(starts[i], *few) for i in np.argsort(sizes)[:_REFINED]]
        least = min(size for size, _ in best)
        alike = least * (1.0 + _ALIKE * math.sqrt(2.0 / few[0].size)) + self.floor
        shortest = max(one[0] for size, one in best if size <= alike)
        _, vector = min((pair for pair in best if abs(pair[1][0] - shortest) < 0.5), key=lambda pair: pair[0])
        if step > 1:
            _, vector = self._refined(vector, self.x, self.y)
        return self._described(vector)

    def _vector(self, waves: float, m: float) -> Floats:
        rest = [m] if self.exponent is None else []
        return np.array([waves, *rest, *([self.start_centre] if self.both else [])])

    def _exponent_of_power(self, x: Floats, y: Floats) -> float:
        """Return the exponent of the power alone that fits best."""
        rho = np.abs(x - self.start_centre)

        def size(m: float) -> float:
            columns = np.column_stack([np.ones_like(rho), rho**m])
            return float(np.sum((y - columns @ np.linalg.lstsq(columns, y, rcond=None)[0]) ** 2))

        grid = np.geomspace(*EXPONENTS, 30)
        i = int(np.argmin([size(m) for m in grid]))
        return float(minimize_scalar(size, bounds=(grid[max(0, i - 1)], grid[min(29, i + 1)]), method="bounded").x)

    def _periods(self, m: float, x: Floats, y: Floats) -> Floats:
        """Return waves over the radius at which the harmonics of the residual of a power are largest."""
        rho = np.abs(x - self.start_centre)
        order = np.argsort(rho)
        columns = np.column_stack([np.ones_like(rho), rho**m])
        left = y - columns @ np.linalg.lstsq(columns, y, rcond=None)[0]
        count = 1 << max(6, math.ceil(math.log2(1.0 / self.spacing)))
        even = np.interp(np.arange(count) / count, rho[order], left[order])
        density = np.abs(np.fft.rfft(even * np.hanning(count), count * _PADDING)) ** 2
        most = 0.25 / self.spacing  # four points a wave
        waves = np.arange(1.0, most, 1.0 / (_PADDING * self.terms))
        if waves.size < 3:
            return np.array([1.0])
        total = np.zeros_like(waves)
        for n in range(1, self.terms + 1):
            at = np.rint(n * waves * _PADDING).astype(int)
            total += np.where(n * waves <= 2.0 * most, density[np.minimum(at, density.size - 1)], 0.0)
        peaks = np.flatnonzero((total[1:-1] >= total[:-2]) & (total[1:-1] > total[2:])) + 1
        best = peaks[np.argsort(-total[peaks])][:_CANDIDATES]
        return np.unique(np.concatenate([[1.0], waves[best]]))

    def _refined(self, start: Floats, x: Floats, y: Floats) -> tuple[float, Floats]:
        """Return the least sum of squares near a start, and the searched numbers there."""
        low, high = start.copy(), start.copy()
        low[0], high[0] = max(1.0, start[0] - 0.5), max(1.0, start[0] - 0.5) + 1.0
        if self.exponent is None:
            low[1], high[1] = EXPONENTS
        if self.both:
            low[-1], high[-1] = self.start_centre - 0.2, self.start_centre + 0.2
        inner = np.clip(start, low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        done = least_squares(
            lambda vector: self.projected(vector, x, y),
            inner,
            bounds=(low, high),
            x_scale=[0.1 / self.terms, *([0.1] if self.exponent is None else []), *([0.01] if self.both else [])],
            xtol=1e-12,
            ftol=1e-12,
            gtol=1e-15,
            max_nfev=40,
        )
        return 2.0 * float(done.cost), done.x

    def _described(self, vector: Floats) -> FittedProfile:
        """Describe the fit in the units of the measurement, with the errors that its residual implies."""
        m, waves, centre = self.split(vector)
        columns, roots = self.design(m, waves, centre, self.x)
        found = np.linalg.lstsq(columns * roots[:, None], self.y * roots, rcond=None)[0]
        linear = np.asarray(found, dtype=np.float64)
        if not linear[1] > 0.0:
            raise ValueError(
                "the height does not grow with the distance from the centre; it is to grow away from the half-space, "
                "so reverse its sign, or name another part of the profile with up_to"
            )
        count = (columns.shape[1] - 2) // 2
        rho = np.abs(self.x - centre)
        left = (self.y - columns @ linear) * self.unit
        order = np.argsort(rho)
        inside = order[rho[order] <= 1.0]
        bends = [self._slope(linear, vector, i) for i in range(vector.size)]
        jacobian = np.column_stack([columns, *bends]) * roots[:, None]
        weight = float(np.sum(roots**2)) - jacobian.shape[1]
        variance = float(np.sum((left * roots) ** 2)) / max(1.0, weight) / self.unit**2
        inverse = np.linalg.pinv(jacobian)
        spread = np.sqrt(variance * np.sum((inverse * roots) ** 2, axis=1))
        pad = self.terms - count
        factor = linear[1] * self.unit / self.reach**m  # 1/(m R^(m-1))
        names = ["wavelength", *(["exponent"] if self.exponent is None else []), *(["centre"] if self.both else [])]
        searched = dict(zip(names, spread[2 + 2 * count :].tolist(), strict=True))
        radius = (m * factor) ** (-1.0 / (m - 1.0))
        both = inverse[[1, 2 + 2 * count + 1]] if self.exponent is None else inverse[[1]]
        return FittedProfile(
            exponent=m,
            radius=float(radius),
            wavelength=self.reach / waves,
            up_to=self.reach,
            cosines=np.pad(linear[2 : 2 + count], (0, pad)) * self.unit,
            sines=np.pad(linear[2 + count :], (0, pad)) * self.unit,
            centre=centre * self.reach,
            height=float(linear[0]) * self.unit + self.lowest,
            errors={
                "exponent": searched.get("exponent", 0.0),
                "radius": self._error_of_radius(m, factor, linear[1], both * roots, variance),
                "wavelength": searched["wavelength"] * self.reach / waves**2,
                "cosines": np.pad(spread[2 : 2 + count], (0, pad)) * self.unit,
                "sines": np.pad(spread[2 + count : 2 + 2 * count], (0, pad)) * self.unit,
                "centre": searched.get("centre", 0.0) * self.reach,
                "height": spread[0] * self.unit,
            },
            distance=rho[inside] * self.reach,
            residual=left[inside],
        )

    def _error_of_radius(self, m: float, factor: float, own: float, rows: Floats, variance: float) -> float:
        """Return the standard deviation of R = (m g)^(-1/(m-1)); the relative error of g is that of `own`."""
        gradient = [-1.0 / ((m - 1.0) * own)]
        if rows.shape[0] > 1:
            logarithm = math.log(m * factor)
            gradient.append(logarithm / (m - 1.0) ** 2 - (1.0 / m - math.log(self.reach)) / (m - 1.0))
        radius = (m * factor) ** (-1.0 / (m - 1.0))
        covariance = variance * rows @ rows.T
        return float(radius * math.sqrt(np.array(gradient) @ covariance @ np.array(gradient)))

    def _slope(self, linear: Floats, vector: Floats, i: int) -> Floats:
        """Return the derivative of the heights by one of the searched numbers, by a central difference."""

        def model(where: Floats) -> Floats:
            heights: Floats = self.design(*self.split(where), self.x)[0] @ linear
            return heights

        step = np.zeros_like(vector)
        step[i] = 1e-6 * max(1.0, abs(vector[i]))
        slope: Floats = (model(vector + step) - model(vector - step)) / (2.0 * step[i])
        return slope
