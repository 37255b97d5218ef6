"""`gradhesion run` writes the dataset that the study asks for, and leaves with the right code."""

import os
import re
import stat
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.names.outputs import OUTPUTS
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.work.solve.scenes import solve as real_solve
from gradhesion.core import FAILED
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.outputs import OUTPUTS as DECLARED
from gradhesion.core.problem.status import OF_EVERY_MAP

Call = Callable[..., Result]


@pytest.fixture
def dataset_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Path:
    """The dataset of the small study."""
    path = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return path


def test_the_names_are_those_of_the_core() -> None:
    from gradhesion import core
    from gradhesion.core.problem.names import EDGE, RATE

    assert tuple(PARAMETERS) == tuple(core.PARAMETERS)
    edges = (*EDGE, *RATE)
    assert tuple(OUTPUTS) == (
        *core.OUTPUTS,
        *edges,
        *core.REPORTS,
        *core.VALIDITY,
        "contact_slope",
        *core.SENSITIVITIES,
    )
    exact_alone = {name for name, one in DECLARED.items() if one.exact_alone}
    assert exact_alone == {*core.REPORTS, *core.SENSITIVITIES, "snap_in_force"}


def test_the_dataset_keeps_its_contract(dataset_file: Path, study_file: Path) -> None:
    with netCDF4.Dataset(dataset_file) as file:
        assert file.data_model == "NETCDF4"
        assert list(file.dimensions) == ["k", "lambda_over_R", "A", "a_max_over_R"]
        assert {name: file[name].dimensions for name in PARAMETERS} == {
            name: ((name,) if name in file.dimensions else ()) for name in PARAMETERS
        }
        types = {name: file[name].dtype.name for name in file.variables if name not in PARAMETERS}
        assert types == {
            "pull_off_force": "float64",
            "dissipated_energy": "float64",
            "loading_jumps": "int32",
            "status": "int8",
        }
        for name, variable in file.variables.items():
            assert variable.units == "1"
            assert variable.long_name
            assert "standard_name" not in variable.ncattrs()
            if name in PARAMETERS:
                assert "_FillValue" not in variable.ncattrs()
            else:
                assert variable.coordinates == "nu modulus c0_over_R"
            if variable.dimensions:
                filters = variable.filters()
                assert (filters["zlib"], filters["complevel"], filters["shuffle"]) == (True, 1, True)
        status = file["status"]
        assert np.atleast_1d(status.flag_masks).tolist() == list(OF_EVERY_MAP.values())
        assert status.flag_masks.dtype == np.int8
        assert status.flag_meanings.split() == list(OF_EVERY_MAP)
        study = load_study(study_file)
        assert file.Conventions == "CF-1.11"
        assert file.title == "A small study"
        assert re.fullmatch(r"gradhesion \d+\.\d+\.\d+.*", file.source)
        assert (file.study, file.study_sha256) == (study_file.read_text(), study.sha256)
        assert {"history", "references", "python_version", "numpy_version", "numba_version", "scipy_version"} <= set(
            file.ncattrs()
        )
        assert all(isinstance(file.getncattr(name), str) for name in file.ncattrs())


def test_the_file_and_the_notebook_have_the_same_dataset(dataset_file: Path, study_file: Path) -> None:
    with xarray.open_dataset(dataset_file) as written:
        computed = compute(load_study(study_file))
        for one in (computed, written):
            del one.attrs["history"]
            masks = one["status"].attrs["flag_masks"]
            one["status"].attrs["flag_masks"] = np.atleast_1d(masks).tolist()
        xarray.testing.assert_identical(computed, written)
        assert {name: v.dtype for name, v in computed.variables.items()} == {
            name: v.dtype for name, v in written.variables.items()
        }


