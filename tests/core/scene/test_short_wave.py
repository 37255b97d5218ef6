"""The leading term of a short wave against its own curve on a dense grid, and against the exact solution it tends to."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import FAILED, OUTPUTS, Harmonic, Profile, solve
from gradhesion.core.equations import short_waves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES

NU, C0 = 0.23, 0.17
Scene = dict[str, float]


def r_per_amplitude(k: float, wavelength: float) -> float:
    return math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2)


def stretch_of(k: float, M: float) -> float:
    return math.sqrt(2 ** (1 + k) * math.pi / M)


def scene_of(k: float, M: float, wavelength: float, chi: float, a_max: float) -> Scene:
    """Return the parameters of a scene from its stiffness and chi."""
    nu = 0.5 if k == 1.0 else NU
    return {
        "k": k,
        "nu": nu,
        "modulus": M / float(stiffness(k, nu, 1.0, C0)),
        "c0_over_R": C0,
        "lambda_over_R": wavelength,
        "A": chi * stretch_of(k, M) / r_per_amplitude(k, wavelength),
        "a_max_over_R": a_max,
    }


def asymptotic(scene: Any) -> dict[str, NDArray[Any]]:
    return solve(scene, OUTPUTS, solver="asymptotic")


def on_a_grid(k: float, M: float, wavelength: float, chi: float, rim: float) -> tuple[float, float, float, float]:
    """Return force, energy, delta_max and delta_jump_out from running maxima and minima of (5.15)-(5.20)."""
    s, c, points = stretch_of(k, M), (1 - k) / 2, 200_000
    t = np.arange(1, points + 1) / points
    a, da = rim * t**1.5, 1.5 * rim * np.sqrt(t) / points
    da[-1] /= 2
    sine = np.sin(2 * np.pi * a / wavelength - (1 + k) * np.pi / 4)
    stretch = s * a**c
    far = a**2 / (1 + k) + wavelength * chi * s / r_per_amplitude(k, wavelength) + chi * stretch * sine
    depth = far - stretch
    load = (
        2 ** (1 - k)
        * M
        / (1 + k)
        * (2 * a ** (3 + k) / ((1 + k) * (3 + k)) - s * (1 - chi * sine) * a ** ((3 + k) / 2))
    )
    rising = np.flatnonzero(np.diff(depth) > 0)
    first = int(rising[0]) if rising.size else points - 1  # no equilibrium is stable before
    loading = np.maximum(0, np.maximum.accumulate(np.where(np.arange(points) < first, -np.inf, depth)))
    unloading = np.minimum.accumulate(depth[::-1])[::-1]
    lost = 2 * np.pi * a * (((far - unloading) / stretch) ** 2 - ((far - loading) / stretch) ** 2)
    return -load.min() / (1.5 * math.pi), float(np.sum(lost * da)), loading[-1], unloading[0]


@pytest.mark.parametrize("k", [0.0, 0.22, 0.51, 0.87, 1.0])
def test_it_solves_its_own_curve(k: float) -> None:
    rng = np.random.default_rng(round(100 * k))
    for _ in range(12):
        M = 10 ** rng.uniform(0, 4)
        length = M ** (-1 / (3 + k))
        wavelength, chi = length * 10 ** rng.uniform(-1.6, -0.2), 10 ** rng.uniform(-2.5, 0.6)
        rim = length * rng.uniform(0.9, 3.7)
        result = asymptotic(scene_of(k, M, wavelength, chi, rim))
        force, energy, deepest, last = on_a_grid(k, M, wavelength, chi, rim)
        assert not result["status"] & FAILED
        assert result["pull_off_force"] == pytest.approx(force, rel=1e-5)
        assert result["dissipated_energy"] == pytest.approx(energy, rel=1e-5)
        assert result["delta_max"] == pytest.approx(deepest, abs=3e-5 * length**2)
        assert result["delta_jump_out"] == pytest.approx(last, abs=3e-5 * length**2)


@pytest.mark.parametrize("k", [0.0, 0.33, 0.68])
@pytest.mark.parametrize("chi", [0.21, 1.4])
def test_it_tends_to_the_exact_solution(k: float, chi: float) -> None:
    wavelengths = [0.08, 0.008, 0.0008]
    errors = []
    for wavelength in wavelengths:
        scene = scene_of(k, 110.0, wavelength, chi, 0.97)
        exact, result = solve(scene, OUTPUTS), asymptotic(scene)
        errors.append([abs(float(result[name] / exact[name] - 1)) for name in ("pull_off_force", "dissipated_energy")])
    force, energy = np.array(errors).T
    assert np.all(force <= 0.2 * np.array(wavelengths))
    assert np.all(energy <= 0.05 * np.array(wavelengths))
    assert np.all(energy[1:] < 0.07 * energy[:-1])


def test_it_is_far_better_than_the_envelopes() -> None:
    scene = scene_of(0.3, 110.0, 0.01, 0.4, 0.97)
    exact, result, envelope = (
        float(solve(scene, ["dissipated_energy"], solver=solver)["dissipated_energy"])
        for solver in ("exact", "asymptotic", "envelope")
    )
    assert 100 * abs(result - exact) < abs(envelope - exact)


@pytest.mark.parametrize("rim", [0.31, 0.77, 1.9, math.inf])
def test_at_k_1_the_depth_is_exact_and_with_it_the_cycle(rim: float) -> None:
    scene = scene_of(1.0, 63.0, 0.043, 0.24, rim)
    exact, result = solve(scene, OUTPUTS), asymptotic(scene)
    assert result["loading_jumps"] == exact["loading_jumps"]
    assert result["unloading_jumps"] == exact["unloading_jumps"]
    assert result["dissipated_energy"] == pytest.approx(exact["dissipated_energy"], rel=1e-10)
    assert result["delta_max"] == pytest.approx(exact["delta_max"], rel=1e-12)
    assert result["delta_jump_out"] == pytest.approx(exact["delta_jump_out"], rel=1e-12)


@pytest.mark.parametrize("wavelength", [0.021, 1e-6])
def test_several_rims_are_as_one_by_one(wavelength: float) -> None:
    # of the short waves, only the first two rims have few enough
    scene: Any = scene_of(0.42, 210.0, wavelength, 0.37, 1.0)
    rims = np.array([0.07, 0.31, 0.9, math.inf])
    together = asymptotic(scene | {"a_max_over_R": rims})
    for i, rim in enumerate(rims):
        for name, value in asymptotic(scene | {"a_max_over_R": rim}).items():
            np.testing.assert_array_equal(value, together[name][i], err_msg=name)


def test_a_long_jump_in_is_integrated_in_closed_form() -> None:
    # hardly a wave: 40,000 of them within the jump-in, to the smooth punch by the size of the wave alone
    k, M = 0.37, 150.0
    length = M ** (-1 / (3 + k))
    wavelength = 5e-5 * length
    scene = scene_of(k, M, wavelength, 1e-9, 3.1 * length)
    result, smooth = asymptotic(scene), solve(scene | {"A": 0.0}, OUTPUTS)
    assert result["loading_jumps"] == 1
    assert result["dissipated_energy"] == pytest.approx(smooth["dissipated_energy"], rel=1e-8)
    assert result["pull_off_force"] == pytest.approx(smooth["pull_off_force"], rel=1e-8)


def test_more_than_a_million_waves_have_no_value() -> None:
    result = asymptotic(scene_of(0.2, 100.0, 1e-8, 0.4, 2.0))
    assert result["status"] == NO_VALUE | TOO_MANY_WAVES
    assert np.isnan(result["dissipated_energy"])
    assert result["loading_jumps"] == -1
    k, chi = 0.2, 0.4
    result = solve(scene_of(k, 100.0, 2e-6, chi, 2.0), ["pull_off_force"], solver="asymptotic")
    assert result["pull_off_force"] == pytest.approx((3 + k) / 3 * (1 + chi) ** 2, rel=1e-9)


def test_without_waviness_it_is_the_smooth_punch() -> None:
    scene = scene_of(0.6, 77.0, 0.03, 0.0, 1.3)
    exact = solve(scene, OUTPUTS)
    for name, value in asymptotic(scene).items():
        assert value == pytest.approx(exact[name], rel=1e-14), name


def test_hostile_scenes_end_with_a_value_or_a_status() -> None:
    rng, n = np.random.default_rng(11), 300
    k = rng.choice([0.0, 1e-16, 0.3, 0.9, 1 - 1e-12, 1.0], n)
    result = asymptotic(
        {
            "k": k,
            "nu": np.where(k == 1, 0.5, rng.uniform(-0.99, 0.5, n)),
            "modulus": 10 ** rng.uniform(-9, 15, n),
            "c0_over_R": 10 ** rng.uniform(-12, 9, n),
            "lambda_over_R": 10 ** rng.uniform(-12, 6, n),
            "A": np.where(rng.random(n) < 0.1, 0.0, 10 ** rng.uniform(-300, 3, n)),
            "a_max_over_R": np.where(rng.random(n) < 0.1, math.inf, 10 ** rng.uniform(-12, 9, n)),
        }
    )
    good = (result["status"] & FAILED) == 0
    assert np.all(np.isfinite(result["pull_off_force"][good]))
    assert np.all(result["dissipated_energy"][good] >= 0)
    assert np.all(np.isfinite(result["dissipated_energy"][good]))
    assert np.all(np.isnan(result["dissipated_energy"][~good]))


TWO = Profile(harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=-0.1, sin=0.15)))
SINE = Profile(exponent=1.0, harmonics=(Harmonic(n=1, sin=1.0),))


def test_one_cosine_is_a_series_of_one() -> None:
    """However it is named: as three waves in a wavelength three times as long, and with a harmonic of no amplitude."""
    scene = scene_of(0.37, 110.0, 0.05, 0.4, 0.97)
    expected = asymptotic(scene)
    third = Profile(harmonics=(Harmonic(n=3, cos=2.0),))
    named = scene | {"lambda_over_R": 3 * scene["lambda_over_R"], "A": scene["A"] / 6}
    for found in (
        solve(named, OUTPUTS, solver="asymptotic", profile=third),
        solve(scene, OUTPUTS, solver="asymptotic", profile=Profile(harmonics=(Harmonic(n=1), Harmonic(n=2, cos=0.0)))),
        solve(
            scene, OUTPUTS, solver="asymptotic", profile=Profile(harmonics=(Harmonic(n=1), Harmonic(n=5, sin=1e-18)))
        ),
    ):
        for name, value in expected.items():
            assert found[name] == pytest.approx(value, rel=1e-12), name


@pytest.mark.parametrize("k", [0.0, 0.51, 1.0])
@pytest.mark.parametrize(("waves", "exponent"), [(TWO, 1.0), (TWO, 2.0), (TWO, 3.7), (TWO, 8.0), (SINE, 1.0)])
def test_any_punch_solves_its_own_curve(k: float, waves: Profile, exponent: float) -> None:
    """Running maxima and minima of (5.15), (5.16) on a dense grid."""
    profile = Profile(exponent=exponent, harmonics=waves.harmonics)
    M, wavelength, rim, points = 110.0, 0.06, 0.97, 100_000
    scene = scene_of(k, M, wavelength, 0.4, rim)
    s, c = stretch_of(k, M), (1 - k) / 2
    count = max(one.n for one in profile.harmonics)
    cosines, sines = np.zeros(count), np.zeros(count)
    for one in profile.harmonics:
        cosines[one.n - 1], sines[one.n - 1] = -scene["A"] * one.cos, scene["A"] * one.sin
    t = np.arange(1, points + 1) / points
    a, da = rim * t**1.5, 1.5 * rim * np.sqrt(t) / points
    da[-1] /= 2
    waves_of = (wavelength, cosines.tolist(), sines.tolist())
    depth = short_waves.indentation(k, M, a, *waves_of, exponent=exponent)
    load = short_waves.load(k, M, a, *waves_of, exponent=exponent)
    far = depth + s * a**c
    rising = np.flatnonzero(np.diff(depth) > 0)
    loading = np.maximum(0, np.maximum.accumulate(np.where(np.arange(points) < rising[0], -np.inf, depth)))
    unloading = np.minimum.accumulate(depth[::-1])[::-1]
    lost = 2 * np.pi * a * (((far - unloading) / (s * a**c)) ** 2 - ((far - loading) / (s * a**c)) ** 2)
    result = solve(scene, OUTPUTS, solver="asymptotic", profile=profile)
    assert not result["status"] & FAILED
    assert result["pull_off_force"] == pytest.approx(-load.min(), rel=1e-5)
    assert result["pull_off_radius"] == pytest.approx(a[load.argmin()], rel=1e-3)
    assert result["dissipated_energy"] == pytest.approx(np.sum(lost * da), rel=1e-4)
    assert result["loading_energy"] + result["unloading_energy"] == pytest.approx(
        result["dissipated_energy"], rel=1e-12
    )
    assert result["delta_max"] == pytest.approx(loading[-1], abs=1e-5)
    assert result["delta_jump_out"] == pytest.approx(unloading[0], abs=1e-5)


@pytest.mark.parametrize(("profile", "k"), [(TWO, 0.3), (TWO, 0.0), (SINE, 0.68), (Profile(exponent=4.0), 0.2)])
def test_any_punch_tends_to_the_exact_solution(profile: Profile, k: float) -> None:
    """The error falls at least as the wavelength: the leading term of the depth is off by lambda/a of its waves."""
    wavelengths, errors = [0.016, 0.004, 0.001], []
    for wavelength in wavelengths:
        scene = scene_of(k, 110.0, wavelength, 0.3, 0.97)
        exact, result = (solve(scene, OUTPUTS, solver=one, profile=profile) for one in ("exact", "asymptotic"))
        errors.append([abs(float(result[name] / exact[name] - 1)) for name in ("pull_off_force", "dissipated_energy")])
        assert abs(result["delta_max"] - exact["delta_max"]) <= 0.1 * wavelength**1.5
    force, energy = np.array(errors).T
    assert np.all(force <= 0.2 * np.array(wavelengths))
    assert np.all(energy <= 0.2 * np.array(wavelengths))
    assert energy[2] < 0.1 * energy[0]


def test_a_contact_may_begin_in_a_point() -> None:
    """Where the slope of a sine at its apex is steep: the depth rises from that of a point on."""
    profile = Profile(harmonics=(Harmonic(n=1, sin=-1.0),))
    for chi in (0.5, 2.0, 6.0):
        result = solve(scene_of(0.4, 110.0, 0.02, chi, 0.97), OUTPUTS, solver="asymptotic", profile=profile)
        assert not result["status"] & FAILED
        assert result["dissipated_energy"] > 0.0
