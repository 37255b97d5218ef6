"""`gradhesion explore` writes a page of every kind of dataset, and says so where there is nothing to write."""

import re
from collections.abc import Callable
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from click.testing import Result
from hypothesis import given
from hypothesis import strategies as st

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.explorer import choice
from gradhesion.cli.explorer.data import rounded, study_data
from gradhesion.cli.explorer.plain import title
from gradhesion.cli.names.outputs import SPREADS

Call = Callable[..., Result]


@pytest.fixture
def dataset_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Path:
    path = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return path


@given(st.floats(allow_infinity=False))
def test_a_rounded_value_is_exact_to_its_six_digits(value: float) -> None:
    shown = f"{float(rounded(np.array([value]))[0]):.6g}"
    assert shown == f"{value:.6g}"


@given(st.lists(st.floats(1e-30, 1e30), min_size=1))
def test_values_of_common_sizes_are_kept_in_single_precision(values: list[float]) -> None:
    kept = rounded(np.array(values))
    assert kept.dtype == np.float32
    assert [f"{value:.6g}" for value in kept.tolist()] == [f"{value:.6g}" for value in values]


def test_axes_rise_and_infinity_has_a_place(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "falling.nc"
    sets = ["--set=parameters.a_max_over_R=[inf, 9.0, 3.0, 1.0]", "--set=parameters.k=[0.31, 0.1]"]
    assert gradhesion("run", study_file, "-o", path, "--quiet", *sets).exit_code == 0
    with opened(path) as dataset:
        study, variables = study_data(dataset)
        axes = {axis["name"]: axis for axis in study["axes"]}
        assert axes["k"]["values"].tolist() == [0.1, 0.31]
        assert axes["a_max_over_R"]["places"] == pytest.approx(np.log10([1.0, 3.0, 9.0, 27.0]))
        assert axes["a_max_over_R"]["infinity"] == pytest.approx(np.log10(27.0))
        order = [axis["name"] for axis in study["axes"]]
        force = (
            gr.open(path)["pull_off_force"]
            .sel(k=0.1, a_max_over_R=np.inf, A=0.023)
            .isel(lambda_over_R=1, nu=0, missing_dims="ignore")
        )
        place = {"k": 0, "a_max_over_R": 3, "A": 1, "lambda_over_R": 1}
        shape = [len(axes[name]["values"]) for name in order]
        values = variables[0]["values"].reshape(shape)
        assert values[tuple(place[name] for name in order)] == np.float32(f"{float(force):.6g}")


def test_units_have_the_prefix_that_suits_the_values(gradhesion: Call, root: Path, tmp_path: Path) -> None:
    path = tmp_path / "physical.nc"
    assert gradhesion("run", root / "configs" / "physical.toml", "-o", path, "--quiet").exit_code == 0
    with opened(path) as dataset:
        study, variables = study_data(dataset)
        radius, work = (
            next(axis for axis in study["axes"] if axis["name"] == name) for name in ("R", "work_of_adhesion")
        )
        assert (radius["unit"], work["unit"]) == ("µm", "mJ/m²")
        assert radius["values"] == pytest.approx(np.geomspace(0.5, 5.0, 13))
        force = next(one for one in variables if one["name"] == "pull_off_force_si")
        greatest = float(dataset["pull_off_force_si"].max())
        assert force["unit"] == "µN"
        assert f"{force['greatest']:.6g}" == f"{1e6 * greatest:.6g}"


def test_a_page_is_taken_at_values_of_axes(gradhesion: Call, dataset_file: Path) -> None:
    page = dataset_file.with_suffix(".html")
    at = ["--at", "k=0.31", "--at", "a_max_over_R=inf", "--variable", "pull_off_force"]
    result = gradhesion("explore", dataset_file, *at)
    assert result.exit_code == 0, result.stderr
    assert page.read_text().startswith("<!DOCTYPE html>")
    with opened(dataset_file) as dataset:
        cut = choice.chosen(dataset, ["pull_off_force"], ["k=0.31", "a_max_over_R=inf"])
        assert set(cut.data_vars) == {"pull_off_force", "status"}
        assert float(cut["k"]) == 0.31
        expected = gr.open(dataset_file)["pull_off_force"].sel(k=0.31, a_max_over_R=np.inf)
        assert np.array_equal(cut["pull_off_force"].values, expected.values)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--variable", "pull_of_force"], 'did you mean "pull_off_force"?'),
        (["--at", "K=0.31"], 'did you mean "k"?'),
        (["--at", "k"], "write --at AXIS=VALUE"),
        (["--at", "k=0.7"], "outside the axis, which has values of 0 to 0.31"),
        (["-o", "page.png"], "ends in .html"),
    ],
)
def test_wrong_wishes_are_said(options: list[str], message: str, gradhesion: Call, dataset_file: Path) -> None:
    result = gradhesion("explore", dataset_file, *options)
    assert result.exit_code == 2
    assert message in result.stderr
    assert not dataset_file.with_suffix(".html").exists()


