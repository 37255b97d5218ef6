"""Parameters from a measured loop of load and depth: least squares on the distance to the path.

The path of a cycle is a connected curve in the plane of depth and load, its jumps straight lines in it, so that the
distance of a measured point to it is continuous in all parameters; the difference of loads at one depth is not. Both
axes are scaled by their noise. Loading begins, and unloading ends, on the line of no load. The path turns where the
data do.

There are many local minima: contact points anywhere in the data, and each wavelength with another number of waves in
the contact. Starts come from features that depend on no zero of the instrument (search.py), several are refined with
exact derivatives, and other minima that the noise allows are reported. Parameters with the same effect on
the loop (E*, c0 and nu act through one number M, docs/theory.md) make its Jacobian singular and are refused.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike
from threadpoolctl import threadpool_limits

from gradhesion.core.closed.reduced import WAYS
from gradhesion.core.loops.fitted import DEPTH_ZERO, LOAD_ZERO, TILT, FittedLoop, Offsets
from gradhesion.core.loops.measured.features import BaseLine, base_line, contact_point
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import LINEAR, TURN, LoopModel
from gradhesion.core.loops.results import covariance_of, results_at
from gradhesion.core.loops.search import minima
from gradhesion.core.loops.search import starts as starts_of
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CLOSING, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness
from gradhesion.core.types import Floats, Truths

_BLUR: Final = 6.0  # standard deviations of the depth by which the path continues beyond the deepest point
_LEVEL: Final = 3.0  # standard deviations of the points of a base line within which the fitted path has it
_MISSED: Final = 0.03  # part of the span by which the furthest point may miss the turn


def fit_loop(
    indentation: ArrayLike,
    load: ArrayLike,
    unloading: ArrayLike,
    fixed: Mapping[str, float],
    free: Mapping[str, tuple[float, float]],
    *,
    noise: tuple[float, float],
    noise_is_given: bool = True,
    counts: ArrayLike | None = None,
    offsets: Offsets | None = None,
    profile: Profile | None = None,
    loading: Loading | None = None,
    toughness: Toughness | None = None,
    rate: Rate | None = None,
    intervals: str = "linear",
    starts: int = 16,
    seed: int = 0,
) -> FittedLoop:
    """Fit parameters to the points of a loop: more than are fitted, all finite; ranges rise.

    Depths are in m and loads in N (positive presses), points in any order, of one or several equal cycles, of both
    branches or of one; `unloading` says which branch each belongs to.

    fixed       numbers by name, in SI units: R, E_star (or E), work_of_adhesion, c0, wavelength, A (or amplitude), k,
                nu, closing_ratio and, where the rim is met, a_max; what has no effect may be left out, as in a study
    free        the ends of the range of each name that is fitted: positive, but for k, nu and ratios; the cycle turns
                where the data do, unless indentation_max (m) or preload (N) is given too
    noise       standard deviations of depth and load of a point, both > 0; where they are estimated from the points,
                not known (`noise_is_given`), intervals are widened
    counts      the number of points averaged in each, 1 if not given: its noise is that of one point over its root
    offsets     the zeros that are fitted too, and their ranges; those of depth and load if not given
    profile     the shape of the punch, a paraboloid with one cosine wave if not given
    loading     what is prescribed; with control "machine" the depths are those of its far end, depth +
                load/spring_constant, and spring_constant in N/m is fixed or free
    toughness   a pattern, whose toughness_wavelength and toughness_amplitude are fixed or free
    rate        how the work of adhesion grows with the speed of the edge; speed or reference_speed, or both as
                speed_over_reference, are fixed or free, and its exponent may be free under that name; every
                derivative is a difference of paths then: fits take minutes
    intervals   "linear", those of the linear problem at the minimum, or "profile", by profile likelihoods; the
                deviation of a contact point that was found is part of them
    starts      how many starts are refined; another `seed` gives others of what no feature tells

    A fit is unreliable where `converged` is false, `on_bound` has names, or `status` has `POOR_FIT` or
    `ANOTHER_MINIMUM`. There is a CannotTellApartError where some of the free parameters have the same effect, and a
    ValueError where loading has no base line that the contact point is to come from, no combination has a path, or a
    number has no effect.

    Examples
    --------
    A smooth ball gives its modulus and work of adhesion back (Johnson, Kendall & Roberts 1971):

    >>> from gradhesion.core import draw_curves
    >>> R, E_star, work = 5e-6, 1e7, 0.03
    >>> scene = dict(k=0.0, nu=0.3, modulus=E_star * R / work, c0_over_R=1.0, lambda_over_R=1.0, A=0.0)
    >>> path = draw_curves(scene | {"a_max_over_R": np.inf, "indentation_max_over_R": 0.03}, ["path"])[0]
    >>> depth, force = R * path["path_indentation"], 1.5 * np.pi * R * work * path["path_load"]
    >>> fixed, free = dict(k=0.0, nu=0.3, A=0.0, R=R), dict(E_star=(1e6, 1e8), work_of_adhesion=(5e-3, 0.2))
    >>> found = fit_loop(depth, force, path["path_unloading"] == 1, fixed, free, noise=(1e-10, 1e-9))
    >>> round(found.values["E_star"] / E_star, 3), round(found.values["work_of_adhesion"] / work, 3)
    (1.0, 1.0)
    """
    points = np.column_stack([np.ravel(indentation), np.ravel(load)]).astype(float)
    back, zeros = np.ravel(unloading).astype(bool), offsets or Offsets()
    each = np.ones(back.size) if counts is None else np.ravel(counts).astype(float)
    root = float(np.sqrt(np.median(each)))
    of_means = noise[0] / root, noise[1] / root
    line, contact = base_line(points, back, of_means[1]), None
    if zeros.indentation == "contact" and (contact := contact_point(points, back, line, of_means)) is None:
        raise ValueError(
            'offsets.indentation = "contact": loading has no base line from which contact could be told; measure '
            'further out, or write "free"'
        )
    drive, furthest, span = loading or Loading(), points.max(axis=0), np.ptp(points, axis=0)
    driven, given = int(drive.control == "load"), {*fixed, *free}
    ranges, blur = _searched(points, free, zeros, line), _BLUR * of_means[0]
    turns = any(given & {name, *WAYS[name]} for name in TURNS)
    if given & {CLOSING, *WAYS[CLOSING]} and not turns:  # the edge is pinned at a turn that points may miss by a step
        step = _MISSED * span[driven] + _BLUR * of_means[driven]
        ranges[TURN], blur = (furthest[driven] - step, furthest[driven] + step), 0.0
    model = LoopModel(
        {**fixed} if contact is None else {**fixed, DEPTH_ZERO: contact.depth}, tuple(ranges), profile or Profile(),
        drive, toughness, furthest=tuple(furthest.tolist()), first=float(points[:, 0].min() - span[0]), blur=blur,
        rate=rate,
    )  # fmt: skip
    ends = [own if name in LINEAR else (math.log(own[0]), math.log(own[1])) for name, own in ranges.items()]
    low, high = np.array(ends).T
    misfit = Misfit(points, back, noise, each, model, low, high)
    with threadpool_limits(1):  # matrices of a few columns: threads only wait for each other
        begun = starts_of(misfit, *_zeros(points, back, line), starts, seed)
        _refuse_locked(misfit, begun)
        found = minima(misfit, begun)
        if misfit.nearest(found[0].x).drawn is None:
            raise ValueError("no combination within the ranges has a path; widen them")
        fitted = results_at(misfit, found, intervals, ranges, widened=not noise_is_given, contact=contact)
    if line is not None:  # points in contact may be flat, as those before the pull-off are: at another load
        level = fitted.values.get(LOAD_ZERO, 0.0) + fitted.values.get(TILT, 0.0) * line.middle
        line = line if abs(line.level - level) < _LEVEL * line.spread else None
    return replace(fitted, base_line=line)


def _zeros(points: Floats, back: Truths, line: BaseLine | None) -> tuple[float, float]:
    """Return estimates of the load out of contact and of the depth at which contact begins, NaN without any."""
    first = points[~back] if not back.all() else points
    depth, level = first[np.argmin(first[:, 0])].tolist()
    end = math.nan if line is None else line.ends[0]
    return level if line is None else line.level, depth if math.isnan(end) and not back.all() else end


def _searched(
    points: Floats, free: Mapping[str, tuple[float, float]], zeros: Offsets, line: BaseLine | None
) -> dict[str, tuple[float, float]]:
    """Return the ends of the ranges that are searched, by name, those of offsets after those that are free.

    Unless `zeros` says where, depths are searched within the data, rows of depth in m and load in N of shape (n, 2),
    and loads within the pull-off force of the base line.
    """
    ranges = {name: (float(low), float(high)) for name, (low, high) in free.items()}
    least, span = points.min(axis=0), np.ptp(points, axis=0)
    own = {DEPTH_ZERO: (least[0], least[0] + span[0]), LOAD_ZERO: (least[1] - 0.1 * span[1], least[1] + span[1])}
    if line is not None:
        reach = line.level - float(least[1]) + 5.0 * line.spread
        own[LOAD_ZERO] = (line.level - reach, line.level + reach)
    if zeros.slope:
        own[TILT] = (-span[1] / span[0], span[1] / span[0])
    given = {DEPTH_ZERO: zeros.indentation, LOAD_ZERO: zeros.load}
    own |= {name: ends for name, ends in given.items() if isinstance(ends, tuple)}
    return ranges | {name: (float(own[name][0]), float(own[name][1])) for name in zeros.names}


def _refuse_locked(misfit: Misfit, begun: list[Floats]) -> None:
    """Refuse, before the search, numbers that no start can tell apart: an error that all starts have."""
    for vector in begun:
        if misfit.nearest(vector).drawn is None:
            return
        try:
            covariance_of(misfit, vector)
        except ValueError as error:
            found = error
        else:
            return
    raise found
