"""`gradhesion info` tells what a dataset holds, few scenes as a table and all as CSV; every command says what is wrong with a file that is none."""

import csv
import io
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.terminal.messages import printable
from gradhesion.core import OUTPUTS, SENSITIVITIES
from gradhesion.core.problem.status import OF_EVERY_MAP as FLAGS
from tests.cli.conftest import Call, Made, Patch, Told

CHANGES: dict[str, Callable[[xarray.Dataset], xarray.Dataset]] = {
    "a status with gaps": lambda whole: whole.assign(status=whole["status"].where(whole["k"] > 0)),
    "no scene": lambda whole: whole.isel(k=[]),
    "a mean beside values": lambda whole: whole.assign(pull_off_force=whole["pull_off_force"].mean("A")),
    "no values of an axis": lambda whole: whole.drop_vars("A"),
}
"""What other programs may have made of a dataset."""
PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
TIP: dict[str, Any] = {"nu": 0.3, "A": 0.0, "R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm"}  # fmt: skip
NO_TABLES = {
    "--format csv": "jumps",
    "--format csv --variable path --variable equilibrium": "path",
    "--format csv --variable pathh": '"path"',
    "--variable path": "--format",
}


def test_it_tells_axes_fixed_values_and_status(gradhesion: Call, dataset_file: Path, made: Made) -> None:
    told = " ".join(gradhesion("info", dataset_file).stdout.split())
    assert "k 0, 0.31 lambda_over_R 0.11, 0.227376, 0.47 A 0, 0.023 a_max_over_R 0.7, inf" in told
    assert "nu 0.27 modulus 430 c0_over_R 0.013" in told
    assert "24 of 24 scenes (100.0%)" in told
    assert "changed since" not in told
    with netCDF4.Dataset(dataset_file, "a") as file:
        file.study += "# and more\n"
    assert "changed since" in gradhesion("info", dataset_file).stdout
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


