"""The path of a loop with its units and offsets, and how it moves with what is fitted.

A distance to a curve changes with a parameter as the curve moves across itself, whatever moves along it. So the
vertices are moved at fixed contact radius a: depth and load of equilibrium at a are closed forms (docs/theory.md),
and no derivative of a fold or of a landing is needed. A jump stays where its fold is, which is a stationary point. The
contact that is pinned at the rim is moved at fixed depth. The closed forms are differentiated by central differences,
good to 1e-9.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from gradhesion.core.answers.loop_points import OFFSETS
from gradhesion.core.curve.branches import ARRIVAL, END, START
from gradhesion.core.curves import general, path
from gradhesion.core.curves.forms import point
from gradhesion.core.curves.subject import Subject, subject_of
from gradhesion.core.equations import hertz, jkr
from gradhesion.core.equations.pair import cosine_integrals, sine_integrals
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import JUMP_IN_TO_RIM, NO_VALUE
from gradhesion.core.sweep import solve
from gradhesion.core.variables.reduced import WAYS, parameters_from

_Array = NDArray[np.float64]

LINEAR: Final = ("k", "nu", "indentation_max", *OFFSETS)
"""What is searched as it is; all else by its logarithm."""
_STEP: Final = 1e-5
"""Of the differences: the error is that of its square, or 1e-16 over it."""
_REACH: Final = 1.5
"""How far branches are looked for first, over the radius of contact without adhesion or waves at the depth."""
_OFF: Final = 1e-9
"""Of the depth: what is further from equilibrium is pinned at the rim."""
_INSTEAD: Final[dict[str, frozenset[str]]] = {
    parameter: frozenset(WAYS[parameter]) for parameter in ("c0_over_R", "lambda_over_R", "a_max_over_R")
}
"""The keys in whose place something without effect stands by default."""


@dataclass(frozen=True, eq=False)
class LoopPath:
    """A path in SI units, offsets included.

    Attributes
    ----------
    places
        Rows of depth in m (of the machine, where its displacement is measured) and load in N: first along the line of
        no load, then loading, unloading, and back along that line.
    radius
        The contact radius of each, in m; 0 out of contact.
    jump
        Whether each is reached by a jump.
    turn
        The number of the vertex at which loading ends and unloading begins.
    """

    places: _Array
    radius: _Array
    jump: NDArray[np.bool_]
    turn: int


class LoopModel:
    """What draws the path of a loop from the numbers that are searched.

    Parameters
    ----------
    fixed
        Numbers by name, in SI units (`fit_loop`).
    names
        What is searched, in order; `OFFSETS` may be the last.
    deepest, first
        Where the data turn, and where the line of no load begins, in m.
    profile
        The shape of the punch.
    through_machine
        Whether the depth is that of the far end of a machine: what is measured is depth + load/spring_constant.
    """

    def __init__(
        self,
        fixed: Mapping[str, float],
        names: tuple[str, ...],
        *,
        deepest: float,
        first: float,
        profile: Profile,
        through_machine: bool = False,
    ) -> None:
        self.fixed, self.names, self.profile = dict(fixed), names, profile
        self.deepest, self.first = deepest, first
        self.loading = Loading(control="machine") if through_machine else Loading()
        self._turns_with_data = not {"indentation_max", "preload"} & {*fixed, *names}

    def values(self, vectors: _Array) -> dict[str, Any]:
        """Give what is searched its names and units: numbers of one vector, arrays of the rows of several."""
        return {
            name: column if name in LINEAR else np.exp(column)
            for name, column in zip(self.names, np.moveaxis(vectors, -1, 0), strict=True)
        }

    def given(self, own: Mapping[str, Any]) -> dict[str, Any]:
        """Put what is searched beside what is fixed, and what has no effect in the place of what is left out."""
        given = {"a_max_over_R": math.inf, "c0_over_R": 1.0, "lambda_over_R": 1.0} | self.fixed
        given |= {name: value for name, value in own.items() if name not in OFFSETS}
        for role, others in _INSTEAD.items():
            if others & given.keys():
                given.pop(role, None)
        return given

    def path(self, vector: _Array) -> LoopPath | None:
        """Draw the path; None where the scene has none."""
        own = self.values(vector)
        shift = np.array([float(own.get(name, 0.0)) for name in OFFSETS])
        given = self.given(own)
        made = {name: float(value) for name, value in parameters_from(given).items()}
        R, work = float(given["R"]), float(given["work_of_adhesion"])
        scene = {name: made[name] for name in PARAMETERS}
        compliance = 0.0
        if self.loading.control == "machine":
            scene["machine_stiffness"] = made["machine_stiffness"]
            compliance = 1.0 / (R * made["machine_stiffness"] * made["modulus"] * work)  # of the machine, in R/N
        unit = 1.5 * math.pi * R * work
        targets: dict[str, float] = {name: made[name] for name in TURNS if name in made}
        if self._turns_with_data:
            targets["indentation_max_over_R"] = (self.deepest - shift[0]) / R
        drawn = self._drawn(scene, targets, compliance * unit)
        if drawn is None:
            return None
        radius, depth, load, jump, unloading = drawn
        places = np.column_stack([R * (depth + compliance * unit * load), unit * load])
        if not np.isfinite(places).all():
            return None
        places, radius, jump, unloading = self._halved(vector, places, R * radius, jump, unloading)
        far = np.array([[self.first - shift[0], 0.0]])
        return LoopPath(
            np.concatenate([far, places, far]) + shift,
            np.concatenate([[0.0], radius, [0.0]]),
            np.concatenate([[False], jump, [False]]),
            int(np.count_nonzero(~unloading)),
        )

    def _halved(
        self, vector: _Array, places: _Array, radius: _Array, jump: Any, unloading: Any
    ) -> tuple[_Array, _Array, Any, Any]:
        """Halve the chords of branches by the points of the exact curve between: they are then off by a quarter."""
        curved = (radius[1:] > 0.0) & (radius[:-1] > 0.0) & (radius[1:] != radius[:-1]) & ~jump[1:]
        after = np.flatnonzero(curved) + 1
        middle = 0.5 * (radius[after] + radius[after - 1])
        depth, load, _, compliance = self._states(vector[None], middle)
        between = np.column_stack([depth[0] + compliance[0] * load[0], load[0]])
        return (
            np.insert(places, after, between, axis=0),
            np.insert(radius, after, middle),
            np.insert(jump, after, False),
            np.insert(unloading, after, unloading[after]),
        )

    def status(self, vector: _Array) -> int:
        """Return what `solve` reports of the cycle, turned at the radius at which its path does."""
        drawn = self.path(vector)
        if drawn is None:
            return NO_VALUE
        given = self.given(self.values(vector))
        made = {name: float(value) for name, value in parameters_from(given).items()}
        scene = {name: made[name] for name in PARAMETERS}
        if self.loading.control == "machine":
            scene["machine_stiffness"] = made["machine_stiffness"]
        radius = float(drawn.radius[drawn.turn]) / float(given["R"])
        if radius == 0.0:
            return 0
        scene["a_max_over_R"] = min(scene["a_max_over_R"], radius)
        wanted = ["dissipated_energy", "loading_jumps", "unloading_jumps"]
        found = int(solve(scene, wanted, profile=self.profile, loading=self.loading, threads=1)["status"])
        return found & ~(JUMP_IN_TO_RIM if radius < made["a_max_over_R"] else 0)

    def _drawn(
        self, scene: Mapping[str, float], targets: Mapping[str, float], compliance: float
    ) -> tuple[Any, ...] | None:
        """Return radius, depth, load, jump and unloading of the vertices of a cycle, in units of the theory."""
        rim, own = scene["a_max_over_R"], (self.profile, self.loading)
        if "load_max" in targets:
            asked = {**scene, "load_max": targets["load_max"]}
            radius = float(
                solve(asked, ["turning_radius"], profile=own[0], loading=own[1], threads=1, check_contact=False)[
                    "turning_radius"
                ]
            )
            subject = self._subject(scene, min(rim, radius)) if radius > 0.0 else None
        else:
            depth = targets.get("indentation_max_over_R", math.inf)
            subject = self._turned(scene, depth, compliance)
            radius = 0.0 if subject is None else subject.end
        if radius == 0.0:
            depth = max(0.0, targets.get("indentation_max_over_R", 0.0))
            return np.zeros(2), np.array([0.0, depth]), np.zeros(2), np.zeros(2, bool), np.zeros(2, bool)
        if subject is None or subject.trace is None:
            return None
        with np.errstate(all="ignore"):
            found: dict[str, Any] = path.draw_path(subject)
        names = ("contact_radius", "indentation", "load", "jump", "unloading")
        a, depth, load, jump, unloading = (found[f"path_{name}"] for name in names)
        drawn = a, depth, load, jump > 0, unloading > 0
        deepest = targets.get("indentation_max_over_R", -math.inf)
        return _pressed(drawn, scene, deepest, compliance) if radius == rim else drawn

    def _subject(self, scene: Mapping[str, float], rim: float) -> Subject | None:
        """Make a scene with its rim elsewhere ready for drawing."""
        moved = {**scene, "a_max_over_R": rim}
        if self.profile == Profile() and self.loading == Loading():
            return subject_of(moved)
        return general.subject_of(moved, self.profile, self.loading)

    def _turned(self, scene: Mapping[str, float], target: float, compliance: float) -> Subject | None:
        """Make a scene ready for drawing with its rim where the depth, of the machine if there is one, is first met.

        None without contact. Loading visits a branch from its arrival to its end; within a jump it turns at its end.
        """
        rim = scene["a_max_over_R"]
        if target == math.inf or math.isnan(target):
            return self._subject(scene, rim)
        if target <= 0.0:
            return None
        smooth = math.sqrt(2.0 * (1.0 + scene["k"]) * max(target, 1e-12))
        for reach in (_REACH * smooth, 4.0 * _REACH * smooth, math.inf):
            subject = self._subject(scene, min(rim, reach))
            if subject is None or subject.trace is None:
                return subject
            found = _first_reached(subject, target, compliance)
            if found is not None:
                place = found * subject.exact.radius_scale
                trace = subject.trace[:, subject.trace[START] <= found]
                return replace(subject, rim=place, end=place, trace=np.ascontiguousarray(trace))
            if reach >= rim:
                return subject
        return subject

    def moving(self, vector: _Array, drawn: LoopPath) -> _Array:
        """Return how the vertices of a path move with each number that is searched, at fixed contact radius.

        Returns
        -------
        Of shape (vertices, 2, numbers). Out of contact vertices move with the offsets alone.
        """
        count = len(self.names)
        steps = np.diag([_STEP * (abs(value) or 1.0) if name in ("indentation_max", *OFFSETS) else _STEP
                         for name, value in zip(self.names, vector, strict=True)])  # fmt: skip
        moved = np.zeros((drawn.radius.size, 2, count))
        inner = [i for i, name in enumerate(self.names) if name not in (*OFFSETS, "indentation_max", "preload")]
        within = np.flatnonzero(drawn.radius > 0.0)
        if inner and within.size:
            shift = np.array([vector[self.names.index(name)] if name in self.names else 0.0 for name in OFFSETS])
            own = drawn.places[within] - shift
            rows = np.array([vector, *(vector + sign * steps[i] for i in inner for sign in (1.0, -1.0))])
            depth, load, slope, compliance = self._states(rows, drawn.radius[within])
            # the depth of the contact itself, which the pinned contact keeps
            actual = own[:, 0] - compliance[0] * own[:, 1]
            pinned = np.abs(actual - depth[0]) > _OFF * np.ptp(actual) + 1e-12 * np.abs(actual)
            held = load + slope * (actual - depth)
            x = np.where(pinned, actual + compliance * held, depth + compliance * load)
            y = np.where(pinned, held, load)
            for j, i in enumerate(inner):
                width = 2.0 * steps[i, i]
                moved[within, 0, i] = (x[1 + 2 * j] - x[2 + 2 * j]) / width
                moved[within, 1, i] = (y[1 + 2 * j] - y[2 + 2 * j]) / width
        for axis, name in enumerate(OFFSETS):
            if name in self.names:
                moved[:, axis, self.names.index(name)] = 1.0
        return moved

    def _states(self, vectors: _Array, radius: _Array) -> tuple[_Array, _Array, _Array, _Array]:
        """Return depth, load and dP/d(depth) at fixed radius, and the machine's compliance, in SI: a row a vector."""
        own = {name: column[:, None] for name, column in self.values(vectors).items()}
        given = self.given(own)
        made = parameters_from(given)
        R, work = np.asarray(given["R"], dtype=float), np.asarray(given["work_of_adhesion"], dtype=float)
        k, m = made["k"], self.profile.exponent
        M = stiffness(k, made["nu"], made["modulus"], made["c0_over_R"])
        a = radius / R
        first, second = self._waves(k, a / made["lambda_over_R"], made["A"])
        smooth = hertz.power_indentation(k, a, m)
        disc, pull = hertz.disc_stiffness(k, M, a), jkr.adhesive_depth(k, M, a)
        unit = 1.5 * math.pi * R * work
        depth = R * (smooth + a * first - pull)
        load = unit * disc * (smooth * m / (1.0 + k + m) + a * (first - second) - pull)
        compliance = np.zeros((vectors.shape[0], 1))
        if self.loading.control == "machine":
            compliance = compliance + 1.0 / (made["machine_stiffness"] * made["modulus"] * work)
        shape = (vectors.shape[0], radius.size)
        depth, load, slope = (np.broadcast_to(each, shape) for each in (depth, load, unit * disc / R))
        return depth, load, slope, compliance

    def _waves(self, k: _Array, x: _Array, A: _Array) -> tuple[Any, Any]:
        """Return what the waves add to delta_H/a and to I/a^(2+k)."""
        waves = self.profile.harmonics if np.any(A > 0.0) else ()
        first: Any = 0.0
        second: Any = 0.0
        for wave in waves:
            size = 2.0 * math.pi * A * wave.n
            if wave.cos:
                S0, S1 = sine_integrals(k, wave.n * x)[:2]
                first, second = first + size * wave.cos * S0, second + size * wave.cos * S1
            if wave.sin:
                C0, C1 = cosine_integrals(k, wave.n * x)
                first, second = first + size * wave.sin * C0, second + size * wave.sin * C1
        return first, second


