"""docs/paper.md keeps what it says: every equation has a row, every function and every test that it names exists."""

import ast
import importlib
import inspect
import pkgutil
import re
from functools import cache
from pathlib import Path

import pytest

import gradhesion.core.equations

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "paper.md").read_text()
MODULES = {
    name: importlib.import_module(f"gradhesion.core.equations.{name}")
    for _, name, _ in pkgutil.iter_modules(gradhesion.core.equations.__path__)
    if not name.startswith("_")
}
FUNCTIONS = sorted(
    f"{name}.{function}"
    for name, module in MODULES.items()
    for function, value in inspect.getmembers(module, inspect.isfunction)
    if value.__module__ == module.__name__ and not function.startswith("_")
)
SECTIONS = dict(zip(*[iter(re.split(r"^## (.*)$", TEXT, flags=re.MULTILINE)[1:])] * 2, strict=True))
ROWS = [line.split("|")[1:-1] for line in SECTIONS["Equations"].splitlines() if line.startswith("| (")]


@cache
def _tests_of(path: Path) -> set[str]:
    """Return the names of all tests and classes of tests in a file."""
    found = {node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    return {node.name for node in found}


def test_every_function_has_its_place_and_every_one_that_is_named_exists() -> None:
    named = set(re.findall(r"`([a-z_]+\.[a-z_]+)`", TEXT)) - {"theory.md"}
    assert named == set(FUNCTIONS)
    for name in re.findall(r"`core\.([\w.]+)\.(\w+)`", TEXT):
        assert hasattr(importlib.import_module(f"gradhesion.core.{name[0]}"), name[1])


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
