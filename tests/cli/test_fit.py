"""`gradhesion run` of a fit: from a measured loop to values with intervals, and how a loop can be refused."""

import json
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT
from tests.cli.conftest import Call, Patch, Told, jkr
from tests.conftest import ROOT

CONFIGS = ROOT / "configs"
TRUE = {"E_star": 1e7, "work_of_adhesion": 0.03, "wavelength": 0.5e-6, "A": 0.012, "indentation_offset": 2e-9, "load_offset": 1e-8}  # fmt: skip
"""What configs/force_curve.csv was made with."""
ROWS = [line for line in (CONFIGS / "force_curve.csv").read_text().splitlines() if line[0] in "-0123456789"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: Patch) -> Path:
    for name in ("fit.toml", "force_curve.csv"):
        (tmp_path / name).write_text((CONFIGS / name).read_text())
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def found() -> xarray.Dataset:
    return gr.run(CONFIGS / "fit.toml")


def measured(folder: Path, rows: list[str], header: str = "depth,force") -> None:
    (folder / "force_curve.csv").write_text("\n".join([header, *rows]) + "\n")


def recovers(found: xarray.Dataset, true: dict[str, float], deviations: float) -> None:
    """Check that values are what data were made with, within so many standard deviations."""
    assert [*true] == found["parameter"].values.tolist()
    off = (found["value"].values - np.array([*true.values()])) / found["standard_deviation"].values
    assert np.abs(off).max() < deviations, dict(zip(true, off, strict=True))


def test_the_example_gives_what_its_loop_was_made_with_and_its_path(found: xarray.Dataset) -> None:
    recovers(found, TRUE, 4.0)
    assert found["parameter_units"].values.tolist() == ["Pa", "J/m^2", "m", "1", "m", "N"]
    assert float(found["standard_deviation"][0]) < 0.01 * TRUE["E_star"], "the intervals mean something"
    for low, high in (("low", "value"), ("value", "high"), ("low_searched", "low"), ("high", "high_searched")):
        assert (found[low] < found[high]).all()
    assert [float(found[name][0]) for name in ("low_searched", "high_searched")] == pytest.approx([1e6, 1e8])
    degrees = int(found["degrees_of_freedom"])
    assert degrees == 600 - 6
    assert float(found["chi_square"]) == pytest.approx(degrees, rel=5.0 * math.sqrt(2.0 / degrees))
    assert float(found["chi_square"]) == pytest.approx(float((found["residual"] ** 2).sum()), rel=1e-12)
    assert float(found["reduced_chi_square"]) == float(found["chi_square"]) / degrees
    assert int(found["raw_points"]) == int(found["kept_points"]) == 600
    assert not found["on_bound"].any()
    assert found["status"].dtype == np.int16
    assert int(found["status"]) & (POOR_FIT | ANOTHER_MINIMUM) == 0
    assert int(found["converged"]) == 1
    np.testing.assert_allclose(np.diag(found["correlation"].values), 1.0, rtol=1e-12)
    assert "units" not in found["value"].attrs
    assert float(found["R"]) == 5e-6
    points, path = found["measured_unloading"].values == 0, found["fitted_unloading"].values == 0
    depth, load = (found[f"measured_{name}"].values[points] for name in ("indentation", "load"))
    along, up = (found[f"fitted_{name}"].values[path] for name in ("indentation", "load"))
    deep = depth > 1e-7  # beyond the jumps
    apart = np.abs(np.interp(depth[deep], along, up) - load[deep])
    assert np.median(apart) < 2.5 * 7e-9, "noise of depth adds to that of load"


def test_run_writes_it_and_info_and_plot_read_it(gradhesion: Call, folder: Path, found: xarray.Dataset) -> None:
    assert "a fit of 600 points in 1 cycle" in gradhesion("validate", "fit.toml").stdout
    assert "E_star, work_of_adhesion" in gradhesion("plan", "fit.toml").stdout
    assert json.loads(gradhesion("plan", "fit.toml", "--json").stdout)["points"] == 600
    assert not (folder / "outputs").exists()
    result = gradhesion("run", "fit.toml", code=0)
    assert f"reduced chi square {float(found['reduced_chi_square']):.3g}" in result.stderr
    with gr.open(folder / "outputs/fit.nc") as dataset:
        np.testing.assert_array_equal(dataset["value"].values, found["value"].values)
        study = dataset.attrs["study"]
    seal = f'sha256 = "{tomllib.loads(study)["data"]["sha256"]}"\n'
    assert study.replace(seal, "") == (folder / "fit.toml").read_text(), "all else is as it was written"
    told = gradhesion("info", "outputs/fit.nc").stdout
    assert [name for name in TRUE if f"  {name} " not in told] == []
    table = gradhesion("info", "outputs/fit.nc", "--format", "csv").stdout.splitlines()
    assert table[0] == "parameter,unit,value,standard_deviation,low,high,on_bound"
    assert float(table[1].split(",")[2]) == float(found["value"][0])
    assert gradhesion("plot", "outputs/fit.nc", "-o", "fit.svg").exit_code == 0
    assert (folder / "fit.svg").stat().st_size > 20_000
    assert gradhesion("run", "fit.toml").exit_code == 4, "an existing dataset is not replaced"


