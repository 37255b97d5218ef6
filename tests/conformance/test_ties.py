"""Decisions: `close_to_a_jump` where two decisions tie, and one disc against the gap by brute force."""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gradhesion.core import FLAGS, draw_curves

from .faults import kinds_with
from .kinds import BY_NAME, COUNTS, EXACT, Kind, Scenes, drawn, name_of, rng_of, some
from .promises import CLOSE, has
from .theory import Curve

STEPS = 64
"""Bisections from a step of some percent down to two doubles beside each other."""


@pytest.mark.parametrize("kind", EXACT, ids=name_of)
def test_random_scenes_are_close_to_no_jump(kind: Kind) -> None:
    """Ties within 1e-10 among some hundred decisions of 160 scenes: once in 10,000 seeds."""
    _, found = drawn(kind)
    assert not has(found, CLOSE).any()


def bisected(kind: Kind, scenes: Scenes, name: str, output: str) -> tuple[Scenes, Scenes]:
    """Scenes on both sides of a step of a count, or of the pull-off's place, as close as doubles are."""

    def value(amount: Any) -> Any:
        return kind.solve(scenes | {name: amount}, [output])[output].astype(float)

    def differ(one: Any, other: Any) -> Any:
        return np.abs(one - other) > (0.02 * np.abs(one) if output == "pull_off_radius" else 0.5)

    low = np.array(scenes[name], dtype=float)
    high = low * 1.12
    first, last = value(low), value(high)
    use = differ(first, last) & np.isfinite(first) & np.isfinite(last) & (low != high)
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        found = value(middle)
        left = np.abs(found - first) > np.abs(found - last) if output == "pull_off_radius" else differ(first, found)
        high, last = np.where(left, middle, high), np.where(left, found, last)
        low, first = np.where(left, low, middle), np.where(left, first, found)
    use &= differ(first, last) & (np.abs(high - low) <= 4e-16 * np.abs(high))
    return tuple(some(scenes | {name: end}, use) for end in (low, high))  # type: ignore[return-value]


@pytest.mark.parametrize("kind", kinds_with("ties", [k for k in EXACT if not k.unbounded]))
def test_scenes_on_a_tie_are_close_to_a_jump(kind: Kind) -> None:
    """A count is promised where the bit is not set: at one of two neighbouring doubles it may be either."""
    scenes = some(drawn(kind)[0], slice(48))
    tied = 0
    for name, output in (("A", COUNTS[0]), ("lambda_over_R", COUNTS[1]), ("a_max_over_R", COUNTS[0])):
        for ends in bisected(kind, scenes, name, output):
            found = kind.solve(ends, COUNTS)
            tied += ends[name].size
            assert has(found, CLOSE).all(), some(ends, ~has(found, CLOSE))
            apart = kind.solve(ends | {name: ends[name] * (1 + 3e-7)}, COUNTS)
            assert has(apart, CLOSE).mean() <= 0.1 if ends[name].size else True
    assert tied > 6


@pytest.mark.parametrize("name", ["cosine", "two harmonics", "sines, machine", "exponent 1.5"])
def test_two_troughs_that_tie(name: str) -> None:
    """The place of the pull-off steps where two troughs are equally deep."""
    kind = BY_NAME[name]
    for ends in bisected(kind, some(drawn(kind)[0], slice(120)), "lambda_over_R", "pull_off_radius"):
        found = kind.solve(ends, ["pull_off_force", "pull_off_radius"])
        assert ends["A"].size > 2
        assert has(found, CLOSE).all(), some(ends, ~has(found, CLOSE))


