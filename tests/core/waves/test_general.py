"""Sums over regular waves of general scenes: against walking them, one cosine, similarity, and limits of the machine."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import compliance_of
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.contact.disc import disc_limits
from gradhesion.core.curve.branches import START_DEPTH
from gradhesion.core.curve.general import Basis, coordinate, curve_of, state
from gradhesion.core.curve.general_energy import drop, energy_from_zero, jump_energy, place_left
from gradhesion.core.curve.general_folds import room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.harmonics.series import sums
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import walk
from gradhesion.core.path.general_long import Tasks, stride
from gradhesion.core.path.general_middle import REGULAR, middle_of
from gradhesion.core.path.loading import highest_depth, loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import RESULTS
from gradhesion.core.problem.shape import depth_factor_of, rows_of
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE
from gradhesion.core.pull_off.general import deepest_wave, lowest_load
from gradhesion.core.waves.general import Waves, branches_of_wave, cut_of, room_for_waves, step_of_wave
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero

pytestmark = pytest.mark.slow

EPS = float(np.finfo(float).eps)
SCENE = {"k": 0.3, "nu": 0.27, "modulus": 1e3, "c0_over_R": 0.1, "lambda_over_R": 1e-3, "A": 1e-2, "a_max_over_R": 0.7}
PAIR = (Harmonic(n=1, cos=0.6, sin=-0.3), Harmonic(n=2, cos=-0.2, sin=0.25))
ODD = (Harmonic(n=1, cos=1.0, sin=0.4), Harmonic(n=3, cos=0.3, sin=0.1), Harmonic(n=5, cos=-0.1))
HIGH = (Harmonic(n=2, cos=0.5), Harmonic(n=7, cos=0.1, sin=0.1), Harmonic(n=8, cos=1.0, sin=-0.1))
ROUGH = tuple(Harmonic(n=n, cos=math.cos(n * n) * n**-1.6, sin=math.sin(n * n) * n**-1.6) for n in range(1, 9))


def _amplitude(chi: float, scene: dict[str, float]) -> float:
    """Give A of a cosine whose waves have the amplitude chi in the depth over the stretch."""
    k = scene["k"]
    M = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    stretch = math.sqrt(2 ** (1 + k) * math.pi / M)
    return (
        chi
        * stretch
        / (math.pi ** (0.5 * (1 - k)) * math.gamma(0.5 * (1 + k)) * scene["lambda_over_R"] ** (0.5 * (1 + k)))
    )


def _curve(
    k: float, m: float, harmonics: Any, control: str, waves: float, chi: float, machine: float = 1.0
) -> tuple[Any, Any, float]:
    """Return basis, curve, and rim over wavelength of a scene with some waves on it."""
    scene = SCENE | {"k": k, "nu": 0.5 if k == 1.0 else 0.27, "lambda_over_R": 0.8 / waves}
    profile, loading = Profile(exponent=m, harmonics=harmonics), Loading(control=control)
    M = stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"])
    spring = [np.array(machine)] if control == "machine" else []
    compliance = float(compliance_of(loading, np.array(k), np.array(scene["modulus"]), M, *spring))
    table, cosine_bins = tables_of(k)
    stretch = math.sqrt(2 ** (1 + k) * math.pi / float(M))
    numbers = (stretch, scene["lambda_over_R"], _amplitude(chi, scene), compliance)
    curve, _, _ = curve_of(k, m, depth_factor_of(k, m), *numbers)
    return Basis(table, cosine_bins, rows_of(profile)), curve, waves


@pytest.mark.parametrize("wavelength", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("k", [0.0, 0.3, 0.8, 1.0])
def test_one_cosine_is_what_its_own_solver_finds(k: float, wavelength: float) -> None:
    """The other solver sums by other means: arches, a lag, and moments with closed forms."""
    scene = SCENE | {"k": k, "nu": 0.5 if k == 1.0 else 0.27, "lambda_over_R": wavelength}
    amplitudes = [_amplitude(chi, scene) for chi in (0.05, 0.6, 2.0)]
    scenes: Any = scene | {"A": amplitudes}
    special = solve(scenes, OUTPUTS)
    general = solve_general(scenes, RESULTS, Profile(), Loading(), 1)
    for name in ("loading_jumps", "unloading_jumps"):
        assert np.array_equal(special[name], general[name]), name
    # 5e-13 where either sums, most of it the other's
    np.testing.assert_allclose(general["dissipated_energy"], special["dissipated_energy"], rtol=2e-12)
    np.testing.assert_allclose(general["pull_off_force"], special["pull_off_force"], rtol=20 * EPS)
    for name in ("delta_max", "delta_jump_out"):
        np.testing.assert_allclose(general[name], special[name], rtol=1e-14, atol=4 * EPS, err_msg=name)


@pytest.mark.parametrize("wavelength", [1e-7, 1e-8])
@pytest.mark.parametrize("k", [0.0, 0.8, 1.0])
def test_beyond_four_million_waves_both_solvers_agree(k: float, wavelength: float) -> None:
    """Both take phases from the part of a wave alone; folds, landings and sums each has its own way to."""
    scene = SCENE | {"k": k, "nu": 0.5 if k == 1.0 else 0.27, "lambda_over_R": wavelength}
    scenes: Any = scene | {"A": [_amplitude(chi, scene) for chi in (0.3, 0.8, 1.5)]}
    special = solve(scenes, ["dissipated_energy"])["dissipated_energy"]
    general = solve_general(scenes, ["dissipated_energy"], Profile(), Loading(), 1)["dissipated_energy"]
    np.testing.assert_allclose(special, general, rtol=1e-12)


@pytest.mark.parametrize(
    ("k", "m", "harmonics", "control", "waves", "chi"),
    [
        (0.3, 2.0, PAIR, "displacement", 9000.0, 0.6),
        (0.0, 2.0, ODD, "displacement", 6000.0, 0.15),
        (1.0, 3.0, HIGH, "displacement", 4000.0, 0.9),
        (0.7, 1.0, PAIR, "displacement", 9000.0, 0.5),
        (0.3, 2.0, ROUGH, "machine", 4000.0, 0.5),
        (0.0, 1.5, PAIR, "machine", 9000.0, 1.5),
        (0.6, 6.0, ODD, "load", 6000.0, 0.7),
        (0.0, 2.0, ROUGH, "load", 4000.0, 2.0),
    ],
)
def test_sums_are_walks(k: float, m: float, harmonics: Any, control: str, waves: float, chi: float) -> None:
    basis, curve, rim = _curve(k, m, harmonics, control, waves, chi)
    first, last = first_fold_bound(basis, curve) / TWO_PI, min(rim, last_fold_bound(basis, curve) / TWO_PI)
    middle = middle_of(basis, curve, first, last, 0.0)
    assert middle.kind == REGULAR
    done, up, down, _, one_disc, wholes, x = stride(
        basis, curve, first, middle, (rim, 0.0), Tasks(True, control != "load", True, False), np.empty((0, 5))
    )
    count, trace, _ = walk(basis, curve, (first, last), rim, True)
    assert done
    assert count > 0
    assert wholes > 0.0  # before the rim
    assert wholes + x == pytest.approx(rim, rel=1e-15)
    assert one_disc == (disc_limits(basis, curve, count, trace, rim) == (math.inf, math.inf))
    level = coordinate(basis, curve, rim)
    loss, jumps = loading_to(basis, curve, count, trace, rim, True)
    # the walk adds up 10^4 numbers, and its phases are rounded by 10^4 units
    assert up[1] == jumps
    assert up[0] == pytest.approx(loss, rel=1e-11)
    assert up[2] == pytest.approx(highest_depth(count, trace, rim, level), rel=1e-12)
    loss, jumps, depth = unloading_from(basis, curve, count, trace, rim, level, True)
    assert down[1] == jumps > 100
    assert down[0] == pytest.approx(loss, rel=1e-11)
    assert state(basis, curve, down[4], down[3])[3] == pytest.approx(depth, rel=1e-11)


@pytest.mark.parametrize("waves", [300.0, 1e3, 1e5, 1e7])
def test_a_jump_from_zero_contact_to_the_rim(waves: float) -> None:
    """At the depth 0, which is not that of the curve at the rim: what is left of a small punch is 2 pi a^2/(1+k)."""
    k, rim = 0.7, 1e-6
    scene: Any = SCENE | {"k": k, "a_max_over_R": rim, "lambda_over_R": rim / waves}
    scene |= {"A": _amplitude(1e-9, scene)}
    general = solve_general(scene, RESULTS, Profile(), Loading(), 1)
    assert (general["loading_jumps"], general["unloading_jumps"]) == (1, 1)
    # the punch's own share of the depth is (a/a_in)^((3+k)/2) of the stretch, here 1e-9
    assert general["dissipated_energy"] == pytest.approx(2.0 * math.pi * rim**2 / (1.0 + k), rel=1e-6)
    special = solve(scene, ["dissipated_energy"])
    assert general["dissipated_energy"] == pytest.approx(special["dissipated_energy"], rel=1e-13)


@pytest.mark.parametrize("control", ["displacement", "machine", "load"])
def test_long_jumps(control: str) -> None:
    """A jump over 10^4 waves against Gauss's rule in every one of them, outwards and inwards, and from zero contact."""
    basis, curve, _ = _curve(0.4, 2.0, PAIR, control, 1e4, 0.4)
    start, end = 37.3, 9000.7
    outwards = jump_energy(basis, curve, start, end, 0.0)
    assert jump_between(basis, curve, start, end, 0.0) == pytest.approx(outwards, rel=1e-11)
    inwards = jump_energy(basis, curve, end, start, 0.0)
    assert jump_between(basis, curve, end - 8990.0, start - 8990.0, 8990.0) == pytest.approx(inwards, rel=1e-11)
    if control == "load":  # from zero contact to another load than 0 the energy has no bound
        return
    level = coordinate(basis, curve, end, 0.0)
    from_zero = energy_from_zero(basis, curve, end, level)
    assert jump_from_zero(basis, curve, end, level, 0.0) == pytest.approx(from_zero, rel=1e-11)


