"""Some hundred scenes of each draw against every check, and what they may cost.

Each check gives one number a scene, at most 1 where it holds; NaN is a failure.

STRESS_SCENES=100000 STRESS_SEED=7 pytest tests/stress -k long      more of them, and fresh ones
"""

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import FAILED, OUTPUTS, REPORTS, solve
from gradhesion.core.equations import short_waves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC, NO_VALUE
from tests.conftest import ROOT

from .draw import Scenes, eventful, groups, hostile

EPS: Final = 2.0**-52
Excess = NDArray[np.float64]
overflowing: Final = np.errstate(all="ignore")
"""Around checks: what overflows has no value."""


def _valid(result: dict[str, Any]) -> NDArray[np.bool_]:
    return np.asarray((result["status"] & FAILED) == 0)


@overflowing
def _size(scenes: Scenes) -> Excess:
    """Give the size of the terms of the energy: the area on which anything happens, times (1 + chi)^2."""
    of = groups(scenes)
    reach = np.maximum(of["jump_in"] * (1 + of["chi"]), of["waves"] * scenes["lambda_over_R"])
    return np.asarray(2 * np.pi * (1 + of["chi"]) ** 2 * np.minimum(scenes["a_max_over_R"], reach) ** 2)


@overflowing
def _terms(scenes: Scenes, found: dict[str, Any]) -> Excess:
    """Give the sizes of the terms of a pull-off force over it, which is a small difference on a small, very wavy punch."""
    of = groups(scenes)
    shape = (-1, *(1,) * (found["pull_off_force"].ndim - 1))
    jump_in, chi, k = (np.reshape(one, shape) for one in (of["jump_in"], of["chi"], scenes["k"]))
    abscissa = 2 * (found["pull_off_radius"] / jump_in) ** (0.5 * (3 + k))
    return np.fmax(1.0, 4 / 3 * abscissa * (1 + chi) / found["pull_off_force"])


def _at_rims(scenes: Scenes, factors: Any, outputs: Sequence[str]) -> dict[str, Any]:
    columns = {name: values[:, None] for name, values in scenes.items()}
    return solve(columns | {"a_max_over_R": columns["a_max_over_R"] * np.asarray(factors)}, outputs)


@overflowing
def values_or_status(scenes: Scenes) -> Excess:
    """Finite values and status 0, or no value at all and a status that says why; only delta_max and the turning radius may be infinite."""
    result = solve(scenes, OUTPUTS)
    valid = _valid(result)
    excess = np.zeros(valid.shape)
    unbounded = np.maximum(scenes["a_max_over_R"], scenes["a_max_over_R"] / scenes["lambda_over_R"]) > 1e150
    for name in OUTPUTS:
        values = result[name].astype(float)
        right = np.where(valid, np.isfinite(values), (values == -1.0) if "jumps" in name else np.isnan(values))
        if name in ("delta_max", "turning_radius"):
            right |= valid & (values == np.inf) & unbounded
        excess[~right] = np.nan
    positive = (result["pull_off_force"] >= 0.0) & (result["delta_max"] >= 0.0) & (result["loading_jumps"] >= 1)
    excess[valid & ~positive] = np.inf
    return excess


@overflowing
def energy_not_negative(scenes: Scenes) -> Excess:
    """The cycle loses energy, but for rounding, unless adhesion is so weak that the contact is no disc any more."""
    result = solve(scenes, ("dissipated_energy",))
    energy, flagged = result["dissipated_energy"], (result["status"] & LOADING_NOT_ONE_DISC) != 0
    excess = np.where(flagged, 0.0, -energy / (64 * EPS * _size(scenes)))
    excess[flagged & (groups(scenes)["chi"] < 0.5)] = np.inf  # a flag must not be an excuse
    return np.where(np.isnan(energy), 0.0, excess)


@overflowing
def force_does_not_fall(scenes: Scenes) -> Excess:
    """A larger punch never holds less."""
    found = _at_rims(scenes, [1.0, 1.0 + 1e-9, 1.03, 1.4, 7.0, 1e4, np.inf], ("pull_off_force", "pull_off_radius"))
    force = found["pull_off_force"]
    falls = (-np.diff(force, axis=1) / (16 * EPS * (_terms(scenes, found) * np.abs(force))[:, 1:])).max(axis=1)
    return np.where(np.isnan(force).any(axis=1) | (force == 0.0).any(axis=1), 0.0, falls)


