"""What an edge that opens at a larger work of adhesion than it closes at adds to a cycle, in closed form.

With w_o = dgamma the work of opening, Gamma = w_c/w_o that of closing over it, and a_t the radius at which the edge
turns, the edge itself takes up pi a_t^2 (w_o - w_c) in every cycle, beside what its jumps lose. Where loading ends the
contact is pinned: in depth the two curves are (1 - sqrt(Gamma)) Delta(a_t) apart, Delta(a) = s a^((1-k)/2) being what
adhesion at w_o adds to the depth, and a machine of stiffness S goes 1 + K a^(1+k)/S times as far (docs/theory.md).
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.prepared import prepared
from gradhesion.core.problem.control import Loading


def front_energy(ratio: NDArray[np.float64], radius: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what the edge takes up in R^2 dgamma, of closing ratios and radii a_t/R that broadcast; 0 at ratio 1."""
    with np.errstate(invalid="ignore"):  # infinite radii at ratio 1
        return np.where(ratio == 1.0, 0.0, np.pi * radius * radius * (1.0 - ratio))


def adhesive_depth(
    parameters: Mapping[str, ArrayLike], loading: Loading, radius: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return Delta/R at the radii a/R of scenes, and K a^(1+k)/S there: 0 under displacement control, inf under load.

    `parameters` are those of `solve` of core/sweep.py; radii of 0 have Delta of 0 (1 - k > 0) and no spring. All have
    the broadcast shape.
    """
    scenes = prepared(parameters, loading)
    shape = np.broadcast_shapes(scenes.shape, radius.shape)
    k, stretch, compliance = (
        np.broadcast_to(scenes.of_each(values).reshape(scenes.shape), shape)
        for values in (scenes.k, scenes.stretch, scenes.compliance)
    )
    with np.errstate(all="ignore"):
        spring = np.where(compliance == 0.0, 0.0, compliance * radius ** (1.0 + k))
        return stretch * radius ** (0.5 * (1.0 - k)), spring


def pinned_depth(
    parameters: Mapping[str, ArrayLike], loading: Loading, ratio: NDArray[np.float64], radius: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far, in R, the depth or the far end of a machine moves back before the edge opens; 0 at ratio 1.

    Under a load it is the depth. Arguments are as those of `adhesive_depth` and `front_energy`.
    """
    depth, spring = adhesive_depth(parameters, loading, radius)
    with np.errstate(all="ignore"):
        apart = (1.0 - ratio) / (1.0 + np.sqrt(ratio)) * depth * (1.0 if loading.control == "load" else 1.0 + spring)
    return np.where((ratio == 1.0) | (radius == 0.0), 0.0, apart)
