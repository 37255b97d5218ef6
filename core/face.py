"""The questions that every kind of curve answers: each function is declared here once, and answered once per kind.

    Cosine      one cosine on a paraboloid under displacement control   curve/cosine.py       faces/cosine.py
    Series      any profile under any control                           curve/general.py      faces/series.py
    ShortWave   the leading form of any profile's short waves           curve/short_wave.py   faces/short_wave.py
    Patterned   any profile and control on a patterned interface        curve/patterned.py    faces/patterned.py

Numba chooses the answer by the type of `curve` when it compiles (compiler/dispatch.py); code for one kind of curve
calls its functions directly. All declarations share these arguments:

    table       what the curve is computed from: the table of the exponent (struve/table.py) for one cosine, the `Basis`
                of a series or of short waves, which begins with that table
    x           a place on the curve: the contact radius in wavelengths. A jump leaves the curve at `start` and reaches
                `end`
    level       a value of what is prescribed, the coordinate: the depth, of a series alpha depth + beta load; in units
                of s l^c
    trace       the branches of the curve, of shape (ROWS, branches or more): curve/branches.py names the rows
    near        what sensitivities need: the curve at neighbouring exponents, or how its basis changes
    total       slopes of an energy, of shape (SLOPES,), by the numbers of sensitivities/jump_slopes.py: added to

Energies are in units of 2 pi l^2 dgamma.
"""

from typing import Any, Final, TypeAlias

from gradhesion.core.compiler.dispatch import face
from gradhesion.core.curve.branches import Trace
from gradhesion.core.types import Floats, Harmonics, Slopes, Table, Work

AnyTable: TypeAlias = Any
"""The tables and series of a curve, by its kind (above)."""
AnyCurve: TypeAlias = Any
"""A curve of any kind."""
AnyNear: TypeAlias = Any
"""The inputs for sensitivities of a curve, by kind: `Near` of sensitivities/neighbours.py, or how a basis changes."""
_OF_PATHS: Final = tuple(f"gradhesion.core.faces.{kind}" for kind in ("cosine", "series", "short_wave", "patterned"))
_OF_EXACT: Final = (*_OF_PATHS[:2], _OF_PATHS[3])
_OF_SERIES: Final = _OF_PATHS[1:]
_OF_FOLDS: Final = _OF_EXACT[1:]
_OF_CONTACT: Final = tuple(
    f"gradhesion.core.faces.{kind}" for kind in ("cosine_contact", "series_contact", "patterned")
)
_OF_SLOPES: Final = tuple(f"gradhesion.core.faces.{kind}_slopes" for kind in ("cosine", "series"))


# the path of a cycle: all kinds


@face(*_OF_PATHS)
def find_place(table: AnyTable, curve: AnyCurve, level: float, trace: Trace, branch: int) -> float:
    """Return the place at which a branch meets a level: one between those of its two ends, on the rising curve."""


@face(*_OF_PATHS)
def loss_between(table: AnyTable, curve: AnyCurve, start: float, end: float, work: Work) -> float:
    """Return the energy that a jump from one place to another one loses, at the level of its start.

    `work` is room for 16 floats. The end may be 0 where k = 1: there the contact shrinks to a point.
    """


