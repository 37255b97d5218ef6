"""The curves of a loop: depth and load of equilibrium at any contact radius, from the numbers that are searched.

At a contact radius a the depth and the load are closed forms (docs/theory.md),

    delta = delta_H(a) - g kappa(a) Delta(a),    P = P_H(a) - g kappa(a) S(a) Delta(a),

with S the stiffness of a flat disc, kappa the toughness of the place over its mean, and g = 1 where the edge opens, the
root of the closing ratio where it closes. Paths, and how they move, need nothing else.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.closed.reduced import WAYS, parameters_from
from gradhesion.core.equations import hertz, jkr
from gradhesion.core.loops.fitted import OFFSETS
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import CLOSING, MACHINE, PARAMETERS, PATTERN, SPEED, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness, rows_of_pattern, series_at
from gradhesion.core.types import Floats

EXPONENT: Final = "exponent"
"""The name of the power of the speed, where it is searched."""
TURN: Final = "turn"
"""The name of the displacement, or the load, of the turn in the data, where it is searched too."""
LINEAR: Final = (*(name for name, one in INPUTS.items() if one.is_linear), EXPONENT, *OFFSETS, TURN)
"""Names searched on a linear scale; all others are searched by their logarithm."""
_WITHOUT_EFFECT: Final = {"a_max_over_R": math.inf, "c0_over_R": 1.0, "lambda_over_R": 1.0}
"""Values of what may be left out where it has no effect."""
AMPLITUDES: Final = ("A", *WAYS["A"])
WAVELENGTHS: Final = ("lambda_over_R", *WAYS["lambda_over_R"])
WAVES: Final = (*AMPLITUDES, *WAVELENGTHS)
SPEEDS: Final = ("speed", "reference_speed", SPEED, EXPONENT)
"""Names of what belongs to a moving edge alone."""


class Scenes(NamedTuple):
    """Numbers of a scene, or columns of several, of shape (scenes, 1) or plain numbers of all, in SI units.

    `stiffness` is M R^(1+k)/dgamma, `wavelength` and `pattern`, the wavelength of the toughness, are over R; `swing` is
    the amplitude of the toughness, `root` the root of the closing ratio, `compliance` that of the machine in m/N, `rim`
    a_max in m. `rise`, `disc` and `adhesion` are depth, stiffness and pull at the radius R. `turn` is the depth, or
    under a preload the load, at which loading turns; NaN where that comes from the data.
    """

    k: Any
    R: Any
    stiffness: Any
    wavelength: Any
    A: Any
    root: Any
    compliance: Any
    rim: Any
    pattern: Any
    swing: Any
    turn: Any
    rise: Any
    disc: Any
    adhesion: Any

    @property
    def one(self) -> "Scenes":
        """The first of several, of plain numbers."""
        return Scenes(*(float(np.asarray(column).flat[0]) for column in self))

    @property
    def neck(self) -> float:
        """The radius of one scene at which adhesion outweighs the curvature of the punch, in m."""
        return float(self.R * (2.0 ** (1.0 + self.k) * math.pi / self.stiffness) ** (1.0 / (3.0 + self.k)))


@dataclass(eq=False)
class LoopModel:
    """A loop as a function of the numbers that are searched: its curves of equilibrium, and what its path is drawn by.

    `fixed` are numbers by name, in SI units (`fit_loop`); `names` is what is searched, in order, those of `OFFSETS` and
    `TURN` last. Then come the shape of the punch, what is prescribed, and a pattern of the toughness.

    The path turns at the largest depth in m, or load in N, of the data (`furthest`), unless told otherwise, and goes on
    by `blur` in m on the branch where it is, since points at the turn have noise. Where works of adhesion differ the
    edge is pinned at the turn, which is then searched as `TURN`. The line of no load begins at the depth `first`.
    `rate` is the law of an edge that has a speed; its exponent is that of the numbers that are searched, if it is one.
    """

    fixed: Mapping[str, float]
    names: tuple[str, ...]
    profile: Profile
    loading: Loading = field(default_factory=Loading)
    toughness: Toughness | None = None
    furthest: tuple[float, float] = (math.nan, math.nan)
    first: float = 0.0
    blur: float = 0.0
    rate: Rate | None = None

    @property
    def driven(self) -> int:
        """The row of the states that is prescribed."""
        return int(self.loading.control == "load")

    @property
    def turns(self) -> str:
        """The name of the parameter that says where loading turns, "" where the data do."""
        return next((name for name in TURNS if {name, *WAYS[name]} & {*self.fixed, *self.names}), "")

    @property
    def has_waves(self) -> bool:
        """Whether the punch has waves: a profile with some, and no amplitude of 0."""
        return bool(self.profile.harmonics) and not any(self.fixed.get(name) == 0.0 for name in AMPLITUDES)

    def place_of(self, ways: Sequence[str]) -> int | None:
        """Return the place, among what is searched, of the one that has one of some names; None if none has."""
        return next((place for place, name in enumerate(self.names) if name in ways), None)

    def shift(self, vector: Floats) -> tuple[float, ...]:
        """Return the zeros of depth and load, and the tilt, of a vector."""
        known = {**self.fixed, **self.values(vector)}
        return tuple(float(known.get(name, 0.0)) for name in OFFSETS)

    def values(self, vectors: Floats) -> dict[str, Any]:
        """Give what is searched its names and units: numbers of one vector, arrays of the rows of several."""
        return {
            name: column if name in LINEAR else np.exp(column)
            for name, column in zip(self.names, vectors.T, strict=True)
        }

    def given(self, own: Mapping[str, Any]) -> dict[str, Any]:
        """Join the searched and the fixed numbers, with defaults without effect for what is left out."""
        given = {name: value for name, value in {**self.fixed, **own}.items() if name not in (*OFFSETS, TURN)}
        return {name: one for name, one in _WITHOUT_EFFECT.items() if not WAYS[name].keys() & given.keys()} | given

    def parameters(self, vector: Floats) -> dict[str, float]:
        """Return the parameters of `solve` of one vector, but for the turn."""
        made = parameters_from(self.given(self.values(vector)))
        kept = (*PARAMETERS, SPEED, CLOSING, MACHINE, *(PATTERN if self.toughness is not None else ()))
        return {name: float(made[name]) for name in kept if name in made}

    def scenes(self, vectors: Floats) -> Scenes:
        """Return the numbers of vectors, of shape (vectors, unknown)."""
        own = {name: column[:, None] for name, column in self.values(vectors).items()}
        given = self.given(own)
        made, R, work = parameters_from(given), given["R"], given["work_of_adhesion"]
        k, nu, modulus, c0 = (made[name] for name in PARAMETERS[:4])
        M, unit = stiffness(k, nu, modulus, c0), 1.5 * math.pi * R * work
        compliance = 1.0 / (made[MACHINE] * modulus * work) if self.loading.control == "machine" else 0.0
        turn = made[self.turns] * (unit if self.turns == "load_max" else R) if self.turns else math.nan
        columns = (
            k, R, M, made["lambda_over_R"], made["A"], np.sqrt(np.maximum(made.get(CLOSING, 1.0), 0.0)), compliance,
            R * made["a_max_over_R"], made.get(PATTERN[0], 1.0), made.get(PATTERN[1], 1.0), turn,
            R * hertz.power_indentation(k, 1.0, self.profile.exponent), unit / R * hertz.disc_stiffness(k, M, 1.0),
            R * jkr.adhesive_depth(k, M, 1.0),
        )  # fmt: skip
        return Scenes(*columns)

    def states(self, scenes: Scenes, radius: Floats, edge: Any) -> Floats:
        """Return equilibrium at radii in m where the edge has a toughness, over that of opening.

        Radii are of shape (n,) for one scene and (1 or scenes, n) for columns of them. Four rows of the shape to which
        scenes, radii and edge broadcast: displacement (of the machine, or depth) and load in m and N, and what both
        grow by for each m of radius.
        """
        k, R, m = scenes.k, scenes.R, self.profile.exponent
        a = radius / R
        flat, smooth = scenes.disc * a ** (1.0 + k), scenes.rise * a**m
        depth, moment, rise = self._waves(scenes, radius)
        tough, more = self._toughness(scenes, a)
        pull = edge * scenes.adhesion * a ** (0.5 * (1.0 - k))
        less, pull = pull * (0.5 * (1.0 - k) / a * tough + more), pull * tough
        load = flat * (smooth * (m / (1.0 + k + m)) + depth - moment - pull)
        depth, depth_rate = smooth + depth - pull, (m * smooth + rise) / a - less
        load_rate = flat * (depth_rate - pull * (1.0 + k) / a)
        soft = scenes.compliance
        rows = depth + soft * load, load, (depth_rate + soft * load_rate) / R, load_rate / R
        return np.array(np.broadcast_arrays(*rows))

    def flat(self, scenes: Scenes, radius: Any) -> tuple[Any, Any]:
        """Return how displacement and load of a flat disc grow, for each m of its depth."""
        stiffness = scenes.disc * (radius / scenes.R) ** (1.0 + scenes.k)
        return 1.0 + scenes.compliance * stiffness, stiffness

    def _waves(self, scenes: Scenes, radius: Floats) -> Any:
        """Return what the waves add to delta_H, to I/a^(1+k) and to a delta_H'; those of equal waves from one pass."""
        if not self.has_waves:
            return 0.0, 0.0, 0.0
        length, waves = scenes.wavelength * scenes.R, [(one.n, -one.cos, one.sin) for one in self.profile.harmonics]
        return scenes.A * length * np.array(hertz.wave_terms(scenes.k, radius / length, 1.0, waves))

    def _toughness(self, scenes: Scenes, a: Floats) -> tuple[Any, Any]:
        """Return the toughness at radii over R, over its mean, and how it grows with them."""
        if self.toughness is None:
            return 1.0, 0.0
        at, step = a / scenes.pattern, 1e-5
        series = series_at(rows_of_pattern(self.toughness), np.stack([at - step, at, at + step]))
        tough = np.maximum(1.0 + scenes.swing * series, 0.0)
        below, here, above = np.sqrt(tough) if self.toughness.of == "work" else tough
        return here, (above - below) / (2.0 * step * scenes.pattern)

    def shortest(self, scenes: Scenes) -> float:
        """Return the shortest wave of one scene in m, of its profile or its pattern; inf if it has none."""
        lengths = [math.inf]
        if self.has_waves and scenes.A > 0.0:
            lengths += [scenes.wavelength / max(wave.n for wave in self.profile.harmonics)]
        if self.toughness is not None:
            lengths += [scenes.pattern / float(rows_of_pattern(self.toughness)[:, 0].max())]
        return float(scenes.R * min(lengths))
