"""What the page on installation says of upgrading names what exists: modules, studies, and the version of the changelog."""

import re
import tomllib
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "installation.md").read_text(encoding="utf-8")
ROWS = [
    [re.findall(r"`([^`]+)`", cell) for cell in line.strip("| ").split(" | ")]
    for line in PAGE.splitlines()
    if line.startswith("| `gradhesion.")
]


@pytest.mark.parametrize(("old", "new"), ROWS)
def test_a_module_that_has_moved_is_where_the_page_says(old: list[str], new: list[str]) -> None:
    for name in new:
        assert import_module(name)
    for name in (name for name in old if name.startswith("gradhesion.")):
        assert find_spec(name.rpartition(".")[0])
        try:
            left = import_module(name)
        except ModuleNotFoundError:
            continue
        assert hasattr(left, "__path__"), name  # a folder of that name has come in its place


def test_the_studies_that_it_names_are_shipped() -> None:
    for name in re.findall(r"\b(extra_[a-z_]+|fig1|fig9)\b", PAGE):
        assert (ROOT / "configs" / f"{name}.toml").is_file(), name


def test_the_changelog_begins_with_this_version_and_its_date() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first, *_ = re.findall(r"^## (\S+) \((\d{4}-\d\d-\d\d)\)$", text, re.MULTILINE)
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert first[0] == version
    assert re.search(rf'^date-released: "{first[1]}"$', citation, re.MULTILINE)
