"""A scene of any profile under any control made ready for drawing, and its punch without waves.

The branches of the subject are those of the coordinate that is prescribed (core/curve/general.py): there the contact is
stable under the control in force. The other extrema of depth and of load are its `load_folds`.
"""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.arrays.prepared import compliance_of
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.branches import ARRIVAL, END, START
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Series, curve_of
from gradhesion.core.curves.equilibrium import draw_named
from gradhesion.core.curves.forms import general_numbers
from gradhesion.core.curves.subject import BEYOND, BEYOND_SMOOTH, Form, Subject
from gradhesion.core.face import find_all_folds, window
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import walk
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import depth_factor_of, rows_of

MOST_FOLDS: Final = 20_000
"""Folds of a curve that is drawn."""


def _turns(basis: Basis, curve: Series, furthest: float) -> NDArray[np.float64] | None:
    """Return all folds of the coordinate up to a place; None if too many."""
    first, end = window(basis, curve)
    zeros = np.empty(MOST_FOLDS)
    count, last = 0, min(furthest, end)
    if first < last < math.inf:
        count, _, _ = find_all_folds(basis, curve, first, last, zeros)
    return None if count < 0 or last == math.inf else zeros[:count]


def trace_of(
    basis: Basis, curve: Series, furthest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | tuple[None, NDArray[np.float64]]:
    """Return the branches with the rows of path/general.py, and the other extrema of depth and load.

    The rim is no end of a branch.
    """
    coordinates = (1.0, 0.0), (0.0, 1.0), (curve.alpha, curve.beta)
    measured = [curve._replace(alpha=alpha, beta=beta) for alpha, beta in coordinates]
    turns = [each for one in measured if (each := _turns(basis, one, furthest)) is not None]
    if len(turns) < len(coordinates):
        return None, np.empty(0)
    count, trace, _ = walk(basis, curve, window(basis, curve), furthest, False)
    trace = np.ascontiguousarray(trace[:, :count])
    trace[END, trace[END] == furthest] = math.inf
    others = np.setdiff1d(np.concatenate(turns[:2]), trace[[START, END]])
    return trace, others[others < furthest]


def _form(basis: Any, curve: Series, radius_scale: float, depth_scale: float, load_scale: float) -> Form:
    table, _, series = basis
    numbers = general_numbers(float(table["k"]), curve, float(table["amplitude"]), series)
    return Form(basis, numbers, radius_scale, depth_scale, load_scale)


def smooth_place(form: Form, level: float) -> float:
    """Return z where m B z^(m-1) = level z^(-(1+k)/2): a turn of depth or load of the punch without waves."""
    bend, m, _, _, _ = form.curve
    place: float = (level / (m * bend)) ** (1.0 / (m - 0.5 * (1.0 - float(form.table[0]["k"]))))
    return place


def end_of(form: Form, trace: NDArray[np.float64] | None, turns: NDArray[np.float64]) -> float:
    """Return a/R at which the curve of an unbounded punch ends."""
    places = [BEYOND_SMOOTH * smooth_place(form, form.curve.exponent) / TWO_PI, *BEYOND * turns[-1:]]
    if trace is not None:
        places += [BEYOND * trace[START, -1], BEYOND * trace[ARRIVAL, -1]]
    return float(form.radius_scale * max(places))


def subject_of(scene: Mapping[str, float], profile: Profile, loading: Loading) -> Subject | None:
    """Return a scene (the parameters of `solve`) ready for drawing, None where one is outside its range.

    Its drawn range is that of curves/subject.py, which extends beyond the folds of the coordinate too.
    """
    k, nu, modulus, c0, wavelength, amplitude, rim = (float(scene[name]) for name in PARAMETERS)
    machine = [np.array(float(scene["machine_stiffness"]))] if loading.control == "machine" else []
    with np.errstate(all="ignore"):
        material = stiffness(k, nu, modulus, c0)
        stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / material) if material > 0.0 else math.nan
        compliance = float(compliance_of(loading, np.array(k), np.array(modulus), np.array(material), *machine))
    lengths = 0.0 < stretch < math.inf and 0.0 < wavelength < math.inf and 0.0 <= amplitude < math.inf
    if not (lengths and rim > 0.0 and compliance >= 0.0):
        return None
    table, cosine_bins = tables_of(k)
    series = rows_of(profile)
    if not (amplitude > 0.0 and series.size):
        amplitude, series = 0.0, np.zeros((0, 3))
    basis = Basis(table, cosine_bins, series)
    depth_factor = depth_factor_of(k, profile.exponent)
    curve, length, unit = curve_of(k, profile.exponent, depth_factor, stretch, wavelength, amplitude, compliance)
    if not (0.0 < curve.bend < math.inf and curve.gain < math.inf):
        return None
    form = _form(basis, curve, wavelength, unit, force_unit(k, length, unit))
    trace, turns = trace_of(basis, curve, rim / wavelength)
    end = rim if rim < math.inf else end_of(form, trace, turns)
    return Subject(table, stretch, wavelength, math.nan, amplitude * wavelength, rim, end, form, trace, turns)


def draw_smooth(subject: Subject) -> dict[str, NDArray[np.float64]]:
    """Return the variables `smooth_...` (draw.CURVES): the curve of the same power without waves."""
    exact, k = subject.exact, subject.k
    basis = exact.table._replace(series=np.zeros((0, 3)))
    form = _form(basis, exact.curve._replace(gain=0.0), exact.radius_scale, exact.depth_scale, exact.load_scale)
    end = subject.end / form.radius_scale
    levels = (0.5 * (1.0 - k), form.curve.exponent, 0.5 * (3.0 + k))
    places = np.unique([smooth_place(form, level) / TWO_PI for level in levels])
    return draw_named(subject, form, places[(places > 0.0) & (places < end)], "smooth")
