"""Long curves against similarity and the printed equation, and the leading term of short waves.

Sums over waves against those that are walked, neighbours, drawn jumps, saturation and turns are in tests/conformance.
"""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, OUTPUTS, Profile, solve
from gradhesion.core.closed.reduced import amplitude_of_ratio
from gradhesion.core.equations import short_waves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from tests.core.scene import Scene, Waves, adhesion, curve_of, material_of, profile_of, scene_of, scene_of_ratio
from tests.stress.draw import hostile

ONE, TWO = Profile(), profile_of(2.0, (1, 1.0, 0.0), (3, -0.1, 0.15))
SINE = profile_of(1.0, (1, 0.0, 1.0))
PARTS = ("loading_energy", "unloading_energy")
COUNTS = ("loading_jumps", "unloading_jumps")
RESULTS = ("pull_off_force", "pull_off_radius", "dissipated_energy", *PARTS)


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
    """Nor is a loop integral known of more than 2,000 waves, which are not walked."""
    beyond = [asymptotic(scene_of_ratio(0.2, 100.0, 1e-8, 0.4, 2.0))]
    scene = scene_of(0.3, 0.3, 500.0, 0.1, 0.6 / np.array([2500.0, 0.9e6, 1.2e6]), 0.02, 0.6)
    found = solve(scene, [*OUTPUTS, "energy_residual"])
    assert np.isnan(found["energy_residual"]).all()
    assert np.isnan(found["dissipated_energy"]).tolist() == [False, False, True]
    assert not (found["status"][:2] & FAILED).any()
    for values in (*beyond, {name: row[2] for name, row in found.items()}):
        assert values["status"] & (NO_VALUE | TOO_MANY_WAVES) == NO_VALUE | TOO_MANY_WAVES
        assert np.isnan(values["dissipated_energy"])
        assert values["loading_jumps"] == -1
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


PAIR: Waves = ((1, 0.6, -0.3), (2, -0.2, 0.25))
SHAPES = {
    "one cosine": (Profile(), 330.7),
    "sine": (profile_of(2.0, (1, 0.0, 1.0)), 4.1e3),
    "negative": (profile_of(2.0, (1, -1.0, 0.0)), 6.3e4),
    "two harmonics": (profile_of(2.0, *PAIR), 4.9e5),
    "exponent 5": (profile_of(5.0, (1, 0.8, 0.6)), 4.1e3),
    "cone": (profile_of(1.0, (2, 0.3, 0.4)), 6.3e4),
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("ratio", [0.05, 30.0])
def test_the_lowest_load_is_that_of_the_printed_equation(name: str, ratio: float) -> None:
    """At the rim, and about the lowest trough, wherever the phase is; the rim is `ratio` lengths of similarity."""
    (profile, waves), rim, c0 = SHAPES[name], 0.3, 0.1
    rng = np.random.default_rng(int(waves) % 1000)
    chi, k = 10.0 ** rng.uniform(-2.0, 0.3), float(rng.choice([0.0, 0.3, 0.8, 1.0]))
    nu, M = 0.5 if k == 1.0 else 0.3, (rim / ratio) ** (1.0 - 2.0 * profile.exponent - k)
    material = (k, nu, M / float(stiffness(k, nu, 1.0, c0)), c0, rim / waves)
    scene = scene_of(*material, float(amplitude_of_ratio(*material, chi)), rim)
    force, radius = (float(one) for one in list(solve(scene, RESULTS[:2], profile=profile).values())[:2])
    assert (radius > 0.99 * rim) == (ratio < 1.0)
    curve, allowed = curve_of(scene, profile), 1e-12 * max(1.0, waves / 1000.0) * force
    assert abs(force + float(curve(radius)[1])) <= allowed, scene
    for share in (0.8, 1.0, 1.25):  # within a wave, and some waves away
        around = share * radius + rim / waves * np.linspace(-1.0, 1.0, 2001)
        _, loads = curve(around[around <= rim])
        assert loads.size == 0 or -loads.min() <= force + 10.0 * allowed
