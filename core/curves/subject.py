"""A scene made ready for drawing: its scales, its reduced forms, its branches, and how far it is drawn."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.arrays.tables import table_of
from gradhesion.core.closed import smooth
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, ROWS, START, START_DEPTH, UNKNOWN, UNLOADING_JUMPS
from gradhesion.core.curve.cosine import Cosine, curve_of, force_unit
from gradhesion.core.curves import knots
from gradhesion.core.curves.forms import EXACT, PLAIN, General, PowerLaw, Reduced, fill_points
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import extent, is_endless_wave, is_smooth, walk
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS

BEYOND: Final = 1.05
"""How far an unbounded punch is drawn beyond its last fold or jump."""
BEYOND_SMOOTH: Final = 1.5
"""How far an unbounded punch is drawn at least, in radii where the smooth curve is at zero depth."""
_SMALLEST: Final = 1e-140
"""a/lambda from which on the tables reach."""


@dataclass(frozen=True)
class Form:
    """A reduced form with its scales: the radius (in R) of a place, the depth (in R) and the load of a unit."""

    table: Any
    numbers: Any
    radius_scale: float
    depth_scale: float
    load_scale: float

    @property
    def is_plain(self) -> bool:
        """Whether it is a smooth punch, whose places are a/l."""
        return isinstance(self.numbers, PowerLaw) or (isinstance(self.numbers, Reduced) and self.numbers.kind == PLAIN)

    @property
    def is_one_wave(self) -> bool:
        """Whether it is the curve of curve/cosine.py."""
        return isinstance(self.numbers, Reduced) and self.numbers.kind == EXACT

    @property
    def curve(self) -> Any:
        """The curve in the form of core/path/; that of a smooth punch is one without waves."""
        numbers = self.numbers
        return numbers.curve if isinstance(numbers, General) else Cosine(numbers.first, numbers.second, 0.0)

    @property
    def coordinate(self) -> tuple[float, float]:
        """What is prescribed, as alpha and beta of alpha depth + beta load; the depth for all but general forms."""
        return self.curve[3:] if isinstance(self.numbers, General) else (1.0, 0.0)

    def flat_stiffness(self, place: float) -> float:
        """Return the load over the depth of a flat punch as wide as a place, K a^(1+k): of contact pinned there."""
        k = float((self.table[0] if isinstance(self.numbers, General) else self.table)["k"])
        return float((place if self.is_plain else TWO_PI * place) ** (1.0 + k))

    def states(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return reduced points, of shape (3, n): places >= 0 with their depths and loads."""
        points = np.empty((3, places.size))
        points[0] = places
        fill_points(self.table, self.numbers, points)
        return points

    def scaled(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return radius, depth and load of reduced points, of shape (3, n)."""
        return points[0] * self.radius_scale, points[1] * self.depth_scale, points[2] * self.load_scale


@dataclass(frozen=True)
class Subject:
    """The data from which all curves of a scene are drawn.

    Lengths are in R. `trace` has the branches of the exact curve (curve/branches.py) and `load_folds` the places
    where its load is extremal, both in places of the form `exact`; it is None where the curve folds too often to be
    drawn.
    """

    table: Any
    stretch: float
    wavelength: float
    chi: float
    mean_height: float
    rim: float
    end: float
    exact: Form
    trace: NDArray[np.float64] | None
    load_folds: NDArray[np.float64]

    @property
    def k(self) -> float:
        """The gradient exponent."""
        return float(self.table["k"])

    @property
    def bounded(self) -> bool:
        """Whether the punch has a rim."""
        return self.rim < math.inf

    def plain(self, pull: float, height: float = 0.0) -> Form:
        """Return the form of a smooth punch with a pull for its adhesion, its depth raised by a height (in R)."""
        return plain_form(self.table, self.stretch, pull, height)


def plain_form(table: Any, stretch: float, pull: float, height: float = 0.0) -> Form:
    """Return the form of a smooth punch (smooth.py)."""
    k = float(table["k"])
    length = smooth.smooth_length(k, stretch)
    depth_scale = 2.0 * length * length / (1.0 + k)
    return Form(table, Reduced(PLAIN, k, pull, height / depth_scale), length, depth_scale, smooth.FORCE_SCALE)


def wavy_form(table: Any, stretch: float, wavelength: float, mean_height: float) -> Form:
    """Return the exact form of one wave, in the scales of scene/cosine.py."""
    k = float(table["k"])
    (bend, gain, _), length, depth_scale = curve_of(k, stretch, wavelength, mean_height)
    load_scale = force_unit(k, length, depth_scale)
    return Form(table, Reduced(EXACT, bend, gain), wavelength, depth_scale, load_scale)


def _smooth_trace(k: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the one branch of a smooth punch, and where its load is least."""
    z_pull, z_in, z_out, last_depth = smooth.smooth_places(k)
    trace = np.full((ROWS, 1), math.nan)
    trace[START], trace[START_DEPTH] = z_out, last_depth
    trace[END] = trace[END_DEPTH] = math.inf
    trace[ARRIVAL], trace[UNLOADING_JUMPS] = z_in, UNKNOWN
    return trace, np.array([z_pull])


def _wavy_trace(form: Form, arches: tuple[float, float], furthest: float) -> tuple[NDArray[np.float64], Any]:
    """Return the branches of a wavy punch up to a place, and where its load is extremal."""
    curve = form.curve
    count, trace = walk(form.table, curve, arches, furthest, np.empty((ROWS, 64)), False)
    knots.polish_branches(form.table, curve, count, trace)
    return np.ascontiguousarray(trace[:, :count]), knots.folds_of_load(form.table, curve, furthest)


def subject_of(scene: Mapping[str, float]) -> Subject | None:
    """Return a scene ready for drawing, None where a parameter is outside its range.

    Parameters
    ----------
    scene
        The seven parameters (sweep.PARAMETERS).

    Returns
    -------
    The subject, drawn up to the rim. An unbounded punch is drawn up to the largest of 1.5 times the radius where the
    smooth curve crosses zero depth and 1.05 times the last fold of depth, extremum of load and jump of loading; where
    the curve cannot be drawn, 1.05 times the pull-off of the unloading envelope stands in for the latter.
    """
    k, nu, modulus, c0, wavelength, amplitude, rim = (float(scene[name]) for name in PARAMETERS)
    with np.errstate(all="ignore"):
        material = float(stiffness(k, nu, modulus, c0))
    if not (0.0 < material < math.inf and 0.0 < wavelength < math.inf and 0.0 <= amplitude < math.inf and rim > 0.0):
        return None
    table = table_of(k)
    stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / material)
    smooth_form = plain_form(table, stretch, 1.0)
    least = BEYOND_SMOOTH * smooth_form.radius_scale * 2.0 ** (2.0 / (3.0 + k))
    form, chi = smooth_form, 0.0
    if amplitude > 0.0:
        wavy = wavy_form(table, stretch, wavelength, amplitude * wavelength)
        curve = wavy.curve
        chi = float(table["amplitude"]) * curve.gain
        if not is_endless_wave(wavelength, amplitude):
            if not (0.0 < curve.bend < math.inf and chi < math.inf and min(rim, least) > _SMALLEST * wavelength):
                return None
            arches = extent(table, curve)
            if not is_smooth(arches):
                form = wavy
    furthest = rim / form.radius_scale
    trace, load_folds = None, np.empty(0)
    if form is smooth_form:
        trace, load_folds = _smooth_trace(k)
        load_folds = load_folds[load_folds < furthest]
    elif not knots.folds_too_often(table, curve, furthest):
        trace, load_folds = _wavy_trace(form, arches, furthest)
    end = rim
    if not rim < math.inf:
        envelope_pull = (0.5 * (3.0 + k) * (1.0 + chi)) ** (2.0 / (3.0 + k))
        last = envelope_pull * smooth_form.radius_scale
        if trace is not None and trace.size > 0 and load_folds.size > 0:
            last = form.radius_scale * max(trace[START, -1], trace[ARRIVAL, -1], load_folds[-1])
        end = max(least, BEYOND * last)
    return Subject(table, stretch, wavelength, chi, amplitude * wavelength, rim, end, form, trace, load_folds)
