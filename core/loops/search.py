"""Where a fit starts, near the curve of a smooth punch, then of waves, then of speeds; and the minima next to that.

Smooth: contact points over all depths of the data, some works of adhesion with each, and the modulus that gives the
largest load. Waves: the residual of a smooth punch is periodic in the contact radius; the peaks of its spectrum, then
wavelengths over the whole range, each with some amplitudes, are refined in everything else, until one leaves no more
than noise.
"""

import itertools
import math
from collections.abc import Mapping
from operator import attrgetter
from typing import Any, Final

import numpy as np

from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.loops.fitted import DEPTH_ZERO, LOAD_ZERO, OFFSETS
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import AMPLITUDES, SPEEDS, TURN, WAVELENGTHS, WAVES
from gradhesion.core.types import Floats

COST: Final = attrgetter("cost")
_FEW: Final = 140  # points that starts are compared with
_WORK: Final = "work_of_adhesion"
_MODULI: Final = ("E_star", "E", "modulus")
_CONTACTS: Final = 12  # contact points that are tried, beside the end of the base line
_WORKS: Final = 3  # works of adhesion that are tried with each
_KEPT: Final = 8  # starts of a smooth punch that are refined
_HEIGHTS: Final = 3  # amplitudes that are tried with each wavelength
_PEAKS: Final = 6  # peaks of the spectrum that are tried
_BESIDE: Final = 2  # peaks that are tried with a third of a wave more, and less, within the contact
_PER_WAVE: Final = 3.0
"""Wavelengths tried, over the number of waves by which the shortest and the longest differ within the contact."""
_LEAST, _MOST = 8, 14  # how many they are at least and at most
_LONG: Final = 16
"""Wavelengths tried beside these, evenly by their logarithm: of long waves, few of which are in the contact."""
_ALIKE: Final = 0.05  # parts of the ranges within which two smooth curves share one search for waves
_HELD, _ROUGH = 6, 15  # steps in which starts are refined with the waves held, and the best of these with them
_SPEEDS: Final = 4  # speeds that are tried
_WORSE: Final = 4.0  # half the sum of squares over that of the best start, above which another is left out
_SOME: Final = 300  # largest number of points by which starts are refined
_WHOLE: Final = 4  # how many of the starts that fit some of the points best are refined by all points
_MORE: Final = (-1.0, -0.5, 0.5, 1.0)  # differences of the number of waves within the contact that are tried
_HOPELESS: Final = 25.0
"""Half the sum of squares of some of the points by which a minimum may be worse than one that leaves only noise."""
_VALLEY: Final = 3.0
"""Standard deviations of the least certain combination by which a smooth fit is begun anew on both sides."""
_FEWEST: Final = 0.2  # least number of waves that is tried
_HOPS: Final = 5  # most rounds in which these are tried
_BETTER: Final = 1e-6  # relative difference of sums of squares, below which two minima are the same


def starts(misfit: Misfit, load_zero: float, contact: float, count: int, seed: int) -> list[Floats]:
    """Return `count` starts at most for all numbers of a loop, refined by some of its points, the best first.

    Each is (numbers,), in the order of `misfit.names` and on the scales of `misfit.low`. `load_zero` estimates the load
    out of contact in N, `contact` the depth in m at which contact begins: the end of the base line of loading, or else
    the least depth of loading; NaN if there is neither. `seed` gives other values of what no feature tells.
    """
    if misfit.model.rate is not None:
        rest, few = misfit.without(SPEEDS), misfit.thinned(100)
        start = _filled(few, rest, minima(rest, starts(rest, load_zero, contact, count, seed))[0].x)
        tried = {name: shares_of(few, name, _SPEEDS) for name in few.names if name in SPEEDS}
        begun = [put(few, start, {name: row[i] for name, row in tried.items()}) for i in range(_SPEEDS if tried else 1)]
        return _kept([few.refined(vector, most=12, tolerance=1e-4) for vector in begun], few, min(count, 3))
    if misfit.turn:
        rest = misfit.without((TURN,))
        return [_filled(misfit, rest, vector) for vector in starts(rest, load_zero, contact, count, seed)]
    few = misfit.thinned(_FEW)
    if not misfit.model.has_waves:
        return _smooth(few, load_zero, contact, seed)[:count]
    smooth = few.without(WAVES, A=0.0)
    first = _smooth(smooth, load_zero, contact, seed)[0]
    held = put(smooth, first, {DEPTH_ZERO: contact, LOAD_ZERO: load_zero})
    zeros = [place for place, name in enumerate(smooth.names) if name in (DEPTH_ZERO, LOAD_ZERO)]
    again = smooth.refined(matched(smooth, held, load_zero), most=40, held=zeros, tolerance=1e-6).x
    found: list[Any] = []
    for base in distinct([first, again], smooth, _ALIKE):
        found += _wavy(few, smooth, base, count)
        if few.is_noise(found):
            break
    return _kept(found, few, count)


