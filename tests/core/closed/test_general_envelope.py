"""The envelopes of any profile: one cosine, the loop integral of the load, the exact solver for short waves, extrema."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.equations import envelopes
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.shape import swings
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.twin import stated
from gradhesion.twin.general import Shape

EPS = float(np.finfo(float).eps)
WAVES = ((1, 1.0, 0.1), (3, 0.2, -0.3), (4, 0.0, 0.2))
PROFILE = Profile(exponent=1.4, harmonics=tuple(Harmonic(n=n, cos=even, sin=odd) for n, even, odd in WAVES))


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


@pytest.mark.parametrize("k", [0.0, 0.31, 0.875])
@pytest.mark.parametrize("reach", [0.02, 0.1, 0.7])
def test_the_energy_is_the_loop_integral_of_the_load(k: float, reach: float) -> None:
    """Integrate P d(delta) along the two envelopes and the line at the rim, depths counted from the mean surface."""
    scene = {
        "k": k,
        "nu": 0.2,
        "modulus": 240.0,
        "c0_over_R": 0.1,
        "lambda_over_R": 1e-3,
        "A": 0.2,
        "a_max_over_R": reach,
    }
    M = float(stiffness(k, 0.2, 240.0, 0.1))
    m, c = PROFILE.exponent, (1 - mpmath.mpf(k)) / 2
    up, down = (
        float(envelopes.waviness_strength(k, 1e-3, 0.2)) * swing
        for swing in swings(k, tuple((float(n), even, odd) for n, even, odd in WAVES))
    )
    s = float(envelopes.adhesion_strength(k, M))
    assert up < s  # so that contact is made by a jump
    with mpmath.workdps(25):
        front = (
            mpmath.gamma(m / 2)
            * mpmath.gamma((1 + mpmath.mpf(k)) / 2)
            / (2 * mpmath.gamma((1 + mpmath.mpf(k) + m) / 2))
        )
        K = 2 ** (1 - mpmath.mpf(k)) * M / (1 + mpmath.mpf(k))

        def depth(pull: float, a: mpmath.mpf) -> mpmath.mpf:
            return front * a**m - pull * a**c

        def load(pull: float, a: mpmath.mpf) -> mpmath.mpf:
            return K * a ** (1 + k) * (m / (1 + k + m) * front * a**m - pull * a**c)

        def work(pull: float, low: mpmath.mpf, high: mpmath.mpf) -> mpmath.mpf:
            def rate(t: mpmath.mpf) -> mpmath.mpf:
                a = mpmath.exp(t)
                return load(pull, a) * (m * front * a**m - pull * c * a**c)

            return (
                mpmath.quad(rate, mpmath.linspace(mpmath.log(low), mpmath.log(high), 9))
                if low < high
                else mpmath.mpf(0)
            )

        rim = mpmath.mpf(reach)
        a_in = min(rim, ((s - up) / front) ** (1 / (m - c)))
        a_out = min(rim, (c * (s + down) / (m * front)) ** (1 / (m - c)))
        top, bottom = max(mpmath.mpf(0), depth(s - up, rim)), depth(s + down, rim)
        pinned = (top - bottom) * load(s + down, rim) + K * rim ** (1 + k) * (top - bottom) ** 2 / 2
        loop = work(s - up, a_in, rim) - pinned - work(s + down, a_out, rim)
    found = solve(scene, ["dissipated_energy"], solver="envelope", profile=PROFILE)["dissipated_energy"]
    assert float(found) == pytest.approx(float(loop), rel=1e-12)


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
