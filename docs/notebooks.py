"""Notebooks made from pages of the manual that are Python throughout, for readers to download."""

import re
from pathlib import Path
from typing import Final

import jupytext

FOLDER: Final = Path(__file__).parent

PAGES: Final = ("notebook", "colloidal_probe", "statistics")
"""The pages that become notebooks."""

_LINK: Final = re.compile(r"\[([^]]*)\]\([\w/.-]+\.md(?:#[\w-]*)?\)")
"""A link to another page."""


def notebook(page: str) -> str:
    """
    Make a notebook of a page: its Python as cells of code, all else as text, what is printed included.

    Links to other pages lose their addresses, which a notebook on its own does not reach.
    """
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    made = jupytext.reads(_LINK.sub(r"*\1*", text), fmt="md")
    for number, cell in enumerate(made.cells):
        cell["id"] = f"{page}-{number}"  # jupytext draws them at random
    made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return str(jupytext.writes(made, fmt="ipynb")) + "\n"


def write(folder: Path) -> list[Path]:
    """Write all notebooks into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f"{page}.ipynb" for page in PAGES]
    for page, file in zip(PAGES, files, strict=True):
        file.write_text(notebook(page), encoding="utf-8")
    return files
