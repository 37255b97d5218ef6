"""The citation, the changelog and the pages on installation and architecture agree with the project."""

import ast
import re
import tomllib
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml

from gradhesion.cli.names.scenes import REFERENCES

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
UPGRADING = (ROOT / "docs" / "installation.md").read_text(encoding="utf-8")
MOVED = [
    [re.findall(r"`([^`]+)`", cell) for cell in line.strip("| ").split(" | ")]
    for line in UPGRADING.splitlines()
    if line.startswith("| `gradhesion.")
]
ARCHITECTURE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROWS = ARCHITECTURE.partition("each uses only those above it:\n")[2].partition("\n\n## ")[0].splitlines()
ROOMS = [re.findall(r"`(cli/[\w/]+)`", line.split("|")[1]) for line in ROWS if "`" in line]
LEVELS = {room: level for level, row in enumerate(ROOMS) for room in row}


def test_the_citation_and_the_changelog_are_those_of_the_project() -> None:
    assert (CITATION["cff-version"], CITATION["type"]) == ("1.2.0", "software")
    assert {"message", "title", "authors"} <= CITATION.keys()
    for key in ("version", "license", "keywords"):
        assert CITATION[key] == PROJECT[key]
    (paper,) = CITATION["references"]
    names = [author["family-names"] for author in paper["authors"]]
    assert f"{', '.join(names[:-1])} & {names[-1]} ({paper['year']}), {paper['title']}" in REFERENCES
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first, *_ = re.findall(r"^## (\S+) \((\d{4}-\d\d-\d\d)\)$", text, re.MULTILINE)
    assert first == (PROJECT["version"], str(CITATION["date-released"]))


@pytest.mark.parametrize(("old", "new"), MOVED)
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


def test_the_studies_that_the_page_on_installation_names_are_shipped() -> None:
    for name in re.findall(r"\b(extra_[a-z_]+|fig1|fig9)\b", UPGRADING):
        assert (ROOT / "configs" / f"{name}.toml").is_file(), name


def _used(file: Path) -> set[str]:
    """List the rooms whose modules a file imports, at any depth; the modules beside main.py are nobody's room."""
    nodes = [node for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))) if isinstance(node, ast.ImportFrom)]
    names = {f"{node.module}.{alias.name}" for node in nodes for alias in node.names if node.module}
    paths = ["/".join(n.split(".")[1:]) for n in names if n.startswith("gradhesion.cli.")]
    return {max((room for room in LEVELS if path.startswith(f"{room}/")), key=len, default="") for path in paths}


def test_each_room_of_the_commands_stands_on_its_page_and_uses_only_those_above_it() -> None:
    assert {*LEVELS} == {file.parent.relative_to(ROOT).as_posix() for file in (ROOT / "cli").rglob("*.py")} - {"cli"}
    below = {
        (file.relative_to(ROOT).as_posix(), used)
        for room, level in LEVELS.items()
        for file in (ROOT / room).glob("*.py")
        for used in _used(file) - {""}
        if LEVELS[used] > level
    }
    assert below == set()
