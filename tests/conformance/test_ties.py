"""Decisions: `close_to_a_jump` where two decisions tie, and one disc against the gap by brute force."""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gradhesion.core import FLAGS, draw_curves
from tests.core.scene import scene_of

from .kinds import BY_NAME, COUNTS, EXACT, SCENES, Kind, Scenes, drawn, for_kinds, one_of, rng_of, some
from .promises import CLOSE, has
from .theory import Array, Curve, Waves

NOT_ONE = FLAGS["loading_contact_not_one_disc"]
DIPS: list[Waves] = [((1, 0.5, 0.0), (4, -0.4, 0.2)), ((1, 0.5, 0.3), (5, -0.7, 0.0)), ((1, 0.2, 0.1), (3, -0.3, 0.4))]


@for_kinds(EXACT)
def test_random_scenes_are_close_to_no_jump(kind: Kind) -> None:
    """Ties within 1e-10 among some hundred decisions: once in 10,000 seeds."""
    assert not has(drawn(kind)[1], CLOSE).any()


def bisected(kind: Kind, scenes: Scenes, name: str, output: str) -> list[Scenes]:
    """Scenes on both sides of a step of a count, or of the pull-off's place, as close as doubles are."""

    def value(amount: Any) -> Any:
        return kind.solve(scenes | {name: amount}, [output])[output].astype(float)

    least = 0.5 if output in COUNTS else 0.02 * scenes["a_max_over_R"]
    use = np.abs(value(scenes[name]) - value(1.12 * scenes[name])) > least
    scenes, least = some(scenes, use), np.broadcast_to(least, use.shape)[use]
    low, high = scenes[name], 1.12 * scenes[name]
    first, last = value(low), value(high)
    for _ in range(64):
        middle = 0.5 * (low + high)
        found = value(middle)
        left = np.abs(found - first) > (least if output in COUNTS else np.abs(found - last))
        high, last = np.where(left, middle, high), np.where(left, found, last)
        low, first = np.where(left, low, middle), np.where(left, first, found)
    use = (np.abs(first - last) > least) & (high - low <= 4e-16 * high)
    return [some(scenes | {name: end}, use) for end in (low, high)]


