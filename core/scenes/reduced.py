"""From the parameters of scenes to the few numbers of their curves.

With l = lambda/2 pi and s = sqrt(2^(1+k) pi dgamma/M), lengths are in l, depths in s l^((1-k)/2), the stretch at y = 1,
and loads in K l^(1+k) times that:

    B = depth factor l^m/(s l^((1-k)/2)),   g = A lambda/(s l^((1-k)/2)),   by_load = K l^(1+k)/S through a machine
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.cycle.disc import Disc, fill_weights
from gradhesion.core.cycle.turning import turning_reach
from gradhesion.core.jit import inlined, kernel, leaf
from gradhesion.core.problem.material import theta_of
from gradhesion.core.scenes import rows as at
from gradhesion.core.table.basis import Basis, between
from gradhesion.core.types import Floats

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
    waves       its harmonics, rows (n, cos, sin) in the order of n
    control     DISPLACEMENT, AT_LOAD or MACHINE
    turn        AT_RIM, AT_DEPTH or AT_A_LOAD
    rows        the harmonics of the pattern of toughness, (2, highest); (2, 0) without one
    of_work     whether they multiply the work of adhesion
    profile     heights of the waves, as of `profile_of`
    """

    exponent: float
    waves: Floats
    control: int
    turn: int
    rows: Floats
    of_work: bool
    profile: Floats


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
    """Return a bound of |U - mean| over y^((1-k)/2) from y = 1 on: 5 % more than the sum of the leading terms.

    `waves` are rows (n, cos, sin), U is that of table/layout.py. Nearer the centre the mean alone may be larger.
    """
    size = 1.05 * 2.0 ** (0.5 * (k - 1.0)) * math.gamma(0.5 * (1.0 + k))
    total = 0.0
    for h in range(len(waves)):
        total += size * waves[h, 0] ** (0.5 * (1.0 - k)) * math.hypot(waves[h, 1], waves[h, 2])
    return total


@leaf
def mean_of(waves: Floats) -> float:
    """Return a bound of the part of U that has no waves."""
    total = 0.0
    for h in range(len(waves)):
        total += math.hypot(waves[h, 1], waves[h, 2])
    return total


@kernel
def disc_of(punch: Punch, k: float, weights: Floats) -> Disc:
    """Return what the tests of the contact need of an exponent; `weights` is room for those of its rule, (RULE,)."""
    fill_weights(k, weights)
    crest, wave = crest_of(k, punch.waves), 2.0 * math.pi / punch.waves[-1, 0]
    bend = 1.0 / (punch.exponent * depth_factor_of(k, punch.exponent))
    return Disc(0.5 * (1.0 - k), weights, crest, mean_of(punch.waves), wave, bend, punch.profile, punch.waves)


@inlined
def reduce_scene(punch: Punch, scenes: Floats, i: int, theta: float, depth_factor: float, reduced: Floats) -> None:
    """Fill the units, sizes and targets of scene i, of a given theta and depth factor."""
    k, m = scenes[at.K, i], punch.exponent
    eta = 0.5 * (1.0 - k)
    M = theta * scenes[at.MODULUS, i] / scenes[at.C0, i] ** k
    doubled = 2.0 ** (1.0 + k)
    stretch = math.sqrt(doubled * math.pi / M)
    length = scenes[at.WAVELENGTH, i] / (2.0 * math.pi)
    if scenes[at.AMPLITUDE, i] == 0.0 and punch.rows.shape[1] == 0:  # no wave gives a length: that at which B is 1
        length = (stretch / depth_factor) ** (1.0 / (m - eta))
    lift = length**eta
    depth = stretch * lift
    load = 4.0 / doubled * M / (1.0 + k) * (length / lift) ** 2 * depth  # l^(1+k) = (l/l^eta)^2: a power is slow
    reduced[at.BY_POWER, i] = depth_factor * length**m / depth
    reduced[at.BY_WAVES, i] = scenes[at.AMPLITUDE, i] * scenes[at.WAVELENGTH, i] / depth
    reduced[at.LENGTH, i], reduced[at.DEPTH, i], reduced[at.LOAD, i] = length, depth, load
    reduced[at.BY_DEPTH, i], reduced[at.BY_LOAD, i] = 1.0, 0.0
    if punch.control == AT_LOAD:
        reduced[at.BY_DEPTH, i], reduced[at.BY_LOAD, i] = 0.0, 1.0
    elif punch.control == MACHINE:
        reduced[at.BY_LOAD, i] = load / depth / (scenes[at.STIFFNESS, i] * scenes[at.MODULUS, i])
    unit = depth if punch.turn == AT_DEPTH else load * UNIT_OF_FORCE
    reduced[at.TARGET_VALUE, i] = scenes[at.TARGET, i] / unit
    reduced[at.CLOSING, i] = max(scenes[at.RATIO, i], LEAST_RATIO) if scenes[at.RATIO, i] >= 0.0 else math.nan
    reduced[at.PATTERN_WAVES, i] = scenes[at.WAVELENGTH, i] / scenes[at.PATTERN_WAVELENGTH, i]
    reduced[at.EXPONENT, i] = k


