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

from gradhesion.core.cycle.disc import profile_of
from gradhesion.core.problem.material import theta_slopes
from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN, SENSITIVITIES, TURNS
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import AT_A_LOAD, Punch
from gradhesion.core.scenes.requests import Request, Wanted, columns_of, punch_of, run_parts, scenes_by_exponent
from gradhesion.core.scenes.tables import Tables, long_table, near_tables, rooms_for, solve_far
from gradhesion.core.scenes.tasks import in_groups
from gradhesion.core.slopes.derivatives import (
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
    UNIT,
    near_of,
    solve_slopes,
)
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.filling import width_of
from gradhesion.core.table.layout import EXACT, GEOMETRIC, Y, span_of
from gradhesion.core.types import Floats

_ALL_ROWS: Final = UNIT + 1
FURTHER: Final = ("machine_stiffness", *TURNS, CLOSING, *PATTERN)
"""Parameters beyond the seven, in the order of the last axis."""
_MOST_BINS: Final = 26_000
"""Bins of a table at most, of which there are five: 3,250 waves."""


def _near(
    punch: Punch, wanted: Wanted, profile: Floats, finer: int, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Store the derivatives of near scenes of one fineness of bins."""
    patterned = punch.rows.shape[1] > 0
    with near_tables(punch, EXACT, finer, math.nan) as tables:  # neighbours need a basis of all exponents
        none, bins = tables.long, tables.basis.values.shape[0] - 1
        nodes, polys = (np.stack([room] * 4) for room in room_of(bins))
        nodes[:, Y] = tables.basis.fixed[0, : bins + 1]  # a table ends where its last bin does, filled or not
        rooms = rooms_for(bins if patterned else 0, patterned)
        near, four = near_of(tables.basis, rooms, bins), (none, none, none, none)
        solve_slopes(punch, wanted, tables, near, four, nodes, polys, profile, scenes, reduced, out)


def _far(
    punch: Punch, wanted: Wanted, profile: Floats, finer: int, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Store the derivatives of scenes of one exponent that reach beyond near tables.

    Those of more waves than _MOST_BINS holds have none: here sums over waves would take over.
    """
    patterned = punch.rows.shape[1] > 0
    within = np.flatnonzero(reduced[at.NEED] <= (_MOST_BINS - GEOMETRIC) * width_of(punch.waves, finer))

    def solve(tables: Tables, own: Floats, numbers: Floats, found: Floats) -> None:
        """Store those of scenes within a long table, on tables of neighbouring exponents as long."""
        k, y_end, bins = tables.long.k, span_of(tables.long), tables.long.bins
        long = [long_table(punch, k + STEP * place, EXACT, finer, y_end)[0] for place in PLACES]
        nodes, polys = (np.stack([room] * 4) for room in room_of(0))
        rooms = rooms_for(bins if patterned else 0, patterned)
        near, four = near_of(tables.basis, rooms, bins), (long[0], long[1], long[2], long[3])
        solve_slopes(punch, wanted, tables, near, four, nodes, polys, profile, own, numbers, found)

    if within.size:
        found = np.empty((len(out), within.size))
        solve_far(punch, EXACT, finer, scenes[:, within], reduced[:, within], found, solve, _MOST_BINS)
        out[:, within] = found


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
    punch, profile = punch_of(request), profile_of(request.waves)
    of_energy = SENSITIVITIES[1] in outputs
    wanted = Wanted(cycle=of_energy, depth=False, contact=False, residual=False, saturation=False)
    columns, count = columns_of(request)
    names = [*PARAMETERS, *(name for name in FURTHER if name in given)]
    found = {name: np.empty((count, len(names))) for name in outputs}

    def work(first: int, last: int) -> None:
        """Fill a part of the scenes."""
        scenes, places = scenes_by_exponent(columns, first, last)
        near, far = partial(_near, punch, wanted, profile), partial(_far, punch, wanted, profile)
        out, _ = in_groups(punch, EXACT, scenes, _ALL_ROWS, near, far)
        with np.errstate(all="ignore"):  # what has no value has no sensitivity
            material = _material_slopes(scenes[at.K], scenes[at.NU], punch.exponent)
            for output in outputs:
                of_force = output == SENSITIVITIES[0]
                by = out[FORCE : FORCE + ROWS] if of_force else out[ENERGY : ENERGY + ROWS]
                slopes = _by_parameter(punch, scenes, out[UNIT], by, material, of_force=of_force)
                rows = np.array([slopes[name] for name in names])
                has_value = np.isfinite(by[OF_POWER])
                found[output][places] = np.where(has_value & np.isfinite(rows), rows + 0.0, np.nan).T  # no -0

    run_parts(count, work, threads)
    return {name: values.reshape(*request.shape, len(names)) for name, values in found.items()}
