"""The stress intensity: the limit of the pressure at the edge, and the energy release rate it stands for."""

import math

import numpy as np
import pytest

from gradhesion.core.equations import general, hertz, jkr, pressure
from gradhesion.core.equations import stress_intensity as module

EPS = float(np.finfo(float).eps)
WAVES = [([], [], 2.0), ([-0.02], [], 2.0), ([-0.021, 0.004], [0.003, 0.0, -0.002], 1.7)]


@pytest.mark.parametrize("k", [0.0, 0.2, 0.61, 1.0])
@pytest.mark.parametrize(("cosines", "sines", "m"), WAVES)
def test_every_equilibrium_state_is_critical(k: float, cosines: list[float], sines: list[float], m: float) -> None:
    a, wave = np.linspace(0.01, 0.9, 90), (0.13, cosines, sines, m)
    for M in (3.0, 1e4):
        depth = general.indentation(k, M, a, *wave)
        # delta_H - delta is a difference: eps of the depth, over Delta
        room = 4 * (1 + np.abs(general.hertz_indentation(k, a, *wave)) / jkr.adhesive_depth(k, M, a))
        found = module.stress_intensity(k, M, a, depth, *wave)
        assert (found < 0).all()
        assert (np.abs(found**2 / (2 * M) - 1) <= 4 * EPS * room).all()
        assert (np.abs(module.energy_release_rate(k, M, a, depth, *wave) - 1) <= 4 * EPS * room).all()


@pytest.mark.parametrize("k", [0.0, 0.2, 0.61, 0.95])
@pytest.mark.parametrize("raised", [-1.3, 0.4])
def test_it_is_the_limit_of_the_pressure(k: float, raised: float) -> None:
    a, M, wave = 0.23, 210.0, (0.13, [-0.02], [0.004])
    depth = float(general.hertz_indentation(k, a, *wave)) + raised * float(jkr.adhesive_depth(k, M, a))
    limit = []
    for share in (1e-6, 1e-8):
        edge = math.sqrt(2 * math.pi) * (a * share) ** (0.5 * (1 - k))
        limit.append(edge * float(pressure.pressure(k, M, a * (1 - share), a, depth, *wave)))
    found = float(module.stress_intensity(k, M, a, depth, *wave))
    assert abs(limit[1] / found - 1) < 1e-5
    assert abs(limit[1] - found) < 0.05 * abs(limit[0] - found)


@pytest.mark.parametrize("k", [0.0, 0.43, 1.0])
def test_one_definition_of_the_release_rate(k: float) -> None:
    a, depth = np.linspace(0.02, 0.5, 12), 0.03
    one = jkr.energy_release_rate(k, 210.0, a, depth, 0.13, 0.02)
    np.testing.assert_allclose(module.energy_release_rate(k, 210.0, a, depth, 0.13, [-0.02]), one, rtol=1e-11)
    squared = module.stress_intensity(k, 210.0, a, depth, 0.13, [-0.02]) ** 2 / 420.0
    np.testing.assert_allclose(squared, one, rtol=1e-11)


@pytest.mark.parametrize("k", [0.0, 0.43, 1.0])
def test_it_is_that_of_the_missing_load(k: float) -> None:
    # (4.5) as it must be: -(1+k) (P_H - P)/(2^(1-k/2) sqrt(pi) a^((3+k)/2)); as it is printed only at k = 0
    a, M, wave = 0.23, 210.0, (0.13, [-0.02])
    depth = float(general.indentation(k, M, a, *wave))
    missing = 1.5 * math.pi * float(hertz.disc_stiffness(k, M, a) * jkr.adhesive_depth(k, M, a))
    right, printed = (
        -(1 + k) * missing / (2 ** (1 + sign * k / 2) * math.sqrt(math.pi) * a ** (0.5 * (3 + k))) for sign in (-1, 1)
    )
    assert module.stress_intensity(k, M, a, depth, *wave) == pytest.approx(right, rel=1e-12)
    assert (printed**2 / (2 * M) == pytest.approx(1.0, rel=1e-12)) == (k == 0.0)


def test_outside_the_ranges() -> None:
    assert np.isnan(module.stress_intensity([-0.1, 0.3, 0.3], [1, 0, 1], [1, 1, 0], 0.0, 0.1, [])).all()
    assert np.isnan(module.energy_release_rate(0.3, [0.0, 1.0], [1.0, 0.0], 0.0, 0.1, [])).all()
    assert module.stress_intensity(np.full((2, 1), 0.3), 1.0, np.ones(3), 0.0, 0.1, [0.1]).shape == (2, 3)