@inlined
def _end_of_folds(punch: Punch, i: int, steep: float, reduced: Floats) -> float:
    """Return a radius beyond which scene i has no fold, inf if there may be any everywhere, 0 if there are no waves.

    There D = B m y^(m-1) - steep y^eta - q most y^(eta-1) > 0, with the largest q of D (table/layout.py): `steep`
    bounds the slope of the waves over y^eta, and MOST the toughness.
    """
    m, eta = punch.exponent, 0.5 * (1.0 - reduced[at.EXPONENT, i])
    rise, power = reduced[at.BY_POWER, i] * m, m - 1.0 - eta
    stretch = (eta if punch.control == DISPLACEMENT else 2.0 - eta) * reduced[at.MOST, i]
    if steep == 0.0:
        return 0.0
    if power < 0.0 or (power == 0.0 and steep >= rise):
        return math.inf
    if power == 0.0:
        return stretch / (rise - steep) * 1.15 + 60.0
    end = (steep / rise) ** (1.0 / power)
    if stretch > 0.1 * power * steep * end:  # it lies farther out, and farther out than the end of the stretch alone
        end = max(end, (stretch / rise) ** (1.0 / (m - eta)))
        end = ((steep + stretch / end) / rise) ** (1.0 / power)
    return end * 1.15 + 60.0


@inlined
def fill_reach(punch: Punch, i: int, crest: float, steepest: float, mean: float, reduced: Floats) -> None:
    """Fill how far scene i must be known without its rim.

    `crest` and `steepest` bound U less its mean, and -U', over y^((1-k)/2).
    """
    k, m = reduced[at.EXPONENT, i], punch.exponent
    B, g, most = reduced[at.BY_POWER, i], reduced[at.BY_WAVES, i], reduced[at.MOST, i]
    eta = 0.5 * (1.0 - k)
    of_load = 0.5 * (3.0 + k) / m  # the lowest load of the envelope is where B y^(m - eta) = crest (3+k)/(2 m)
    front = (most + g * crest) / B
    # a smooth punch lands where B y^(m - eta) is 1 at the depth 0, and (1+k+m)/m at the load 0
    landing = 1.0 if punch.control == DISPLACEMENT else (1.0 + k + m) / m
    smooth = (front * max(landing, of_load)) ** (1.0 / (m - eta)) * 1.2 + _BEYOND
    reduced[at.PULL, i] = (front * of_load) ** (1.0 / (m - eta)) * 1.2 + 20.0
    reduced[at.WINDOW, i] = max(smooth, _end_of_folds(punch, i, g * steepest + reduced[at.STEEP, i], reduced))
    reduced[at.FAR, i] = reduced[at.WINDOW, i]
    if punch.turn != AT_RIM:
        root = math.sqrt(reduced[at.CLOSING, i])
        target = max(reduced[at.TARGET_VALUE, i], 0.0)
        far = turning_reach(k, m, B, root * most + g * crest, g * mean, target, punch.turn == AT_A_LOAD)
        reduced[at.FAR, i] = max(far, reduced[at.PULL, i])


@inlined
def fill_rim(punch: Punch, scenes: Floats, i: int, least: float, reduced: Floats) -> None:
    """Fill what depends on the rim of scene i, which no table has below `least`; VALID has no regard to the rim yet."""
    rim, far = scenes[at.RIM, i] / reduced[at.LENGTH, i], reduced[at.FAR, i]
    if punch.turn == AT_RIM and punch.rows.shape[1] > 0 and rim < math.inf:
        far = max(far, rim)  # beyond its table an interface with a pattern is not known
    reduced[at.RIM_Y, i], reduced[at.NEED, i] = rim, min(far, rim)
    if not (scenes[at.RIM, i] > 0.0 and rim >= least):
        reduced[at.VALID, i] = 0.0


