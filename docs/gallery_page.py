"""The page of pictures, each with its study and the command that makes it."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]
PICTURES: Final = ROOT / "docs" / "figures" / "paper"


def page() -> str:
    """Write the page."""
    return "\n\n".join(_sections())


def _sections() -> Iterator[str]:
    """Write the sections."""
    yield "# Gallery"
    yield (
        "Every picture is made from a study in `configs/` by one command. `make figures` draws all those of the paper; "
        "[the paper](paper.md#figures) says what is to be seen in them. `gradhesion init` writes the same study into a "
        "file of your own, to be changed, and `gradhesion plot` draws any dataset, in a plainer look."
    )
    yield "## " + _title("maps")
    yield "![Pull-off force and dissipated energy over the gradient exponent and the wavelength](images/maps.png)"
    yield "Study: [maps.toml](../configs/maps.toml). Made by `make maps`."
    for study in sorted((ROOT / "configs").glob("fig*.toml")):
        yield from _of(study.stem)


def _of(name: str) -> Iterator[str]:
    """Write the section of a study of the paper."""
    panels = sorted(picture.stem for picture in PICTURES.glob("*.png") if re.fullmatch(rf"{name}[a-c]?", picture.stem))
    panels = [panel for panel in panels if panel == name or not (ROOT / "configs" / f"{panel}.toml").exists()]
    yield "## " + _title(name)
    yield "\n".join(f"![{panel}](figures/paper/{panel}.png)" for panel in panels)
    targets = " ".join(f"outputs/figures/{panel}.png" for panel in panels)
    yield (
        f"Study: [{name}.toml](../configs/{name}.toml). Made by `make {targets}`; or `gradhesion init {name}`, "
        f"`gradhesion run {name}.toml` and `gradhesion plot outputs/{name}.nc`."
    )


def _title(name: str) -> str:
    """Take the title of a study."""
    title: str = tomllib.loads((ROOT / "configs" / f"{name}.toml").read_text(encoding="utf-8"))["title"]
    return title
