"""A profile in the form that kernels use: its power's factor, its harmonics as rows, and when it is one cosine wave."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.profile import Profile


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


def depth_factor_of(k: float, exponent: float) -> float:
    """Return G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)), the depth of r^m/m over a^m."""
    if exponent == 2.0:
        return 1.0 / (1.0 + k)
    from scipy.special import beta  # noqa: PLC0415 (200 ms that a paraboloid does not need)

    return float(0.5 * beta(0.5 * exponent, 0.5 * (1.0 + k)))


@lru_cache(maxsize=128)
def equivalent_wave(profile: Profile) -> tuple[int, float] | None:
    """Return n and the factor of A for which a profile is a paraboloid with one cosine wave of length lambda/n.

    None where it is not. A is over the wavelength, so that a wave n times shorter has an A n times as large.
    """
    rows = rows_of(profile)
    if profile.exponent != 2.0 or len(rows) > 1:
        return None
    if len(rows) == 0:
        return 1, 0.0
    n, even, odd = rows[0].tolist()
    return (int(n), n * even) if even > 0.0 and odd == 0.0 else None


def starts_downwards(parameters: Mapping[str, ArrayLike], profile: Profile) -> NDArray[np.bool_]:
    """Report which punches are lower beside their tip than at it, so that contact without adhesion starts by a jump."""
    wavelength, amplitude = (np.asarray(parameters[name], dtype=float) for name in ("lambda_over_R", "A"))
    m = profile.exponent
    tip = 2.0 * np.pi * amplitude * sum(wave.n * wave.sin for wave in profile.harmonics) + (m == 1.0)
    bow = 2.0 * np.pi**2 * amplitude / wavelength * sum(wave.n**2 * wave.cos for wave in profile.harmonics)
    bow = bow + (0.5 if m == 2.0 else np.inf if 1.0 < m < 2.0 else 0.0)
    return np.asarray((tip < 0.0) | ((tip == 0.0) & (bow < 0.0)))