@inlined
def _end_of_rims(scenes: Floats, first: int) -> int:
    """Return the end of the scenes from `first` on that have all parameters but the rim in common."""
    end, same = first, True
    while same:
        end, row = end + 1, 0
        same = end < scenes.shape[1]
        while same and row < at.PARAMETER_ROWS:
            same = row == at.RIM or scenes[row, end] == scenes[row, first]
            row += 1
    return end


@inlined
def _is_valid(punch: Punch, scenes: Floats, i: int, least: float, reduced: Floats) -> bool:
    """Return whether all parameters of scene i but its rim are in their ranges, and it does not end below `least`."""
    sizes = 0.0 < scenes[at.MODULUS, i] < math.inf and 0.0 < scenes[at.C0, i] < math.inf
    sizes = sizes and 0.0 < scenes[at.WAVELENGTH, i] < math.inf and 0.0 <= scenes[at.AMPLITUDE, i] < math.inf
    edge = 0.0 <= scenes[at.RATIO, i] <= 1.0 and 0.0 < scenes[at.PATTERN_WAVELENGTH, i] < math.inf
    target = math.isfinite(scenes[at.TARGET, i]) and (punch.turn != AT_A_LOAD or scenes[at.TARGET, i] > 0.0)
    machine = punch.control != MACHINE or 0.0 < scenes[at.STIFFNESS, i] < math.inf
    known = 0.0 < reduced[at.BY_POWER, i] < math.inf and reduced[at.MOST, i] > 0.0
    if punch.rows.shape[1] > 0:
        known = known and 0.0 < reduced[at.PATTERN_WAVES, i] < math.inf
    return sizes and edge and target and machine and known and not _is_below_tables(punch, i, least, reduced)


@inlined
def _is_below_tables(punch: Punch, i: int, least: float, reduced: Floats) -> bool:
    """Return whether the contact that jumps out of a smooth punch is smaller than `least`."""
    eta = 0.5 * (1.0 - reduced[at.EXPONENT, i])
    # d depth/dy = 0 is B m y^(m - eta) = eta; at k = 1 the contact shrinks to a point, and B y^m is compared with 1
    jump_out = eta / punch.exponent if eta > 0.0 else 1.0
    return reduced[at.BY_POWER, i] * least ** (punch.exponent - eta) > jump_out


@kernel
def reduce_scenes(punch: Punch, basis: Basis, scenes: Floats, reduced: Floats) -> None:
    """Fill the reduced numbers of all scenes but MOST and STEEP; scenes that differ in the rim alone share the rest."""
    k = nu = theta = depth_factor = crest = steepest = math.nan
    mean, least = mean_of(punch.waves), _LEAST / punch.waves[-1, 0]
    i = int(np.int64(0))  # a plain 0 would be a type of its own
    while i < scenes.shape[1]:
        if scenes[at.K, i] != k:
            k, nu = scenes[at.K, i], math.nan
            if not 0.0 <= k <= 1.0:
                theta = math.nan
            else:
                depth_factor, crest = depth_factor_of(k, punch.exponent), crest_of(k, punch.waves)
                low, high = between(basis, k)
                steepest = 1.05 * max(basis.crest[low], basis.crest[high])
        if scenes[at.NU, i] != nu:
            nu = scenes[at.NU, i]
            theta = theta_of(k, nu)
        reduce_scene(punch, scenes, i, theta, depth_factor, reduced)
        fill_reach(punch, i, crest, steepest, mean, reduced)
        reduced[at.VALID, i] = 1.0 if _is_valid(punch, scenes, i, least, reduced) else 0.0
        end = i + 1 if punch.rows.shape[1] > 0 else _end_of_rims(scenes, i)
        for row in range(at.REDUCED_ROWS):
            for other in range(i + 1, end):
                reduced[row, other] = reduced[row, i]
        for other in range(i, end):
            fill_rim(punch, scenes, other, least, reduced)
        i = end


def reduced_of(punch: Punch, basis: Basis, scenes: Floats, most: Floats, steep: Floats) -> Floats:
    """Return the reduced numbers of scenes, (REDUCED_ROWS, scenes); `most`, `steep` bound their patterns, (scenes,)."""
    reduced = np.empty((at.REDUCED_ROWS, scenes.shape[1]))
    reduced[at.MOST], reduced[at.STEEP] = most, steep
    reduce_scenes(punch, basis, scenes, reduced)
    return reduced
