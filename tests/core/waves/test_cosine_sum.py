"""Sums over waves: wave by wave, against closed limits at every power of ten, and against the solver of any profile."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.general_report import report_general
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.equations import saturation
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import FAILED, NO_VALUE
from gradhesion.core.waves.cosine import jump_of_wave
from gradhesion.core.waves.cosine_at_once import room_for_batch
from gradhesion.core.waves.cosine_sum import branch_points, sum_of_waves
from tests.core.waves.reaching import reaching

pytestmark = pytest.mark.slow

WORK, ROOM = np.zeros(22), room_for_batch()
GOOD = 1e-12
"""What sums are promised to, in parts of the loss."""
NAMES = ("dissipated_energy", "dissipated_energy_error")
ANY = (Profile(), Loading(), 1)
"""What the solver of any profile is asked for: one cosine, on one thread."""


def scene_of(k: float, chi: float, waves: float) -> dict[str, float]:
    """Give the scene of an unbounded punch on which folds end at a given wave, about."""
    material = {"k": k, "nu": 0.5 if k == 1.0 else 0.3, "modulus": 500.0, "c0_over_R": 0.01}
    return {name: float(value) for name, value in reaching(material, chi, waves).items()}


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9, 1.0])
@pytest.mark.parametrize("chi", [1e-5, 1e-2, 0.1, 0.6, 3.0])
@pytest.mark.parametrize("outwards", [True, False])
def test_a_sum_is_what_every_wave_loses(k: float, chi: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    """Runs that begin next to a branch point or far from it, and end where folds do or before."""
    table = table_of(k)
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    runs = 0
    for waves in (200.0, 1000.0, 5000.0):
        curve = Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)
        final = last_arch(table, curve, 0.5 * (1 - k))
        inner, outer = branch_points(table, curve, final, outwards)
        first = math.ceil(max(inner + 1.0, 0.5 * first_arch(table, curve, 0.5 * (1 - k)) + 16.0, 16.0))
        for low, high in [(first, outer - 11), (first, 0.3 * outer), (first + 300, outer - 50), (first, first + 30)]:
            high = math.floor(high)
            if high <= low or high > outer - 11:
                continue
            losses = [jump_of_wave(table, curve, wave, outwards, WORK)[1] for wave in np.arange(low, high + 1.0)]
            total = sum_of_waves(table, curve, low, high, outwards, final, ROOM)
            assert abs(total - math.fsum(losses)) <= GOOD * math.fsum(np.abs(losses))
            runs += 1
    assert runs >= 3


@pytest.mark.parametrize("waves", [1e3, 1e5, 1e7])
def test_a_short_sum_far_out(waves: float, table_of: Callable[[float], Any]) -> None:
    """The length of a run must not be a difference of its places, which are 10^5 times as large."""
    table = table_of(0.5)
    amplitude = 2 ** (0.5 * (0.5 - 1)) * math.gamma(0.75)
    curve = Cosine(0.3 / (2 * math.pi * 1e3 * waves) ** 0.75, 0.3 / amplitude, 0.0)
    final = last_arch(table, curve, 0.25)
    for length in (60, 300):
        losses = [jump_of_wave(table, curve, waves + i, False, WORK)[1] for i in range(length)]
        total = sum_of_waves(table, curve, waves, waves + length - 1.0, False, final, ROOM)
        assert math.isclose(total, math.fsum(losses), rel_tol=256 * 2.0**-52)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 1.0])
@pytest.mark.parametrize("chi", [0.03, 0.3])
def test_the_saturated_energy_tends_to_its_limit(k: float, chi: float) -> None:
    """At every power of ten of waves: the closed limit of short waves is off by 2/(chi N) at most, evenly.

    What it leaves out is of the order 1/N, so that ten times as many waves leave about a tenth, down to rounding.
    """
    waves = 10.0 ** np.arange(5, 16)
    scenes = [scene_of(k, chi, number) for number in waves]
    columns = {name: np.array([scene[name] for scene in scenes]) for name in scenes[0]}
    result = solve(columns, ["dissipated_energy", "dissipated_energy_error"])
    assert np.all(result["status"] & FAILED == 0)
    material = float(stiffness(*(scenes[0][name] for name in ("k", "nu", "modulus", "c0_over_R"))))
    shape = (k, material, columns["lambda_over_R"], columns["A"], np.inf)
    off = result["dissipated_energy"] / saturation.dissipated_energy(*shape) - 1.0
    assert np.all(np.abs(off) <= 2.0 / (chi * waves) + 1e-13)
    even = np.abs(off[2:-1] - 0.1 * off[1:-2]) <= 0.2 * np.abs(off[2:-1]) + GOOD
    assert np.all(even)
    # beyond: the phase of the last wave is in no digit of the inputs
    beyond = solve(scene_of(k, chi, 1e16), OUTPUTS)
    assert beyond["status"] == NO_VALUE
    assert np.isnan(beyond["dissipated_energy"])


@pytest.mark.parametrize("bounded", [False, True])
@pytest.mark.parametrize("decade", range(2, 13))
def test_the_stated_error_covers(decade: int, bounded: bool) -> None:
    """Against the solver of any profile, which sums by other means: by no more than both state, and to 1e-12."""
    rng = np.random.default_rng([decade, bounded])
    size = 12
    drawn = [
        scene_of(float(k), float(chi), float(waves))
        for k, chi, waves in zip(
            rng.choice([0.0, 0.1, 0.5, 0.9, 1.0], size),
            10.0 ** rng.uniform(-1.5 if decade < 5 else -4.0, 0.5, size),
            10.0 ** (decade + rng.uniform(0.0, 1.0, size)),
            strict=True,
        )
    ]
    scenes: Any = {name: np.array([scene[name] for scene in drawn]) for name in drawn[0]}
    if bounded:
        reach = scenes["lambda_over_R"] * 10.0 ** (decade + rng.uniform(-1.0, 1.0, size))
        scenes["a_max_over_R"] = reach
    one = solve(scenes, NAMES)
    other = solve_general(scenes, NAMES[:1], *ANY, check_contact=False)
    stated = one[NAMES[1]] + report_general(scenes, NAMES[1:], other, *ANY)[NAMES[1]]
    there = np.isfinite(other[NAMES[0]])
    assert np.all(np.isfinite(one[NAMES[0]]))
    assert there.mean() >= 0.5  # a weak wave has too few digits left for the other one, beyond 10^9
    difference = np.abs(one[NAMES[0]] - other[NAMES[0]])[there]
    assert np.all(difference <= stated[there])
    assert np.all(difference <= GOOD * np.abs(other[NAMES[0]][there]))


def test_a_weak_wave_far_out_has_its_energy() -> None:
    """chi = 1.5e-6, 6e9 waves: 1 - rho kept nothing of it, and gave -384."""
    scene = {"k": 0.0, "nu": 0.5, "modulus": 4.9015e-05, "c0_over_R": 0.057964, "lambda_over_R": 1.31973e-07}
    scene |= {"A": 0.0138352, "a_max_over_R": math.inf}
    found = float(solve(scene, ["dissipated_energy"])["dissipated_energy"])
    expected = float(saturation.dissipated_energy(0.0, 4.9015e-05, 1.31973e-07, 0.0138352, math.inf))
    assert math.isclose(found, expected, rel_tol=1e-3)
