"""`gradhesion explore` writes a page of every kind of dataset, and says so where there is nothing to write."""

from pathlib import Path

import netCDF4
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.explorer import page as of_page
from gradhesion.cli.explorer.data import rounded, study_data
from tests.cli.conftest import Call, Made, Patch

PLACES = ("k=0", "lambda_over_R=0.11", "A=0", "a_max_over_R=0.7")
WRONG = {
    '"pull_off_force"': ["--variable", "pull_of_force"], '"k"': ["--at", "K=0.31"], "0 to 0.31": ["--at", "k=0.7"], ".html": ["-o", "page.png"],
    "pull_off_force: ": ["--variable", "pull_off_force"], "nothing varies": [f"--at={place}" for place in PLACES],
}  # fmt: skip


@given(st.lists(st.floats(allow_infinity=False), min_size=1))
def test_rounded_values_are_exact_to_their_six_digits_and_single_where_they_fit(values: list[float]) -> None:
    kept = rounded(np.array(values))
    assert [f"{value:.6g}" for value in kept.tolist()] == [f"{value:.6g}" for value in values]
    if all(1e-30 <= value <= 1e30 for value in values):
        assert kept.dtype == np.float32


def test_axes_rise_and_infinity_has_a_place(made: Made) -> None:
    path = made(parameters={"a_max_over_R": [np.inf, 27.0, 9.0, 3.0, 1.0], "k": [0.31, 0.1]})
    with opened(path) as dataset:
        study, variables = study_data(dataset)
    axes = {axis["name"]: axis for axis in study["axes"]}
    assert axes["k"]["values"].tolist() == [0.1, 0.31]
    assert axes["a_max_over_R"]["places"] == pytest.approx(np.log10([1.0, 3.0, 9.0, 27.0, 81.0]))
    assert axes["a_max_over_R"]["infinity"] == pytest.approx(np.log10(81.0))
    assert axes["a_max_over_R"]["ends"] == pytest.approx(np.log10([1.0, 27.0]))
    with gr.open(path) as whole:
        force = whole["pull_off_force"].sortby([*axes]).transpose(*axes).values
    values = variables[0]["values"].reshape(force.shape)
    np.testing.assert_array_equal(values, np.vectorize(lambda value: float(f"{value:.6g}"))(force).astype(np.float32))


def test_a_page_is_taken_at_values_of_axes_and_written_once(gradhesion: Call, dataset_file: Path) -> None:
    page = dataset_file.with_suffix(".html")
    at = ["--at", "k=0.31", "--at", "a_max_over_R=inf", "--variable", "pull_off_force"]
    page.write_text("precious")
    assert gradhesion("explore", dataset_file, *at).exit_code == 4
    assert page.read_text() == "precious"
    assert gradhesion("explore", dataset_file, *at, "--overwrite").exit_code == 0
    assert page.read_text().startswith("<!DOCTYPE html>")
    with opened(dataset_file) as dataset:
        cut = of_page.chosen(dataset, ["pull_off_force"], ["k=0.31", "a_max_over_R=inf"])
        assert set(cut.data_vars) == {"pull_off_force", "status"}
        expected = dataset["pull_off_force"].isel(k=1, a_max_over_R=1)
        np.testing.assert_array_equal(cut["pull_off_force"].values, expected.values)


def test_wrong_wishes_and_too_many_values_are_said(gradhesion: Call, dataset_file: Path, monkeypatch: Patch) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        for name in ("pull_off_force", "dissipated_energy"):
            file[name][:] = np.nan
    for key, options in WRONG.items():
        assert key in gradhesion("explore", dataset_file, *options, code=2).stderr
        assert not dataset_file.with_suffix(".html").exists()
    assert gradhesion("explore", dataset_file).exit_code == 0  # the jumps are there
    monkeypatch.setattr(of_page, "MOST", 90)
    told = gradhesion("explore", dataset_file, "--overwrite", code=2).stderr
    assert "96 values are too many for a page, which takes 90" in told
    assert gradhesion("explore", dataset_file, "--at", "k=0.31", "--overwrite").exit_code == 0
