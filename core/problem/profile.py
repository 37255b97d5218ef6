"""The shape of a punch: a power of the radius and a Fourier series of waves.

    f(r) = r^m/(m R^(m-1)) + lambda A sum_n [ cos_n (1 - cos 2 pi n r/lambda) + sin_n sin(2 pi n r/lambda) ]

m = 2 is a paraboloid. A sine gives the punch a tip; one cosine is the wave of the paper.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from gradhesion.core.problem.settings import check_settings, setting

HIGHEST: Final = 10_000
"""Number of the highest harmonic."""
MOST_HARMONICS: Final = 64


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
        "waves of the series [one cosine]",
        "[{ n = 1, cos = 1.0 }, { n = 2, sin = 0.3 }]",
        default=(Harmonic(n=1),),
    )

    def __post_init__(self) -> None:
        check_settings(self)
        if not self.exponent < math.inf:
            raise ValueError(f"exponent = {self.exponent}: the power of the punch is finite")
        object.__setattr__(self, "exponent", float(self.exponent))  # an int would compile other kernels
        check_numbers("harmonics", [harmonic.n for harmonic in self.harmonics])


WAVY: Final = Profile()
"""The default punch: a paraboloid with one cosine wave."""
