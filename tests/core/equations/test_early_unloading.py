"""Early unloading of a series: it joins the envelopes of the series, along the line of a flat punch."""

import math

import numpy as np
import pytest

from gradhesion.core.equations import early_unloading, effective, envelopes, general, hertz, jkr, short_waves

M, A_AM, WAVELENGTH = 150.0, 0.6, 0.003
COSINES, SINES = [-0.02, 0.004], [0.006, 0.0, -0.001]
EXPONENTS = [0.0, 0.41, 1.0]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("m", [1.5, 2.0])
def test_it_joins_the_envelopes_of_the_series(k: float, m: float) -> None:
    lowest, highest = envelopes.zeta_extrema(k, COSINES, SINES)
    s = envelopes.adhesion_strength(k, M)
    up, down = envelopes.series_strengths(k, WAVELENGTH, COSINES, SINES)
    for alpha, pull in ((highest, s - up), (lowest, s + down)):
        depth = early_unloading.indentation(k, M, A_AM, alpha, WAVELENGTH, exponent=m)
        assert depth == pytest.approx(envelopes.indentation(k, A_AM, pull, 0.0, m), rel=1e-12)
        load = early_unloading.load(k, M, A_AM, alpha, WAVELENGTH, exponent=m)
        assert load == pytest.approx(envelopes.load(k, M, A_AM, pull, m), rel=1e-12)
        assert early_unloading.load_at_depth(k, M, A_AM, depth, exponent=m) == pytest.approx(load, rel=1e-12)
    top, bottom = (
        early_unloading.indentation(k, M, A_AM, alpha, WAVELENGTH, exponent=m) for alpha in (highest, lowest)
    )
    # two depths of the order of the radius: eps of it
    drop = early_unloading.drop(k, A_AM, WAVELENGTH, COSINES, SINES)
    assert top - bottom == pytest.approx(float(drop), abs=4e-16)
    assert drop == pytest.approx(float((up + down) * A_AM ** (0.5 * (1 - k))), rel=1e-13)


@pytest.mark.parametrize("k", EXPONENTS)
def test_it_is_the_leading_term_of_short_waves_at_one_radius(k: float) -> None:
    # within one wave zeta takes every value alpha: (5.28), (5.29) are (5.15), (5.16) with the radius held elsewhere
    xi = np.round(A_AM / WAVELENGTH) + np.linspace(0.0, 1.0, 17)
    alpha = short_waves.zeta(k, xi, COSINES, SINES)
    held = short_waves.indentation(k, M, A_AM, WAVELENGTH, COSINES, SINES, mean_height=False)
    base = float(short_waves.zeta(k, A_AM / WAVELENGTH, COSINES, SINES))
    depth = early_unloading.indentation(k, M, A_AM, alpha, WAVELENGTH)
    n = 0.5 * (1 + k)
    swing = 2 ** (n - 1) * math.gamma(n) * WAVELENGTH**n * A_AM ** (1 - n)
    np.testing.assert_allclose(depth - held, swing * (alpha - base), atol=1e-15)


@pytest.mark.parametrize("k", EXPONENTS)
def test_one_cosine_of_a_paraboloid_is_the_printed_line(k: float) -> None:
    depths = np.linspace(-0.1, 0.3, 5)
    for mean in (0.0, 0.001):
        np.testing.assert_allclose(
            early_unloading.load_at_depth(k, M, A_AM, depths, mean_height=mean),
            effective.early_unloading_load(k, M, A_AM, depths, mean),
            rtol=1e-11,
            atol=1e-11,
        )
    r = envelopes.waviness_strength(k, WAVELENGTH, 0.02)
    assert early_unloading.drop(k, A_AM, WAVELENGTH, [-0.02]) == pytest.approx(
        float(effective.early_unloading_depth(k, A_AM, r)), rel=1e-13
    )


@pytest.mark.parametrize("k", [0.0, 0.41])
def test_it_is_contact_pinned_at_its_radius_for_short_waves(k: float) -> None:
    # a disc of the radius a_am held at any depth: P = P_H + K a^(1+k) (delta - delta_H), of the whole series
    depth, mean = 0.3, WAVELENGTH * 0.016
    wave = (WAVELENGTH, COSINES, SINES)
    lowered = depth - general.hertz_indentation(k, A_AM, *wave)
    pinned = general.hertz_load(k, M, A_AM, *wave) + hertz.disc_stiffness(k, M, A_AM) * lowered
    line = early_unloading.load_at_depth(k, M, A_AM, depth, mean_height=mean)
    # what is left is the waviness's own moment, (lambda/a)^((3+k)/2)
    assert abs(float(pinned - line)) < 3 * M * 0.03 * A_AM * (WAVELENGTH / A_AM) ** (0.5 * (3 + k))
    assert abs(float(pinned - early_unloading.load_at_depth(k, M, A_AM, depth))) > 1e-4


def test_a_smooth_punch_has_no_early_unloading() -> None:
    assert early_unloading.drop(0.3, A_AM, WAVELENGTH, [0.0]) == 0.0
    assert early_unloading.indentation(0.3, M, A_AM, 0.0, WAVELENGTH) == pytest.approx(
        float(jkr.indentation(0.3, M, A_AM, 1.0, 0.0)), rel=1e-15
    )


def test_outside_the_ranges() -> None:
    assert np.isnan(early_unloading.indentation([-0.1, 0.3, 0.3], [1, 0, 1], [1, 1, -1], 0.0, 0.1)).all()
    assert np.isnan(early_unloading.drop(0.3, [-0.1, 0.1], [0.1, 0.0], [-0.1])).all()
    assert early_unloading.load(np.full((2, 1), 0.3), 1.0, np.ones(3), 0.1, 0.1).shape == (2, 3)
