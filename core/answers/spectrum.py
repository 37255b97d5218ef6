"""Random profiles of self-affine roughness: a power law of amplitudes, and phases from a seed.

    f2(xi) = A sum_n a_n [cos p_n (1 - cos 2 pi n xi) + sin p_n sin 2 pi n xi],   n = first ... last
    a_n ~ n^-(H + 1/2),   sum a_n^2 = 2,   p_n uniform in [0, 2 pi)

so that A is the root mean square of the height over the wavelength, and the power spectral density of the profile
falls as n^-(2H + 1), that of a self-affine line of Hurst exponent H. A realisation follows from the seed and its own
number alone, whatever how many there are.
"""

import math
from dataclasses import dataclass

import numpy as np

from gradhesion.core.problem.profile import HIGHEST, MOST_HARMONICS, Harmonic, Profile


@dataclass(frozen=True, kw_only=True)
class Spectrum:
    """Self-affine roughness.

    Parameters
    ----------
    hurst
        H, 0 to 1.
    first, last
        The longest and the shortest wave, in waves per wavelength: 1 <= first <= last <= 10,000, 64 of them at most.
    realisations, seed
        How many profiles are drawn, 1 or more; seed of the random phases, 0 or more.

    Raises
    ------
    ValueError
        For a number out of range.

    Examples
    --------
    >>> Spectrum(hurst=0.8, first=1, last=32, realisations=100, seed=1).terms
    32
    """

    hurst: float
    first: int
    last: int
    realisations: int
    seed: int

    def __post_init__(self) -> None:
        if not 0.0 <= self.hurst <= 1.0:
            raise ValueError(f"hurst = {self.hurst}: the Hurst exponent is from 0 to 1")
        if not 1 <= self.first <= self.last <= HIGHEST or self.terms > MOST_HARMONICS:
            limits = f"1 <= first <= last <= {HIGHEST:,}, and {MOST_HARMONICS} waves at most"
            raise ValueError(f"first = {self.first}, last = {self.last}: {limits}")
        if self.realisations < 1 or self.seed < 0:
            raise ValueError(f"realisations = {self.realisations} and seed = {self.seed}: 1 or more, and 0 or more")

    @property
    def terms(self) -> int:
        """The number of waves."""
        return self.last - self.first + 1

    @property
    def rms_slope(self) -> float:
        """The rms slope of the waves at A = 1; it grows with A.

        >>> round(Spectrum(hurst=0.3, first=2, last=2, realisations=1, seed=0).rms_slope / (2 * math.pi), 12)
        2.0
        """
        numbers = range(self.first, self.last + 1)
        slopes, heights = (math.fsum(n ** (power - 2.0 * self.hurst) for n in numbers) for power in (1.0, -1.0))
        return 2.0 * math.pi * math.sqrt(slopes / heights)


def random_profile(spectrum: Spectrum, number: int, exponent: float = 2.0) -> Profile:
    """Return one realisation of a spectrum, the same for the same seed and number, bit by bit.

    `number` counts from 0, and may be beyond `spectrum.realisations`; `exponent` is m of the punch without waves, >= 1.

    Examples
    --------
    >>> profile = random_profile(Spectrum(hurst=0.8, first=1, last=32, realisations=1, seed=1), 0)
    >>> len(profile.harmonics), round(sum(wave.cos**2 + wave.sin**2 for wave in profile.harmonics), 12)
    (32, 2.0)
    """
    bits = np.random.PCG64(np.random.SeedSequence(spectrum.seed, spawn_key=(number,)))
    # 53 random bits each, as they come: a stream that no version of NumPy may change
    turns = (bits.random_raw(spectrum.terms) >> np.uint64(11)) * 2.0**-53
    numbers = range(spectrum.first, spectrum.last + 1)
    sizes = [n ** -(spectrum.hurst + 0.5) for n in numbers]
    unit = math.sqrt(2.0 / math.fsum(size * size for size in sizes))
    waves = []
    for n, size, phase in zip(numbers, sizes, (2.0 * math.pi * turns).tolist(), strict=True):
        waves.append(Harmonic(n=n, cos=unit * size * math.cos(phase), sin=unit * size * math.sin(phase)))
    return Profile(exponent=exponent, harmonics=tuple(waves))
