"""A profile in the form that kernels use: its harmonics as rows, and which punches begin to touch by a jump."""

from collections.abc import Mapping

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


def starts_downwards(parameters: Mapping[str, ArrayLike], profile: Profile) -> NDArray[np.bool_]:
    """Report which punches are lower beside their tip than at it, so that contact without adhesion starts by a jump."""
    wavelength, amplitude = (np.asarray(parameters[name], dtype=float) for name in ("lambda_over_R", "A"))
    m = profile.exponent
    tip = 2.0 * np.pi * amplitude * sum(wave.n * wave.sin for wave in profile.harmonics) + (m == 1.0)
    bow = 2.0 * np.pi**2 * amplitude / wavelength * sum(wave.n**2 * wave.cos for wave in profile.harmonics)
    bow = bow + (0.5 if m == 2.0 else np.inf if 1.0 < m < 2.0 else 0.0)
    return np.asarray((tip < 0.0) | ((tip == 0.0) & (bow < 0.0)))
