"""The short form of the adversary, and the files that it found."""

import random
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from click.testing import Result

from tests.adversary import datasets
from tests.adversary.commands import fault_of
from tests.adversary.names import faults_of_names
from tests.adversary.scenes import trials_of_scenes
from tests.adversary.trials import CURVES, STATES, of_datasets, of_parts

pytestmark = pytest.mark.slow

Call = Callable[..., Result]


@pytest.mark.parametrize("seed", [1, 2])
def test_datasets_changed_at_random_end_in_a_sentence(seed: int, tmp_path: Path) -> None:
    assert not of_datasets(tmp_path, 30, random.Random(seed))


@pytest.mark.parametrize("seed", [1, 2])
def test_folders_of_parts_changed_at_random_end_in_a_sentence(seed: int, tmp_path: Path) -> None:
    assert not of_parts(tmp_path, 15, random.Random(seed))


@pytest.mark.parametrize("seed", [1, 2])
def test_hostile_names_end_in_a_sentence(seed: int, tmp_path: Path) -> None:
    assert not faults_of_names(tmp_path, 10, random.Random(seed))


def test_scenes_keep_what_is_promised() -> None:
    words, worst = trials_of_scenes(80, 3)
    assert worst <= 1.0, words
    assert words.startswith("80 scenes")


@pytest.mark.skipif(shutil.which("strace") is None, reason="strace is not there")
def test_kills_at_system_calls_lose_nothing(root: Path) -> None:
    code = "from tests.adversary.kills import trials_of_kills; print(trials_of_kills(23))"
    done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    killed, calls = re.match(r"(\d+) runs killed at (\d+) system calls", done.stdout).groups()
    assert int(killed) >= 8
    assert int(calls) > 100


@pytest.mark.skipif(
    subprocess.run(
        ["unshare", "-m", "mount", "-t", "tmpfs", "none", "/mnt"], check=False, capture_output=True
    ).returncode
    != 0
    if shutil.which("unshare")
    else True,
    reason="no disk can be mounted here",
)
def test_disks_that_are_full_read_only_or_gone_lose_nothing(root: Path) -> None:
    """A run is stopped before its 1st, 8th ... change of a name; the dataset gets its name by the 12th."""
    command = [sys.executable, "-m", "tests.adversary.disks", "7", "2"]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    ended = {what: int(failed) for what, failed in re.findall(r"([^:;]+): [\d,]+ \((\d+) ended with", done.stdout)}
    assert ended.keys() == {
        "runs on full disks, page by page",
        *(f" {what} at a {when}" for what in ("read-only", "gone") for when in ("change of a name", "random moment")),
    }
    assert ended["runs on full disks, page by page"] > 0
    assert ended[" read-only at a change of a name"] > 0, "before the first nothing is open for writing"
    assert ended[" gone at a change of a name"] >= 2


ATTRIBUTES = ["title", "source", "history", "profile", "control", "study", "study_sha256", "numpy_version"]


@pytest.fixture
def dataset_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Path:
    path = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return path


def tried(path: Path) -> None:
    """Try every command that reads a dataset."""
    for command in ("info", "verify", "plot", "explore", "status"):
        assert not fault_of(command, path, *(["--overwrite"] if command in ("plot", "explore") else [])), command
    assert not fault_of("info", path, "--format", "csv")
    assert not fault_of("merge", path, path.with_name("none.nc"), "-o", path.with_name("joined.nc"))


@pytest.mark.parametrize("value", [None, 1, 2.5, [1.0, 2.0], "\x1b[31m$\\bad{"])
@pytest.mark.parametrize("name", ATTRIBUTES)
def test_an_attribute_that_is_missing_or_mistyped(name: str, value: Any, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        if value is None:
            file.delncattr(name)
        else:
            file.setncattr(name, value)
    tried(dataset_file)


@pytest.mark.parametrize("units", ["days since 2000-01-01", "hours", 3, "\x1b[31m"])
@pytest.mark.parametrize("name", ["status", "k", "pull_off_force"])
def test_odd_units(name: str, units: Any, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file[name].units = units
    tried(dataset_file)


@pytest.mark.parametrize("value", [np.inf, np.nan, -1.0, 0.31])
@pytest.mark.parametrize("name", ["k", "lambda_over_R", "a_max_over_R", "nu"])
def test_odd_coordinates(name: str, value: float, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        if file[name].ndim:
            file[name][0] = value
        else:
            file[name][...] = value
    tried(dataset_file)


@pytest.mark.parametrize(("name", "dtype"), [("a_max_over_R", "S1"), ("status", "str"), ("dissipated_energy", "i1")])
def test_a_variable_of_another_type(name: str, dtype: str, dataset_file: Path) -> None:
    content = datasets.Content.of(dataset_file)
    content.variables[name].dtype = dtype
    content.variables[name].attributes.pop("_FillValue", None)
    content.variables[name].values = np.zeros_like(content.variables[name].values).astype(dtype)
    content.write(dataset_file)
    tried(dataset_file)


@pytest.mark.parametrize("value", [2**62, np.inf, "x"])
def test_odd_scales(value: Any, gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path) -> None:
    """What decodes whole numbers by a whole number has no NaN for those that are missing."""
    path = tmp_path / "out.nc"
    assert gradhesion("run", write_study(CURVES), "-o", path, "--quiet").exit_code == 0
    with netCDF4.Dataset(path, "a") as file:
        file["path_branch"].scale_factor = value
    tried(path)


@pytest.mark.parametrize("value", [-np.inf, 1.0])
@pytest.mark.parametrize(
    ("study", "names"),
    [
        (CURVES, ["indentation"]),
        (CURVES, ["path_load", "contact_radius"]),
        (STATES, ["pressure"]),
        (STATES, ["pressure_radius", "surface_displacement"]),
    ],
)
def test_curves_of_one_value(
    study: str, names: list[str], value: float, gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    """What is everywhere the same, or nowhere finite, has no limits to draw it between."""
    path = tmp_path / "out.nc"
    assert gradhesion("run", write_study(study), "-o", path, "--quiet").exit_code == 0
    with netCDF4.Dataset(path, "a") as file:
        for name in names:
            file[name][:] = value
        file["status"][...] = 0
    tried(path)


@pytest.mark.parametrize("command", ["info", "plot", "explore", "verify"])
def test_a_small_file_of_endless_cells_is_refused_at_once(command: str, gradhesion: Call, tmp_path: Path) -> None:
    path = tmp_path / "huge.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.title, file.source = "huge", "gradhesion 0.1.0"
        file.createDimension("k", 2**18)
        file.createDimension("A", 2**18)
        status = file.createVariable("status", "i1", ("k", "A"), compression="zlib", chunksizes=(1024, 1024))
        status.flag_meanings = "x"
    result = gradhesion(command, path)
    assert result.exit_code == 2
    assert (
        f"{path}: was changed or is damaged (status cannot have 68,719,476,736 values in so small a file)"
        in result.stderr
    )
