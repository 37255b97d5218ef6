"""Draw a figure of the paper from its dataset: `python -m figures fig4a DATASET PICTURE...`."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Final

import xarray
from matplotlib.figure import Figure

from figures import extras, fig1, fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9
from figures.style import styled

PICTURES: Final[dict[str, Callable[..., None]]] = {
    name: draw
    for module in (fig1, fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9, extras)
    for name, draw in module.PICTURES.items()
}
"""What draws each picture into the axes that it is given: one, or as many as it has panels."""

PANELS: Final = {"fig4a": 3, "fig9": 2, "extra_roughness": 2}
"""The pictures of several panels, side by side."""

UNDATED: Final = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}
"""The same dataset gives the same file."""


def figure_of(name: str, dataset: xarray.Dataset) -> Figure:
    """Draw a picture; the style is to be set."""
    figure, panels = Figure(), PANELS.get(name, 1)
    width, height = figure.get_size_inches()
    figure.set_size_inches(panels * width, height)
    PICTURES[name](*figure.subplots(1, panels, squeeze=False)[0], dataset)
    return figure


def draw(name: str, dataset: xarray.Dataset, files: list[Path], dpi: float | None = None) -> None:
    """Draw a picture and save it in files, each in the form of its suffix."""
    with styled():
        figure = figure_of(name, dataset)
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # all files have the layout of the first
        for file in files:
            file.parent.mkdir(parents=True, exist_ok=True)
            figure.savefig(file, dpi=dpi or "figure", metadata=UNDATED.get(file.suffix))


def main() -> None:
    """Read the command line, and draw."""
    parser = argparse.ArgumentParser(prog="python -m figures", description=__doc__)
    parser.add_argument("name", choices=PICTURES, metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument("dataset", type=Path, help="from `gradhesion run` on its study in configs/")
    parser.add_argument("pictures", type=Path, nargs="+", metavar="PICTURE", help=".png, .pdf or .svg")
    parser.add_argument("--dpi", type=float, help="of a .png [300]")
    arguments = parser.parse_args()
    with xarray.open_dataset(arguments.dataset) as dataset:
        draw(arguments.name, dataset, arguments.pictures, arguments.dpi)


if __name__ == "__main__":
    main()
