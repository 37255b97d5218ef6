"""Sensitivities of pull-off force and dissipated energy to the parameters of scenes.

    d ln(value)/d ln p,    for k and nu, which may be 0, d ln(value)/dp

They follow by the chain rule from the derivatives by the reduced numbers of a scene (derivatives.py).
"""

import math
from collections.abc import Sequence
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import psi

from gradhesion.core.problem.material import theta_slopes
from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN, SENSITIVITIES, TURNS
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scenes import results
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import AT_A_LOAD, Punch
from gradhesion.core.scenes.requests import Places, Request, Wanted, run_parts
from gradhesion.core.scenes.tables import Tables, ends_of_exponents, long_table, rooms_for
from gradhesion.core.scenes.tasks import solve_groups
from gradhesion.core.slopes.derivatives import (
    ALL_ROWS,
    ENERGY,
    FORCE,
    OF_EXPONENT,
    OF_MACHINE,
    OF_PATTERN,
    OF_PATTERN_WAVES,
    OF_POWER,
    OF_RATIO,
    OF_RIM,
    OF_TARGET,
    OF_WAVES,
    PLACES,
    ROWS,
    STEP,
    Near,
    solve_slopes,
)
from gradhesion.core.slopes.frozen import OBSERVED
from gradhesion.core.table.basis import NOTHING_KEPT, kept_for, make_known
from gradhesion.core.table.layout import EXACT, span_of
from gradhesion.core.types import Floats

FURTHER: Final = ("machine_stiffness", *TURNS, CLOSING, *PATTERN)
"""Parameters beyond the seven, in the order of the last axis."""
_MOST_BINS: Final = 26_000
"""Bins of a table at most, of which there are five: 3,250 waves."""