def test_a_fit_at_a_bound_is_flagged_and_one_of_what_has_no_effect_refused(gradhesion: Call, folder: Path) -> None:
    assert "wavelength" in gradhesion("run", "fit.toml", "--set=parameters.A=0.0", code=2).stderr
    assert not (folder / "outputs/fit.nc").exists()
    bound = '--set=physical.E_star={ start = "1 MPa", stop = "9.9 MPa" }'
    waves = ("--set=parameters.A=0.012", '--set=physical.wavelength="0.5 um"')  # known: a search for them takes long
    result = gradhesion("run", "fit.toml", bound, *waves, '--set=fit.intervals="linear"', code=3)
    assert "E_star is at an end of its range of 1e+06 to 9.9e+06" in result.stderr
    with gr.open(folder / "outputs/fit.nc") as dataset:
        assert dataset["on_bound"].values[0] == 1


def test_a_file_that_is_no_loop_is_refused(refusal: Told, folder: Path) -> None:
    a_line, flat = ([f"{i % last},{i if last == 50 else 1}" for i in range(50)] for last in (50, 20))
    for rows in (a_line, flat, ["0,1", "1,2", "0,1"], ["nan,1", "nan,2"]):
        measured(folder, rows)
        assert refusal("validate", "fit.toml").startswith("fit.toml:")
    with (folder / "force_curve.csv").open("wb") as file:
        file.truncate(2**30)  # a hole, that takes no room
    assert refusal("validate", "fit.toml").startswith("fit.toml:")


def test_rows_without_a_number_are_left_out_and_noise_is_estimated(gradhesion: Call, folder: Path) -> None:
    measured(folder, [*ROWS[:30], "nan,1.0", "2.0,nan", *ROWS[30:]])
    result = gradhesion("validate", "fit.toml", code=0)
    assert "force_curve.csv: 2 rows without a number left out" in result.stderr
    assert "a fit of 600 points" in result.stdout
    lines = (folder / "fit.toml").read_text().splitlines()
    (folder / "fit.toml").write_text("\n".join(line for line in lines if not line.startswith("noise")))
    assert gr.load("fit.toml").loop.noise == pytest.approx((0.25e-9, 7e-9), rel=0.5)
    assert "noise estimated" in gradhesion("validate", "fit.toml").stderr


def test_cycles_are_found_in_the_order_of_the_points(folder: Path) -> None:
    measured(folder, 3 * ROWS)
    study = gr.load("fit.toml")
    assert (study.loop.cycles, study.loop.depth.size) == (3, 1800)
    found = gr.run(study, set={"fit.intervals": "linear"})
    assert found["measured_cycle"].values.max() == 3
    recovers(found, TRUE, 4.0 * math.sqrt(3.0))  # thrice the same noise


def test_the_displacement_of_a_machine_is_fitted_with_its_spring(folder: Path) -> None:
    """Points of a smooth ball pushed through a spring."""
    R, E_star, work, S = 5e-6, 1e7, 0.03, 20.0

    def at(a: np.ndarray) -> np.ndarray:
        depth, load = jkr(a, R, E_star, work)
        return np.array([depth + load / S, load])

    fine = np.linspace(1e-7, 1.4e-6, 20_001)
    moved = at(fine)[0]
    first = fine[moved > 0.0][0] if moved[0] < 0.0 else fine[0]
    last = fine[int(np.argmin(moved))]
    radii = np.concatenate([np.linspace(first, 1.3e-6, 150), np.linspace(1.3e-6, last, 250)[1:]])
    noise = np.array([[0.3], [5.0]]) * np.random.default_rng(8).standard_normal((2, radii.size))
    measured(folder, [f"{x:.4f},{y:.4f}" for x, y in (1e9 * at(radii) + noise).T], "piezo [nm],force [nN]")
    (folder / "spring.toml").write_text("""
kind = "fit"
data = { file = "force_curve.csv", displacement = "piezo", load = "force" }
parameters = { k = 0.0, nu = 0.3, A = 0.0 }
fit = { noise = { displacement = "0.3 nm", load = "5 nN" }, intervals = "linear" }
[physical]
R = "5 um"
E_star = { start = "1 MPa", stop = "100 MPa" }
work_of_adhesion = { start = "5 mJ/m^2", stop = "200 mJ/m^2" }
spring_constant = { start = "2 N/m", stop = "200 N/m" }
""")
    found = gr.run("spring.toml")
    true = {"E_star": E_star, "work_of_adhesion": work, "spring_constant": S}
    recovers(found, true | {"indentation_offset": 0.0, "load_offset": 0.0}, 4.0)
    assert float(found["standard_deviation"][2]) < 0.1 * S
    assert found.attrs["control"] == "machine"
