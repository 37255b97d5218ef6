"""Fourier series against the defining integrals, against one cosine, and against 24 scenes solved to 30 digits."""

import json
import math
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import general, hertz, jkr

EPS = float(np.finfo(float).eps)
SCENES = json.loads((Path(__file__).parents[2] / "reference" / "general.json").read_text())["scenes"]
COSINES, SINES = [-0.021, 0.004, 0.0], [0.003, 0.0, -0.002]


def _slope(s: mpmath.mpf, wavelength: float, m: float) -> mpmath.mpf:
    total = s ** (m - 1)
    for n, (a_n, b_n) in enumerate(zip(COSINES, SINES, strict=True), start=1):
        y = 2 * mpmath.pi * n * s / wavelength
        total += 2 * mpmath.pi * n * (b_n * mpmath.cos(y) - a_n * mpmath.sin(y))
    return total


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize("a", [0.07, 0.9])
@pytest.mark.parametrize("m", [1.0, 2.0, 2.9])
def test_depth_and_load_without_adhesion(k: float, a: float, m: float) -> None:
    wavelength, M = 0.41, 19.0

    def integral(power: mpmath.mpf) -> mpmath.mpf:  # s = a sin u
        nodes = mpmath.linspace(0, mpmath.pi / 2, 12)
        exponent = 2 * power + 1
        return mpmath.mpf(a) ** exponent * mpmath.quad(
            lambda u: _slope(a * mpmath.sin(u), wavelength, m) * mpmath.cos(u) ** exponent, nodes
        )

    with mpmath.workdps(18):
        depth = mpmath.mpf(a) ** (1 - k) * integral((mpmath.mpf(k) - 1) / 2)
        load = 2 ** (1 - k) * M / (1 + k) * (mpmath.mpf(a) ** (1 + k) * depth - integral((mpmath.mpf(k) + 1) / 2))
    assert general.hertz_indentation(k, a, wavelength, COSINES, SINES, m) == pytest.approx(float(depth), rel=200 * EPS)
    found = 1.5 * math.pi * general.hertz_load(k, M, a, wavelength, COSINES, SINES, m)
    assert found == pytest.approx(float(load), rel=400 * EPS)


@pytest.mark.parametrize("k", [0.0, 0.43, 0.9])
def test_the_printed_sums(k: float) -> None:
    # (B1)-(B4), Struve's functions of the cosines and Bessel's of the sines, with pi^((3-k)/2) and pi^((1-k)/2)
    a, length, M = mpmath.mpf("0.21"), mpmath.mpf("0.13"), 19.0
    k_, n, pi = mpmath.mpf(k), (1 + mpmath.mpf(k)) / 2, mpmath.pi
    sums = [mpmath.mpf(0), mpmath.mpf(0)]
    for j in (0, 1):
        for m, a_m, b_m in general.harmonics(COSINES, SINES):
            y, order = 2 * m * pi * a / length, k_ / 2 + j
            sums[j] += m ** (1 - order) * (-a_m * mpmath.struveh(order, y) + b_m * mpmath.besselj(order, y))
    wave = a ** (1 - k_ / 2) * mpmath.gamma(n) * pi ** ((3 - k_) / 2) * length ** (k_ / 2) * sums[0]
    wavy = (float(a), float(length), COSINES, SINES)
    found = general.hertz_indentation(k, *wavy) - hertz.power_indentation(k, float(a))
    assert found == pytest.approx(float(wave), rel=1e-12)
    load = a**2 * mpmath.gamma(n) * pi ** ((3 - k_) / 2) * (length * a) ** (k_ / 2) * sums[0]
    load -= mpmath.gamma(n + 1) * pi ** ((1 - k_) / 2) * (length * a) ** (1 + k_ / 2) * sums[1]
    load *= 2 ** (1 - k_) * M / (1 + k_)
    smooth = hertz.load(k, M, float(a), 1.0, 0.0)
    assert 1.5 * math.pi * (general.hertz_load(k, M, *wavy) - smooth) == pytest.approx(float(load), rel=1e-11)


@pytest.mark.parametrize("scene", SCENES, ids=[str(i) for i in range(len(SCENES))])
def test_pull_off_of_general_scenes(scene: dict[str, Any]) -> None:
    p, expected = scene["parameters"], scene["expected"]
    count = max(h["n"] for h in p["harmonics"])
    cosines, sines = [0.0] * count, [0.0] * count
    for h in p["harmonics"]:
        cosines[h["n"] - 1], sines[h["n"] - 1] = -p["A"] * h["cos"], p["A"] * h["sin"]
    wave = (p["lambda_over_R"], cosines, sines, p["exponent"])
    at_pull_off = -general.load(p["k"], expected["M"], expected["pull_off_radius"], *wave)
    assert at_pull_off == pytest.approx(expected["pull_off_force"], rel=20 * EPS)
    everywhere = general.load(p["k"], expected["M"], np.linspace(1e-4, p["a_max_over_R"], 4001), *wave)
    assert -everywhere.min() <= at_pull_off * (1 + 20 * EPS)


def test_one_cosine_is_the_wave_of_hertz_and_jkr() -> None:
    a = np.linspace(0.0, 0.9, 30)
    np.testing.assert_allclose(
        general.hertz_indentation(0.4, a, 0.1, [-0.02]), hertz.indentation(0.4, a, 0.1, 0.02), rtol=1e-14
    )
    np.testing.assert_allclose(
        general.indentation(0.4, 90.0, a, 0.1, [-0.02]),
        jkr.indentation(0.4, 90.0, a, 0.1, 0.02),
        rtol=1e-13,
        atol=1e-16,
    )
    np.testing.assert_allclose(
        general.load(0.4, 90.0, a, 0.1, [-0.02]), jkr.load(0.4, 90.0, a, 0.1, 0.02), rtol=1e-12, atol=1e-15
    )


def test_a_harmonic_is_a_shorter_wave() -> None:
    a = np.linspace(0.01, 0.9, 30)
    np.testing.assert_allclose(
        general.indentation(0.4, 90.0, a, 0.3, [0.0, 0.0, -0.02], [0.0, 0.0, 0.01]),
        general.indentation(0.4, 90.0, a, 0.1, [-0.06], [0.03]),
        rtol=1e-12,
        atol=1e-14,
    )


def test_waviness() -> None:
    xi = np.linspace(-1.0, 2.0, 61)
    expected = sum(
        a_n * (np.cos(2 * math.pi * n * xi) - 1) + b_n * np.sin(2 * math.pi * n * xi)
        for n, a_n, b_n in general.harmonics(COSINES, SINES)
    )
    np.testing.assert_allclose(general.waviness(xi, COSINES, SINES), expected, atol=20 * EPS)
    assert general.waviness(0.0, COSINES, SINES) == 0.0


def test_outside_the_ranges() -> None:
    assert np.isnan(general.indentation([-0.1, 0.4, 0.4, 0.4], [1, 0, 1, 1], [1, 1, -1, 1], [1, 1, 1, 0], [-0.1])).all()
    assert general.load(np.full((2, 1), 0.3), 1.0, np.ones(3), 0.1, [-0.1], [0.1]).shape == (2, 3)
