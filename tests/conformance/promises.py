"""How far a value may be from the truth, as docs/accuracy.md promises it, and comparisons by that.

Force and energy are promised to 1e-12 of the sizes of their terms up to 1,000 waves of the shortest harmonic within the
contact, a digit less for each decade more. Counts are equal wherever `close_to_a_jump` is not set.
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core import FLAGS

from .kinds import COUNTS, Kind, Scenes, one_of
from .theory import FORCE, Array, Curve, power_factor, stiffness, stretch, wave_size

SHARE: Final = 1e-12  # of the sizes of the terms
PLACE: Final = 1e-6  # of a radius at which a function that is good to SHARE is stationary: the root of it
SENSITIVITY: Final = 1e-8
CLOSE, NO_VALUE, NO_CONTACT = (FLAGS[name] for name in ("close_to_a_jump", "no_value", "no_contact"))

Results = Mapping[str, NDArray[Any]]


def has(found: Results, bits: int) -> NDArray[np.bool_]:
    """Tell which scenes have one of some bits in their status, whatever its type."""
    return np.asarray(np.asarray(found["status"]).astype(int) & bits != 0)


def is_sure(found: Results) -> NDArray[np.bool_]:
    """Tell which scenes have values of a contact, and no tie."""
    return ~has(found, NO_VALUE | NO_CONTACT | CLOSE)


def phase_of(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The phase of the shortest harmonic at a radius."""
    return np.asarray(2 * np.pi * kind.highest * a / np.asarray(scenes["lambda_over_R"]))


def depth_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The sum of the sizes of the terms of the depth at a radius: punch, waves, adhesion."""
    k, m, A, wavelength = np.asarray(scenes["k"]), kind.exponent, scenes["A"], np.asarray(scenes["lambda_over_R"])
    M = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    front = a ** ((1 - k) / 2)
    sizes = [(n, np.hypot(even, odd)) for n, even, odd in kind.waves]
    waves = sum(h * (wavelength * A + n ** ((1 - k) / 2) * front * wave_size(k, A, wavelength)) for n, h in sizes)
    tough = 1 + sum(np.hypot(even, odd) for _, even, odd in kind.pattern_waves)
    return np.asarray(power_factor(k, m) * a**m + waves + tough * stretch(k, M) * front)


def load_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The same of the load, in 1.5 pi R dgamma."""
    k = np.asarray(scenes["k"])
    M = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    return np.asarray(2 ** (1 - k) * M / (1 + k) * a ** (1 + k) * depth_size(kind, scenes, a) / FORCE)


def work_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The size of what is done up to a radius: the area of the loop in the plane of load and what is prescribed."""
    return np.asarray(np.pi * np.asarray(a) ** 2 + FORCE * load_size(kind, scenes, a) * moved_size(kind, scenes, a))


def moved_size(kind: Kind, scenes: Scenes, a: Any) -> Array:
    """The size of the depth, or of where the far end of a machine's spring is: 1 + K a^(1+k)/S of it."""
    depth = depth_size(kind, scenes, a)
    if kind.control == "machine":
        depth += FORCE * load_size(kind, scenes, a) / (np.asarray(scenes["machine_stiffness"]) * scenes["modulus"])
    return depth


def turn_error(kind: Kind, scenes: Scenes, radius: Array) -> Array:
    """How far a turning radius may be off: errors of depth or load over their slopes, at most PLACE beside a fold.

    It is where a depth or a load is first met, or where a jump at some depth or load lands: the larger error holds.
    """
    error = np.zeros(radius.shape)
    rims = np.broadcast_to(scenes["a_max_over_R"], radius.shape)
    for i in np.flatnonzero((radius > 0) & (radius < rims)) if kind.turn else ():
        scene, a = one_of(scenes, i), float(radius[i])
        curve, near = Curve(kind, scene, closing=True), np.array([a * (1 - 1e-5), a * (1 + 1e-5)])
        for function, size in ((curve.depth, depth_size), (curve.load, load_size)):
            slope = max(abs(float(np.diff(function(near))[0])) / (2e-5 * a), 1e-300)
            error[i] = max(error[i], min(PLACE * a, SHARE * float(size(kind, scene, a)) / slope))
    return error


