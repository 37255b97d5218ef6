"""A notebook shows each picture once, whatever its cell does with it; a script shows none by itself."""

import sys
from collections.abc import Callable
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(scope="module")
def grid() -> xarray.Dataset:
    punch = {"k": [0.0, 0.3], "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "A": 0.0}
    return gr.solve(punch, "pull_off_force", lambda_over_R=np.linspace(0.1, 0.4, 5), a_max_over_R=0.7)


class Notebook:
    """The part of IPython that pictures meet: cells whose last value is shown, and calls when a cell has ended."""

    def __init__(self, *, kernel: bool = True) -> None:
        self.outputs: list[bytes] = []
        self.callbacks: dict[str, list[Callable[[], None]]] = {"post_execute": []}
        events = SimpleNamespace(callbacks=self.callbacks, register=lambda when, act: self.callbacks[when].append(act))
        self.shell = SimpleNamespace(events=events, kernel=object() if kernel else None)

    def display(self, value: Any) -> None:
        """Show a value, as a picture if it is one."""
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
    forms: dict[str, tuple[Callable[[], Any], int]] = {
        "the last expression": (lambda: gr.plot(grid), 1),
        "assigned": (lambda: kept.append(gr.plot(grid)), 1),
        "assigned, then the last expression": (lambda: kept.append(gr.plot(grid)) or kept[-1], 1),
        "one of its axes": (lambda: gr.plot(grid)[0], 1),
        "of the accessor": (grid.gr.plot, 1),
        "a loop": (lambda: [gr.plot(grid, at={"k": k}) for k in (0.0, 0.3)], 2),
        "displayed": (lambda: page.display(gr.plot(grid)), 1),
        "a cell without a picture": (lambda: None, 0),
        "a picture of an earlier cell": (lambda: kept[0], 1),
    }
    found = {form: page.cell(run) for form, (run, _) in forms.items()}
    assert found == {form: expected for form, (_, expected) in forms.items()}
    assert len(page.callbacks["post_execute"]) == 1


def test_what_a_cell_changes_is_shown(notebook: Callable[..., Notebook], grid: xarray.Dataset) -> None:
    page = notebook()
    page.cell(lambda: gr.plot(grid))
    (plain,) = page.outputs

    def changed() -> None:
        gr.plot(grid)[0].set_ylim(0.0, 9.0)

    page.cell(changed)
    assert page.outputs != [plain]


def test_a_terminal_shows_nothing_by_itself(notebook: Callable[..., Notebook], grid: xarray.Dataset) -> None:
    page = notebook(kernel=False)
    assert page.cell(lambda: gr.plot(grid) and None) == 0
    assert not page.callbacks["post_execute"]
