"""One scene made ready for drawing: its two curves of equilibrium, how far they are drawn, where the cycle turns.

Loading follows the curve of closing, unloading that of opening (physics 16); at closing_ratio 1 both are one. Radii are
y = 2 pi a/lambda. Curves reach to the rim. Those of an unbounded punch end at 1.5 times the radius where the smooth
curve crosses zero depth, or 5 % beyond the last fold, extremum of depth or load, or landing of loading; where a cycle
turns at a depth or a load, 5 % beyond that and the pull-off.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.folds import find_folds
from gradhesion.core.curve.levels import polished
from gradhesion.core.curve.trace import END, LANDING, START, room_for
from gradhesion.core.curve.values import Curve
from gradhesion.core.cycle.path import walk_loading
from gradhesion.core.draw.sampling import Line, line_of
from gradhesion.core.edge.pattern import Pattern, patterned_table
from gradhesion.core.jit import kernel
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import UNIT_OF_FORCE, Punch, crest_of
from gradhesion.core.scenes.requests import Request, columns_of, scenes_of, set_lengths
from gradhesion.core.scenes.tables import MOST_BINS, long_table
from gradhesion.core.scenes.tasks import FINEST, prepared
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.filling import width_of
from gradhesion.core.table.layout import EXACT, LANES, Source, Table, span_of
from gradhesion.core.types import Floats, Integers

BEYOND: Final = 1.05
"""How far an unbounded punch is drawn beyond its last fold or jump."""
_BEYOND_SMOOTH: Final = 1.5  # how far it is drawn at least, in radii where the smooth curve is at zero depth
_LEAST: Final = 1e-5
"""Radii y that are resolved: a wave may be some hundred thousand times as long as the contact is wide."""
_SAME: Final = 1e-8  # relative distance below which the turn of a cycle and the landing of a jump are one


class Frame(NamedTuple):
    """A scene in its reduced form (scenes/reduced.py).

    punch             shape, control and pattern
    scenes, reduced   its parameters and reduced numbers, a column each
    finer             by how much its bins are narrower than those of its profile
    """

    punch: Punch
    scenes: Floats
    reduced: Floats
    finer: int

    @property
    def k(self) -> float:
        """The gradient exponent."""
        return float(self.scenes[at.K, 0])

    @property
    def units(self) -> Floats:
        """The units of radius and depth in R and of load in 1.5 pi R w_o, (3,)."""
        length, depth, load = self.reduced[[at.LENGTH, at.DEPTH, at.LOAD], 0]
        return np.array([length, depth, load * UNIT_OF_FORCE])

    @property
    def root(self) -> float:
        """The root of the ratio of the works of closing and opening."""
        return math.sqrt(self.reduced[at.CLOSING, 0])

    @property
    def rim(self) -> float:
        """The radius y of the rim."""
        return float(self.reduced[at.RIM_Y, 0])

    @property
    def is_patterned(self) -> bool:
        """Whether the toughness varies with the radius."""
        return self.punch.rows.shape[1] > 0

    def place(self, level: float, pull: float) -> float:
        """Return y where B y^m is a level times a pull of y^((1-k)/2), 0 for a pull below 0."""
        power = self.punch.exponent - 0.5 * (1.0 - self.k)
        return float((level * max(0.0, pull) / self.reduced[at.BY_POWER, 0]) ** (1.0 / power))

    def radii(self, y: Floats, end: float) -> Floats:
        """Return a/R of radii y; that of the rim as it was given."""
        rim = self.scenes[at.RIM, 0] if end == self.rim else end * self.units[0]
        return np.where(y == end, rim, y * self.units[0])


class Side(NamedTuple):
    """One curve of a scene.

    line      as it is drawn
    curve     in its own units
    trace     its branches, ends to rounding
    extrema   radii at which depth or load is extremal without an end of a branch, in order
    visited   columns of the branches that loading visits
    """

    line: Line
    curve: Curve
    trace: Floats
    extrema: Floats
    visited: Integers


class Drawn(NamedTuple):
    """A scene ready for drawing.

    frame             in reduced form
    end               how far it is drawn
    turn              where its cycle turns; 0: before it makes contact; NaN: not known
    turned            whether it turns at a given depth or load, not at the rim
    sides             its curves of closing and opening; none if they fold too often to be drawn
    grows             whether contact grows from a point, so that its first jump is none
    """

    frame: Frame
    end: float
    turn: float
    turned: bool
    sides: tuple[Side, ...]
    grows: bool = False


def frame_of(request: Request) -> Frame | None:
    """Return one scene that turns at its rim in its reduced form, None where a parameter is outside its range."""
    punch, scenes = request.punch, scenes_of(columns_of(request)[0], 0, 1)
    set_lengths(punch, scenes)
    reduced, finer = prepared(punch, EXACT, scenes)
    known = finer[0] <= FINEST and bool(reduced[at.VALID, 0])
    return Frame(punch, scenes, reduced, int(finer[0])) if known else None


@kernel
def _trace(curve: Curve, y_end: float, trace: Floats) -> int:
    """Fill the trace of a curve, the ends of its branches to rounding; return as `find_folds`."""
    count = find_folds(curve, y_end, trace)
    for j in range(count):
        trace[START, j] = polished(curve, trace[START, j], math.nan)
        trace[END, j] = polished(curve, trace[END, j], math.nan)
    return count


def _trace_of(curve: Curve, y_end: float) -> Floats | None:
    """Return the trace of a curve, a column for each branch; None if its table is too short."""
    trace = room_for(curve.table.bins)
    count = _trace(curve, y_end, trace)
    return None if count < 0 else np.ascontiguousarray(trace[:, :count])


def ends_of(trace: Floats, end: float) -> Floats:
    """Return where branches of a trace start or end, in order, between 0 and `end` (excluded)."""
    ends = np.sort(trace[[START, END]].ravel())
    return ends[(ends > 0.0) & (ends < end)]


def extrema_of(curve: Curve, y_end: float) -> Floats | None:
    """Return the radii at which what a curve prescribes is extremal, in order; None if its table is too short."""
    trace = _trace_of(curve, y_end)
    return None if trace is None else ends_of(trace, min(y_end, span_of(curve.table)))


def waves_of(frame: Frame) -> tuple[float, float]:
    """Return half the shortest wave of a scene in y, and a bound of its waves of depth over y^((1-k)/2)."""
    half = math.pi / float(frame.punch.waves[:, 0].max())
    crest = crest_of(frame.k, frame.punch.waves) * frame.reduced[at.BY_WAVES, 0]
    if frame.is_patterned:
        half = min(half, math.pi / (frame.punch.rows.shape[1] * frame.reduced[at.PATTERN_WAVES, 0]))
        crest += frame.reduced[at.MOST, 0] ** 2 - 1.0
    return half if crest > 0.0 else math.inf, crest


def table_for(frame: Frame, form: int, y_end: float) -> tuple[Table, Source, float] | None:
    """Return the table of a scene up to y_end, its source, and the crest of -U'; None where it cannot be resolved."""
    if not min(y_end, frame.place(1.0, 1.0)) >= _LEAST or y_end > MOST_BINS * width_of(frame.punch.waves, frame.finer):
        return None
    return long_table(frame.punch, frame.k, form, frame.finer, y_end)