def put(misfit: Misfit, vector: Floats, values: Mapping[str, float]) -> Floats:
    """Return a vector with other numbers under some names, within their ranges; those that are NaN stay."""
    changed = np.array([values.get(name, math.nan) for name in misfit.names])
    return np.where(np.isnan(changed), vector, np.clip(changed, misfit.low, misfit.high))


def _filled(misfit: Misfit, rest: Misfit, vector: Floats) -> Floats:
    """Return a vector from one of the rest of its numbers, the others in the middle of their ranges."""
    return put(misfit, 0.5 * (misfit.low + misfit.high), dict(zip(rest.names, vector, strict=True)))


def shares_of(misfit: Misfit, name: str, count: int) -> Floats:
    """Return values of a number evenly within its range, none at its ends; shape (count,)."""
    i, shares = misfit.names.index(name), (np.arange(count) + 0.5) / count
    return np.asarray(misfit.low[i] + shares * (misfit.high[i] - misfit.low[i]))


def _kept(found: list[Any], few: Misfit, count: int) -> list[Floats]:
    """Return the best of some refined starts that differ, in order, without those that are far worse."""
    best = sorted(found, key=COST)
    return distinct([done.x for done in best if done.cost <= _WORSE * best[0].cost], few)[:count]


def _smooth(few: Misfit, load_zero: float, contact: float, seed: int) -> list[Floats]:
    """Return refined starts of a loop whose punch has no waves that are searched, the best first."""
    names, middle, widths = few.names, 0.5 * (few.low + few.high), few.high - few.low
    depths = np.append(shares_of(few, DEPTH_ZERO, _CONTACTS), contact) if DEPTH_ZERO in names else np.zeros(1)
    works = shares_of(few, _WORK, _WORKS) if _WORK in names else np.zeros(1)
    others = [i for i, name in enumerate(names) if name not in (*OFFSETS, *_MODULI, _WORK)]  # no feature tells these
    steps = 2.0 ** (np.arange(1.0, len(others) + 1.0) / (len(others) + 1.0))  # their multiples fill a cube evenly
    begun, places = [], itertools.product(depths[np.isfinite(depths)], works)
    for number, (depth, work) in enumerate(places, start=2**6 * seed):
        vector = middle.copy()
        vector[others] = few.low[others] + (0.5 + number * steps) % 1.0 * widths[others]
        vector = put(few, vector, {DEPTH_ZERO: depth, LOAD_ZERO: load_zero, _WORK: work})
        begun.append(matched(few, vector, load_zero))
    rest = len(begun) - (len(works) if math.isfinite(contact) else 0)  # the last are at `contact`
    found: list[Any] = []
    for vectors in (begun[rest:], sorted(begun[:rest], key=few.size)[:_KEPT]):
        found += [few.refined(vector, most=40, tolerance=1e-6) for vector in vectors]
        if few.is_noise(found):
            break  # contact points elsewhere have a larger misfit
    return _kept(found, few, len(found))