def least_opening(kind: Kind, scene: Scenes) -> float:
    """The least gap over the states of loading, over that which the edge alone would leave; negative: it overlaps."""
    path, _ = draw_curves(scene, ["path"], **kind.how)
    loading = path["path_unloading"] == 0
    states = np.flatnonzero(loading & (path["path_contact_radius"] > 0) & (path["path_jump"] == 0))
    curve = Curve(kind, scene, closing=True)
    end = scene["a_max_over_R"]
    shortest = scene["lambda_over_R"] / kind.waves_per_wavelength
    grid = end * np.linspace(0.0, 1.0, int(200 * end / shortest) + 60)[1:] ** 1.5
    without = CubicSpline(grid, curve.without_adhesion(grid))
    curve.without_adhesion = lambda a: without(a)  # type: ignore[method-assign]
    least = 1.0
    for i in states:
        a = float(path["path_contact_radius"][i])
        radii = np.append(np.arange(a * 1.0005 + 0.01 * shortest, end, shortest / 40), end)
        if a >= end * 0.999:
            continue
        # with the pull as the height of the integrand at its lower end the ratio is 1 at the edge
        pull = float(curve.adhesion(np.array([a]))[0])
        depth = float(without(a)) - pull
        gap = curve.gaps(a, depth, radii)
        edge = curve.edge_gap(a, pull, radii)
        least = min(least, float((gap / edge).min()))
    return least


@pytest.mark.parametrize(
    "name", ["cosine", "cosine, turned at a depth", "two harmonics", "cosine, machine", "exponent 1.5", "cosine, load"]
)
def test_one_disc_against_the_gap_by_brute_force(name: str) -> None:
    kind = BY_NAME[name]
    scenes, found = drawn(kind)
    flagged = has(found, FLAGS["loading_contact_not_one_disc"])
    rng = rng_of(f"disc {name}")
    decided = {True: 0, False: 0}
    for flag in (True, False):
        for i in rng.permutation(np.flatnonzero((flagged == flag) & (scenes["A"] > 0) & (found["loading_jumps"] > 0)))[:6]:
            scene = {n: float(v[i]) for n, v in scenes.items()}
            if flag and touches_elsewhere(kind, scene):
                continue
            least = least_opening(kind, scene)
            if abs(least) > 2e-3:  # nearer, radii between those of the grid decide
                assert (least < 0) == flag, (least, flag, scene)
                decided[flag] += 1
    assert decided[True] > 1 or not flagged.any()
    assert decided[False] > 1


def touches_elsewhere(kind: Kind, scene: Scenes) -> bool:
    """Tell whether the punch is lower somewhere than at its centre, so that contact starts elsewhere."""
    r = np.linspace(0.0, scene["a_max_over_R"], 4000)
    height = r**kind.exponent / kind.exponent
    for n, even, odd in kind.waves:
        phase = 2 * np.pi * n * r / scene["lambda_over_R"]
        height = height + scene["lambda_over_R"] * scene["A"] * (even * (1 - np.cos(phase)) + odd * np.sin(phase))
    return bool(height.min() < 0)


def test_a_punch_that_touches_elsewhere_first_is_flagged() -> None:
    for name in ("sines, load", "no first harmonic"):
        kind = BY_NAME[name]
        scenes, found = drawn(kind)
        lower = np.array([touches_elsewhere(kind, {n: v[i] for n, v in scenes.items()}) for i in range(len(scenes["k"]))])
        assert lower.any()
        assert has(found, FLAGS["loading_contact_not_one_disc"])[lower].all()


def test_the_monotonic_profile_that_is_not_one_disc() -> None:
    """A monotonic profile is not sufficient where adhesion is weak: section 7 has the scene and its gap."""
    scene = {"k": 0.0, "nu": 0.3, "modulus": 1e7, "c0_over_R": 1.0, "lambda_over_R": 0.1, "a_max_over_R": 0.3}
    scene["A"] = 4.59 * 0.1 / (4 * np.pi**2)
    kind = BY_NAME["cosine"]
    found = kind.solve(scene)
    assert has(found, FLAGS["loading_contact_not_one_disc"])
    curve = Curve(kind, scene)
    depth = float(curve.depth(np.array([0.0511]))[0])
    assert float(curve.gaps(0.0511, depth, np.array([0.0811]))[0]) * 2 / np.pi == pytest.approx(-2.6e-4, rel=0.1)