def test_whole_waves_keep_the_phase() -> None:
    """What is at whole + x is what is at their sum as far as that tells the phase."""
    for k in (0.0, 0.4, 1.0):
        basis, curve, _ = _curve(k, 2.0, ROUGH, "machine", 1e3, 0.5)
        for whole in (8.0, 1000.0):
            for x in np.linspace(0.0, 1.0, 23)[:-1] + 2.0**-30:
                here = sums(*basis, whole + x, 0.0)
                size = max(abs(here[0]), abs(here[1]), whole**-0.5), max(abs(here[2]), abs(here[3]), whole**0.5)
                phase = 4 * EPS * TWO_PI * 8 * whole
                there = sums(*basis, x, whole)
                np.testing.assert_allclose(there[:2], here[:2], rtol=0, atol=phase * size[0])
                np.testing.assert_allclose(there[2:], here[2:], rtol=0, atol=8 * phase * size[1])
                levels = [coordinate(basis, curve, *place) for place in ((x, whole), (whole + x, 0.0))]
                assert levels[0] == pytest.approx(levels[1], rel=phase)


@pytest.mark.parametrize("kind", [0, 1, 2])
def test_a_wave_is_smooth_in_its_number(kind: int) -> None:
    """A polynomial through whole waves meets those between."""
    basis, curve, _ = _curve(0.4, 2.0, PAIR, "machine", 1e5, 0.6)
    work, cut = room_for_waves(basis[2]), cut_of(basis[0], basis[2])
    left = place_left(basis, curve, 0.3, 20_000.0)
    task = Waves(kind, cut, left, work)
    waves = np.arange(30_000.0, 30_010.0)
    steps = [step_of_wave(basis, curve, task, wave, True) for wave in waves]
    assert len({step[1:] for step in steps}) == 1
    fit = np.polynomial.Polynomial.fit(waves, [step[0] for step in steps], 4)
    for wave in (30_004.5, 30_006.13):
        assert step_of_wave(basis, curve, task, wave, True)[0] == pytest.approx(fit(wave), rel=1e-11)
    if kind == 2:
        whole = drop(basis, curve, left, 0.0, 1.0, waves[0])
        parts = drop(basis, curve, left, 0.0, 0.37, waves[0]) + drop(basis, curve, left, 0.37, 1.0, waves[0])
        assert whole == pytest.approx(parts, rel=1e-12)


