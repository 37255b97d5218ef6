"""The profile of a punch from measured heights: a power and a Fourier series that fit them best.

    h(r) = h0 + rho^m/(m R^(m-1)) + sum_n [c_n (1 - cos 2 pi n x) + s_n sin 2 pi n x],   rho = |r - r0|, x = rho/lambda

The numbers that are not linear, m, lambda and r0, are searched by profile_search.py.
"""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike
from threadpoolctl import threadpool_limits

from gradhesion.core.answers.profile_search import Search
from gradhesion.core.problem.profile import MOST_HARMONICS, Harmonic, Profile
from gradhesion.core.types import Floats

_FEWEST: Final = 8
"""Points that are fitted, at least."""
_WRONG_WAY: Final = (
    "the height does not grow with the distance from the centre; it is to grow away from the half-space, "
    "so reverse its sign, or name another part of the profile with up_to"
)


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
        lowest height, it is a line over both flanks, whose centre is fitted; otherwise the axis is at 0, and the first
        place within half of the last one of it.
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
    vertex = _vertex(places, heights) if places.size >= _FEWEST else 0.0
    if vertex is None and places[0] < 0.0:
        raise ValueError(_WRONG_WAY)
    both = vertex is not None and (
        bool(places[0] < 0.0) or (places[0] < vertex < places[-1] and _is_lowest_inside(heights))
    )
    centre = vertex if vertex is not None and both else 0.0
    reach = float(np.max(np.abs(places - centre))) if up_to is None else float(up_to)
    inside = np.abs(places - centre) <= reach * (1.0 + 0.05 * both)  # the centre moves by less
    places, heights = places[inside], heights[inside]
    unknown = 2 + 2 * terms + 1 + (exponent is None) + both
    if places.size < max(_FEWEST, 2 * unknown):
        raise ValueError(
            f"{places.size:,} points within {reach:g} of the centre are too few for {terms} terms, which take "
            f"{2 * unknown}; use fewer terms or a larger up_to"
        )
    if not both and places[0] > 0.5 * reach:
        raise ValueError(
            f"no heights within {places[0]:g} of the axis, which is at r = 0; shift r, so that it is the distance from "
            "the axis"
        )
    search = Search(places, heights, reach, terms, exponent, centre if both else None)
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        return _described(search, search.best())


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


def _vertex(places: Floats, heights: Floats) -> float | None:
    """Return the vertex of the parabola that fits points (n,) best, or the end of the line next to it.

    None if the parabola does not open upwards.
    """
    middle, half = 0.5 * (places[0] + places[-1]), 0.5 * (places[-1] - places[0]) or 1.0
    bend, slope, _ = np.polyfit((places - middle) / half, heights, 2)
    return float(middle + half * np.clip(-0.5 * slope / bend, -1.0, 1.0)) if bend > 0.0 else None


def _described(search: Search, vector: Floats) -> FittedProfile:
    """Describe a fit in the units of the measurement, with the errors that its residual implies."""
    m, waves, centre = search.split(vector)
    reach, unit, names = search.reach, search.unit, search.names
    columns, roots = search.design(vector, search.x)
    found = np.linalg.lstsq(columns * roots[:, None], search.y * roots, rcond=None)[0]
    linear = np.asarray(found, dtype=np.float64)
    if not linear[1] > 0.0:
        raise ValueError(_WRONG_WAY)
    count = (columns.shape[1] - 2) // 2
    rho, left = np.abs(search.x - centre), (search.y - columns @ linear) * unit
    order = np.argsort(rho)
    inside = order[rho[order] <= 1.0]
    jacobian = np.column_stack([columns, _moving(search, linear, vector)]) * roots[:, None]
    degrees = max(1.0, float(np.sum(roots**2)) - jacobian.shape[1])
    variance = float(np.sum((left * roots) ** 2)) / degrees / unit**2
    rows = np.linalg.pinv(jacobian) * roots
    spread = np.sqrt(variance * np.sum(rows**2, axis=1))
    searched = {"exponent": 0.0, "centre": 0.0} | dict(zip(names, spread[2 + 2 * count :].tolist(), strict=True))
    factor = linear[1] * unit / reach**m  # 1/(m R^(m-1))
    radius = float((m * factor) ** (-1.0 / (m - 1.0)))
    # R = (m g)^(-1/(m-1)) moves with g, whose relative error is that of its column, and with m
    gradient, moved = [-1.0 / ((m - 1.0) * linear[1])], [1]
    if "exponent" in names:
        gradient.append(math.log(m * factor) / (m - 1.0) ** 2 - (1.0 / m - math.log(reach)) / (m - 1.0))
        moved.append(2 + 2 * count + names.index("exponent"))
    covariance = variance * rows[moved] @ rows[moved].T

    def lengths(coefficients: Floats) -> Floats:
        """Return the coefficients of all harmonics, those left out as 0, in the unit of heights."""
        return np.pad(coefficients, (0, search.terms - count)) * unit

    return FittedProfile(
        exponent=m,
        radius=radius,
        wavelength=reach / waves,
        up_to=reach,
        cosines=lengths(linear[2 : 2 + count]),
        sines=lengths(linear[2 + count :]),
        centre=centre * reach,
        height=float(linear[0]) * unit + search.lowest,
        errors={
            "exponent": searched["exponent"],
            "radius": radius * math.sqrt(np.array(gradient) @ covariance @ np.array(gradient)),
            "wavelength": searched["waves"] * reach / waves**2,
            "cosines": lengths(spread[2 : 2 + count]),
            "sines": lengths(spread[2 + count : 2 + 2 * count]),
            "centre": searched["centre"] * reach,
            "height": spread[0] * unit,
        },
        distance=rho[inside] * reach,
        residual=left[inside],
    )


def _moving(search: Search, linear: Floats, vector: Floats) -> Floats:
    """Return the derivatives of the heights by the searched numbers, by central differences; (points, numbers)."""
    steps = np.diag(1e-6 * np.maximum(1.0, np.abs(vector)))
    columns = []
    for step in steps:
        ahead, behind = (search.design(vector + way * step, search.x)[0] @ linear for way in (1.0, -1.0))
        columns.append((ahead - behind) / (2.0 * step.max()))
    return np.column_stack(columns)
