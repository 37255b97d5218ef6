"""Random profiles: their heights and slopes, the law of their amplitudes, phases from the seed, and their extremes."""

import math

import numpy as np
import pytest

from gradhesion.core import Profile
from gradhesion.core.answers.spectrum import Spectrum, random_profile

EPS = np.finfo(float).eps
ROUGH = {"hurst": 0.7, "first": 2, "last": 41, "realisations": 400, "seed": 11}


def waves(profile: Profile) -> tuple[np.ndarray, ...]:
    return tuple(np.array([getattr(wave, name) for wave in profile.harmonics]) for name in ("n", "cos", "sin"))


def test_amplitudes_follow_the_power_law_and_make_the_rms_height_one() -> None:
    spectrum = Spectrum(**ROUGH)
    n, cos, sin = waves(random_profile(spectrum, 3))
    assert n.tolist() == list(range(2, 42))
    sizes = np.hypot(cos, sin)
    np.testing.assert_allclose(sizes / sizes[0], (n / 2.0) ** -1.2, rtol=8 * EPS)
    phase = 2 * np.pi * np.multiply.outer(np.arange(4096) / 4096, n)
    assert np.std((1 - np.cos(phase)) @ cos + np.sin(phase) @ sin) == pytest.approx(1.0, rel=64 * EPS)
    slope = 2 * np.pi * (np.sin(phase) @ (n * cos) + np.cos(phase) @ (n * sin))
    assert np.sqrt(np.mean(slope**2)) == pytest.approx(spectrum.rms_slope, rel=64 * EPS)


def test_a_realisation_follows_from_seed_and_number_alone() -> None:
    """A dataset can be made again by another version of NumPy: the raw stream of PCG64 is fixed."""
    one, other = Spectrum(**ROUGH), Spectrum(**(ROUGH | {"realisations": 3}))
    assert random_profile(one, 2) == random_profile(other, 2)
    assert random_profile(one, 2) != random_profile(one, 1)
    assert random_profile(one, 2) != random_profile(Spectrum(**(ROUGH | {"seed": 12})), 2)
    assert random_profile(one, 0, 1.5).exponent == 1.5
    _, cos, sin = waves(random_profile(Spectrum(hurst=0.5, first=1, last=3, realisations=1, seed=1), 0))
    bits = np.random.PCG64(np.random.SeedSequence(1, spawn_key=(0,)))
    phases = 2 * np.pi * np.random.Generator(bits).random(3)
    np.testing.assert_allclose(np.arctan2(sin, cos) % (2 * np.pi), phases, rtol=8 * EPS)


def test_phases_are_uniform_and_independent() -> None:
    spectrum, turns = Spectrum(**ROUGH), []
    for number in range(400):
        _, cos, sin = waves(random_profile(spectrum, number))
        turns.append(np.arctan2(sin, cos))
    phases = np.array(turns)
    neighbours = (phases[:, 1:] - phases[:, :-1], phases[1:] - phases[:-1])
    for sample in (phases, 2 * phases, *neighbours):
        assert abs(np.mean(np.exp(1j * sample))) < 4.0 / math.sqrt(sample.size)


WRONG = ({"hurst": -0.1}, {"hurst": 1.1}, {"first": 0}, {"last": 1}, {"last": 66}, {"last": 10_001, "first": 10_000})


@pytest.mark.parametrize("change", [*WRONG, {"realisations": 0}, {"seed": -1}], ids=str)
def test_what_cannot_be_drawn_is_refused(change: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(change))):
        Spectrum(**(ROUGH | change))
