"""Hundreds to a million waves, which are summed, against those that are walked, the twin and similarity; and the leading term of short waves.

Neighbours, drawn jumps, saturation and turns of long curves, similarity, sums and bad input are in tests/conformance.
"""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, OUTPUTS, Loading, Profile, solve
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
DEPTHS = ("delta_max", "delta_jump_out", "turning_radius", "snap_in_force")
CONTROLS: dict[str, dict[str, float]] = {"displacement": {}, "load": {}, "machine": {"machine_stiffness": 0.4}}
PROFILES = {
    "one cosine": Profile(),
    "asymmetric": profile_of(2.0, (1, 1.0, 0.3), (2, 0.4, -0.2)),
    "steep between": profile_of(2.0, (1, 0.2, 0.0), (4, 0.5, 0.2)),
    "exponent 1.5": Profile(exponent=1.5),
    "cubic": profile_of(3.0, (1, 1.0, 0.0), (3, 0.2, 0.2)),
}


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


def scenes(waves: Any, A: Any = 0.02) -> dict[str, Any]:
    """Scenes whose rim, at 0.6 R, has that many waves."""
    return scene_of(0.3, 0.3, 500.0, 0.1, 0.6 / np.asarray(waves, dtype=float), A, 0.6)


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_summed_waves_lose_what_walked_ones_do(profile: Profile, control: str) -> None:
    """The loop integral is known of walked waves alone: where it is asked for, nothing is summed up to 2,000 waves."""
    scene = scenes([650.3, 1171.9, 1702.6], A=np.array([0.006, 0.02, 0.06])[:, None]) | CONTROLS[control]
    names, how = (*RESULTS, *DEPTHS), {"profile": profile, "loading": Loading(control=control)}
    summed = solve(scene, [*names, *COUNTS], **how)
    if control == "load":  # which has no loop: a limit of machines
        scene, how = scene | {"machine_stiffness": 1e-13}, {"profile": profile, "loading": Loading(control="machine")}
        names = ("pull_off_force", "pull_off_radius", "loading_energy", "delta_max", "turning_radius")
    walked = solve(scene, [*names, *COUNTS, "energy_residual"], **how)
    assert np.isfinite(walked["energy_residual"]).all()
    for name in COUNTS:
        np.testing.assert_array_equal(summed[name], walked[name], name)
    size = np.abs(summed["loading_energy"]) + np.abs(summed["unloading_energy"])
    for name in names:
        scale = size if "energy" in name else np.abs(summed[name]) + (1e-3 if "delta" in name else 0.0)
        np.testing.assert_array_less(np.abs(summed[name] - walked[name]), 2e-12 * scale, name)


def test_what_is_not_known_of_long_curves() -> None:
    """No loop integral of what is not walked, and no value beyond a million waves."""
    loop = solve(scenes(2500.0), ["energy_residual", "dissipated_energy"])
    assert np.isnan(loop["energy_residual"])
    assert loop["dissipated_energy"] > 0.0
    found = solve(scenes([0.9e6, 1.2e6]), [*RESULTS, *COUNTS])
    assert np.isnan(found["dissipated_energy"]).tolist() == [False, True]
    assert found["loading_jumps"][1] == -1
    np.testing.assert_array_equal(found["status"] & (NO_VALUE | TOO_MANY_WAVES), [0, NO_VALUE | TOO_MANY_WAVES])


PAIR: Waves = ((1, 0.6, -0.3), (2, -0.2, 0.25))
SIMILAR = [
    # unloading ends between neighbours that are level to rounding
    (0.3, 2.0, PAIR, "displacement", 2.6e4, 3.0, 1e-3, {}),
    (0.0, 2.0, ((1, 0.0, 1.0),), "displacement", 4.3e5, 2.0, 0.1, {}),
    (0.5, 3.0, PAIR, "machine", 7.1e5, 5.0, 0.02, {"machine_stiffness": 0.3}),
    (0.8, 1.0, PAIR, "load", 9.9e4, 4.0, 0.3, {}),
    # k = 1: the waves next to zero contact are level, and unloading passes them
    (1.0, 2.0, PAIR, "displacement", 5.3e5, 5.8, 0.016, {}),
    (1.0, 2.0, PAIR, "machine", 3.6e4, 6.0, 2.4e-4, {"machine_stiffness": 0.0038}),
    # loading jumps in where many waves end at the depth 0
    (0.9, 2.0, ((1, -1.0, 0.0),), "displacement", 33910.125, 2.8, 1.2, {}),
]


@pytest.mark.slow
@pytest.mark.parametrize("case", SIMILAR)
def test_similar_scenes(case: tuple[float, float, Waves, str, float, float, float, dict[str, float]]) -> None:
    """Lengths differ by 5/4: coordinates round anew while the phase at the rim is the same double."""
    k, m, waves, control, count, ratio, chi, extra = case
    nu, c0, factor = 0.5 if k == 1.0 else 0.2, 0.1, 1.25
    wavelength = 2.0 ** round(math.log2(1e-3 / count))
    length = count * wavelength / ratio
    modulus = length ** (1.0 - 2.0 * m - k) / float(stiffness(k, nu, 1.0, c0))
    material = (k, nu, modulus, c0, wavelength)
    scene = scene_of(*material, float(amplitude_of_ratio(*material, chi)), count * wavelength, **extra)
    powers = {"modulus": 1.0 - 2.0 * m - k, "lambda_over_R": 1.0, "a_max_over_R": 1.0, "A": m - 1.0}
    powers["machine_stiffness"] = 1.0 + k
    both = {name: value * factor ** (powers.get(name, 0.0) * np.arange(2)) for name, value in scene.items()}
    how: dict[str, Any] = {"profile": profile_of(m, *waves), "loading": Loading(control=control)}
    found = solve(both, PARTS, check_contact=False, **how)
    assert not (found["status"] & FAILED).any()
    size = sum(abs(found[name][0]) for name in PARTS)
    for name in PARTS:
        assert abs(found[name][0] - found[name][1] / factor**2) <= 1e-12 * (count / 1000.0) * size


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
