"""`gradhesion run` writes the dataset that the study asks for, with the right code; the first run of a version says once that it compiles."""

import os
import re
import stat
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from filelock import FileLock

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import load_study, study_from
from gradhesion.cli.work import compiling
from gradhesion.core import PARAMETERS
from gradhesion.core.jit import Place
from gradhesion.core.problem.status import OF_EVERY_MAP
from tests.cli.conftest import Call, Called, Made, Patch

SOLVE = "gradhesion.cli.work.solve.scenes.solve"
Printed = pytest.CaptureFixture[str]


def test_the_dataset_keeps_its_contract(dataset_file: Path, study_file: Path) -> None:
    with netCDF4.Dataset(dataset_file) as file:
        assert file.data_model == "NETCDF4"
        assert list(file.dimensions) == ["k", "lambda_over_R", "A", "a_max_over_R"]
        expected = {name: ((name,) if name in file.dimensions else ()) for name in PARAMETERS}
        assert {name: file[name].dimensions for name in PARAMETERS} == expected
        types = {name: file[name].dtype.name for name in file.variables if name not in PARAMETERS}
        floats = {"pull_off_force": "float64", "dissipated_energy": "float64"}
        assert types == floats | {"loading_jumps": "int32", "status": "int8"}
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
        assert file.Conventions == "CF-1.11"
        assert file.title == "A small study"
        assert re.fullmatch(r"gradhesion \d+\.\d+\.\d+.*", file.source)
        assert (file.study, file.study_sha256) == (study_file.read_text(), load_study(study_file).sha256)
        versions = {f"{name}_version" for name in ("python", "numpy", "numba", "scipy")}
        assert {"history", "references"} | versions <= {*file.ncattrs()}
        assert all(isinstance(file.getncattr(name), str) for name in file.ncattrs())


def test_chunks_are_near_one_megabyte(made: Made) -> None:
    wide = {"k": {"start": 0, "stop": 0.9, "num": 50}, "A": {"start": 0, "stop": 0.9, "num": 900}}
    method = {"solver": "envelope"}
    with netCDF4.Dataset(made(parameters=wide, outputs=["pull_off_force"], method=method)) as file:
        chunk = file["pull_off_force"].chunking()
        assert 2**18 < 8 * np.prod(chunk) <= 2**20
        assert np.isfinite(file["pull_off_force"][:]).any()


def test_values_do_not_depend_on_blocks_or_threads(data: dict[str, Any]) -> None:
    """A block of 128 exponents or more has interpolated tables, a smaller one those of its own."""
    scenes = np.random.default_rng(7).uniform(0.05, 0.45, (4, 150))
    lists = dict(zip(("k", "lambda_over_R", "A", "a_max_over_R"), scenes.tolist(), strict=True))
    study = study_from(data | {"layout": "points", "parameters": data["parameters"] | lists})
    whole = compute(study, threads=1)
    xarray.testing.assert_identical(compute(study, threads=2), whole)
    rounding = 512 * 2.0**-52  # terms of a value and of the tables that it is made of: some hundred eps
    xarray.testing.assert_allclose(compute(replace(study, chunk=2), threads=2), whole, rtol=rounding, atol=0.0)


def test_a_list_of_one_value_is_an_axis(made: Made) -> None:
    fixed = {"k": 0.2, "lambda_over_R": 0.3, "A": 0.1}
    for rims, sizes in (([np.inf], {"a_max_over_R": 1}), (2.0, {})):
        with xarray.open_dataset(made(parameters=fixed | {"a_max_over_R": rims})) as dataset:
            assert dict(dataset.sizes) == sizes
            assert np.isfinite(dataset["pull_off_force"].values).all()