def matched(misfit: Misfit, vector: Floats, load_zero: float) -> Floats:
    """Return a vector with the modulus at which contact without adhesion has the largest load of the data."""
    model = misfit.model
    i = model.place_of(_MODULI)
    if i is None:
        return vector
    scene, m = model.scenes(vector[None]).one, model.profile.exponent
    deepest, load = misfit.data[np.argmax(misfit.data[:, 0])]
    place = (max(float(deepest) - model.shift(vector)[0], 0.0) / scene.rise) ** (1.0 / m)
    power = 1.0 + scene.k
    pressed = scene.rise * place**m * scene.disc * place**power * m / (power + m)
    if not (place > 0.0 and load > load_zero):
        return vector
    return put(misfit, vector, {misfit.names[i]: vector[i] + math.log((load - load_zero) / pressed)})


def spectrum(smooth: Misfit, vector: Floats, lengths: tuple[float, float]) -> Floats:
    """Return the wavelengths in m at which the residual of a smooth punch repeats most, the strongest first."""
    from scipy.signal import find_peaks, lombscargle  # noqa: PLC0415 (a loop without waves does without its half second)

    _, near, drawn = smooth.nearest(vector)
    if near is None or drawn is None:
        return np.empty(0)
    largest = float(drawn.radius.max())
    count = int(np.clip(10.0 * largest * (1.0 / lengths[0] - 1.0 / lengths[1]), 64, 4000))
    waves = np.linspace(1.0 / lengths[1], 1.0 / lengths[0], count)
    power = np.zeros(count)
    at = (1.0 - near.share) * drawn.radius[near.piece] + near.share * drawn.radius[near.piece + 1]
    inside = (at > lengths[0]) & ~drawn.jump[near.piece + 1]
    for use in (inside & ~smooth.back, inside & smooth.back):
        if np.unique(at[use]).size < 12:
            continue
        left = (near.distance * smooth.weights)[use]
        left -= np.polynomial.Polynomial.fit(at[use], left, 3)(at[use])
        if (size := float(left @ left)) > 0.0:
            power += lombscargle(at[use], left, 2.0 * math.pi * waves) / size * left.size
    peaks, _ = find_peaks(power)
    return np.asarray(1.0 / waves[peaks[np.argsort(-power[peaks], kind="stable")]])


def _wavy(few: Misfit, smooth: Misfit, base: Floats, count: int) -> list[Any]:
    """Return refined starts for waves that are searched, refined in everything else, the best first.

    `smooth` and `base` are the same loop without waves, and its best start.
    """
    length, height = (next((name for name in few.names if name in ways), "") for ways in (WAVELENGTHS, AMPLITUDES))
    held = [few.names.index(name) for name in (length, height) if name]
    heights = shares_of(few, height, _HEIGHTS) if height else [math.nan]
    middle = _filled(few, smooth, base)
    found: list[Any] = []
    for waves in _lengths(few, smooth, base, middle, length) if length else [[math.nan]]:
        begun = [put(few, middle, {length: wave, height: swell}) for wave, swell in itertools.product(waves, heights)]
        rough = [few.refined(_softened(few, vector), most=_HELD, held=held, tolerance=1e-4) for vector in begun]
        found += [few.refined(done.x, most=_ROUGH, tolerance=1e-4) for done in sorted(rough, key=COST)[:count]]
        if few.is_noise(found):
            break
    return found


