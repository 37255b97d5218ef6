"""`gr.plot` and `gr.explore`."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

import gradhesion as gr

PUNCH: dict[str, Any] = {"nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "a_max_over_R": 0.7, "A": 0.01}


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
    """A map over two axes."""
    return gr.solve(PUNCH, k=[0.0, 0.3, 0.6], lambda_over_R=[0.1, 0.2, 0.4])


def test_a_figure_is_that_of_the_command(grid: xarray.Dataset, tmp_path: Path, gradhesion: Any) -> None:
    grid.to_netcdf(tmp_path / "x.nc")
    panels = gr.plot(grid, "pull_off_force", at={"k": 0.3})
    assert isinstance(panels.figure, Figure)
    options = ["--variable", "pull_off_force", "--at", "k=0.3", "-o", tmp_path / "command.png"]
    assert gradhesion("plot", tmp_path / "x.nc", *options).exit_code == 0
    assert panels._repr_png_() == (tmp_path / "command.png").read_bytes()
    (line, *_) = panels[0].get_lines()
    assert line.get_ydata() == pytest.approx(grid["pull_off_force"].sel(k=0.3).values, rel=1e-15)
    assert [axes.get_ylabel() for axes in gr.plot(tmp_path / "x.nc", at={"k": 0.3})] == [
        axes.get_ylabel() for axes in grid.gr.plot(at={"k": 0.3})
    ]


def test_axes_are_reduced_and_given_their_places(grid: xarray.Dataset) -> None:
    (panel,) = gr.plot(grid, ["pull_off_force"], over={"lambda_over_R": "max"})
    (line, *_) = panel.get_lines()
    assert line.get_ydata() == pytest.approx(grid["pull_off_force"].max("lambda_over_R").values, rel=1e-15)
    assert gr.plot(grid, "pull_off_force", x="k", y="lambda_over_R")[0].get_xlabel() == "$k$"
    (part,) = gr.plot(grid, "pull_off_force", xlim=(0.15, None), ylim=("0.5", 1.5), inset=(0.2, 0.3), band="none")
    assert part.get_xlim()[0] == pytest.approx(0.15, rel=1e-12)
    assert part.get_ylim() == pytest.approx((0.5, 1.5), rel=1e-12)
    assert [inset.get_xlim() for inset in part.child_axes] == [pytest.approx((0.2, 0.3), rel=1e-12)]


@pytest.mark.parametrize(("arguments", "said"), [({"kind": "maps"}, "kind maps: "), ({"levels": []}, "levels : "), ({"interpolate": True}, "interpolate: ")])  # fmt: skip
def test_wishes_that_cannot_be_met(arguments: dict[str, Any], said: str, grid: xarray.Dataset) -> None:
    with pytest.raises(gr.DatasetError) as refused:
        gr.plot(grid, **arguments)
    assert said in str(refused.value)
    assert "--" not in str(refused.value)


def test_named_dimensions_are_for_xarray() -> None:
    named = gr.solve(PUNCH, k=0.3, lambda_over_R=xarray.DataArray([0.1, 0.2], dims="x"))
    with pytest.raises(
        gr.DatasetError, match="its dimension x is no parameter, and pictures are drawn over parameters"
    ):
        named.gr.plot()
    points = gr.solve(PUNCH, k=0.3, lambda_over_R=xarray.DataArray([0.1, 0.2], dims="scene"))
    assert points.gr.plot("pull_off_force", x="lambda_over_R")


def test_a_variable_alone_is_not_drawn(grid: xarray.Dataset) -> None:
    for call in (gr.plot, gr.verify):
        with pytest.raises(gr.DatasetError, match="a DataArray is neither a dataset nor the path of one"):
            call(grid["pull_off_force"])  # type: ignore[arg-type]


def test_a_page_is_written_once(grid: xarray.Dataset, tmp_path: Path) -> None:
    pytest.importorskip("bokeh")
    page = gr.explore(grid, tmp_path / "x.html", variables="pull_off_force")
    assert page == tmp_path / "x.html"
    text = page.read_text(encoding="utf-8")
    assert "<html" in text
    assert "pull_off_force, dissipated_energy" in text, "its title"
    with pytest.raises(gr.OutputError, match=r"x\.html"):
        gr.explore(grid, page)
    assert gr.explore(grid, page, at={"k": 0.3}, overwrite=True) == page
    assert page.read_text(encoding="utf-8") != text
    grid.to_netcdf(tmp_path / "y.nc")
    assert gr.explore(tmp_path / "y.nc") == tmp_path / "y.html"
    with pytest.raises(gr.OutputError, match="a page of a dataset in memory needs a name"):
        gr.explore(grid)
    with pytest.raises(gr.OutputError, match=r"the name of a page ends in \.html"):
        gr.explore(grid, tmp_path / "x.png")


def test_a_picture_is_saved_in_its_size_and_style(grid: xarray.Dataset, tmp_path: Path) -> None:
    panels = gr.plot(grid, kind="map", width="page", height=4, colour_map="cividis", style="gradhesion.journal")
    assert panels.figure.get_size_inches() == pytest.approx([190 / 25.4, 4.0], rel=1e-15)
    assert len(panels) == 2, "colour bars are no panels"
    assert len(panels[:1]) == 1
    panels.savefig(tmp_path / "map.png")
    width, height = np.frombuffer((tmp_path / "map.png").read_bytes()[16:24], ">u4")
    assert (width, height) == (int(300 * 190 / 25.4), 1200), "300 dots per inch are those of the style"


def test_realisations_are_reduced_as_the_command_does_it() -> None:
    rough = gr.solve(PUNCH, k=0.1, lambda_over_R=[0.1, 0.2], profile={"spectrum": {"hurst": 0.8, "first": 1, "last": 4, "realisations": 5, "seed": 1}})  # fmt: skip
    (panel, _) = gr.plot(rough, over={"realisation": "p95"})
    upper = rough["pull_off_force"].quantile(0.95, "realisation")
    assert panel.get_lines()[0].get_ydata() == pytest.approx(upper.values, rel=1e-14)
    assert len(gr.plot(rough)) == 2
