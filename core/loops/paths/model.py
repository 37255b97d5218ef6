"""The curves of a loop: depth and load of equilibrium at any contact radius, from the numbers that are searched.

At a contact radius a the depth and the load are closed forms (docs/theory.md),

    delta = delta_H(a) - g kappa(a) Delta(a),    P = P_H(a) - g kappa(a) S(a) Delta(a),

with S the stiffness of a flat disc, kappa the toughness of the place over its mean, and g = 1 where the edge opens, the
root of the closing ratio where it closes. Paths, and how they move, need nothing else.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.closed.reduced import WAYS, parameters_from
from gradhesion.core.equations import hertz, jkr
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN, TURNS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Toughness, rows_of_pattern, series_at
from gradhesion.core.types import Floats

LINEAR: Final = ("k", "nu", "indentation_max", "closing_ratio", "toughness_amplitude", "exponent", *OFFSETS)
"""Names searched on a linear scale; all others are searched by their logarithm."""
_WITHOUT_EFFECT: Final = {"a_max_over_R": math.inf, "c0_over_R": 1.0, "lambda_over_R": 1.0}
"""Values of what may be left out where it has no effect."""
AMPLITUDES: Final = ("A", *WAYS["A"])
WAVELENGTHS: Final = ("lambda_over_R", *WAYS["lambda_over_R"])
WAVES: Final = (*AMPLITUDES, *WAVELENGTHS)


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


class States(NamedTuple):
    """Equilibrium at some radii, in m, N and N/m; of their shape, or of (scenes, radii)."""

    depth: Floats
    load: Floats
    pull: Floats
    slope: Floats

    def at(self, toughness: Any) -> tuple[Floats, Floats]:
        """Return depth and load where the edge has a toughness, over that of opening."""
        pull = toughness * self.pull
        return self.depth - pull, self.load - self.slope * pull


@lru_cache(maxsize=64)
def _units_at(k: float, nu: float, m: float) -> tuple[Any, ...]:
    """Return the result of `_units` for plain numbers."""
    return (
        stiffness(k, nu, 1.0, 1.0), hertz.power_indentation(k, 1.0, m), hertz.disc_stiffness(k, 1.0, 1.0),
        jkr.adhesive_depth(k, 1.0, 1.0),
    )  # fmt: skip


def _units(k: Any, nu: Any, m: float) -> tuple[Any, ...]:
    """Return M, depth, stiffness and pull at the radius R, in R and dgamma, where E* R/dgamma, c0/R and M are 1."""
    if np.ndim(k) == np.ndim(nu) == 0:
        return _units_at(float(k), float(nu), m)
    return _units_at.__wrapped__(k, nu, m)


class Model:
    """A loop as a function of the numbers that are searched.

    Parameters
    ----------
    fixed
        Numbers by name, in SI units (`fit_loop`).
    names
        What is searched, in order; those of `OFFSETS` may be the last.
    profile, loading, toughness
        The shape of the punch, what is prescribed, and a pattern of the toughness.
    """

    def __init__(
        self,
        fixed: Mapping[str, float],
        names: tuple[str, ...],
        profile: Profile,
        loading: Loading,
        toughness: Toughness | None = None,
    ) -> None:
        self.fixed, self.names = dict(fixed), names
        self.profile, self.loading, self.toughness = profile, loading, toughness
        known = {*fixed, *names}
        self.turns = next((name for name in TURNS if {name, *WAYS[name]} & known), "")
        self.has_waves = bool(profile.harmonics) and not any(
            fixed.get(name) == 0.0 for name in ("A", "amplitude", "chi")
        )

    def place_of(self, ways: Sequence[str]) -> int | None:
        """Return the place, among what is searched, of the one that has one of some names; None if none has."""
        return next((place for place, name in enumerate(self.names) if name in ways), None)

    def values(self, vectors: Floats) -> dict[str, Any]:
        """Give what is searched its names and units: numbers of one vector, arrays of the rows of several."""
        return {
            name: column if name in LINEAR else np.exp(column)
            for name, column in zip(self.names, vectors.T, strict=True)
        }

    def given(self, own: Mapping[str, Any]) -> dict[str, Any]:
        """Join the searched and the fixed numbers, with defaults without effect for what is left out."""
        given = self.fixed | {name: value for name, value in own.items() if name not in OFFSETS}
        return {name: one for name, one in _WITHOUT_EFFECT.items() if not WAYS[name].keys() & given.keys()} | given

    def scenes(self, vectors: Floats) -> Scenes:
        """Return the numbers of vectors, of shape (vectors, unknown)."""
        own = {name: column[:, None] for name, column in self.values(vectors).items()}
        given = self.given(own)
        made = parameters_from(given)
        R, work = given["R"], given["work_of_adhesion"]
        k, nu, modulus, c0 = (made[name] for name in PARAMETERS[:4])
        theta, rise, disc, adhesion = _units(k, nu, self.profile.exponent)
        M, unit = theta * modulus / c0**k, 1.5 * math.pi * R * work
        compliance = 1.0 / (made["machine_stiffness"] * modulus * work) if self.loading.control == "machine" else 0.0
        turn = made[self.turns] * (unit if self.turns == "load_max" else R) if self.turns else math.nan
        columns = (
            k, R, M, made["lambda_over_R"], made["A"], np.sqrt(np.maximum(made.get(CLOSING, 1.0), 0.0)), compliance,
            R * made["a_max_over_R"], made.get(PATTERN[0], 1.0), made.get(PATTERN[1], 1.0), turn,
            R * rise, unit / R * disc * M, R * adhesion / np.sqrt(M),
        )  # fmt: skip
        return Scenes(*columns)

    def states(self, scenes: Scenes, radius: Floats) -> States:
        """Return equilibrium of scenes at radii in m, all of them at the same."""
        k, R, m = scenes.k, scenes.R, self.profile.exponent
        a = radius / R
        smooth = scenes.rise * a**m
        slope = scenes.disc * a ** (1.0 + k)
        first, second = self._waves(scenes, a)
        load = slope * (smooth * (m / (1.0 + k + m)) + R * a * (first - second))
        pull = scenes.adhesion * a ** (0.5 * (1.0 - k))
        if self.toughness is not None:
            pull = pull * self._toughness(scenes, a)
        return States(smooth + R * a * first, load, pull, slope)

    def _waves(self, scenes: Scenes, a: Floats) -> tuple[Any, Any]:
        """Return what the waves add to delta_H/a and to I/a^(2+k); one pass for scenes of equal k and lengths."""
        if not self.has_waves:
            return 0.0, 0.0
        if a.ndim == 1:
            sums = scenes.A * self._sums(scenes.k, a / scenes.wavelength)
            return sums[0], sums[1]
        rim = (scenes.rim,) if a.shape[0] > 1 else ()  # by which radii differ
        columns = np.broadcast_arrays(scenes.k, scenes.wavelength, scenes.R, *rim)
        sums, known = np.empty((2, columns[0].size, a.shape[1])), {}
        for row, key in enumerate(zip(*(column.flat for column in columns), strict=True)):
            if key not in known:
                known[key] = self._sums(key[0], a[row % a.shape[0]] / key[1])
            sums[:, row] = known[key]
        sums = scenes.A * sums
        return sums[0], sums[1]

    def _sums(self, k: float, x: Floats) -> Floats:
        """Return the sums over the waves of a unit amplitude, for depth and moment, at wavelengths x: (2, n)."""
        sums = np.zeros((2, x.size))
        for wave in self.profile.harmonics:
            size = 2.0 * math.pi * wave.n
            if wave.cos:
                sums += size * wave.cos * hertz.sine_integrals(k, wave.n * x)[:2]
            if wave.sin:
                sums += size * wave.sin * hertz.cosine_integrals(k, wave.n * x)
        return sums

    def _toughness(self, scenes: Scenes, a: Floats) -> Floats:
        """Return the toughness of the interface at radii over R, over its mean."""
        assert self.toughness is not None  # noqa: S101 (only called with one)
        series = 1.0 + scenes.swing * series_at(rows_of_pattern(self.toughness), a / scenes.pattern)
        return np.sqrt(np.maximum(series, 0.0)) if self.toughness.of == "work" else series

    def shortest(self, scenes: Scenes) -> float:
        """Return the shortest wave of one scene in m, of its profile or its pattern; inf if it has none."""
        lengths = [math.inf]
        if self.has_waves and scenes.A > 0.0:
            lengths += [scenes.wavelength / max(wave.n for wave in self.profile.harmonics)]
        if self.toughness is not None:
            lengths += [scenes.pattern / float(rows_of_pattern(self.toughness)[:, 0].max())]
        return float(scenes.R * min(lengths))
