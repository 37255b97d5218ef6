"""Limits in which another theory, or another kind, has the same values."""

import math
from typing import Any

import numpy as np
import pytest

from .kinds import BY_NAME, EXACT, KINDS, SINES, Kind, Scenes, at, drawn, name_of, some
from .promises import SHARE, agree, errors
from .theory import stiffness, stretch, wave_size

SMOOTH: Scenes = {"nu": 0.3, "modulus": 500.0, "c0_over_R": 0.07, "lambda_over_R": 0.1, "A": 0.0}
EXPONENTS = np.array([0.0, 0.1, 0.37, 0.7, 0.96])


@pytest.mark.parametrize("waves", [((1, 1.0, 0.0),), SINES], ids=["cosine", "sines"])
@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_smooth_punches_are_those_of_jkr(control: str, waves: Any) -> None:
    """Force (3 + k)/3 at any modulus; at k = 0 Johnson, Kendall & Roberts' radius and depth at pull-off."""
    scene = SMOOTH | {"k": EXPONENTS, "modulus": np.array([[1.0], [700.0], [1e5]]), "a_max_over_R": np.inf}
    scene |= {"machine_stiffness": 0.3} if control == "machine" else {}
    found = Kind("smooth", control=control, waves=waves).solve(scene, ["pull_off_force", "pull_off_radius"])
    expected = np.broadcast_to((3 + EXPONENTS) / 3, (3, 5))
    np.testing.assert_allclose(found["pull_off_force"], expected, rtol=4 * SHARE)
    radius = (9 * np.pi / (8 * scene["modulus"][:, 0])) ** (1 / 3)  # of a^3 = 9 pi R^2 dgamma/(8 E*)
    np.testing.assert_allclose(found["pull_off_radius"][:, 0], radius, rtol=1e-6)


def smooth_loss(k: Any, s: Any) -> Any:
    """Energy of a smooth cycle, section 10: a jump into contact at depth 0 and one out at the fold of the depth."""

    def part(q: Any) -> Any:
        return 16 * q * q / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1

    q = (1 - k) / 4
    first, last = ((c * (1 + k) * s) ** (2 / (3 + k)) for c in (1.0, q))
    return np.pi * (part(q) * last**2 - part(1.0) * first**2)


@pytest.mark.parametrize("name", ["cosine", "two harmonics", "envelope of a cosine"])
def test_smooth_cycles_lose_their_closed_form(name: str) -> None:
    scene = {n: np.broadcast_to(v, 5) for n, v in (SMOOTH | {"k": EXPONENTS, "a_max_over_R": 1.5}).items()}
    found = BY_NAME[name].solve(scene)
    s = stretch(EXPONENTS, stiffness(EXPONENTS, 0.3, 500.0, 0.07))
    agree(BY_NAME[name], scene, dict(found) | {"dissipated_energy": smooth_loss(EXPONENTS, s)}, found, ["dissipated_energy"])


def test_a_smooth_punch_snaps_in_at_its_closed_form() -> None:
    """F_in = 8 (1 + k) Gamma/(3 (3 + k)) at any modulus, section 16."""
    ratio = np.array([[0.04], [0.5], [1.0]])
    found = Kind("smooth", ratio=True).solve(
        SMOOTH | {"k": EXPONENTS, "a_max_over_R": 2.0, "closing_ratio": ratio}, ["snap_in_force", "front_energy"]
    )
    expected = 8 * (1 + EXPONENTS) * ratio / (3 * (3 + EXPONENTS))
    np.testing.assert_allclose(found["snap_in_force"], expected, rtol=20 * SHARE)
    np.testing.assert_allclose(found["front_energy"], np.broadcast_to(np.pi * 4 * (1 - ratio), (3, 5)), rtol=1e-14)


@pytest.mark.parametrize(
    ("k", "c0", "rim", "force", "energy"),
    [(0.0, 1.0, 1.6, 1.2252120971, 1.42657111), (0.5, 0.1, 1.95, 1.1676276541, 0.874428597)],
)
def test_the_method_of_dimensionality_reduction(k: float, c0: float, rim: float, force: float, energy: float) -> None:
    """Another route to two scenes, by its authors in units of R = 1, dgamma = 1/pi, E* = 3/4."""
    scene = {"k": k, "nu": 0.3, "modulus": 0.75 * math.pi, "c0_over_R": c0, "lambda_over_R": 0.5, "A": 0.1}
    found = Kind("plain").solve(scene | {"a_max_over_R": rim})
    assert float(found["pull_off_force"]) * 3 / (3 + k) == pytest.approx(force, rel=1e-10)
    assert float(found["dissipated_energy"]) / math.pi == pytest.approx(energy, rel=1e-8)


@pytest.mark.parametrize("kind", [k for k in KINDS if not k.ratio], ids=name_of)
def test_one_work_is_two_equal_ones(kind: Kind) -> None:
    scenes, found = drawn(kind)
    one = scenes | {"closing_ratio": np.ones_like(scenes["k"])}
    agree(kind, scenes, at(kind, ratio=True).solve(one, kind.outputs), found)


