"""The rooms of cli/ are those of the page on the architecture, and each uses only those above it there."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
_, _, TABLE = PAGE.partition("each uses only those above it:\n")
ROWS = [
    re.findall(r"`(cli/[\w/]+)`", line.split("|")[1])
    for line in TABLE.partition("\n\n## ")[0].splitlines()
    if "`" in line
]
LEVELS = {room: level for level, row in enumerate(ROWS) for room in row}


def _used(file: Path) -> set[str]:
    """List the rooms whose modules a file imports, at any depth; the modules beside main.py are nobody's room."""
    nodes = [node for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))) if isinstance(node, ast.ImportFrom)]
    names = {f"{node.module}.{alias.name}" for node in nodes for alias in node.names if node.module}
    paths = [name.removeprefix("gradhesion.").split(".") for name in names if name.startswith("gradhesion.cli.")]
    return {
        max((room for room in LEVELS if "/".join(path).startswith(f"{room}/")), key=len, default="") for path in paths
    }


def test_the_page_names_every_room() -> None:
    folders = {file.parent.relative_to(ROOT).as_posix() for file in (ROOT / "cli").rglob("*.py")}
    assert {*LEVELS} == folders - {"cli"}


def test_each_room_uses_only_those_above_it() -> None:
    below = {
        (file.relative_to(ROOT).as_posix(), used)
        for room, level in LEVELS.items()
        for file in (ROOT / room).glob("*.py")
        for used in _used(file) - {""}
        if LEVELS[used] > level
    }
    assert below == set()
