"""The page of pictures, each with its study and the command that makes it."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]
PICTURES: Final = ROOT / "docs" / "figures" / "paper"

NUMBER: Final = r"\d+(?:\.\d+)?"
LETTER: Final = r"(?:delta|lambda|nu|a_(?:2|4|am|max)|c0|C[12]|[kPRrz]|A(?=,| =| and| is| lambda)|a(?=\.| =))(?!\w)"
FORMULA: Final = (
    rf"\(3\+k\)/3|(?<![\w'`.\\-])(?:{NUMBER} )?{LETTER}"
    rf"(?:\^\(\(1\+k\)/2\)| A(?!\w)| {LETTER}|(?: [=<+] |/)(?:{NUMBER} )?(?:{LETTER}|[as]\b|{NUMBER}))*"
)
"""A formula in the plain text of a study: letters, numbers, and what joins them."""
LATEX: Final = {letter: f"\\{letter}" for letter in ("delta", "lambda", "nu")} | {
    "c0": "c_0",
    "C1": "C_1",
    "C2": "C_2",
    "_am": r"_\mathrm{am}",
    "_max": r"_\mathrm{max}",
    "((1+k)/2)": "{(1+k)/2}",
}
NAME: Final = r"(?<!`)\b[a-z]{2,}(?:_[a-z]+)+\b"


def page() -> str:
    """Write the page."""
    return "\n\n".join(_sections())


def _sections() -> Iterator[str]:
    """Write the sections."""
    yield "# Gallery"
    yield (
        "Every figure is made from a study in `configs/` by one command; `make figures` draws all. The paper's "
        "figures have its numbers, and each lists which values are the paper's and which are chosen; the others are "
        "extras. [The paper](paper.md#figures) describes what they show. `gradhesion init` writes the same study into "
        "a file of your own, and `gradhesion plot` draws any dataset in a plainer style."
    )
    yield "## " + _title("maps")
    yield "![Pull-off force and dissipated energy over the gradient exponent and the wavelength](images/maps.png)"
    yield "Study: [maps.toml](../configs/maps.toml). Made by `make maps`."
    for pattern in ("fig*.toml", "extra_*.toml"):
        for study in sorted((ROOT / "configs").glob(pattern)):
            yield from _of(study.stem)


def _of(name: str) -> Iterator[str]:
    """Write the section of a study of the paper."""
    panels = sorted(picture.stem for picture in PICTURES.glob("*.png") if re.fullmatch(rf"{name}[a-c]?", picture.stem))
    panels = [panel for panel in panels if panel == name or not (ROOT / "configs" / f"{panel}.toml").exists()]
    yield "## " + _with_formulae(_title(name))
    yield "\n".join(f"![{panel}](figures/paper/{panel}.png)" for panel in panels)
    yield from _comment(name)
    targets = " ".join(f"outputs/figures/{panel}.png" for panel in panels)
    yield (
        f"Study: [{name}.toml](../configs/{name}.toml). Made by `make {targets}`; or `gradhesion init {name}`, "
        f"`gradhesion run {name}.toml` and `gradhesion plot outputs/{name}.nc`."
    )


def _comment(name: str) -> Iterator[str]:
    """Take what a study says of itself: what is to be seen, what is the paper's, and what is chosen."""
    lines = (ROOT / "configs" / f"{name}.toml").read_text(encoding="utf-8").splitlines()
    head = [
        line.removeprefix("#").strip() for line in lines[: next(i for i, line in enumerate(lines) if line[:1] != "#")]
    ]
    yield from (_with_formulae(paragraph.strip()) for paragraph in " ".join(line or "\n" for line in head).split("\n"))


def _with_formulae(text: str) -> str:
    """Set the formulae and names of plain text as the manual sets them."""
    text = re.sub(NAME, r"`\g<0>`", text)
    return re.sub(FORMULA, lambda formula: f"${_latex(formula[0])}$", text)


def _latex(formula: str) -> str:
    """Write a formula of plain text in LaTeX."""
    formula = re.sub(r"(?<=\w)(?<!lambda) (?=\w)", "", formula)
    for plain, latex in LATEX.items():
        formula = formula.replace(plain, latex)
    return formula


def _title(name: str) -> str:
    """Take the title of a study."""
    title: str = tomllib.loads((ROOT / "configs" / f"{name}.toml").read_text(encoding="utf-8"))["title"]
    return title
