"""The twin against closed forms, a second quadrature, the reference scenes and its own stored values."""

import json
import math
from pathlib import Path

import pytest
from flint import arb

from gradhesion.twin import stated
from gradhesion.twin.curve import Curve
from gradhesion.twin.energy import dissipated, double_exponential, loop
from gradhesion.twin.path import cycle
from gradhesion.twin.scene import PARAMETERS, solve
from gradhesion.twin.special import Sine, s0_series, s1_series, struve_expansion, theta

HERE = Path(__file__).parent
REFERENCE = HERE.parent / "reference" / "scenes.json"
ULP = 2.0**-52


def stored() -> list[dict[str, object]]:
    """The rows of scenes.json under their column names."""
    file = json.loads((HERE / "scenes.json").read_text(encoding="utf-8"))
    return [dict(zip(file["columns"], row, strict=True)) for row in file["scenes"]]


def expected(value: arb, size: float) -> bool:
    """Whether a value is below 1e-40 of a size."""
    return bool(abs(value) < arb("1e-40") * size)


@pytest.mark.parametrize("z", ["0.013", "0.25", "3.3", "41.7", "260.2"])
def test_special_functions(z: str) -> None:
    """Taylor bins against the series, k = 1 against elementary functions, k = 0.37 against the defining integral."""
    x, k = arb(float(z)), arb(0.37)
    s0, s1 = Sine(k).pair(x)
    assert expected(s0 - s0_series(k, x), 1)
    assert expected(s1 - s1_series(k, x), 1)
    assert expected(Sine(arb(1)).s0(x) - (1 - x.cos()) / x, 1)
    if x < 10:  # with t = 1 - u: (1 - t^2)^((k-1)/2) = (u (2 - u))^((k-1)/2)
        rule = double_exponential()
        s0_integral = sum((w * (u * (2 - u)) ** ((k - 1) / 2) * (x * (1 - u)).sin() for u, w in rule), arb(0))
        s1_integral = sum((w * (u * (2 - u)) ** ((k + 1) / 2) * (x * (1 - u)).sin() for u, w in rule), arb(0))
        assert abs(s0 - s0_integral) < 1e-12  # the rule ends at u = 1e-40, u^0.3 there is 1e-13
        assert abs(s1 - s1_integral) < 1e-28


def test_theta() -> None:
    """Theta is 1 at k = 0 and continuous at k = 1, nu = 1/2."""
    assert expected(theta(arb(0), arb("0.3")) - 1, 1)
    assert abs(theta(arb(1), arb(1) / 2) - arb.pi()) < arb("1e-48")
    assert abs(theta(1 - arb("1e-20"), arb(1) / 2) - arb.pi()) < arb("1e-18")


@pytest.mark.parametrize("index", [3, 8, 30, 33, 34, 44, 47])
def test_reference(index: int) -> None:
    """Reference scenes to the last bits of their doubles; k = 0.247, 0.109, 1, 0.999, 1e-6, 0.5, 1e-6."""
    scene = json.loads(REFERENCE.read_text(encoding="utf-8"))["scenes"][index]
    solution = solve(scene["parameters"])
    for name, value in scene["expected"].items():
        if name in ("theta", "M"):
            continue
        assert abs(float(getattr(solution, name)) - value) <= 2 * ULP * abs(value), name


@pytest.mark.parametrize("group", ["random", "hard"])
def test_loop_integral(group: str) -> None:
    """The drops at the jumps sum to the loop integral, also where adhesion is weak and some are negative."""
    for row in [r for r in stored() if r["group"] == group][::20][:8]:
        curve = Curve({name: float(str(row[name])) for name in PARAMETERS})
        path, _ = cycle(curve)
        drops = [dissipated(curve, jump) for jump in path.loading + path.unloading]
        size = float(sum((abs(drop) for drop in drops), arb(0)))
        assert abs(sum(drops, arb(0)) - loop(curve, path)) < arb("1e-24") * size