@overflowing
def energy_is_continuous(scenes: Scenes) -> Excess:
    """A step of a_max by 1e-12 of itself moves the energy by as much of its terms, wherever the rim is."""
    step = 1e-12
    energy = _at_rims(scenes, [1.0 - step, 1.0, 1.0 + step], ("dissipated_energy",))["dissipated_energy"]
    jump = np.abs(np.diff(energy, axis=1)).max(axis=1)
    # a ring of that width at the rim, on which (1 + chi + the wave)^2 is at most four times (1 + chi)^2; and where
    # contact leaves the rim at once, the depth of that jump follows the wave at the rim
    waves = scenes["a_max_over_R"] / scenes["lambda_over_R"]
    excess = jump / ((16 * step + 2 * np.pi * waves * step + 1e-11) * _size(scenes))
    return np.where(np.isnan(energy).any(axis=1) | np.isinf(scenes["a_max_over_R"]), 0.0, excess)


@overflowing
def energy_is_constant_on_branches(scenes: Scenes) -> Excess:
    """While the rim lies on a branch that loading visits, as the rim before it does, the energy keeps its value."""
    names = ("dissipated_energy", "delta_max", "loading_jumps", "unloading_jumps")
    result = _at_rims(scenes, 1.0 + 1e-3 * np.arange(-1, 5), names)
    on_branch = (np.diff(result["delta_max"], axis=1) > 0.0).all(axis=1)
    for name in names[2:]:
        on_branch &= (np.diff(result[name], axis=1) == 0).all(axis=1)
    # a step of a thousandth must not pass over a wave
    on_branch &= 4e-3 * scenes["a_max_over_R"] < 0.2 * scenes["lambda_over_R"]
    energy = result["dissipated_energy"]
    excess = np.ptp(energy[:, 1:], axis=1) / (64 * EPS * _size(scenes) + 1e-11 * np.abs(energy[:, 1]))
    return np.where(on_branch, excess, 0.0)


@overflowing
def similarity(scenes: Scenes) -> Excess:
    """Scenes of equal groups lambda/L, A R lambda/L^2, a_max/L have equal reduced results.

    Forces to 1e-11, energies too up to 1,000 waves, with a digit less for each decade more (docs/accuracy.md). L grows by
    a power of 2 with modulus and depth alone, so that no rounding of the inputs stands between the two.
    """
    scale = 2.0**5
    powers = {"modulus": -3, "c0_over_R": 1, "lambda_over_R": 1, "A": 1, "a_max_over_R": 1}
    first = solve(scenes, OUTPUTS)
    second = solve({name: values * scale ** powers.get(name, 0) for name, values in scenes.items()}, OUTPUTS)
    force = np.abs(second["pull_off_force"] / first["pull_off_force"] - 1) / 1e-11
    # of the losses, which cancel where adhesion is weak
    size = np.abs(first["loading_energy"]) + np.abs(first["unloading_energy"]) + 1e-3 * _size(scenes)
    waves = np.minimum(scenes["a_max_over_R"] / scenes["lambda_over_R"], groups(scenes)["waves"])
    # waves whose folds tie to rounding: the last one of unloading is another, and loses what rounding leaves of the terms
    tied = first["unloading_jumps"] != second["unloading_jumps"]
    allowed = np.where(tied, 1e-9 * size + 1e-11 * _size(scenes), 1e-11 * np.maximum(1.0, waves / 1000.0) * size)
    energy = np.abs(second["dissipated_energy"] / scale**2 - first["dissipated_energy"]) / allowed
    return np.where(_valid(first) & _valid(second), np.maximum(force, energy), 0.0)


@overflowing
def one_ulp(scenes: Scenes) -> Excess:
    """One unit in the last place of an input changes no result by more than its condition allows.

    Powers of the material's numbers, each to at most some tens of units; and the phase 2 pi a/lambda of the waves at the
    pull-off, or up to the rim, of which a unit is 2 pi x eps.
    """
    base = solve(scenes, ("pull_off_force", "pull_off_radius", "dissipated_energy"))
    of = groups(scenes)
    waves = np.minimum(scenes["a_max_over_R"] / scenes["lambda_over_R"], of["waves"])
    waves = np.where(np.isfinite(waves), waves, 0.0)
    at_pull_off = base["pull_off_radius"] / scenes["lambda_over_R"]
    # theta next to k = 1, nu = 1/2 is as steep as 1/(1 - k + 1 - 2 nu); c0^k brings its logarithm
    steep = 1.0 / np.maximum(1.0 - scenes["k"] + 1.0 - 2.0 * scenes["nu"], EPS) * EPS
    allowed = 256 * EPS + 16 * EPS * np.abs(np.log(scenes["c0_over_R"])) + 4 * steep
    allowed[steep > 0.1] = np.inf  # where not one digit of theta is told by the inputs
    size, excess = np.abs(base["dissipated_energy"]) + _size(scenes), np.zeros(waves.shape)
    for name in scenes:
        if name == "k":
            continue  # another exponent is another table
        moved = np.nextafter(scenes[name], np.where(scenes[name] > 0.0, 0.0, 0.5))
        if name == "nu":
            moved = np.where(scenes["k"] == 1.0, 0.5, np.nextafter(scenes[name], -0.9))
        result = solve(scenes | {name: moved}, ("pull_off_force", "dissipated_energy"))
        force = np.abs(result["pull_off_force"] / base["pull_off_force"] - 1)
        energy = np.abs(result["dissipated_energy"] - base["dissipated_energy"])
        excess = np.fmax(excess, force / (_terms(scenes, base) * (allowed + 16 * EPS * at_pull_off)))
        excess = np.fmax(excess, energy / (size * (allowed + 1e-11 + 16 * EPS * waves)))
    return np.where(np.isnan(base["pull_off_force"]), 0.0, excess)


