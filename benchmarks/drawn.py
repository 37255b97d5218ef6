"""Functions of core/ drawn at random, to be read by somebody who has not seen them.

Is each clear within a minute?

    python -m benchmarks.drawn                 the fifteen of the seed below
    python -m benchmarks.drawn --seed 7        fifteen others

A function is clear if every argument and result that is an array has its shape, unit and meaning in its docstring, in
that of its module or in its type, and if what it does is one sentence.
"""

import argparse
import ast
import random
from pathlib import Path
from typing import Final

from benchmarks.clock import ROOT

CORE: Final = ROOT / "core"
SEED: Final = 20261123
"""Set before the functions were looked at."""
NUMBER: Final = 15


def functions() -> list[tuple[Path, ast.FunctionDef]]:
    """List all functions and methods of the core, in the order of their files, without those inside others."""
    found: list[tuple[Path, ast.FunctionDef]] = []
    for path in sorted(CORE.rglob("*.py")):
        bodies = [ast.parse(path.read_text(encoding="utf-8")).body]
        while bodies:
            for node in bodies.pop():
                if isinstance(node, ast.ClassDef):
                    bodies.append(node.body)
                elif isinstance(node, ast.FunctionDef):
                    found.append((path, node))
    return found


def main() -> None:
    """Print where the functions stand, their first lines and their docstrings."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--number", type=int, default=NUMBER)
    arguments = parser.parse_args()
    every = functions()
    for path, node in random.Random(arguments.seed).sample(every, arguments.number):
        print(f"{path.relative_to(CORE)}:{node.lineno}: def {node.name}({ast.unparse(node.args)})")
        for line in (ast.get_docstring(node) or "no docstring").splitlines():
            print(f"    {line}".rstrip())


if __name__ == "__main__":
    main()
