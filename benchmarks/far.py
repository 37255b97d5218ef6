"""Scenes of 10^4 to 10^14 waves against similar scenes: `python -m benchmarks.far [SCENES] [SEED]`.

Two scenes are similar (docs/theory.md, section 6) whose lengths differ by a factor f: lambda, a_max and L by f, A by
f^(m-1), loads by f^(2-m), at one k. f is 5/4 and lambda a power of two, so that a_max/lambda, and with it the phase at
the rim, is the same double twice; all else rounds anew. Decade by decade: what of force, energies and depths differs by
more than both scenes state, and how many scenes have no value, by their status. With --balls N: forces of N scenes of
each class against ball arithmetic.
"""

import argparse
import math
from collections import Counter
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np
from flint import arb
from numpy.typing import NDArray

from benchmarks.clock import table
from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.shape import depth_factor_of
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, FAILED
from gradhesion.twin.general import Shape
from tests.twin.far import pull_off_force

Values = NDArray[np.float64]
FACTOR: Final = 1.25
BATCH: Final = 50
"""Scenes of one profile, control and turn."""
BITS: Final = 50
"""Of a_max/lambda: 5/4 of it is a double too."""
FORCE, ENERGY = "pull_off_force", "dissipated_energy"
PARTS: Final = ("loading_energy", "unloading_energy")
DEPTHS: Final = ("delta_max", "delta_jump_out")
ERRORS: Final = {FORCE: "pull_off_force_error", ENERGY: "dissipated_energy_error"}
CONTROLS: Final = ("displacement", "load", "machine")
TURNS: Final = (None, None, "indentation_max_over_R", "load_max")
DEPTH_PROMISED: Final = 1e-13
"""Of the sizes of the terms of a depth (docs/accuracy.md)."""


class Batch(NamedTuple):
    """Scenes of one profile and control, those similar to them, and the sizes of the terms of their depths."""

    name: str
    scenes: dict[str, Values]
    similar: dict[str, Values]
    profile: Profile
    loading: Loading
    size: Values


def waves_of(rng: np.random.Generator, count: int, decay: float) -> tuple[Harmonic, ...]:
    """Draw a series whose amplitudes fall as a power of n."""
    return tuple(
        Harmonic(n=n, cos=float(even), sin=float(odd))
        for n, (even, odd) in enumerate(rng.normal(size=(count, 2)) * np.arange(1.0, count + 1)[:, None] ** -decay, 1)
    )


def profiles(rng: np.random.Generator) -> dict[str, Profile]:
    """Draw a profile of each class."""
    sine, negative = (Harmonic(n=1, cos=0.0, sin=1.0),), (Harmonic(n=1, cos=-1.0),)
    return {
        "one cosine": Profile(),
        "sine": Profile(harmonics=sine),
        "negative": Profile(harmonics=negative),
        "two harmonics": Profile(harmonics=waves_of(rng, 2, 0.0)),
        "24 harmonics": Profile(harmonics=waves_of(rng, 24, 1.5)),
        "exponent 1 to 8": Profile(exponent=float(rng.uniform(1.0, 8.0)), harmonics=waves_of(rng, 1, 0.0)),
        "cone": Profile(exponent=1.0, harmonics=waves_of(rng, 1, 0.0)),
        "sampled": Profile(harmonics=sampled(rng)),
    }


def sampled(rng: np.random.Generator) -> tuple[Harmonic, ...]:
    """Give the waves of a surface that is known at 32 points."""
    heights = np.fft.rfft(np.cumsum(rng.normal(size=32)))[1:9]
    return tuple(Harmonic(n=n, cos=float(-h.real), sin=float(-h.imag)) for n, h in enumerate(heights, 1))