@overflowing
def many_waves_lose_what_short_ones_do(scenes: Scenes) -> Excess:
    """An unbounded punch of more than 10^5 waves loses the closed limit of short waves, to 4/(chi N) of it and 1e-12."""
    result = solve(scenes | {"a_max_over_R": np.full(scenes["k"].shape, np.inf)}, ("dissipated_energy",))
    k, wavelength, A, chi = scenes["k"], scenes["lambda_over_R"], scenes["A"], groups(scenes)["chi"]
    material = stiffness(k, scenes["nu"], scenes["modulus"], scenes["c0_over_R"])
    limit = short_waves.dissipated_energy(k, material, wavelength, A, np.inf)
    waves = short_waves.end_of_folds(k, wavelength, A) / wavelength
    allowed = 4.0 / (chi * waves) + 1e-12
    known = _valid(result) & (waves > 1e5) & (chi < 0.9) & (allowed < 0.05)
    return np.where(known, np.abs(result["dissipated_energy"] / limit - 1.0) / allowed, 0.0)


CHECKS: Final[tuple[Callable[[Scenes], Excess], ...]] = (
    values_or_status, energy_not_negative, force_does_not_fall, energy_is_continuous, energy_is_constant_on_branches,
    similarity, one_ulp, many_waves_lose_what_short_ones_do,
)  # fmt: skip


SIZE, SEED = int(os.environ.get("STRESS_SCENES", "250")), int(os.environ.get("STRESS_SEED", "1"))
CHUNK = 5000
"""Scenes that are solved at once, at most."""
WALKED = 70.0
"""Waves of a curve that is walked one by one; the checks of longer ones stand in the second half of the draws."""
DRAWS: dict[str, Callable[[int, int], Scenes]] = {
    "hostile": lambda seed, size: hostile(seed, 2 * size, WALKED),
    "eventful": lambda seed, size: eventful(seed, 2 * size, WALKED),
    "hostile, long": hostile,
    "eventful, long": eventful,
}


@pytest.mark.parametrize("draw", DRAWS)
@pytest.mark.parametrize("check", CHECKS, ids=lambda check: str(check.__name__))
def test_it_holds(check: Callable[[Any], Any], draw: str) -> None:
    for drawn in range(0, SIZE, CHUNK):
        scenes = DRAWS[draw](SEED + drawn, min(CHUNK, SIZE - drawn))
        excess = check(scenes)
        for i in np.flatnonzero(~(excess <= 1.0)):
            pytest.fail(f"{excess[i]:.3g}: { {name: float(values[i]) for name, values in scenes.items()} }")


def test_cost_and_memory_are_bounded() -> None:
    """No scene hangs or asks for memory without bound: the limits are wide, and a wall that is hit is a failure."""
    script = (
        "import resource, numpy as np\n"
        "from gradhesion.core import solve, OUTPUTS\n"
        "from tests.stress.draw import hostile, eventful\n"
        "solve(hostile(3, 50), OUTPUTS, threads=1)\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "for draw in (hostile, eventful):\n"
        "    solve(draw(2, 600), OUTPUTS, threads=1)\n"
        "print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)\n"
    )
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300, check=True)
    assert float(done.stdout) < 64.0, f"{done.stdout} MiB for 1,200 scenes"


def test_beyond_all_bounds_it_ends() -> None:
    """Any positive doubles have values, or a status that says why not, and none hang; without a value there is no report."""
    rng, size = np.random.default_rng(4), 600
    scenes = {"k": rng.choice([0.0, 1e-16, 0.3, 0.7, 1.0 - 1e-12, 1.0], size), "nu": rng.choice([-0.9, 0.3, 0.5], size)}
    for name in ("modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R"):
        wild = 10.0 ** rng.uniform(-300, 300, size)
        scenes[name] = np.where(rng.uniform(size=size) < 0.4, wild, 10.0 ** rng.uniform(-6, 2, size))
    for endless in ({}, {"a_max_over_R": np.full(size, np.inf)}):
        assert np.all(values_or_status(scenes | endless) <= 1.0)
    result = solve(scenes, REPORTS)
    failed = (result["status"] & NO_VALUE) != 0
    assert 0.1 < np.mean(failed) < 0.9
    assert np.isnan([result[name][failed] for name in REPORTS]).all()
