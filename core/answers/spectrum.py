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

from gradhesion.core.problem.inputs import check_settings, setting
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
    realisations
        How many profiles are drawn, 1 to 100,000.
    seed
        Seed of the random phases, 0 or more.

    Raises
    ------
    ValueError
        For a number out of range.

    Examples
    --------
    >>> Spectrum(hurst=0.8, first=1, last=32, realisations=100, seed=1).terms
    32
    """

    hurst: float = setting(
        "Hurst exponent H: the amplitudes of the waves n fall as n^-(H + 1/2)", "0.8", ge=0.0, le=1.0
    )
    first: int = setting("number of the longest wave; its wavelength is lambda/first", "1", default=1, ge=1, le=HIGHEST)
    last: int = setting("number of the shortest wave", "32", ge=1, le=HIGHEST)
    realisations: int = setting(
        "number of random profiles, along the last dimension of the dataset", "100", default=1, ge=1, le=100_000
    )
    seed: int = setting("seed of the random numbers", "1", default=0, ge=0, le=2**63 - 1)

    def __post_init__(self) -> None:
        check_settings(self)
        if not self.first <= self.last or self.terms > MOST_HARMONICS:
            raise ValueError(
                f"first = {self.first}, last = {self.last}: 1 <= first <= last <= {HIGHEST:,}, and {MOST_HARMONICS} "
                "waves at most"
            )

    @property
    def terms(self) -> int:
        """The number of waves."""
        return self.last - self.first + 1

    @property
    def rms_slope(self) -> float:
        """The rms slope of the waves at A = 1; it grows with A."""
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