def test_a_file_that_is_no_dataset_is_said(gradhesion: Call, tmp_path: Path) -> None:
    result = gradhesion("explore", tmp_path / "none.nc")
    assert result.exit_code == 2
    assert "name a dataset that `gradhesion run` wrote" in result.stderr


def test_an_existing_page_stays_without_overwrite(gradhesion: Call, dataset_file: Path) -> None:
    page = dataset_file.with_suffix(".html")
    page.write_text("precious")
    assert gradhesion("explore", dataset_file).exit_code == 4
    assert page.read_text() == "precious"
    assert gradhesion("explore", dataset_file, "--overwrite").exit_code == 0
    assert page.read_text().startswith("<!DOCTYPE html>")


def test_variables_without_any_value_are_said(gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        for name in ("pull_off_force", "dissipated_energy"):
            file[name][:] = np.nan
    result = gradhesion("explore", dataset_file, "--variable", "pull_off_force")
    assert result.exit_code == 2
    assert "pull_off_force: no value in any scene" in result.stderr
    assert gradhesion("explore", dataset_file).exit_code == 0  # the jumps are there


def test_nothing_to_explore_is_said(gradhesion: Call, dataset_file: Path) -> None:
    at = [f"--at={place}" for place in ("k=0", "lambda_over_R=0.11", "A=0", "a_max_over_R=0.7")]
    result = gradhesion("explore", dataset_file, *at)
    assert result.exit_code == 2
    assert "nothing varies, so there is nothing to explore" in result.stderr


def test_a_dataset_too_large_for_a_page_is_said(
    gradhesion: Call, dataset_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(choice, "MOST", 90)
    result = gradhesion("explore", dataset_file)
    assert result.exit_code == 2
    assert (
        "96 values are too many for a page, which takes 90: choose one value of an axis with --at, as in"
        in result.stderr
    )
    example = result.stderr.split("as in ")[1].split(",")[0]
    assert gradhesion("explore", dataset_file, *example.split()).exit_code == 0


def test_jumps_alone_are_no_page(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path = tmp_path / "jumps.nc"
    sets = ["--set=kind='curve'", "--set=outputs=['jumps']"]
    assert gradhesion("run", study_file, "-o", path, "--quiet", *sets).exit_code == 0
    result = gradhesion("explore", path)
    assert result.exit_code == 2
    assert "`gradhesion info --jumps` lists them" in result.stderr


def test_each_part_of_a_spread_has_a_name_of_its_own() -> None:
    """In the order of a list that may be cut short: the letter and what it is, then the quantity."""
    titles = {name: title(name, long_name) for name, long_name in SPREADS.items()}
    assert len({*titles.values()}) == len(titles)
    for how, words in (
        ("std", "standard deviation"),
        ("p05", "5 % quantile"),
        ("p50", "median"),
        ("p95", "95 % quantile"),
    ):
        assert titles[f"pull_off_force_{how}"].startswith("F/(1.5 "), "the letter comes first"
        assert f", {words} " in titles[f"pull_off_force_{how}"]
        assert title(f"dissipated_energy_{how}_si", "").startswith(f"H, {words} ")


@pytest.mark.parametrize(("scenes", "announced"), [("0.3", False), ("[0.3, 0.5]", True)])
def test_sliders_are_announced_where_there_are_some(
    scenes: str, announced: bool, gradhesion: Call, study_file: Path, tmp_path: Path
) -> None:
    one = ["k", "A=0.023", "lambda_over_R=0.17", "a_max_over_R=0.4"]
    sets = [f"--set=parameters.{word}" for word in (f"k={scenes}", *one[1:])]
    data = tmp_path / "curves.nc"
    made = gradhesion("run", study_file, "-o", data, "--quiet", "--set=kind='curve'", "--set=outputs=['path']", *sets)
    assert made.exit_code == 0, made.stderr
    assert gradhesion("explore", data).exit_code == 0
    page = data.with_suffix(".html").read_text(encoding="utf-8")
    body = page[page.index("<main>") : page.index("</main>")]
    assert ("slider" in re.sub('id="sliders"', "", body)) == announced
    assert ("arrow keys" in body) == announced
