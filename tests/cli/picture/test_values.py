"""Pictures of values show the values of the dataset: lines, maps, panels, points, what is taken over an axis."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.contour import QuadContourSet

import gradhesion as gr
from gradhesion.cli.names.symbols import SYMBOLS
from tests.cli.conftest import contours, curves, legend, words
from tests.conftest import mistakes

PUNCH: dict[str, Any] = {"nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "a_max_over_R": 0.7}
SOLVERS = ["exact", "asymptotic", "envelope"]
SHAPES: dict[str, dict[str, Any]] = {
    "a line to infinity": {"a_max_over_R": [0.5, 1.0, 2.0, np.inf], "k": 0.2, "A": 0.1, "lambda_over_R": 0.1},
    "a line of one value to infinity": {"a_max_over_R": [0.5, np.inf], "k": 0.2, "A": 0.1, "lambda_over_R": 0.1},
    "a map to infinity": {"a_max_over_R": [0.1, 0.2, 0.3, 0.5, 1, 2, np.inf], "k": np.linspace(0, 0.9, 9), "A": 0.1, "lambda_over_R": 1.0},
    "panels of lines": {"k": [0.0, 0.3], "A": [0.0, 0.02], "lambda_over_R": [0.1, 0.2, 0.4], "a_max_over_R": [0.5, np.inf]},
    "panels of maps": {"k": np.linspace(0, 0.9, 7), "A": [0.0, 0.02], "lambda_over_R": np.linspace(0.1, 0.5, 8), "c0_over_R": [0.1, 1.0]},
    "solvers as lines": {"k": 0.2, "A": 0.02, "lambda_over_R": [0.1, 0.2, 0.4], "solver": SOLVERS},
    "solvers beside maps": {"k": np.linspace(0, 0.9, 7), "A": 0.02, "lambda_over_R": np.linspace(0.1, 0.5, 8), "solver": SOLVERS},
}  # fmt: skip


def computed(outputs: Any = ("pull_off_force", "dissipated_energy"), **parameters: Any) -> xarray.Dataset:
    method = {"method": {"solver": parameters.pop("solver")}} if "solver" in parameters else {}
    own = {name: np.asarray(value).tolist() for name, value in parameters.items()}
    return gr.run({"title": "A small study", "outputs": [*outputs], "parameters": PUNCH | own, **method})


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
    return computed(k=np.linspace(0, 0.8, 9), A=[0.0, 0.02, 0.05], lambda_over_R=np.geomspace(0.02, 1.0, 20))


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_is_drawn_in_line(shape: str) -> None:
    """Panels, and the end of a line that stands apart from it."""
    panels = gr.plot(computed(**SHAPES[shape]))
    panels.figure.draw_without_rendering()
    first, second = np.split(np.array([axes.get_position().extents for axes in panels]), 2)
    assert any(np.allclose(first[:, side::2], second[:, side::2], atol=1e-9) for side in (0, 1))
    for axes in panels if shape.endswith("to infinity") and shape.startswith("a line") else ():
        line, end = (one.get_xdata() for one in axes.get_lines()[:2])
        assert (len(line), len(end), line[-1] < end[0]) == (len(SHAPES[shape]["a_max_over_R"]) - 1, 1, True)
        assert axes.get_xlim()[0] < line[0] < end[0] < axes.get_xlim()[1]


def test_contours_of_a_map_have_numbers_that_keep_clear_of_each_other() -> None:
    """On the longest piece with room, where the longest one of all runs along a steep flank among others."""
    k, wavelength = np.linspace(0.0, 0.9, 10), np.geomspace(0.05, 1.0, 80)
    maps = gr.solve(k=k, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=wavelength, A=0.05, a_max_over_R=0.3)
    for axes in gr.plot(maps, width="page"):
        numbers = [text.get_window_extent().get_points().mean(axis=0) for text in axes.texts]
        assert len(numbers) >= 2
        apart = [np.hypot(*(one - other)) for i, one in enumerate(numbers) for other in numbers[:i]]
        assert min(apart) > 0.35 * axes.figure.dpi


def test_panels_in_a_column_are_high_enough_to_be_read_and_none_is_empty() -> None:
    maps = computed(**SHAPES["panels of maps"])
    for kind in ("map", "lines"):
        panels = gr.plot(maps, kind=kind, width="column")
        heights = [axes.get_position().height * panels.figure.get_size_inches()[1] for axes in panels]
        assert (len(heights), min(heights) > 0.75) == (8, True)
    names = ["pull_off_force", "pull_off_radius", "loading_energy", "unloading_energy"]
    panels = gr.plot(computed(names, k=[0.0, 0.3, 0.6], A=0.02, lambda_over_R=0.1), names)
    assert [axes.get_ylabel() for axes in panels] == [SYMBOLS[name] for name in names]
    assert panels.figure.axes == list(panels)


def test_lines_are_the_values_of_the_dataset(grid: xarray.Dataset) -> None:
    few = grid.isel(A=1, k=[0, 3, 8])
    panels = gr.plot(few)
    for axes, name in zip(panels, ("pull_off_force", "dissipated_energy"), strict=True):
        assert (axes.get_xscale(), axes.get_xlabel()) == ("log", SYMBOLS["lambda_over_R"])
        assert axes.get_ylabel() == SYMBOLS[name]
        for line, values in zip(curves(axes), few[name].transpose("k", "lambda_over_R").values, strict=True):
            np.testing.assert_array_equal(line.get_xdata(), few["lambda_over_R"])
            np.testing.assert_array_equal(line.get_ydata(), values)
        assert len({str(line._dash_pattern) for line in curves(axes)}) == 3, "a grey print keeps them apart"
    assert legend(panels) == [f"$k$ = {value:g}" for value in few["k"].values]
    assert r"A = 0.02, a_{\max}/R = 0.7" in words(panels)


@pytest.mark.parametrize(("x", "y"), [(None, None), ("k", None), (None, "lambda_over_R")])
def test_a_map_has_its_axes_and_contours_its_values(x: str | None, y: str | None, grid: xarray.Dataset) -> None:
    one = grid.isel(A=1)
    axes, bar = gr.plot(one, "pull_off_force", x=x, y=y).figure.axes
    turned = bool(x or y)
    sides = ["lambda_over_R", "k"][:: -1 if turned else 1]
    assert [axes.get_xlabel(), axes.get_ylabel()] == [SYMBOLS[side] for side in sides]
    assert (axes.get_xscale(), axes.get_yscale()) == (("linear", "log") if turned else ("log", "linear"))
    assert bar.get_ylabel() == SYMBOLS["pull_off_force"]
    filled = next(one for one in axes.collections if isinstance(one, QuadContourSet) and one.filled)
    assert filled.levels[0] <= one["pull_off_force"].min() < one["pull_off_force"].max() <= filled.levels[-1]
    lines = contours(axes)
    assert lines.labelTexts
    crossings = 0  # a contour crosses a line of the grid where the values along it, interpolated, have its level
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        places = path.vertices[:, ::-1] if turned else path.vertices
        for wavelength, k in places[np.isclose(places[:, 1:], one["k"].values, rtol=1e-12, atol=1e-12).any(axis=1)]:
            values = one["pull_off_force"].values[int(np.argmin(np.abs(one["k"].values - k)))]
            assert np.interp(wavelength, one["lambda_over_R"], values) == pytest.approx(level, rel=1e-9)
            crossings += 1
    assert crossings > 20


def test_panels_have_some_values_of_their_axes() -> None:
    own: dict[str, Any] = {"A": np.linspace(0, 0.04, 5), "lambda_over_R": np.linspace(0.1, 0.4, 6), "a_max_over_R": [0.5, 1.0]}  # fmt: skip
    scenes = computed(["pull_off_force"], k=[0.0, 0.4], **own)
    panels = gr.plot(scenes, kind="lines", x="lambda_over_R", y="k")
    titles = [axes.get_title() for axes in panels]
    assert titles == ["$A$ = 0.01", "$A$ = 0.03", "$A$ = 0.04", "", "", ""], "waves of no height have no length"
    assert len({(axes.get_xlim(), axes.get_ylim()) for axes in panels}) == 1, "they are compared at a glance"
    rows = [text.get_text() for axes in panels for text in axes.texts if "a_" in text.get_text()]
    assert rows == [r"$a_{\max}/R$ = 0.5", r"$a_{\max}/R$ = 1"]


def test_what_is_fixed_or_reduced_is_drawn_and_said(grid: xarray.Dataset) -> None:
    force = grid["pull_off_force"]
    panels = gr.plot(grid, "pull_off_force", at={"A": 0.019}, over={"k": "max"})
    assert r"A = 0.02, a_{\max}/R = 0.7, max over k" in words(panels)
    np.testing.assert_array_equal(panels[0].get_lines()[0].get_ydata(), force.isel(A=1).max("k"))
    panels = gr.plot(grid, "pull_off_force", at={"A": 0.03, "k": 0.0}, interpolate=True)
    assert "A = 0.03 (interpolated)" in words(panels)
    np.testing.assert_allclose(panels[0].get_lines()[0].get_ydata(), force.isel(k=0).interp(A=0.03), rtol=1e-14)
    failed = grid.copy(deep=True)
    failed["pull_off_force"][0, :, 0] = np.nan
    assert "20 failed scenes left out" in words(gr.plot(failed, "pull_off_force", at={"k": 0.0}, over={"A": "mean"}))
    lines = gr.plot(grid, "pull_off_force", at={"A": 0.02}, kind="lines")
    assert "6 of 9 values of k" in words(lines)
    assert len(curves(lines[0])) == 6


def test_the_place_of_an_extreme_is_drawn_and_marked_at_an_end(grid: xarray.Dataset) -> None:
    one = grid.isel(k=0, lambda_over_R=slice(0, 12))
    panels = gr.plot(one, "pull_off_force", over={"lambda_over_R": "argmin"})
    places = one["lambda_over_R"].values[one["pull_off_force"].argmin("lambda_over_R").values]
    line = panels[0].get_lines()[0].get_ydata()
    assert np.isnan(line[0]), "without waves the force does not depend on their length"
    np.testing.assert_array_equal(line[1:], places[1:])
    assert "1 left out where all values are equal" in words(panels)
    ends = np.isin(places[1:], one["lambda_over_R"].values[[0, -1]]).sum()
    assert [len(line.get_xdata()) for line in panels[0].get_lines() if line.get_marker() == "^"] == [ends]
    assert ends
    assert "argmax" in mistakes(gr.plot, grid, "pull_off_force", at={"A": 0.0}, over={"lambda_over_R": "argmax"})[0]


def test_units_have_prefixes_and_values_stay_in_si(root: Path) -> None:
    scenes = gr.run(root / "configs/physical.toml")
    force, energy = gr.plot(scenes, at={"k": 0.0, "work_of_adhesion": "50 mJ/m^2", "A": 0.0})
    assert (force.get_xlabel(), force.get_ylabel()) == ("$R$ (µm)", "pull-off force $F$ (µN)")
    force.figure.draw_without_rendering()
    assert {"0.5", "1", "2", "5"} <= {tick.get_text() for tick in force.get_xticklabels()}
    np.testing.assert_array_equal(force.get_lines()[0].get_xdata(), scenes["R"])
    johnson_kendall_roberts = 1.5 * np.pi * scenes["R"].values * 0.05
    np.testing.assert_allclose(force.get_lines()[0].get_ydata(), johnson_kendall_roberts, rtol=1e-12)
    assert energy.get_yscale() == "linear"
    wide = gr.plot(scenes, at={"k": 0.0, "work_of_adhesion": 0.02})
    assert [axes.get_yscale() for axes in wide] == ["log", "log"], "they differ by 50 and more"
    assert r"\Delta\gamma = 20 mJ/m^2, c_0 = 10 nm" in words(wide)
    assert "E^{\\ast}R" not in words(wide), "what follows from other parameters is not told"
    over = gr.plot(scenes, at={"k": 0.0, "work_of_adhesion": 0.02, "A": 0.0}, x="c0_over_R")
    np.testing.assert_array_equal(over[0].get_lines()[0].get_xdata()[::-1], scenes["c0_over_R"])


def test_prefixes_suit_a_logarithmic_axis_and_numbers_differ_where_values_do(grid: xarray.Dataset) -> None:
    for low, high, symbol in ((5e-9, 9e-7, "nm"), (2e-7, 9e-5, "µm"), (3e-10, 4e-6, "nm")):
        waves = np.geomspace(low, high, 20)
        wide = grid.isel(A=1, k=0).rename(lambda_over_R="wavelength").assign_coords(wavelength=waves)
        assert gr.plot(wide, "pull_off_force")[0].get_xlabel() == rf"$\lambda$ ({symbol})"
    near = grid.isel(A=1, k=slice(0, 5)).assign_coords(k=0.3 + 1e-7 * np.arange(5.0))
    near["k"].attrs = grid["k"].attrs
    assert len({*legend(gr.plot(near, "pull_off_force"))}) == 5
    (axes,) = gr.plot(near, "pull_off_force", x="k", at={"lambda_over_R": 0.1})
    axes.figure.draw_without_rendering()
    numbers = [float(tick.get_text()) for tick in axes.get_xticklabels()]
    assert len({*numbers}) == len(numbers) >= 3
    np.testing.assert_allclose(numbers, axes.get_xticks(), rtol=1e-14)


def test_points_are_drawn_over_a_parameter_and_many_as_their_number(grid: xarray.Dataset) -> None:
    parameters = PUNCH | {"lambda_over_R": [0.2, 0.1], "k": [0.1, 0.3], "A": 0.1}
    points = gr.run({"layout": "points", "outputs": ["pull_off_force"], "parameters": parameters})
    for x, order in (("lambda_over_R", [1, 0]), (None, [0, 1])):
        panels = gr.plot(points, "pull_off_force", x=x)
        assert panels[0].get_xlabel() == SYMBOLS[x or "k"]
        expected = np.column_stack([points[x or "k"].values[order], points["pull_off_force"].values[order]])
        np.testing.assert_array_equal(panels[0].get_lines()[0].get_xydata(), expected)
    assert "varying too: \\lambda/R" in words(panels)
    k = np.random.default_rng(7).uniform(0.0, 0.9, 2500)
    status = ("scene", np.zeros(k.size, "i4"), grid["status"].attrs)
    coords = {"k": ("scene", k), "nu": ("scene", np.full(k.size, 0.3))}
    many = xarray.Dataset({"pull_off_force": ("scene", 1.0 + k), "status": status}, coords, grid.attrs)
    many["pull_off_force"][:40] = np.nan
    (cells,) = gr.plot(many)[0].collections
    assert float(np.sum(cells.get_array())) == k.size - 40, "every scene with a value is counted once"
    assert not gr.plot(many.isel(scene=slice(0, 100)))[0].collections
    assert "density" in mistakes(gr.plot, many, band="std")[0]


def test_a_status_has_a_colour_or_a_height_for_each_set_of_flags(grid: xarray.Dataset) -> None:
    one = grid.isel(A=1).copy(deep=True)
    codes, places = np.array([0, 4, 9]), np.arange(20) * 3 // 20
    one["status"][...] = codes[places]
    axes, bar = gr.plot(one, "status").figure.axes
    mesh = axes.collections[0]
    np.testing.assert_array_equal(codes[mesh.get_array().astype(int)], one["status"])
    assert bar.get_yticklabels()[0].get_text() == "nothing to report"
    shades = mesh.cmap(mesh.norm(np.arange(3))) @ [0.299, 0.587, 0.114, 0.0]
    assert (np.diff(shades) > 0.2).all(), "they differ in a grey print"
    few = one.isel(k=slice(0, 2))
    (lines,) = gr.plot(few, "status")
    assert len(lines.get_yticklabels()) == 3
    assert np.round(lines.get_lines()[0].get_ydata()).tolist() == places.tolist()
    assert "ylim" in mistakes(gr.plot, few, "status", ylim=(0, 1))[0]


def test_a_front_is_one_goal_over_the_other() -> None:
    search = {"maximise": ["pull_off_force", "dissipated_energy"], "over": ["A"], "resolution": 12}
    own = {"k": [0.0, 0.3], "lambda_over_R": 0.2, "A": {"start": 0.0, "stop": 0.02}}
    front = gr.run({"kind": "optimum", "optimum": search, "parameters": PUNCH | own})
    (axes,) = gr.plot(front)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (SYMBOLS["pull_off_force"], SYMBOLS["dissipated_energy"])
    for line, values in zip(curves(axes), front["best_pull_off_force"].values, strict=True):
        np.testing.assert_array_equal(line.get_xdata(), values[np.isfinite(values)])
    ends = float(front["best_pull_off_force"].min()) - 0.5, float(front["best_pull_off_force"].max()) + 0.25
    assert gr.plot(front, xlim=ends)[0].get_xlim() == pytest.approx(ends, rel=1e-12)
    for choices in ({"band": "std"}, {"kind": "map"}, {"over": {"k": "max"}}, {"variables": "A"}):
        mistakes(gr.plot, front, **choices)
