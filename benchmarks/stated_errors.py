"""Do stated errors cover the true ones, and how tight are they? `python -m benchmarks.stated_errors [SCENES] [SEED]`.

True errors come from the reference solver, and on long curves from walking every wave, the sums being switched off.
With --only WORDS: the classes whose names contain these words alone, SCENES of each.
"""

import argparse
import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from tests.core.walked import walked_cosine, walked_general

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.tables import table_of
from gradhesion.twin import stated
from gradhesion.twin.general import Shape
from tests.twin.draw_general import general_scene, known_to_the_core

NAMES = ("pull_off_force", "dissipated_energy")
Draw = Callable[[np.random.Generator], dict[str, float]]
Measure = Callable[[int, int], np.ndarray]
"""True over stated errors of so many scenes from a seed."""


def material(rng: np.random.Generator) -> dict[str, float]:
    """Draw a material."""
    k = float(rng.choice([0.0, 1.0, 0.1, 0.25, 0.4, 0.515, 0.63, 0.8]))
    nu = 0.5 if k == 1.0 else float(rng.uniform(-0.9, 0.5))
    return {"k": k, "nu": nu, "modulus": 10.0 ** rng.uniform(-1, 5), "c0_over_R": 10.0 ** rng.uniform(-3, 1)}


def wavy(low: float, high: float) -> Draw:
    """Draw scenes with wavelengths between two powers of ten."""

    def draw(rng: np.random.Generator) -> dict[str, float]:
        rim = float(rng.choice([math.inf, 10.0 ** rng.uniform(-1, 0.5)]))
        wave = {"lambda_over_R": 10.0 ** rng.uniform(low, high), "A": 10.0 ** rng.uniform(-4, -0.7)}
        return material(rng) | wave | {"a_max_over_R": rim}

    return draw


def smooth(rng: np.random.Generator) -> dict[str, float]:
    """Draw a smooth punch whose pull-off is at its edge."""
    scene = material(rng) | {"lambda_over_R": 1.0, "A": 0.0, "a_max_over_R": math.inf}
    radius = float(solve(scene, ["pull_off_radius"])["pull_off_radius"])
    return scene | {"a_max_over_R": radius * 10.0 ** rng.uniform(-2, 0)}


def ratios(
    draw: Draw, count: int, seed: int, shape: Shape, extra: dict[str, float] | None = None, **how: Any
) -> np.ndarray:
    """Return true over stated errors of force and energy, one row a scene, from the reference solver."""
    return of_scenes(lambda rng: (draw(rng) | (extra or {}), shape, how), count, seed)


def anything(count: int, seed: int) -> np.ndarray:
    """Return the same for random profiles and controls."""

    def draw(rng: np.random.Generator) -> tuple[dict[str, float], Shape, dict[str, Any]]:
        scene, shape = general_scene(rng)
        return scene, shape, known_to_the_core(shape)

    return of_scenes(draw, count, seed)


def of_scenes(
    draw: Callable[[np.random.Generator], tuple[dict[str, float], Shape, dict[str, Any]]], count: int, seed: int
) -> np.ndarray:
    """Return true over stated errors of force and energy, one row a scene that the reference solver follows."""
    rng, rows = np.random.default_rng(seed), []
    while len(rows) < count:
        scene, shape, how = draw(rng)
        found = solve(scene, [*NAMES, *(f"{name}_error" for name in NAMES), "unloading_jumps"], threads=1, **how)
        if (
            found["status"] & 64
            or found["unloading_jumps"] > 60
            or not stated.within_reach(scene, NAMES, "exact", shape)
        ):
            continue
        try:
            truth = stated.expected(scene, NAMES, "exact", shape)
        except ArithmeticError:
            continue
        rows.append(
            [stated.deviation(float(found[name]), truth[name]) / float(found[f"{name}_error"]) for name in NAMES]
        )
    return np.array(rows)


def long(count: int, seed: int) -> np.ndarray:
    """Return true over stated errors of the energy of long curves, from walking every wave."""
    rng, rows = np.random.default_rng(seed), []
    draw = wavy(-4.5, -1.0)
    while len(rows) < count:
        scene = draw(rng)
        truth = walked_cosine(scene, table_of, 4000.0)
        if truth is not None:
            found = solve(scene, ["dissipated_energy", "dissipated_energy_error"], threads=1)
            rows.append(abs(float(found["dissipated_energy"]) - truth) / float(found["dissipated_energy_error"]))
    return np.array(rows)[:, None]


