"""The results at a minimum of the misfit: values, intervals, correlations and warnings."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np
from scipy.optimize import brentq
from scipy.special import chdtri, stdtrit

from gradhesion.core.closed.reduced import WAYS
from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.loops.fitted import DEPTH_ZERO, CannotTellApartError, FittedLoop, OtherMinimum, poor_from
from gradhesion.core.loops.measured.features import ContactPoint
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import LINEAR, TURN, WAVELENGTHS, LoopModel
from gradhesion.core.loops.paths.path import LoopPath
from gradhesion.core.loops.search import COST
from gradhesion.core.problem.names import CLOSING, SPEED
from gradhesion.core.problem.status import ANOTHER_MINIMUM, JUMP_IN_TO_RIM, POOR_FIT
from gradhesion.core.sweep import solve
from gradhesion.core.types import Floats

_SINGULAR: Final = 5e-4
"""Singular value over the largest, below which numbers are locked together: correlations above 1 - 1e-6."""
_PART: Final = 0.01  # least part of such a combination that a parameter has in it
_WITHOUT: Final = 1e-6  # effect of a parameter over the largest, below which it has none
LEVEL: Final = 0.95
"""Probability that an interval covers, and that the rise of chi square is below that of minima which noise allows."""
_NEAR_END: Final = 0.01  # part of a range: a value closer than this to an end is on the bound
_WIDE: Final = 10.0  # ratio of stop to start above which a range is measured by its logarithm
_LOWER: Final = 0.005  # fall of half the sum of squares, over the variance of a residual, that is another minimum
_MOST: Final = 16  # minima, from which on a lower one is not sought: the misfit of another model has no end of them
_NEAR: Final = 0.01  # accuracy of the end of an interval, in parts of the quantile
_FINE: Final = 1e-5  # tolerance for the sum of squares and the numbers: a rise by 4 is known to a hundredth of it
_ROUNDING: Final = 1e-12  # relative difference of radii that is rounding
_SEEN: Final = 5.0  # size of a jump, in standard deviations of the noise, from which on it shows that there are waves
_LEAST: Final = 0.01  # strength of waves below which nothing is reported
_PHASE: Final = 0.1  # error of the number of waves within the contact, below which waves are resolved without jumps
_APART: Final = 9.0, 4.0
"""Another minimum is further away, in squared standard deviations, than the first, and than the second times the rise
of chi square; two places in one valley are not."""


def results_at(
    misfit: Misfit,
    found: list[Any],
    intervals: str,
    ranges: Mapping[str, tuple[float, float]],
    *,
    widened: bool,
    contact: ContactPoint | None = None,
) -> FittedLoop:
    """Return the results at the first of some minima, the results of `minima`.

    `intervals` is "linear" or "profile"; `ranges` are the ends of what is searched, in SI units; a `contact` point at
    which the zero of depth was fixed adds its deviation; where noise was estimated, deviations and intervals are
    `widened` by the root of the reduced chi square.
    """
    best = found[0].x
    residual, path = misfit.residual(best), misfit.nearest(best).drawn
    names = tuple(name for name in misfit.names if name != TURN)  # the turn is the last number
    assert path is not None  # noqa: S101 (fit.py has refused those without)
    chi_square, degrees = float(residual @ residual), residual.size - best.size
    unit = max(1.0, chi_square / degrees) if widened else 1.0
    covariance = covariance_of(misfit, best) * unit
    spread = np.sqrt(np.diag(covariance))
    values, factor = _values(misfit, best), float(stdtrit(degrees, 0.5 * (1.0 + LEVEL)))
    ends = np.array([best - factor * spread, best + factor * spread])
    if intervals == "profile":
        ways = covariance / spread[:, None]
        ends, tried = profile_intervals(misfit, found[0], ways, factor, unit)
        lowest = min(tried, key=COST)
        lower = _LOWER * max(1.0, chi_square / degrees)
        if found[0].cost - lowest.cost > lower and len(found) < _MOST:  # a valley that no start has led to
            better = [misfit.refined(lowest.x), *found]
            return results_at(misfit, better, intervals, ranges, widened=widened, contact=contact)
    if contact is not None:
        move = _by_contact(misfit, best, covariance / unit, contact)
        ends = best + np.array([[-1.0], [1.0]]) * np.hypot(ends - best, factor * move)
        covariance = covariance + np.outer(move, move)
        spread = np.sqrt(np.diag(covariance))
    low, high = (misfit.named(np.clip(end, misfit.low, misfit.high)) for end in ends)
    allowed = others(found, covariance / unit, unit)
    radius = float(path.radius[path.turn]) / path.scene.R
    status = status_of(misfit.model, best, radius) | (ANOTHER_MINIMUM if allowed else 0)
    return FittedLoop(
        names=names,
        values=values,
        standard_deviations={
            name: float(sd if name in LINEAR else values[name] * sd) for name, sd in zip(names, spread, strict=False)
        },
        low=low,
        high=high,
        ranges={name: ranges[name] for name in names},
        correlation=(covariance / np.outer(spread, spread))[: len(names), : len(names)],
        on_bound=tuple(name for name in names if is_on_bound(values[name], ranges[name])),
        chi_square=chi_square,
        degrees_of_freedom=degrees,
        residual=residual[: misfit.weights.size],
        loading=path.places[: path.turn + 1],
        unloading=path.places[path.turn :],
        converged=bool(found[0].status > 0),
        status=status | (POOR_FIT if chi_square > poor_from(degrees) * degrees else 0),
        others=tuple(OtherMinimum(values=_values(misfit, one.x), chi_square=2.0 * one.cost) for one in allowed),
        alike=alternatives(misfit.model, path, misfit.scale, spread),
        contact=contact,
        turning_radius=radius,
        widening=math.sqrt(unit),
    )


def _values(misfit: Misfit, vector: Floats) -> dict[str, float]:
    """Return the values of a minimum by name; where both works are equal, noise has them in either order."""
    values = misfit.named(vector)
    if (closing := "work_of_adhesion_closing") in values:
        values[closing] = min(values[closing], {**misfit.model.fixed, **values}["work_of_adhesion"])
    return values


def _by_contact(misfit: Misfit, best: Floats, covariance: Floats, contact: ContactPoint) -> Floats:
    """Return by how much the numbers change where the contact point is a standard deviation further, (numbers,)."""
    fixed = {**misfit.model.fixed, DEPTH_ZERO: contact.depth + contact.deviation}
    further = replace(misfit, model=replace(misfit.model, fixed=fixed))
    return covariance @ misfit.jacobian(best).T @ (misfit.residual(best) - further.residual(best))


def others(found: list[Any], covariance: Floats, unit: float) -> list[Any]:
    """Return the minima after the first that noise allows, by the covariance of the first and a residual's variance."""
    best, inverse = found[0], np.linalg.pinv(covariance)
    allowed = float(chdtri(best.x.size, 1.0 - LEVEL)) * unit
    kept: list[Any] = []
    for done in found[1:]:
        rise = 2.0 * (done.cost - best.cost)
        least = max(_APART[0], _APART[1] * rise / unit)
        away = [done.x - other.x for other in (best, *kept)]
        if rise <= allowed and all(apart @ inverse @ apart > least for apart in away):
            kept.append(done)
    return kept


