"""From a gradient exponent to its table, and the universal pair for arrays.

Accuracy: on 7,676 reference points of twelve k (0, 1e-8, ..., 1 - 1e-8, 1; a/lambda from 1e-100 to 1e6) the error of
each of the four functions is at most 1.0e-15 of the larger of the function and its local amplitude.
"""

import math
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.struve import arches, bins, fractional, jump_tail, large, moments, theta
from gradhesion.core.struve.layout import TABLE
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.power import build_power
from gradhesion.core.types import Floats, Table


@kernel()
def fill_constants(table: Table, k: float) -> None:
    """Fill the constants of the amplitude and the phase."""
    table.k = k
    gamma = math.gamma(0.5 * (k + 1.0))
    amplitude = 2.0 ** (0.5 * (k - 1.0)) * gamma
    table.gamma, table.amplitude = gamma, amplitude
    table.phase = 0.25 * math.pi * (1.0 + k)
    # cos(phi) and sin(phi) through cos and sin of k pi/4: no rounding of 1 + k
    cosine, sine = math.cos(0.25 * math.pi * k), math.sin(0.25 * math.pi * k)
    table.cos_phase = math.sqrt(0.5) * amplitude * (cosine - sine)
    table.sin_phase = math.sqrt(0.5) * amplitude * (cosine + sine)


@kernel(entry=True)
def _fill(
    table: Table,
    k: float,
    economisation: Floats,
    nodes: Floats,
    fit: Floats,
    moment_economisation: Floats,
    theta_nodes: Floats,
    theta_fit: Floats,
) -> None:
    """Fill the table of k; matrices, nodes and fits are those of bins.py, large.py, moments.py and theta.py."""
    fill_constants(table, k)
    table.rounding = 1.0
    bins.build_bins(k, table.bins, economisation)
    large.build_tail(k, table.tail, nodes, fit)
    build_power(k, table.power_mantissa, table.power_exponent)
    moments.build_moments(table, moment_economisation)
    jump_tail.build_jump_tail(table, nodes, fit)
    arches.build_arches(table)
    fractional.build_fractional(k, table.fractional)
    theta.build_theta(k, table.theta, theta_nodes, theta_fit)
    table.theta_front = theta.front_of(k)


def build_table(k: float) -> Table:
    """Return the table of the gradient exponent 0 <= k <= 1, one record of layout.TABLE."""
    table = np.zeros(1, dtype=TABLE)[0]
    of_bins = (bins.ECONOMISATION, large.NODES, large.FIT, moments.ECONOMISATION)
    _fill(table, float(k), *of_bins, theta.NODES, theta.FIT)
    return table


_kept: Final = lru_cache(maxsize=16)(build_table)
"""Kept for repeated calls with a few points: building a table takes as long as 40,000 points."""


@kernel(entry=True)
def _pairs(table: Table, x: Floats, out: Floats) -> None:
    """Put S0, S1, S0' and S1' at each x (n,) into the rows of `out`, of shape (4, n)."""
    for i in range(x.size):
        out[0, i], out[1, i], out[2, i], out[3, i] = pair(table, x[i])


def struve_pair(k: float, x: ArrayLike) -> NDArray[np.float64]:
    """Return S0, S1, dS0/dz and dS1/dz at z = 2 pi x.

    Parameters
    ----------
    k
        Gradient exponent, 0 to 1.
    x
        Contact radius over wavelength, 0 <= x < 2**49, any shape.

    Returns
    -------
    Array of shape (4, *x.shape).

    Examples
    --------
    At k = 1 the first function is (1 - cos z)/z:

    >>> struve_pair(1.0, 0.25).round(6).tolist()
    [0.63662, 0.342075, 0.231335, 0.157255]
    """
    points = np.asarray(x, dtype=float)
    out = np.empty((4, points.size))
    _pairs(_kept(float(k)), points.ravel(), out)
    return out.reshape(4, *points.shape)
