"""The profile of a punch from measured heights: a power and a Fourier series that fit them best.

    h(r) = h0 + rho^m/(m R^(m-1)) + sum_n [c_n (1 - cos 2 pi n x) + s_n sin 2 pi n x],   rho = |r - r0|, x = rho/lambda

Three numbers are searched: the waves over the radius, m, and the place of the axis. For each choice of them the height,
the factor of the power and the coefficients are those of linear least squares (variable projection, Golub & Pereyra
1973). Where the period may lie follows from the spectrum of the residual of a power: the sum of its density over the
harmonics of a period. Every multiple of a period contains the same series, so that the shortest of those that fit
equally well is chosen.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.linalg import lstsq, norm, pinv, qr
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares, minimize_scalar
from threadpoolctl import threadpool_limits

from gradhesion.core.problem.profile import MOST_HARMONICS, Harmonic, Profile
from gradhesion.core.types import Floats, Truths

_FEWEST: Final = 8  # points that show where the axis is, at least
_TAPER: Final = 0.1  # part of the radius over which weights fall to 0: a sharp edge would ring through the series
_EXPONENTS: Final = (1.05, 10.0)  # range in which the exponent is searched: at 1 the radius has no effect
_SEARCHED: Final = 3000  # most points used in the search; its result is refined on all
_PADDING: Final = 8  # samples of the spectrum for one wave over the radius
_CANDIDATES: Final = 40  # peaks of the sum over harmonics that are tried
_REFINED: Final = 10  # of these those that are refined
_AS_GOOD: Final = 4.0  # standard deviations of a sum of squares within which two periods fit as well
_ROUNDING: Final = 64.0 * 2.0**-52  # residual, in parts of the range of heights, below which it is rounding


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedProfile:
    """A profile with how well it fits; lengths are in the unit of the measurement."""

    exponent: float
    radius: float
    wavelength: float
    """m, R and lambda."""
    cosines: Floats
    sines: Floats
    """lambda A kappa_n and lambda A sigma_n for n = 1, 2, ...: amplitudes, as lengths."""
    centre: float
    height: float
    """r0 and h0."""
    up_to: float
    """The distance from the centre up to which it is fitted."""
    errors: dict[str, Any]
    """The standard deviations of all these by name, as the residual implies them; 0 for what was not fitted."""
    distance: Floats
    """rho of every point within `up_to` of the centre, ascending."""
    residual: Floats
    """Measured less fitted height of these points."""

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
        pairs = enumerate(zip((self.cosines / unit).tolist(), (self.sines / unit).tolist(), strict=True), start=1)
        return Profile(exponent=self.exponent, harmonics=tuple(Harmonic(n=n, cos=c, sin=s) for n, (c, s) in pairs))

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

    r           finite places along a line through the axis, in any unit and order; where some are negative, or both
                ends are well above the lowest height, it is a line over both flanks, whose centre is fitted; otherwise
                the axis is at 0, and the first place within half of the last one of it
    height      of the punch above them, in the same unit: it grows away from the half-space
    up_to       the distance from the centre up to which it is fitted; all of it if not given
    terms       harmonics of the series, 1 to 64; those shorter than two spacings of the points are left out (0)
    exponent    m > 1, or None to fit it between 1.05 and 10

    The period is the shortest, of two spacings to `up_to`, that fits as well as the best. Coefficients are within their
    errors; without noise, they are good to rounding times the condition of the fit. Too few points, none near the axis,
    or heights that do not grow with the distance are a ValueError.

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
    order = np.argsort(places, kind="stable")
    places, heights = places[order], heights[order]
    centre, both = _axis(places, heights) if places.size >= _FEWEST else (0.0, False)
    reach = float(np.max(np.abs(places - centre))) if up_to is None else float(up_to)
    inside = np.abs(places - centre) <= reach * (1.0 + 0.05 * both)  # the centre moves by less
    places, heights = places[inside], heights[inside]
    needed = 2 * (2 + 2 * terms + 1 + (exponent is None) + both)
    if places.size < needed:
        raise ValueError(
            f"{places.size:,} points within {reach:g} of the centre are too few for {terms} terms, which take "
            f"{needed}; use fewer terms or a larger up_to"
        )
    if not both and places[0] > 0.5 * reach:
        raise ValueError(f"no heights within {places[0]:g} of the axis, at r = 0; shift r to be the distance from it")
    lowest, unit = float(heights.min()), float(np.ptp(heights)) or 1.0
    # flanks are no finer together than one of them
    spacing = (1.0 + both) / max(1, np.unique(np.abs(places / reach - centre / reach)).size - 1)
    free = np.array([True, exponent is None, both])
    points = _Points(x=places / reach, y=(heights - lowest) / unit, terms=terms, spacing=spacing, free=free)
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        return _described(points, points.best(exponent, centre / reach), reach, lowest, unit)


def _axis(places: Floats, heights: Floats) -> tuple[float, bool]:
    """Return where the axis is, and whether points (n,), from left to right, are those of both flanks.

    They are if they begin left of 0, or are well above their lowest one at both ends; the axis is next to the vertex of
    a parabola then.
    """
    middle, half = 0.5 * (places[0] + places[-1]), 0.5 * (places[-1] - places[0]) or 1.0
    bend, slope, _ = np.polyfit((places - middle) / half, heights, 2)
    few = max(1, heights.size // 50)
    ends = min(float(np.median(heights[:few])), float(np.median(heights[-few:])))
    rises = ends - float(heights.min()) > 0.25 * float(np.ptp(heights))
    if not (bend > 0.0 and (places[0] < 0.0 or (rises and abs(slope) < 2.0 * bend))):
        return 0.0, False
    return float(middle + half * np.clip(-0.5 * slope / bend, -1.0, 1.0)), True


@dataclass(frozen=True, kw_only=True, eq=False)
class _Points:
    """Points in parts of the radius and of the range of their heights, and the search for what is not linear.

    The numbers that are searched are the waves over the radius, m, and the centre, if they are `free`.
    """

    x: Floats
    y: Floats
    terms: int
    spacing: float
    free: Truths

    def design(self, numbers: Floats) -> tuple[Floats, Floats]:
        """Return the columns of the linear part, of shape (n, 2 + waves), and the roots of the weights."""
        waves, m, centre = numbers
        rho = np.abs(self.x - centre)
        count = max(1, min(self.terms, int(0.5 / (self.spacing * waves))))
        turns = 2.0 * math.pi * waves * np.multiply.outer(rho, np.arange(1, count + 1))
        columns = np.column_stack([np.ones_like(rho), rho**m, 1.0 - np.cos(turns), np.sin(turns)])
        return columns, np.sin(0.5 * math.pi * np.clip((1.0 - rho) / _TAPER, 0.0, 1.0))

    def projected(self, numbers: Floats) -> Floats:
        """Return the weighted residual of the best linear part."""
        columns, roots = self.design(numbers)
        q, _ = qr(columns * roots[:, None])
        weighted = self.y * roots
        return np.asarray(weighted - q @ (q.T @ weighted))

    def best(self, exponent: float | None, centre: float) -> Floats:
        """Return the numbers that fit best, with the shortest of periods that fit as well."""
        step = -(-self.x.size // _SEARCHED)
        few = replace(self, x=self.x[::step], y=self.y[::step])
        rho = np.abs(few.x - centre)
        m = exponent or float(minimize_scalar(lambda m: norm(_left_of_power(m, rho, few.y)), bounds=_EXPONENTS).x)
        starts = [np.array([waves, m, centre]) for waves in few.periods(rho, _left_of_power(m, rho, few.y))]
        nearest = sorted(starts, key=lambda start: norm(few.projected(start)))[:_REFINED]
        found = [few.refined(start) for start in nearest]
        floor = _ROUNDING**2 * self.x.size
        as_good = min(size for size, _ in found) * (1.0 + _AS_GOOD * math.sqrt(2.0 / few.x.size)) + floor
        shortest = max(numbers[0] for size, numbers in found if size <= as_good)
        _, numbers = min((one for one in found if abs(one[1][0] - shortest) < 0.5), key=lambda one: one[0])
        return self.refined(numbers)[1] if step > 1 else numbers

    def periods(self, rho: Floats, left: Floats) -> Floats:
        """Return waves over the radius at which the harmonics of the residual of a power, (n,), are largest."""
        count = 1 << max(6, math.ceil(math.log2(1.0 / self.spacing)))
        even = np.interp(np.arange(count) / count, np.sort(rho), left[np.argsort(rho)])
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

    def refined(self, start: Floats) -> tuple[float, Floats]:
        """Return the least sum of squares near a start, and the numbers there."""
        numbers, fewest = start.copy(), max(1.0, float(start[0]) - 0.5)
        low = np.array([fewest, _EXPONENTS[0], start[2] - 0.2])[self.free]
        high = np.array([fewest + 1.0, _EXPONENTS[1], start[2] + 0.2])[self.free]

        def residual(searched: Floats) -> Floats:
            numbers[self.free] = searched
            return self.projected(numbers)

        margin, scale = 1e-9 * (high - low), np.array([0.1 / self.terms, 0.1, 0.01])[self.free]
        begun = np.clip(start[self.free], low + margin, high - margin)
        done = least_squares(
            residual, begun, bounds=(low, high), x_scale=scale, xtol=1e-12, ftol=1e-12, gtol=1e-15, max_nfev=40
        )
        numbers[self.free] = done.x
        return 2.0 * float(done.cost), numbers


def _left_of_power(m: float, rho: Floats, y: Floats) -> Floats:
    """Return the residual of a power alone at points (n,)."""
    power = rho**m
    return np.asarray(y - np.polyval(np.polyfit(power, y, 1), power))


def _described(points: _Points, numbers: Floats, reach: float, lowest: float, unit: float) -> FittedProfile:
    """Describe a fit in the units of the measurement, with the errors that its residual implies."""
    columns, roots = points.design(numbers)
    linear = lstsq(columns * roots[:, None], points.y * roots, rcond=None)[0]
    if not linear[1] > 0.0:
        raise ValueError(
            "the height does not grow with the distance from the centre; it is to grow away from the half-space, so "
            "reverse its sign, or name another part of the profile with up_to"
        )
    waves, m, centre = numbers.tolist()
    rho, left = np.abs(points.x - centre), (points.y - columns @ linear) * unit
    inside = np.argsort(rho)[: np.count_nonzero(rho <= 1.0)]

    def named(height: float, amplitudes: NDArray[Any]) -> dict[str, Any]:
        """Return the linear part by name, in the unit of heights; harmonics that are left out are 0."""
        cosines, sines = np.pad(amplitudes.reshape(2, -1), ((0, 0), (0, points.terms - amplitudes.size // 2))) * unit
        return {"height": float(height) * unit, "cosines": cosines, "sines": sines}

    radius = reach * float(linear[1] * m * unit / reach) ** (-1.0 / (m - 1.0))
    found = {"radius": radius, "wavelength": reach / waves, "exponent": m, "centre": centre * reach}
    found |= named(linear[0] + lowest / unit, linear[2:])
    fit = FittedProfile(**found, errors={}, up_to=reach, distance=rho[inside] * reach, residual=left[inside])

    def slope_to(name: str) -> Floats:
        """Return the derivative of the fitted heights, by central differences."""
        step = 1e-6 * (reach if name == "centre" else found[name])
        ahead, behind = (replace(fit, **{name: found[name] + way}) for way in (step, -step))
        steps = [one.heights(np.abs(points.x * reach - one.centre)) for one in (ahead, behind)]
        return np.asarray(steps[0] - steps[1]) / (2.0 * step * unit)

    names = [name for name, free in zip(("wavelength", "exponent", "centre"), points.free, strict=True) if free]
    jacobian = np.column_stack([columns[:, :1], columns[:, 2:], *map(slope_to, ("radius", *names))]) * roots[:, None]
    degrees = max(1.0, float(np.sum(roots**2)) - jacobian.shape[1])
    scales = norm(jacobian, axis=0)
    spread = norm(left * roots) / math.sqrt(degrees) / unit / scales * norm(pinv(jacobian / scales) * roots, axis=1)
    errors = dict.fromkeys(found, 0.0) | named(spread[0], spread[1 : linear.size - 1])
    return replace(fit, errors=errors | dict(zip(("radius", *names), spread[linear.size - 1 :].tolist(), strict=True)))
