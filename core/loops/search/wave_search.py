"""Where to start a fit of waves: the residual of a smooth punch is periodic in the contact radius.

The peaks of its spectrum, then wavelengths over the whole range, each with some amplitudes, are refined in everything
else, and the best of them in all, until one leaves no more than noise.
"""

import itertools
import math
from typing import Any, Final

import numpy as np

from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import AMPLITUDES, WAVELENGTHS
from gradhesion.core.loops.search.starts import (
    COARSE,
    best_of,
    carried,
    coarse,
    distinct,
    is_noise,
    near_best,
    roughly,
    shares_of,
)
from gradhesion.core.types import Floats

_HEIGHTS: Final = 3
"""Amplitudes that are tried with each wavelength."""
_PEAKS: Final = 6
"""Peaks of the spectrum that are tried."""
_BESIDE: Final = 2
"""Peaks that are tried with a third of a wave more, and less, within the contact."""
_ALIKE: Final = 0.05
"""Distance in parts of the ranges: closer smooth curves share one search for waves."""
_PER_WAVE: Final = 3.0
"""Wavelengths tried, over the number of waves by which the shortest and the longest differ within the contact."""
_LEAST, _MOST = 8, 14
"""How many they are at least and at most."""


def spectrum(smooth: Misfit, vector: Floats, lengths: tuple[float, float]) -> Floats:
    """Return the wavelengths in m at which the residual of a smooth punch repeats most, the strongest first."""
    from scipy.signal import find_peaks, lombscargle  # noqa: PLC0415 (a loop without waves does without its half second)

    drawn = smooth.path(vector)
    if drawn is None:
        return np.empty(0)
    largest = float(drawn.radius.max())
    count = int(np.clip(10.0 * largest * (1.0 / lengths[0] - 1.0 / lengths[1]), 64, 4000))
    waves = np.linspace(1.0 / lengths[1], 1.0 / lengths[0], count)
    power = np.zeros(count)
    for own, piece, nearest in smooth.feet(vector):
        radius, jump = drawn.radius[piece], drawn.jump[piece]
        at = (1.0 - nearest.share) * radius[nearest.piece] + nearest.share * radius[nearest.piece + 1]
        use = (at > lengths[0]) & ~jump[nearest.piece + 1]
        if np.unique(at[use]).size < 12:
            continue
        left = nearest.distance[use] * smooth.weights[own][use]
        trend = np.polynomial.Polynomial.fit(at[use], left, 3)(at[use])
        rest = left - trend
        size = float(rest @ rest)
        if size > 0.0:
            power += lombscargle(at[use], rest, 2.0 * math.pi * waves) / size * rest.size
    peaks, _ = find_peaks(power)
    return np.asarray(1.0 / waves[peaks[np.argsort(-power[peaks], kind="stable")]])


def wavy_starts(misfit: Misfit, smooth: Misfit, bases: list[Floats], count: int) -> list[Floats]:
    """Return starts for waves that are searched, refined in everything else, the best first.

    Parameters
    ----------
    misfit
        The loop.
    smooth, bases
        The same without waves, and where it is begun from.
    count
        How many are returned at most.
    """
    few = coarse(misfit, COARSE)
    length, height = misfit.model.place_of(WAVELENGTHS), misfit.model.place_of(AMPLITUDES)
    held = [i for i in (length, height) if i is not None]
    heights = [None] if height is None else shares_of(misfit, height, _HEIGHTS)
    found: list[Floats] = []
    for base in distinct(bases, smooth, _ALIKE):
        middle = carried(misfit, smooth, base)
        for waves in [[None]] if length is None else _lengths(misfit, smooth, base, middle, length):
            begun = []
            for wave, swell in itertools.product(waves, heights):
                vector = middle.copy()
                for i, value in ((length, wave), (height, swell)):
                    if i is not None and value is not None:
                        vector[i] = value
                begun.append(_softened(misfit, vector))
            near = best_of(misfit, roughly(misfit, begun, few, most=4, held=held), few, count)
            found += roughly(misfit, distinct(near, misfit), few, most=10)
            found = best_of(misfit, found, few, len(found))
            if found and is_noise(misfit, found[0], few):
                return near_best(distinct(found, misfit), misfit)[:count]
    return near_best(distinct(found, misfit), misfit)[:count]


def _lengths(misfit: Misfit, smooth: Misfit, begun: Floats, middle: Floats, i: int) -> list[Any]:
    """Return the logarithms of the wavelengths that are tried: those of the spectrum, and others over the range."""
    drawn, scene = smooth.path(begun), misfit.model.scenes(middle[None]).one
    unit = scene.wavelength * scene.R / math.exp(middle[i])  # the wavelength in m of a number of 1
    low, high = math.exp(misfit.low[i]) * unit, math.exp(misfit.high[i]) * unit
    largest = 0.0 if drawn is None else float(drawn.radius.max())
    count = int(np.clip(_PER_WAVE * largest * (1.0 / low - 1.0 / high), _LEAST, _MOST))
    even = 1.0 / np.linspace(1.0 / high, 1.0 / low, count + 2)[1:-1]
    peaks = spectrum(smooth, begun, (low, high))[:_PEAKS]
    # a wave more or less within the contact is another minimum: peaks are off by parts of one
    strong = peaks[:_BESIDE]
    beside = [strong / (1.0 + sign * strong / (_PER_WAVE * largest)) for sign in (1.0, -1.0) if largest]
    groups = np.concatenate([peaks, *beside]), even
    return [np.log(tried[(tried >= low) & (tried <= high)] / unit) for tried in groups]


def _softened(misfit: Misfit, vector: Floats) -> Floats:
    """Subtract what waves add from the work of adhesion of the smooth punch: the roots of both add up."""
    if "work_of_adhesion" not in misfit.names:
        return vector
    i = misfit.names.index("work_of_adhesion")
    scene = misfit.model.scenes(vector[None]).one
    waves = float(waviness_strength(scene.k, scene.wavelength, scene.A))
    ratio = waves / float(adhesion_strength(scene.k, scene.stiffness))
    root = max(1.0 - ratio, 0.15)
    vector[i] = np.clip(vector[i] + 2.0 * math.log(root), misfit.low[i], misfit.high[i])
    return vector
