"""The effective path: its corners lie on the envelopes, and its line is that of contact pinned at a radius."""

import math

import numpy as np
import pytest

from gradhesion.core.equations import effective, envelopes, jkr

EPS = float(np.finfo(float).eps)
M, WAVELENGTH, AMPLITUDE = 150.0, 0.003, 0.03
EXPONENTS = [0.0, 0.41, 0.9]


def _strengths(k: float) -> tuple[float, float]:
    s, r = envelopes.adhesion_strength(k, M), envelopes.waviness_strength(k, WAVELENGTH, AMPLITUDE)
    return float(s), float(r)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
def test_loading_begins_at_zero_depth(k: float) -> None:
    s, r = _strengths(k)
    a = effective.jump_in_radius(k, s, r)
    assert envelopes.indentation(k, a, s - r) == pytest.approx(0.0, abs=8 * EPS * s)
    assert envelopes.indentation(k, 1.01 * a, s - r) > 0.0


@pytest.mark.parametrize("k", EXPONENTS)
def test_unloading_ends_at_the_lowest_depth(k: float) -> None:
    s, r = _strengths(k)
    a = float(effective.jump_out_radius(k, s, r))
    around = envelopes.indentation(k, a * np.array([0.99, 1.0, 1.01]), s + r)
    assert around[1] < min(around[0], around[2])
    assert abs(around[2] - around[0]) < 0.05 * (around[2] - around[1])


def test_contact_shrinks_to_a_point_at_exponent_one() -> None:
    assert effective.jump_out_radius(1.0, 0.1, 0.05) == 0.0


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("mean", [0.0, WAVELENGTH * AMPLITUDE])
def test_line_of_early_unloading_joins_the_envelopes(k: float, mean: float) -> None:
    s, r = _strengths(k)
    a = 0.6
    depths = envelopes.indentation(k, a, np.array([s - r, s + r]), mean)
    loads = envelopes.load(k, M, a, np.array([s - r, s + r]))
    np.testing.assert_allclose(effective.early_unloading_load(k, M, a, depths, mean), loads, rtol=1e-12, atol=1e-12)
    assert depths[0] - depths[1] == pytest.approx(effective.early_unloading_depth(k, a, r), rel=1e-12)


@pytest.mark.parametrize("k", EXPONENTS)
def test_line_of_early_unloading_is_contact_pinned_at_its_radius(k: float) -> None:
    # the waviness's moment 2 pi A a^(2+k) S1 tends to A lambda a^(1+k): the line is lowered by the mean height
    a, depth = 0.6, 0.3
    for wavelength in (1e-3, 1e-4):
        pinned = jkr.load_at_depth(k, M, a, depth, wavelength, AMPLITUDE)
        line = effective.early_unloading_load(k, M, a, depth, wavelength * AMPLITUDE)
        swing = M * AMPLITUDE * a * (wavelength / a) ** (0.5 * (3 + k))
        assert abs(pinned - line) < 3 * swing


def test_outside_the_ranges() -> None:
    assert np.isnan(effective.jump_in_radius([-0.1, 0.3, 0.3], [0.1, 0.1, 0.1], [0.0, 0.1, -0.1])).all()
    assert np.isnan(effective.jump_out_radius([1.1, 0.3], 0.1, [0.0, -0.1])).all()
    assert np.isnan(effective.early_unloading_depth(0.3, [-0.1, math.nan], 0.1)).all()
    assert np.isnan(effective.early_unloading_load(0.3, [0.0, 1.0], [0.1, -0.1], 0.0)).all()