def _solve(punch: Punch, wanted: Wanted, tables: Tables, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Store the derivatives of scenes on near tables, or on a long one and four of neighbouring exponents as long.

    Those of more waves than _MOST_BINS holds have none: here sums over waves would take over. Near tables of a long
    series have one exponent alone: its scenes are left for long ones.
    """
    long, patterned = tables.long, punch.rows.shape[1] > 0
    bins, four, kept = long.bins, [long] * 4, NOTHING_KEPT
    if bins > 0:
        made = (long_table(punch, long.k + STEP * place, EXACT, tables.finer, span_of(long)) for place in PLACES)
        four = [table for table, _, _ in made]
    elif tables.basis.k.size > 1:
        bins, kept = tables.basis.values.shape[0] - 1, kept_for(tables.basis, len(PLACES))
        least, greatest = ends_of_exponents(scenes[at.K])
        make_known(tables.basis, least + STEP * PLACES[0], greatest + STEP * PLACES[-1])
    else:
        out[results.STATUS] = np.where(reduced[at.VALID] > 0.0, results.SHORT, NO_VALUE)
        return
    scene, numbers = np.empty((at.PARAMETER_ROWS, 1)), np.empty((at.REDUCED_ROWS, 1))
    rooms = rooms_for(bins if patterned else 0, patterned)
    near = Near(kept, rooms, scene, numbers, np.zeros((ROWS, OBSERVED)), np.zeros(OBSERVED))
    solve_slopes(punch, wanted, tables, near, (four[0], four[1], four[2], four[3]), scenes, reduced, out)


def _material_slopes(k: Floats, nu: Floats, m: float) -> tuple[Floats, Floats, Floats]:
    """Return d ln theta/dk, d ln theta/dnu and d ln(depth factor of r^m/m)/dk; these, `k` and `nu` are (scenes,).

    A run of neighbours of the same k and nu is computed once.
    """
    start = np.flatnonzero(np.append(True, (k[1:] != k[:-1]) | (nu[1:] != nu[:-1])))
    times, half = np.diff(np.append(start, k.size)), 0.5 * (1.0 + k[start])
    slopes = (*theta_slopes(k[start], nu[start]), 0.5 * (psi(half) - psi(half + 0.5 * m)))
    by_k, by_nu, factor = (np.repeat(slope, times) for slope in slopes)
    return by_k, by_nu, factor


def _by_parameter(
    punch: Punch, scenes: Floats, length: Floats, by: Floats, material: tuple[Floats, Floats, Floats], *, of_force: bool
) -> dict[str, Floats]:
    """Return the sensitivities of a value by parameter, (scenes,) each, from those to reduced numbers, (ROWS, scenes).

    `length` is the unit l of length in R, `material` what `_material_slopes` returns. The units of depth, load and
    energy are, with M = theta modulus c0^-k, s = sqrt(2^(1+k) pi/M), K = 2^(1-k) M/(1+k) and eta = (1-k)/2,

        s l^eta,    K s l^(1+k+eta),    l^2
    """
    k, m, half = scenes[at.K], punch.exponent, 0.5 * np.log(0.5 * length)
    eta, smooth = 0.5 * (1.0 - k), scenes[at.AMPLITUDE] == 0.0
    theta_by_k, theta_by_nu, factor = material

    def unit(stiffness: float, power: ArrayLike, by_k: ArrayLike) -> Floats:
        """Return how a unit changes by ln M, ln l and k, (3, scenes)."""
        return np.stack(np.broadcast_arrays(stiffness, power, by_k, k)[:3])

    depth, load = unit(-0.5, eta, -half), unit(0.5, 1.0 + k + eta, half - 1.0 / (1.0 + k))
    total = load if of_force else unit(0.0, 2.0, 0.0)
    total = total + by[OF_POWER] * (unit(0.0, m, factor) - depth) + by[OF_WAVES] * (unit(0.0, 1.0, 0.0) - depth)
    total += by[OF_MACHINE] * (load - depth) - by[OF_TARGET] * (load if punch.turn == AT_A_LOAD else depth)
    total += unit(0.0, by[OF_PATTERN_WAVES] - by[OF_RIM], by[OF_EXPONENT])
    stiffness, wavelength, exponent = total
    found = {
        "k": exponent + stiffness * (theta_by_k - np.log(scenes[at.C0])),
        "nu": stiffness * theta_by_nu,
        "modulus": stiffness - by[OF_MACHINE],  # a machine's stiffness is over that of the half-space
        "c0_over_R": np.where(k == 0.0, 0.0, -k * stiffness),
        "lambda_over_R": np.where(smooth, 0.0, wavelength),
        "A": np.where(smooth, 0.0, by[OF_WAVES]),
        "a_max_over_R": np.where(np.isinf(scenes[at.RIM]), 0.0, by[OF_RIM]),
        "machine_stiffness": -by[OF_MACHINE],
        CLOSING: np.where(scenes[at.RATIO] == 0.0, 0.0, by[OF_RATIO]),
        PATTERN[0]: -by[OF_PATTERN_WAVES],
        PATTERN[1]: by[OF_PATTERN],
    }
    return found | dict.fromkeys(TURNS, by[OF_TARGET])


def sensitivities(
    request: Request, outputs: Sequence[str], given: Sequence[str], threads: int | None
) -> dict[str, NDArray[np.float64]]:
    """Return sensitivities among `outputs`, arrays of the shape (*request.shape, parameters).

    The last axis has the parameters of `PARAMETERS`, and those of `FURTHER` that are `given`, in this order. NaN where
    the value is not positive or has no bound, for nu at k = 1, and for the closing ratio of the energy of an unbounded
    punch that does not turn.
    """
    punch, of_energy = request.punch, SENSITIVITIES[1] in outputs
    wanted = Wanted(cycle=of_energy, contact=False, residual=False, saturation=False)
    names = [*PARAMETERS, *(name for name in FURTHER if name in given)]
    found = {name: np.empty((math.prod(request.shape), len(names))) for name in outputs}

    def work(scenes: Floats, places: Places) -> None:
        """Fill a part of the scenes."""
        out = np.full((ALL_ROWS, scenes.shape[1]), np.nan)
        reduced = solve_groups(punch, EXACT, scenes, out, partial(_solve, punch, wanted), most_bins=_MOST_BINS)
        with np.errstate(all="ignore"):  # what has no value has no sensitivity
            material = _material_slopes(scenes[at.K], scenes[at.NU], punch.exponent)
            for output in outputs:
                of_force = output == SENSITIVITIES[0]
                by = out[FORCE : FORCE + ROWS] if of_force else out[ENERGY : ENERGY + ROWS]
                slopes = _by_parameter(punch, scenes, reduced[at.LENGTH], by, material, of_force=of_force)
                rows = np.array([slopes[name] for name in names])
                has_value = np.isfinite(by[OF_POWER])
                found[output][places] = np.where(has_value & np.isfinite(rows), rows + 0.0, np.nan).T  # no -0

    run_parts(request, work, threads)
    return {name: values.reshape(*request.shape, len(names)) for name, values in found.items()}
