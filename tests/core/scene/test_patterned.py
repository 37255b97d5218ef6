"""Cycles on an interface whose toughness varies with the radius: reference values, a slow solver, identities, limits."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, Harmonic, Loading, Profile, solve
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_VALUE,
    TOO_MANY_WAVES,
)
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic, lowest, rows_of_pattern
from tests.core.slow_pattern import SlowScene

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "moving_edge.json").read_text())["patterns"]
ONE = Toughness((ToughnessHarmonic(n=1, cos=0.6, sin=0.8),))
WORK = Toughness(ONE.harmonics, "work")
TWO = Toughness((ToughnessHarmonic(n=1, cos=0.3, sin=0.4), ToughnessHarmonic(n=3, sin=0.3)))
SCENE = {
    "k": 0.23,
    "nu": 0.3,
    "modulus": 400.0,
    "c0_over_R": 0.05,
    "lambda_over_R": 0.11,
    "A": 0.004,
    "a_max_over_R": 0.47,
    "toughness_wavelength_over_R": 0.07,
    "toughness_amplitude": 0.5,
}
CYCLE = tuple(name for name in OUTPUTS if name != "turning_radius")


def same(found: Any, expected: Any, rel: float) -> None:
    for name in CYCLE:
        assert np.asarray(found[name]) == pytest.approx(np.asarray(expected[name]), rel=rel), name


def pattern_area(pattern: Toughness, wavelength: float, radius: float) -> float:
    """Integrate 2 pi r kappa^2 over the contact, by Gauss's rule on every sixteenth of the wavelength."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    edges = np.linspace(0.0, radius, 2 + int(16.0 * radius / wavelength))
    half = 0.5 * np.diff(edges)[:, None]
    r = edges[:-1, None] + half * (1.0 + nodes)
    phase = 2.0 * math.pi * r / wavelength
    t = 1.0 + sum(h.cos * np.cos(h.n * phase) + h.sin * np.sin(h.n * phase) for h in pattern.harmonics)
    return float(np.sum(half * weights * 2.0 * math.pi * r * (t * t if pattern.of == "toughness" else t)))


@pytest.mark.parametrize("name", REFERENCE)
def test_reference_cycles(name: str) -> None:
    """Two works are two cycles: loading at the work of closing, unloading at that of opening, and what the edge takes."""
    given, expected = REFERENCE[name]["input"], REFERENCE[name]["result"]
    ratio, rows = given.get("ratio", 1.0), given.get("toughness") or given["works"]
    harmonics = tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd, _ in rows)
    pattern, wavelength = Toughness(harmonics, "toughness" if "toughness" in given else "work"), rows[0][3]
    scene = {key: given[key] for key in ("k", "nu", "modulus", "A")} | {"toughness_wavelength_over_R": wavelength}
    scene |= {"c0_over_R": given["c0"], "lambda_over_R": given["lam"], "a_max_over_R": given.get("end", math.inf)}
    turn = {"indentation_max_over_R": given["turn"]} if "turn" in given else {}
    closed = solve(scene | turn | {"modulus": given["modulus"] / ratio}, OUTPUTS, toughness=pattern, threads=1)
    radius = float(closed["turning_radius"])
    opened = solve(scene | {"a_max_over_R": radius}, OUTPUTS, toughness=pattern, threads=1)
    found = opened | {name: closed[name] for name in ("loading_jumps", "delta_max", "turning_radius")}
    found["loading_energy"] = ratio * closed["loading_energy"]
    found["front_energy"] = (1.0 - ratio) * pattern_area(pattern, wavelength, radius)
    found["dissipated_energy"] = found["loading_energy"] + found["unloading_energy"] + found["front_energy"]
    found["depth_at_separation"] = found["delta_jump_out"]
    for key, value in expected.items():
        if key in found:
            assert float(found[key]) == pytest.approx(float(value), rel=1e-13, abs=1e-15), key