def damaged_values(path: Path) -> bytes:
    """Damage a compressed chunk so that the file opens and its values cannot be read."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(path) as file:
        start = file["pull_off_force"].id.get_chunk_info(0).byte_offset
    content = path.read_bytes()
    return content[: start + 2] + b"\xff" * 6 + content[start + 8 :]


@pytest.mark.parametrize("damage", ["missing", "folder", "text", "empty", "truncated", "flipped"])
def test_a_file_that_is_no_dataset_of_ours(damage: str, gradhesion: Call, dataset_file: Path, tmp_path: Path) -> None:
    path, content = tmp_path / "bad.nc", dataset_file.read_bytes()
    contents = {"text": b"title = 1", "empty": b"", "truncated": content[: len(content) * 2 // 3]}
    if damage == "folder":
        path.mkdir()
    elif damage != "missing":
        path.write_bytes(contents[damage] if damage in contents else damaged_values(dataset_file))
    for command in ("info", "plot", "explore", "verify"):
        result = gradhesion(command, path, code=2)
        assert result.stderr.startswith(f"{path}: ")
        assert "gradhesion run" in result.stderr, "it tells what to do"
        assert result.stdout == "" or damage == "flipped"


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


@pytest.fixture
def table(gradhesion: Call, tmp_path: Path) -> Callable[..., str]:
    """What `info` says of a dataset, from its values to its status."""

    def tell(dataset: Any, *options: str) -> str:
        dataset.to_netcdf(path := tmp_path / "it.nc")
        result = gradhesion("info", path, *options, code=0)
        return result.stdout.partition("\nvalues\n")[2].partition("\nstatus: ")[0]

    return tell


def table_of(table: str) -> list[list[str]]:
    return [line.split() for line in table.partition("\n\n")[2].splitlines()]


def test_few_scenes_have_a_line_each_with_their_parameters_and_values(table: Callable[..., str]) -> None:
    values = table_of(table(gr.solve(TIP, "pull_off_force", k=[0.0, 0.3], wavelength="1 um")))
    forces = [(3 + k) / 2 * math.pi * 1e-6 * 0.05 for k in (0.0, 0.3)]  # of a smooth punch, in place of the ratio
    assert values == [["k", "pull_off_force_si"], ["0", f"{forces[0]:.7g}"], ["0.3", f"{forces[1]:.7g}"]]
    found = gr.solve(PUNCH, ["loading_jumps"], k=[0.0, 0.3], A=[0.01, 0.02, 0.05])
    rows = [[f"{k:g}", f"{A:g}", str(int(found["loading_jumps"].sel(k=k, A=A)))] for k in (0.0, 0.3) for A in found["A"].values]  # fmt: skip
    assert table_of(table(found))[1:7] == rows
    flagged = gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.1])
    names, *lines = table_of(table(flagged))
    assert names == ["A", "dissipated_energy", "status"]
    assert [int(row[-1]) for row in lines if row] == flagged["status"].values.tolist()


def test_columns_that_do_not_fit_go_on_below(table: Callable[..., str]) -> None:
    outputs = [name for name in OUTPUTS if name not in ("loading_energy", "unloading_energy")]
    told = table(gr.solve(PUNCH, outputs, A=[0.0, 0.01])).partition("\n\n")[2]
    assert max(map(len, told.splitlines())) <= 100
    assert {*outputs} < {*told.split()}


def test_only_few_scenes_have_a_table(table: Callable[..., str]) -> None:
    for scenes in (12, 13):
        found = gr.solve(PUNCH, "pull_off_force", A=[0.001 * i for i in range(scenes)])
        assert bool(table(found)) == (scenes == 12)
        assert len(table_of(table(found, "--at", "A=0.001:0.002"))) == 3, "a part has few scenes"


def test_points_and_solvers_are_told_apart(table: Callable[..., str]) -> None:
    scenes = PUNCH | {"k": [0.0, 0.3], "modulus": [500.0, 600.0], "A": 0.0}
    method = {"solver": ["exact", "envelope"]}
    found = gr.run({"layout": "points", "outputs": ["pull_off_force"], "parameters": scenes, "method": method})
    rows = [[solver, *rest] for solver in method["solver"] for rest in (("0", "500", "1"), ("0.3", "600", "1.1"))]
    assert table_of(table(found)) == [["solver", "k", "modulus", "pull_off_force"], *rows]


def test_a_single_scene_has_a_line_for_each_value_and_none_for_what_has_several(table: Callable[..., str]) -> None:
    newtons = (3 + 0.3) / 2 * math.pi * 1e-6 * 0.05
    (line,) = table(gr.solve(TIP, "pull_off_force", k=0.3, wavelength="1 um")).splitlines()
    assert line.split()[:3] == ["pull_off_force_si", f"{newtons:.7g}", "N"]
    both = gr.solve(PUNCH, ["pull_off_force", "pull_off_force_sensitivity"], A=0.02)
    assert [line.split()[0] for line in table(both).splitlines()] == ["pull_off_force"]
    assert not table(gr.curves(PUNCH, "path", A=[0.0, 0.01]))


def read(text: str) -> pd.DataFrame:
    rows = pd.DataFrame(list(csv.DictReader(io.StringIO(text))))
    return rows.astype({name: float for name in rows.columns if name != "solver"})  # as Python reads numbers


def test_a_map_has_a_line_for_each_scene_and_all_digits(gradhesion: Call, made: Made) -> None:
    path = made(method={"solver": ["exact", "envelope"]})
    frame = read(gradhesion("info", path, "--format", "csv", code=0).stdout)
    with xarray.open_dataset(path) as dataset:
        assert len(frame) == dataset["status"].size
        axes = list(dataset["status"].dims)
        again = frame.set_index(axes).to_xarray()
        for name in ("pull_off_force", "dissipated_energy", "loading_jumps", "status"):
            found = again[name].transpose(*axes).reindex_like(dataset)
            np.testing.assert_array_equal(found.values, dataset[name].values)
        assert set(frame.columns) == {*dataset.data_vars, *dataset.coords} - {"steep_contact"}


def test_a_sensitivity_has_a_column_for_each_parameter(gradhesion: Call, made: Made) -> None:
    path, (force, energy) = made(outputs=["pull_off_force", *SENSITIVITIES]), SENSITIVITIES
    frame = read(gradhesion("info", path, "--format", "csv").stdout)
    with xarray.open_dataset(path) as dataset:
        columns = frame[[f"{energy}_{name}" for name in gr.PARAMETERS]]
        np.testing.assert_array_equal(columns, dataset[energy].values.reshape(-1, 7))
    chosen = gradhesion("info", path, "--format", "csv", "--variable", force).stdout.splitlines()[0]
    assert f"{force}_k,{force}_nu" in chosen
    assert energy not in chosen


def test_points_and_failed_scenes(gradhesion: Call, made: Made) -> None:
    numbers: dict[str, Any] = {"k": [0.1, 0.2, 0.9], "nu": 0.3, "modulus": 400.0, "c0_over_R": [0.01, 0.02, 1e-300]}
    numbers |= {"lambda_over_R": 0.2, "A": 0.01, "a_max_over_R": 1.0}
    path = made(exit_code=3, layout="points", parameters=numbers)
    frame = read(gradhesion("info", path, "--format", "csv", "--variable", "pull_off_force").stdout)
    assert list(frame.columns) == [*numbers, "pull_off_force", "status"]
    assert frame["status"].tolist()[2] == 64
    assert np.isnan(frame["pull_off_force"][2])


def test_a_curve_has_a_line_for_each_of_its_points(gradhesion: Call, made: Made) -> None:
    path = made(kind="curve", outputs=["equilibrium", "path", "jumps"])
    frame = read(gradhesion("info", path, "--format", "csv", "--variable", "path").stdout)
    with xarray.open_dataset(path) as dataset:
        assert len(frame) == int(dataset["path_load"].notnull().sum())
        assert frame["path_load"].sum() == pytest.approx(float(dataset["path_load"].sum()), rel=1e-12)
    assert frame["path_jump"].isin([0, 1]).all()
    assert (frame["path_branch"] % 1 == 0).all()


def test_what_is_no_table_is_refused(refusal: Told, made: Made) -> None:
    path = made(kind="curve", outputs=["equilibrium", "path", "jumps"])
    for words, key in NO_TABLES.items():
        assert key in refusal("info", path, *words.split())
