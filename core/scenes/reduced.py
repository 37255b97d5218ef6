"""From the parameters of scenes to the few numbers of their curves.

With l = lambda/2 pi and s = sqrt(2^(1+k) pi dgamma/M), lengths are in l, depths in s l^((1-k)/2), the stretch at y = 1,
and loads in K l^(1+k) times that:

    B = depth factor l^m/(s l^((1-k)/2)),   g = A lambda/(s l^((1-k)/2)),   by_load = K l^(1+k)/S through a machine
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.borrowed import borrowed
from gradhesion.core.cycle.turning import turning_reach
from gradhesion.core.jit import kernel
from gradhesion.core.problem.material import theta_of
from gradhesion.core.table.basis import Basis, between
from gradhesion.core.types import Floats

# Rows of parameters, (rows, scenes); those that a study may leave out have what stands beside them.
K, NU, MODULUS, C0, WAVELENGTH, AMPLITUDE, RIM = range(7)
STIFFNESS, TARGET, RATIO, PATTERN_WAVELENGTH, PATTERN_AMPLITUDE = range(7, 12)
# inf; depth or load at which the cycle turns, 0; closing over opening, 1; 1; 1
PARAMETER_ROWS: Final = 12

# Rows of reduced numbers, (rows, scenes).
BY_POWER, BY_WAVES, BY_DEPTH, BY_LOAD, LENGTH, DEPTH, LOAD = range(7)
# B; g; weights of depth and load; units of length in R, of depth in R, of load in R dgamma
RIM_Y, TARGET_VALUE, CLOSING = 7, 8, 9
# the rim; the target in its unit; w_c/w_o
WINDOW, PULL, FAR, NEED = range(10, 14)
# radii: beyond the first no fold; the pull-off within the second; the table must reach to the third without a rim, to
# the last with it
PATTERN_WAVES, MOST, STEEP, EXPONENT, VALID = range(14, 19)
# waves of the pattern in one of the profile; bounds of kappa and its slope; k; 1 if the scene can have a value, else 0
REDUCED_ROWS: Final = 19

DISPLACEMENT, AT_LOAD, MACHINE = range(3)
"""What is prescribed."""
AT_RIM, AT_DEPTH, AT_A_LOAD = range(3)
"""Where a cycle turns."""
LEAST_RATIO: Final = 2.0**-120
"""Closing ratios below are 0: sqrt of it is below rounding."""
UNIT_OF_FORCE: Final = 1.0 / (1.5 * math.pi)
_LEAST: Final = 1e-8
"""Least radius, in 1/(2 pi) of the shortest wave: tables begin at 6e-9 (table/layout.py)."""
_BEYOND: Final = 25.0
"""Radii, in 1/(2 pi) of a wavelength, that are added to what an envelope says."""


class Punch(NamedTuple):
    """What all scenes of a call share.

    exponent    m of the punch r^m/(m R^(m-1))
    waves       its harmonics, rows (n, cos, sin)
    control     DISPLACEMENT, AT_LOAD or MACHINE
    turn        AT_RIM, AT_DEPTH or AT_A_LOAD
    rows        the harmonics of the pattern of toughness, (2, highest); (2, 0) without one
    of_work     whether they multiply the work of adhesion
    """

    exponent: float
    waves: Floats
    control: int
    turn: int
    rows: Floats
    of_work: bool


@kernel
def depth_factor_of(k: float, m: float) -> float:
    """Return G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)), the depth of r^m/m over a^m."""
    if m == 2.0:
        return 1.0 / (1.0 + k)
    log = math.lgamma(0.5 * m) + math.lgamma(0.5 * (1.0 + k)) - math.lgamma(0.5 * (1.0 + k + m))
    if m < 40.0:
        return 0.5 * math.gamma(0.5 * m) * math.gamma(0.5 * (1.0 + k)) / math.gamma(0.5 * (1.0 + k + m))
    return 0.5 * math.exp(log)


@kernel
def crest_of(k: float, waves: Floats) -> float:
    """Return a bound of |U - mean| over y^((1-k)/2), 5 % more than the sum of the leading terms."""
    size = 1.05 * 2.0 ** (0.5 * (k - 1.0)) * math.gamma(0.5 * (1.0 + k))
    total = 0.0
    for h in range(len(waves)):
        total += size * waves[h, 0] ** (0.5 * (1.0 - k)) * math.hypot(waves[h, 1], waves[h, 2])
    return total


@kernel
def mean_of(waves: Floats) -> float:
    """Return a bound of the part of U that has no waves."""
    total = 0.0
    for h in range(len(waves)):
        total += math.hypot(waves[h, 1], waves[h, 2])
    return total


@kernel
def reduce_scene(punch: Punch, scenes: Floats, i: int, theta: float, depth_factor: float, reduced: Floats) -> None:
    """Fill the units, sizes and targets of scene i, of a given theta and depth factor."""
    k, m = scenes[K, i], punch.exponent
    eta = 0.5 * (1.0 - k)
    M = theta * scenes[MODULUS, i] / scenes[C0, i] ** k
    stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / M)
    length = scenes[WAVELENGTH, i] / (2.0 * math.pi)
    if scenes[AMPLITUDE, i] == 0.0 and punch.rows.shape[1] == 0:  # no wave gives a length: that at which B is 1
        length = (stretch / depth_factor) ** (1.0 / (m - eta))
    depth = stretch * length**eta
    load = 2.0 ** (1.0 - k) * M / (1.0 + k) * length ** (1.0 + k) * depth
    reduced[BY_POWER, i] = depth_factor * length**m / depth
    reduced[BY_WAVES, i] = scenes[AMPLITUDE, i] * scenes[WAVELENGTH, i] / depth
    reduced[LENGTH, i], reduced[DEPTH, i], reduced[LOAD, i] = length, depth, load
    reduced[BY_DEPTH, i], reduced[BY_LOAD, i] = 1.0, 0.0
    if punch.control == AT_LOAD:
        reduced[BY_DEPTH, i], reduced[BY_LOAD, i] = 0.0, 1.0
    elif punch.control == MACHINE:
        reduced[BY_LOAD, i] = load / depth / (scenes[STIFFNESS, i] * scenes[MODULUS, i])
    unit = depth if punch.turn == AT_DEPTH else load * UNIT_OF_FORCE
    reduced[TARGET_VALUE, i] = scenes[TARGET, i] / unit
    reduced[CLOSING, i] = max(scenes[RATIO, i], LEAST_RATIO) if scenes[RATIO, i] >= 0.0 else math.nan
    reduced[PATTERN_WAVES, i] = scenes[WAVELENGTH, i] / scenes[PATTERN_WAVELENGTH, i]
    reduced[EXPONENT, i] = k


@kernel
def fill_reach(punch: Punch, i: int, crest: float, steepest: float, mean: float, reduced: Floats) -> None:
    """Fill how far scene i must be known without its rim: `crest` and `steepest` bound U and -U' over y^((1-k)/2)."""
    k, m = reduced[EXPONENT, i], punch.exponent
    B, g, most = reduced[BY_POWER, i], reduced[BY_WAVES, i], reduced[MOST, i]
    eta = 0.5 * (1.0 - k)
    of_load = 0.5 * (3.0 + k) / m  # the lowest load of the envelope is where B y^(m - eta) = crest (3+k)/(2 m)
    front = (most + g * crest) / B
    # a smooth punch lands where B y^(m - eta) is 1 at the depth 0, and (1+k+m)/m at the load 0
    landing = 1.0 if punch.control == DISPLACEMENT else (1.0 + k + m) / m
    smooth = (front * max(landing, of_load)) ** (1.0 / (m - eta)) * 1.2 + _BEYOND
    reduced[PULL, i] = (front * of_load) ** (1.0 / (m - eta)) * 1.2 + 20.0
    steep, power = g * steepest + reduced[STEEP, i], m - 1.0 - eta
    window = math.inf
    if steep == 0.0:
        window = 0.0
    elif power > 0.0:
        window = (steep / (B * m)) ** (1.0 / power) * 1.15 + 60.0
    elif power == 0.0 and steep < B * m:
        window = 60.0
    reduced[WINDOW, i] = max(smooth, window)
    reduced[FAR, i] = reduced[WINDOW, i]
    if punch.turn != AT_RIM:
        root = math.sqrt(reduced[CLOSING, i])
        target = max(reduced[TARGET_VALUE, i], 0.0)
        far = turning_reach(k, m, B, root * most + g * crest, g * mean, target, punch.turn == AT_A_LOAD)
        reduced[FAR, i] = max(far, reduced[PULL, i])


