"""A thousand to a hundred thousand waves within one contact, where few can be walked: similarity, sums and limits."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, draw_curves
from tests.core.scene import scene_of

from .kinds import COUNTS, DEPTH, MIXED, TWO, Kind, Scenes, for_kinds, one_of, rescaled, rng_of, some
from .promises import agree
from .theory import Waves, stiffness, stretch, wave_size

ENERGIES = ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out")
WAVES = np.array([1e3, 5e3, 3e4, 1e5])
PLAIN = (Kind("long"), Kind("long, two harmonics", waves=TWO))
TYPES = (*PLAIN, Kind("long, machine", control="machine"), Kind("long, two works", ratio=True))
EVERY = for_kinds(TYPES)
PAIR: Waves = ((1, 0.6, -0.3), (2, -0.2, 0.25))
SLANTED, STEEP = ((1, 1.0, 0.3), (2, 0.4, -0.2)), ((1, 0.2, 0.0), (4, 0.5, 0.2))
WALKED = (
    *TYPES,
    Kind("long, load", control="load"),
    Kind("long, slanted", waves=SLANTED),
    Kind("long, slanted, load", waves=SLANTED, control="load"),
    Kind("long, steep between, machine", waves=STEEP, control="machine"),
    Kind("long, exponent 1.5", exponent=1.5),
    Kind("long, exponent 1.5, load", exponent=1.5, control="load"),
    Kind("long, cubic, machine", exponent=3.0, waves=MIXED, control="machine"),
)


def long(kind: Kind, law: str, waves: Any = WAVES, chi: Any = None) -> Scenes:
    """Scenes with that many waves within the rim, most of which fold."""
    rng, count = rng_of(f"{law} {kind.name}"), np.size(waves)
    scenes = kind.draw(rng, count)
    k, M = scenes["k"], stiffness(scenes["k"], scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    rim = M ** (-1 / (3 + k)) * rng.uniform(1.5, 2.5, count)
    wavelength = rim / np.asarray(waves)
    A = (rng.uniform(0.15, 0.7, count) if chi is None else chi) * stretch(k, M) / wave_size(k, 1.0, wavelength)
    return scenes | {"lambda_over_R": wavelength, "A": A, "a_max_over_R": rim}


def agree_but_for_a_jump(kind: Kind, scenes: Scenes, found: Any, expected: Any, names: Any = ()) -> None:
    """Compare values; of 1e5 decisions one may be within the promise of a tie, and a count differ by as much."""
    names = names or [name for name in kind.outputs if name not in COUNTS]
    agree(kind, scenes, found, expected, names)
    for name in COUNTS:
        assert (np.abs(found[name] - expected[name]) <= 1).all(), name


@EVERY
def test_similarity_and_alone_and_beside(kind: Kind) -> None:
    scenes = long(kind, "similar")
    found, other = kind.solve(scenes), rescaled(kind, scenes, scenes["k"], 4.0)
    assert (found["unloading_jumps"] > 20).any()
    agree_but_for_a_jump(kind, other, kind.solve(other), rescaled(kind, found, scenes["k"], 4.0))
    for i in range(WAVES.size):
        agree_but_for_a_jump(kind, some(scenes, [i]), kind.solve(some(scenes, [i])), some(found, [i]))


@for_kinds(PLAIN)
def test_what_is_lost_is_the_sum_over_the_drawn_jumps(kind: Kind) -> None:
    """Some thousand jumps, listed one by one; from rims on either side of the pull-off, on a branch or between two."""
    scenes = long(kind, "sum", [900.0, 2500.0, *[2500.0] * 6])
    scenes["a_max_over_R"][2:] *= np.linspace(0.1, 0.4, 6)
    found = kind.solve(scenes)
    for i in range(8):
        jumps, _ = draw_curves(one_of(scenes, i), ["jumps"], **kind.how)
        own = values = some(found, [i])
        for back, name in enumerate(("loading", "unloading")):
            lost = jumps["jump_energy"][jumps["jump_unloading"] == back]
            own = own | {f"{name}_energy": lost.sum(keepdims=True), f"{name}_jumps": np.array([lost.size])}
        agree_but_for_a_jump(kind, some(scenes, [i]), own, values, ["loading_energy", "unloading_energy"])


@for_kinds(WALKED)
def test_waves_are_summed_as_they_are_walked(kind: Kind) -> None:
    """The loop integral is known of walked waves alone: where it is asked for, nothing is summed up to 2,000 waves."""
    rng = rng_of(f"walked {kind.name}")
    scenes = long(kind, "walked", rng.uniform(650.0, 1900.0, 40), rng.uniform(0.05, 4.0, 40))
    scenes |= {"a_max_over_R": rng.uniform(0.5, 1.0, 40) * scenes["a_max_over_R"]}
    summed, other = kind.solve(scenes), kind
    names = ["pull_off_force", "pull_off_radius", "loading_energy", "delta_max", "turning_radius", *COUNTS]
    if kind.control == "load":  # which has no loop: a limit of machines
        other, scenes = replace(kind, control="machine"), scenes | {"machine_stiffness": np.full(40, 1e-15)}
    else:
        names += ["dissipated_energy", "unloading_energy", "delta_jump_out", "snap_in_force"]
    walked = other.solve(scenes, [*names, "energy_residual"])
    assert np.isfinite(walked["energy_residual"]).all()
    size = np.abs(summed["loading_energy"]) + np.abs(summed["unloading_energy"])
    for name in names:
        scale = size if "energy" in name else np.abs(summed[name]) + (1e-3 if "delta" in name else 0.0)
        within = np.abs(summed[name] - walked[name]) <= (0.0 if name in COUNTS else 2e-12 * scale)
        assert (within | (np.isnan(summed[name]) & np.isnan(walked[name]))).all(), name


@for_kinds([Kind("two works", ratio=True), Kind("two works, machine", ratio=True, control="machine")])
def test_opening_may_fold_farther_than_closing(kind: Kind) -> None:
    """Faint short waves whose end is set by the stretch: of opening at 2.19, of closing inside it."""
    rims = np.array([1.5, 2.1, 2.3, 3.0, 30.0, np.inf])
    values = 0.11065288007270635, 0.2904237501002302, 1.2411071512131673, 1.3658526168611218, 0.0027736378292707135
    scene = scene_of(*values, 0.010210029543445907, rims, closing_ratio=0.5)
    scene |= {"machine_stiffness": 3.0} if kind.control == "machine" else {}
    scenes = {name: np.broadcast_to(value, 6) for name, value in scene.items()}
    names = ["loading_energy", "unloading_energy"]
    found, ends = kind.solve(scenes), kind.solve(scenes, ["saturation_radius"])["saturation_radius"]
    inner, own = some(scenes, rims < 3.0), some(found, rims < 3.0)
    walked = own | kind.solve(inner, [*names, *COUNTS, "energy_residual"])
    agree_but_for_a_jump(kind, inner, own, walked, names)
    beyond = rims > ends
    assert beyond.sum() > 2
    for i in np.flatnonzero(beyond)[1:]:
        last = some(found, [np.flatnonzero(beyond)[0]])
        agree_but_for_a_jump(kind, some(scenes, [i]), some(found, [i]), last, names)


@for_kinds(PLAIN)
def test_beyond_saturation_nothing_is_lost(kind: Kind) -> None:
    """Where the last fold lies within the rim, a wider rim or none changes no value but the depth that is reached."""
    scenes = long(kind, "saturated", WAVES[[0, 0, 0, 0, 1]], 0.004)
    radius = kind.solve(scenes, ["saturation_radius"])["saturation_radius"]
    scenes, radius = some(scenes, radius > 0), radius[radius > 0]  # NaN where nothing folds
    assert radius.size > 2
    far = scenes | {"a_max_over_R": 3.0 * radius}
    expected = kind.solve(far)
    for rim in (1.001 * radius, np.full(radius.size, np.inf)):
        agree_but_for_a_jump(kind, far, kind.solve(scenes | {"a_max_over_R": rim}), expected, ENERGIES)


@for_kinds(PLAIN)
def test_a_turn_is_a_rim_there(kind: Kind) -> None:
    scenes, turned = long(kind, "turn"), replace(kind, turn=DEPTH)
    wide = scenes | {DEPTH: 0.6 * kind.solve(scenes, ["delta_max"])["delta_max"]}
    found = turned.solve(wide)
    assert (found["turning_radius"] < scenes["a_max_over_R"]).sum() > 1  # a jump may lead to the rim
    rims = kind.solve(scenes | {"a_max_over_R": found["turning_radius"]})
    agree_but_for_a_jump(turned, wide, rims, found, ENERGIES)


def test_waves_below_rounding_lose_nothing() -> None:
    """At k = 1 a flat punch lands on all of its area; what rounding leaves of its waves is no way out of contact."""
    rim = 7.053812616961874e-07
    rims = rim * (1.0 + 1e-12 * np.arange(4))
    scenes = scene_of(1.0, 0.5, 222747622.36116394, 0.5, 5.29e-11, 6.4e-9, rims)
    found = PLAIN[0].solve(scenes, ["dissipated_energy", "unloading_energy"])
    np.testing.assert_allclose(found["dissipated_energy"], np.pi * rim**2, rtol=1e-11)
    np.testing.assert_allclose(found["unloading_energy"], 0.0, atol=1e-11 * np.pi * rim**2)


# number of waves, rim in lengths of similarity and chi
SIMILAR = [
    # unloading ends between neighbours that are level to rounding
    (Kind(waves=PAIR), 0.3, 2.6e4, 3.0, 1e-3),
    (Kind(waves=((1, 0.0, 1.0),)), 0.0, 4.3e5, 2.0, 0.1),
    (Kind(exponent=3.0, waves=PAIR, control="machine"), 0.5, 7.1e5, 5.0, 0.02),
    (Kind(exponent=1.0, waves=PAIR, control="load"), 0.8, 9.9e4, 4.0, 0.3),
    # k = 1: the waves next to zero contact are level, and unloading passes them
    (Kind(waves=PAIR), 1.0, 5.3e5, 5.8, 0.016),
    (Kind(waves=PAIR, control="machine"), 1.0, 3.6e4, 6.0, 2.4e-4),
    # loading jumps in where many waves end at the depth 0
    (Kind(waves=((1, -1.0, 0.0),)), 0.9, 33910.125, 2.8, 1.2),
]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "k", "count", "ratio", "chi"), SIMILAR)
def test_similar_scenes(kind: Kind, k: float, count: float, ratio: float, chi: float) -> None:
    """Lengths differ by 5/4: coordinates round anew while the phase at the rim is the same double."""
    nu, c0, wavelength = 0.5 if k == 1.0 else 0.2, 0.1, 2.0 ** round(math.log2(1e-3 / count))
    M = (count * wavelength / ratio) ** (1.0 - 2.0 * kind.exponent - k)
    A = float(chi * stretch(k, M) / wave_size(k, 1.0, wavelength))
    scene = scene_of(k, nu, M / float(stiffness(k, nu, 1.0, c0)), c0, wavelength, A, count * wavelength)
    spring = 0.0038 if k == 1.0 else 0.3
    scene |= {"machine_stiffness": spring} if kind.control == "machine" else {}
    names = ["loading_energy", "unloading_energy"]
    one, other = (kind.solve(own, names, check_contact=False) for own in (scene, rescaled(kind, scene, k, 1.25)))
    assert not (one["status"] | other["status"]) & FAILED
    size = sum(abs(one[name]) for name in names)
    for name in names:
        assert abs(one[name] - other[name] / 1.25**2) <= 1e-12 * (count / 1000.0) * size