def errors(kind: Kind, scenes: Scenes, found: Results) -> dict[str, Array]:
    """The promised error of each result that is a number, in its unit."""
    with np.errstate(all="ignore"):
        pull, end = found["pull_off_radius"], found["turning_radius"]
        # the largest radius of contact, of an unbounded paraboloid the slope at the end of its jumps
        most = np.where(np.isfinite(end), end, found.get("contact_slope", pull))
        share = SHARE * np.maximum(1.0, np.nan_to_num(phase_of(kind, scenes, most), posinf=0.0) / (2e3 * np.pi))
        moved = turn_error(kind, scenes, end)
        # a turn that is moved moves what depends on the radius there at first order: powers of it up to 4
        turned = 4 * moved / most
        depth, load = depth_size(kind, scenes, most), load_size(kind, scenes, pull)
        losses = np.abs(found["loading_energy"]) + np.abs(found["unloading_energy"])
        terms = losses + np.pi * most**2
        if kind.control == "load":  # what the load does is a term of its own
            terms = work_size(kind, scenes, most)
        energy = share * terms + 2 * np.pi * most * moved
        allowed = dict.fromkeys(("dissipated_energy", "loading_energy", "unloading_energy", "front_energy"), energy)
        allowed["pull_off_force"] = (share + np.where(pull == end, turned, 0.0)) * load
        allowed["pull_off_radius"] = PLACE * pull + moved
        allowed["delta_max"] = (share + turned) * depth
        allowed["delta_jump_out"] = 2 * share * depth_size(kind, scenes, pull)  # contact ends within the pull-off
        allowed["turning_radius"] = moved + 4e-16 * np.nan_to_num(most)
        allowed["snap_in_force"] = share * load_size(kind, scenes, most)
        allowed["pinned_depth"] = (share + turned) * moved_size(kind, scenes, most)
        allowed["contact_slope"] = PLACE * most
        # a sum of products of load and depth, each good to the promise
        allowed["energy_residual"] = 10 * SHARE * work_size(kind, scenes, most) + 2 * energy
    return allowed


def agree(kind: Kind, scenes: Scenes, found: Results, expected: Results, names: Any = (), **more: Any) -> None:
    """Assert that results are the expected ones, all of the kind or `names`.

    Numbers may be off by `times` the promised error, 2 by default: two solves that are compared may be off by it each;
    and by a part `more` of their sizes. Counts are compared where neither scene is close to a jump. What has no value
    must have none in both. With `bits` the status is compared, but for `close_to_a_jump`, which has a limit.
    """
    if more.get("bits"):
        assert ((found["status"] ^ expected["status"]) & ~CLOSE == 0).all(), (found["status"], expected["status"])
    allowed = errors(kind, scenes, expected)
    where = np.broadcast_to(more.get("where", True), found["status"].shape)
    sure = where & ~has(found, CLOSE) & ~has(expected if "status" in expected else found, CLOSE)
    for name in names or [name for name in kind.outputs if name in expected]:
        one, other = np.asarray(found[name], dtype=float), np.asarray(expected[name], dtype=float)
        with np.errstate(invalid="ignore"):
            limit = 0.0 if name in COUNTS else more.get("times", 2.0) * np.nan_to_num(allowed[name], posinf=0.0)
            off = np.abs(one - other) > limit + more.get("more", 0.0) * np.abs(other)
        wrong = off | (np.isnan(one) != np.isnan(other)) | (np.isinf(one) & (one != other))
        wrong &= sure if name in (*COUNTS, "pull_off_radius", "turning_radius") else where
        if wrong.any():
            i = tuple(np.argwhere(wrong)[0])
            scene = {n: float(np.broadcast_to(v, wrong.shape)[i]) for n, v in scenes.items()}
            told = f"{kind.name}: {name} {one[i]!r} for {other[i]!r} in {int(wrong.sum())} of {wrong.size}"
            raise AssertionError(f"{told}, first in {scene}, status {int(found['status'][i])}")
