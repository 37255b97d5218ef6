"""Draw a figure of the paper from its dataset: `python -m figures fig4a DATASET PICTURE...`."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Final

import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figures import fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9
from figures.style import styled

PICTURES: Final[dict[str, Callable[[Axes, xarray.Dataset], None]]] = {
    name: draw for module in (fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9) for name, draw in module.PICTURES.items()
}
"""What draws each picture into the axes that it is given."""

UNDATED: Final = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}
"""The same dataset gives the same file."""


def draw(name: str, dataset: xarray.Dataset, files: list[Path], dpi: float | None = None) -> None:
    """Draw a picture and save it in files, each in the form of its suffix."""
    with styled():
        figure = Figure()
        PICTURES[name](figure.subplots(), dataset)
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
