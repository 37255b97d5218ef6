"""`gradhesion info` writes the values of few scenes as a table, and all of them as CSV, number by number."""

import csv
import io
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray

import gradhesion as gr
from gradhesion.core import SENSITIVITIES
from tests.cli.conftest import Call, Made, Told

PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
TIP: dict[str, Any] = {"nu": 0.3, "A": 0.0, "R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm"}  # fmt: skip


@pytest.fixture
def told(gradhesion: Call, tmp_path: Path) -> Callable[..., str]:
    """What `info` says of a dataset, from its values to its status."""

    def tell(dataset: Any, *options: str) -> str:
        dataset.to_netcdf(path := tmp_path / "it.nc")
        result = gradhesion("info", path, *options, code=0)
        return result.stdout.partition("\nvalues\n")[2].partition("\nstatus: ")[0]

    return tell


def table_of(told: str) -> list[list[str]]:
    """The table below what the values are."""
    return [line.split() for line in told.partition("\n\n")[2].splitlines()]


def test_few_scenes_have_a_line_each_with_their_parameters_and_values(told: Callable[..., str]) -> None:
    values = table_of(told(gr.solve(TIP, "pull_off_force", k=[0.0, 0.3], wavelength="1 um")))
    forces = [(3 + k) / 2 * math.pi * 1e-6 * 0.05 for k in (0.0, 0.3)]  # of a smooth punch, in place of the ratio
    assert values == [["k", "pull_off_force_si"], ["0", f"{forces[0]:.7g}"], ["0.3", f"{forces[1]:.7g}"]]
    found = gr.solve(PUNCH, ["loading_jumps"], k=[0.0, 0.3], A=[0.01, 0.02, 0.05])
    rows = [[f"{k:g}", f"{A:g}", str(int(found["loading_jumps"].sel(k=k, A=A)))] for k in (0.0, 0.3) for A in found["A"].values]  # fmt: skip
    assert table_of(told(found))[1:7] == rows
    flagged = gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.1])
    names, *lines = table_of(told(flagged))
    assert names == ["A", "dissipated_energy", "status"]
    assert [int(row[-1]) for row in lines if row] == flagged["status"].values.tolist()


def test_columns_that_do_not_fit_go_on_below(told: Callable[..., str]) -> None:
    outputs = ["pull_off_force", "pull_off_radius", "dissipated_energy", "delta_max"]
    outputs += ["delta_jump_out", "loading_jumps", "unloading_jumps", "turning_radius"]
    table = told(gr.solve(PUNCH, outputs, A=[0.0, 0.01])).partition("\n\n")[2]
    assert max(map(len, table.splitlines())) <= 100
    assert {*outputs} < {*table.split()}


@pytest.mark.parametrize(("scenes", "there"), [(12, True), (13, False)])
def test_only_few_scenes_have_a_table(scenes: int, there: bool, told: Callable[..., str]) -> None:
    found = gr.solve(PUNCH, "pull_off_force", A=[0.001 * i for i in range(scenes)])
    assert bool(told(found)) == there
    assert len(table_of(told(found, "--at", "A=0.001:0.002"))) == 3, "a part has few scenes"


def test_points_and_solvers_are_told_apart(told: Callable[..., str]) -> None:
    scenes = PUNCH | {"k": [0.0, 0.3], "modulus": [500.0, 600.0], "A": 0.0}
    method = {"solver": ["exact", "envelope"]}
    found = gr.run({"layout": "points", "outputs": ["pull_off_force"], "parameters": scenes, "method": method})
    rows = [[solver, *rest] for solver in method["solver"] for rest in (("0", "500", "1"), ("0.3", "600", "1.1"))]
    assert table_of(told(found)) == [["solver", "k", "modulus", "pull_off_force"], *rows]


def test_a_single_scene_has_a_line_for_each_value_and_none_for_what_has_several(told: Callable[..., str]) -> None:
    newtons = (3 + 0.3) / 2 * math.pi * 1e-6 * 0.05
    (line,) = told(gr.solve(TIP, "pull_off_force", k=0.3, wavelength="1 um")).splitlines()
    assert line.split()[:3] == ["pull_off_force_si", f"{newtons:.7g}", "N"]
    both = gr.solve(PUNCH, ["pull_off_force", "pull_off_force_sensitivity"], A=0.02)
    assert [line.split()[0] for line in told(both).splitlines()] == ["pull_off_force"]
    assert not told(gr.curves(PUNCH, "path", A=[0.0, 0.01]))


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


REFUSED = {
    "--format csv": "jumps",
    "--format csv --variable path --variable equilibrium": "path",
    "--format csv --variable pathh": '"path"',
    "--variable path": "--format",
}


def test_what_is_no_table_is_refused(refusal: Told, made: Made) -> None:
    path = made(kind="curve", outputs=["equilibrium", "path", "jumps"])
    for words, key in REFUSED.items():
        assert key in refusal("info", path, *words.split())