def covariance_of(misfit: Misfit, vector: Floats) -> Floats:
    """Return the covariance of the numbers, for residuals of variance 1; refuse those that have one effect, or none."""
    names, jacobian, widths = misfit.names, misfit.jacobian(vector), misfit.high - misfit.low
    lengths = np.linalg.norm(jacobian * widths, axis=0)
    without = [name for name, length in zip(names, lengths, strict=True) if length <= _WITHOUT * lengths.max()]
    if without:
        raise ValueError(
            f"{' and '.join(without)}: without effect on this loop; fix {'it' if len(without) == 1 else 'them'}"
        )
    unit = lengths / widths
    _, singular, rows = np.linalg.svd(jacobian / unit, full_matrices=False)
    if singular[-1] < _SINGULAR * singular[0]:
        raise CannotTellApartError([name for name, part in zip(names, np.abs(rows[-1]), strict=True) if part > _PART])
    return np.linalg.inv(jacobian.T @ jacobian / np.outer(unit, unit)) / np.outer(unit, unit)


def is_on_bound(value: float, ends: tuple[float, float]) -> bool:
    """Say whether a value is within 1 % of a range of an end of it."""
    low, high = ends
    if low > 0.0 and high > _WIDE * low:
        value, low, high = math.log(value), math.log(low), math.log(high)
    return min(value - low, high - value) < _NEAR_END * (high - low)


def profile_intervals(misfit: Misfit, least: Any, ways: Floats, factor: float, unit: float) -> tuple[Floats, list[Any]]:
    """Return how low and how high each number may be by its profile likelihood, (2, unknown), and all that was tried.

    An interval ends where the sum of squares, over the variance `unit` of a residual, has risen from its `least` (`x`
    and `cost` of a minimum) by the square of `factor`, a quantile of Student's t, or at the end of the range. `ways`
    are how all numbers move with each in the linear problem, standard deviations times correlations. Zeros, the last
    numbers, come first: what jumps pass as they move makes corners and valleys, which belong to the intervals of the
    others as well.
    """
    tried, ends = [least], np.empty((2, least.x.size))

    def excess(one: Any) -> float:
        """Return by how much the root of the rise at a place exceeds that at the end of an interval; 0 if hardly."""
        over = math.sqrt(max(0.0, 2.0 * (one.cost - least.cost)) / unit) - factor
        return 0.0 if abs(over) < _NEAR * factor else over

    for number in reversed(range(least.x.size)):
        for side, sign in enumerate((-1.0, 1.0)):
            ends[side, number] = _profile_end(misfit, tried, number, sign * ways[number], factor, excess)
    return ends, tried


