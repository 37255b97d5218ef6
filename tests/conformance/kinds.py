"""The table of kinds, and how scenes of them are drawn and solved."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final
from zlib import crc32

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import OUTPUTS, Loading, solve
from gradhesion.core.problem.names import EDGE
from tests.core.scene import pattern_of, profile_of

from .theory import Waves, stiffness, stretch, wave_size

SEED: Final = int(os.environ.get("CONFORMANCE_SEED", "2013"))
SCENES: Final = int(os.environ.get("CONFORMANCE_SCENES", "64"))
"""Scenes of each kind."""
DEPTH, LOAD = "indentation_max_over_R", "load_max"
COUNTS: Final = ("loading_jumps", "unloading_jumps")
ONE: Final = ((1, 1.0, 0.0),)
TWO: Final = ((1, 1.0, 0.0), (2, 0.3, 0.0))
SINES: Final = ((1, 1.0, 0.3), (2, -0.4, 0.2), (5, 0.1, -0.1))
NO_FIRST: Final = ((2, 0.6, 0.0), (3, -0.1, 0.2))
MIXED: Final = ((1, 0.7, 0.2), (3, 0.3, 0.0), (4, 0.0, 0.2))
Scenes = dict[str, Any]


@dataclass(frozen=True)
class Kind:
    """What is asked of a solver: how a punch is made, driven and solved."""

    name: str = ""
    exponent: float = 2.0
    waves: Waves = ONE
    control: str = "displacement"
    turn: str = ""  # DEPTH or LOAD, or the rim
    ratio: bool = False  # whether closing has a work of its own
    pattern: str = ""  # what varies with the radius, "toughness" or "work"
    solver: str = "exact"
    unbounded: bool = False

    @property
    def pattern_waves(self) -> Waves:
        """The waves of the pattern; with an amplitude of at most 1 the sum stays above -0.5."""
        return ((1, 0.3, -0.2), (2, 0.0, 0.1)) if self.pattern else ()

    @property
    def how(self) -> dict[str, Any]:
        """The arguments of `solve` and `draw_curves` beside the parameters."""
        pattern = {"toughness": pattern_of(self.pattern, *self.pattern_waves)} if self.pattern else {}
        return {"profile": profile_of(self.exponent, *self.waves), "loading": Loading(control=self.control)} | pattern

    @property
    def shape(self) -> Any:
        """The shape by which the twin knows it."""
        from gradhesion.twin.shape import Shape

        return Shape(self.exponent, self.waves, self.control, self.pattern_waves, self.pattern or "toughness")

    @property
    def outputs(self) -> tuple[str, ...]:
        slope = ("contact_slope",) if self.unbounded else ()
        return (*OUTPUTS, *EDGE, *slope) if self.solver == "exact" else OUTPUTS

    @property
    def highest(self) -> int:
        return max(n for n, _, _ in self.waves)

    @property
    def has_rim(self) -> bool:
        return not self.unbounded and not self.turn

    def solve(self, scenes: Mapping[str, Any], outputs: Sequence[str] = (), **more: Any) -> dict[str, NDArray[Any]]:
        """Solve scenes for all results of the kind, or some."""
        return solve(scenes, outputs or self.outputs, solver=self.solver, **self.how, **more)

    def draw(self, rng: np.random.Generator, count: int) -> Scenes:
        """Draw scenes: most of them fold; smooth ones and both ends of every ratio are among them.

        An eighth has exponents k of their own, the others share six.
        """

        def between(low: float, high: float) -> NDArray[np.float64]:
            return np.exp(rng.uniform(np.log(low), np.log(high), count))

        k = rng.choice([0.0, 1.0, *rng.uniform(0.03, 0.97, 4)], count)
        k = np.where(np.arange(count) % 8 == 5, rng.uniform(0.0, 0.97, count), k)
        nu = np.where(k > 0.98, 0.5, rng.uniform(-0.3, 0.5, count))
        modulus, c0 = between(30.0, 5000.0), between(0.01, 1.0)
        M = stiffness(k, nu, modulus, c0)
        length, folds = M ** (-1 / (3 + k)), rng.random(count) < 0.7
        wavelength = np.where(folds, length * between(0.2 if self.unbounded else 0.06, 2.0), between(0.2, 1.0))
        chi = rng.uniform(0.05, 0.5 if self.unbounded else 1.2, count)
        A = np.where(folds, chi * stretch(k, M) / wave_size(k, 1.0, wavelength), between(1e-3, 0.02))
        A = np.where(rng.random(count) < 0.08, 0.0, A)
        rim = np.full(count, np.inf) if self.unbounded else length * between(0.5, 4.0)
        scenes: Scenes = {"k": k, "nu": nu, "modulus": modulus, "c0_over_R": c0}
        scenes |= {"lambda_over_R": wavelength, "A": A, "a_max_over_R": rim}
        if self.control == "machine":
            scenes["machine_stiffness"] = between(1e-2, 10.0)
        if self.turn == DEPTH:
            scenes[DEPTH] = length**2 * rng.uniform(-0.1, 2.5, count)
        if self.turn == LOAD:
            scenes[LOAD] = length ** (self.exponent - 2) * between(0.02, 10.0)
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
    Kind("sines, machine, two works, turned", waves=SINES, control="machine", ratio=True, turn=DEPTH),
    Kind("no first harmonic", waves=NO_FIRST),
    Kind("exponent 1.5", exponent=1.5),
    Kind("exponent 1.5, machine, turned", exponent=1.5, control="machine", turn=DEPTH),
    Kind("exponent 4, turned at a load", exponent=4.0, waves=MIXED, turn=LOAD),
    Kind("cone with a sine", exponent=1.0, waves=((1, 1.0, 0.5),)),
    Kind("cone, load, two works", exponent=1.0, control="load", ratio=True),
    Kind("pattern of toughness", pattern="toughness"),
    Kind("pattern of work, machine, two works, turned", pattern="work", control="machine", ratio=True, turn=DEPTH),
    Kind("asymptotic cosine", solver="asymptotic"),
    Kind("asymptotic sines", solver="asymptotic", waves=SINES),
    Kind("asymptotic cone", solver="asymptotic", exponent=1.0, waves=TWO),
    Kind("envelope of a cosine", solver="envelope"),
    Kind("envelope of sines on a power", solver="envelope", exponent=1.4, waves=SINES),
)
EXACT: Final = tuple(kind for kind in KINDS if kind.solver == "exact")
BY_NAME: Final = {kind.name: kind for kind in KINDS}


def for_kinds(kinds: Iterable[Kind | str]) -> pytest.MarkDecorator:
    """Have a law hold for kinds, given or by name."""
    given = [kind if isinstance(kind, Kind) else BY_NAME[kind] for kind in kinds]
    return pytest.mark.parametrize("kind", [pytest.param(kind, id=kind.name) for kind in given])


def rng_of(name: str) -> np.random.Generator:
    """Random numbers of one test, that do not depend on which others run."""
    return np.random.default_rng([SEED, crc32(name.encode())])


@cache
def drawn(kind: Kind) -> tuple[Scenes, dict[str, NDArray[Any]]]:
    """Scenes of a kind and all their results, solved in one call for all laws, none of which may change them."""
    scenes = kind.draw(rng_of(kind.name), SCENES)
    return scenes, kind.solve(scenes)


def some(scenes: Mapping[str, Any], index: Any) -> Scenes:
    return {name: np.asarray(values)[index] for name, values in scenes.items()}


def one_of(scenes: Mapping[str, Any], i: Any) -> dict[str, float]:
    return {name: float(values[i]) for name, values in scenes.items()}


def powers_of(kind: Kind, k: Any) -> dict[str, Any]:
    """How parameters and results scale with the radius c of the same reduced problem: as c to a power; R stays.

    lambda, a ~ c;  A ~ c^(m-1);  M ~ c^(1-k-2m), so that Delta ~ c^m as the punch;  S ~ M a^(1+k), in units of E*.
    """
    m = kind.exponent
    powers = dict.fromkeys(("lambda_over_R", "a_max_over_R", "toughness_wavelength_over_R"), 1.0)
    powers |= dict.fromkeys(("pull_off_radius", "turning_radius"), 1.0)
    powers |= dict.fromkeys((DEPTH, "delta_max", "delta_jump_out", "pinned_depth"), m)
    powers |= dict.fromkeys((LOAD, "pull_off_force", "snap_in_force"), 2 - m)
    powers |= dict.fromkeys(("dissipated_energy", "loading_energy", "unloading_energy", "front_energy"), 2.0)
    return powers | {"A": m - 1, "contact_slope": m - 1, "modulus": 1 - k - 2 * m, "machine_stiffness": 1 + k}


def rescaled(kind: Kind, values: Mapping[str, Any], k: Any, c: Any) -> dict[str, Any]:
    """Parameters or results of the same reduced problem with all radii c times as large."""
    powers = powers_of(kind, k)
    return {name: array * c ** powers[name] if name in powers else array for name, array in values.items()}
