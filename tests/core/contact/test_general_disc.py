"""Does loading keep the contact one disc? Against the gap itself at many states, for any profile and control."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.special import gamma

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.contact.disc import disc_limits, is_surely_open, jump_is_one_disc
from gradhesion.core.contact.gap import opening
from gradhesion.core.contact.least import least_opening
from gradhesion.core.curve.branches import END, END_DEPTH, START_DEPTH
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.face import edge_at
from gradhesion.core.path.general import walk
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC

pytestmark = pytest.mark.slow

EXPONENTS = [0.0, 0.3, 0.7, 0.95, 1.0]
MARGIN = 0.005
"""Least openings as near to 0 as this are not decided by 45 radii a wave: the parabola between two is 0.002."""
CONTROLS = [Loading(), Loading(control="load"), Loading(control="machine")]


def _branches(basis: Any, curve: Any, rim: float) -> tuple[int, Any]:
    first, last = first_fold_bound(basis, curve) / (2 * math.pi), last_fold_bound(basis, curve) / (2 * math.pi)
    count, trace, _ = walk(basis, curve, (first, last), rim, False)
    return count, trace


def _strength(k: float, rows: Any) -> float:
    """C sum h_n n^c: times the gain it is about the chi of a series."""
    amplitude = 2 ** (0.5 * (k - 1)) * gamma(0.5 * (k + 1))
    return float(amplitude * np.sum(np.hypot(rows[:, 1], rows[:, 2]) * rows[:, 0] ** (0.5 * (1 - k))))


def _draw(rng: Any, k: float) -> tuple[Any, Any, float]:
    """A curve of any power, series and control, about which it is open whether it keeps one disc, and its rim."""
    phase, random = rng.uniform(-0.5, 0.9), rng.normal(size=(3, 2))
    series = [
        [(1, 1.0, 0.0)],
        [(1, math.cos(phase), math.sin(phase))],
        [(1, 1.0, 0.0), (3, 1 / 9, 0.0)],
        [(1, 1.0, 0.0), (2, rng.uniform(0.0, 1.0), rng.uniform(0.0, 0.3))],
        [(n, float(even) / n**1.5, 0.4 * float(odd) / n**1.5) for n, (even, odd) in enumerate(random, 1)],
    ]
    rows = np.array(series[rng.integers(len(series))])
    chi = 10 ** rng.uniform(-0.5, 0.3) if rng.random() < 0.5 else rng.uniform(0.5, 1.3)
    m = float(rng.choice([1.0, 1.5, 2.0, 3.0, 4.7]))
    waves = 2 * math.pi * 10 ** rng.uniform(0, 1.5)
    share = float(rng.choice([0.0, 1.0, rng.uniform(0.01, 0.9)]))
    bend = waves ** -(m - 1 + 0.5 * (1 + k)) * rng.uniform(0.5, 1.5)
    return Series(bend, m, chi / _strength(k, rows), 1 - share, share), rows, rng.uniform(0.6, 3.6)


@pytest.mark.parametrize("k", EXPONENTS)
def test_against_the_gap_at_many_states(k: float, truth: Any) -> None:
    """Fifty curves an exponent, from few folds to many, under every control; unloading is always one disc."""
    rng = np.random.default_rng(int(1000 * k) + 1)
    discs, undecided = [], 0
    for _ in range(50):
        curve, rows, rim = _draw(rng, k)
        basis = Basis(*tables_of(k), rows)
        one = disc_limits(basis, curve, *_branches(basis, curve, rim), rim) == (math.inf, math.inf)
        slow = truth(k, curve, rows, rim)
        assert slow.least(unloading=True) > 0.0, (curve, rows, rim)
        profile = slow.profile(np.concatenate([np.geomspace(1e-9, 1e-2, 200), slow.z])).min()
        least = slow.least(unloading=False)
        if abs(least) < MARGIN or -1e-4 * curve[2] < profile < 0.0:
            undecided += 1
            continue
        assert one == (least > 0.0 and profile >= 0.0), (curve, rows, rim, least, profile)
        discs.append(one)
    assert undecided < 5
    assert 8 < sum(discs) < len(discs) - 5


def _scenes(count: int, seed: int, profile: Profile) -> dict[str, Any]:
    """Scenes of chi about 0.45 to 2.2."""
    rng = np.random.default_rng(seed)
    k = rng.choice([0.0, 1e-7, 0.23, 0.5, 0.71, 0.94, 1.0], count)
    nu, modulus = np.where(k == 1.0, 0.5, 0.27), 10.0 ** rng.uniform(1.5, 4.0, count)
    c0, wavelength = 10.0 ** rng.uniform(-2.0, 0.0, count), 10.0 ** rng.uniform(-1.7, -0.3, count)
    rows = np.array([(h.n, h.cos, h.sin) for h in profile.harmonics])
    stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / stiffness(k, nu, modulus, c0))
    unit = stretch * (wavelength / (2 * math.pi)) ** (0.5 * (1.0 - k)) / wavelength
    strength = np.array([_strength(each, rows) for each in k])
    return {
        "k": k,
        "nu": nu,
        "modulus": modulus,
        "c0_over_R": c0,
        "lambda_over_R": wavelength,
        "A": 10.0 ** rng.uniform(-0.35, 0.35, count) * unit / strength,
        "a_max_over_R": np.where(rng.random(count) < 0.1, np.inf, wavelength * 10.0 ** rng.uniform(-0.3, 1.2, count)),
    }


def _flags(result: dict[str, Any]) -> Any:
    return (result["status"] & LOADING_NOT_ONE_DISC) != 0


def test_one_cosine_is_what_its_own_solver_finds() -> None:
    scenes = _scenes(400, 21, Profile())
    special = _flags(solve(scenes, ["dissipated_energy"]))
    general = solve_general(scenes, ["dissipated_energy"], Profile(), Loading(), 2)
    found = np.isfinite(general["dissipated_energy"])
    assert found.sum() > 380
    assert np.array_equal(special[found], _flags(general)[found])
    assert 100 < special.sum() < 300


@pytest.mark.parametrize("m", [1.0, 2.0, 3.0])
@pytest.mark.parametrize("loading", CONTROLS, ids=[each.control for each in CONTROLS])
def test_scaling(m: float, loading: Loading) -> None:
    """All radii times 2^j and all heights times 2^(m j): every product with a power of 2 is exact."""
    profile = Profile(exponent=m, harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2, sin=0.1)))
    scenes = _scenes(60, 22, profile)
    if loading.control == "machine":
        scenes["machine_stiffness"] = 10.0 ** np.random.default_rng(23).uniform(-2, 1, 60)
    scaled = dict(scenes)
    for name, power in {
        "modulus": 1 - 2 * m,
        "c0_over_R": 1,
        "lambda_over_R": 1,
        "A": m - 1,
        "a_max_over_R": 1,
        "machine_stiffness": 1,
    }.items():
        if name in scenes:
            scaled[name] = scenes[name] * 4.0**power
    one = solve(scenes, ["delta_max"], profile=profile, loading=loading)
    other = solve(scaled, ["delta_max"], profile=profile, loading=loading)
    assert np.array_equal(one["status"], other["status"])
    assert 4 < _flags(one).sum() < 50


@pytest.mark.parametrize("k", [0.0, 0.4, 0.9])
def test_long_jumps(k: float) -> None:
    """Many windows, parts of which need the whole integral: the least opening against openings at 40 radii a wave."""
    rng = np.random.default_rng(int(1000 * k) + 3)
    signs = []
    for _ in range(40):
        rows = np.array([(1.0, rng.uniform(0.0, 0.5), 0.0), (12.0, rng.uniform(0.02, 0.1), 0.01)])
        basis = Basis(*tables_of(k), rows)
        curve = Series(10 ** rng.uniform(-6, -3), 2.0, rng.uniform(0.5, 1.7) / _strength(k, rows), 1.0, 0.0)
        start, end = rng.uniform(0.2, 1.3), rng.uniform(1.5, 6.0)
        edge = edge_at(basis, curve, start)
        dense = min(opening(basis, curve, edge, r) for r in np.arange(start + 1e-3, end, 1 / 12 / 40))
        found = least_opening(basis, curve, start, end)
        if abs(dense) > MARGIN:
            assert (found < 0.0) == (dense < 0.0)
            # the parabola through 17 openings of a window
            assert found < 0.0 or found <= dense + 0.03
            signs.append(found < 0.0)
    assert 3 < sum(signs) < len(signs) - 3


@pytest.mark.parametrize("k", [0.0, 0.6, 1.0])
def test_what_is_surely_open_is_open(k: float) -> None:
    """The bound of the fall of the coordinate against the opening itself, for jumps of loading under every control."""
    rng = np.random.default_rng(int(1000 * k) + 4)
    sure = 0
    for _ in range(60):
        curve, rows, rim = _draw(rng, k)
        basis = Basis(*tables_of(k), rows)
        count, trace = _branches(basis, curve, rim)
        for branch in range(count - 1):
            left, level = trace[END, branch], trace[END_DEPTH, branch]
            later = trace[:, branch + 1 : count]
            higher = np.flatnonzero(later[END_DEPTH] > level)
            if not higher.size:
                continue
            lowest = later[START_DEPTH, : higher[0] + 1].min()
            if is_surely_open(basis, curve, left, level - lowest):
                places = np.linspace(left, later[END, higher[0]], 60)[1:]
                places = [x for x in places if coordinate(basis, curve, x) <= level]
                edge = edge_at(basis, curve, left)
                assert min(opening(basis, curve, edge, x) for x in places) >= 0.0
                assert jump_is_one_disc(basis, curve, left, places[-1])
                sure += 1
    assert sure > 12


def test_a_choice() -> None:
    """The check can be left out, and says nothing of the pull-off alone."""
    profile = Profile(harmonics=(Harmonic(n=1), Harmonic(n=2, cos=-0.9)))  # its curvature at the centre is negative
    scene = {
        "k": 0.3,
        "nu": 0.2,
        "modulus": 1000.0,
        "c0_over_R": 0.1,
        "lambda_over_R": 0.1,
        "A": 0.1,
        "a_max_over_R": 0.5,
    }
    for loading in CONTROLS[:2]:
        told = {"profile": profile, "loading": loading}
        assert _flags(solve(scene, ["dissipated_energy"], **told))
        assert _flags(solve(scene, ["delta_max"], **told))
        assert not _flags(solve(scene, ["dissipated_energy"], check_contact=False, **told))
        assert not _flags(solve(scene, ["pull_off_force", "pull_off_radius"], **told))
