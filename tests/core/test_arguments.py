"""What travels together is one argument: no function of core/ has more than eight."""

import ast
from pathlib import Path

import pytest

from gradhesion.core.compiler import jit

CORE = Path(jit.__file__).parents[1]
MOST = 8
FORMULAS = {"pressure"}
"""Printed formulas of `gr.equations`, whose arguments users name: each letter of (4.2) and (4.9) is one."""


@pytest.mark.parametrize("path", sorted(CORE.rglob("*.py")), ids=lambda path: path.relative_to(CORE).as_posix())
def test_no_function_has_more_than_eight_arguments(path: Path) -> None:
    """Those that a caller must name count only where kernels call: kernels know no others."""
    wide = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            given = node.args
            assert not given.kwonlyargs or not any("kernel(" in ast.unparse(each) for each in node.decorator_list)
            own = [each.arg for each in (*given.posonlyargs, *given.args) if each.arg != "self"]
            if len(own) > MOST and node.name not in FORMULAS:
                wide.append(f"{node.name}: {len(own)}")
    assert not wide
