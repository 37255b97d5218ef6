"""Random profiles and uncertain inputs: their laws and distributions, statistics against numpy's, and what follows from the seed."""

import math

import numpy as np
import pytest
from scipy.stats import truncnorm

from gradhesion.core import Profile
from gradhesion.core.answers.spectrum import Spectrum, random_profile
from gradhesion.core.answers.uncertainty import QUANTILES, Spread, differ, drawn_shares, linear_deviation, statistics_of

EPS = float(np.finfo(float).eps)
ROUGH = {"hurst": 0.7, "first": 2, "last": 41, "realisations": 400, "seed": 11}
WRONG = ({"hurst": -0.1}, {"hurst": 1.1}, {"first": 0}, {"last": 1}, {"last": 66}, {"last": 10_001, "first": 10_000})


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


@pytest.mark.parametrize("change", [*WRONG, {"realisations": 0}, {"seed": -1}], ids=str)
def test_what_cannot_be_drawn_is_refused(change: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(change))):
        Spectrum(**(ROUGH | change))


SHARES = np.array([1e-12, 0.003, 0.31, 0.5, 0.77, 0.9999])


SPREADS = {
    0.02: Spread(deviation=0.013, low=0.0),
    0.31: Spread(deviation=0.27, low=-1.0, high=0.5),
    0.97: Spread(deviation=0.05, relative=True, low=0.0, high=1.0),
    430.0: Spread(deviation=0.07, relative=True, low=0.0),
}


@pytest.mark.parametrize(("centre", "spread"), SPREADS.items())
def test_a_truncated_normal_distribution(centre: float, spread: Spread) -> None:
    deviation = spread.deviation * (centre if spread.relative else 1.0)
    exact = truncnorm((spread.low - centre) / deviation, (spread.high - centre) / deviation, centre, deviation)
    # the quantile function loses eps over the density of the share, which is least at the ends
    np.testing.assert_allclose(spread.quantiles(centre, SHARES), exact.ppf(SHARES), rtol=1e-11, atol=1e-12)
    assert spread.standard_deviation(centre) == pytest.approx(exact.std(), rel=1e-9)


def test_a_uniform_distribution_is_that_of_every_scene_and_samples_lie_strictly_within() -> None:
    spread = Spread(low=0.28, high=0.32, uniform=True)
    centres = np.array([[0.29], [0.31]])
    assert spread.quantiles(centres, [0.0, 0.25, 1.0]) == pytest.approx(np.array(2 * [[0.28, 0.29, 0.32]]), rel=4 * EPS)
    assert spread.standard_deviation(centres) == pytest.approx(np.full((2, 1), 0.04 / np.sqrt(12.0)), rel=4 * EPS)
    for centre in (0.0, 1.0, 0.5):
        ends = Spread(deviation=0.3, low=0.0, high=1.0).quantiles(centre, [0.0, 1.0])
        assert 0.0 < ends[0] < ends[1] < 1.0


def test_shares_fill_the_cube_evenly_and_follow_from_the_seed() -> None:
    shares = drawn_shares(4, 64, seed=7)
    np.testing.assert_array_equal(np.sort(np.floor(64 * shares), axis=1), np.tile(np.arange(64.0), (4, 1)))
    np.testing.assert_array_equal(shares, drawn_shares(4, 64, seed=7))
    assert not np.array_equal(shares, drawn_shares(4, 64, seed=8))


def test_variances_of_independent_inputs_add_up() -> None:
    assert linear_deviation([2.0, -0.7], [0.3, 0.5]) == pytest.approx(math.hypot(0.6, 0.35), rel=4 * EPS)


def test_statistics_leave_out_what_has_no_value() -> None:
    samples = np.random.default_rng(11).normal(size=(5, 3, 37))
    samples[0, 1, :9] = np.nan
    samples[2, 2] = np.nan
    found, there = statistics_of(samples), np.arange(15).reshape(5, 3) != 8
    exact = {name: np.nanquantile(samples[there], share, axis=-1) for name, share in QUANTILES.items()}
    exact |= {"mean": np.nanmean(samples[there], axis=-1), "std": np.nanstd(samples[there], axis=-1)}
    for name, values in exact.items():
        np.testing.assert_allclose(found[name][there], values, rtol=1e-13, atol=1e-14)
        assert np.isnan(found[name][2, 2])
    infinite = statistics_of(np.array([1.0, 2.0, np.inf, np.inf]))
    assert [float(infinite[name]) for name in ("p05", "p50", "p95", "mean")] == [1.15, np.inf, np.inf, np.inf]
    assert differ([1.0, 1.0, 1.0, 0.0], [0.91, 0.89, np.nan, 1e-13], 1.0).tolist() == [False, True, True, False]
    assert differ([1.0, 1.0], [0.99, 0.97], 1.0, 0.02).tolist() == [False, True]
