"""Size, colours, levels, limits and words of a picture are what a user chooses; what does not exist is refused."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

import gradhesion as gr
from tests.cli.conftest import Call, contours
from tests.conftest import mistakes

LIMITS = {"0.1 um:400 nm": (1e-7, 4e-7), "1e-7:4e-7": (1e-7, 4e-7), (1e-7, None): (1e-7, 1e-6), ":400nm": (5e-8, 4e-7)}


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
    """A force in newtons that is a saddle of known contours, over exponents and wavelengths from 50 nm to 1 um."""
    units = {"R": "2 um", "E_star": "1 GPa", "work_of_adhesion": "20 mJ/m^2", "c0": "10 nm", "a_max": "0.5 um"}
    waves = {"start": "50 nm", "stop": "1 um", "num": 40}
    study = {
        "title": "A small study",
        "outputs": ["pull_off_force", "dissipated_energy"],
        "parameters": {"k": {"start": 0.0, "stop": 0.9, "num": 10}, "nu": 0.3, "A": 0.01},
        "physical": units | {"wavelength": waves},
    }
    found = gr.run(study)
    found["pull_off_force"][...] = 1.0 + found["k"] + 1e6 * found["wavelength"]
    found["pull_off_force_si"][...] = 1e-7 * found["pull_off_force"]
    return found


@pytest.mark.parametrize(("width", "inches"), [("column", 90 / 25.4), ("page", 190 / 25.4), (5, 5.0), ("8 cm", 8 / 2.54)])  # fmt: skip
def test_sides_are_those_of_the_figure(width: Any, inches: float, grid: xarray.Dataset) -> None:
    panels = gr.plot(grid, width=width, height=3)
    assert panels.figure.get_size_inches() == pytest.approx([inches, 3.0], rel=1e-15)
    first, second = (axes.get_position() for axes in panels)
    assert (first.x0 == second.x0) == (inches < 4.8), "variables stand below each other in a column"


def drawn_levels(axes: Axes) -> dict[float, Any]:
    lines = contours(axes)
    return {level: path for level, path in zip(lines.levels, lines.get_paths(), strict=True) if path.vertices.size}


@pytest.mark.parametrize(("levels", "expected"), [("1.5,2.0", [1.5, 2.0]), ([1.25], [1.25]), ([0.5, 1.3], [1.3])])
def test_levels_are_those_listed(levels: Any, expected: list[float], grid: xarray.Dataset) -> None:
    axes, bar = gr.plot(grid, "pull_off_force", levels=levels).figure.axes
    shown = drawn_levels(axes)
    assert [*shown] == expected
    for level, path in shown.items():  # the saddle: 1 + k + wavelength/um
        np.testing.assert_allclose(1.0 + path.vertices @ [1e6, 1.0], level, rtol=0, atol=1e-12)
    ends = [float(end) for end in (grid["pull_off_force"].min(), grid["pull_off_force"].max())]
    listed = [float(level) for level in (levels.split(",") if isinstance(levels, str) else levels)]
    beyond = [end for end in ends if not min(listed) <= end <= max(listed)]
    assert {*bar.get_yticks()} == {*listed, *beyond}, "an end of the values has a colour of its own beyond the levels"
    filled = axes.collections[0]
    mesh = next(one for one in bar.collections if one.get_array() is not None)
    colours = mesh.to_rgba(np.asarray(mesh.get_array()).ravel())
    np.testing.assert_allclose(colours, filled.to_rgba(filled.get_array()), err_msg="bar and map have the same colours")


@pytest.mark.parametrize("levels", ["150 nN, 0.2 uN", "150 nN 2e-7", ["150 nN", 2e-7]])
def test_levels_are_in_si_or_have_units(levels: Any, grid: xarray.Dataset) -> None:
    shown = drawn_levels(gr.plot(grid, "pull_off_force_si", levels=levels)[0])
    assert [*shown] == [1.5e-7, 2e-7]
    for wrong in ("150 nm", "150 nN, 1 J"):
        told = mistakes(gr.plot, grid, "pull_off_force_si", levels=wrong)
        assert "pull_off_force_si, which is in N" in told[0]


def test_a_number_of_levels_and_a_colour_map_are_those_asked_for(grid: xarray.Dataset) -> None:
    few, many = (len(gr.plot(grid, "pull_off_force", levels=n)[0].collections[0].levels) for n in (4, 40))  # type: ignore[attr-defined]
    assert 3 <= few <= 6
    assert 20 <= many <= 42
    (lines,) = gr.plot(grid, "pull_off_force", colour_map="plasma", kind="lines")
    assert to_rgb(lines.get_lines()[0].get_color()) == to_rgb(mpl.colormaps["plasma"](0.0))
    assert gr.plot(grid, "pull_off_force", colour_map="plasma")[0].collections[0].get_cmap().name == "plasma"


def test_words_are_left_out_or_replaced(grid: xarray.Dataset) -> None:
    whole = gr.plot(grid, "pull_off_force")
    title, *caption = whole.figure.get_suptitle().splitlines()
    assert title == "A small study"
    assert r"$\nu$" in caption[0]
    assert contours(whole[0]).labelTexts
    assert gr.plot(grid, "pull_off_force", title=False, caption=False).figure.get_suptitle() == ""
    own = {"title": "My $k$", "xlabel": "waves", "ylabel": "depth", "clabel": "pull"}
    bare = gr.plot(grid, "pull_off_force", caption=False, labels=False, **own)
    shown = (bare[0].get_xlabel(), bare[0].get_ylabel(), bare.figure.axes[-1].get_ylabel())
    assert (bare.figure.get_suptitle(), *shown) == ("My $k$", "waves (µm)", "depth", "pull")
    assert not contours(bare[0]).labelTexts
    assert [axes.get_xlabel() for axes in gr.plot(grid, kind="lines", xlabel="waves")] == 2 * ["waves (µm)"]
    assert "ylabel" in mistakes(gr.plot, grid, kind="lines", ylabel="force")[0]


@pytest.mark.parametrize(("words", "shown", "written"), [
    ("pull", "pull (µN)", "10"), ("pull (nN)", "pull (nN)", "10000"), ("pull (uN)", "pull (uN)", "10"),
    ("pull (measured)", "pull (measured) (µN)", "10"), ("", "", "10"),
])  # fmt: skip
def test_numbers_are_in_the_unit_that_the_words_of_an_axis_end_with(words: str, shown: str, written: str) -> None:
    ball = {
        "k": 0.0,
        "nu": 0.3,
        "A": 0.0,
        "R": [1e-5, 2e-5, 5e-5],
        "E_star": 1e7,
        "work_of_adhesion": 0.1,
        "a_max": 2e-6,
    }
    (axes,) = gr.plot(gr.solve(ball, "pull_off_force"), ylabel=words)
    assert (axes.get_ylabel(), axes.yaxis.get_major_formatter()(1e-5)) == (shown, written)
    endless = gr.plot(gr.solve(ball | {"R": 1e-5, "a_max": [2e-6, 3e-6, np.inf]}, "pull_off_force"), xlabel="rim")
    assert endless[0].get_xlabel() == "rim (µm)"
    ticks = endless[0].xaxis.get_major_formatter().format_ticks(endless[0].get_xticks())
    assert (ticks[0], ticks[-2:]) == ("2", ["3", r"$\infty$"])
    field = gr.solve(ball | {"a_max": [2e-6, 3e-6, 4e-6, 5e-6, 6e-6, 7e-6]}, "pull_off_force")
    figure = gr.plot(field, kind="map", clabel=words or "pull")[0].figure
    assert figure.axes[-1].get_ylabel() == (shown or "pull (µN)")


@pytest.mark.parametrize("width", [3.0, 6.0])
def test_numbers_on_contours_are_whole_and_on_their_lines(width: float, grid: xarray.Dataset) -> None:
    (axes,) = gr.plot(grid, "pull_off_force", width=width, levels=12)
    axes.figure.draw_without_rendering()
    frame, texts = axes.get_window_extent(), contours(axes).labelTexts
    assert texts
    assert len({text.get_text() for text in texts}) == len(texts)
    for text in texts:
        box = text.get_window_extent()
        assert frame.contains(*box.min) * frame.contains(*box.max)
        x, y = text.get_position()
        assert 1.0 + 1e6 * x + y == pytest.approx(float(text.get_text()), abs=0.02)


def test_numbers_stand_clear_of_each_other_and_of_other_contours(grid: xarray.Dataset) -> None:
    """Where the map falls steeply, lines are nearer to each other than numbers are high."""
    steep = grid.copy(deep=True)
    steep["pull_off_force"][...] = 1.0 + grid["k"] + 4.0 / (1.0 + np.exp(4e7 * (grid["wavelength"] - 5e-7)))
    (axes,) = gr.plot(steep, "pull_off_force", levels=20)
    lines, inch = contours(axes), axes.figure.dpi
    places = {float(text.get_text()): np.array(text.get_position()) for text in lines.labelTexts}
    assert len(places) >= 3
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        for number, place in places.items():
            own = axes.transData.transform(place)
            others = axes.transData.transform([place for one, place in places.items() if one != number])
            assert np.hypot(*(others - own).T).min() > 0.35 * inch
            line = axes.transData.transform(np.reshape(path.vertices, (-1, 2)))
            apart = np.hypot(*(line - own).T).min(initial=np.inf)
            assert number == pytest.approx(level, rel=0.01) or apart > 0.08 * inch


@pytest.mark.parametrize("xlim", LIMITS)
@pytest.mark.parametrize("kind", ["lines", "map"])
def test_limits_are_in_si_or_have_units(kind: Any, xlim: Any, grid: xarray.Dataset) -> None:
    (axes,) = gr.plot(grid, "pull_off_force_si", xlim=xlim, kind=kind)
    assert axes.get_xlim() == pytest.approx(LIMITS[xlim], rel=0.2)
    for given, end in zip(LIMITS[xlim], axes.get_xlim(), strict=True):
        assert given in (5e-8, 1e-6) or end == pytest.approx(given, rel=1e-12)
    assert axes.get_xlabel() == (r"$\lambda$ (µm)" if xlim == (1e-7, None) else r"$\lambda$ (nm)")


def test_what_is_seen_sets_the_other_axis(grid: xarray.Dataset) -> None:
    force = grid["pull_off_force_si"]
    seen = force.sel(wavelength=slice(1.9e-7, 4.1e-7))
    (axes,) = gr.plot(grid, "pull_off_force_si", xlim=("200 nm", "400 nm"), kind="lines")
    low, high = axes.get_ylim()
    assert low < float(seen.min()) < float(seen.max()) < high < low + float(force.max() - force.min())
    (axes,) = gr.plot(grid, "pull_off_force_si", ylim="0.15 uN:0.2 uN", kind="lines")
    assert axes.get_ylim() == pytest.approx((1.5e-7, 2e-7), rel=1e-12)
    for axes in gr.plot(grid, xlim=(1e-7, 4e-7), ylim=(0.15, 0.4), kind="map"):
        assert (*axes.get_xlim(), *axes.get_ylim()) == pytest.approx((1e-7, 4e-7, 0.15, 0.4), rel=1e-12)
    between = gr.plot(grid, "pull_off_force_si", at={"k": 0.25}, interpolate=True, xlim=(1e-7, 4e-7))
    assert between[0].get_xlim() == pytest.approx((1e-7, 4e-7), rel=1e-12)


WRONG: list[tuple[str, dict[str, Any]]] = [
    ("width colum", {"width": "colum"}), ("width 9 m", {"width": "9 m"}), ("width -3", {"width": -3}), ("width nan", {"width": "nan"}),
    ("height column", {"height": "column"}), ("height 0.1", {"height": 0.1}), ("virids: ", {"colour_map": "virids"}),
    ("levels many", {"levels": "many"}), ("levels 0", {"levels": 0}), ("levels 1e9,2e9", {"levels": "1e9,2e9"}),
    ("levels", {"levels": 8, "kind": "lines"}), ("levels", {"levels": [1.5, 2.0], "variables": None}), ("map: ", {"kind": "map", "at": {"k": 0.0}}),
    ("style seaborm-v0_8", {"style": "seaborm-v0_8"}), ("xlim 2e-7:1e-7", {"xlim": "2e-7:1e-7"}), ("ylim 1:1", {"ylim": (1, 1), "kind": "lines"}),
    ("xlim 0.1", {"xlim": "0.1"}), ("xlim :", {"xlim": ":"}), ("xlim a:b", {"xlim": "a:b"}), ("xlim nan:1", {"xlim": "nan:1"}),
    ("xlim 50 nN:1 um", {"xlim": "50 nN:1 um"}), ("ylim 0 nN:1", {"ylim": "0 nN:1", "kind": "lines"}), ("xlim 2 um:3 um", {"xlim": "2 um:3 um"}),
    ("ylim 7:8", {"ylim": "7:8", "kind": "lines"}), ("ylim 0:1", {"ylim": "0:1", "kind": "lines", "variables": None}),
    ("x lamda", {"x": "lamda"}), ("x k", {"x": "k", "y": "k"}), ("x k", {"x": "k", "at": {"k": 0.0}}), ("y k", {"y": "k", "over": {"k": "max"}}),
    ("x nu", {"x": "nu"}), ("variable energy", {"variables": ["pull_off_force", "energy"]}), ("at k=1.5", {"at": {"k": 1.5}}),
    ("over k=product", {"over": {"k": "product"}}), ("nothing varies", {"at": {"k": 0.0, "wavelength": 1e-7}}),
    ("kind maps: ", {"kind": "maps"}), ("levels []: ", {"levels": []}), ("interpolate: ", {"interpolate": True}),
    ("1 by 1 inches", {"width": 1, "height": 1}), ("logarithmic", {"xlim": (0, 1e-7)}),
]  # fmt: skip


def test_what_does_not_exist_is_said(grid: xarray.Dataset) -> None:
    uneven = grid.assign_coords(wavelength=np.geomspace(5e-8, 1e-6, 40))
    for key, choices in WRONG:
        dataset = uneven if key == "logarithmic" else grid
        (sentence,) = mistakes(gr.plot, dataset, **({"variables": "pull_off_force"} | choices))
        assert key in sentence
        assert "--" not in sentence, "keywords of Python"
    assert len(mistakes(gr.plot, grid, width="colum", levels="many", kind="maps")) == 3, "all at once"


def test_a_mistake_leaves_what_is_there(grid: xarray.Dataset, tmp_path: Path, gradhesion: Call) -> None:
    path, picture = tmp_path / "x.nc", tmp_path / "x.png"
    grid.to_netcdf(path)
    for options in (["--xlim", "1 um:50 nm"], ["--variable", "energy"], ["-o", tmp_path / "x.bmp"], ["--levels", "?"]):
        assert str(options[1]) in gradhesion("plot", path, *options, code=2).stderr
        assert not picture.exists()
    picture.write_text("precious")
    assert gradhesion("plot", path).exit_code == 4
    assert picture.read_text() == "precious"


@pytest.mark.parametrize(("form", "start"), [("svg", b"<?xml"), ("PDF", b"%PDF"), ("png", b"\x89PNG")])
def test_a_name_gives_the_form(form: str, start: bytes, grid: xarray.Dataset, tmp_path: Path, gradhesion: Call) -> None:
    grid.to_netcdf(tmp_path / "x.nc")
    own = tmp_path / "own.mplstyle"
    own.write_text("savefig.dpi: 50\n")
    choices = ["--no-title", "--xlabel", "waves", "--title", "Mine", "--style", own, "--width", "4", "--height", "3"]
    pictures = [tmp_path / f"{name}.{form}" for name in ("one", "two")]
    for picture, more in zip(pictures, ({}, {"font.size": 30, "axes.facecolor": "red"}), strict=True):
        with mpl.rc_context(more):
            assert gradhesion("plot", tmp_path / "x.nc", "-o", picture, *choices).exit_code == 0
    assert pictures[0].read_bytes().startswith(start)
    assert pictures[0].read_bytes() == pictures[1].read_bytes(), "whatever style the user has"
    if form == "png":
        assert np.frombuffer(pictures[0].read_bytes()[16:24], ">u4").tolist() == [200, 150]
    if form == "svg":
        assert "waves" in pictures[0].read_text()