@pytest.mark.parametrize("kind", [k for k in EXACT if not k.pattern and not k.unbounded], ids=name_of)
def test_a_pattern_without_amplitude_is_none(kind: Kind) -> None:
    scenes, found = drawn(kind)
    own = some(scenes, slice(60))
    flat = own | {"toughness_wavelength_over_R": 0.3 * own["a_max_over_R"], "toughness_amplitude": np.zeros(60)}
    for of in ("toughness", "work"):
        agree(kind, own, at(kind, pattern=of).solve(flat), some(found, slice(60)))


@pytest.mark.parametrize("kind", [k for k in EXACT if k.control == "machine"], ids=name_of)
def test_a_stiff_machine_prescribes_the_depth(kind: Kind) -> None:
    """What is prescribed is the depth + P/S; 1e-9 of it at the stiffest of the three, and a tenth of that change."""
    scenes = some(drawn(kind)[0], slice(60))
    plain = at(kind, control="displacement")
    expected = plain.solve({n: v for n, v in scenes.items() if n != "machine_stiffness"})
    bound = np.abs(expected["dissipated_energy"]) + np.pi * scenes["a_max_over_R"] ** 2
    last = None
    for stiff in (1e7, 1e9, 1e11):
        found = kind.solve(scenes | {"machine_stiffness": np.full(60, stiff)})
        sure = np.abs(found["turning_radius"] - expected["turning_radius"]) <= 1e-3 * scenes["a_max_over_R"]
        assert sure.mean() > 0.9  # a turn may pass a fold that the other control passes just not
        off = np.where(sure, np.abs(found["dissipated_energy"] - expected["dissipated_energy"]) / bound, 0.0).max()
        assert last is None or off <= max(0.03 * last, 1e-11)
        last = off
        agree(plain, scenes, found, expected, ["pull_off_force"], where=sure, more=1e4 / stiff)
    assert last is not None and last < 1e-7


@pytest.mark.parametrize("name", ["cosine, load", "sines, load"])
def test_a_soft_machine_prescribes_the_load(name: str) -> None:
    """All but the last jump, whose energy grows as 1/S."""
    kind = BY_NAME[name]
    scenes, expected = drawn(kind)
    soft = at(kind, control="machine").solve(scenes | {"machine_stiffness": np.full(scenes["k"].size, 1e-13)})
    agree(kind, scenes, soft, expected, ["pull_off_force", "loading_jumps", "unloading_jumps"])
    bound = np.abs(expected["loading_energy"]) + np.pi * scenes["a_max_over_R"] ** 2
    assert (np.abs(soft["loading_energy"] - expected["loading_energy"]) <= 1e-7 * bound).all()


def short(k: float, chi: float, ratio: float) -> Scenes:
    """A scene of a given lambda/L and chi = r/s with its rim at 4 L, beyond the pull-off of every chi up to 0.5."""
    M = float(stiffness(k, 0.3, 500.0, 0.07))
    length = M ** (-1 / (3 + k))
    wavelength = ratio * length
    A = chi * float(stretch(k, M) / wave_size(k, 1.0, wavelength))
    return SMOOTH | {"k": k, "lambda_over_R": wavelength, "A": A, "a_max_over_R": 4.0 * length}


@pytest.mark.parametrize("k", [0.0, 0.31, 0.8])
@pytest.mark.parametrize("waves", [((1, 1.0, 0.0),), ((1, 0.6, 0.8),)], ids=["cosine", "shifted"])
def test_short_waves_follow_their_envelopes(k: float, waves: Any) -> None:
    """Force -> (3 + k)/3 (1 + chi)^2 in proportion to lambda; energy -> that of the envelopes.

    The envelopes leave out the mean height lambda A of a cosine, by which the depth of the jump into contact is moved:
    it falls as lambda^((1-k)/2) at a given chi, and is compared with L^2, the depth that a smooth cycle has.
    """
    chi, off, allowed = 0.4, [], []
    kind = Kind("short", waves=waves)
    for ratio in (0.2, 0.02, 0.002):
        scene = short(k, chi, ratio)
        found, even = kind.solve(scene), at(kind, solver="envelope").solve(scene)
        assert float(even["pull_off_force"]) == pytest.approx((3 + k) / 3 * (1 + chi) ** 2, rel=1e-11)
        names = ("pull_off_force", "dissipated_energy")
        off.append([abs(float(found[name]) / float(even[name]) - 1) for name in names])
        length = scene["lambda_over_R"] / ratio
        allowed.append([ratio, 3 * ratio + scene["lambda_over_R"] * scene["A"] / length**2])
    assert (np.array(off) <= np.array(allowed)).all(), (off, allowed)
    assert (np.array(off[2]) <= 0.3 * np.array(off[0])).all(), off