def _profile_end(
    misfit: Misfit, tried: list[Any], number: int, along: Floats, factor: float, excess: Callable[[Any], float]
) -> float:
    """Return an end of an interval, that on the side to which `along` leads; places are added to those `tried`.

    The interval of the linear problem, or the furthest place within, is the first guess, which is doubled until it is
    too wide: the rise may be a plateau.
    """
    best, step = tried[0].x, float(along[number])
    most = float(((misfit.high if step > 0.0 else misfit.low)[number] - best[number]) / step)
    lowest_last = sorted(tried, key=lambda one: -one.cost)  # of places with the same number
    known = {float((one.x[number] - best[number]) / step): one for one in lowest_last}

    def beyond(way: float) -> float:
        """Return the excess at the place so many deviations away, all other numbers fitted."""
        if way not in known:
            nearest = min(known, key=lambda other: abs(other - way))
            moved, held = known[nearest].x + (way - nearest) * along, best.copy()
            held[number] = moved[number]
            for start in (moved, held):  # the second one where an interval would end
                start = np.clip(start, misfit.low, misfit.high)
                done = misfit.refined(start, held=[number], most=20, tolerance=_FINE)
                known[way] = min(known.get(way, done), done, key=COST)
                if excess(done) < 0.0:
                    break
            tried.append(known[way])
        return excess(known[way])

    inner = max(way for way, one in known.items() if excess(one) < 0.0 and way >= 0.0)
    outer = min(factor if inner < factor else 2.0 * inner, most)
    while beyond(outer) < 0.0 and outer < most:
        inner, outer = outer, min(2.0 * outer, most)
    way = brentq(beyond, inner, outer, xtol=_NEAR * outer) if beyond(outer) > 0.0 else outer
    return float(best[number]) + way * step


def status_of(model: LoopModel, vector: Floats, radius: float) -> int:
    """Return the status that `solve` gives the cycle of a vector that turns at a radius, over R."""
    if radius == 0.0:
        return 0
    scene = model.parameters(vector)
    scene.pop(SPEED, None)
    turns_before = radius < (1.0 - _ROUNDING) * scene["a_max_over_R"]
    scene["a_max_over_R"] = min(scene["a_max_over_R"], radius)
    if CLOSING in scene:  # where the works are equal, two fitted ones are in either order, by noise
        scene[CLOSING] = min(scene[CLOSING], 1.0)
    own: dict[str, Any] = {"profile": model.profile, "loading": model.loading, "toughness": model.toughness}
    wanted = ["pull_off_force", "loading_jumps"] if model.loading.control == "load" else [
        "dissipated_energy", "loading_jumps", "unloading_jumps"]  # fmt: skip
    found = int(solve(scene, wanted, threads=1, **own)["status"])
    return found & ~(JUMP_IN_TO_RIM if turns_before else 0)


def alternatives(model: LoopModel, path: LoopPath, noise: Floats, spread: Floats) -> tuple[str, ...]:
    """Return a sentence on what else would explain a loop; none where the jumps decide.

    Waves of a strength chi that are fine against the contact act as a smooth punch that opens at the work of adhesion
    (1 + chi)^2 dgamma and closes at (1 - chi)^2 dgamma: toughnesses add (docs/theory.md). `noise` are the standard
    deviations of depth and load, in m and N, `spread` those of the numbers, as they are searched.
    """
    scene = path.scene
    if not model.has_waves:
        chi = (1.0 - scene.root) / (1.0 + scene.root)
        if chi < _LEAST or model.place_of((CLOSING, *WAYS[CLOSING])) is None:
            return ()
        waves = f"waves too fine to be seen, of chi = {chi:.3g}, would have the same effect as closing_ratio = "
        return (f"{waves}{scene.root**2:.3g}; a loop cannot tell the two apart",)
    jumps = np.flatnonzero(path.jump[1:] & (path.radius[1:] > 0.0) & (path.radius[:-1] > 0.0))
    sizes = np.hypot(*((path.places[jumps + 1] - path.places[jumps]) / noise).T)
    length = model.place_of(WAVELENGTHS)
    is_known = length is not None and spread[length] * path.radius.max() < _PHASE * scene.wavelength * scene.R
    chi = float(waviness_strength(scene.k, scene.wavelength, scene.A) / adhesion_strength(scene.k, scene.stiffness))
    if sizes.max(initial=0.0) > _SEEN or is_known or not 0.0 < chi < 1.0:
        return ()
    works = f"{((1.0 - chi) / (1.0 + chi)) ** 2:.3g} and {(1.0 + chi) ** 2:.4g} times the work of adhesion"
    punch = f"the waves are too fine to be seen in the noise: a smooth punch with closing_ratio = {works}"
    return (f"{punch} would have the same effect; a loop cannot tell the two apart",)
