"""The curve of the smooth punch, A = 0."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves.equilibrium import draw_named
from gradhesion.core.curves.subject import Subject


def smooth_places(k: float, pulls: Sequence[float], end: float) -> NDArray[np.float64]:
    """Return where smooth punches of some pulls turn and where they are at zero depth, in order, before an end.

    d depth/dz = 0 at X = pull (1-k)/2, d load/dz = 0 at X = pull (3+k)/2, and depth = 0 at X = 2 pull.
    """
    abscissas = [max(0.0, pull) * level for pull in pulls for level in (0.5 * (1.0 - k), 2.0, 0.5 * (3.0 + k))]
    places = np.unique(np.array(abscissas) ** (2.0 / (3.0 + k)))
    kept: NDArray[np.float64] = places[(places > 0.0) & (places < end)]
    return kept


def draw_smooth(subject: Subject) -> dict[str, NDArray[np.float64]]:
    """Return the curve of the same punch without waviness, over the range of the scene's other curves.

    Parameters
    ----------
    subject
        Any scene.

    Returns
    -------
    The variables `smooth_...` (draw.CURVES).
    """
    form = subject.plain(1.0)
    places = smooth_places(subject.k, (1.0,), subject.end / form.radius_scale)
    return draw_named(subject, form, places, "smooth")
