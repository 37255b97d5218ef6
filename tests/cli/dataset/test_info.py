"""`gradhesion info` tells what a dataset holds; every command says what is wrong with a file that is not one."""

from collections.abc import Callable
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray

from gradhesion.cli.terminal.messages import printable
from gradhesion.core.problem.status import OF_EVERY_MAP as FLAGS
from tests.cli.conftest import Call, Made, Patch, Told


def test_it_tells_axes_fixed_values_and_status(gradhesion: Call, dataset_file: Path, made: Made) -> None:
    told = " ".join(gradhesion("info", dataset_file).stdout.split())
    for words in (
        "k 0, 0.31 lambda_over_R 0.11, 0.227376, 0.47 A 0, 0.023 a_max_over_R 0.7, inf",
        "nu 0.27 modulus 430 c0_over_R 0.013",
        "24 of 24 scenes (100.0%)",
    ):
        assert words in told
    waves = {"start": 0.11, "stop": 0.47, "num": 20, "spacing": "log"}
    long = made(parameters={"lambda_over_R": waves, "A": {"start": 0, "stop": 0.1, "num": 11}})
    told = gradhesion("info", long).stdout
    assert "20 values from 0.11 to 0.47, log-spaced" in told
    assert "11 values from 0 to 0.1, evenly spaced" in told
    assert "was not tested" not in told
    assert "was not tested" in gradhesion("info", made(outputs=["pull_off_force"])).stdout


@pytest.mark.parametrize("chunk", ["1", "131072"])
def test_extremes_and_flags_across_blocks(chunk: str, gradhesion: Call, dataset_file: Path, monkeypatch: Patch) -> None:
    monkeypatch.setenv("GRADHESION_CHUNK", chunk)
    status = np.zeros(24, dtype=np.int8)
    for number, bit in enumerate(FLAGS.values()):
        status[: 3 * number] |= bit
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][:] = status.reshape(file["status"].shape)
        values = np.ones((2, 3, 2, 2))
        values[1, 2, 0, 1], values[0, 1, 1, 0], values[0, 0, 0, 0] = 9.0, -2.0, np.nan
        file["pull_off_force"][:] = values
    lines = [" ".join(line.split()) for line in gradhesion("info", dataset_file).stdout.splitlines()]
    assert "min -2 at k = 0, lambda_over_R = 0.227376, A = 0.023, a_max_over_R = 0.7" in lines
    assert "max 9 at k = 0.31, lambda_over_R = 0.47, A = 0, a_max_over_R = inf" in lines
    first = lines.index("status: 6 of 24 scenes (25.0%) have values")  # the last flag, no_value, is set in 18
    flags = [line.partition(" %)")[0] for line in lines[first + 1 : lines.index("origin") - 1]]
    expected = [f"{name} {3 * i} of 24 scenes ({12.5 * i:.2g}" for i, name in enumerate(FLAGS)]
    assert flags == expected[1:], "one that does not occur is not told"


def damaged_values(content: bytes, path: Path) -> bytes:
    """Damage a compressed chunk so that the file opens and its values cannot be read."""
    start = content.find(b"x\x01")
    while start >= 0:
        damaged = content[: start + 2] + b"\xff" * 6 + content[start + 8 :]
        path.write_bytes(damaged)
        try:
            with netCDF4.Dataset(path) as file:
                try:
                    file["pull_off_force"][:]
                except RuntimeError:
                    return damaged
        except (OSError, RuntimeError):
            pass
        start = content.find(b"x\x01", start + 2)
    pytest.fail("there is no such chunk")


@pytest.mark.parametrize("damage", ["missing", "folder", "text", "empty", "truncated", "flipped", "foreign"])
def test_a_file_that_is_no_dataset_of_ours(damage: str, gradhesion: Call, dataset_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "bad.nc"
    content = dataset_file.read_bytes()
    if damage == "folder":
        path.mkdir()
    elif damage == "foreign":
        with netCDF4.Dataset(path, "w") as file:
            file.title = "something else"
    elif damage != "missing":
        contents = {"text": b"title = 1", "empty": b"", "truncated": content[: len(content) * 2 // 3]}
        path.write_bytes(contents[damage] if damage in contents else damaged_values(content, path))
    for command in ("info", "plot", "explore", "verify"):
        result = gradhesion(command, path, code=2)
        assert result.stderr.startswith(f"{path}: ")
        assert "gradhesion run" in result.stderr, "it tells what to do"
        assert result.stdout == "" or damage == "flipped"


CHANGES: dict[str, Callable[[xarray.Dataset], xarray.Dataset]] = {
    "a status with gaps": lambda whole: whole.assign(status=whole["status"].where(whole["k"] > 0)),
    "no scene": lambda whole: whole.isel(k=[]),
    "a mean beside values": lambda whole: whole.assign(pull_off_force=whole["pull_off_force"].mean("A")),
    "no values of an axis": lambda whole: whole.drop_vars("A"),
}
"""What other programs may have made of a dataset."""


@pytest.mark.parametrize("change", CHANGES)
def test_what_a_dataset_lacks_is_said(change: str, refusal: Told, dataset_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "changed.nc"
    with xarray.open_dataset(dataset_file) as whole:
        CHANGES[change](whole).to_netcdf(path)
    for command in ("info", "plot", "verify"):
        assert refusal(command, path).startswith(f"{path}: ")


def test_jumps_of_some_scenes_do_not_belong_to_others(refusal: Told, made: Made, tmp_path: Path) -> None:
    """As where a user takes scenes of a dataset of jumps with xarray, which does not know that the two belong together."""
    with xarray.open_dataset(made(kind="curve", outputs=["jumps"], parameters={"a_max_over_R": 0.7})) as whole:
        whole.isel(A=[1]).to_netcdf(tmp_path / "part.nc")
    assert "jump_count" in refusal("info", tmp_path / "part.nc")


def test_a_study_that_was_changed_is_told(gradhesion: Call, dataset_file: Path) -> None:
    assert "changed since" not in gradhesion("info", dataset_file).stdout
    with netCDF4.Dataset(dataset_file, "a") as file:
        file.study += "# and more\n"
    assert "changed since" in gradhesion("info", dataset_file).stdout


def test_what_a_dataset_says_is_data(gradhesion: Call, dataset_file: Path) -> None:
    """Words that a terminal obeys, formulas that are none and studies that are programs are printed or drawn as text."""
    hostile = "\x1b[31m$\\bad{ </script> {0.__class__} %s"
    with netCDF4.Dataset(dataset_file, "a") as file:
        file.setncatts(dict.fromkeys(("title", "history", "profile", "study", "study_sha256"), hostile))
        for name in ("k", "status", "pull_off_force"):
            file[name].setncatts({"units": hostile, "long_name": hostile})
    for command in (["info"], ["info", "--format", "csv"], ["plot"], ["explore"], ["verify"]):
        result = gradhesion(*command, dataset_file, code=(2 if command == ["verify"] else 0))
        assert printable(result.output) == result.output