def long_general(count: int, seed: int, profile: Profile, control: str) -> np.ndarray:
    """Return the same for 10^3 to 10^5 waves of another profile or control."""
    rng, rows = np.random.default_rng(seed), []
    loading, names = Loading(control=control), ("dissipated_energy", "dissipated_energy_error")
    draw = wavy(-6.0, -2.5)
    while len(rows) < count:
        scene = draw(rng)
        if control == "machine":
            scene["machine_stiffness"] = 10.0 ** rng.uniform(-3, 2)
        truth = walked_general(scene, profile, loading, (1e3, 1e5))
        if truth is not None:
            found = solve(scene, names, profile=profile, loading=loading, threads=1)
            energy, error = (float(found[name]) for name in names)
            rows.append(abs(energy - truth[0]) / error)
    return np.array(rows)[:, None]


def classes() -> dict[str, tuple[int, Measure]]:
    """Give the part of all scenes that each class has, and how so many of them are measured.

    Those of the reference solver have a tenth, the longest a hundredth.
    """
    plain, waves = Shape(), ((1, 1.0, 0.0), (3, 0.3, 0.2))
    series = Profile(harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in waves))
    cone = Profile(exponent=1.5)
    rough = tuple(Harmonic(n=n, cos=math.cos(n * n) * n**-1.6, sin=math.sin(n * n) * n**-1.6) for n in range(1, 9))
    found: dict[str, tuple[int, Measure]] = {
        "one cosine, 160 to 4,000 arches, energy": (1, long),
        "smooth, pull-off at the edge": (10, partial(ratios, smooth, shape=plain)),
        "one cosine, up to 60 waves": (10, partial(ratios, wavy(-1.5, 0), shape=plain)),
        "series": (10, partial(ratios, wavy(-1, 0), shape=Shape(2.0, waves), profile=series)),
        "exponent 1.5": (10, partial(ratios, wavy(-1, 0), shape=Shape(1.5, ((1, 1.0, 0.0),)), profile=cone)),
    }
    for name, spring in (("load", None), ("machine, S = 3 E* R", 3.0), ("machine, S = 0.001 E* R", 1e-3)):
        control, extra = ("load", {}) if spring is None else ("machine", {"machine_stiffness": spring})
        shape = Shape(2.0, ((1, 1.0, 0.0),), control)
        found[name] = 10, partial(ratios, wavy(-1, 0), shape=shape, extra=extra, loading=Loading(control=control))
    found["any profile and control"] = 10, anything
    for name, profile, control in (
        ("series", series, "displacement"),
        ("eight harmonics", Profile(harmonics=rough), "displacement"),
        ("exponent 1.5", cone, "displacement"),
        ("exponent 4, series", Profile(exponent=4.0, harmonics=series.harmonics), "machine"),
        ("load", Profile(), "load"),
        ("machine", Profile(), "machine"),
    ):
        measure = partial(long_general, profile=profile, control=control)
        found[f"{name}, 1,000 to 100,000 waves, energy"] = 100, measure
    return found


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=10_000)
    parser.add_argument("seed", type=int, nargs="?", default=20261)
    parser.add_argument("--only", default="", help="classes whose names contain this alone, SCENES of each")
    requested = parser.parse_args()
    print("| class | scenes | exceeded (force, energy) | largest true/stated | median stated/true |")
    print("| --- | --- | --- | --- | --- |")
    for name, (part, measure) in classes().items():
        if requested.only not in name:
            continue
        count = requested.count if requested.only else max(10, requested.count // part)
        found = measure(count, requested.seed)
        over = ", ".join(str(n) for n in (found > 1.0).sum(axis=0))
        worst = ", ".join(f"{n:.2f}" for n in found.max(axis=0))
        with np.errstate(divide="ignore"):
            tight = ", ".join(f"{1 / n:.0f}" for n in np.median(found, axis=0))
        print(f"| {name} | {len(found):,} | {over} | {worst} | {tight} |", flush=True)


if __name__ == "__main__":
    main()
