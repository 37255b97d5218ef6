"""Long curves: sums in the place of walks, for one rim and for many."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.path import cosine as cycle
from gradhesion.core.path import cosine_long as long_cycle
from gradhesion.core.path.loading import loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.material import stiffness

EXPONENTS = [(0.0, 0.3), (0.31, 0.27), (0.7, 0.1), (0.97, 0.5), (1.0, 0.5)]


def _curve(k: float, chi: float, waves: float) -> Cosine:
    """Give the curve of a given C g whose folds end at a given wave."""
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)


def _read(table: Any, curve: Any, count: int, trace: Any, rim: float) -> tuple[float, float, float, float]:
    """Give the energy of a cycle up to a rim, its numbers of jumps, and the depth at which contact ends."""
    rim_depth = depth(table, curve, rim) if rim < math.inf else math.inf
    loaded, loading_jumps = loading_to(table, curve, count, trace, rim, True)
    unloaded, unloading_jumps, last = unloading_from(table, curve, count, trace, rim, rim_depth, True)
    return loaded + unloaded, loading_jumps, unloading_jumps, last


@pytest.mark.parametrize("k", [0.0, 1e-12, 0.37, 0.8, 1 - 1e-12, 1.0])
@pytest.mark.parametrize("chi", [0.001, 0.01, 0.05, 0.4, 1.0, 1.7, 6.0])
@pytest.mark.parametrize("waves", [120.0, 1000.0])
def test_striding_is_walking(k: float, chi: float, waves: float, table_of: Callable[[float], Any]) -> None:
    """Long curves, whole and cut by rims: the same loss as walking every wave, the same numbers of jumps."""
    table = table_of(k)
    curve = _curve(k, chi, waves)
    arches = cycle.extent(table, curve)
    end = 0.5 * arches[1]
    long = long_cycle.begin_long(table, curve, arches, np.zeros((ROWS, 192)), True, 1.0)
    for rim in (85.0, 100.3, 0.71 * waves, end - 14.2, end - 9.7, end - 3.1, end - 1.4, 1.5 * waves, math.inf):
        if not cycle.is_long(table, arches, rim):
            continue
        count, all_of_it = cycle.walk(table, curve, arches, rim, np.zeros((ROWS, 192)), True)
        energy, *walked = _read(table, curve, count, all_of_it, rim)
        count = long_cycle.stride(table, curve, rim, long, True, 1.0)
        other, *strode = _read(table, curve, count, long.trace, rim)
        assert walked[:2] == strode[:2]
        assert math.isclose(walked[2], strode[2], rel_tol=1e-12)
        # what sums promise
        assert math.isclose(energy, other, rel_tol=1e-12)


@pytest.mark.parametrize("chi", [0.02, 0.4])
@pytest.mark.parametrize("waves", [400.0, 1e6])
def test_rims_share_the_samples_of_their_sums(chi: float, waves: float, table_of: Callable[[float], Any]) -> None:
    """Four hundred rims find the jumps of no more waves than the panels of the sums have places."""
    table, curve = table_of(0.3), _curve(0.3, chi, waves)
    arches = cycle.extent(table, curve)
    long = long_cycle.begin_long(table, curve, arches, np.zeros((ROWS, 192)), True, 1.0)
    rims = np.linspace(0.25 * waves, 0.9 * waves, 400)
    for rim in rims:
        assert cycle.is_long(table, arches, rim)
        assert not long_cycle.ends_folds(table, arches, rim)
        long_cycle.stride(table, curve, rim, long, True, 1.0)
    samples = long.sums["samples"]
    assert np.all(samples > 0)
    assert np.all(samples <= 12 + 16 * long.sums["count"])


@pytest.mark.parametrize(("k", "nu"), EXPONENTS)
@pytest.mark.parametrize(("wavelength", "A"), [(1e-3, 0.02), (2e-4, 0.2)])
def test_a_rim_is_the_same_among_others_and_alone(k: float, nu: float, wavelength: float, A: float) -> None:
    """To the last bit, in any order: the values of a study do not depend on its blocks."""
    scene = {"k": k, "nu": nu, "modulus": 70.0, "c0_over_R": 0.4, "lambda_over_R": wavelength, "A": A}
    rng = np.random.default_rng(9)
    rims = np.concatenate([rng.uniform(0.005, 2.0, 60), 10.0 ** rng.uniform(-1, 2.0, 20), [np.inf, 1e9]])
    together = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
    for i in range(0, rims.size, 3):
        alone = solve(scene | {"a_max_over_R": rims[i]}, OUTPUTS)
        for name in (*OUTPUTS, "status"):
            np.testing.assert_array_equal(alone[name], together[name][i])


@pytest.mark.parametrize(("k", "nu"), EXPONENTS)
@pytest.mark.parametrize("wavelength", [1e-3, 1e-4])
def test_short_waves(k: float, nu: float, wavelength: float, table_of: Callable[[float], Any]) -> None:
    """Energy of thousands of waves to 1e-12: against walking every one."""
    m = float(stiffness(k, nu, 70.0, 0.4))
    s = math.sqrt(2 ** (1 + k) * math.pi / m)
    amplitude = 0.5 * s / (math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2))
    scene = {"k": k, "nu": nu, "modulus": 70.0, "c0_over_R": 0.4, "lambda_over_R": wavelength, "A": amplitude}
    rims = np.array([0.4, 1.1, 3.3]) * m ** (-1 / (3 + k))
    values = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
    length = wavelength / (2 * math.pi)
    scale = s * length ** (0.5 * (1 - k))
    curve = Cosine(2 * length * length / ((1 + k) * scale), amplitude * wavelength / scale, 0.0)
    table = table_of(k)
    arches = cycle.extent(table, curve)
    x = rims / wavelength
    count, trace = cycle.walk(table, curve, arches, x[-1], np.zeros((ROWS, 192)), True)
    for i in range(rims.size):
        loss, loading_jumps, unloading_jumps, _ = _read(table, curve, count, trace, x[i])
        walked = 2 * math.pi * length * length * loss
        assert math.isclose(float(values["dissipated_energy"][i]), walked, rel_tol=1e-12)
        assert [values[name][i] for name in ("loading_jumps", "unloading_jumps")] == [loading_jumps, unloading_jumps]


@pytest.mark.parametrize("k", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("chi", [0.55, 0.72, 0.78, 1.1])
def test_the_contact_of_a_rim_is_the_same_among_others_and_alone(k: float, chi: float) -> None:
    """Whether loading keeps the contact one disc is looked at once for all rims of a long curve."""
    nu = 0.5 if k == 1.0 else 0.3
    wavelength = 5e-4
    m = float(stiffness(k, nu, 1e5, 0.01))
    stretch = math.sqrt(2 ** (1 + k) * math.pi / m)
    amplitude = chi * stretch / (math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2))
    scene = {"k": k, "nu": nu, "modulus": 1e5, "c0_over_R": 0.01, "lambda_over_R": wavelength, "A": amplitude}
    rims = np.concatenate([np.linspace(0.06, 0.6, 40), [np.inf]])
    together = solve(scene | {"a_max_over_R": rims}, ["dissipated_energy"])["status"]
    for i in (0, 7, 20, 33, 40):
        assert solve(scene | {"a_max_over_R": rims[i]}, ["dissipated_energy"])["status"] == together[i]


def test_waves_that_begin_within_the_branch_point() -> None:
    """With k an ulp from 1 the losses of waves have their branch point further out than the first wave of the gap."""
    scene = {
        "k": 1.0 - 2.0**-53,
        "nu": -0.99,
        "modulus": 4.08e-7,
        "c0_over_R": 8.2e-12,
        "lambda_over_R": 4.7e-10,
        "A": 41.0,
    }
    rims = np.geomspace(1e-6, 0.2, 12)
    energy = solve(scene | {"a_max_over_R": rims}, ["dissipated_energy"])["dissipated_energy"]
    # so steep waves are never full: what is lost on the way out is the work of adhesion of the whole contact
    np.testing.assert_allclose(energy, math.pi * rims**2, rtol=1e-6)
    expected = solve_general(
        scene | {"a_max_over_R": rims}, ["dissipated_energy"], Profile(), Loading(), 1, check_contact=False
    )
    known = np.isfinite(expected["dissipated_energy"]) & (rims < 1e6 * scene["lambda_over_R"])
    assert known.sum() >= 5
    np.testing.assert_allclose(energy[known], expected["dissipated_energy"][known], rtol=1e-12)
    # beyond, sums of one cosine lose digits that other profiles keep; docs/accuracy.md has both
    far = np.isfinite(expected["dissipated_energy"]) & ~known
    np.testing.assert_allclose(expected["dissipated_energy"][far], math.pi * rims[far] ** 2, rtol=1e-12)


def test_contact_ends_at_the_lowest_of_all_waves_where_neighbours_differ_by_less_than_rounding() -> None:
    """Scenes of 9 10^9 waves and similar ones, all lengths 5/4 times as large, whose roundings differ."""
    factor = 1.25
    ulps = 1.0 + np.arange(300.0) * 2.0**-52
    scene = {
        "k": 0.5,
        "nu": -0.07205794646137065,
        "modulus": 385973969.6717387 * ulps,
        "c0_over_R": 0.014373395433882028,
    }
    scene |= {"lambda_over_R": 2.0**-42, "A": 65700.09319711609, "a_max_over_R": 0.0020078730580606365}
    similar = scene | {name: factor * scene[name] for name in ("lambda_over_R", "a_max_over_R", "A")}
    similar["modulus"] = scene["modulus"] * factor**-3.5
    one, other = (solve(each, ["delta_jump_out"])["delta_jump_out"] for each in (scene, similar))
    # the depth is a difference of terms of its size, and changes as 0.7 of a stiffness that has some eps of its own
    np.testing.assert_allclose(other / factor**2, one, rtol=32 * np.finfo(float).eps)
