"""`gradhesion info --format csv` writes what the dataset has, number by number."""

import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.core import SENSITIVITIES

Call = Callable[..., Result]
Made = Callable[..., Path]


def read(text: str) -> pd.DataFrame:
    rows = pd.DataFrame(list(csv.DictReader(io.StringIO(text))))
    return rows.astype({name: float for name in rows.columns if name != "solver"})  # as Python reads numbers


def test_a_map_has_a_line_for_each_scene_and_all_digits(gradhesion: Call, made: Made) -> None:
    path = made(method={"solver": ["exact", "envelope"]})
    result = gradhesion("info", path, "--format", "csv")
    assert result.exit_code == 0, result.stderr
    frame = read(result.stdout)
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


@pytest.mark.parametrize(
    ("words", "key"),
    [
        (["--format", "csv"], "jumps"),
        (["--format", "csv", "--variable", "path", "--variable", "equilibrium"], "path"),
        (["--format", "csv", "--variable", "pathh"], '"path"'),
        (["--variable", "path"], "--format"),
    ],
)
def test_what_is_no_table_is_refused(words: list[str], key: str, gradhesion: Call, made: Made) -> None:
    result = gradhesion("info", made(kind="curve", outputs=["equilibrium", "path", "jumps"]), *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert key in result.stderr
