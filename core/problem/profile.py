"""The shape of a punch: a power of the radius and a Fourier series of waves.

    f(r) = r^m/(m R^(m-1)) + lambda A sum_n [ cos_n (1 - cos 2 pi n r/lambda) + sin_n sin(2 pi n r/lambda) ]

m = 2 is a paraboloid. A sine gives the punch a tip; one cosine is the wave of the paper. Kernels take its harmonics as
rows.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.inputs import check_settings, setting

HIGHEST: Final = 10_000
"""Number of the highest harmonic."""
MOST_HARMONICS: Final = 64
Rows = tuple[tuple[float, float, float], ...]
"""(n, cos, sin) of each harmonic."""
_SAMPLES: Final = 32
"""Of each wave of the shortest harmonic: a maximum lies within 1/64 of a wave of a sample that no neighbour exceeds."""
_STEPS: Final = 6
"""Newton's steps from there: after four nothing changes."""
_CANDIDATES: Final = 64
"""Samples that are refined; all of a sum that are within its curvature of the best."""


def number_of_wave() -> Any:
    """Declare the number of a wave."""
    return setting("number of the wave; its wavelength is lambda/n", "1", ge=1, le=HIGHEST)


def check_harmonic(name: str, n: float, cos: float, sin: float) -> None:
    """Raise ValueError for a wave of a series that is out of range; `name` is its name in the message."""
    if not (1 <= n <= HIGHEST and n == int(n)):
        raise ValueError(f"{name} n = {n}: n is a whole number from 1 on, {HIGHEST:,} at most")
    if not (math.isfinite(cos) and math.isfinite(sin)):
        raise ValueError(f"{name} n = {n}: cos = {cos} and sin = {sin} must be finite")


def check_numbers(name: str, numbers: Sequence[int]) -> None:
    """Raise ValueError for waves that are none, too many or given twice; `name` is their name in the message."""
    if not 1 <= len(numbers) <= MOST_HARMONICS:
        raise ValueError(f"{len(numbers)} {name}: a series has 1 to {MOST_HARMONICS}")
    repeated = sorted({n for n in numbers if numbers.count(n) > 1})
    if repeated:
        raise ValueError(f"{name} n = {repeated} are given more than once")


@dataclass(frozen=True, init=False)
class Harmonic:
    """One wave of the series, n times shorter than the wavelength.

    Parameters
    ----------
    n
        Waves per wavelength, a whole number from 1 to 10,000.
    cos, sin
        Amplitudes of 1 - cos and of sin, in units of A; finite. A missing one is 0; if both are missing, cos is 1.

    Raises
    ------
    ValueError
        For a number out of range.

    Examples
    --------
    >>> Harmonic(n=1), Harmonic(n=3, sin=0.2)
    (Harmonic(n=1, cos=1.0, sin=0.0), Harmonic(n=3, cos=0.0, sin=0.2))
    """

    n: int = number_of_wave()
    cos: float = setting(
        "cosine of the wave, in units of the amplitude; 1 if cos and sin are both left out", "1.0", default=None
    )
    sin: float = setting("sine of the wave, in units of the amplitude", "0.3", default=None)

    def __init__(self, *, n: int, cos: float | None = None, sin: float | None = None) -> None:
        if cos is None:
            cos = 1.0 if sin is None else 0.0
        for name, value in (("n", n), ("cos", cos), ("sin", 0.0 if sin is None else sin)):
            object.__setattr__(self, name, value)
        check_harmonic("harmonic", self.n, self.cos, self.sin)


@dataclass(frozen=True, kw_only=True)
class Profile:
    """The shape of a punch; by default a paraboloid with one cosine wave.

    Parameters
    ----------
    exponent
        m >= 1, finite; 1 is a cone, 2 a paraboloid.
    harmonics
        Up to 64 waves, each n once; with all amplitudes 0 the punch is smooth.

    Raises
    ------
    ValueError
        For an exponent or a series out of range.

    Examples
    --------
    >>> Profile() == Profile(exponent=2.0, harmonics=(Harmonic(n=1, cos=1.0, sin=0.0),))
    True
    """

    exponent: float = setting(
        'power m of the punch without waves: 2 is a paraboloid, 1 a cone; "fit" fits it to the file',
        "2.0",
        default=2.0,
        ge=1.0,
    )
    harmonics: tuple[Harmonic, ...] = setting(
        "waves of the series [one cosine]", "[{ n = 1, cos = 1.0 }, { n = 2, sin = 0.3 }]", default=(Harmonic(n=1),)
    )

    def __post_init__(self) -> None:
        check_settings(self)
        if not self.exponent < math.inf:
            raise ValueError(f"exponent = {self.exponent}: the power of the punch is finite")
        object.__setattr__(self, "exponent", float(self.exponent))  # an int would compile other kernels
        check_numbers("harmonics", [harmonic.n for harmonic in self.harmonics])


WAVY: Final = Profile()
"""The default punch: a paraboloid with one cosine wave."""


