"""A toughness that varies with the radius, and a work of adhesion that grows with the speed of the edge.

A Fourier series multiplies the toughness, or the work of adhesion:

    t(r) = 1 + toughness_amplitude sum_n [ cos_n cos(2 pi n r/lambda_t) + sin_n sin(2 pi n r/lambda_t) ]

of="toughness": K_c(r) = K_c t, t >= 0;   of="work": w(r) = w t, t > 0. Either way the edge of a contact of radius r has
the toughness kappa(r) K_c, with kappa = t or its root. An edge with a speed v opens at G = w_o [1 + (v/v*)^n].
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.problem.inputs import check_settings, setting
from gradhesion.core.problem.profile import check_harmonic, check_numbers, number_of_wave

OF: Final = ("toughness", "work")
"""What a pattern multiplies."""
CLOSINGS: Final = ("quasi-static", "same")
"""How the contact closes: at the work of closing whatever the speed, or at w_c/[1 + (v/v*)^n]."""
MOST_WAVES: Final = 16_000.0
"""Most waves of the shortest harmonic that are followed: a table of them has 75 MB."""
EXPONENTS: Final = (0.1, 2.0)
"""The range of n within which the solver has been measured; elastomers have 0.1 to 0.8."""
_SAMPLES: Final = 16
"""Parts of the shortest wave with which the search for the lowest value begins."""
_ROUNDING: Final = 8.0 * 2.0**-52
"""Error of a sum, in parts of the sum of the sizes of its terms."""
_NARROW: Final = 1e-15
"""Part of the wavelength below which the search ends."""


@dataclass(frozen=True, kw_only=True)
class ToughnessHarmonic:
    """One wave of a pattern, n times shorter than its wavelength.

    Parameters
    ----------
    n
        Waves per wavelength, a whole number from 1 to 10,000.
    cos, sin
        Amplitudes in units of `toughness_amplitude`; finite, 0 if left out.

    Raises
    ------
    ValueError
        For a number out of range.

    Examples
    --------
    >>> ToughnessHarmonic(n=3, sin=0.2)
    ToughnessHarmonic(n=3, cos=0.0, sin=0.2)
    """

    n: int = number_of_wave()
    cos: float = setting("cosine of the wave, in units of the amplitude", "0.2", default=0.0)
    sin: float = setting("sine of the wave, in units of the amplitude", "0.3", default=0.0)

    def __post_init__(self) -> None:
        check_harmonic("toughness harmonic", self.n, self.cos, self.sin)


@dataclass(frozen=True)
class Toughness:
    """How the toughness of the interface, or its work of adhesion, varies with the radius.

    Parameters
    ----------
    harmonics
        1 to 64 waves, each n once.
    of
        "toughness" or "work": what the series multiplies.

    Raises
    ------
    ValueError
        For a series out of range, or an unknown `of`.

    Examples
    --------
    >>> Toughness((ToughnessHarmonic(n=1, cos=0.2),)).of
    'toughness'
    """

    harmonics: tuple[ToughnessHarmonic, ...] = setting(
        "waves of the series, a sum that is added to 1", "[{ n = 1, cos = 0.2 }]"
    )
    of: str = setting(
        "what the series multiplies: the toughness K_c, or the work of adhesion",
        '"work"',
        default="toughness",
        choices=OF,
    )

    def __post_init__(self) -> None:
        check_settings(self)
        check_numbers("toughness harmonics", [harmonic.n for harmonic in self.harmonics])


@dataclass(frozen=True, kw_only=True)
class Rate:
    """The law of a moving edge (Maugis & Barquins 1978).

    Parameters
    ----------
    exponent
        n, from 0.1 to 2.
    closing
        One of `CLOSINGS`.

    Raises
    ------
    ValueError
        For an exponent out of range, or an unknown closing.

    Examples
    --------
    >>> Rate(exponent=0.6).closing
    'quasi-static'
    """

    exponent: float = setting(
        "power n of the speed of the edge in its work, 1 + (v/v*)^n", "0.6", ge=EXPONENTS[0], le=EXPONENTS[1]
    )
    closing: str = setting(
        "law of closing: quasi-static whatever the speed, or the same law as for opening",
        '"same"',
        default="quasi-static",
        choices=CLOSINGS,
    )

    def __post_init__(self) -> None:
        check_settings(self)


def rows_of_pattern(toughness: Toughness) -> NDArray[np.float64]:
    """Return the harmonics that have an amplitude, as rows (n, cos, sin)."""
    chosen = [(h.n, h.cos, h.sin) for h in sorted(toughness.harmonics, key=lambda h: h.n) if h.cos or h.sin]
    return np.array(chosen, dtype=float).reshape(-1, 3)


def series_at(rows: NDArray[np.float64], u: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the series of a pattern, rows of n and both amplitudes, at u wavelengths, of the shape of u."""
    total = np.zeros(u.shape)
    for n, even, odd in rows:
        phase = 2.0 * math.pi * ((n * u) % 1.0)
        total += even * np.cos(phase) + odd * np.sin(phase)
    return total


