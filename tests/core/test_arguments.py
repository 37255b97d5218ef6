"""What travels together is one argument: no function of core/ has more than eight."""

import ast
from pathlib import Path

from gradhesion.core.compiler import jit

CORE = Path(jit.__file__).parents[1]
MOST = 8
FORMULAS = {"pressure"}
"""Printed formulas of `gr.equations`, whose arguments users name: each letter of (4.2) and (4.9) is one."""


def test_no_function_has_more_than_eight_arguments() -> None:
    """Those that a caller must name count only where kernels call: kernels know no others."""
    paths = sorted(CORE.rglob("*.py"))
    assert paths
    wide = []
    for path in paths:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef):
                given, where = node.args, f"{path.relative_to(CORE).as_posix()}: {node.name}"
                is_kernel = any("kernel(" in ast.unparse(each) for each in node.decorator_list)
                assert not (given.kwonlyargs and is_kernel), where
                own = [each.arg for each in (*given.posonlyargs, *given.args) if each.arg != "self"]
                if len(own) > MOST and node.name not in FORMULAS:
                    wide.append(f"{where}: {len(own)}")
    assert wide == []