def test_stored_values() -> None:
    """Some stored rows, solved again, give the same doubles."""
    for row in stored()[:2100:175]:
        solution = solve({name: float(str(row[name])) for name in PARAMETERS})
        for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_max", "delta_jump_out"):
            value = getattr(solution, name)
            assert (None if value is None else float(value)) == row[name], name
        assert [solution.loading_jumps, solution.unloading_jumps] == [row["loading_jumps"], row["unloading_jumps"]]


@pytest.mark.parametrize("k", [0.0, 2.0**-53, 1e-9, 0.37, 1 - 1e-12, 1.0])
def test_far_expansion(k: float) -> None:
    """Beyond z = 200 Struve's expansion takes over from the series, next to integer orders as well."""
    exponent = arb(k)
    for z in (arb(201), arb(877) / 2):
        assert expected(struve_expansion(exponent / 2, z) - s0_series(exponent, z), 1)
        assert expected(struve_expansion(1 + exponent / 2, z) - s1_series(exponent, z), 1)


@pytest.mark.parametrize(("k", "nu"), [(0.0, 0.3), (0.45, -0.4), (1.0, 0.5)])
def test_smooth_punch_of_any_wavelength(k: float, nu: float) -> None:
    """Without amplitude the wavelength is nothing, and rim, modulus and depth may be of any size: closed forms."""
    for wavelength, rim in ((1e-12, math.inf), (1e6, 1e9), (0.3, 3e-9)):
        scene = dict(zip(PARAMETERS, (k, nu, 1e9, 1e-7, wavelength, 0.0, rim), strict=True))
        solution = solve(scene)
        curve = Curve(scene)
        s, x = curve.adhesion, arb(k)
        q, first = (1 - x) / 4, ((1 + x) * curve.adhesion) ** (2 / (3 + x))
        if rim > first:
            part = [
                16 * p * p / ((1 + x) * (3 + x) * (5 + x)) - 8 * p / ((1 + x) * (3 + x)) + 2 / (1 + x) - 1
                for p in (q, 1)
            ]
            last = (q * (1 + x) * s) ** (2 / (3 + x)) if k < 1 else arb(0)
            energy = arb.pi() * (part[0] * last * last - part[1] * first * first)
            assert abs(solution.dissipated_energy / energy - 1) < arb("1e-35")
            assert abs(solution.pull_off_force / ((3 + x) / 3) - 1) < arb("1e-35")
        else:
            assert [solution.loading_jumps, solution.unloading_jumps] == [1, 1 if k < 1 else 0]
            assert float(solution.pull_off_radius) == rim


def test_what_is_solved_does_not_depend_on_the_outputs() -> None:
    """The pull-off alone is that of the whole scene, and each output comes with an error in proportion to its size."""
    scene = {name: float(str(stored()[5][name])) for name in PARAMETERS}
    alone = stated.expected(scene, ["pull_off_force"], "exact")
    everything = stated.expected(scene, sorted(stated.KNOWN), "exact")
    assert set(everything) == stated.KNOWN
    assert float(alone.pop("pull_off_force").value) == float(everything["pull_off_force"].value)
    assert not alone
    depth = everything["delta_max"]
    assert stated.deviation(float(depth.value), depth) <= depth.error
    assert stated.deviation(math.nan, depth) == math.inf
    assert stated.deviation(math.inf, stated.Expected(arb("inf"), 0.0)) == 0.0


def test_scenes_of_too_many_waves_are_out_of_reach() -> None:
    """A bound on the time: 1,000 waves."""
    scene = dict(zip(PARAMETERS, (0.3, 0.3, 500.0, 0.01, 1e-3, 0.2, 0.9), strict=True))
    assert stated.within_reach(scene, ["dissipated_energy"], "exact")
    assert not stated.within_reach(scene | {"lambda_over_R": 5e-4}, ["dissipated_energy"], "exact")
    assert stated.within_reach(scene | {"lambda_over_R": 5e-4}, ["dissipated_energy"], "envelope")
