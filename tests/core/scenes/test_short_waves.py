"""The leading term of short waves: its own curve on a dense grid, and its corners.

Similarity, sums, neighbours and bad input of this solver are asserted in tests/conformance.
"""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, OUTPUTS, Profile, solve
from gradhesion.core.equations import short_waves
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from tests.core.draw.printed import curve_of
from tests.core.scene import Scene, adhesion, material_of, profile_of, scene_of_ratio
from tests.stress.draw import hostile

ONE, TWO = Profile(), profile_of(2.0, (1, 1.0, 0.0), (3, -0.1, 0.15))
SINE = profile_of(1.0, (1, 0.0, 1.0))


def asymptotic(scene: Scene, profile: Profile = ONE) -> dict[str, Any]:
    return solve(scene, OUTPUTS, solver="asymptotic", profile=profile)


def on_a_grid(scene: Scene, profile: Profile) -> dict[str, float]:
    """Values by running maxima and minima of (5.15), (5.16) at 200,000 radii."""
    k, M, rim, points = scene["k"], material_of(scene), scene["a_max_over_R"], 200_000
    t = np.arange(1, points + 1) / points
    a, da = rim * t**1.5, 1.5 * rim * np.sqrt(t) / points
    da[-1] /= 2
    depth, load = curve_of(scene, profile, short_waves)(a)
    pull = adhesion(k, M) * a ** ((1 - k) / 2)
    rising = np.flatnonzero(np.diff(depth) > 0)
    first = int(rising[0]) if rising.size else points - 1  # no equilibrium is stable before
    loading = np.maximum(0, np.maximum.accumulate(np.where(np.arange(points) < first, -np.inf, depth)))
    unloading = np.minimum.accumulate(depth[::-1])[::-1]
    lost = 2 * np.pi * a * (((depth + pull - unloading) / pull) ** 2 - ((depth + pull - loading) / pull) ** 2)
    found = {"pull_off_force": -load.min(), "pull_off_radius": a[load.argmin()], "delta_max": loading[-1]}
    return found | {"dissipated_energy": float(np.sum(lost * da)), "delta_jump_out": unloading[0]}


@pytest.mark.parametrize("seed", range(24))
def test_it_solves_its_own_curve(seed: int) -> None:
    """Of any exponent and chi; one cosine, or a series on any power."""
    rng = np.random.default_rng(seed)
    k, M = float(rng.choice([0.0, 0.22, 0.51, 0.87, 1.0])), 10 ** rng.uniform(0, 4)
    length = M ** (-1 / (3 + k))
    ratio, chi = 10 ** rng.uniform(-1.6, -0.2), 10 ** rng.uniform(-2.5, 0.6)
    scene = scene_of_ratio(k, M, ratio * length, chi, length * rng.uniform(0.9, 3.7))
    waves = (SINE if seed % 4 == 1 else TWO).harmonics
    profile = ONE if seed % 2 == 0 else Profile(exponent=float(rng.choice([1.0, 2.0, 3.7, 8.0])), harmonics=waves)
    found, expected = asymptotic(scene, profile), on_a_grid(scene, profile)
    assert not found["status"] & FAILED
    depth = max(abs(expected["delta_max"]), abs(expected["delta_jump_out"]), scene["a_max_over_R"] ** 2)
    for name, value in expected.items():
        rel = {"pull_off_radius": 1e-3, "dissipated_energy": 1e-4}.get(name, 1e-5)
        assert found[name] == pytest.approx(value, rel=rel, abs=3e-5 * depth if "delta" in name else 1e-5), name


@pytest.mark.parametrize("rim", [0.31, 1.9, math.inf])
def test_at_k_1_the_depth_is_exact_and_with_it_the_cycle(rim: float) -> None:
    scene = scene_of_ratio(1.0, 63.0, 0.043, 0.24, rim)
    exact, found = solve(scene, OUTPUTS), asymptotic(scene)
    for name in ("loading_jumps", "unloading_jumps", "dissipated_energy", "delta_max", "delta_jump_out"):
        assert found[name] == pytest.approx(exact[name], rel=0.0 if "jumps" in name else 1e-10), name


def test_a_long_jump_in_is_integrated_in_closed_form() -> None:
    """Hardly a wave: 40,000 of them within the jump-in, to the smooth punch by the size of the wave alone."""
    length = 150.0 ** (-1 / 3.37)
    scene = scene_of_ratio(0.37, 150.0, 5e-5 * length, 1e-9, 3.1 * length)
    found, smooth = asymptotic(scene), solve(scene | {"A": 0.0}, OUTPUTS)
    assert found["loading_jumps"] == 1
    for name in ("dissipated_energy", "pull_off_force"):
        assert found[name] == pytest.approx(smooth[name], rel=1e-8)
    for name, value in asymptotic(scene | {"A": 0.0}).items():
        assert value == pytest.approx(smooth[name], rel=1e-14), name


def test_more_than_a_million_waves_have_no_value_but_a_force_where_it_is_near() -> None:
    found = asymptotic(scene_of_ratio(0.2, 100.0, 1e-8, 0.4, 2.0))
    assert found["status"] == NO_VALUE | TOO_MANY_WAVES
    assert np.isnan(found["dissipated_energy"])
    assert found["loading_jumps"] == -1
    near = scene_of_ratio(0.2, 100.0, 2e-6, 0.4, 2.0)
    force = solve(near, ["pull_off_force"], solver="asymptotic")["pull_off_force"]
    assert force == pytest.approx(3.2 / 3 * 1.4**2, rel=1e-9)


def test_hostile_scenes_end_with_a_value_or_a_status() -> None:
    found = asymptotic(hostile(11, 300))
    good = (found["status"] & FAILED) == 0
    assert np.all(np.isfinite(found["pull_off_force"][good]))
    assert np.all(found["dissipated_energy"][good] >= 0)
    assert np.array_equal(np.isfinite(found["dissipated_energy"]), good)
    for chi in (0.5, 2.0, 6.0):  # the slope of a sine at its apex is steep: contact begins in a point
        steep = asymptotic(scene_of_ratio(0.4, 110.0, 0.02, chi, 0.97), profile_of(2.0, (1, 0.0, -1.0)))
        assert not steep["status"] & FAILED
        assert steep["dissipated_energy"] > 0.0