def test_chunks_are_near_one_megabyte(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    wide = ["--set", "parameters.k={start=0, stop=0.9, num=50}", "--set", "parameters.A={start=0, stop=0.9, num=900}"]
    few = ["--set", 'outputs=["pull_off_force"]', "--set", "parameters.modulus=1e9"]
    assert gradhesion("run", study_file, "-o", tmp_path / "wide.nc", *wide, *few).exit_code == 0
    with netCDF4.Dataset(tmp_path / "wide.nc") as file:
        chunk = file["pull_off_force"].chunking()
        assert 2**18 < 8 * np.prod(chunk) <= 2**20
        assert np.isfinite(file["pull_off_force"][:]).all()


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_values_do_not_depend_on_blocks_or_threads(layout: str, data: dict[str, Any]) -> None:
    if layout == "points":
        scenes = np.random.default_rng(7).uniform(0.05, 0.45, (4, 100))
        lists = dict(zip(("k", "lambda_over_R", "A", "a_max_over_R"), scenes.tolist(), strict=True))
        data |= {"layout": "points", "parameters": data["parameters"] | lists}
    whole = compute(study_from(data), threads=1)
    xarray.testing.assert_identical(compute(replace(study_from(data), chunk=2), threads=2), whole)


def test_many_exponents_depend_on_blocks_by_rounding_alone(data: dict[str, Any]) -> None:
    """A block of 128 exponents or more has interpolated tables, a smaller one those of its own."""
    scenes = np.random.default_rng(7).uniform(0.05, 0.45, (4, 150))
    lists = dict(zip(("k", "lambda_over_R", "A", "a_max_over_R"), scenes.tolist(), strict=True))
    study = study_from(data | {"layout": "points", "parameters": data["parameters"] | lists})
    whole = compute(study, threads=1)
    xarray.testing.assert_identical(compute(study, threads=2), whole)
    # terms of a value and of the tables that it is made of: some hundred eps
    xarray.testing.assert_allclose(compute(replace(study, chunk=2), threads=2), whole, rtol=512 * 2.0**-52, atol=0.0)


def test_an_axis_of_one_value_stays_and_a_number_is_scalar(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "one.nc"
    fixed = [f"--set=parameters.{name}={value}" for name, value in {"k": 0.2, "lambda_over_R": 0.3, "A": 0.1}.items()]
    assert gradhesion("run", study_file, "-o", path, *fixed, "--set=parameters.a_max_over_R=[inf]").exit_code == 0
    with xarray.open_dataset(path) as dataset:
        assert dict(dataset.sizes) == {"a_max_over_R": 1}
        assert dataset["a_max_over_R"].item() == np.inf
        assert dataset["k"].shape == ()
    assert (
        gradhesion("run", study_file, "-o", path, *fixed, "--set=parameters.a_max_over_R=2", "--overwrite").exit_code
        == 0
    )
    with xarray.open_dataset(path) as dataset:
        assert dict(dataset.sizes) == {}
        assert np.isfinite(dataset["pull_off_force"].item())


def test_points_have_one_dimension(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "points.nc"
    lists = ["--set=layout='points'", "--set=parameters.lambda_over_R=[0.1, 0.1]"]
    assert gradhesion("run", study_file, "-o", path, *lists).exit_code == 0
    with xarray.open_dataset(path) as dataset:
        assert dict(dataset.sizes) == {"scene": 2}
        assert set(dataset.coords) == set(PARAMETERS)
        assert all(dataset[name].dims == ("scene",) for name in dataset.variables)
        assert dataset["nu"].values.tolist() == [0.27, 0.27]


def test_the_default_output_and_its_message(
    gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = gradhesion("run", study_file)
    assert result.exit_code == 0
    assert result.stdout == ""
    assert re.search(r"outputs/study.nc: 24 scenes in [\d.]+ s \([\d,]+ per s\), [\d.]+ kB\n$", result.stderr)
    assert os.listdir("outputs") == ["study.nc"]
    mask = os.umask(0)
    os.umask(mask)
    assert stat.S_IMODE(Path("outputs/study.nc").stat().st_mode) == 0o666 & ~mask


def test_quiet_is_silent(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    result = gradhesion("run", study_file, "-o", tmp_path / "x.nc", "--quiet")
    assert (result.stdout, result.stderr) == ("", "")


def test_an_existing_output_stays_without_overwrite(
    gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "out.nc"
    path.write_text("precious")
    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.given.solve", lambda *_, **__: pytest.fail("nothing is computed"))
        result = gradhesion("run", study_file, "-o", path)
    assert result.exit_code == 4
    assert result.stderr == f"{path}: exists already; add --overwrite to replace it, or name another output with -o\n"
    assert path.read_text() == "precious"
    assert gradhesion("run", study_file, "-o", path, "--overwrite").exit_code == 0
    assert xarray.open_dataset(path).sizes["k"] == 2


def test_a_link_is_followed(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    link, real = tmp_path / "link.nc", tmp_path / "real" / "real.nc"
    real.parent.mkdir()
    link.symlink_to(real)
    assert gradhesion("run", study_file, "-o", link).exit_code == 0
    assert link.is_symlink()
    assert real.stat().st_size > 1000


@pytest.mark.parametrize("output", ["folder", "file/out.nc", "/proc/out.nc", "/dev/null", "x" * 300 + ".nc"])
def test_an_output_that_cannot_be_is_refused_before_computing(
    output: str, gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", lambda *_, **__: pytest.fail("nothing is computed"))
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").touch()
    result = gradhesion("run", study_file, "-o", tmp_path / output, "--overwrite")
    assert result.exit_code == 4
    assert result.stderr.startswith(str(tmp_path / output))
    assert "-o" in result.stderr, "it tells what to do"


def test_failed_scenes_are_written_and_told(
    gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*arguments: Any, **options: Any) -> dict[str, Any]:
        values = real_solve(*arguments, **options)
        values["status"].flat[3] = FAILED
        values["pull_off_force"].flat[3] = np.nan
        return values

    monkeypatch.setattr("gradhesion.cli.work.solve.given.solve", failing)
    result = gradhesion("run", study_file, "-o", tmp_path / "out.nc", "--quiet")
    assert result.exit_code == 3
    assert f"1 of 24 scenes failed; `gradhesion info {tmp_path}/out.nc` reports why" in result.stderr
    with xarray.open_dataset(tmp_path / "out.nc") as dataset:
        assert int(dataset["pull_off_force"].isnull().sum()) == 1
    told = gradhesion("info", tmp_path / "out.nc").stdout
    assert "status: 23 of 24 scenes (95.8%) have values" in told
    assert re.search(r"no_value +1 of 24 scenes", told)


@pytest.mark.parametrize("limit", [3_000, 20_000, 60_000])
def test_a_failed_write_loses_nothing(
    limit: int, study_file: Path, tmp_path: Path, on_a_full_disk: Callable[..., CompletedProcess[str]]
) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    old = folder / "out.nc"
    old.write_text("precious")
    larger = ["--set", "parameters.A={start=0, stop=0.4, num=3000}", "--set", "parameters.modulus=1e7"]
    done = on_a_full_disk(limit, "run", study_file, "-o", old, "--overwrite", *larger)
    assert done.returncode == 4, done.stderr
    assert f"{old}: cannot be written" in done.stderr
    assert "Traceback" not in done.stderr
    assert old.read_text() == "precious"
    assert os.listdir(folder) == ["out.nc"]


@pytest.mark.parametrize("option", [["--dry-run"], ["--chunk", "7"], ["--fail-fast"], ["--log-json"]])
def test_what_was_given_up_is_refused_with_what_to_use(
    option: list[str], gradhesion: Call, study_file: Path, tmp_path: Path
) -> None:
    result = gradhesion("run", study_file, "-o", tmp_path / "out.nc", *option)
    assert result.exit_code == 2
    assert f"{option[0]} was given up" in result.stderr
    assert not (tmp_path / "out.nc").exists()
