"""The energy of an edge that opens at a larger work of adhesion than it closes at, in closed form.

With w_o = dgamma the work of opening, Gamma = w_c/w_o that of closing over it, and a_t the radius at which the edge
turns, the edge itself dissipates (w_o - w_c) int_0^{a_t} 2 pi a kappa^2 da in every cycle, pi a_t^2 (w_o - w_c) where
its toughness kappa does not vary, besides the losses of its jumps. Where loading ends the contact is pinned: in depth
the two curves are (1 - sqrt(Gamma)) kappa Delta(a_t) apart, Delta(a) = s a^((1-k)/2) being the change of depth by
adhesion at w_o, and a machine of stiffness S moves 1 + K a^(1+k)/S times as far (docs/theory.md, section 18).
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.prepared import prepared
from gradhesion.core.problem.names import CLOSING, PATTERN

if TYPE_CHECKING:
    from gradhesion.core.sweep import How

Array = NDArray[np.float64]


def pattern_of(parameters: Mapping[str, ArrayLike]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return amplitude and wavelength of the pattern of toughness of scenes, as they are given."""
    wavelength, amplitude = (np.asarray(parameters.get(name, 1.0), dtype=float) for name in PATTERN)
    return amplitude, wavelength


def edge_area(parameters: Mapping[str, ArrayLike], how: How, radius: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the area in R^2, each part by its work of adhesion, within radii a/R that broadcast with `parameters`."""
    with np.errstate(invalid="ignore"):  # an infinite radius has an infinite area
        plain: NDArray[np.float64] = np.pi * radius * radius
        if how.toughness is None:
            return plain
        from gradhesion.core.closed.pattern import pattern_area  # noqa: PLC0415 (seldom wanted)

        return np.where(np.isfinite(radius), pattern_area(how.toughness, *pattern_of(parameters), radius), plain)


def front_energy(ratio: NDArray[np.float64], area: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the energy lost at the edge in R^2 dgamma, of closing ratios and areas that broadcast; 0 at ratio 1."""
    with np.errstate(invalid="ignore"):  # infinite areas at ratio 1
        return np.where(ratio == 1.0, 0.0, area * (1.0 - ratio))


def adhesive_depth(parameters: Mapping[str, ArrayLike], how: How, radius: Array) -> tuple[Array, Array]:
    """Return kappa Delta/R at the radii a/R of scenes, and what a machine's far end moves beside the depth over that.

    The second is K a^(1+k)/S, 0 under displacement control and under a load, whose result is the depth.
    `parameters` are those of `solve` of core/sweep.py but for the ratio; all broadcast.
    """
    others = (*PATTERN, CLOSING)
    scenes = prepared({name: value for name, value in parameters.items() if name not in others}, how.loading)
    k, stretch, compliance = (
        scenes.of_each(values).reshape(scenes.shape) for values in (scenes.k, scenes.stretch, scenes.compliance)
    )
    with np.errstate(all="ignore"):
        depth = stretch * radius ** (0.5 * (1.0 - k))
        if how.toughness is not None:
            from gradhesion.core.closed.pattern import toughness_at  # noqa: PLC0415 (seldom wanted)

            depth = depth * toughness_at(how.toughness, *pattern_of(parameters), radius)[0]
        driven = how.loading.control == "machine"
        return depth, compliance * radius ** (1.0 + k) if driven else np.zeros(())


def pinned_depth(parameters: Mapping[str, ArrayLike], how: How, ratio: Array, radius: Array) -> Array:
    """Return how far, in R, the depth or the far end of a machine moves back before the edge opens; 0 at ratio 1.

    Under a load it is the depth. Arguments are as those of `adhesive_depth`; all broadcast.
    """
    depth, spring = adhesive_depth(parameters, how, radius)
    with np.errstate(all="ignore"):
        apart = (1.0 - ratio) / (1.0 + np.sqrt(ratio)) * depth * (1.0 + spring)
    return np.where((ratio == 1.0) | (radius == 0.0), 0.0, apart)