def _first_reached(subject: Subject, target: float, compliance: float) -> float | None:
    """Return the place at which loading first has a depth, or None where it has not within the rim.

    `compliance` is that of a machine whose own displacement counts, in R by the unit of load; a depth that is passed in
    a jump is reached at its end.
    """
    form, trace = subject.exact, subject.trace
    assert trace is not None  # noqa: S101 (asked before)
    rim = subject.rim / form.radius_scale

    def beyond(place: float) -> float:
        depth, load = point(form.kind, form.table, form.numbers, place)
        return float(depth * form.depth_scale + compliance * load * form.load_scale - target)

    for branch in range(trace.shape[1]):
        arrival, end = float(trace[ARRIVAL, branch]), float(trace[END, branch])
        if not arrival <= rim:
            continue
        if beyond(arrival) >= 0.0:
            return arrival
        top = min(end, rim)
        if top == math.inf:
            top = 2.0 * arrival
            while beyond(top) < 0.0:
                top *= 2.0
        if beyond(top) >= 0.0:
            return float(brentq(beyond, arrival, top, xtol=1e-300, rtol=1e-14))
    return None


def _pressed(drawn: tuple[Any, ...], scene: Mapping[str, float], target: float, compliance: float) -> tuple[Any, ...]:
    """Add where the contact, pinned at the rim, is pressed on to a depth beyond the path, if it is."""
    _, depth, load, _, unloading = drawn
    last = int(np.count_nonzero(~unloading)) - 1
    reached = depth[last] + compliance * load[last]
    if not target > reached:
        return drawn
    k, nu, modulus, c0 = (scene[name] for name in PARAMETERS[:4])
    disc = float(hertz.disc_stiffness(k, stiffness(k, nu, modulus, c0), scene["a_max_over_R"]))
    more = (target - reached) / (1.0 + compliance * disc)
    row = (scene["a_max_over_R"], depth[last] + more, load[last] + disc * more, False, False)
    return tuple(np.insert(each, last + 1, value) for each, value in zip(drawn, row, strict=True))
