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

from gradhesion.cli.dataset.writer import write
from gradhesion.cli.study.reading import study_from

Call = Callable[..., Result]


@pytest.fixture
def written(data: dict[str, Any], tmp_path: Path) -> Callable[..., Path]:
    """Write the dataset of the small study with other keys."""

    def make(**changes: Any) -> Path:
        path = tmp_path / "out.nc"
        write(study_from(data | changes), path, history="")
        return path

    return make


def read(text: str) -> pd.DataFrame:
    rows = pd.DataFrame(list(csv.DictReader(io.StringIO(text))))
    return rows.astype({name: float for name in rows.columns if name != "solver"})  # as Python reads numbers


def test_a_map_has_a_line_for_each_scene_and_all_digits(gradhesion: Call, written: Callable[..., Path]) -> None:
    path = written(method={"solver": ["exact", "envelope"]})
    result = gradhesion("info", path, "--format", "csv")
    assert result.exit_code == 0, result.stderr
    frame = read(result.stdout)
    with xarray.open_dataset(path) as dataset:
        assert len(frame) == dataset["status"].size
        axes = list(dataset["status"].dims)
        again = frame.set_index(axes).to_xarray()
        for name in ("pull_off_force", "dissipated_energy", "loading_jumps", "status"):
            np.testing.assert_array_equal(
                again[name].transpose(*axes).reindex_like(dataset).values, dataset[name].values
            )
        assert set(frame.columns) == {*dataset.data_vars, *dataset.coords} - {"steep_contact"}


def test_points_and_failed_scenes(gradhesion: Call, written: Callable[..., Path]) -> None:
    numbers = {"k": [0.1, 0.2, 0.9], "nu": 0.3, "modulus": 400.0, "c0_over_R": [0.01, 0.02, 1e-300]}
    path = written(layout="points", parameters=numbers | {"lambda_over_R": 0.2, "A": 0.01, "a_max_over_R": 1.0})
    frame = read(gradhesion("info", path, "--format", "csv", "--variable", "pull_off_force").stdout)
    assert list(frame.columns) == [*numbers, "lambda_over_R", "A", "a_max_over_R", "pull_off_force", "status"]
    assert frame["status"].tolist()[2] == 64
    assert np.isnan(frame["pull_off_force"][2])


def test_a_curve_has_a_line_for_each_of_its_points(gradhesion: Call, written: Callable[..., Path]) -> None:
    path = written(kind="curve", outputs=["equilibrium", "path", "jumps"])
    frame = read(gradhesion("info", path, "--format", "csv", "--variable", "path").stdout)
    with xarray.open_dataset(path) as dataset:
        counts = int(dataset["path_load"].notnull().sum())
        assert len(frame) == counts
        assert frame["path_load"].sum() == pytest.approx(float(dataset["path_load"].sum()), rel=1e-12)
    assert frame["path_jump"].isin([0, 1]).all()
    assert (frame["path_branch"] % 1 == 0).all()
    for wrong, sentence in (
        ([], "jumps have a separate table; write it with gradhesion info --jumps"),
        (
            ["--variable", "path", "--variable", "equilibrium"],
            "choose one with --variable equilibrium or --variable path",
        ),
        (["--variable", "pathh"], 'there is no variable "pathh"; did you mean "path"?'),
    ):
        result = gradhesion("info", path, "--format", "csv", *wrong)
        assert result.exit_code == 2
        assert sentence in result.stderr


def test_variables_belong_to_a_table(gradhesion: Call, written: Callable[..., Path]) -> None:
    result = gradhesion("info", written(), "--variable", "pull_off_force")
    assert result.exit_code == 2
    assert "--variable selects the columns of a table; add --format csv" in result.stderr
