"""`gr.plot` and `gr.explore`; a notebook shows each picture once, whatever its cell does with it, a script none by itself."""

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

import gradhesion as gr
from tests.conftest import mistakes

PNG = b"\x89PNG\r\n\x1a\n"
PUNCH: dict[str, Any] = {"nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "a_max_over_R": 0.7, "A": 0.01}


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
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
    both = gr.plot(tmp_path / "x.nc", at={"k": 0.3}), grid.gr.plot(at={"k": 0.3})
    assert len({tuple(axes.get_ylabel() for axes in panels) for panels in both}) == 1


def test_named_dimensions_are_for_xarray() -> None:
    named = gr.solve(PUNCH, k=0.3, lambda_over_R=xarray.DataArray([0.1, 0.2], dims="x"))
    assert "dimension x is no parameter, and pictures are drawn over parameters" in mistakes(named.gr.plot)[0]
    points = gr.solve(PUNCH, k=0.3, lambda_over_R=xarray.DataArray([0.1, 0.2], dims="scene"))
    assert points.gr.plot("pull_off_force", x="lambda_over_R")


def test_a_variable_alone_is_not_drawn(grid: xarray.Dataset) -> None:
    for call in (gr.plot, gr.verify):
        assert "a DataArray is neither a dataset nor the path of one" in mistakes(call, grid["pull_off_force"])[0]


def test_a_page_is_written_once(grid: xarray.Dataset, tmp_path: Path) -> None:
    page = gr.explore(grid, tmp_path / "x.html", variables="pull_off_force")
    assert page == tmp_path / "x.html"
    text = page.read_text(encoding="utf-8")
    assert "pull_off_force, dissipated_energy" in text, "its title"
    with pytest.raises(gr.OutputError, match=r"x\.html"):
        gr.explore(grid, page)
    assert gr.explore(grid, page, at={"k": 0.3}, overwrite=True) == page
    assert page.read_text(encoding="utf-8") != text
    grid.to_netcdf(tmp_path / "y.nc")
    assert gr.explore(tmp_path / "y.nc") == tmp_path / "y.html"
    for path in (None, tmp_path / "x.png"):
        with pytest.raises(gr.OutputError, match=r"a page .*( needs a name|ends in \.html)"):
            gr.explore(grid, path)


def test_a_picture_is_saved_in_its_size_and_style(grid: xarray.Dataset, tmp_path: Path) -> None:
    panels = gr.plot(grid, kind="map", width="page", height=4, colour_map="cividis", style="gradhesion.journal")
    assert panels.figure.get_size_inches() == pytest.approx([190 / 25.4, 4.0], rel=1e-15)
    assert (len(panels), len(panels[:1])) == (2, 1), "colour bars are no panels"
    panels.savefig(tmp_path / "map.png")
    width, height = np.frombuffer((tmp_path / "map.png").read_bytes()[16:24], ">u4")
    assert (width, height) == (int(300 * 190 / 25.4), 1200), "300 dots per inch are those of the style"


class Notebook:
    """The part of IPython that pictures meet: cells whose last value is shown, and calls when a cell has ended."""

    def __init__(self, *, kernel: bool = True) -> None:
        self.outputs: list[bytes] = []
        self.callbacks: dict[str, list[Callable[[], None]]] = {"post_execute": []}
        events = SimpleNamespace(callbacks=self.callbacks, register=lambda when, act: self.callbacks[when].append(act))
        self.shell = SimpleNamespace(events=events, kernel=object() if kernel else None)

    def display(self, value: Any) -> None:
        if hasattr(value, "_repr_png_"):
            self.outputs.append(value._repr_png_())

    def cell(self, run: Callable[[], Any]) -> int:
        """Run a cell and count the pictures below it."""
        self.outputs.clear()
        self.display(run())
        for act in self.callbacks["post_execute"]:
            act()
        assert all(output.startswith(PNG) for output in self.outputs)
        return len(self.outputs)


@pytest.fixture
def notebook(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Notebook]:
    def made(**options: Any) -> Notebook:
        one = Notebook(**options)
        ipython, display = ModuleType("IPython"), ModuleType("IPython.display")
        ipython.get_ipython = lambda: one.shell  # type: ignore[attr-defined]
        ipython.version_info = (9, 0)  # type: ignore[attr-defined] # matplotlib asks
        display.display = one.display  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, "IPython", ipython)
        monkeypatch.setitem(sys.modules, "IPython.display", display)
        return one

    return made


def test_every_form_shows_a_picture_once(notebook: Callable[..., Notebook], grid: xarray.Dataset) -> None:
    page = notebook()
    kept: list[Any] = []
    one = partial(gr.plot, grid, "pull_off_force")
    forms: dict[str, tuple[Callable[[], Any], int]] = {
        "the last expression": (one, 1),
        "assigned": (lambda: kept.append(one()), 1),
        "assigned, then the last expression": (lambda: kept.append(one()) or kept[-1], 1),
        "one of its axes": (lambda: one()[0], 1),
        "of the accessor": (lambda: grid.gr.plot("pull_off_force"), 1),
        "a loop": (lambda: [one(at={"k": k}) for k in (0.0, 0.3)], 2),
        "displayed": (lambda: page.display(one()), 1),
        "a cell without a picture": (lambda: None, 0),
        "a picture of an earlier cell": (lambda: kept[0], 1),
    }
    found = {form: page.cell(run) for form, (run, _) in forms.items()}
    assert found == {form: expected for form, (_, expected) in forms.items()}
    assert len(page.callbacks["post_execute"]) == 1


def test_what_a_cell_changes_is_shown_and_a_terminal_shows_nothing_by_itself(
    notebook: Callable[..., Notebook], grid: xarray.Dataset
) -> None:
    page = notebook()
    one = partial(gr.plot, grid, "pull_off_force")
    page.cell(one)
    (plain,) = page.outputs
    page.cell(lambda: one()[0].set_ylim(0.0, 9.0) and None)
    assert page.outputs != [plain]
    page = notebook(kernel=False)
    assert page.cell(lambda: one() and None) == 0
    assert not page.callbacks["post_execute"]
