"""The pages of the manual that follow from the program: `make docs` writes them into `docs/reference/`."""

from collections.abc import Callable
from pathlib import Path
from typing import Final

from docs import command_page, dataset_page, python_page, study_page

FOLDER: Final = Path(__file__).parent / "reference"

PAGES: Final[dict[str, Callable[[], str]]] = {
    "commands": command_page.page,
    "dataset": dataset_page.page,
    "python": python_page.page,
    "study": study_page.page,
}
"""What writes each page."""


def write() -> None:
    """Write all pages."""
    FOLDER.mkdir(exist_ok=True)
    for name, page in PAGES.items():
        (FOLDER / f"{name}.md").write_text(page() + "\n", encoding="utf-8")