@pytest.mark.parametrize("control", ["displacement", "machine", "load"])
@pytest.mark.parametrize("wavelength", [2e-6, 1.3e-5])
def test_similar_scenes(control: str, wavelength: float) -> None:
    """Lengths of the problem are in L (theory.md, section 6); a factor of 3 in L rounds everything anew."""
    loading, profile = Loading(control=control), Profile(harmonics=ODD)
    scene = SCENE | {"lambda_over_R": wavelength, "k": 0.4}
    scene["A"] = _amplitude(0.5, scene)
    factor, k = 1.1, scene["k"]
    other = {**scene, "modulus": scene["modulus"] * factor ** -(3.0 + k)}
    for name in ("lambda_over_R", "a_max_over_R"):
        other[name] = scene[name] * factor
    other["A"] = scene["A"] * factor
    if control == "machine":  # S over K a^(1+k) is a number; it is given in E* R
        scene["machine_stiffness"] = 0.4
        other["machine_stiffness"] = 0.4 * factor ** (1.0 + k)
    results = [solve(each, OUTPUTS, profile=profile, loading=loading, check_contact=False) for each in (scene, other)]
    units = {"dissipated_energy": 2, "pull_off_radius": 1, "delta_max": 2, "delta_jump_out": 2, "pull_off_force": 0}
    for name, power in units.items():
        # the phase at the rim is told to 10^6 units of rounding, and with it the depth there and the last jump
        assert float(results[1][name]) == pytest.approx(float(results[0][name]) * factor**power, rel=1e-9), name
    assert results[0]["unloading_jumps"] > 10_000
    for name in ("loading_jumps", "unloading_jumps"):
        assert abs(int(results[0][name]) - int(results[1][name])) <= 1, name


