"""The Fourier coefficients of any waviness (5.12)-(5.14).

    f2(xi) = a0/2 + sum_n [a_n cos 2 pi n xi + b_n sin 2 pi n xi]
    a_n = 2 int_{-1/2}^{1/2} f2(xi) cos(2 pi n xi) d(xi),   b_n = 2 int_{-1/2}^{1/2} f2(xi) sin(2 pi n xi) d(xi)

They turn a waviness that is measured, or given as a function, into the series of general.py. The rule is that of equal
steps, which is exact for a series and converges faster than any power of the step for a smooth periodic f2. As f2(0)
= 0 in the theory, a0/2 = -sum a_n is not needed: a constant height of f2 only shifts the punch.
"""

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.equations._arguments import Array, describe

_MOST: Final = 2**20
"""Most samples of a period."""


def sampled_coefficients(heights: ArrayLike, terms: int) -> tuple[list[float], list[float]]:
    """Return the coefficients of a waviness that is sampled at equal steps over one period (5.13), (5.14).

    Parameters
    ----------
    heights
        f2 at xi = 0, 1/N, ..., (N-1)/N, over the wavelength, one-dimensional.
    terms
        How many harmonics, 1 to (N-1)/2.

    Returns
    -------
    The lists a_1, a_2, ... and b_1, b_2, ..., as general.py takes them. Exact to rounding for a series of fewer than
    N - terms harmonics. Others, and samples that are not finite, are a ValueError.

    >>> cosines, sines = sampled_coefficients([0.0, 0.04, 0.0, -0.04], 1)
    >>> abs(cosines[0]) < 1e-17, round(sines[0], 12)
    (True, 0.04)
    """
    values = np.asarray(heights, dtype=float)
    if values.ndim != 1 or not np.isfinite(values).all():
        raise ValueError("heights are to be finite numbers along one dimension: the samples of one period")
    if not 1 <= terms <= (values.size - 1) // 2:
        most = max(0, (values.size - 1) // 2)
        raise ValueError(f"terms = {terms}: {values.size} samples hold 1 to {most} harmonics; take more samples")
    found = 2.0 / values.size * np.fft.rfft(values)[1 : terms + 1]
    return found.real.tolist(), (-found.imag).tolist()


def coefficients(waviness: Callable[[Array], Array], terms: int) -> tuple[list[float], list[float]]:
    """Return the coefficients of a waviness that is given as a function (5.13), (5.14).

    Parameters
    ----------
    waviness
        f2 of an array of xi in [0, 1), over the wavelength; of period 1.
    terms
        How many harmonics, 1 or more.

    Returns
    -------
    The lists a_1, a_2, ... and b_1, b_2, ..., as general.py takes them. Samples are doubled until no coefficient
    changes by more than 1e-11 of the largest |f2|; for a smooth f2 they are more accurate. One with corners needs
    some 2^19 samples, and one with steps, which 2^20 do not resolve, or one that is not finite is a ValueError.

    A wave of flat valleys: A (1 - cos)^2 = A (3/2 - 2 cos + cos(2 .)/2).

    >>> cosines, _ = coefficients(lambda xi: 0.01 * (1 - np.cos(2 * np.pi * xi)) ** 2, 3)
    >>> [round(a_n, 12) + 0.0 for a_n in cosines]
    [-0.02, 0.005, 0.0]
    """
    if terms < 1:
        raise ValueError(f"terms = {terms}: a series has one harmonic or more")
    count = 4
    while count < 4 * terms:
        count *= 2
    before: Array | None = None
    while count <= _MOST:
        heights = np.broadcast_to(np.asarray(waviness(np.arange(count) / count), dtype=float), (count,))
        cosines, sines = sampled_coefficients(heights, terms)
        now = np.array([cosines, sines])
        if before is not None and np.abs(now - before).max() <= 1e-11 * np.abs(heights).max():
            return cosines, sines
        before, count = now, 2 * count
    raise ValueError(f"the waviness is not resolved by {_MOST:,} samples of its period; it is to be continuous")


describe(__name__)
