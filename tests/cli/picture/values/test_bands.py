"""Uncertain values are drawn with their spread, a band or bars; a variable that has none is refused in a sentence."""

from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.looks import looks_of
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.study.reading import study_from

PARAMETERS = {
    "k": [0.0, 0.4],
    "nu": 0.3,
    "modulus": 430.0,
    "c0_over_R": 0.013,
    "lambda_over_R": {"start": 0.1, "stop": 0.5, "num": 24},
    "A": 0.01,
    "a_max_over_R": 0.5,
}


def _computed(uncertainty: dict[str, Any], **parameters: Any) -> xarray.Dataset:
    study = {"outputs": ["pull_off_force", "loading_jumps"], "parameters": PARAMETERS | parameters}
    return compute(study_from(study | ({"uncertainty": uncertainty} if uncertainty else {})), threads=1)


@pytest.fixture(scope="module")
def sampled() -> xarray.Dataset:
    """A force with standard deviations and quantiles."""
    return _computed({"modulus": "5 %", "A": "10 %", "samples": 16})


def _edges(axes: Axes) -> list[tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]]:
    """Read the least and the greatest height of each band at its places."""
    found = []
    for band in axes.collections:
        if isinstance(band, PolyCollection):
            vertices = band.get_paths()[0].vertices
            places = np.unique(vertices[:, 0])
            rows = [vertices[vertices[:, 0] == place, 1] for place in places]
            found.append((np.array([row.min() for row in rows]), np.array([row.max() for row in rows])))
    return found


def test_a_band_goes_from_the_lower_to_the_upper_quantile(sampled: xarray.Dataset) -> None:
    figure = drawn(sampled, ["pull_off_force"])
    bands = _edges(figure.axes[0])
    assert len(bands) == 2
    for item, (low, high) in enumerate(bands):
        np.testing.assert_array_equal(low, sampled["pull_off_force_p05"].values[item])
        np.testing.assert_array_equal(high, sampled["pull_off_force_p95"].values[item])
    assert "5 % to 95 % of samples" in [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    low, high = figure.axes[0].get_ylim()
    assert low < float(sampled["pull_off_force_p05"].min())
    assert float(sampled["pull_off_force_p95"].max()) < high


def test_a_standard_deviation_is_drawn_on_each_side(sampled: xarray.Dataset) -> None:
    axes = drawn(sampled.isel(k=0), ["pull_off_force"], looks=looks_of(band="std")).axes[0]
    ((low, high),) = _edges(axes)
    value, deviation = (sampled[name].values[0] for name in ("pull_off_force", "pull_off_force_std"))
    np.testing.assert_array_equal(low, value - deviation)
    np.testing.assert_array_equal(high, value + deviation)
    linear = _computed({"modulus": "5 %"})
    assert len(_edges(drawn(linear, ["pull_off_force"]).axes[0])) == 2, "without samples it is what there is"


def test_few_values_have_bars(sampled: xarray.Dataset) -> None:
    few = sampled.isel(lambda_over_R=slice(0, 24, 4))
    axes = drawn(few, ["pull_off_force"]).axes[0]
    bars = [one for one in axes.collections if isinstance(one, LineCollection)]
    ends = np.array([path.vertices[:, 1] for path in bars[1].get_paths()])
    np.testing.assert_array_equal(ends[:, 0], few["pull_off_force_p05"].values[1])
    np.testing.assert_array_equal(ends[:, 1], few["pull_off_force_p95"].values[1])


def test_no_line_of_the_grid_crosses_a_bar(sampled: xarray.Dataset) -> None:
    axes = drawn(sampled.isel(lambda_over_R=slice(0, 24, 4)), ["pull_off_force"]).axes[0]
    caps = [line for line in axes.get_lines() if line.get_marker() == "_"]
    bars = [one for one in axes.collections if isinstance(one, LineCollection)]
    values = [line for line in axes.get_lines() if line.get_linestyle() != "None"]
    grid = axes.xaxis.get_zorder()  # lines of the grid are drawn with the ticks
    assert caps
    assert grid < min(one.get_zorder() for one in [*caps, *bars])
    assert max(one.get_zorder() for one in [*caps, *bars]) < min(one.get_zorder() for one in values)


def test_points_have_bars() -> None:
    points = compute(
        study_from(
            {
                "outputs": ["pull_off_force"],
                "layout": "points",
                "parameters": PARAMETERS | {"k": 0.2, "lambda_over_R": [0.3, 0.1, 0.2]},
                "uncertainty": {"A": "10 %"},
            }
        ),
        threads=1,
    )
    (bars,) = [one for one in drawn(points, ["pull_off_force"]).axes[0].collections if isinstance(one, LineCollection)]
    ends = np.array([path.vertices[:, 1] for path in bars.get_paths()])
    order = np.argsort(points["lambda_over_R"].values)
    np.testing.assert_array_equal(np.diff(ends)[:, 0] > 0.0, True)
    np.testing.assert_allclose(ends.mean(axis=1), points["pull_off_force"].values[order], rtol=1e-15)


def test_the_median_lies_in_its_band_and_none_is_drawn_without_it(sampled: xarray.Dataset) -> None:
    assert len(_edges(drawn(sampled, ["pull_off_force_p50"]).axes[0])) == 2
    for name, band in (("pull_off_force", "none"), ("pull_off_force_std", None), ("loading_jumps", None)):
        assert not _edges(drawn(sampled, [name], looks=looks_of(band=band)).axes[0])
    over = selection_of(sampled, (), ["k=max"])
    assert not _edges(drawn(sampled, ["pull_off_force"], over).axes[0]), (
        "the greatest of some values has other quantiles"
    )


def test_a_band_that_is_not_there_is_refused(sampled: xarray.Dataset) -> None:
    linear, plain = _computed({"modulus": "5 %"}), _computed({})
    for dataset, name, choices, sentence in (
        (plain, "pull_off_force", {"band": "std"}, "--band std: pull_off_force has no spread in this dataset; add "),
        (
            linear,
            "pull_off_force",
            {"band": "quantiles"},
            "pull_off_force has no quantiles in this dataset; write --band",
        ),
        (
            sampled,
            "loading_jumps",
            {"band": "std"},
            "--band std: loading_jumps has none; choose an output with --variable",
        ),
        (sampled, "pull_off_force_std", {"band": "std"}, "--band std: pull_off_force_std has none; choose an output"),
        (sampled, "pull_off_force", {"band": "std", "kind": "map"}, "--band: this picture is a map, and has no lines"),
    ):
        with pytest.raises(DatasetError) as error:
            drawn(dataset, [name], looks=looks_of(**choices))
        assert sentence in str(error.value)
    with pytest.raises(DatasetError, match="--band stdd: not a band"):
        looks_of(band="stdd")
    with pytest.raises(DatasetError, match="--band: pull_off_force is taken over k, and its spread is that of a scene"):
        drawn(sampled, ["pull_off_force"], selection_of(sampled, (), ["k=max"]), looks=looks_of(band="std"))
    with pytest.raises(DatasetError, match="--band: curves have no spread; leave it out"):
        drawn_curves(sampled, [], looks=looks_of(band="std"))
