"""Write the pages of the manual that follow from the program: `python -m docs`, or `make reference`.

They are committed, so that they can be read where the repository is; a test compares them with what is written here.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Final

from docs import command_page, dataset_page, gallery_page, python_page, study_page

FOLDER: Final = Path(__file__).parent

PAGES: Final[dict[str, Callable[[], str]]] = {
    "gallery.md": gallery_page.page,
    "reference/commands.md": command_page.page,
    "reference/dataset.md": dataset_page.page,
    "reference/python.md": python_page.page,
    "reference/study.md": study_page.page,
}
"""What writes each page."""


def main() -> None:
    """Write all pages."""
    for name, page in PAGES.items():
        (FOLDER / name).write_text(page() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