def test_the_default_output_and_message(gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(tmp_path)
    result = gradhesion("run", study_file, code=0)
    assert result.stdout == ""
    assert re.search(r"outputs/study.nc: 24 scenes in [\d.]+ s \([\d,]+ per s\), [\d.]+ kB\n$", result.stderr)
    assert os.listdir("outputs") == ["study.nc"]
    mask = os.umask(0)
    os.umask(mask)
    assert stat.S_IMODE(Path("outputs/study.nc").stat().st_mode) == 0o666 & ~mask
    quiet = gradhesion("run", study_file, "-o", tmp_path / "x.nc", "--quiet")
    assert (quiet.stdout, quiet.stderr) == ("", "")


def test_an_output_that_cannot_be_is_refused(run: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(SOLVE, lambda *_, **__: pytest.fail("nothing is computed"))
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").touch()
    (tmp_path / "old.nc").write_text("precious")
    for output in ("old.nc", "folder", "file/out.nc", "/proc/out.nc", "/dev/null", "x" * 300 + ".nc"):
        overwrite = [] if output == "old.nc" else ["--overwrite"]
        result = run("-o", tmp_path / output, *overwrite, code=4)
        assert result.stderr.startswith(str(tmp_path / output))
        assert "-o" in result.stderr, "it tells what to do"
        assert (tmp_path / "old.nc").read_text() == "precious"


def test_an_output_is_replaced_if_asked_and_a_link_followed(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    link, real = tmp_path / "link.nc", tmp_path / "real" / "real.nc"
    real.parent.mkdir()
    link.symlink_to(real)
    for overwrite in ([], ["--overwrite"]):
        assert gradhesion("run", study_file, "-o", link, *overwrite).exit_code == 0
        assert link.is_symlink()
        with xarray.open_dataset(real) as dataset:
            assert dataset.sizes["k"] == 2
        real.write_text("old")


@pytest.mark.parametrize("limit", [300, 20_000])
def test_a_failed_write_loses_nothing(limit: int, study_file: Path, tmp_path: Path, on_a_full_disk: Called) -> None:
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


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: Patch) -> Path:
    """A folder for compiled code, in which no process has compiled yet."""
    folder = tmp_path / "kernels"
    folder.mkdir()
    monkeypatch.setattr(compiling, "place", lambda: Place(folder, ""))
    return folder


def test_what_is_first_says_that_it_compiles_and_neither_the_next_nor_another_process_says_it_again(
    folder: Path, gradhesion: Call, study_file: Path, data: dict[str, Any], monkeypatch: Patch, capsys: Printed
) -> None:
    """A run, also where it is quiet, a plan, and Python; and why nothing is kept."""
    run, plan = ("run", study_file, "--quiet", "--overwrite", "-o", folder / "x.nc"), ("plan", study_file, "--json")
    for name, *commands in (("run first", run, run, plan), ("plan first", plan, run), ("in Python",)):
        (folder / name).mkdir()
        monkeypatch.setattr(compiling, "place", lambda name=name: Place(folder / name, ""))
        said = [len(gradhesion(*command).stderr.splitlines()) for command in commands]
        assert said == [1, 0, 0][: len(commands)], name
    scene = dict.fromkeys(data["parameters"], 0.3) | {"A": 0.01}
    for said in (1, 0):
        for call in (lambda: gr.solve(scene, "pull_off_force"), lambda: gr.curves(scene, "path")):
            call()  # each compiles something else
            assert len(capsys.readouterr().err.splitlines()) == said
        monkeypatch.setattr(compiling, "_begun", set())
    compute(study_from(data | {"outputs": ["pull_off_force"]}))
    assert capsys.readouterr().err == ""
    compute(study_from(data | {"outputs": ["dissipated_energy"]}))
    assert len(capsys.readouterr().err.splitlines()) == 1
    waves = {"lambda_over_R": {"start": 0.1, "stop": 0.2}}
    search = {"maximise": "pull_off_force", "over": ["lambda_over_R"], "resolution": 5}
    for said in (1, 0):  # the goal and its slope, no curve
        gr.run({"kind": "optimum", "optimum": search, "parameters": data["parameters"] | waves})
        assert len(capsys.readouterr().err.splitlines()) == said
    monkeypatch.setattr(compiling, "place", lambda: Place(None, "a folder is not used, and why"))
    monkeypatch.setattr(compiling, "_begun", set())
    for is_first in (True, False):
        compute(study_from(data))
        assert ("a folder is not used, and why" in capsys.readouterr().err) == is_first


def test_what_starts_while_another_process_compiles_waits_for_it(folder: Path) -> None:
    """The other process is this one: it holds the lock."""
    waiting = threading.Thread(target=compiling.prepare)
    with FileLock(folder / "lock"):
        waiting.start()
        waiting.join(0.3)
        assert waiting.is_alive()
    waiting.join(60)
    assert not waiting.is_alive()


@pytest.mark.usefixtures("folder")
def test_a_map_compiles_what_it_needs_before_it_is_solved(data: dict[str, Any], monkeypatch: Patch) -> None:
    """A scene at either end of its axes is solved; blocks that raise are left to the run."""
    solved: list[Any] = []

    def solve_block(_study: Any, block: Any, _threads: Any) -> None:
        solved.append(block)
        raise ZeroDivisionError

    monkeypatch.setattr(compiling, "solve_block", solve_block)
    study = study_from(data)
    compiling.prepare(study)
    ends = [tuple((part.start, part.stop) for part in block) for block in solved]
    assert ends == [tuple((0, 1) for _ in study.shape), tuple((size - 1, size) for size in study.shape)]


@pytest.mark.usefixtures("folder")
def test_a_warmup_takes_the_options_of_earlier_versions(gradhesion: Call, monkeypatch: Patch) -> None:
    asked: list[bool] = []
    monkeypatch.setattr("gradhesion.core.warm_up", lambda _report, *, everything: asked.append(everything))
    for arguments in ([], ["--all"], ["--all", "--workers", "2", "--quiet"]):
        assert ("--quiet" in arguments) == (gradhesion("warmup", *arguments, code=0).stderr == "")
    assert asked == [False, True, True]
