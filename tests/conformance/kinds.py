"""The table of kinds, and how scenes of them are drawn and solved."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.problem.names import EDGE, OUTPUTS
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

from .theory import stiffness, stretch, wave_size

SEED: Final = int(os.environ.get("CONFORMANCE_SEED", "2013"))
DEPTH, LOAD = "indentation_max_over_R", "load_max"
COUNTS: Final = ("loading_jumps", "unloading_jumps")
ONE: Final = ((1, 1.0, 0.0),)
TWO: Final = ((1, 1.0, 0.0), (2, 0.3, 0.0))
SINES: Final = ((1, 1.0, 0.3), (2, -0.4, 0.2), (5, 0.1, -0.1))
NO_FIRST: Final = ((2, 0.6, 0.0), (3, -0.1, 0.2))
MIXED: Final = ((1, 0.7, 0.2), (3, 0.3, 0.0), (4, 0.0, 0.2))

Scenes = dict[str, Any]
Waves = tuple[tuple[int, float, float], ...]


@dataclass(frozen=True)
class Kind:
    """What is asked of a solver: how a punch is made, driven and solved."""

    name: str
    exponent: float = 2.0
    waves: Waves = ONE
    control: str = "displacement"
    turn: str = ""
    """DEPTH or LOAD, or the rim."""
    ratio: bool = False
    """Whether closing has a work of its own."""
    pattern: str = ""
    """What varies with the radius, "toughness" or "work"."""
    solver: str = "exact"
    unbounded: bool = False

    @property
    def pattern_waves(self) -> Waves:
        """The waves of the pattern; with an amplitude of at most 1 they stay above -0.5."""
        return ((1, 0.3, -0.2), (2, 0.0, 0.1)) if self.pattern else ()

    @property
    def how(self) -> dict[str, Any]:
        """The arguments of `solve` beside the parameters."""
        waves = tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in self.waves)
        how: dict[str, Any] = {"profile": Profile(exponent=self.exponent, harmonics=waves)}
        how["loading"] = Loading(control=self.control)
        if self.pattern:
            harmonics = tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in self.pattern_waves)
            how["toughness"] = Toughness(harmonics, of=self.pattern)
        return how

    @property
    def outputs(self) -> tuple[str, ...]:
        """All results of the kind."""
        slope = ("contact_slope",) if self.unbounded else ()
        return (*OUTPUTS, *EDGE, *slope) if self.solver == "exact" else OUTPUTS

    @property
    def waves_per_wavelength(self) -> int:
        """Number of the highest harmonic."""
        return max(n for n, _, _ in self.waves)

    def solve(self, scenes: Mapping[str, Any], outputs: Sequence[str] = (), **more: Any) -> dict[str, NDArray[Any]]:
        """Solve scenes for all results of the kind, or some."""
        return solve(scenes, outputs or self.outputs, solver=self.solver, **self.how, **more)

    def draw(self, rng: np.random.Generator, count: int, exponents: Sequence[float] | None = None) -> Scenes:
        """Draw scenes: smooth ones, both ends of every ratio and values of any size among them."""

        def between(low: float, high: float) -> NDArray[np.float64]:
            return np.exp(rng.uniform(np.log(low), np.log(high), count))

        k = rng.choice([0.0, 1.0, *rng.uniform(0.03, 0.97, 4)] if exponents is None else exponents, count)
        nu = np.where(k > 0.98, 0.5, rng.uniform(-0.3, 0.5, count))
        modulus, c0 = between(30.0, 5000.0), between(0.01, 1.0)
        # most scenes are drawn over the length L of the smooth punch, and the waves by chi: these fold
        M = stiffness(k, nu, modulus, c0)
        length, folds = M ** (-1 / (3 + k)), rng.random(count) < 0.7
        wavelength = np.where(folds, length * between(0.2 if self.unbounded else 0.06, 2.0), between(0.2, 1.0))
        chi = rng.uniform(0.05, 0.5 if self.unbounded else 1.2, count)
        A = np.where(folds, chi * stretch(k, M) / wave_size(k, 1.0, wavelength), between(1e-3, 0.02))
        scenes: Scenes = {
            "k": k,
            "nu": nu,
            "modulus": modulus,
            "c0_over_R": c0,
            "lambda_over_R": wavelength,
            "A": np.where(rng.random(count) < 0.08, 0.0, A),
            "a_max_over_R": np.full(count, np.inf) if self.unbounded else length * between(0.5, 4.0),
        }
        if self.control == "machine":
            scenes["machine_stiffness"] = between(1e-2, 10.0)
        if self.turn:
            depths, loads = length**2 * rng.uniform(-0.1, 2.5, count), length ** (self.exponent - 2) * between(0.02, 10.0)
            scenes[self.turn] = depths if self.turn == DEPTH else loads
        if self.ratio:
            scenes["closing_ratio"] = rng.choice([0.0, 1.0, *rng.uniform(0, 1, 6)], count)
        if self.pattern:
            scenes["toughness_wavelength_over_R"] = length * between(0.1, 2.0)
            scenes["toughness_amplitude"] = np.where(rng.random(count) < 0.1, 0.0, rng.uniform(0.0, 1.0, count))
        return scenes


KINDS: Final = (
    Kind("cosine"),
    Kind("cosine, unbounded", unbounded=True),
    Kind("cosine, load", control="load"),
    Kind("cosine, machine", control="machine"),
    Kind("cosine, turned at a depth", turn=DEPTH),
    Kind("cosine, turned at a load", turn=LOAD),
    Kind("cosine, load, turned at a load", control="load", turn=LOAD),
    Kind("cosine, two works", ratio=True),
    Kind("cosine, two works, turned at a load", ratio=True, turn=LOAD),
    Kind("two harmonics", waves=TWO),
    Kind("two harmonics, turned at a depth", waves=TWO, turn=DEPTH),
    Kind("sines, unbounded", waves=SINES, unbounded=True),
    Kind("sines, load", waves=SINES, control="load"),
    Kind("sines, machine", waves=SINES, control="machine"),
    Kind("sines, machine, two works, turned at a depth", waves=SINES, control="machine", ratio=True, turn=DEPTH),
    Kind("no first harmonic", waves=NO_FIRST),
    Kind("exponent 1.5", exponent=1.5),
    Kind("exponent 1.5, machine, turned at a depth", exponent=1.5, control="machine", turn=DEPTH),
    Kind("exponent 4, series, turned at a load", exponent=4.0, waves=MIXED, turn=LOAD),
    Kind("cone with a sine", exponent=1.0, waves=((1, 1.0, 0.5),)),
    Kind("cone, load, two works", exponent=1.0, control="load", ratio=True),
    Kind("pattern of toughness", pattern="toughness"),
    Kind("pattern of work, machine, two works, turned", pattern="work", control="machine", ratio=True, turn=DEPTH),
    Kind("asymptotic cosine", solver="asymptotic"),
    Kind("asymptotic sines", solver="asymptotic", waves=SINES),
    Kind("asymptotic cone", solver="asymptotic", exponent=1.0, waves=TWO),
    Kind("envelope of a cosine", solver="envelope"),
    Kind("envelope of sines", solver="envelope", waves=SINES),
)
EXACT: Final = tuple(kind for kind in KINDS if kind.solver == "exact")
BY_NAME: Final = {kind.name: kind for kind in KINDS}


def name_of(kind: Any) -> str:
    """The name of a kind, for parametrised tests."""
    return str(kind.name)


def rng_of(name: str) -> np.random.Generator:
    """Random numbers of one test, that do not depend on which others run."""
    return np.random.default_rng([SEED, crc32(name.encode())])


@lru_cache(maxsize=None)
def _solved(kind: Kind, count: int) -> tuple[Scenes, dict[str, NDArray[Any]]]:
    scenes = kind.draw(rng_of(kind.name), count)
    return scenes, kind.solve(scenes)


def drawn(kind: Kind, count: int = 160) -> tuple[Scenes, dict[str, NDArray[Any]]]:
    """Scenes of a kind and all their results, solved in one call; shared by the laws, which copy what they change."""
    scenes, found = _solved(kind, count)
    return dict(scenes), dict(found)


def some(scenes: Mapping[str, Any], index: Any) -> Scenes:
    """Some scenes of an array of them."""
    return {name: np.asarray(values)[index] for name, values in scenes.items()}


def at(kind: Kind, **changed: Any) -> Kind:
    """A kind like another one."""
    return replace(kind, **changed)