def drawn(rng: np.random.Generator, decade: float, name: str, profile: Profile, count: int) -> Batch:
    """Draw scenes whose rim is so many waves out, of one profile, and a control and a turn for all of them."""
    m = profile.exponent
    control, turn = CONTROLS[rng.integers(3)], TURNS[rng.integers(4)]
    k = rng.choice([0.0, 0.1, 0.5, 0.9, 1.0, float(rng.uniform())], count)
    nu = np.where(k == 1.0, 0.5, rng.uniform(-0.9, 0.5, count))
    waves = 10.0 ** (decade + rng.uniform(0.0, 1.0, count))
    scale = 2.0 ** (np.floor(np.log2(waves)) + 1.0 - BITS)
    waves = np.round(waves / scale) * scale
    wavelength = 2.0 ** np.round(np.log2(10.0 ** rng.uniform(-3.0, 0.0, count) / waves))
    rim = waves * wavelength
    c0 = 10.0 ** rng.uniform(-3.0, 0.5, count)
    length = rim / 10.0 ** rng.uniform(-2.0, 1.0, count)
    modulus = length ** (1.0 - 2.0 * m - k) / stiffness(k, nu, 1.0, c0)
    material = {"k": k, "nu": nu, "modulus": modulus, "c0_over_R": c0, "lambda_over_R": wavelength}
    steepness = math.sqrt(sum((h.cos**2 + h.sin**2) * h.n for h in profile.harmonics))
    amplitude = amplitude_of_ratio(**material, chi=10.0 ** rng.uniform(-4.0, 0.5, count)) / steepness
    scenes = {**material, "A": amplitude, "a_max_over_R": rim}
    similar = scenes | {
        "modulus": modulus * FACTOR ** (1.0 - 2.0 * m - k),
        "lambda_over_R": FACTOR * wavelength,
        "A": amplitude * FACTOR ** (m - 1.0),
        "a_max_over_R": FACTOR * rim,
    }
    M = stiffness(k, nu, modulus, c0)
    front = np.array([depth_factor_of(float(one), m) for one in k])
    if control == "machine":
        spring = 10.0 ** rng.uniform(-4.0, 2.0, count)
        scenes["machine_stiffness"], similar["machine_stiffness"] = spring, spring * FACTOR ** (1.0 + k)
    if turn is not None:
        part = front * (rim * 10.0 ** rng.uniform(-1.0, 0.2, count)) ** m
        if turn == "load_max":
            part *= 2.0 ** (1.0 - k) / (1.0 + k) * M * rim ** (1.0 + k) * m / (1.0 + k + m) / (1.5 * math.pi)
        scenes[turn], similar[turn] = part, part * FACTOR ** (m if turn != "load_max" else 2.0 - m)
    stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / M) * rim ** (0.5 * (1.0 - k))
    size = front * rim**m + 4.0 * stretch + wavelength * amplitude
    if turn == "load_max" or (turn is not None and control != "displacement"):  # depths change with the phase there
        size += 2.0 * math.pi * rim * amplitude * sum(h.n * math.hypot(h.cos, h.sin) for h in profile.harmonics)
    return Batch(f"{name}, {control}, {turn}", scenes, similar, profile, Loading(control=control), size)


def solved(scenes: dict[str, Values], batch: Batch) -> dict[str, NDArray[Any]]:
    """Solve scenes for all that is compared."""
    names = (FORCE, ENERGY, *PARTS, *DEPTHS, *ERRORS.values())
    return solve(scenes, names, profile=batch.profile, loading=batch.loading, check_contact=False, threads=1)


def compared(batch: Batch) -> tuple[dict[str, Values], Values]:
    """Return differences over what is stated, NaN where a scene has no value, and its status."""
    one, other = solved(batch.scenes, batch), solved(batch.similar, batch)
    m = batch.profile.exponent
    units = dict.fromkeys((ENERGY, *PARTS), FACTOR**2) | dict.fromkeys(DEPTHS, FACTOR**m) | {FORCE: FACTOR ** (2.0 - m)}
    there = (one["status"] | other["status"]) & FAILED == 0
    found = {}
    for name, unit in units.items():
        if name in DEPTHS:
            stated = 2.0 * DEPTH_PROMISED * batch.size
        else:
            error = ERRORS[FORCE if name == FORCE else ENERGY]
            stated = one[error] + other[error] / unit
        with np.errstate(all="ignore"):
            found[name] = np.where(there, np.abs(one[name] - other[name] / unit) / stated, np.nan)
    return found, np.where(there, 0, (one["status"] | other["status"]) & ~CLOSE_TO_A_JUMP)


def against_balls(first: int, end: int, count: int, seed: int) -> Iterator[tuple[str, Values]]:
    """Return the true over the stated error of forces, class by class, from ball arithmetic, NaN without a value."""
    rng = np.random.default_rng([seed, 1])
    for name in profiles(rng):
        ratios: list[float] = []
        while len(ratios) < count:
            profile = profiles(rng)[name]
            shape = Shape(profile.exponent, tuple((h.n, h.cos, h.sin) for h in profile.harmonics))
            scenes = drawn(rng, rng.uniform(first, end - 1), name, profile, 10).scenes
            scenes["lambda_over_R"] *= rng.uniform(1.0, 2.0, 10)  # so that a_max/lambda is no double
            for i in range(min(10, count - len(ratios))):
                scene = {key: float(scenes[key][i]) for key in PARAMETERS}
                found = solve(scene, (FORCE, "pull_off_radius", ERRORS[FORCE]), profile=profile, threads=1)
                force, radius, error = (float(found[key]) for key in (FORCE, "pull_off_radius", ERRORS[FORCE]))
                there = found["status"] & FAILED == 0
                off = abs(pull_off_force(scene, shape, radius) - force) if there else arb(math.nan)
                ratios.append(float(off) / error)
        yield name, np.array(ratios)


