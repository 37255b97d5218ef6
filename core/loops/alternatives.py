"""Alternatives that a loop cannot tell apart: waves too fine to be seen, and unequal works of adhesion.

Waves of a strength chi that are fine against the contact act as a smooth punch that opens at the work of adhesion
(1 + chi)^2 dgamma and closes at (1 - chi)^2 dgamma: toughnesses add (docs/theory.md).
"""

from typing import Final

import numpy as np

from gradhesion.core.closed.reduced import WAYS
from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.loops.paths.model import WAVELENGTHS, Model
from gradhesion.core.loops.paths.path import LoopPath
from gradhesion.core.problem.names import CLOSING
from gradhesion.core.types import Floats

_SEEN: Final = 5.0
"""Size of a jump, in standard deviations of the noise, from which on it shows that there are waves."""
_LEAST: Final = 0.01
"""Strength of waves below which nothing is reported."""
_PHASE: Final = 0.1
"""Error of the number of waves within the contact, below which waves are resolved without jumps."""


def alternatives(model: Model, path: LoopPath, noise: Floats, spread: Floats) -> tuple[str, ...]:
    """Return a sentence on what else would explain a loop; none where the jumps decide.

    Parameters
    ----------
    model, path
        What was fitted, and the path of the best numbers.
    noise
        Standard deviations of depth and load, in m and N; shape (2,).
    spread
        Standard deviations of the numbers, as they are searched; shape (unknown,).
    """
    scene = path.scene
    if not model.has_waves:
        chi = (1.0 - scene.root) / (1.0 + scene.root)
        if chi < _LEAST or model.place_of((CLOSING, *WAYS[CLOSING])) is None:
            return ()
        sentence = (
            f"waves too fine to be seen, of chi = {chi:.3g}, would have the same effect as closing_ratio = "
            f"{scene.root**2:.3g}; a loop cannot tell the two apart"
        )
        return (sentence,)
    jumps = np.flatnonzero(path.jump)
    jumps = jumps[(path.radius[jumps] > 0.0) & (path.radius[jumps - 1] > 0.0)]
    sizes = np.hypot(*((path.places[jumps] - path.places[jumps - 1]) / noise).T)
    length = model.place_of(WAVELENGTHS)
    is_known = length is not None and spread[length] * path.radius.max() < _PHASE * scene.wavelength * scene.R
    chi = float(waviness_strength(scene.k, scene.wavelength, scene.A) / adhesion_strength(scene.k, scene.stiffness))
    if sizes.max(initial=0.0) > _SEEN or is_known or not 0.0 < chi < 1.0:
        return ()
    ratio, times = ((1.0 - chi) / (1.0 + chi)) ** 2, (1.0 + chi) ** 2
    sentence = (
        f"the waves are too fine to be seen in the noise: a smooth punch with closing_ratio = {ratio:.3g} and "
        f"{times:.4g} times the work of adhesion would have the same effect; a loop cannot tell the two apart"
    )
    return (sentence,)
