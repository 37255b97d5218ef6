"""Curves by the printed equations, and how far they are from the chords of drawn points."""

from collections.abc import Callable
from typing import Any

import numpy as np

from gradhesion.core import Profile
from gradhesion.core.equations import general
from tests.core.scene import material_of


def series_of(scene: dict[str, float], profile: Profile | None = None) -> tuple[float, list[float], list[float]]:
    waves = (profile or Profile()).harmonics
    count = max(wave.n for wave in waves)
    cosines, sines = [0.0] * count, [0.0] * count
    for wave in waves:
        cosines[wave.n - 1], sines[wave.n - 1] = -scene["A"] * wave.cos, scene["A"] * wave.sin
    return scene["lambda_over_R"], cosines, sines


def curve_of(scene: dict[str, float], profile: Profile | None = None, of: Any = general) -> Callable[[Any], Any]:
    """Depth and load at radii, by the printed equations of a module."""
    k, M, series = scene["k"], material_of(scene), series_of(scene, profile)
    power = {"exponent": (profile or Profile()).exponent}
    return lambda a: (of.indentation(k, M, a, *series, **power), of.load(k, M, a, *series, **power))


def chord_error(curve: Callable[[Any], Any], points: Any, joined: Any = None) -> float:
    """The largest distance of a curve from the chords of its points, in any plane and in spans, at 48 places a chord.

    Points are rows of radius, depth and load; `joined` tells which are reached along the curve. Of long curves every
    so many chords are looked at.
    """
    points = np.asarray(points)
    spans = np.ptp(points, axis=1)
    scales = np.divide(1.0, spans, out=np.zeros(3), where=spans > 0)
    steps = np.flatnonzero(np.ones(points.shape[1] - 1, dtype=bool) if joined is None else joined[1:])
    steps = steps[:: 1 + steps.size // 800]
    start, end = points[:, steps], points[:, steps + 1]
    worst = 0.0
    for share in np.arange(1, 48) * 0.6180339887498949 % 1.0 if steps.size else ():
        radii = start[0] + share * (end[0] - start[0])
        found = np.array([radii, *curve(radii)])
        for i, j in ((0, 1), (1, 2), (0, 2)):
            u, v = (end - start)[i] * scales[i], (end - start)[j] * scales[j]
            x, y = (found - start)[i] * scales[i], (found - start)[j] * scales[j]
            length = np.hypot(u, v)
            # the nearest point of the chord, not of its line
            along = np.clip((x * u + y * v) / np.where(length > 0, length, 1) ** 2, 0, 1)
            worst = max(worst, float(np.hypot(x - along * u, y - along * v).max()))
    return worst
