"""The manual is whole, and what the citation, the changelog and pages on installation, architecture and the paper say is so."""

import ast
import inspect
import pkgutil
import re
import subprocess
import sys
import tomllib
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import click
import pytest
import yaml

import gradhesion as gr
import gradhesion.core.equations
from docs.generated import PAGES
from gradhesion.cli import main
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.names.fits import FIT, FIT_POINTS
from gradhesion.cli.names.outputs import OUTPUTS
from gradhesion.cli.names.scenes import REFERENCES
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.mistakes import tables_of
from gradhesion.core import FLAGS
from gradhesion.core.problem.inputs import INPUTS
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


def test_every_command_and_option_stands_in_the_manual() -> None:
    page = PAGES["commands"]()
    for name, command in main.cli.commands.items():
        section = page.partition(f"\n## gradhesion {name}\n")[2].partition("\n## ")[0]
        options = [option for option in command.params if isinstance(option, click.Option) and not option.hidden]
        assert section
        assert all(re.search(rf"`[^`]*{option.opts[-1]}\b[^`]*` \| \w", section) for option in options), name


def test_every_key_output_flag_and_name_stands_in_the_manual() -> None:
    study, dataset, python = (PAGES[name]() for name in ("study", "dataset", "python"))
    assert all(f"### gr.{name}\n" in python or f"`gr.{name}`" in python for name in gr.__all__)
    tables = ("parameters", "physical", "profile", "loading", "toughness", "rate", "states", "optimum", "uncertainty", "method")  # fmt: skip
    of_a_fit = ("data", "fit")
    keys = {key for table in tables_of(Form).values() for key in table.model_fields} - {*tables, *of_a_fit}
    assert keys >= {*INPUTS}
    assert all(f"\n| `{key}` |" in study for key in keys)
    assert all(f"\n## [{name}]\n" in study for name in tables)
    assert all(f"\n### [{name}]\n" in study for name in of_a_fit)
    assert all(f"| `{name}` |" in dataset for name in (*FIT, *(name for own in FIT_POINTS.values() for name in own)))
    assert all(f"| `{name}` |" in dataset for name in (*INPUTS, *OUTPUTS, *FLAGS, *CURVES))
    assert all(f"| `{name}` |" in dataset for own in CURVES.values() for name in own)


@pytest.mark.slow
def test_the_manual_builds_without_a_warning_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    sphinx = [sys.executable, "-m", "sphinx", "-E", "-q", "-W", "--keep-going", "-d", tmp_path / "trees"]
    done = subprocess.run([*sphinx, ROOT / "docs", tmp_path / "html"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    pages = sorted((tmp_path / "html").rglob("*.html"))
    assert {page.stem for page in pages} >= {page.stem for page in (ROOT / "docs").glob("*.md")} | {*PAGES}
    loaded = re.compile(r"<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)=\"(https?:)?//", re.IGNORECASE)
    assert not [page.name for page in pages if loaded.search(page.read_text(encoding="utf-8"))]
    assert "<math" in (tmp_path / "html" / "theory.html").read_text(encoding="utf-8")
    static = tmp_path / "html" / "_static"
    assert (static / "STIXTwoMath-Regular.ttf").stat().st_size > 100_000, "a font for formulae comes along"
    assert "STIXTwoMath-Regular.ttf" in (static / "manual.css").read_text(encoding="utf-8")
    assert "copybutton.js" in (tmp_path / "html" / "scenes.html").read_text(encoding="utf-8")


def test_every_link_of_a_file_that_is_read_in_the_repository_is_there() -> None:
    """A link to a generated page holds where the manual is built; from elsewhere only files of the repository are named."""
    generated = {ROOT / "docs" / "reference" / f"{name}.md" for name in PAGES}
    pages = [*(ROOT / "docs").glob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    for page in pages:
        allowed = generated if page.parent.name == "docs" else set()
        for link in re.findall(r"\]\((?!https?:|#)([^)#\s]+)", page.read_text(encoding="utf-8")):
            path = (page.parent / link).resolve()
            assert path in allowed or (path not in generated and path.exists()), f"{page.name}: {link}"


def test_every_page_that_the_sources_name_is_there() -> None:
    tops = ("api", "benchmarks", "cli", "configs", "core", "docs", "figures", "tests", "twin")
    files = [file for top in tops for ending in ("py", "toml") for file in (ROOT / top).rglob(f"*.{ending}")]
    for file in (*files, ROOT / "Makefile", ROOT / "pyproject.toml", ROOT / "CHANGELOG.md"):
        for page in re.findall(r"\bdocs/[\w/]+\.md\b", file.read_text(encoding="utf-8")):
            assert (ROOT / page).is_file(), f"{file.relative_to(ROOT)}: {page}"
