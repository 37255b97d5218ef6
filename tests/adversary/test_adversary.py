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
from tests.adversary.trials import CURVES, MAP, STATES, of_datasets, of_parts

pytestmark = pytest.mark.slow

Call = Callable[..., Result]


def test_datasets_changed_at_random_end_in_a_sentence(tmp_path: Path) -> None:
    assert not of_datasets(tmp_path, 30, random.Random(1))


def test_folders_of_parts_changed_at_random_end_in_a_sentence(tmp_path: Path) -> None:
    assert not of_parts(tmp_path, 15, random.Random(1))


def test_hostile_names_end_in_a_sentence(tmp_path: Path) -> None:
    assert not faults_of_names(tmp_path, 10, random.Random(1))


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


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small dataset that nobody has changed."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "study.toml").write_text(MAP)
    assert not fault_of("run", folder / "study.toml", "-o", folder / "out.nc", "--quiet", codes=[0])
    return folder / "out.nc"


@pytest.fixture
def dataset_file(whole: Path, tmp_path: Path) -> Path:
    return shutil.copyfile(whole, tmp_path / "out.nc")


DRAWN = ("plot", "explore")


def tried(path: Path, *, drawn: bool | None = None) -> None:
    """Try every command that reads a dataset; a change that hides no other is `drawn`, others end before they are."""
    for command in ("info", "verify", *DRAWN, "status"):
        codes = (0, 2, 3, 4) if drawn is None or command not in DRAWN else (0,) if drawn else (2,)
        assert not fault_of(command, path, *(["--overwrite"] if command in DRAWN else []), codes=codes), command
    assert not fault_of("info", path, "--format", "csv")
    assert not fault_of("merge", path, path.with_name("none.nc"), "-o", path.with_name("joined.nc"))


TERMINAL = "\x1b[31m$\\bad{"
"""What a terminal obeys, and no formula."""
SHOWN = ("history", "profile", "numpy_version")
ATTRIBUTES: dict[str, dict[str, Any]] = {
    "what is shown is missing": dict.fromkeys((*SHOWN, "control")),
    "what is shown is no word": dict.fromkeys((*SHOWN, "title"), TERMINAL),
    "no study": {"study": None},
    "the study is no study": {"study": TERMINAL},
    "no digest of the study": {"study_sha256": None},
    "another digest": {"study_sha256": TERMINAL},
}
"""Changes with which a dataset is drawn, all of one row at once."""
REFUSED: dict[str, tuple[Any, ...]] = dict.fromkeys((*SHOWN, "study", "study_sha256"), (1, [1.0, 2.0]))
REFUSED |= {"title": (None, 2.5, [1.0, 2.0]), "source": (None, 1, [1.0], TERMINAL), "control": (2.5, [1.0], TERMINAL)}
"""Attributes without one of which, or with one of another type, it is not."""


def changed(path: Path, attributes: dict[str, Any]) -> Path:
    """Set attributes of a dataset, or delete those that are None."""
    with netCDF4.Dataset(path, "a") as file:
        for name, value in attributes.items():
            file.delncattr(name) if value is None else file.setncattr(name, value)
    return path


@pytest.mark.parametrize("change", ATTRIBUTES)
def test_attributes_that_are_missing_or_odd(change: str, dataset_file: Path) -> None:
    tried(changed(dataset_file, ATTRIBUTES[change]), drawn=True)


@pytest.mark.parametrize(
    ("name", "value"),
    [pytest.param(name, value, id=f"{name}={value!r}") for name in REFUSED for value in REFUSED[name]],
)
def test_an_attribute_without_which_it_is_no_dataset(name: str, value: Any, dataset_file: Path) -> None:
    tried(changed(dataset_file, {name: value}), drawn=False)


UNITS = ("status", "k", "pull_off_force")


@pytest.mark.parametrize("units", ["hours", TERMINAL])
def test_odd_units(units: str, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        for name in UNITS:
            file[name].units = units
    tried(dataset_file, drawn=True)


@pytest.mark.parametrize("units", ["days since 2000-01-01", 3])
@pytest.mark.parametrize("name", UNITS)
def test_units_that_make_dates_of_numbers_or_are_none(name: str, units: Any, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file[name].units = units
    tried(dataset_file, drawn=False)


@pytest.mark.parametrize(
    ("values", "drawn"),
    [
        ({"k": -1.0, "lambda_over_R": -1.0, "a_max_over_R": -1.0, "nu": -1.0}, True),
        ({"lambda_over_R": 0.31, "a_max_over_R": 0.31, "nu": np.nan}, True),
        ({"nu": np.inf}, True),
        *(({name: value}, False) for name in ("k", "lambda_over_R", "a_max_over_R") for value in (np.inf, np.nan)),
        ({"k": 0.31}, False),  # twice
    ],
)
def test_odd_coordinates(values: dict[str, float], drawn: bool, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        for name, value in values.items():
            file[name][0 if file[name].ndim else ...] = value
    tried(dataset_file, drawn=drawn)


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