def rows_of(profile: Profile) -> NDArray[np.float64]:
    """Return the harmonics that have an amplitude, as rows (n, cos, sin)."""
    rows = [(h.n, h.cos, h.sin) for h in sorted(profile.harmonics, key=lambda h: h.n) if h.cos != 0.0 or h.sin != 0.0]
    return np.array(rows, dtype=float).reshape(-1, 3)


def in_own_wavelength(profile: Profile) -> tuple[float, NDArray[np.float64]]:
    """Return n and the harmonics of a wavelength n times shorter, over which A is n times as large.

    n is 1 but for a single harmonic, which is the first one of its own wavelength.
    """
    rows = rows_of(profile)
    if len(rows) != 1:
        return 1.0, rows
    n, even, odd = rows[0].tolist()
    return n, np.array([[1.0, even, odd]])


def starts_downwards(parameters: Mapping[str, ArrayLike], profile: Profile) -> NDArray[np.bool_]:
    """Report which punches are lower beside their tip than at it, so that contact without adhesion starts by a jump."""
    wavelength, amplitude = (np.asarray(parameters[name], dtype=float) for name in ("lambda_over_R", "A"))
    m = profile.exponent
    tip = 2.0 * np.pi * amplitude * sum(wave.n * wave.sin for wave in profile.harmonics) + (m == 1.0)
    bow = 2.0 * np.pi**2 * amplitude / wavelength * sum(wave.n**2 * wave.cos for wave in profile.harmonics)
    bow = bow + (0.5 if m == 2.0 else np.inf if 1.0 < m < 2.0 else 0.0)
    return np.asarray((tip < 0.0) | ((tip == 0.0) & (bow < 0.0)))


@lru_cache(maxsize=256)
def swings(k: float, rows: Rows) -> tuple[float, float]:
    """Return how far waves of some rows swing above and below their mean at large radii, where they keep their shape.

    For short waves depth swings by r zeta(x) a^c about its mean, c = (1-k)/2, with the r of one cosine and

        zeta(x) = sum n^c [cos_n sin(2 pi n x - phi) + sin_n cos(2 pi n x - phi)],   phi = pi (1+k)/4      (5.17)

    These are the largest zeta and minus the least, both >= 0, to a few units in the last place of their terms: those of
    a sampled period that may be the best are refined by Newton's method. Any k: at -1 and -3 zeta is f2'/(2 pi A) and
    f2''/(4 pi^2 A).

    >>> [round(float(swing), 12) for swing in swings(0.3, ((1.0, 1.0, 0.0),))]
    [1.0, 1.0]
    """
    if not rows:
        return 0.0, 0.0
    numbers, even, odd = np.array(rows).T[:, :, np.newaxis]
    even, odd = (numbers ** (0.5 * (1.0 - k)) * size for size in (even, odd))
    count, shift = _SAMPLES * int(numbers.max()), 0.25 * math.pi * (1.0 + k)

    def zeta(steps: NDArray[np.float64], rest: NDArray[np.float64], order: int = 0) -> NDArray[np.float64]:
        """Return a derivative of zeta at x = steps/count + rest, whose first part is exact in turns."""
        phase = 2.0 * math.pi * ((numbers * steps) % count / count + numbers * rest) - shift + 0.5 * math.pi * order
        return np.sum((2.0 * math.pi * numbers) ** order * (even * np.sin(phase) + odd * np.cos(phase)), axis=0)

    waves = np.zeros(count // 2 + 1, dtype=complex)
    np.add.at(waves, numbers.astype(int), 0.5 * count * (odd - 1j * even) * np.exp(-1j * shift))
    values = np.fft.irfft(waves, count)  # good enough to choose by
    found = []
    for sign in (1.0, -1.0):
        best = np.argsort(-sign * values)[:_CANDIDATES]
        crest = (sign * values >= np.roll(sign * values, 1)) & (sign * values >= np.roll(sign * values, -1))
        samples = np.union1d(best[crest[best]], best[:1]).astype(float)
        rest = np.zeros(samples.size)
        for _ in range(_STEPS):
            bend = sign * zeta(samples, rest, 2)
            step = np.divide(-sign * zeta(samples, rest, 1), bend, out=np.zeros_like(bend), where=bend < 0.0)
            rest = np.clip(rest + step, -1.0 / count, 1.0 / count)
        ends = np.concatenate([zeta(samples, rest), zeta(samples, np.zeros(samples.size))])
        found.append(max(0.0, float((sign * ends).max())))
    return found[0], found[1]


def swings_of(k: NDArray[np.float64], rows: Rows) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the same for every exponent of an array, NaN outside [0, 1]."""
    up, down = np.full(k.shape, np.nan), np.full(k.shape, np.nan)
    for exponent in np.unique(k[(k >= 0.0) & (k <= 1.0)]):
        up[k == exponent], down[k == exponent] = swings(float(exponent), rows)
    return up, down
