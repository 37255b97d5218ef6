"""A scene on a patterned interface made ready for drawing, as curves/general.py."""

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.arrays.patterned import curves_of_scenes
from gradhesion.core.arrays.prepared import prepared
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.branches import ARRIVAL, END, START
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis
from gradhesion.core.curve.patterned import Patterned, are_too_many, folds_up_to, patterned_curve, window
from gradhesion.core.curves.forms import GENERAL, general_numbers
from gradhesion.core.curves.general import MOST_FOLDS, smooth_place
from gradhesion.core.curves.subject import BEYOND, BEYOND_SMOOTH, Form, Subject
from gradhesion.core.path.patterned import walk
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import PATTERN
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Toughness
from gradhesion.core.struve.circle import TWO_PI


def _turns(basis: Basis, curve: Patterned, furthest: float) -> NDArray[np.float64] | None:
    """Return all folds of the coordinate up to a place; None if too many."""
    first, end = window(basis, curve)
    zeros, count, last = np.empty(MOST_FOLDS), 0, min(furthest, end)
    if first < last:
        if are_too_many(basis, first, last):
            return None
        count, _, _ = folds_up_to(basis, curve, first, last, zeros)
    return None if count < 0 else zeros[:count]


def subject_of(scene: Mapping[str, float], profile: Profile, loading: Loading, toughness: Toughness) -> Subject | None:
    """Return a scene ready for drawing, None where a parameter is outside its range.

    Parameters
    ----------
    scene
        The parameters of `solve`, with those of the pattern.
    profile, loading, toughness
        Any.
    """
    scenes = prepared({PATTERN[1]: 1.0, **scene}, loading, more=PATTERN)
    k, rim = float(scenes.k[0]), float(scenes.rim[0, 0])
    series, curves_of, patterns = curves_of_scenes(scenes, profile, toughness)
    if not (0.0 <= k <= 1.0 and 0.0 < rim <= patterns.limit[0]):
        return None
    table, cosine_bins = tables_of(k, series)
    made = patterned_curve(table, cosine_bins, series, curves_of(k, np.zeros(1, dtype=np.int64)), patterns, 0)
    valid, pattern, finest, curve, (wavelength, length, unit) = made
    if not valid:
        return None
    basis, furthest = Basis(table, pattern, finest), rim / wavelength
    _, half, ripple = general_numbers(k, curve._replace(gain=pattern.gain), float(table["amplitude"]), pattern.waves)
    numbers = (curve, min(half, 0.5 / finest[0, 0]), ripple + max(pattern.most - 1.0, 1.0 - pattern.least))
    form = Form(GENERAL, basis, numbers, wavelength, unit, force_unit(k, length, unit))
    turns = [_turns(basis, curve._replace(alpha=a, beta=b), furthest) for a, b in ((1.0, 0.0), (0.0, 1.0), curve[3:])]
    known = [each for each in turns if each is not None]
    trace, others = None, np.empty(0)
    if len(known) == len(turns):
        count, trace, _ = walk(basis, curve, window(basis, curve), furthest, False)
        trace = np.ascontiguousarray(trace[:, :count])
        trace[END, trace[END] == furthest] = math.inf
        others = np.setdiff1d(np.concatenate(known[:2]), trace[[START, END]])
        others = others[others < furthest]
    end = rim
    if not rim < math.inf:
        places = [BEYOND_SMOOTH * smooth_place(form, profile.exponent) / TWO_PI, *BEYOND * others[-1:]]
        if trace is not None:
            places += [BEYOND * trace[START, -1], BEYOND * trace[ARRIVAL, -1]]
        end = wavelength * max(places)
    stretch, mean = float(scenes.stretch[0]), float(scenes.amplitude[0] * scenes.wavelength[0])
    return Subject(table, stretch, wavelength, math.nan, mean, rim, end, form, trace, others)
