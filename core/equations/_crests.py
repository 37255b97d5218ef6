"""The heights of crests and depths of troughs of a profile at large radii, where waves keep their shape.

For short waves the depth swings by r zeta(x) a^c about its mean, c = (1-k)/2, with the r of one cosine and

    zeta(x) = sum n^c [cos_n sin(2 pi n x - phi) + sin_n cos(2 pi n x - phi)],   phi = pi (1+k)/4          (5.17)

Its extrema are the true ones: those of a sampled period that may still be the best are refined by Newton's method.
"""

import math
from functools import lru_cache
from typing import Final

import numpy as np

from gradhesion.core.equations._arguments import Array

_SAMPLES: Final = 32
"""Of each wave of the shortest harmonic: a maximum lies within 1/64 of a wave of a sample that no neighbour exceeds."""
_STEPS: Final = 6
"""Newton's steps from there: after four nothing changes."""
_CANDIDATES: Final = 64
"""Samples that are refined; all of a sum that are within its curvature of the best."""

Rows = tuple[tuple[float, float, float], ...]
"""(n, cos, sin) of each harmonic."""


@lru_cache(maxsize=256)
def swings(k: float, rows: Rows) -> tuple[float, float]:
    """Return the largest zeta and minus the least, both >= 0, to a few units in the last place of their terms.

    >>> [round(float(swing), 12) for swing in swings(0.3, ((1.0, 1.0, 0.0),))]
    [1.0, 1.0]
    """
    if not rows:
        return 0.0, 0.0
    numbers = np.array([int(n) for n, _, _ in rows])[:, np.newaxis]
    size = numbers ** (0.5 * (1.0 - k))
    even, odd = (size * np.array([row[i] for row in rows])[:, np.newaxis] for i in (1, 2))
    count = _SAMPLES * int(numbers.max())
    shift = 0.25 * math.pi * (1.0 + k)

    def derivative(x: Array, order: int) -> Array:
        # x is exact in units of 1/count, and what is left over in turns beside it
        turns = (numbers * x[0]) % count / count + numbers * x[1]
        phase = 2.0 * math.pi * turns - shift + 0.5 * math.pi * order
        return np.sum((2.0 * math.pi * numbers) ** order * (even * np.sin(phase) + odd * np.cos(phase)), axis=0)

    waves = np.zeros(count // 2 + 1, dtype=complex)
    np.add.at(waves, numbers, 0.5 * count * (odd - 1j * even) * np.exp(-1j * shift))
    values = np.fft.irfft(waves, count)  # good enough to choose by
    found = []
    for sign in (1.0, -1.0):
        best = np.argsort(-sign * values)[:_CANDIDATES]
        crest = (sign * values >= np.roll(sign * values, 1)) & (sign * values >= np.roll(sign * values, -1))
        near = np.union1d(best[crest[best]], best[:1])
        samples = x = np.stack([near.astype(float), np.zeros(near.size)])
        for _ in range(_STEPS):
            bend = sign * derivative(x, 2)
            step = np.divide(-sign * derivative(x, 1), bend, out=np.zeros_like(bend), where=bend < 0.0)
            x = np.stack([x[0], np.clip(x[1] + step, -1.0 / count, 1.0 / count)])
        found.append(max(0.0, *(sign * np.concatenate([derivative(x, 0), derivative(samples, 0)])).tolist()))
    return found[0], found[1]


def swings_of(k: Array, rows: Rows) -> tuple[Array, Array]:
    """Return the same for every exponent of an array, NaN outside [0, 1]."""
    up, down = np.full(k.shape, np.nan), np.full(k.shape, np.nan)
    for exponent in np.unique(k[(k >= 0.0) & (k <= 1.0)]):
        place = k == exponent
        up[place], down[place] = swings(float(exponent), rows)
    return up, down