def drawn(seed: int) -> tuple[dict[str, float], Toughness, Profile, Loading, SlowScene, str]:
    """Draw a scene of any kind, and make the slow solver for it."""
    rng = np.random.default_rng(seed)
    of, control, turn = (
        ("toughness", "work")[seed % 2],
        ("displacement", "machine", "load")[seed % 3],
        ("", "depth", "load"),
    )
    numbers = rng.choice(np.arange(1, 5), rng.integers(1, 4), replace=False).tolist()
    rows = [(n, rng.normal(), rng.normal()) for n in numbers]
    pattern = Toughness(tuple(ToughnessHarmonic(n=n, cos=even, sin=odd) for n, even, odd in rows), of)
    least = -lowest(rows_of_pattern(pattern))
    amplitude = (1.0 if of == "toughness" and seed % 4 == 0 else rng.uniform(0.05, 0.95)) / least
    k, rim = float(rng.choice([0.0, 0.1, 0.5, 0.9, 1.0])), rng.uniform(0.2, 0.9)
    waves = ((1.0, 1.0, 0.0),) if seed % 2 else ((1.0, 0.7, 0.2), (3.0, 0.2, -0.1))
    profile = Profile(
        exponent=float(rng.choice([1.5, 2.0, 3.0])),
        harmonics=tuple(Harmonic(n=int(n), cos=even, sin=odd) for n, even, odd in waves),
    )
    scene = {
        "k": k,
        "nu": 0.5 if k == 1.0 else rng.uniform(0.0, 0.5),
        "modulus": 10 ** rng.uniform(1.5, 3.0),
        "c0_over_R": 10 ** rng.uniform(-2.0, 0.0),
        "lambda_over_R": 10 ** rng.uniform(-1.0, 0.0),
        "A": 10 ** rng.uniform(-3.5, -1.8) if seed % 5 else 0.0,
        "a_max_over_R": rim,
        "toughness_wavelength_over_R": rim * 10 ** rng.uniform(-1.2, 0.0),
        "toughness_amplitude": amplitude,
    }
    spring = {"displacement": math.inf, "load": 0.0}.get(control, 0.3 * scene["modulus"])
    slow = SlowScene(
        k,
        scene["nu"],
        scene["modulus"],
        scene["c0_over_R"],
        scene["lambda_over_R"],
        scene["A"],
        [(n, amplitude * even, amplitude * odd) for n, even, odd in rows],
        scene["toughness_wavelength_over_R"],
        of,
        profile.exponent,
        waves,
        spring,
        40_000,
    )
    return (
        scene | ({"machine_stiffness": 0.3} if control == "machine" else {}),
        pattern,
        profile,
        Loading(control=control),
        slow,
        turn[seed % 7 % 3],
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_the_slow_solver(seed: int) -> None:
    """Of 200 such scenes all counts agree, and energies to 2.4e-14 of their sizes."""
    scene, pattern, profile, loading, slow, turn = drawn(seed)
    radius, target = scene["a_max_over_R"], 0.0
    if turn:
        target = float(slow.pair(0.6 * radius)[turn == "load"])
        radius = slow.turning(target, turn == "load", radius)
        scene |= {"load_max": target / (1.5 * math.pi)} if turn == "load" else {"indentation_max_over_R": target}
    found = solve(scene, OUTPUTS, toughness=pattern, profile=profile, loading=loading, threads=1)
    expected = slow.cycle(radius)
    assert float(found["turning_radius"]) == pytest.approx(radius, rel=1e-12)
    size = abs(expected["loading_energy"]) + abs(expected["unloading_energy"])
    for name, value in expected.items():
        if name.endswith("energy"):
            assert float(found[name]) == pytest.approx(value, abs=1e-12 * size), name
        elif not (name == "delta_max" and turn):  # the target itself where depth is what is prescribed
            rel = {"pull_off_radius": 1e-7, "delta_jump_out": 1e-8}.get(name, 1e-11)
            assert float(found[name]) == pytest.approx(value, rel=rel, abs=1e-14), name


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("turn", [{}, {"indentation_max_over_R": 0.1}, {"load_max": 2.0}])
def test_without_amplitude_the_interface_is_plain(control: str, turn: dict[str, float]) -> None:
    machine = {"machine_stiffness": 0.2} if control == "machine" else {}
    scene = {**SCENE, **turn, **machine, "A": np.array([0.0, 0.004, 0.02])}
    plain = {name: value for name, value in scene.items() if not name.startswith("toughness")}
    for pattern in (ONE, WORK):
        found = solve(
            scene | {"toughness_amplitude": 0.0}, OUTPUTS, toughness=pattern, loading=Loading(control=control)
        )
        expected = solve(plain, OUTPUTS, loading=Loading(control=control))
        same(found, expected, 1e-13)
        assert found["status"].tolist() == expected["status"].tolist()
        assert found["turning_radius"] == pytest.approx(expected["turning_radius"], rel=1e-14)


@pytest.mark.parametrize("pattern", [ONE, WORK], ids=["toughness", "work"])
def test_a_pattern_far_longer_than_the_contact_scales_the_work(pattern: Toughness) -> None:
    far = {**SCENE, "toughness_wavelength_over_R": 1e18}
    t = 1.0 + 0.5 * 0.6
    work = t * t if pattern is ONE else t
    found = solve(far, OUTPUTS, toughness=pattern)
    plain = {name: value for name, value in SCENE.items() if not name.startswith("toughness")}
    expected = solve(plain | {"modulus": SCENE["modulus"] / work}, OUTPUTS)
    for name in ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy"):
        expected[name] = work * expected[name]
    same(found, expected, 1e-13)


def test_similarity() -> None:
    """At fixed k three lengths over that of contact, L, are all there is, and that of the pattern."""
    k = 0.4
    changes = {"nu": 0.1, "modulus": 70.0, "c0_over_R": 0.3}
    M = [float(stiffness(k, s["nu"], s["modulus"], s["c0_over_R"])) for s in (SCENE, SCENE | changes)]
    ratio = (M[0] / M[1]) ** (1.0 / (3.0 + k))
    other = SCENE | changes | {"A": SCENE["A"] * ratio}
    other |= {name: SCENE[name] * ratio for name in SCENE if name.endswith("_over_R") and not name.startswith("c0")}
    one, two = (solve(scene | {"k": k}, OUTPUTS, toughness=TWO) for scene in (SCENE, other))
    for name in ("pull_off_force", "loading_jumps", "unloading_jumps"):
        assert two[name] == pytest.approx(one[name], rel=1e-13)
    for name in ("dissipated_energy", "delta_max", "delta_jump_out"):
        assert two[name] == pytest.approx(one[name] * ratio**2, rel=1e-12)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_the_load_of_short_waves_is_that_of_a_pattern(k: float) -> None:
    """kappa = 1 - chi sin(2 pi r/lambda - (1+k) pi/4) has exactly the load of the asymptotic solver."""
    nu, phase = 0.5 if k == 1.0 else 0.3, 0.25 * (1.0 + k) * math.pi
    scene = SCENE | {"k": k, "nu": nu, "toughness_wavelength_over_R": SCENE["lambda_over_R"], "a_max_over_R": math.inf}
    M = float(stiffness(k, nu, scene["modulus"], scene["c0_over_R"]))
    per_amplitude = math.pi ** (0.5 * (1 - k)) * math.gamma(0.5 * (1 + k)) * scene["lambda_over_R"] ** (0.5 * (1 + k))
    chi = scene["A"] * per_amplitude / math.sqrt(2 ** (1 + k) * math.pi / M)
    waves = Toughness((ToughnessHarmonic(n=1, cos=math.sin(phase), sin=-math.cos(phase)),))
    plain = {name: value for name, value in scene.items() if not name.startswith("toughness")}
    expected = solve(plain, ["pull_off_force", "pull_off_radius"], solver="asymptotic")
    found = solve(
        scene | {"A": 0.0, "toughness_amplitude": chi}, ["pull_off_force", "pull_off_radius"], toughness=waves
    )
    assert float(found["pull_off_force"]) == pytest.approx(float(expected["pull_off_force"]), rel=1e-12)
    assert float(found["pull_off_radius"]) == pytest.approx(float(expected["pull_off_radius"]), rel=1e-8)


@pytest.mark.parametrize("pattern", [TWO, Toughness(TWO.harmonics, "work")], ids=["toughness", "work"])
def test_rims_that_share_a_curve_have_the_results_of_each_alone(pattern: Toughness) -> None:
    rims = np.array([0.02, 0.13, 0.21, 0.34, 0.47, 0.9, math.inf])
    together = solve(SCENE | {"a_max_over_R": rims}, OUTPUTS, toughness=pattern)
    for i, rim in enumerate(rims.tolist()):
        alone = solve(SCENE | {"a_max_over_R": rim}, OUTPUTS, toughness=pattern)
        same({name: values[i] for name, values in together.items()}, alone, 1e-14)
        assert together["status"][i] == alone["status"]
    assert together["status"][0] & JUMP_IN_TO_RIM
    assert together["status"].dtype == np.int16


def test_a_centre_without_adhesion() -> None:
    """Contact grows from a point and shrinks to one: nothing pulls, nothing is lost; whether it jumps there is rounding."""
    pattern = Toughness((ToughnessHarmonic(n=1, cos=-1.0),))
    scene = SCENE | {"A": 0.0, "toughness_amplitude": 1.0, "toughness_wavelength_over_R": 3.0, "a_max_over_R": 0.2}
    found = solve(scene, OUTPUTS, toughness=pattern)
    assert float(found["pull_off_force"]) == 0.0
    assert np.isnan(found["pull_off_radius"])
    assert found["status"] & CLOSE_TO_A_JUMP
    for name in ("dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out"):
        assert abs(float(found[name])) < 1e-18, name


def test_waves_are_followed_to_ten_thousand() -> None:
    """Fine waves of chi on a smooth punch lose 4 pi chi a^2 beyond it, less by the order of their length (section 10)."""
    scene = SCENE | {"A": 0.0, "k": 0.0, "toughness_amplitude": 0.3, "toughness_wavelength_over_R": 5e-5}
    found = solve(scene | {"a_max_over_R": 0.5}, OUTPUTS, toughness=ONE)
    assert found["status"] == 0
    assert min(int(found[name]) for name in ("loading_jumps", "unloading_jumps")) > 6_000
    plain = {name: value for name, value in scene.items() if not name.startswith("toughness")} | {"a_max_over_R": 0.5}
    up, down = (solve(plain | {"modulus": scene["modulus"] / w}, OUTPUTS) for w in (0.7**2, 1.3**2))
    limit = 0.7**2 * up["loading_energy"] + 1.3**2 * down["unloading_energy"] + math.pi * 0.25 * (1.3**2 - 0.7**2)
    assert float(found["dissipated_energy"]) == pytest.approx(float(limit), rel=2e-2)
    assert float(found["pull_off_force"]) == pytest.approx(1.3**2, rel=1e-7)
    scene |= {"toughness_wavelength_over_R": 5e-6, "a_max_over_R": np.array([0.01, 0.5])}
    found = solve(scene, OUTPUTS, toughness=ONE)
    assert found["status"].tolist()[1] == NO_VALUE | TOO_MANY_WAVES
    assert not found["status"][0] & NO_VALUE, "a rim that is near enough has its values"
    turned = solve(scene | {"a_max_over_R": 0.5, "load_max": 30.0}, ["dissipated_energy"], toughness=ONE)
    assert int(turned["status"]) == NO_VALUE | TOO_MANY_WAVES


def test_what_has_no_value() -> None:
    strong = {**SCENE, "toughness_amplitude": np.array([0.5, 1.2, np.nan]), "a_max_over_R": np.array([[0.02], [0.4]])}
    found = solve(strong, OUTPUTS, toughness=WORK)
    assert ((found["status"] & NO_VALUE) != 0).tolist() == [[False, False, True], [False, True, True]]
    assert np.isnan(found["pull_off_force"][1, 1])
    near = solve(SCENE | {"toughness_amplitude": 1.2, "a_max_over_R": 0.02}, CYCLE, toughness=WORK)
    assert float(found["dissipated_energy"][0, 1]) == pytest.approx(float(near["dissipated_energy"]), rel=1e-14)
    outside = solve(
        SCENE | {"toughness_wavelength_over_R": np.array([0.0, -1.0, np.inf, np.nan])}, CYCLE, toughness=ONE
    )
    assert (outside["status"] == NO_VALUE).all()
    for change in ({"solver": "asymptotic"}, {"toughness": None}):
        with pytest.raises(ValueError, match="pattern of toughness"):
            solve(SCENE, **({"toughness": ONE} | change))  # type: ignore[arg-type]


def test_contact_that_is_not_one_disc() -> None:
    """A stiff half-space does not follow the waves of the punch; a smooth punch is one disc on any interface."""
    stiff = SCENE | {"modulus": 1e7, "k": 0.0, "A": np.array([0.0, 0.02])}
    found = solve(stiff, ["dissipated_energy"], toughness=ONE)
    assert ((found["status"] & LOADING_NOT_ONE_DISC) != 0).tolist() == [False, True]
