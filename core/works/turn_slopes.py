"""How the radius at which a cycle turns changes with the numbers of a scene.

At a depth, or a load, Y(a_t; p) = target, so that d ln a_t/d ln p = -(dY/d ln p)/(dY/d ln a). Y is a depth or a load of
the reduced form of curve/general.py in its unit: a product of powers of lambda and M and a function of the numbers of
the curve.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.prepared import curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Series, coordinate, curve_at, rims_of, slope
from gradhesion.core.face import measured_by
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.sensitivities.cosine_slopes import (
    BY_AMPLITUDE,
    BY_EXPONENT,
    BY_MACHINE,
    BY_RIM,
    BY_STIFFNESS,
    BY_WAVELENGTH,
    COUNT,
)
from gradhesion.core.sensitivities.general_jump_slopes import parts_of
from gradhesion.core.sensitivities.general_slopes import Sense, Sensed, sensed_by
from gradhesion.core.sensitivities.neighbours import depth_factor_by_k
from gradhesion.core.sweep import How
from gradhesion.core.types import Floats


@kernel()
def _put(basis: Basis, held: Series, own: Sensed, unit: float, x: float, i: int) -> float:
    """Store the slopes of the prescribed depth (1, 0) or load (0, 1) at rim number i, x; return its value.

    `unit` is its unit in R or in 1.5 pi R dgamma.
    """
    k, m, found = own.k, own.m, own.found[0]
    c = 0.5 * (1.0 - k)
    power, half, by_k = (2.0 - c, 0.5, own.by_k.force) if held.alpha == 0.0 else (c, -0.5, own.by_k.depth)
    value = coordinate(basis, held, x)
    bend, gain, _, exponent = parts_of(basis, held, own.change, x, 0.0)
    _, _, rate = slope(basis, held, x)
    by_rim = TWO_PI * x * rate
    found[BY_STIFFNESS, i] = unit * (half * value + 0.5 * (bend + gain))
    found[BY_WAVELENGTH, i] = unit * (power * value + (m - c) * bend + (1.0 - c) * gain - by_rim)
    found[BY_AMPLITUDE, i] = unit * gain
    found[BY_RIM, i] = unit * by_rim
    found[BY_EXPONENT, i] = unit * (exponent + own.by_k.bend * bend + own.by_k.gain * gain + by_k * value)
    found[BY_EXPONENT, i] += own.size * found[BY_STIFFNESS, i]
    found[BY_MACHINE, i] = 0.0
    return unit * value


@kernel()
def fill_slopes(basis: Basis, curves: GeneralCurves, sense: Sense, by_load: bool, values: Floats) -> None:
    """Put the slopes of depths or loads at the rims of curves where `sense` has them, and their values.

    Slopes by ln of M, lambda, A and a, and by k, are in R or 1.5 pi R dgamma, as `values` of shape (curves, rims).
    """
    for i in curves.numbers:
        made = curve_at(basis, curves, i)
        waves = Basis(basis.table, made.cosine_bins, made.series)
        own, held, rims = sensed_by(sense, curves, made, i), measured_by(made.curve, by_load), rims_of(curves, i)
        scale = force_unit(basis.table.k, made.length, made.depth) if by_load else made.depth
        for rim in range(rims.size):
            values[i, rim] = _put(waves, held, own, scale, rims[rim] / made.wavelength, rim)


def turn_slopes(
    scenes: Mapping[str, ArrayLike], by_load: bool, how: How
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the depth in R, or the load in 1.5 pi R dgamma, at a_max of scenes, and its slopes.

    These are by ln of M, lambda, A and a_max, by k at fixed M, and by ln of the machine's stiffness, of shape
    (6, *scenes); the values have the broadcast shape.
    """
    m, found = how.profile.exponent, prepared(scenes, how.loading)
    series, curves_at = curves_of(found, how.profile)
    values = np.full((found.k.size, found.rim.shape[1]), np.nan)
    slopes = np.full((1, COUNT, *values.shape), np.nan)

    def work(exponent: float, index: NDArray[np.int64], _: bool) -> None:
        basis = Basis(*tables_of(exponent, series, interpolated=False), series)
        change, by_k = changes_of(exponent, series), depth_factor_by_k(exponent, m)
        sense = Sense(change, by_k, exponent, m, slopes, True, 0, True)
        fill_slopes(basis, curves_at(exponent, index), sense, by_load, values)

    run_by_exponent(found.k, work, how.threads, found.rim.shape[1])
    return values.reshape(found.shape), slopes[0].reshape((COUNT, *found.shape))