def _side(frame: Frame, root: float, made: tuple[Table, Source, float], y_end: float) -> Side | None:
    """Return the curve of a work of adhesion, `root`^2 of that of opening; None: the table is too short."""
    table, source, crest = made
    B, g, by_depth, by_load = frame.reduced[[at.BY_POWER, at.BY_WAVES, at.BY_DEPTH, at.BY_LOAD], 0].tolist()
    B, g = B / root, g / root
    if frame.is_patterned:
        numbers = frame.reduced[at.PATTERN_WAVES, 0], frame.scenes[at.PATTERN_AMPLITUDE, 0]
        bounds = frame.reduced[at.MOST, 0], frame.reduced[at.STEEP, 0]
        pattern = Pattern(frame.punch.rows, *numbers, frame.punch.of_work, *bounds)
        end, room = min(y_end, span_of(table)), room_of(table.bins, LANES + 1)
        table, g = patterned_table(table, crest, g, pattern, end, *room), 1.0
    curve = Curve(table, B, g, by_depth, by_load)
    weights = [(1.0, 0.0)] * (by_load != 0.0) + [(0.0, 1.0)] * (by_depth != 0.0)
    extrema = [found for by in weights if (found := extrema_of(Curve(table, B, g, *by), y_end)) is not None]
    trace, visited = _trace_of(curve, y_end), np.empty(table.bins + 8, dtype=np.int64)
    if trace is None or len(extrema) < len(weights):
        return None
    count = trace.shape[1]
    visited = visited[: walk_loading(curve, trace, count, visited)]
    if count > 0 and trace[END, -1] == math.inf and count - 1 not in visited and span_of(table) < y_end:
        return None
    line = line_of(curve, source, frame.units * np.array([1.0, root, root]), *waves_of(frame))
    return Side(line, curve, trace, np.sort(np.concatenate(extrema)), visited)


def _end_of(frame: Frame, y_end: float, sides: tuple[Side, ...]) -> float:
    """Return how far a punch is drawn: an unbounded one, without sides, as far as the pull-off of its envelope."""
    if y_end < math.inf:
        return y_end
    pull = 1.0 + waves_of(frame)[1] if not sides else 0.0
    last = [frame.place(0.5 * (3.0 + frame.k) / frame.punch.exponent, pull)]
    for side in sides:
        last += [side.trace[START, -1], side.trace[LANDING, side.visited[-1]], *side.extrema[-1:]]
    return max(_BEYOND_SMOOTH * frame.place(1.0, 1.0), BEYOND * max(last))


def draw_scene(frame: Frame, turn: float | None, pulled: float) -> Drawn:
    """Make a scene ready for drawing.

    `turn` is a/R where its cycle turns, None if that is the rim; 0 without contact, NaN if it is not known. `pulled` is
    a/R of the pull-off, if an unbounded punch turns.
    """
    length, y_end, sides = frame.units[0], frame.rim, tuple[Side, ...]()
    turned = y_end if turn is None else turn / length
    if y_end == math.inf and turn is not None:
        y_end = BEYOND * float(np.fmax(turned, pulled / length))
    need = min(max(frame.reduced[at.WINDOW, 0], frame.reduced[at.PULL, 0]), y_end)
    if frame.is_patterned and y_end < math.inf:
        need = y_end
    roots = (frame.root, 1.0) if frame.root != 1.0 else (1.0,)
    while (made := table_for(frame, EXACT, need)) is not None:
        found = [side for root in roots if (side := _side(frame, root, made, y_end)) is not None]
        sides = (found[0], found[-1]) if len(found) == len(roots) else ()
        if sides and not (frame.is_patterned and _end_of(frame, y_end, sides) > span_of(sides[1].curve.table)):
            break
        need = min(3.0 * need, y_end)
    else:
        sides = ()
    end = _end_of(frame, y_end, sides)
    turned = end if turned == math.inf else turned
    if sides and turned < frame.rim:
        landings = sides[0].trace[LANDING, sides[0].visited]
        near = landings[np.abs(landings - turned) <= _SAME * turned]
        turned = float(near[0]) if near.size else turned
    return Drawn(frame, end, turned, turn is not None, sides)
