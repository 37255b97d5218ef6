"""The envelopes against the loop integral of their load over depth, the numbers of the paper, and other theories."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import FAILED, OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.profile import swings
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.twin import stated
from gradhesion.twin.general import Shape

EPS = float(np.finfo(float).eps)
NU, C0 = 0.27, 0.13
EXPONENTS = [0.0, 0.2, 0.53, 0.9, 1.0 - 1e-9]
WAVES = ((1, 1.0, 0.1), (3, 0.2, -0.3), (4, 0.0, 0.2))
PROFILE = Profile(exponent=1.4, harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in WAVES))


def scene_of(k: float, M: float, wavelength: float, chi: float, a_max: float) -> dict[str, float]:
    """Return the parameters of a scene from its stiffness and chi."""
    nu = 0.5 if k == 1.0 else NU
    r_over_A = math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2)
    return {
        "k": k,
        "nu": nu,
        "modulus": M / float(stiffness(k, nu, 1.0, C0)),
        "c0_over_R": C0,
        "lambda_over_R": wavelength,
        "A": chi * math.sqrt(2 ** (1 + k) * math.pi / M) / r_over_A,
        "a_max_over_R": a_max,
    }


def envelope(scene: dict[str, float]) -> dict[str, NDArray[Any]]:
    return solve(scene, OUTPUTS, solver="envelope")


def length_of(k: float, M: float) -> float:
    return M ** (-1 / (3 + k))


def loop_integral(k: float, M: float, m: float, up: float, down: float, rim: float) -> float:
    """Integrate P d(delta) along envelopes that are off the mean by r_+ and r_-, and along the line at the rim.

    R = dgamma = 1, depths are counted from the mean surface, and the jumps are at their fixed depth.
    """
    k, c = mpmath.mpf(k), (1 - mpmath.mpf(k)) / 2
    K, s = 2 ** (1 - k) * M / (1 + k), mpmath.sqrt(2 ** (1 + k) * mpmath.pi / M)
    front = mpmath.beta(mpmath.mpf(m) / 2, (1 + k) / 2) / 2

    def depth(pull: Any, a: Any) -> Any:
        return front * a**m - pull * a**c

    def load(pull: Any, a: Any) -> Any:
        return K * a ** (1 + k) * (m / (1 + k + m) * front * a**m - pull * a**c)

    def work(pull: Any, first: Any, last: Any) -> Any:
        def rate(t: Any) -> Any:
            a = mpmath.exp(t)
            return load(pull, a) * (m * front * a**m - pull * c * a**c)

        return mpmath.quad(rate, mpmath.linspace(mpmath.log(first), mpmath.log(last), 9)) if last > first else 0

    rim, loading, unloading = mpmath.mpf(rim), s - up, s + down
    a_in = min(rim, (max(loading, mpmath.mpf(10) ** -30) / front) ** (1 / (m - c)))
    a_out = min(rim, (c * unloading / (m * front)) ** (1 / (m - c)))
    drop = max(0, depth(loading, rim)) - depth(unloading, rim)
    pinned = drop * load(unloading, rim) + K * rim ** (1 + k) * drop**2 / 2
    return float(work(loading, a_in, rim) - pinned - work(unloading, a_out, rim))


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("chi", [0.031, 0.72, 1.0, 2.6])
@pytest.mark.parametrize("reach", [0.21, 0.9, 1.63, 5.8])
def test_the_energy_is_the_loop_integral_of_load_over_depth(k: float, chi: float, reach: float) -> None:
    M, rim = 37.0, reach * length_of(k, 37.0)
    scene = scene_of(k, M, 0.0023, chi, rim)
    one = chi * math.sqrt(2 ** (1 + k) * math.pi / M)
    with mpmath.workdps(20):
        expected = loop_integral(k, M, 2.0, one, one, rim)
    assert envelope(scene)["dissipated_energy"] == pytest.approx(expected, rel=400 * EPS)
    up, down = (one * swing for swing in swings(k, WAVES))
    with mpmath.workdps(20):
        expected = loop_integral(k, M, 1.4, up, down, rim)
    found = solve(scene, ["dissipated_energy"], solver="envelope", profile=PROFILE)["dissipated_energy"]
    assert found == pytest.approx(expected, rel=2000 * EPS)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("reach", [0.003, 0.4, 1.1, 2.9, math.inf])
def test_without_waviness_it_is_the_smooth_punch(k: float, reach: float) -> None:
    scene = scene_of(k, 51.0, 0.017, 0.0, reach * length_of(k, 51.0))
    exact = solve(scene, OUTPUTS)
    exact["status"] &= FAILED  # what the rim decides the exact solver alone tells
    for name, value in envelope(scene).items():
        # an energy of the size of all losses; a radius where a function is stationary
        size = float(exact["dissipated_energy"]) if name.endswith("_energy") else 0.0
        rel = 2e-13 if name == "pull_off_radius" else 50 * EPS
        assert value == pytest.approx(exact[name], rel=rel, abs=1e-17 + 4e-14 * size), name


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("chi", [0.0, 0.23, 1.0, 3.1])
def test_the_pull_off_force_is_that_of_a_smooth_punch_of_greater_adhesion(k: float, chi: float) -> None:
    M, wavelength = 410.0, 0.0019
    result = envelope(scene_of(k, M, wavelength, chi, math.inf))
    assert result["pull_off_force"] == pytest.approx((3 + k) / 3 * (1 + chi) ** 2, rel=20 * EPS)
    s = math.sqrt(2 ** (1 + k) * math.pi / M)
    a = float(result["pull_off_radius"])
    assert a ** ((3 + k) / 2) == pytest.approx((1 + k) * (3 + k) / 4 * s * (1 + chi), rel=50 * EPS)
    # a rim within that radius: the load of the envelope there, and continuous
    rim = 0.77 * a
    K = 2 ** (1 - k) * M / (1 + k)
    load = K * (2 * rim ** (3 + k) / ((1 + k) * (3 + k)) - s * (1 + chi) * rim ** ((3 + k) / 2))
    at_rim = envelope(scene_of(k, M, wavelength, chi, rim))
    assert at_rim["pull_off_force"] == pytest.approx(-load / (1.5 * math.pi), rel=100 * EPS)
    assert at_rim["pull_off_radius"] == rim
    near = envelope(scene_of(k, M, wavelength, chi, a * (1 - 1e-9)))
    assert near["pull_off_force"] == pytest.approx(result["pull_off_force"], rel=100 * EPS)


@pytest.mark.parametrize(
    ("k", "f0", "f1"), [(0.0, 7.092, 29.629), (0.2, 8.863, 25.241), (0.5, 11.317, 19.465), (0.9, 14.188, 13.692)]
)
def test_a_small_wave_gives_the_paper_s_two_functions(k: float, f0: float, f1: float) -> None:
    # (5.43) at a_max = a_2, where C2 = 0; M = 1, so that L = R
    wavelength = 0.011
    chis = np.array([0.0, 1e-5, 2e-5])
    energies, amplitudes = [], []
    for chi in chis:
        a_2 = ((1 + k) * math.sqrt(2 ** (1 + k) * math.pi) * (1 - chi)) ** (2 / (3 + k))
        scene = scene_of(k, 1.0, wavelength, chi, a_2)
        energies.append(float(envelope(scene)["dissipated_energy"]))
        amplitudes.append(scene["A"])
    assert energies[0] == pytest.approx(f0, abs=6e-4)
    slope = (4 * energies[1] - energies[2] - 3 * energies[0]) / (2 * amplitudes[1])
    assert slope / wavelength ** ((1 + k) / 2) == pytest.approx(f1, abs=6e-4)


@pytest.mark.parametrize("k", [0.0, 0.41, 0.83])
@pytest.mark.parametrize("chi", [0.3, 0.8])
def test_beyond_the_jump_in_each_area_loses_the_same(k: float, chi: float) -> None:
    M, wavelength = 230.0, 3e-4
    a, b = 2.6 * length_of(k, M), 7.3 * length_of(k, M)
    losses = [float(envelope(scene_of(k, M, wavelength, chi, rim))["dissipated_energy"]) for rim in (a, b)]
    assert losses[1] - losses[0] == pytest.approx(4 * math.pi * chi * (b * b - a * a), rel=1e-13)
    scene = scene_of(k, M, wavelength, chi, a)
    r_per_A = math.gamma((1 + k) / 2) * math.sqrt(
        2 ** (3 - k) * math.pi ** (2 - k) * wavelength ** (1 + k) * M
    )  # C2 of (5.39)
    assert losses[1] - losses[0] == pytest.approx(scene["A"] * r_per_A * (b * b - a * a), rel=1e-13)


def test_the_energy_of_an_unbounded_punch_is_infinite_with_waviness_alone() -> None:
    result = envelope(scene_of(0.37, 90.0, 0.01, 0.2, math.inf))
    assert result["dissipated_energy"] == math.inf
    assert result["delta_max"] == math.inf
    assert result["status"] == 0
    assert np.isfinite(result["pull_off_force"])
    assert np.isfinite(envelope(scene_of(0.37, 90.0, 0.01, 0.0, math.inf))["dissipated_energy"])


def test_depths_gain_the_mean_height_of_the_wave() -> None:
    k, M, chi, rim = 0.43, 77.0, 0.21, 2.1
    scene = scene_of(k, M, 0.013, chi, rim)
    s = math.sqrt(2 ** (1 + k) * math.pi / M)
    result = envelope(scene)
    depth = rim**2 / (1 + k) - s * (1 - chi) * rim ** ((1 - k) / 2)
    assert result["delta_max"] == pytest.approx(depth + scene["A"] * 0.013, rel=20 * EPS)
    a_4 = ((1 - k * k) / 4 * s * (1 + chi)) ** (2 / (3 + k))
    depth = a_4**2 / (1 + k) - s * (1 + chi) * a_4 ** ((1 - k) / 2)
    assert result["delta_jump_out"] == pytest.approx(depth + scene["A"] * 0.013, rel=20 * EPS)


def test_jumps_are_those_of_the_envelopes_themselves() -> None:
    for k, chi, expected in [(0.2, 0.9, (1, 1)), (0.2, 1.1, (0, 1)), (1.0, 0.9, (1, 0)), (1.0, 1.0, (0, 0))]:
        result = envelope(scene_of(k, 33.0, 0.004, chi, 1.3))
        assert (int(result["loading_jumps"]), int(result["unloading_jumps"])) == expected


def test_the_force_rises_with_the_rim_and_the_energy_is_never_negative() -> None:
    rng = np.random.default_rng(7)
    k = rng.choice([0.0, 0.31, 0.74, 1.0], size=500)
    for exponent, M, chi in zip(k, 10 ** rng.uniform(-4, 8, 500), 10 ** rng.uniform(-6, 3, 500), strict=True):
        scene: dict[str, Any] = scene_of(float(exponent), float(M), 0.01, float(chi), 1.0)
        scene["a_max_over_R"] = np.geomspace(1e-9, 1e6, 60) * length_of(float(exponent), float(M))
        result = envelope(scene)
        assert np.all(np.diff(result["pull_off_force"]) >= -8 * EPS * result["pull_off_force"][1:])
        assert np.all(result["dissipated_energy"] >= 0)
        assert not result["status"].any()


def test_what_is_out_of_range_has_no_value() -> None:
    good = scene_of(0.4, 60.0, 0.02, 0.1, 1.0)
    for change in [{"A": -0.1}, {"lambda_over_R": 0.0}, {"a_max_over_R": 0.0}, {"modulus": math.nan}, {"nu": 0.6}]:
        result = envelope(good | change)
        assert result["status"] == 64, change
        assert np.isnan(result["pull_off_force"])
        assert result["loading_jumps"] == -1


def _draw(count: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(8)
    k = rng.choice([0.0, 1e-7, 0.23, 0.71, 1.0], count)
    return {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, 0.27),
        "modulus": 10.0 ** rng.uniform(1.0, 4.0, count),
        "c0_over_R": 10.0 ** rng.uniform(-2.0, 0.0, count),
        "lambda_over_R": 10.0 ** rng.uniform(-4.0, -1.0, count),
        "A": np.where(rng.random(count) < 0.1, 0.0, 10.0 ** rng.uniform(-4.0, 0.0, count)),
        "a_max_over_R": np.where(rng.random(count) < 0.1, np.inf, 10.0 ** rng.uniform(-2.0, 0.5, count)),
    }


def test_the_twin_has_the_same_envelopes() -> None:
    scenes = _draw(40)
    values = solve(scenes, OUTPUTS, solver="envelope", profile=PROFILE)
    for i in range(40):
        scene = {name: float(column[i]) for name, column in scenes.items()}
        for name, one in stated.expected(scene, OUTPUTS, "envelope", Shape(1.4, WAVES)).items():
            assert stated.deviation(float(values[name][i]), one) <= one.error, name


@pytest.mark.parametrize("k", [0.0, 0.6])
@pytest.mark.parametrize("waves", [((1, 0.0, 0.5),), ((1, 0.6, 0.1), (3, -0.4, -0.3), (4, -0.2, 0.2))])
def test_the_exact_solution_tends_to_the_envelopes(k: float, waves: tuple[tuple[int, float, float], ...]) -> None:
    """Waves of no mean height, which the energy of the envelopes leaves out; one harmonic's crest moves, but keeps its height."""
    profile = Profile(exponent=2.5, harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in waves))
    wavelength = np.array([4e-3, 1e-3])
    scene = {"k": k, "nu": 0.2, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": wavelength, "a_max_over_R": 0.6}
    scene["A"] = 0.02 * (4e-3 / wavelength) ** (0.5 * (1.0 + k))
    exact, limit = (solve(scene, OUTPUTS, profile=profile, solver=solver) for solver in ("exact", "envelope"))
    force = np.abs(exact["pull_off_force"] / limit["pull_off_force"] - 1.0)
    assert np.all(force <= (10.0 * wavelength**2 if len(waves) == 1 else 0.05 * wavelength))
    energy = np.abs(exact["dissipated_energy"] / limit["dissipated_energy"] - 1.0)
    assert np.all((energy > 0.0) & (energy <= 30.0 * wavelength))
    assert np.all(np.abs(exact["delta_max"] - limit["delta_max"]) < 1.2 * wavelength)


def test_what_has_no_envelopes_is_refused() -> None:
    scene = {name: column[0] for name, column in _draw(1).items()}
    with pytest.raises(ValueError, match="displacement control only: the path along the envelopes jumps"):
        solve(scene, profile=PROFILE, loading=Loading(control="load"), solver="envelope")
    bad = solve({**scene, "A": [-1.0, np.nan, 0.1], "k": 0.2}, OUTPUTS, profile=PROFILE, solver="envelope")
    assert (bad["status"] == NO_VALUE).tolist() == [True, True, False]
    assert all(np.isnan(bad[name][:2]).all() or (bad[name][:2] == -1).all() for name in OUTPUTS)
    endless = solve(scene | {"k": 0.2, "A": 0.1, "a_max_over_R": np.inf}, OUTPUTS, profile=PROFILE, solver="envelope")
    assert [float(endless[name]) for name in ("dissipated_energy", "delta_max")] == [math.inf, math.inf]