@kernel
def fill_rim(punch: Punch, scenes: Floats, i: int, reduced: Floats) -> None:
    """Fill what depends on the rim of scene i; the rest of its numbers is known."""
    rim, far = scenes[RIM, i] / reduced[LENGTH, i], reduced[FAR, i]
    if punch.turn == AT_RIM and punch.rows.shape[1] > 0 and rim < math.inf:
        far = max(far, rim)  # beyond its table an interface with a pattern is not known
    reduced[RIM_Y, i], reduced[NEED, i] = rim, min(far, rim)
    reduced[VALID, i] = 1.0 if _is_valid(punch, scenes, reduced, i) else 0.0


@kernel
def _differs_in_rim_alone(scenes: Floats, i: int, j: int) -> bool:
    """Return whether two scenes have all parameters but the rim in common."""
    same, row = True, 0
    while same and row < PARAMETER_ROWS:
        same = row == RIM or scenes[row, i] == scenes[row, j]
        row += 1
    return same


@kernel
def _is_valid(punch: Punch, scenes: Floats, reduced: Floats, i: int) -> bool:
    """Return whether all parameters of scene i are in their ranges, and its contact is not too small for tables."""
    sizes = 0.0 < scenes[MODULUS, i] < math.inf and 0.0 < scenes[C0, i] < math.inf
    sizes = sizes and 0.0 < scenes[WAVELENGTH, i] < math.inf and 0.0 <= scenes[AMPLITUDE, i] < math.inf
    edge = 0.0 <= scenes[RATIO, i] <= 1.0 and scenes[RIM, i] > 0.0
    edge = edge and 0.0 < scenes[PATTERN_WAVELENGTH, i] < math.inf
    target = math.isfinite(scenes[TARGET, i]) and (punch.turn != AT_A_LOAD or scenes[TARGET, i] > 0.0)
    machine = punch.control != MACHINE or 0.0 < scenes[STIFFNESS, i] < math.inf
    known = 0.0 < reduced[BY_POWER, i] < math.inf and reduced[MOST, i] > 0.0
    if punch.rows.shape[1] > 0:
        known = known and 0.0 < reduced[PATTERN_WAVES, i] < math.inf
    return sizes and edge and target and machine and known and not _is_below_tables(punch, reduced, i)


