"""Datasets that somebody has changed, at random or as was found to matter."""

import random
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import netCDF4
import numpy as np
import pytest
from click.testing import Result

from tests.adversary import datasets
from tests.adversary.commands import fault_of

pytestmark = pytest.mark.slow

Call = Callable[..., Result]


PUNCH: Final = "[parameters]\nk = [0.0, 0.31]\nnu = 0.3\nmodulus = 430.0\nc0_over_R = 0.013\n"
MAP: Final = f"""\
outputs = ["pull_off_force", "dissipated_energy", "loading_jumps"]
{PUNCH}lambda_over_R = {{ start = 0.11, stop = 0.47, num = 3, spacing = "log" }}
A = [0.0, 0.023]
a_max_over_R = [1.7, inf]
"""
CURVES: Final = f"""\
kind = "curve"
outputs = ["equilibrium", "path", "jumps"]
{PUNCH}lambda_over_R = 0.2
A = 0.02
a_max_over_R = 1.7
"""
POINTS: Final = """\
layout = "points"
outputs = ["pull_off_force", "pull_off_radius"]
[method]
solver = ["exact", "envelope"]
[parameters]
k = [0.0, 0.3]
nu = 0.3
A = [0.01, 0.02]
[physical]
R = "1 um"
E_star = "1 GPa"
work_of_adhesion = "50 mJ/m^2"
c0 = "13 nm"
wavelength = ["100 nm", "200 nm"]
a_max = "1 um"
"""
STATES: Final = CURVES.replace('"equilibrium", "path", "jumps"', '"pressure", "surface"')


def test_datasets_changed_at_random_end_in_a_sentence(tmp_path: Path) -> None:
    """Each kind of dataset, changed in one to three places; every command takes it, or says what is wrong."""
    draw, files = random.Random(1), []
    for number, text in enumerate((MAP, CURVES, POINTS, STATES)):
        study = tmp_path / f"{number}.toml"
        study.write_text(text)
        files.append(tmp_path / f"{number}.nc")
        assert not fault_of("run", study, "-o", files[-1], codes=(0,))
    changed, joined = tmp_path / "changed.nc", tmp_path / "joined.nc"
    for trial in range(40):
        file = draw.choice(files)
        if draw.random() < 0.15:
            changed.write_bytes(datasets.damage(file.read_bytes(), draw))
            what = "bytes"
        else:
            content = datasets.Content.of(file)
            what = "; ".join(datasets.mutate(content, draw) for _ in range(draw.choice([1, 1, 2, 3])))
            content.write(changed)
        commands = [
            ("info",),
            ("info", "--format", "csv"),
            ("info", "--jumps"),
            ("verify", "--sample", "1"),
            ("status",),
        ]
        commands.append(("merge", str(files[0]), "-o", str(joined), "--overwrite"))
        if trial % 20 == 0:  # they take longest
            commands += [("plot", "--overwrite"), ("explore", "--overwrite")]
        for name, *options in commands:
            assert not (fault := fault_of(name, changed, *options)), f"{name}: {fault} ({file.stem}: {what})"


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
