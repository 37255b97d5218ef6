"""A thousand to a hundred thousand waves within one contact, where few can be walked: similarity, sums and limits."""

from dataclasses import replace
from typing import Any

import numpy as np

from gradhesion.core import draw_curves
from tests.core.scene import scene_of

from .kinds import COUNTS, DEPTH, TWO, Kind, Scenes, for_kinds, one_of, rescaled, rng_of, some
from .promises import agree
from .theory import stiffness, stretch, wave_size

WAVES = np.array([1e3, 5e3, 3e4, 1e5])
PLAIN = (Kind("long"), Kind("long, two harmonics", waves=TWO))
EVERY = for_kinds([*PLAIN, Kind("long, machine", control="machine"), Kind("long, two works", ratio=True)])


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


@EVERY
def test_waves_are_summed_as_they_are_walked(kind: Kind) -> None:
    """Up to 2,000 waves are walked where the loop integral is asked for, else up to 600."""
    rng = rng_of(f"walked {kind.name}")
    scenes = long(kind, "walked", rng.uniform(650.0, 1900.0, 40), rng.uniform(0.05, 4.0, 40))
    scenes |= {"a_max_over_R": rng.uniform(0.5, 1.0, 40) * scenes["a_max_over_R"]}
    summed, names = kind.solve(scenes), ["dissipated_energy", "loading_energy", "unloading_energy", "delta_max"]
    walked = summed | kind.solve(scenes, [*names, *COUNTS, "energy_residual"])
    assert np.isfinite(walked["energy_residual"]).all(), "it is known of what is walked alone"
    agree_but_for_a_jump(kind, scenes, summed, walked, names)


@for_kinds([Kind("two works", ratio=True), Kind("two works, machine", ratio=True, control="machine")])
def test_opening_may_fold_farther_than_closing(kind: Kind) -> None:
    """Faint short waves whose end is set by the stretch: of opening at 2.19, of closing inside it."""
    rims = np.array([1.5, 2.1, 2.3, 3.0, 30.0, np.inf])
    scenes = {"k": 0.11065288007270635, "nu": 0.2904237501002302, "modulus": 1.2411071512131673}
    scenes |= {"c0_over_R": 1.3658526168611218, "lambda_over_R": 0.0027736378292707135, "A": 0.010210029543445907}
    scenes |= {"closing_ratio": 0.5, "machine_stiffness": 3.0} if kind.control == "machine" else {"closing_ratio": 0.5}
    scenes = {name: np.full(6, value) for name, value in scenes.items()} | {"a_max_over_R": rims}
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
        names = ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out")
        agree_but_for_a_jump(kind, far, kind.solve(scenes | {"a_max_over_R": rim}), expected, names)


@for_kinds(PLAIN)
def test_a_turn_is_a_rim_there(kind: Kind) -> None:
    scenes, turned = long(kind, "turn"), replace(kind, turn=DEPTH)
    wide = scenes | {DEPTH: 0.6 * kind.solve(scenes, ["delta_max"])["delta_max"]}
    found = turned.solve(wide)
    assert (found["turning_radius"] < scenes["a_max_over_R"]).sum() > 1  # a jump may lead to the rim
    rims = kind.solve(scenes | {"a_max_over_R": found["turning_radius"]})
    names = ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out")
    agree_but_for_a_jump(turned, wide, rims, found, names)


def test_waves_below_rounding_lose_nothing() -> None:
    """At k = 1 a flat punch lands on all of its area; what rounding leaves of its waves is no way out of contact."""
    rim = 7.053812616961874e-07
    rims = rim * (1.0 + 1e-12 * np.arange(4))
    scenes = scene_of(1.0, 0.5, 222747622.36116394, 0.5, 5.29e-11, 6.4e-9, rims)
    found = PLAIN[0].solve(scenes, ["dissipated_energy", "unloading_energy"])
    np.testing.assert_allclose(found["dissipated_energy"], np.pi * rim**2, rtol=1e-11)
    np.testing.assert_allclose(found["unloading_energy"], 0.0, atol=1e-11 * np.pi * rim**2)
