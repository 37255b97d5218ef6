"""The citation, the changelog, the pages on installation and architecture agree with the project, and docs/paper.md keeps what it says."""

import ast
import inspect
import pkgutil
import re
import tomllib
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml

import gradhesion.core.equations
from gradhesion.cli.names.scenes import REFERENCES
from tests.conftest import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
UPGRADING = (ROOT / "docs" / "installation.md").read_text(encoding="utf-8")
MOVED = [
    [re.findall(r"`([^`]+)`", cell) for cell in line.strip("| ").split(" | ")]
    for line in UPGRADING.splitlines()
    if line.startswith("| `gradhesion.")
]
ARCHITECTURE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
LAYERS = ARCHITECTURE.partition("each uses only those above it:\n")[2].partition("\n\n## ")[0].splitlines()
ROOMS = [re.findall(r"`(cli/[\w/]+)`", line.split("|")[1]) for line in LAYERS if "`" in line]
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


TEXT = (ROOT / "docs" / "paper.md").read_text()
MODULES = [module.name for module in pkgutil.iter_modules(gradhesion.core.equations.__path__) if module.name[0] != "_"]
FUNCTIONS = {
    f"{name}.{function}"
    for name in MODULES
    for function, value in inspect.getmembers(import_module(f"gradhesion.core.equations.{name}"), inspect.isfunction)
    if value.__module__.endswith(f"equations.{name}") and not function.startswith("_")
}
SECTIONS = dict(zip(*[iter(re.split(r"^## (.*)$", TEXT, flags=re.MULTILINE)[1:])] * 2, strict=True))
ROWS = [line.split("|")[1:-1] for line in SECTIONS["Equations"].splitlines() if line.startswith("| (")]


@cache
def _tests_of(path: Path) -> set[str]:
    """Return the names of all tests and classes of tests in a file."""
    found = {node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    return {node.name for node in found}


def test_every_function_has_its_place_and_every_one_that_is_named_exists() -> None:
    named = set(re.findall(r"`([a-z_]+\.[a-z_]+)`", TEXT)) - {"theory.md"}
    assert named == FUNCTIONS
    for name in re.findall(r"`core\.([\w.]+)\.(\w+)`", TEXT):
        assert hasattr(import_module(f"gradhesion.core.{name[0]}"), name[1])


def test_every_test_that_is_named_exists() -> None:
    named = re.findall(r"`((?:tests/core/(?:\w+/)?)?test_\w+\.py)::(\w+)`", TEXT)
    assert len(named) > 40
    for file, test in named:
        path = ROOT / file if file.startswith("tests/") else ROOT / "tests" / "core" / "equations" / file
        assert test in _tests_of(path), (file, test)
    claims = _tests_of(ROOT / "tests" / "core" / "test_claims.py")
    columns = [line.split("|")[-2] for line in SECTIONS["Claims"].splitlines() if line.startswith("| ")][1:]
    in_claims = [name for column in columns[1:] for name in re.findall(r"`([\w:]+)`", column)]
    assert len(in_claims) >= len(columns) - 1
    assert {part for name in in_claims for part in name.split("::")} <= claims


PRINTED = [f"({section}.{n})" for section, last in ((2, 3), (3, 10), (4, 10), (5, 43)) for n in range(1, last + 1)]
PRINTED += [f"({appendix}{n})" for appendix, last in (("A", 5), ("B", 13)) for n in range(1, last + 1)]
CLASSES = ("damaged: ", "contradiction: ", "dropped: ")


def test_every_equation_has_one_row_with_its_meaning_function_and_test() -> None:
    assert [row[0].strip() for row in ROWS] == PRINTED
    for row in ROWS:
        equation, meaning, functions, tests, difference = (cell.strip() for cell in row)
        assert meaning, equation
        assert re.search(r"`[a-z_.]+`", functions), equation
        assert re.search(r"`[\w/]+\.py::test_\w+`", tests), equation
        assert difference == "" or difference.startswith(CLASSES), equation


def test_the_python_of_the_page_works() -> None:
    (code,) = re.findall(r"```python\n(.*?)```", TEXT, flags=re.DOTALL)
    found: dict[str, object] = {}
    exec(code, found)  # noqa: S102 (our own text)
    assert float(found["chi"]) == pytest.approx(0.21, abs=5e-4)  # type: ignore[arg-type]