@kernel
def _is_below_tables(punch: Punch, reduced: Floats, i: int) -> bool:
    """Return whether the rim of scene i, or the contact that jumps out of a smooth punch, is too small for tables."""
    least, eta = _LEAST / punch.waves[:, 0].max(), 0.5 * (1.0 - reduced[EXPONENT, i])
    # d depth/dy = 0 is B m y^(m - eta) = eta; at k = 1 the contact shrinks to a point, and B y^m is compared with 1
    jump_out = eta / punch.exponent if eta > 0.0 else 1.0
    return reduced[RIM_Y, i] < least or reduced[BY_POWER, i] * least ** (punch.exponent - eta) > jump_out


@kernel
def reduce_scenes(punch: Punch, basis: Basis, scenes: Floats, reduced: Floats) -> None:
    """Fill the reduced numbers of all scenes but MOST and STEEP; neighbours share what they have in common."""
    punch, basis, scenes, reduced = borrowed((punch, basis, scenes, reduced))
    k = nu = theta = depth_factor = crest = steepest = math.nan
    mean = mean_of(punch.waves)
    for i in range(scenes.shape[1]):
        if i > 0 and punch.rows.shape[1] == 0 and _differs_in_rim_alone(scenes, i - 1, i):
            reduced[:, i] = reduced[:, i - 1]
            fill_rim(punch, scenes, i, reduced)
            continue
        if scenes[K, i] != k:
            k, nu = scenes[K, i], math.nan
            if not 0.0 <= k <= 1.0:
                theta = math.nan
            else:
                depth_factor, crest = depth_factor_of(k, punch.exponent), crest_of(k, punch.waves)
                low, high = between(basis, k)
                steepest = 1.05 * max(basis.crest[low], basis.crest[high])
        if scenes[NU, i] != nu:
            nu = scenes[NU, i]
            theta = theta_of(k, nu)
        reduce_scene(punch, scenes, i, theta, depth_factor, reduced)
        fill_reach(punch, i, crest, steepest, mean, reduced)
        fill_rim(punch, scenes, i, reduced)


def reduced_of(punch: Punch, basis: Basis, scenes: Floats, most: Floats, steep: Floats) -> Floats:
    """Return the reduced numbers of scenes, (REDUCED_ROWS, scenes); `most`, `steep` bound their patterns, (scenes,)."""
    reduced = np.empty((REDUCED_ROWS, scenes.shape[1]))
    reduced[MOST], reduced[STEEP] = most, steep
    reduce_scenes(punch, basis, scenes, reduced)
    return reduced
