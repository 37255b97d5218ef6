"""Size, colours, levels and words of a picture are what a user chooses; what does not exist is refused in a sentence."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.style
import numpy as np
import pytest
import xarray
from click.testing import Result
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.path import Path as Outline

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.looks import STYLE, looks_of
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.picture.values.points import DENSE
from gradhesion.cli.study.reading import study_from

Call = Callable[..., Result]


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
    """A force that is a saddle of known contours, in the form of a dataset of maps."""
    parameters = {
        "k": {"start": 0.0, "stop": 0.9, "num": 10},
        "nu": 0.27,
        "modulus": 430.0,
        "c0_over_R": 0.013,
        "lambda_over_R": {"start": 0.1, "stop": 1.0, "num": 40},
        "A": [0.0, 0.02],
        "a_max_over_R": 0.7,
    }
    study = {"title": "A small study", "outputs": ["pull_off_force", "dissipated_energy"], "parameters": parameters}
    dataset = compute(study_from(study), threads=1)
    force = 1.0 + dataset["k"] + dataset["lambda_over_R"] + 0.0 * dataset["pull_off_force"]
    dataset["pull_off_force"] = force.transpose(*dataset["pull_off_force"].dims).assign_attrs(
        dataset["pull_off_force"].attrs
    )
    return dataset


def _contours(axes: Axes) -> QuadContourSet:
    """Give the lines of a map."""
    return next(one for one in axes.collections if isinstance(one, QuadContourSet) and not one.filled)


def _size(figure: Figure) -> list[float]:
    return [float(side) for side in figure.get_size_inches()]


@pytest.mark.parametrize(
    ("words", "inches"),
    [("column", 90 / 25.4), ("page", 190 / 25.4), (5, 5.0), ("8 cm", 8 / 2.54), ("90mm", 90 / 25.4)],
)
def test_a_width_is_that_of_the_figure(words: Any, inches: float, grid: xarray.Dataset) -> None:
    figure = drawn(grid.isel(A=1), ["pull_off_force"], looks=looks_of(width=words))
    assert _size(figure)[0] == pytest.approx(inches, rel=1e-15)
    assert _size(drawn(grid.isel(A=1), [], looks=looks_of(width=words, height=3)))[1] == 3.0


def test_variables_stand_below_each_other_in_a_column(grid: xarray.Dataset) -> None:
    for width, below in (("column", True), ("page", False)):
        first, second = drawn(grid.isel(A=1), [], looks=looks_of(width=width)).subfigs[0].subfigs
        assert (first.bbox.y0 > second.bbox.y0) == below


def test_lines_and_maps_are_as_asked_for(grid: xarray.Dataset) -> None:
    one = grid.isel(A=1)
    (axes, _) = drawn(one, ["pull_off_force"]).axes
    assert _contours(axes)
    figure = drawn(one, ["pull_off_force"], looks=looks_of(kind="lines"))
    lines = figure.axes[0].get_lines()
    assert [line.get_label() for line in lines] == [f"$k$ = {value:g}" for value in (0.0, 0.2, 0.4, 0.5, 0.7, 0.9)]
    assert len({str(line.get_linestyle()) + str(line._dash_pattern) for line in lines}) == 6, (
        "a grey print keeps them apart"
    )
    assert "6 of 10 values of" in figure.get_suptitle()
    few = one.isel(k=[0, 4])
    assert len(drawn(few, ["pull_off_force"]).axes) == 1
    assert _contours(drawn(few, ["pull_off_force"], looks=looks_of(kind="map")).axes[0])


@pytest.mark.parametrize(("levels", "expected"), [("1.5,2.0", [1.5, 2.0]), ([1.25], [1.25]), ([1.3, 9.0], [1.3])])
def test_levels_are_those_listed(levels: Any, expected: list[float], grid: xarray.Dataset) -> None:
    (axes, bar) = drawn(grid.isel(A=1), ["pull_off_force"], looks=looks_of(levels=levels)).axes
    lines = _contours(axes)
    drawn_ones = [level for level, path in zip(lines.levels, lines.get_paths(), strict=True) if path.vertices.size]
    assert drawn_ones == expected
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):  # the saddle: 1 + k + lambda/R
        np.testing.assert_allclose(1.0 + path.vertices.sum(axis=1), level, rtol=0, atol=1e-12)
    assert {*expected} <= {*bar.get_yticks()}


def test_a_number_of_levels_is_about_theirs(grid: xarray.Dataset) -> None:
    few, many = (
        len(drawn(grid.isel(A=1), ["pull_off_force"], looks=looks_of(levels=n)).axes[0].collections[0].levels)  # type: ignore[attr-defined]
        for n in (4, 40)
    )
    assert 3 <= few <= 6
    assert 20 <= many <= 42


def test_a_colour_map_is_that_of_maps_and_lines(grid: xarray.Dataset) -> None:
    looks = looks_of(colour_map="plasma", kind="lines")
    lines = drawn(grid.isel(A=1), ["pull_off_force"], looks=looks).axes[0].get_lines()
    assert to_rgb(lines[0].get_color()) == to_rgb(mpl.colormaps["plasma"](0.0))
    (axes, _) = drawn(grid.isel(A=1), ["pull_off_force"], looks=looks_of(colour_map="plasma")).axes
    assert axes.collections[0].get_cmap().name == "plasma"


def test_title_caption_and_numbers_can_be_left_out(grid: xarray.Dataset) -> None:
    one = grid.isel(A=1)
    whole = drawn(one, ["pull_off_force"])
    assert whole.get_suptitle().splitlines()[0] == "A small study"
    assert r"$\nu$ = 0.27" in whole.get_suptitle()
    assert _contours(whole.axes[0]).labelTexts
    assert drawn(one, ["pull_off_force"], looks=looks_of(title=False, caption=False)).get_suptitle() == ""
    assert drawn(one, ["pull_off_force"], looks=looks_of(caption=False)).get_suptitle() == "A small study"
    assert not _contours(drawn(one, ["pull_off_force"], looks=looks_of(labels=False)).axes[0]).labelTexts


@pytest.mark.parametrize("width", [3.0, 6.0])
def test_numbers_on_contours_are_whole_and_clear_of_each_other_and_of_other_lines(
    width: float, grid: xarray.Dataset
) -> None:
    figure = drawn(grid.isel(A=1), ["pull_off_force"], looks=looks_of(width=width, levels=12))
    figure.draw_without_rendering()
    axes = figure.axes[0]
    lines = _contours(axes)
    frame = axes.get_window_extent()
    assert lines.labelTexts
    boxes = [text.get_window_extent() for text in lines.labelTexts]
    for box in boxes:
        assert frame.x0 <= box.x0 < box.x1 <= frame.x1
        assert frame.y0 <= box.y0 < box.y1 <= frame.y1
    middles = np.array([[0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)] for box in boxes])
    apart = np.hypot(*(middles[:, None] - middles).T) + 1e9 * np.eye(len(middles))
    assert apart.min() > min(box.height for box in boxes) / 2
    for text, level in zip(lines.labelTexts, [float(text.get_text()) for text in lines.labelTexts], strict=True):
        at = axes.transData.inverted().transform(axes.transData.transform(text.get_position()))
        assert 1.0 + at.sum() == pytest.approx(level, abs=0.02), "a number is on its line"
    assert all(isinstance(path, Outline) for path in lines.get_paths())


def test_a_map_too_small_for_numbers_has_none(grid: xarray.Dataset) -> None:
    looks = looks_of(width=1.4, height=0.8 + 0.2, levels=40, title=False, caption=False)
    assert not _contours(drawn(grid.isel(A=1), ["pull_off_force"], looks=looks).axes[0]).labelTexts
    with pytest.raises(DatasetError, match="a picture of 1 by 1 inches has no room for its panels"):
        drawn(grid.isel(A=1), [], looks=looks_of(width=1, height=1))


def test_status_is_drawn_as_categories(grid: xarray.Dataset) -> None:
    dataset = grid.isel(A=1, k=slice(0, 2)).copy()
    dataset["status"][...] = 0
    dataset["status"][..., 3:] = 1
    axes = drawn(dataset, ["status"]).axes[0]
    assert [text.get_text() for text in axes.get_yticklabels()] == ["nothing to report", "loading contact not one disc"]
    first = axes.get_lines()[0].get_ydata()
    assert np.round(first).tolist() == [0.0] * 3 + [1.0] * 37
    points = dataset.isel(k=0).rename_dims(lambda_over_R="scene").reset_index("lambda_over_R")
    axes = drawn(points, ["status"]).axes[0]
    assert [text.get_text() for text in axes.get_yticklabels()] == ["nothing to report", "loading contact not one disc"]


def test_many_points_are_drawn_as_their_number(grid: xarray.Dataset) -> None:
    rng = np.random.default_rng(7)
    count = DENSE + 500
    k = rng.uniform(0.0, 0.9, count)
    points = xarray.Dataset(
        {"pull_off_force": ("scene", 1.0 + k), "status": ("scene", np.zeros(count, "i4"))},
        coords={"k": ("scene", k), "nu": ("scene", np.full(count, 0.3))},
        attrs=grid.attrs,
    )
    points["pull_off_force"][:40] = np.nan
    points["status"][100:110] = 1 << 5
    figure = drawn(points, ["pull_off_force"])
    (cells,) = figure.axes[0].collections
    counts = cells.get_array()
    assert counts is not None
    assert float(np.sum(counts)) == count - 40, "every scene with a value is counted once"
    assert figure.axes[1].get_ylabel() == "scenes in a cell"
    assert "40 scenes without a value" in figure.get_suptitle()
    few = drawn(points.isel(scene=slice(0, 100)), ["pull_off_force"])
    assert not few.axes[0].collections


def test_one_plane_of_curves_is_drawn(data: dict[str, Any]) -> None:
    fixed = {"k": 0.3, "lambda_over_R": 0.17, "A": 0.03, "a_max_over_R": 0.4}
    curves = compute(
        study_from(data | {"kind": "curve", "outputs": ["path"], "parameters": data["parameters"] | fixed}), threads=1
    )
    for choice, planes in (
        ({"x": "indentation", "y": "load"}, [("depth", "load")]),
        ({"x": "contact_radius"}, [("contact radius", "depth"), ("contact radius", "load")]),
        ({"y": "contact_radius"}, [("depth", "contact radius"), ("load", "contact radius")]),
        ({"x": "load", "y": "indentation"}, [("load", "depth")]),
    ):
        figure = drawn_curves(curves, [], **choice)
        assert [(a.get_xlabel().split(" $")[0], a.get_ylabel().split(" $")[0]) for a in figure.axes] == planes
    figure = drawn_curves(curves, [], looks=looks_of(width="column", title=False, caption=False))
    assert figure.get_suptitle() == ""
    assert len({axes.bbox.x0 for axes in figure.axes}) == 1, "panels stand below each other"
    without = curves.drop_vars([name for name in curves if "load" in str(name) and name != "path_unloading"])
    with pytest.raises(DatasetError, match="--y load: path of this dataset has no such plane"):
        drawn_curves(without, [], y="load")
    with pytest.raises(DatasetError, match="--map: curves are drawn as lines"):
        drawn_curves(curves, [], looks=looks_of(kind="map"))
    with pytest.raises(DatasetError, match="--levels: contour levels are for a map"):
        drawn_curves(curves, [], looks=looks_of(levels=5))


WRONG = [
    (["--width", "colum"], '--width colum: not a size; did you mean "column"?'),
    (["--width", "wide"], '--width wide: not a size; write for example 3.5, "9 cm" or column'),
    (["--height", "0.1"], "--height 0.1: a picture of 0.1 inches; choose one of 1 to 100 inches"),
    (["--width", "-3"], "--width -3: a picture of -3 inches; choose one of 1 to 100 inches"),
    (["--width", "9 m"], "--width 9 m: not a size"),
    (["--width", "1.2.3"], "--width 1.2.3: not a size"),
    (["--height", "column"], "--height column: not a size"),
    (["--width", "nan"], "--width nan: not a size"),
    (["--colour-map", "virids"], '--colour-map virids: not a colour map of matplotlib; did you mean "viridis"?'),
    (["--color-map", "?"], '--colour-map ?: not a colour map of matplotlib; choose one of its own, as "viridis"'),
    (["--levels", "many"], "--levels many: neither a number of levels nor a list of levels; write 8 or 0.5,1,2"),
    (["--levels", "0"], "--levels 0: choose 1 to 100 levels; a single level is written with its point, as 0.0"),
    (["--levels", "1e9,2e9"], "--levels 1e+09,2e+09: none is among the values, which are"),
    (["--levels", "8", "--lines"], "--levels: contour levels are for a map, and this picture has none"),
    (["--map", "--at", "k=0"], "--map: a map needs two axes that vary, and here lambda_over_R alone does; use --lines"),
    (["--style", "seaborm-v0_8"], '--style seaborm-v0_8: neither a style of matplotlib nor the file of a style; did you mean "seaborn-v0_8"?'),
    (["--at", "k=0", "--at", "lambda_over_R=0.5"], "nothing varies, so there is nothing to draw it over; fix or reduce fewer axes"),
]  # fmt: skip


def test_what_does_not_exist_is_said(grid: xarray.Dataset, tmp_path: Path, gradhesion: Call) -> None:
    path = tmp_path / "x.nc"
    grid.isel(A=1).to_netcdf(path)
    for options, message in WRONG:
        result = gradhesion("plot", path, *options)
        assert result.exit_code == 2, options
        assert message in result.stderr
        assert len(result.stderr.splitlines()) == 1
        assert not path.with_suffix(".png").exists()


def test_the_style_can_be_named_and_overlaid(grid: xarray.Dataset, tmp_path: Path, gradhesion: Call) -> None:
    with matplotlib.style.context([STYLE, "gradhesion.journal"]):
        assert mpl.rcParams["font.family"] == ["STIXGeneral"]
        assert mpl.rcParams["savefig.dpi"] == 300
    grid.isel(A=1).to_netcdf(tmp_path / "x.nc")
    own = tmp_path / "own.mplstyle"
    own.write_text("savefig.dpi: 50\n")
    options = ["--variable", "pull_off_force", "--width", "4", "--height", "3", "--style", own]
    assert gradhesion("plot", tmp_path / "x.nc", *options).exit_code == 0
    sides = np.frombuffer((tmp_path / "x.png").read_bytes()[16:24], ">u4")
    assert sides.tolist() == [200, 150]


def test_a_parameter_without_effect_is_not_in_the_caption(data: dict[str, Any]) -> None:
    fixed = {key: value for key, value in data["parameters"].items() if key != "c0_over_R"}
    dataset = compute(study_from(data | {"parameters": fixed | {"k": 0.0, "A": 0.1, "a_max_over_R": 1.0}}), threads=1)
    assert "c0_over_R" in dataset.coords
    words = drawn(dataset, ["pull_off_force"]).get_suptitle()
    assert "$k$ = 0" in words
    assert "c_0" not in words
