"""The twin against closed forms, a second quadrature, the reference scenes and its own stored values."""

import json
from pathlib import Path

import pytest
from flint import arb

from .curve import Curve
from .energy import dissipated, double_exponential, loop
from .path import cycle
from .scene import PARAMETERS, solve
from .special import Sine, s0_series, s1_series, theta

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
    if not REFERENCE.exists():
        pytest.skip("no reference scenes in tests/reference")
    scene = json.loads(REFERENCE.read_text(encoding="utf-8"))["scenes"][index]
    solution = solve(scene["parameters"])
    for name, value in scene["expected"].items():
        if name in ("theta", "M"):
            continue
        assert abs(float(getattr(solution, name)) - value) <= 2 * ULP * abs(value), name


@pytest.mark.parametrize("group", ["random", "hard"])
def test_loop_integral(group: str) -> None:
    """The drops at the jumps sum to the loop integral, also where adhesion is weak and some are negative."""
    for row in [r for r in stored() if r["group"] == group][::20][:12]:
        curve = Curve({name: float(str(row[name])) for name in PARAMETERS})
        path, _ = cycle(curve)
        drops = [dissipated(curve, jump) for jump in path.loading + path.unloading]
        size = float(sum((abs(drop) for drop in drops), arb(0)))
        assert abs(sum(drops, arb(0)) - loop(curve, path)) < arb("1e-24") * size


def test_stored_values() -> None:
    """Some stored rows, solved again, give the same doubles."""
    for row in stored()[:2100:70]:
        solution = solve({name: float(str(row[name])) for name in PARAMETERS})
        for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_max", "delta_jump_out"):
            value = getattr(solution, name)
            assert (None if value is None else float(value)) == row[name], name
        assert [solution.loading_jumps, solution.unloading_jumps] == [row["loading_jumps"], row["unloading_jumps"]]
