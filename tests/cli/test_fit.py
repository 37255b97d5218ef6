"""`gradhesion run` of a fit: from a measured loop to values with intervals, and every way in which it can be refused."""

import json
import math
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT

Call = Callable[..., Result]
CONFIGS = Path(__file__).parents[2] / "configs"
TRUE = {
    "E_star": 1e7,
    "work_of_adhesion": 0.03,
    "wavelength": 0.5e-6,
    "A": 0.012,
    "indentation_offset": 2e-9,
    "load_offset": 1e-8,
}
"""What configs/force_curve.csv was made with."""
UNITS = ("Pa", "J/m^2", "m", "1", "m", "N")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the study of `init fit` and its loop."""
    for name in ("fit.toml", "force_curve.csv"):
        (tmp_path / name).write_text((CONFIGS / name).read_text())
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def found() -> xarray.Dataset:
    """The fit of the example."""
    return gr.run(CONFIGS / "fit.toml")


def test_the_example_gives_what_its_loop_was_made_with(found: xarray.Dataset) -> None:
    assert found["parameter"].values.tolist() == list(TRUE)
    assert found["parameter_units"].values.tolist() == list(UNITS)
    for i, (name, value) in enumerate(TRUE.items()):
        assert abs(float(found["value"][i]) - value) < 4.0 * float(found["standard_deviation"][i]), name
        assert float(found["low"][i]) < float(found["value"][i]) < float(found["high"][i])
    assert float(found["standard_deviation"][0]) < 0.01 * TRUE["E_star"], "the intervals mean something"
    degrees = int(found["degrees_of_freedom"])
    assert degrees == 600 - 6
    assert float(found["chi_square"]) == pytest.approx(degrees, rel=5.0 * math.sqrt(2.0 / degrees))
    assert float(found["chi_square"]) == pytest.approx(float((found["residual"] ** 2).sum()), rel=1e-12)
    assert float(found["reduced_chi_square"]) == float(found["chi_square"]) / degrees
    assert int(found["raw_points"]) == int(found["kept_points"]) == 600
    assert (found["low_searched"] < found["low"]).all(), "an interval is within what was searched"
    assert (found["high"] < found["high_searched"]).all()
    assert [float(found[name][0]) for name in ("low_searched", "high_searched")] == pytest.approx([1e6, 1e8])
    assert not found["on_bound"].any()
    assert found["status"].dtype == np.int16
    assert int(found["status"]) & (POOR_FIT | ANOTHER_MINIMUM) == 0
    assert int(found["converged"]) == 1
    np.testing.assert_allclose(np.diag(found["correlation"].values), 1.0, rtol=1e-12)
    assert not {"units"} & found["value"].attrs.keys()
    assert float(found["R"]) == 5e-6


def test_the_path_goes_through_the_points(found: xarray.Dataset) -> None:
    inside = found["measured_unloading"].values == 0
    depth, load = found["measured_indentation"].values[inside], found["measured_load"].values[inside]
    loading = found["fitted_unloading"].values == 0
    along, up = found["fitted_indentation"].values[loading], found["fitted_load"].values[loading]
    deep = depth > 1e-7  # beyond the jumps
    apart = np.abs(np.interp(depth[deep], along, up) - load[deep])
    assert np.median(apart) < 2.5 * 7e-9, "noise of depth adds to that of load"


def test_run_writes_it_and_info_and_plot_read_it(gradhesion: Call, folder: Path, found: xarray.Dataset) -> None:
    result = gradhesion("run", "fit.toml")
    assert result.exit_code == 0, result.stderr
    assert "600 points fitted" in result.stderr
    assert "E_star = " in result.stderr
    assert f"; reduced chi square {float(found['reduced_chi_square']):.3g}\n" in result.stderr
    with opened(folder / "outputs/fit.nc") as dataset:
        np.testing.assert_array_equal(dataset["value"].values, found["value"].values)
        study = tomllib.loads(dataset.attrs["study"])
        assert len(study["data"]["sha256"]) == 64
        assert (
            dataset.attrs["study"].replace(f'sha256 = "{study["data"]["sha256"]}"\n', "")
            == (folder / "fit.toml").read_text()
        ), "all else is as it was written"
    told = gradhesion("info", "outputs/fit.nc").stdout
    assert "fitted, with 95 % intervals (profile likelihoods)" in told
    for name in TRUE:
        assert f"  {name} " in told
    table = gradhesion("info", "outputs/fit.nc", "--format", "csv").stdout.splitlines()
    assert table[0] == "parameter,unit,value,standard_deviation,low,high,on_bound"
    assert float(table[1].split(",")[2]) == float(found["value"][0])
    assert gradhesion("plot", "outputs/fit.nc", "-o", "fit.svg").exit_code == 0
    assert (folder / "fit.svg").stat().st_size > 20_000
    again = gradhesion("run", "fit.toml")
    assert again.exit_code == 4, "an existing dataset is not replaced"


@pytest.mark.parametrize("command", ["explore", "verify"])
def test_what_is_of_scenes_refuses_it(gradhesion: Call, folder: Path, found: xarray.Dataset, command: str) -> None:
    found.to_netcdf(folder / "fit.nc")
    result = gradhesion(command, "fit.nc")
    assert result.exit_code == 2
    assert "fit" in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_a_picture_takes_no_axes(gradhesion: Call, folder: Path, found: xarray.Dataset) -> None:
    found.to_netcdf(folder / "fit.nc")
    result = gradhesion("plot", "fit.nc", "--variable", "value")
    assert result.exit_code == 2
    assert "a fit is drawn as a whole" in result.stderr


def test_validate_and_plan_say_what_would_be_fitted(gradhesion: Call, folder: Path) -> None:
    assert "valid; a fit of 600 points in 1 cycle; fitted: " in gradhesion("validate", "fit.toml").stdout
    assert "E_star, work_of_adhesion" in gradhesion("plan", "fit.toml").stdout
    plan = json.loads(gradhesion("plan", "fit.toml", "--json").stdout)
    assert plan["points"] == 600
    assert not (folder / "outputs").exists()


@pytest.mark.usefixtures("folder")
def test_a_file_that_differs_is_refused(gradhesion: Call) -> None:
    result = gradhesion("validate", "fit.toml", f'--set=data.sha256="{64 * "0"}"')
    assert result.exit_code == 2
    assert "the file is not the one that this study was written for" in result.stderr


def test_a_fit_at_a_bound_is_written_and_flagged(gradhesion: Call, folder: Path) -> None:
    bound = '--set=physical.E_star={ start = "1 MPa", stop = "9.9 MPa" }'
    result = gradhesion("run", "fit.toml", bound, '--set=fit.intervals="linear"')
    assert result.exit_code == 3
    assert "E_star is at an end of its range (9.9e+06 of 1e+06 to 9.9e+06); widen the range, or give" in result.stderr
    with opened(folder / "outputs/fit.nc") as dataset:
        assert dataset["on_bound"].values[0] == 1
    assert "at an end of its range" in gradhesion("info", "outputs/fit.nc").stdout


def test_what_has_no_effect_is_refused_after_the_search(gradhesion: Call, folder: Path) -> None:
    result = gradhesion("run", "fit.toml", "--set=parameters.A=0.0")
    assert result.exit_code == 2
    assert "wavelength: without effect on this loop; fix it" in result.stderr
    assert not (folder / "outputs/fit.nc").exists()


WRONG: dict[str, tuple[str, str]] = {
    "no file": ('data.file="none.csv"', "the file cannot be read (No such file or directory)"),
    "no column": ('data.load={ column = "forc", unit = "nN" }', 'no column "forc"; did you mean "force"?'),
    "no force": ('data.load={ column = "force", unit = "nm" }', '"nm" is not a unit'),
    "no length": ('data.indentation={ column = "depth", unit = "nN" }', '"nN" is not a unit'),
    "no unit": ('data.load="force"', 'the column "force" has no unit'),
    "E_star and c0": ('physical.c0={ start = "1 nm", stop = "1 um" }', "cannot determine both E_star and c0"),
    "E_star and nu": ("parameters.nu={ start = 0.1, stop = 0.4 }", "cannot determine both nu and E_star"),
    "an output": ('outputs=["pull_off_force"]', "outputs = "),
    "a solver": ('method.solver="exact"', "method = "),
    "an axis": ('physical.E_star=["1 MPa"]', "a fit has no axes"),
    "half a range": ('physical.E_star={ start = "1 MPa" }', "physical.E_star.stop: "),
    "num": ('physical.E_star={ start = "1 MPa", stop = "2 MPa", num = 3 }', "physical.E_star = "),
    "falling": ('physical.E_star={ start = "2 MPa", stop = "1 MPa" }', "is above its start"),
    "from 0": ("parameters.A={ start = 0.0, stop = 0.1 }", "begin the range above 0"),
    "out of range": ("parameters.nu=0.7", "choose a value with -1 < nu <= 0.5"),
    "another unit": ('physical.R="5 s"', "a length (m) is expected"),
    "noise": ('fit.noise={ load = "1 nm", indentation = "1 nm" }', "fit.noise.load = "),
    "half the noise": ('fit.noise={ load = "1 nN" }', "fit.noise = "),
    "unknown": ("fit.ofsets=true", 'did you mean "offsets"?'),
    "intervals": ('fit.intervals="profil"', 'did you mean "profile"?'),
    "starts": ("fit.starts=0", "fit.starts = 0: "),
    "offsets": ("fit.offsets=1", "this must be true or false"),
    "two depths": ('data.displacement={ column = "depth", unit = "nm" }', "indentation gives the depths already"),
    "a spring": ('physical.spring_constant="1 N/m"', "on which a machine has no effect"),
    "two turns": ('physical.preload="1 uN"', "indentation_max gives it already"),
    "a ratio": ("parameters.modulus=500.0", "a ratio, where [physical] gives quantities with units"),
    "random": ("profile.spectrum={ hurst = 0.5, last = 3 }", "a spectrum draws many punches"),
    "kind": ('kind="fti"', 'did you mean "fit"?'),
}


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_one_sentence(gradhesion: Call, name: str) -> None:
    setting, words = WRONG[name]
    result = gradhesion("validate", "fit.toml", f"--set={setting}")
    assert result.exit_code == 2
    assert words in result.stderr
    assert len(result.stderr.splitlines()) == 1, result.stderr


@pytest.mark.usefixtures("folder")
def test_nothing_searched_is_refused(gradhesion: Call) -> None:
    fixed = ('physical.E_star="10 MPa"', 'physical.work_of_adhesion="30 mJ/m^2"', 'physical.wavelength="0.5 um"')
    result = gradhesion("validate", "fit.toml", *(f"--set={one}" for one in fixed), "--set=parameters.A=0.012")
    assert result.exit_code == 2
    assert "no parameter is fitted; give a range to one, as E_star" in result.stderr


@pytest.mark.usefixtures("folder")
def test_a_surface_without_stiffness_is_refused(gradhesion: Call) -> None:
    told = gradhesion("validate", "fit.toml", "--set=parameters.k=1.0", '--set=physical.c0="1 um"').stderr
    assert "with k = 1 and nu other than 0.5 the surface has no stiffness" in told


def test_what_is_missing_is_said(gradhesion: Call, folder: Path) -> None:
    (folder / "short.toml").write_text(
        'kind = "fit"\n[data]\nfile = "force_curve.csv"\n[parameters]\n[physical]\nR = "1 um"\n'
    )
    told = gradhesion("validate", "short.toml").stderr
    for name in ("data.load", "data.indentation", "parameters.k", "parameters.nu", "physical.E_star", "parameters.A"):
        assert f"{name}: " in told, name
    (folder / "map.toml").write_text((folder / "fit.toml").read_text().replace('kind  = "fit"', 'kind = "map"'))
    told = gradhesion("validate", "map.toml").stderr
    assert "data = " in told
    assert 'write kind = "fit"' in told


FILES: dict[str, tuple[str, str]] = {
    "0 bytes": ("", "the file has 0 bytes"),
    "comments": ("# nothing\n", "the file has comments only"),
    "no numbers": ("depth,force\n1.0,x\n", 'line 2: force = "x" is not a number; write one'),
    "a line": ("depth,force\n" + "".join(f"{i},{i}\n" for i in range(50)), "the data show no contact"),
    "few": (
        "depth,force\n0,1\n1,2\n0,1\n",
        "3 points are too few for 6 fitted values (E_star, work_of_adhesion, wavelength, A",
    ),
    "all nan": ("depth,force\nnan,1\nnan,2\n", "no row has numbers in all of its columns"),
    "flat": ("depth,force\n" + "".join(f"{i % 20},1\n" for i in range(50)), "all values of the load are the same"),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_no_loop_is_refused(gradhesion: Call, folder: Path, name: str) -> None:
    text, words = FILES[name]
    (folder / "force_curve.csv").write_text(text)
    result = gradhesion("validate", "fit.toml")
    assert result.exit_code == 2
    assert words in result.stderr
    assert len(result.stderr.splitlines()) == 1, result.stderr


def test_a_file_of_a_gigabyte_is_refused_at_once(gradhesion: Call, folder: Path) -> None:
    with (folder / "force_curve.csv").open("wb") as file:
        file.truncate(2**30)  # a hole, that takes no room
    assert "the file is larger than 512 MiB; split it" in gradhesion("validate", "fit.toml").stderr


def test_rows_without_a_number_are_counted_and_left_out(gradhesion: Call, folder: Path) -> None:
    lines = (folder / "force_curve.csv").read_text().splitlines()
    (folder / "force_curve.csv").write_text("\n".join([*lines[:30], "nan,1.0", "2.0,nan", *lines[30:]]) + "\n")
    result = gradhesion("validate", "fit.toml")
    assert result.exit_code == 0
    assert "force_curve.csv: 2 rows without a number were left out" in result.stderr
    assert "a fit of 600 points" in result.stdout


def test_a_column_of_branches_and_one_of_cycles_are_read(folder: Path) -> None:
    lines = (folder / "force_curve.csv").read_text().splitlines()[2:]
    depth = np.array([float(line.split(",")[0]) for line in lines])
    back = np.arange(depth.size) > int(np.argmax(depth))
    rows = [
        f"{line},{'Unloading' if b else 'loading'},{1 + i % 2}"
        for i, (line, b) in enumerate(zip(lines, back, strict=True))
    ]
    (folder / "force_curve.csv").write_text("depth,force,branch,cycle\n" + "\n".join(rows) + "\n")
    study = gr.load("fit.toml", set={"data.branch": "branch", "data.cycle": "cycle"})
    assert study.loop.unloading.tolist() == back.tolist()
    assert study.loop.cycles == 2
    (folder / "force_curve.csv").write_text("depth,force,branch\n" + rows[0].replace("loading,1", "up") + "\n")
    with pytest.raises(
        gr.StudyError,
        match='line 2: branch = "up" is not one of its words; choose from "loading", "unloading", "approach"',
    ):
        gr.load("fit.toml", set={"data.branch": "branch"})


def test_cycles_are_found_in_the_order_of_the_points(folder: Path) -> None:
    lines = (folder / "force_curve.csv").read_text().splitlines()
    (folder / "force_curve.csv").write_text("\n".join([*lines, *lines[2:], *lines[2:]]) + "\n")
    study = gr.load("fit.toml")
    assert study.loop.cycles == 3
    assert study.loop.depth.size == 1800
    found = gr.run(study, set={"fit.intervals": "linear"})
    assert found["measured_cycle"].values.max() == 3
    one = found.sel(parameter="E_star")
    assert abs(float(one["value"]) - 1e7) < 6.0 * float(one["standard_deviation"]), (
        "thrice the same noise: 3^(1/2) of it"
    )


def test_noise_is_estimated_where_it_is_not_given(gradhesion: Call, folder: Path) -> None:
    text = (folder / "fit.toml").read_text()
    (folder / "fit.toml").write_text("\n".join(line for line in text.splitlines() if not line.startswith("noise")))
    study = gr.load("fit.toml")
    assert study.noise == pytest.approx((0.25e-9, 7e-9), rel=0.5)
    assert "noise estimated from differences of neighbours" in gradhesion("validate", "fit.toml").stderr


def test_retract_only_is_fitted(folder: Path) -> None:
    lines = (folder / "force_curve.csv").read_text().splitlines()
    depth = np.array([float(line.split(",")[0]) for line in lines[2:]])
    (folder / "force_curve.csv").write_text("\n".join([lines[1], *lines[2 + int(np.argmax(depth)) :]]) + "\n")
    found = gr.run("fit.toml", set={"fit.intervals": "linear"})
    for i, value in enumerate(TRUE.values()):
        assert abs(float(found["value"][i]) - value) < 5.0 * float(found["standard_deviation"][i])


def test_the_displacement_of_a_machine_is_fitted_with_its_spring(folder: Path) -> None:
    """Points of a smooth ball pushed through a spring, by the closed forms of Johnson, Kendall & Roberts (1971)."""
    R, E_star, work, S = 5e-6, 1e7, 0.03, 20.0

    def at(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        load = 4.0 * E_star * a**3 / (3.0 * R) - np.sqrt(8.0 * math.pi * work * E_star * a**3)
        return a**2 / R - np.sqrt(2.0 * math.pi * a * work / E_star) + load / S, load

    fine = np.linspace(1e-7, 1.4e-6, 20_001)
    moved, _ = at(fine)
    first = fine[moved > 0.0][0] if moved[0] < 0.0 else fine[0]
    last = fine[int(np.argmin(moved))]
    up, down = at(np.linspace(first, 1.3e-6, 150)), at(np.linspace(1.3e-6, last, 250)[1:])
    rng = np.random.default_rng(8)
    depth, load = (np.concatenate(each) for each in zip(up, down, strict=True))
    noisy = 1e9 * depth + 0.3 * rng.standard_normal(depth.size), 1e9 * load + 5.0 * rng.standard_normal(depth.size)
    rows = "".join(f"{x:.4f},{y:.4f}\n" for x, y in zip(*noisy, strict=True))
    (folder / "force_curve.csv").write_text("piezo [nm],force [nN]\n" + rows)
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
    assert found["parameter"].values.tolist()[:3] == ["E_star", "work_of_adhesion", "spring_constant"]
    for i, value in enumerate((E_star, work, S, 0.0, 0.0)):
        assert abs(float(found["value"][i]) - value) < 4.0 * float(found["standard_deviation"][i])
    assert float(found["standard_deviation"][2]) < 0.1 * S
    assert found.attrs["control"] == "machine"
