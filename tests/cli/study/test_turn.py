"""Studies whose cycles turn at a depth or a load: keys, units, curves, what is printed, and what is refused."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import study_from
from gradhesion.core import TURNS, solve
from gradhesion.core.problem.status import doubts_about

Call = Callable[..., Result]
SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.05, "A": 0.06}
PROBE = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "100 nm", "wavelength": "100 nm"}
OUTPUTS = ["pull_off_force", "dissipated_energy", "delta_max", "turning_radius"]


def study(parameters: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"outputs": OUTPUTS, "parameters": SCENE | parameters} | more


@pytest.mark.parametrize(("turn", "values"), [*zip(TURNS, ([-0.01, 0.02, 0.2], [0.5, 5.0, 50.0]), strict=True)])
def test_it_is_an_axis_after_the_radius(turn: str, values: list[float]) -> None:
    dataset = compute(study_from(study({"a_max_over_R": [0.2, math.inf], turn: values})))
    assert tuple(dataset["pull_off_force"].dims) == ("a_max_over_R", turn)
    found = solve(SCENE | {"a_max_over_R": np.array([[0.2], [math.inf]]), turn: values}, OUTPUTS)
    for name in (*OUTPUTS, "status"):
        np.testing.assert_array_equal(dataset[name], found[name])
    assert dataset[turn].attrs["long_name"].endswith("at which the cycle turns")


def test_the_radius_may_be_left_out() -> None:
    dataset = compute(study_from(study({"load_max": 2.0})))
    assert dataset["a_max_over_R"] == math.inf
    assert 0.0 < dataset["turning_radius"] < 1.0


def test_quantities_with_units() -> None:
    parameters = {"k": 0.3, "nu": 0.3, "A": [0.0, 0.02]}
    unit = 1.5 * math.pi * 1e-6 * 0.05
    for own, ratio, written, value in (
        ("indentation_max", "indentation_max_over_R", ["-1 nm", "20 nm", "60 nm"], [-1e-3, 0.02, 0.06]),
        ("preload", "load_max", ["100 nN", "1 uN"], [1e-7 / unit, 1e-6 / unit]),
    ):
        made = compute(study_from({"outputs": OUTPUTS, "parameters": parameters, "physical": PROBE | {own: written}}))
        np.testing.assert_allclose(made[ratio], value, rtol=1e-14)
        assert made[ratio].dims == (own,)
        ratios = {"modulus": 20000.0, "c0_over_R": 0.1, "lambda_over_R": 0.1}
        plain = compute(study_from({"outputs": OUTPUTS, "parameters": parameters | ratios | {ratio: value}}))
        for name in OUTPUTS:
            np.testing.assert_allclose(made[name], plain[name], rtol=1e-11, atol=1e-14)
        np.testing.assert_allclose(made["turning_radius_si"], 1e-6 * made["turning_radius"], rtol=1e-15)
        assert made["turning_radius_si"].attrs["units"] == "m"


def test_curves_turn_there() -> None:
    data = study({"indentation_max_over_R": [-0.01, 0.05]}, kind="curve")
    dataset = compute(study_from(data | {"outputs": ["path", "jumps", "equilibrium", "surface"]}))
    radius = float(solve(SCENE | {"a_max_over_R": math.inf, "indentation_max_over_R": 0.05}, OUTPUTS)["turning_radius"])
    path = dataset["path_contact_radius"].isel(indentation_max_over_R=1)
    assert float(path.max()) == pytest.approx(radius, rel=4e-16)
    assert float(dataset["path_indentation"].isel(indentation_max_over_R=1).max()) == pytest.approx(0.05, rel=1e-12)
    none = dataset.isel(indentation_max_over_R=0)
    assert float(none["path_contact_radius"].max()) == 0.0
    assert dataset["jump_count"].values[0] == 0 < dataset["jump_count"].values[1]
    assert not dataset["jump_at_rim"].values.any()
    turned = dataset["surface_gap"].isel(indentation_max_over_R=1).sel(state="turning_point")
    assert np.isfinite(turned).any()
    assert np.isnan(none["surface_gap"].sel(state="turning_point")).all()


def test_commands(gradhesion: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    toml = "\n".join(f"{name} = {value!r}" for name, value in SCENE.items() if name != "A")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "turn.toml").write_text(
        f"outputs = {OUTPUTS}\n[parameters]\n{toml}\nA = [0.0, 0.06]\n"
        "indentation_max_over_R = { start = -0.01, stop = 0.1, num = 12 }\n"
    )
    done = gradhesion("run", "turn.toml", "-o", "turn.nc")
    assert done.exit_code == 0, done.output
    info = gradhesion("info", "turn.nc").output
    assert "indentation_max_over_R" in info
    assert "contact radius a/R at which unloading starts" in info
    verified = gradhesion("verify", "turn.nc", "--sample", "24")
    assert verified.exit_code == 0, verified.output
    assert gradhesion("plot", "turn.nc", "-o", "turn.png").exit_code == 0
    with xarray.open_dataset(tmp_path / "turn.nc") as dataset:
        assert dataset.sizes["indentation_max_over_R"] == 12


def test_doubt_is_cast_on_all_that_loading_leads_to() -> None:
    assert not doubts_about("pull_off_force") & 1
    assert doubts_about("pull_off_force", turned=True) & 1