@face(*_OF_PATHS)
def loss_from_zero(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return the energy that the jump from zero contact to x > 0 loses, at the level 0."""


@face(*_OF_PATHS)
def loss_to_zero(table: AnyTable, curve: AnyCurve, x: float, level: float) -> float:
    """Return the energy that the jump-out from x > 0 loses, at a level; 0 under a dead load: there it has no bound."""


@face(*_OF_PATHS)
def depth_at(table: AnyTable, curve: AnyCurve, x: float, level: float) -> float:
    """Return the depth at x >= 0, a place where the coordinate is `level`, in units of s l^c."""


# the waves of a profile: all kinds but that of one cosine


@face(*_OF_SERIES)
def waves_at(table: Any, curve: Any, x: float, whole: float) -> tuple[float, float, float, float]:
    """Return w0 and w1, the waves of depth and load, at whole + x > 0, and v, those of D, with dv/dz.

    curve/general.py says what they are; of a curve that prescribes the depth v = d(z w0)/dz.
    """


@face(*_OF_SERIES)
def depth_of_point(table: Any, curve: Any) -> float:
    """Return the depth to which that of a contact tends as its radius goes to 0, in units of s l^c."""


@face(*_OF_SERIES)
def relative_toughness(table: Any, curve: Any, x: float) -> float:
    """Return kappa, the toughness at x over that of a plain interface: a jump loses int z (kappa^2 - rho^2) dz."""


@face(*_OF_SERIES)
def shortest_wave(table: Any, curve: Any) -> float:
    """Return the number of the shortest wave of profile and interface in a unit of x, 0 if there is none."""


# where any profile folds: all of them that are exact


@face(*_OF_FOLDS)
def punch_of(table: Any, curve: Any) -> tuple[Any, Harmonics, float]:
    """Return what the waves of the punch are computed from: the bins of its cosines, its harmonics, and g."""


@face(*_OF_FOLDS)
def window(table: Any, curve: Any) -> tuple[float, float]:
    """Return x before which the coordinate surely falls, or one below all others, and x beyond which it surely rises.

    The second is inf where folds need not end.
    """


@face(*_OF_FOLDS)
def find_all_folds(table: Any, curve: Any, first: float, last: float, zeros: Floats) -> tuple[int, bool, float]:
    """Put all folds between two x into `zeros`, of shape (folds,), in order; first < last < inf.

    Returns
    -------
    Their number, -1 if there are too many for `zeros` or to be searched; whether the coordinate rises at the first x;
    and the first x of a pair of folds that an error of CLOSE (curve/cosine_folds.py) could make or unmake, else inf.
    """


@face(*_OF_FOLDS)
def measured_by(curve: Any, by_load: bool) -> Any:
    """Return the curve, of the same kind, whose coordinate is the load, or the depth."""


@face(*_OF_FOLDS)
def reach(table: Any, curve: Any, target: float) -> float:
    """Return x from which on the coordinate exceeds a target by the sizes of its waves, inf if beyond all counting.

    It is too large by some percent, and not rigorous near zero contact, where the waves do not have their far form.
    """


# waves of a trace that were not walked, its gap: all that is exact


@face(*_OF_EXACT)
def gap_in(curve: AnyCurve, trace: Trace) -> float:
    """Return the branch of a trace before which waves stand that were not walked, inf if there are none."""


# decisions that are close: all that is exact


@face(*_OF_EXACT)
def size_at(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return the size of the coordinate's terms at x > 0, the sum of their absolute values."""


@face(*_OF_EXACT)
def most_size_at(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return a bound of `size_at` that takes no power of x, inf if there is none."""


@face(*_OF_EXACT)
def fold_at(table: AnyTable, curve: AnyCurve, x: float) -> tuple[float, float]:
    """Return D at x > 0, whose zeros are the folds of the coordinate, and dD/dz."""


# the gap between the surfaces outside a contact: all that is exact


@face(*_OF_CONTACT)
def table_of(table: AnyTable, curve: AnyCurve) -> Table:
    """Return the table of the exponent, the record of struve/layout.py."""


@face(*_OF_CONTACT)
def coordinate_at(table: AnyTable, curve: AnyCurve, x: float, whole: float) -> float:
    """Return the coordinate at whole + x > 0; `whole` is a number of waves, 0 or beyond z = 40."""


@face(*_OF_CONTACT)
def surely_open(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return the fall of the coordinate over a jump of loading from x > 0 up to which it surely leaves one disc."""


@face(*_OF_CONTACT)
def is_always_one_disc(table: AnyTable, curve: AnyCurve) -> bool:
    """Return whether every contact on the curve is known to be one disc."""


@face(*_OF_CONTACT)
def touches_at_centre(table: AnyTable, curve: AnyCurve, end: float) -> bool:
    """Return whether the punch is nowhere, up to the radius `end`, lower than at its centre."""


@face(*_OF_CONTACT)
def waves_are_one_disc(table: AnyTable, curve: AnyCurve, trace: Trace) -> bool:
    """Return whether the contact is one disc at the ends of the waves in the gap of a trace that loading passes."""


@face(*_OF_CONTACT)
def panels_of(table: AnyTable, curve: AnyCurve) -> tuple[float, float]:
    """Return the shortest wave in lambda, inf for none, and the largest ratio of radii in one panel, inf for any.

    In a panel of that ratio the power of the profile is a polynomial to 1e-12.
    """


@face(*_OF_CONTACT)
def profile_at(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return the height of the punch at x over that of its centre, in units of s l^c."""


@face(*_OF_CONTACT)
def edge_at(table: AnyTable, curve: AnyCurve, x: float) -> Any:
    """Return the edge (contact/gap.py) of a contact of radius x > 0 on the curve."""


@face(*_OF_CONTACT)
def excess_at(table: AnyTable, curve: AnyCurve, edge: Any, x: float) -> tuple[float, float]:
    """Return by how much depth_H at the radius x > 0 exceeds the depth of a contact, and z^c, in units of s l^c."""


@face(*_OF_CONTACT)
def fill_heights(table: AnyTable, curve: AnyCurve, edge: Any, low: float, width: float, heights: Floats) -> None:
    """Fill F (contact/gap.py) at the 16 nodes of x^2 from low^2 to low^2 + width into `heights`, of shape (16,)."""


# sensitivities: all that is exact


@face(*_OF_SLOPES)
def steepness_at(table: AnyTable, curve: AnyCurve, x: float) -> float:
    """Return the slope of the coordinate at x > 0 by z."""


@face(*_OF_SLOPES)
def rim_slope(table: AnyTable, curve: AnyCurve, level: float, x: float) -> float:
    """Return the slope by ln x of the energy of a jump at a level that ends at x > 0, on no branch."""


@face(*_OF_SLOPES)
def add_slopes(
    table: AnyTable, curve: AnyCurve, near: AnyNear, start: float, end: float, work: Work, total: Slopes
) -> None:
    """Add the slopes of `loss_between`, of a jump whose ends are fixed; `work` is room for 48 floats."""


@face(*_OF_SLOPES)
def add_slopes_to_zero(table: AnyTable, curve: AnyCurve, near: AnyNear, x: float, inwards: bool, total: Slopes) -> None:
    """Add the slopes of `loss_to_zero` at the level of x > 0 (inwards), or those of `loss_from_zero`."""


@face(*_OF_SLOPES)
def start_of_wave(table: AnyTable, curve: AnyCurve, wave: float) -> tuple[float, float]:
    """Return place and level of the start of the branch on a wave of a gap; NaN if a trace of this kind has none."""


@face(*_OF_SLOPES)
def add_slopes_of_waves(
    table: AnyTable,
    curve: AnyCurve,
    near: AnyNear,
    waves: tuple[float, float],
    outwards: bool,
    final: float,
    work: Work,
    total: Slopes,
) -> None:
    """Add the slopes of all jumps from the first to the last of some waves of a gap, each to the next wave.

    `final` is the last arch on which the curve folds; `work` is room for 112 floats. Where a trace of this kind has no
    gap, NaN is added.
    """
