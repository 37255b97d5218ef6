"""Draw a figure of the paper from its dataset: `python -m figures fig4a DATASET PICTURE...`."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Final

import xarray
from matplotlib.figure import Figure

from figures import extras, fig1, fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9, moving_edge
from figures.style import styled

PICTURES: Final[dict[str, Callable[..., None]]] = {
    name: draw
    for module in (fig1, fig2, fig3, fig4, fig5, fig6, fig7, fig8, fig9, extras, moving_edge)
    for name, draw in module.PICTURES.items()
}
"""What draws each picture into the axes that it is given: one, or as many as it has panels."""

PANELS: Final = {"fig4a": 3, "extra_roughness": 2, "extra_best_wavelength": 2, "extra_split": 2, "extra_speed": 2}
"""The pictures of several panels, side by side."""

STUDIES: Final = Path(__file__).resolve().parents[1] / "configs"

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
            figure.savefig(file, dpi=dpi, metadata=UNDATED.get(file.suffix))  # of the style where none is given


def missing_of(name: str, dataset: xarray.Dataset) -> list[str]:
    """List the variables that a dataset lacks, and the axes in which it differs from the study of a picture."""
    from gradhesion.cli.study.reading import load_study  # noqa: PLC0415 (0.2 s that a picture does not need)

    study = load_study(study_of(name))
    axes = sorted({*study.sizes} ^ {str(axis) for axis in dataset["status"].dims})
    return [variable for variable in study.outputs or study.variables if variable not in dataset] + axes


def study_of(name: str) -> Path:
    """Return the study that a picture is drawn from: that of its name, or of all its panels a, b, ..."""
    own = STUDIES / f"{name}.toml"
    return own if own.exists() else STUDIES / f"{name[:-1]}.toml"


def main() -> None:
    """Read the command line, and draw."""
    parser = argparse.ArgumentParser(prog="python -m figures", description=__doc__)
    parser.add_argument("name", choices=PICTURES, metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument("dataset", type=Path, help="from `gradhesion run` on its study in configs/")
    parser.add_argument("pictures", type=Path, nargs="+", metavar="PICTURE", help=".png, .pdf or .svg")
    parser.add_argument("--dpi", type=float, help="of a .png [300]")
    arguments = parser.parse_args()
    name, file = arguments.name, arguments.dataset
    remedy = f"write it with `gradhesion run {study_of(name).relative_to(STUDIES.parent)}`"
    if not file.is_file():
        parser.exit(2, f"{file}: no such file; {remedy}\n")
    with xarray.open_dataset(file) as dataset:
        missing = missing_of(name, dataset) if "status" in dataset else ["status"]
        if missing:
            parser.exit(2, f"{file}: not a dataset that {name} is drawn from ({', '.join(missing)}); {remedy}\n")
        draw(name, dataset, arguments.pictures, arguments.dpi)


if __name__ == "__main__":
    main()