def _lengths(few: Misfit, smooth: Misfit, base: Floats, middle: Floats, name: str) -> list[Floats]:
    """Return the logarithms of the wavelengths that are tried: those of the spectrum, and others over the range."""
    i, drawn, scene = few.names.index(name), smooth.nearest(base).drawn, few.model.scenes(middle[None]).one
    unit = scene.wavelength * scene.R / math.exp(middle[i])  # the wavelength in m of a number of 1
    low, high = math.exp(few.low[i]) * unit, math.exp(few.high[i]) * unit
    largest = 0.0 if drawn is None else float(drawn.radius.max())
    count = int(np.clip(_PER_WAVE * largest * (1.0 / low - 1.0 / high), _LEAST, _MOST))
    even = 1.0 / np.linspace(1.0 / high, 1.0 / low, count + 2), np.geomspace(low, high, _LONG + 2)
    peaks = spectrum(smooth, base, (low, high))[:_PEAKS]
    # a wave more or less within the contact is another minimum: peaks are off by parts of one
    strong = peaks[:_BESIDE]
    beside = [strong / (1.0 + sign * strong / (_PER_WAVE * largest)) for sign in (1.0, -1.0) if largest]
    groups = np.concatenate([peaks, *beside]), np.concatenate([row[1:-1] for row in even])
    return [np.log(tried[(tried >= low) & (tried <= high)] / unit) for tried in groups]


def _softened(misfit: Misfit, vector: Floats) -> Floats:
    """Subtract what waves add from the work of adhesion of the smooth punch: the roots of both add up."""
    if _WORK not in misfit.names:
        return vector
    scene = misfit.model.scenes(vector[None]).one
    waves = float(waviness_strength(scene.k, scene.wavelength, scene.A))
    root = max(1.0 - waves / float(adhesion_strength(scene.k, scene.stiffness)), 0.15)
    return put(misfit, vector, {_WORK: vector[misfit.names.index(_WORK)] + 2.0 * math.log(root)})


def minima(misfit: Misfit, begun: list[Floats]) -> list[Any]:
    """Refine starts, by some of the points and then the best of them by all; the best minimum first.

    Minima beside the best one are tried too, until none is better: with some waves more or less in the contact, or
    along the valley of a smooth punch.
    """
    few = misfit.thinned(_SOME)

    def best(vectors: list[Floats], count: int) -> list[Any]:
        rough = sorted((few.refined(vector, most=30, tolerance=1e-6) for vector in vectors), key=COST)
        if few.is_noise(rough):
            rough = [done for done in rough if done.cost < rough[0].cost + _HOPELESS]
        return [misfit.refined(vector, most=100) for vector in distinct([done.x for done in rough], misfit)[:count]]

    whole = sorted(best(begun, _WHOLE), key=COST)
    for _ in range(_HOPS):
        least = whole[0].cost * (1.0 - _BETTER)
        whole = sorted([*whole, *best(_beside(misfit, whole[0].x), 2)], key=COST)
        if not whole[0].cost < least:
            break
    return whole


def distinct(vectors: list[Floats], misfit: Misfit, near: float = 1e-3) -> list[Floats]:
    """Return those of some vectors that are not near an earlier one: a part of the ranges in every number."""
    kept: list[Floats] = []
    for vector in vectors:
        if all(np.max(np.abs(vector - other) / (misfit.high - misfit.low)) > near for other in kept):
            kept.append(vector)
    return kept


def _beside(misfit: Misfit, vector: Floats) -> list[Floats]:
    """Return where minima may lie beside one: with some waves more or less in the contact, or along the valley."""
    i, path = misfit.model.place_of(WAVELENGTHS), misfit.nearest(vector).drawn
    if path is None or misfit.model.rate is not None:
        return []
    if i is None or not misfit.model.has_waves:  # a jump between two points may be nearer to either of them
        widths = misfit.high - misfit.low
        _, singular, rows = np.linalg.svd(misfit.jacobian(vector) * widths, full_matrices=False)
        step = _VALLEY / max(singular[-1], 1e-300) * rows[-1] * widths
        return [np.clip(vector + sign * step, misfit.low, misfit.high) for sign in (-1.0, 1.0)]
    waves = float(path.radius.max()) / (path.scene.wavelength * path.scene.R)
    step = np.eye(vector.size)[i]
    moved = [vector - step * math.log((waves + more) / waves) for more in _MORE if waves + more > _FEWEST]
    return [other for other in moved if misfit.low[i] < other[i] < misfit.high[i]]
