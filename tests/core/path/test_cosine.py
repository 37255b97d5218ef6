"""Whole cycles: a second route to the energy, long curves, and the places where numbers of jumps change."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.path import cosine as cycle
from gradhesion.core.path.loading import loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.material import stiffness
from gradhesion.core.struve.table import struve_pair

EPS = 2.0**-52
EXPONENTS = [(0.0, 0.3), (0.31, 0.27), (0.7, 0.1), (0.97, 0.5), (1.0, 0.5)]


def _area(density: np.ndarray, a: np.ndarray) -> float:
    """Integrate from 0 on."""
    return float(np.trapezoid(np.concatenate([[0.0], density]), np.concatenate([[0.0], a])))


def _brute(scene: dict[str, float], points: int = 400_000) -> dict[str, float]:
    """Solve a scene on a dense grid: no fold, no jump, only running extrema of the depth.

    H = int_0^{a_max} 2 pi a [((delta_H - d_un)/Delta)^2 - ((delta_H - d_load)/Delta)^2] da, where d_load is the running
    maximum of the depth outwards from 0 and d_un its running minimum inwards from the rim.
    """
    k, wavelength = scene["k"], scene["lambda_over_R"]
    m = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    stretch = math.sqrt(2 ** (1 + k) * math.pi / m)
    # half of the points crowd at 0, where the integrand is not smooth
    a = scene["a_max_over_R"] * np.linspace(0, 1, points + 1)[1:] ** 2
    z = 2 * math.pi * a / wavelength
    s0, s1, _, _ = struve_pair(k, a / wavelength)
    hertz = a**2 / (1 + k) + 2 * math.pi * scene["A"] * a * s0
    delta = stretch * a ** (0.5 * (1 - k))
    depths = hertz - delta
    outwards = np.maximum.accumulate(np.maximum(depths, 0.0))
    inwards = np.minimum.accumulate(depths[::-1])[::-1]
    density = 2 * math.pi * a * ((hertz - inwards) ** 2 - (hertz - outwards) ** 2) / delta**2
    factor = 2 ** (1 - k) * m / (1 + k)
    moment = a ** (3 + k) / (3 + k) + 2 * math.pi * scene["A"] * a ** (2 + k) * s1
    load = factor * (a ** (1 + k) * depths - moment)
    below = depths < outwards
    above = depths > inwards
    assert z[0] > 0.0
    return {
        "dissipated_energy": _area(density, a),
        "loading_energy": _area(2 * np.pi * a * (1 - ((hertz - outwards) / delta) ** 2), a),
        "pull_off_force": float(-load.min()) / (1.5 * math.pi),
        "delta_max": float(outwards[-1]),
        "delta_jump_out": float(inwards[0]),
        "loading_jumps": int(np.sum(below[:-1] & ~below[1:])) + int(below[-1]),
        "unloading_jumps": int(np.sum(above[:-1] & ~above[1:])) + int(above[-1]),
    }


SCENES = [
    {
        "k": 0.31,
        "nu": 0.27,
        "modulus": 1730.0,
        "c0_over_R": 0.037,
        "lambda_over_R": 0.043,
        "A": 0.0137,
        "a_max_over_R": 0.47,
    },
    {"k": 0.0, "nu": 0.3, "modulus": 95.0, "c0_over_R": 1.0, "lambda_over_R": 0.31, "A": 0.083, "a_max_over_R": 1.37},
    {
        "k": 0.62,
        "nu": -0.2,
        "modulus": 640.0,
        "c0_over_R": 0.21,
        "lambda_over_R": 0.087,
        "A": 0.31,
        "a_max_over_R": 0.93,
    },
    {"k": 0.97, "nu": 0.5, "modulus": 77.0, "c0_over_R": 0.6, "lambda_over_R": 0.2, "A": 0.11, "a_max_over_R": 1.21},
    {"k": 1.0, "nu": 0.5, "modulus": 210.0, "c0_over_R": 0.3, "lambda_over_R": 0.17, "A": 0.061, "a_max_over_R": 1.03},
    {"k": 1.0, "nu": 0.5, "modulus": 900.0, "c0_over_R": 0.1, "lambda_over_R": 0.11, "A": 2.3, "a_max_over_R": 0.71},
    {"k": 0.15, "nu": 0.45, "modulus": 3e4, "c0_over_R": 0.002, "lambda_over_R": 0.02, "A": 0.9, "a_max_over_R": 0.31},
    {"k": 0.45, "nu": 0.1, "modulus": 350.0, "c0_over_R": 0.05, "lambda_over_R": 0.7, "A": 0.2, "a_max_over_R": 0.05},
]


@pytest.mark.parametrize("scene", SCENES)
def test_running_extrema(scene: dict[str, float]) -> None:
    """A second route to the energy, which knows of no branches: agreement to what the grid leaves."""
    values, expected = solve(scene, OUTPUTS), _brute(scene)
    assert math.isclose(float(values["dissipated_energy"]), expected["dissipated_energy"], rel_tol=2e-6)
    # where loading follows the curve the grid has 0 up to rounding: its own error is that of the whole
    loaded = float(values["loading_energy"])
    assert math.isclose(loaded, expected["loading_energy"], abs_tol=2e-6 * expected["dissipated_energy"])
    assert math.isclose(float(values["pull_off_force"]), expected["pull_off_force"], rel_tol=1e-6)
    assert math.isclose(float(values["delta_max"]), expected["delta_max"], abs_tol=1e-6)
    assert math.isclose(
        float(values["delta_jump_out"]), expected["delta_jump_out"], abs_tol=1e-3 if scene["k"] > 0.9 else 1e-6
    )
    assert int(values["loading_jumps"]) == expected["loading_jumps"]
    # on the grid the contact at k = 1 never quite shrinks to a point
    assert int(values["unloading_jumps"]) == expected["unloading_jumps"]


class TestRim:
    """The rim at every place of the curve."""

    @pytest.mark.parametrize("scene", SCENES)
    def test_energy_is_continuous(self, scene: dict[str, float]) -> None:
        """In steps of a_max of 1e-9 of itself, everywhere and at the places where numbers of jumps change."""
        rims = scene["a_max_over_R"] * np.linspace(0.02, 2.0, 4000)
        values = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
        changes = np.flatnonzero((np.diff(values["loading_jumps"]) != 0) | (np.diff(values["unloading_jumps"]) != 0))
        assert changes.size > 0 or scene is SCENES[7]
        for i in changes[:40]:
            low, high = rims[i], rims[i + 1]
            for _ in range(60):  # the change of the numbers, to the last bit
                middle = 0.5 * (low + high)
                if middle in (low, high):
                    break
                here = solve(scene | {"a_max_over_R": [low, middle]}, ("loading_jumps", "unloading_jumps"))
                same = all(here[name][0] == here[name][1] for name in ("loading_jumps", "unloading_jumps"))
                low, high = (middle, high) if same else (low, middle)
            energies = solve(scene | {"a_max_over_R": [low, high]})["dissipated_energy"]
            assert math.isclose(*energies.tolist(), rel_tol=1e-11)

    @pytest.mark.parametrize("scene", SCENES)
    def test_energy_is_constant_on_branches_that_loading_visits(self, scene: dict[str, float]) -> None:
        rims = scene["a_max_over_R"] * np.linspace(0.02, 2.0, 4000)
        values = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
        # such a rim is the deepest place so far, as its neighbours on the grid are
        rising = np.diff(values["delta_max"]) > 0.0
        same = np.zeros(rims.size - 1, dtype=bool)
        same[1:-1] = rising[1:-1] & rising[:-2] & rising[2:]
        same &= (np.diff(values["loading_jumps"]) == 0) & (np.diff(values["unloading_jumps"]) == 0)
        assert same.sum() > 50 or scene["a_max_over_R"] < 0.1
        steps = np.diff(values["dissipated_energy"])[same]
        assert (np.abs(steps) <= 16 * EPS * np.abs(values["dissipated_energy"][1:][same])).all()

    @pytest.mark.parametrize("scene", SCENES)
    def test_force_never_falls(self, scene: dict[str, float]) -> None:
        rims = scene["a_max_over_R"] * np.linspace(0.02, 2.0, 4000)
        force = np.array(
            [float(solve(scene | {"a_max_over_R": rim}, ("pull_off_force",))["pull_off_force"]) for rim in rims[::10]]
        )
        assert (np.diff(force) >= -8 * EPS * force[1:]).all()

    def test_in_the_middle_of_a_jump(self) -> None:
        """Loading jumps to the rim at the depth it left; unloading starts there by a jump inwards or not at all."""
        scene = SCENES[1]
        rims = np.linspace(0.2, 1.37, 2000)
        values = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
        pinned = np.flatnonzero(np.diff(values["delta_max"]) == 0.0)
        inside = pinned[values["delta_max"][pinned] > 0.0]
        assert inside.size > 20
        for i in inside[::7]:
            expected = _brute(scene | {"a_max_over_R": float(rims[i])})
            assert math.isclose(values["dissipated_energy"][i], expected["dissipated_energy"], rel_tol=3e-6)
            assert values["loading_jumps"][i] == expected["loading_jumps"]

    @pytest.mark.parametrize(("k", "nu"), EXPONENTS)
    def test_smaller_than_the_first_stable_contact(self, k: float, nu: float) -> None:
        """One jump to the rim, one from it: the loss is the integral from zero contact at depth 0, less that at delta."""
        scene = SCENES[0] | {"k": k, "nu": nu, "A": 0.004, "lambda_over_R": 0.7, "a_max_over_R": 2e-4}
        values, expected = solve(scene, OUTPUTS), _brute(scene)
        assert values["loading_jumps"] == 1
        assert values["unloading_jumps"] == (1 if k < 1 else 0)
        assert math.isclose(float(values["dissipated_energy"]), expected["dissipated_energy"], rel_tol=1e-6)
        assert values["delta_max"] == 0.0


class TestAmplitude:
    """Pairs of folds that are about to be born."""

    @pytest.mark.parametrize(("k", "nu"), [(0.0, 0.3), (0.55, 0.1), (1 - 1e-9, 0.5), (1.0, 0.5)])
    def test_energy_is_continuous_at_a_tangency(self, k: float, nu: float) -> None:
        """A new branch brings two jumps that cost nothing at first."""
        scene = {"k": k, "nu": nu, "modulus": 700.0, "c0_over_R": 0.07, "lambda_over_R": 0.15}
        scene["a_max_over_R"] = 6.3 * float(stiffness(k, nu, 700.0, 0.07)) ** (-1 / (3 + k))
        amplitudes = np.geomspace(1e-3, 0.5, 1500)
        values = solve(scene | {"A": amplitudes}, OUTPUTS)
        changes = np.flatnonzero(np.diff(values["loading_jumps"]) != 0)
        assert changes.size >= 3
        for i in changes[:12]:
            low, high = amplitudes[i], amplitudes[i + 1]
            first = int(values["loading_jumps"][i])
            while True:
                middle = 0.5 * (low + high)
                if middle in (low, high):
                    break
                jumps = int(solve(scene | {"A": middle}, ("loading_jumps",))["loading_jumps"])
                low, high = (middle, high) if jumps == first else (low, middle)
            near = solve(scene | {"A": [low, high]}, OUTPUTS)
            assert near["loading_jumps"][0] != near["loading_jumps"][1]
            assert math.isclose(*near["dissipated_energy"].tolist(), rel_tol=1e-11)
            assert math.isclose(*near["pull_off_force"].tolist(), rel_tol=1e-13)
            assert math.isclose(*near["delta_jump_out"].tolist(), rel_tol=1e-12)

    @pytest.mark.parametrize("step", [1e-2, 1e-4, 1e-6, 1e-8])
    def test_the_loss_of_a_close_pair_is_that_of_a_cubic(self, step: float, table_of: Callable[[float], Any]) -> None:
        """At k = 1, D = b z + g sin z: the loop of the two jumps over a close pair costs in proportion to the step squared.

        Beside the place of touching, depth = depth_0 - e y + D'' y^3/6 with e = -D there: the loop is as high as depth
        falls, e^(3/2), and as wide as load changes over it, e^(1/2).
        """
        table = table_of(1.0)
        losses = []
        for size in (step, 0.5 * step):
            # sin z + ratio z touches 0 from above in the second wave where tan z = z = 10.904121659428899
            ratio = -math.cos(10.904121659428899) * (1 - size)
            curve = Cosine(0.9 * ratio, 0.9, 0.0)
            arches = cycle.extent(table, curve)
            results = []
            for rim in (1.25, 2.1):
                count, trace = cycle.walk(table, curve, arches, rim, np.zeros((ROWS, 192)), True)
                loaded, _ = loading_to(table, curve, count, trace, rim, True)
                unloaded, _, _ = unloading_from(table, curve, count, trace, rim, depth(table, curve, rim), True)
                results.append(loaded + unloaded)
            losses.append(results[1] - results[0])
        assert abs(losses[0]) <= 1e3 * step * step + 1e-14
        if step >= 1e-4:
            assert math.isclose(losses[0] / losses[1], 4.0, rel_tol=3 * step + 1e-3)


class TestExponentOne:
    """k = 1: the adhesive stretch is the same everywhere, and contact may shrink to a point."""

    def test_no_jump_out(self) -> None:
        scene = {"k": 1.0, "nu": 0.5, "modulus": 333.0, "c0_over_R": 0.11, "lambda_over_R": 0.19, "a_max_over_R": 0.9}
        values = solve(scene | {"A": [0.0, 1e-6, 1e-3]}, OUTPUTS)
        s = math.sqrt(4 * math.pi / float(stiffness(1.0, 0.5, 333.0, 0.11)))
        assert values["unloading_jumps"].tolist() == [0, 0, 0]
        np.testing.assert_allclose(values["delta_jump_out"], -s, rtol=8 * EPS)

    def test_it_is_the_limit(self) -> None:
        """Results are continuous as k -> 1 at nu = 1/2; the jump-out fades as its radius does."""
        scene = SCENES[4]
        exact = solve(scene, OUTPUTS)
        for step in (1e-6, 1e-9, 1e-12, 2.0**-53):
            near = solve(scene | {"k": 1 - step}, OUTPUTS)
            assert near["loading_jumps"] == exact["loading_jumps"]
            for name, order in (("pull_off_force", 1.0), ("dissipated_energy", 1.0), ("delta_max", 1.0)):
                assert math.isclose(float(near[name]), float(exact[name]), rel_tol=300 * step**order + 32 * EPS)