def decades(low: int, high: int, count: int, seed: int) -> Iterator[tuple[int, Batch]]:
    """Draw the batches of each decade, all classes in turn."""
    for decade in range(low, high):
        rng = np.random.default_rng([seed, decade])
        left = count
        while left > 0:
            for name, profile in profiles(rng).items():
                if left > 0:
                    yield decade, drawn(rng, decade, name, profile, min(BATCH, left))
                left -= BATCH


def report(first: int, end: int, count: int, seed: int, worst: int = 0) -> str:
    """Return a table with a row for each decade; print the worst scenes."""
    names = (FORCE, ENERGY, *PARTS, *DEPTHS)
    rows: dict[int, list[tuple[Batch, dict[str, Values], Values]]] = {}
    for decade, batch in decades(first, end, count, seed):
        rows.setdefault(decade, []).append((batch, *compared(batch)))
    lines = []
    for decade, row in rows.items():
        status = Counter(int(one) for _, _, flags in row for one in flags)
        none = [f"{number} of {flag}" for flag, number in status.items() if flag]
        line = [f"10^{decade}", sum(status.values()), ", ".join(none) or "0"]
        for name in names:
            found = np.concatenate([ratios[name] for _, ratios, _ in row])
            found = found[np.isfinite(found)]
            line.append(f"{np.count_nonzero(found > 1.0)} ({np.max(found, initial=0.0):.2g})")
        lines.append(line)
        print_worst(row, names, worst)
    return table(["waves, from", "scenes", "no value, by status", *(f"{name}: beyond (most)" for name in names)], lines)


def main() -> None:
    """Print a table with a row for each decade, or for each class."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=10_000, help="scenes a decade")
    parser.add_argument("seed", type=int, nargs="?", default=20263)
    parser.add_argument("--decades", type=int, nargs=2, default=(4, 14), metavar=("FIRST", "END"))
    parser.add_argument("--balls", type=int, default=0, help="scenes a class against ball arithmetic instead")
    parser.add_argument("--worst", type=int, default=0, help="scenes to be printed of each decade")
    requested = parser.parse_args()
    first, end = requested.decades
    if requested.balls:
        print(report_of_balls(first, end, requested.balls, requested.seed))
    else:
        print(report(first, end, requested.count, requested.seed, requested.worst))


def report_of_balls(first: int, end: int, count: int, seed: int) -> str:
    """Return a table with a row for each class."""
    heads = ("class", "scenes", "no value", "beyond what is stated", "true/stated at most", "in the median")
    return table(heads, (row_of(*one) for one in against_balls(first, end, count, seed)))


def row_of(name: str, ratios: Values) -> list[Any]:
    """Return a row of what ball arithmetic says of a class."""
    known = ratios[np.isfinite(ratios)]
    beyond = int(np.count_nonzero(known > 1.0))
    return [name, ratios.size, ratios.size - known.size, beyond, float(known.max()), float(np.median(known))]


def print_worst(row: list[tuple[Batch, dict[str, Values], Values]], names: tuple[str, ...], count: int) -> None:
    """Print the scenes that are worst in one of the outputs, and some without a value."""
    for name in names if count else ():
        ranked = [
            (float(ratio), batch, i) for batch, ratios, _ in row for i, ratio in enumerate(ratios[name]) if ratio > 1.0
        ]
        for ratio, batch, i in sorted(ranked, key=lambda one: -one[0])[:count]:
            print(f"{name} {ratio:.3g}: {batch.name}", {key: float(value[i]) for key, value in batch.scenes.items()})
            print("   ", batch.profile)
    failed = [(batch, i) for batch, _, flags in row for i, flag in enumerate(flags) if flag]
    for batch, i in failed[:count]:
        print(f"no value: {batch.name}", {key: float(value[i]) for key, value in batch.scenes.items()})
        print("   ", batch.profile)


if __name__ == "__main__":
    main()
