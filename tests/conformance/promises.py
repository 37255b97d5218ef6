"""How far a value may be from the truth, as docs/accuracy.md promises it, and comparisons by that.

Force and energy are promised to 1e-12 of the sizes of their terms up to 1,000 waves of the shortest harmonic within the
contact, a digit less for each decade more. Counts are equal wherever `close_to_a_jump` is not set.
"""

from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core import FLAGS

from .kinds import COUNTS, Kind, Scenes
from .theory import FORCE, Curve, power_factor, stiffness, stretch, wave_size

SHARE: Final = 1e-12
"""Of the sizes of the terms."""
PLACE: Final = 1e-6
"""Of a radius at which a function that is good to SHARE is stationary: the root of it."""
SENSITIVITY: Final = 1e-8
CLOSE: Final = FLAGS["close_to_a_jump"]
NO_VALUE: Final = FLAGS["no_value"]
NO_CONTACT: Final = FLAGS["no_contact"]
ENERGIES: Final = ("dissipated_energy", "loading_energy", "unloading_energy")

Results = Mapping[str, NDArray[Any]]
Array = NDArray[np.float64]


def has(found: Results, bits: int) -> NDArray[np.bool_]:
    """Tell which scenes have one of some bits in their status, whatever its type."""
    return np.asarray(np.asarray(found["status"]).astype(int) & bits != 0)


def reached(found: Results) -> Array:
    """The largest radius of contact over R: the turn, or of an unbounded paraboloid the slope at the end of its jumps."""
    end = found["turning_radius"]
    return np.asarray(np.where(np.isfinite(end), end, found.get("contact_slope", found["pull_off_radius"])))


def share_of(kind: Kind, scenes: Scenes, radius: Any) -> Array:
    """The promised share at some contact radius."""
    waves = kind.waves_per_wavelength * radius / np.asarray(scenes["lambda_over_R"])
    result: Array = SHARE * np.maximum(1.0, np.nan_to_num(waves, nan=0.0, posinf=0.0) / 1000.0)
    return result


def depth_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The sum of the sizes of the terms of the depth at a radius: punch, waves, adhesion."""
    k, m, A, wavelength = np.asarray(scenes["k"]), kind.exponent, scenes["A"], np.asarray(scenes["lambda_over_R"])
    M = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    front = a ** ((1 - k) / 2)
    waves = sum(
        np.hypot(even, odd) * (wavelength * A + n ** ((1 - k) / 2) * front * wave_size(k, A, wavelength))
        for n, even, odd in kind.waves
    )
    tough = 1 + sum(np.hypot(even, odd) for _, even, odd in kind.pattern_waves)
    result: Array = power_factor(k, m) * a**m + waves + tough * stretch(k, M) * front
    return result


def load_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The same of the load, in 1.5 pi R dgamma."""
    k = np.asarray(scenes["k"])
    M = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    result: Array = 2 ** (1 - k) * M / (1 + k) * a ** (1 + k) * depth_size(kind, scenes, a) / FORCE
    return result


def spring(kind: Kind, scenes: Scenes, a: Any) -> Any:
    """By how much the end of a machine's spring moves more than the punch: 1 + K a^(1+k)/S; 1 without a machine."""
    if kind.control != "machine":
        return 1.0
    stretched = FORCE * load_size(kind, scenes, a) / depth_size(kind, scenes, a)
    return 1.0 + stretched / (np.asarray(scenes["machine_stiffness"]) * scenes["modulus"])


def turn_error(kind: Kind, scenes: Scenes, radius: Array) -> Array:
    """How far a turning radius may be off: the error of what is measured over its slope, or PLACE beside a fold."""
    error = np.zeros(radius.shape)
    for i in np.ndindex(radius.shape):
        a = float(radius[i])
        if not kind.turn or not 0.0 < a < np.inf or a == np.asarray(scenes["a_max_over_R"])[i]:
            continue
        scene = {name: float(np.asarray(values)[i]) for name, values in scenes.items()}
        curve = Curve(kind, scene, closing=True)
        step = np.array([a * (1 - 1e-5), a * (1 + 1e-5)])
        values = curve.depth(step) if kind.turn.startswith("indentation") else curve.load(step)
        size = depth_size(kind, scene, a) if kind.turn.startswith("indentation") else load_size(kind, scene, a)
        slope = abs(values[1] - values[0]) / (2e-5 * a)
        error[i] = min(PLACE * a, SHARE * float(size) / slope if slope > 0 else np.inf)
    return error


def errors(kind: Kind, scenes: Scenes, found: Results) -> dict[str, Array]:
    """The promised error of each result that is a number, in its unit."""
    with np.errstate(invalid="ignore"):
        end, pull = found["turning_radius"], found["pull_off_radius"]
        most = reached(found)
        share = share_of(kind, scenes, most)
        moved = turn_error(kind, scenes, end)
        energy = sum(np.abs(found[name]) for name in ENERGIES[1:]) + np.pi * most**2
        edge = 2 * np.pi * most * moved
        at_turn = load_size(kind, scenes, pull) * np.where(pull == end, 4 * moved / most, 0.0)
        depth = depth_size(kind, scenes, most)
        last = depth_size(kind, scenes, np.minimum(pull, most))  # contact ends within the pull-off
        return {
            "pull_off_force": share * load_size(kind, scenes, pull) + at_turn,
            "pull_off_radius": PLACE * pull + moved,
            "dissipated_energy": share * energy + edge,
            "loading_energy": share * energy + edge,
            "unloading_energy": share * energy + edge,
            "front_energy": share * energy + edge,
            "delta_max": share * depth + depth * 4 * moved / most,
            "delta_jump_out": share * (last + depth_size(kind, scenes, pull)),
            "turning_radius": moved + 4e-16 * np.where(np.isfinite(end), end, 0.0),
            "snap_in_force": share * load_size(kind, scenes, most),
            "pinned_depth": (share + 4 * moved / most) * depth * spring(kind, scenes, most),
            "contact_slope": PLACE * most,
        }


def agree(
    kind: Kind,
    scenes: Scenes,
    found: Results,
    expected: Results,
    names: Iterable[str] = (),
    *,
    times: float = 2.0,
    more: Any = 0.0,
    where: Any = True,
) -> None:
    """Assert that results are the expected ones: within `times` the promised error and `more` of the size of a value.

    Two solves that are compared with each other may be off by the promise each, hence 2. Counts are compared where
    neither is close to a jump. What has no value must have none in both.
    """
    allowed = errors(kind, scenes, expected)
    where = np.broadcast_to(where, found["status"].shape)
    sure = where & ~has(found, CLOSE) & ~has(expected if "status" in expected else found, CLOSE)
    for name in names or [name for name in kind.outputs if name in expected]:
        one, other = np.asarray(found[name], dtype=float), np.asarray(expected[name], dtype=float)
        if name in COUNTS:
            wrong = sure & (one != other)
        else:
            with np.errstate(invalid="ignore"):
                limit = times * np.nan_to_num(allowed[name], posinf=0.0) + more * np.abs(other)
                wrong = where & ~((np.abs(one - other) <= limit) | (one == other) | (np.isnan(one) & np.isnan(other)))
            if name in ("pull_off_radius", "turning_radius"):
                wrong &= sure
        if wrong.any():
            i = tuple(np.argwhere(wrong)[0])
            scene = {n: float(np.broadcast_to(v, wrong.shape)[i]) for n, v in scenes.items()}
            told = f"{kind.name}: {name} {one[i]!r} for {other[i]!r} in {int(wrong.sum())} of {wrong.size}, first in {scene}"
            raise AssertionError(f"{told}, status {int(found['status'][i])}")