def test_machines_from_stiff_to_soft() -> None:
    profile, machine = Profile(exponent=3.0, harmonics=PAIR), Loading(control="machine")
    scene = SCENE | {"lambda_over_R": 1e-5}
    scene["A"] = _amplitude(0.5, scene)
    stiff, soft = (
        solve(scene | {"machine_stiffness": s}, OUTPUTS, profile=profile, loading=machine) for s in (1e14, 1e-14)
    )
    rigid = solve(scene, OUTPUTS, profile=profile)
    dead = solve(scene, OUTPUTS, profile=profile, loading=Loading(control="load"))
    assert rigid["unloading_jumps"] > 10_000
    for name in OUTPUTS:
        assert float(stiff[name]) == pytest.approx(float(rigid[name]), rel=1e-9), name
        if name not in ("dissipated_energy", "unloading_energy"):
            assert float(soft[name]) == pytest.approx(float(dead[name]), rel=1e-9), name
    spring = (1.5 * math.pi * float(dead["pull_off_force"])) ** 2 / (2.0 * 1e-14 * scene["modulus"])
    assert float(soft["dissipated_energy"]) == pytest.approx(spring, rel=1e-9)


@pytest.mark.parametrize("m", [1.0, 2.0, 4.0])
@pytest.mark.parametrize("waves", [3e3, 1e6])
def test_the_lowest_of_many_waves(m: float, waves: float) -> None:
    """No trough within a thousand waves of it is lower."""
    basis, curve, rim = _curve(0.3, m, PAIR, "load", waves, 0.3)
    lowest, place, second = lowest_load(basis, curve, rim, 0.0, room(), deepest_wave(basis[0], basis[2]))
    assert lowest <= second < 0.0
    work, cut = room_for_waves(basis[2]), cut_of(basis[0], basis[2])
    rows = work[2][0]
    centre = math.floor(place - cut)
    others = [
        rows[START_DEPTH, : branches_of_wave(basis, curve, float(wave), cut, work, rows)].min()
        for wave in range(max(centre - 1000, 8), min(centre + 1000, int(rim) - 1))
        if branches_of_wave(basis, curve, float(wave), cut, work, rows) > 0
    ]
    assert len(others) > 100
    assert min(others) >= lowest * (1.0 + 4 * EPS)


def test_endless_and_bounded_cones() -> None:
    """The waves of a cone never cease to fold: up to a rim they are summed, without one there is no sum."""
    cone = Profile(exponent=1.0, harmonics=PAIR)
    scene = SCENE | {"k": 0.0, "lambda_over_R": 1e-5}
    scene["A"] = _amplitude(0.5, scene)
    bounded = solve(scene, OUTPUTS, profile=cone)
    assert bounded["status"] & NO_VALUE == 0
    assert bounded["unloading_jumps"] > 10_000
    assert solve(scene | {"a_max_over_R": math.inf}, ["dissipated_energy"], profile=cone)["status"] & NO_VALUE


def test_rims_one_after_another() -> None:
    """The energy is continuous in the rim and grows by what a wave adds: differences of sums over 10^5 waves."""
    profile = Profile(harmonics=PAIR)
    scene = SCENE | {"lambda_over_R": 4e-6}
    scene["A"] = _amplitude(0.6, scene)
    rims = (150_000.25 + np.arange(40)) * scene["lambda_over_R"]
    result = solve(scene | {"a_max_over_R": rims}, OUTPUTS, profile=profile, check_contact=False)
    assert not np.any(result["status"] & (NO_VALUE | CLOSE_TO_A_JUMP))
    steps = np.diff(result["dissipated_energy"])
    jumps = np.diff(result["loading_jumps"] + result["unloading_jumps"])
    assert (jumps == jumps[0]).all()
    # what a wave adds grows as a power of its number, so that third differences are those of the sums' errors
    assert np.abs(np.diff(steps, 2)).max() <= 64 * EPS * result["dissipated_energy"][0]