@pytest.mark.parametrize("k", [0.0, 0.31, 0.8, 1.0])
def test_the_asymptotic_form_is_the_limit_of_the_exact_one(k: float) -> None:
    """A digit more for each decade of the wavelength."""
    off = []
    for ratio in (0.1, 0.01, 0.001):
        scene = short(k, 0.4, ratio) | ({"nu": 0.5} if k == 1.0 else {})
        values = [Kind("any", solver=solver, waves=SINES).solve(scene) for solver in ("exact", "asymptotic")]
        names = ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy")
        off.append(max(abs(float(values[0][n]) / float(values[1][n]) - 1) for n in names))
    assert off[2] < 0.01
    assert off[2] < 0.2 * off[1] < 0.04 * off[0] or off[2] < 1e-4, off


@pytest.mark.parametrize("k", [0.0, 0.31, 0.8])
def test_the_pattern_that_has_the_load_of_short_waves(k: float) -> None:
    """kappa = 1 - chi sin(2 pi r/lambda - (1 + k) pi/4) has exactly the load of the asymptotic form, section 16."""
    from gradhesion.core import solve
    from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

    chi, phase = 0.4, (1 + k) * math.pi / 4
    for ratio in (0.5, 0.1, 0.03):
        scene = short(k, chi, ratio)
        waves = (ToughnessHarmonic(n=1, cos=chi * math.sin(phase), sin=-chi * math.cos(phase)),)
        tough = scene | {"A": 0.0, "toughness_wavelength_over_R": scene["lambda_over_R"], "toughness_amplitude": 1.0}
        one = Kind("short", solver="asymptotic").solve(scene, ["pull_off_force", "pull_off_radius"])
        other = solve(tough, ["pull_off_force", "pull_off_radius"], toughness=Toughness(waves))
        assert float(one["pull_off_force"]) == pytest.approx(float(other["pull_off_force"]), rel=2e-11)
        assert float(one["pull_off_radius"]) == pytest.approx(float(other["pull_off_radius"]), rel=1e-6)


@pytest.mark.parametrize("k", [0.0, 0.4, 0.9])
def test_a_sine_is_a_shifted_cosine_where_waves_are_short(k: float) -> None:
    """On the envelope at once, whose crests no phase moves; exactly in proportion to the wavelength."""
    cosine, sine = Kind("c"), Kind("s", waves=((1, 0.0, 1.0),))
    even = [at(kind, solver="envelope").solve(short(k, 0.4, 0.01)) for kind in (cosine, sine)]
    for name in ("pull_off_force", "pull_off_radius"):
        assert float(even[0][name]) == pytest.approx(float(even[1][name]), rel=1e-11)
    off = []
    for ratio in (0.03, 0.003):
        values = [kind.solve(short(k, 0.4, ratio)) for kind in (cosine, sine)]
        off.append(abs(float(values[0]["pull_off_force"]) / float(values[1]["pull_off_force"]) - 1))
        assert off[-1] <= 3 * ratio
    assert off[1] <= 0.3 * off[0] or off[1] < 1e-4


@pytest.mark.parametrize("kind", [k for k in EXACT if k.ratio], ids=name_of)
def test_a_tiny_ratio_is_none(kind: Kind) -> None:
    """Closing without adhesion is the limit: sqrt(Gamma) enters depth and load."""
    scenes = some(drawn(kind)[0], slice(60))
    none = kind.solve(scenes | {"closing_ratio": np.zeros(60)})
    tiny = kind.solve(scenes | {"closing_ratio": np.full(60, 1e-24)})
    names = ["dissipated_energy", "pull_off_force", "delta_max"]
    jumped = np.abs(none["turning_radius"] - tiny["turning_radius"]) > 1e-3 * scenes["a_max_over_R"]
    assert jumped.mean() < 0.1
    for name in names:
        limit = errors(kind, scenes, none)[name] * 2 + 1e-8 * (np.abs(none[name]) + scenes["a_max_over_R"] ** 2)
        with np.errstate(invalid="ignore"):
            same = (none[name] == tiny[name]) | (np.abs(none[name] - tiny[name]) <= limit)
        assert (same | jumped).all(), name


def test_waves_on_a_pair_of_works_are_a_smooth_pair() -> None:
    """Toughnesses add: short waves of chi on (1, Gamma) are smooth works (1 + chi)^2 and (sqrt Gamma - chi)^2."""
    k, chi, ratio, wavelength = 0.2, 0.3, 0.64, 2e-5
    scene = short(k, chi, wavelength) | {"closing_ratio": ratio}
    wavy = Kind("pair", ratio=True).solve(scene, ["pull_off_force", "pinned_depth"])
    open_, close = (1 + chi) ** 2, (0.8 - chi) ** 2
    smooth = scene | {"A": 0.0, "modulus": 500.0 / open_, "closing_ratio": close / open_}
    even = Kind("pair", ratio=True).solve(smooth, ["pull_off_force"])
    assert float(wavy["pull_off_force"]) == pytest.approx(open_ * float(even["pull_off_force"]), rel=3e-4)