def lowest(rows: NDArray[np.float64], end: float = 1.0, limit: float = -math.inf) -> tuple[float, float]:
    """Return the lowest value of a series up to `end` wavelengths, 1 at most, or the first below a limit; its place.

    Parts of the wavelength are halved as long as the bound of the curvature allows the series to be lower in them than
    the lowest value so far, or before that lower than the limit: no minimum is missed, up to rounding.
    """
    sizes = np.hypot(rows[:, 1], rows[:, 2])
    if not sizes.any():
        return 0.0, 0.0
    bend, error = float(np.sum((2.0 * math.pi * rows[:, 0]) ** 2 * sizes)), _ROUNDING * float(sizes.sum())
    left = np.linspace(0.0, end, 2 + math.ceil(_SAMPLES * float(rows[:, 0].max()) * end))
    width, values = left[1], series_at(rows, left)
    best, place = float(values[-1]), end
    left, first, last = left[:-1], values[:-1], values[1:]
    while left.size and width > _NARROW:
        below = np.flatnonzero(first < limit)
        i = int(below[0]) if below.size else int(np.argmin(first))
        if first[i] < max(best, limit) and (best >= limit or left[i] < place):
            best, place = float(first[i]), float(left[i])
        worth = np.minimum(first, last) - bend * width**2 / 8.0 < (limit if best < limit else best - error)
        worth &= (best >= limit) | (left < place)
        width *= 0.5
        middle = left[worth] + width
        here = series_at(rows, middle)
        left, first, last = (
            np.stack(pair, axis=-1).ravel()
            for pair in ((left[worth], middle), (first[worth], here), (here, last[worth]))
        )
    return best, place


def violation(toughness: Toughness, amplitude: float, wavelength: float, rim: float) -> float | None:
    """Return the first radius up to a rim at which a pattern has the wrong sign, None if there is none.

    t < 0 is no toughness, t <= 0 no work of adhesion. The amplitude is finite; wavelength and rim are > 0, in one unit,
    and the rim may be inf.

    >>> pattern = Toughness((ToughnessHarmonic(n=1, sin=1.0),))
    >>> violation(pattern, 1.0, 0.1, 1.0), round(violation(pattern, 1.25, 0.1, 1.0), 6)
    (None, 0.064758)
    """
    place = first_violation(toughness, amplitude, min(1.0, rim / wavelength))
    return place * wavelength if place < math.inf else None


def first_violation(toughness: Toughness, amplitude: float, end: float = 1.0) -> float:
    """Return the first place up to `end` wavelengths, 1 at most, at which the sign is wrong, inf if there is none."""
    rows = rows_of_pattern(toughness) * np.array([1.0, amplitude, amplitude])
    error = _ROUNDING * (1.0 + float(np.hypot(rows[:, 1], rows[:, 2]).sum()))
    limit = -1.0 + (error if toughness.of == "work" else -error)
    value, place = lowest(rows, end, limit)
    return place if value < limit else math.inf