@pytest.mark.parametrize("at_1", [False, True])
@for_kinds([kind for kind in EXACT if not kind.unbounded])
def test_scenes_on_a_tie_are_close_to_a_jump(kind: Kind, at_1: bool) -> None:
    """Counts, and the place of the pull-off, are promised without the bit: at two neighbouring doubles they may differ.

    A billionth away most are free, and an error of 1e-12 changes no count of these.
    """
    scenes, tied, free = drawn(kind)[0], 0, 0
    scenes = some(scenes, np.flatnonzero((scenes["k"] == 1) == at_1)[: SCENES // 3])
    steps = (("A", COUNTS[0]), ("lambda_over_R", COUNTS[1]), ("lambda_over_R", "pull_off_radius"))
    for name, output in steps if scenes["k"].size else ():
        for ends, off in zip(bisected(kind, scenes, name, output), (-1e-9, 1e-9), strict=True):
            if ends["A"].size:
                on = has(kind.solve(ends, [output]), CLOSE)
                assert on.all(), some(ends, ~on)
                apart = has(kind.solve(ends | {name: ends[name] * (1 + 1e-6)}, [output]), CLOSE)
                assert apart.mean() <= 0.1
                steps_off = (off, off - 1e-12, off + 1e-12)
                near, *moved = (kind.solve(ends | {name: ends[name] * (1 + step)}, [output]) for step in steps_off)
                sure = ~has(near, CLOSE)
                for other in moved if output in COUNTS else ():
                    np.testing.assert_array_equal(other[output][sure], near[output][sure])
                free += int(sure.sum())
                tied += on.size
    assert (tied > 3 and free > 0.7 * tied) or at_1


def least_gap(kind: Kind, scene: Scenes) -> float:
    """The least gap over the states of loading, over what the pull of their edges alone would open; negative: overlap."""
    path, _ = draw_curves(scene, ["path"], **kind.how)
    on = (path["path_unloading"] == 0) & (path["path_jump"] == 0) & (path["path_contact_radius"] > 0)
    curve, end = Curve(kind, scene, closing=True), scene["a_max_over_R"]
    shortest = scene["lambda_over_R"] / kind.highest
    grid = end * np.linspace(0.0, 1.0, int(200 * end / shortest) + 60)[1:] ** 1.5
    without = CubicSpline(grid, curve.without_adhesion(grid))
    least = 1.0
    for a in path["path_contact_radius"][on & (path["path_contact_radius"] < 0.999 * end)]:
        radii = np.append(np.arange(a * 1.0005 + 0.01 * shortest, end, shortest / 40), end)
        pull = float(curve.adhesion(np.array([a]))[0])
        depth = float(without(a)) - pull
        gap = curve.gaps(a, radii, without, -depth) / curve.gaps(a, radii, np.zeros_like, pull)
        least = min(least, float(gap.min()))
    return least


def swings(waves: Waves, x: Array) -> Any:
    """The height of waves at x wavelengths, over that of one cosine."""
    phases = [2 * np.pi * n * x for n, _, _ in waves]
    return sum(even * (1 - np.cos(x)) + odd * np.sin(x) for (_, even, odd), x in zip(waves, phases, strict=True))


def touches_elsewhere(kind: Kind, scene: Scenes) -> bool:
    """Tell whether the punch is lower somewhere than at its centre, so that contact starts elsewhere."""
    r, wavelength = np.linspace(0.0, scene["a_max_over_R"], 4000), scene["lambda_over_R"]
    waves = wavelength * scene["A"] * swings(kind.waves, r / wavelength)
    return bool(np.min(r**kind.exponent / kind.exponent + waves) < 0)


def beside_the_step(kind: Kind, scenes: Scenes) -> list[Scenes]:
    """Scenes by a percent of A below and above the amplitude from which on contact is not one disc."""
    low, high = 0.2 * scenes["A"], 4.0 * scenes["A"]
    first, last = (has(kind.solve(scenes | {"A": A}), NOT_ONE) for A in (low, high))
    for _ in range(12):
        flagged = has(kind.solve(scenes | {"A": 0.5 * (low + high)}), NOT_ONE)
        low, high = np.where(flagged, [low, 0.5 * (low + high)], [0.5 * (low + high), high])
    return [some(scenes | {"A": A}, last & ~first) for A in (0.99 * low, 1.01 * high)]


DISCS = ["cosine", "cosine, load", "cosine, machine", "cosine, turned at a depth", "two harmonics", "exponent 1.5"]
DISCS += ["two harmonics, turned at a depth", "cosine, turned at a load", "pattern of toughness"]


@pytest.mark.parametrize(
    ("kind", "at_1"), [*((BY_NAME[name], False) for name in DISCS), *((BY_NAME[name], True) for name in DISCS[:3])],
    ids=lambda value: value.name if isinstance(value, Kind) else str(value),
)  # fmt: skip
def test_one_disc_against_the_gap_by_brute_force(kind: Kind, at_1: bool) -> None:
    """Where it is decided, from which random scenes are far; at k = 1 the gap is that of the profile at each radius."""
    rng, decided = rng_of(f"disc {kind.name}"), {True: 0, False: 0}
    own = some(drawn(kind)[0], slice(SCENES // 2))
    own = own | ({"k": np.ones_like(own["k"]), "nu": np.full_like(own["k"], 0.5)} if at_1 else {})
    for scenes in beside_the_step(kind, own):
        flagged = has(kind.solve(scenes), NOT_ONE)
        for i in rng.permutation(flagged.size)[:4]:
            least, flag = least_gap(kind, one_of(scenes, i)), bool(flagged[i])
            if abs(least) > 2e-3 and not touches_elsewhere(kind, one_of(scenes, i)):  # nearer, radii between decide
                assert (least < 0) == flag, (least, one_of(scenes, i))
                decided[flag] += 1
    assert min(decided.values()) > 1


@for_kinds(["sines, load", "no first harmonic"])
def test_a_punch_that_touches_elsewhere_first_is_flagged(kind: Kind) -> None:
    scenes, found = drawn(kind)
    lower = np.array([touches_elsewhere(kind, one_of(scenes, i)) for i in range(found["status"].size)])
    assert lower.any()
    assert has(found, NOT_ONE)[lower].all()


@pytest.mark.parametrize("waves", DIPS)
def test_the_amplitude_from_which_a_punch_touches_elsewhere_first(waves: Waves) -> None:
    """A dip that reaches the height of the centre between two samples of the profile; the amplitude is that of many."""
    wavelength, x = 0.1, np.linspace(0.0, 1.2, 1_000_001)[1:]
    swing = swings(waves, x)
    least = np.min(0.5 * wavelength * x[swing < 0] ** 2 / -swing[swing < 0])
    scene = scene_of(0.3, 0.3, 500.0, 0.01, wavelength, least * np.array([1 - 2e-4, 1 + 2e-4]), 1.0)
    assert has(Kind("a dip", waves=waves).solve(scene), NOT_ONE).tolist() == [False, True]
