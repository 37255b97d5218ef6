"""The leading terms of short waves (5.15 to 5.20), in the place of the exact functions of a table.

    depth ~ B y^m + g mean + (g S(y) - 1) y E,     load ~ T [depth - mu B y^m - g mean]

with S(y) = sum_n size_n [cos_n sin x_n + sin_n cos x_n], x_n = n y - (1+k) pi/4, and size_n = n^((1-k)/2) 2^((k-1)/2)
G((1+k)/2). The slopes of these two are no multiples of each other, so that the pull-off has a table of its own
(BY_LOAD): any U whose derivative is d load/(g T dy), with U - U1 = y E S.
"""

import math

import numpy as np

from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import BY_DEPTH, BY_LOAD, POINTS, N
from gradhesion.core.types import Floats


def amplitude_of(k: float) -> float:
    """Return 2^((k-1)/2) G((1+k)/2), the amplitude of the leading term of z S0 over z^((1-k)/2)."""
    return 2.0 ** (0.5 * (k - 1.0)) * math.gamma(0.5 * (1.0 + k))


def crests_of(k: float, waves: Floats) -> tuple[float, float, float]:
    """Return how far -U' and -(U - U1) rise in the leading term, over y^((1-k)/2), and the phase where U' is least.

    `waves` are rows (n, cos, sin); the phase is y within a wavelength.
    """
    phases = np.linspace(0.0, 2.0 * np.pi, 256 * int(waves[:, 0].max()) + 1)
    slope, wave = np.zeros(phases.size), np.zeros(phases.size)
    for n, cos, sin in waves:
        angle = n * phases - 0.25 * np.pi * (1.0 + k)
        size = amplitude_of(k) * n ** (0.5 * (1.0 - k))
        cosine, sine = np.cos(angle), np.sin(angle)
        slope += size * n * (cos * cosine - sin * sine)
        wave += size * (cos * sine + sin * cosine)
    margin = 1.005  # of the maxima between the phases that are looked at, and of the terms after the leading one
    at = int(slope[:-1].argmin())
    before, least, after = slope[at - 1 if at > 0 else -2], slope[at], slope[at + 1]
    step = 0.5 * (before - after) / (before - 2.0 * least + after)  # to the vertex of the parabola
    steepest = float(phases[at] + step * phases[1]) % (2.0 * np.pi)
    return -margin * float(slope.min()), -margin * float(wave.min()), steepest


@leaf
def leading_at(k: float, waves: Floats, form: int, y: float) -> tuple[float, float]:
    """Return U and U1 of the leading terms of the depth at y; of the load d load/(g T dy) and y E S instead."""
    size = 2.0 ** (0.5 * (k - 1.0)) * math.gamma(0.5 * (1.0 + k))
    wave = slope = mean = 0.0
    for i in range(len(waves)):
        n, cos, sin = waves[i]
        x = n * y - 0.25 * math.pi * (1.0 + k)
        size_n = size * n ** (0.5 * (1.0 - k))
        wave += size_n * (cos * math.sin(x) + sin * math.cos(x))
        slope += size_n * n * (cos * math.cos(x) - sin * math.sin(x))
        mean += cos
    stretch = y ** (0.5 * (1.0 - k))
    if form == BY_LOAD:
        return stretch * (0.5 * (3.0 + k) * wave / y + slope), stretch * wave
    if k == 1.0:  # mean and wave cancel at the centre
        wave = mean = 0.0
        for i in range(len(waves)):
            n, cos, sin = waves[i]
            wave += 2.0 * cos * math.sin(0.5 * n * y) ** 2 + sin * math.sin(n * y)
            mean += cos
        return wave, mean
    return mean + stretch * wave, mean


@kernel
def fill_far_leading(
    k: float, waves: Floats, form: int, width: float, shift: float, far_waves: Floats, far_mean: Floats
) -> None:
    """Fill the expansions of filling.fill_far with the leading terms; by load those of U1 are over y."""
    size = 2.0 ** (0.5 * (k - 1.0)) * math.gamma(0.5 * (1.0 + k))
    for h in range(len(waves)):
        n, cos, sin = waves[h]
        size_n = size * n ** (0.5 * (1.0 - k))
        if form == BY_DEPTH:
            far_mean[0, 0] += cos
            far_mean[1, 0] += cos
        for b in range(far_waves.shape[2]):
            for j in range(N):
                x = n * width * (b + shift + 0.5 + 0.5 * POINTS[j]) - 0.25 * math.pi * (1.0 + k)
                wave = size_n * (cos * math.sin(x) + sin * math.cos(x))
                if form == BY_DEPTH:
                    far_waves[0, 0, b, j] += wave
                else:
                    far_waves[0, 0, b, j] += size_n * n * (cos * math.cos(x) - sin * math.sin(x))
                    far_waves[0, 1, b, j] += 0.5 * (3.0 + k) * wave
                    far_waves[1, 0, b, j] += wave
