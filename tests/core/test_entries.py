"""Kernels with private names are compiled without what Python calls them by: nobody may."""

import ast
import importlib
import inspect
import pkgutil
from pathlib import Path
from types import ModuleType
from typing import Any

import gradhesion.core
from gradhesion.core.compiler import jit

ROOT = Path(__file__).parents[2]
CORE = Path(jit.__file__).parents[1]
MODULES = sorted(
    module.name for module in pkgutil.walk_packages([str(CORE)], f"{gradhesion.core.__name__}.") if not module.ispkg
)


def is_kernel(thing: Any) -> bool:
    return hasattr(thing, "targetoptions")


def is_inner(thing: Any) -> bool:
    return is_kernel(thing) and bool(thing.targetoptions["no_cpython_wrapper"])


def resolved(node: ast.AST, space: dict[str, Any]) -> Any:
    """What a name stands for, in a name space or in a module of it."""
    if isinstance(node, ast.Name):
        return space.get(node.id)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        module = space.get(node.value.id)
        return getattr(module, node.attr, None) if isinstance(module, ModuleType) else None
    return None


def inner_kernels_named(tree: ast.AST, space: dict[str, Any]) -> set[str]:
    """Names of inner kernels that code uses, and those used by the Python functions of kernels that it uses."""
    found = set()
    for node in ast.walk(tree):
        if is_inner(resolved(node, space)):
            found.add(ast.unparse(node))
        if isinstance(node, ast.Attribute) and node.attr == "py_func" and is_kernel(resolved(node.value, space)):
            function = resolved(node.value, space).py_func
            body = ast.parse(inspect.getsource(function)).body[0]
            assert isinstance(body, ast.FunctionDef)
            found |= inner_kernels_named(ast.Module(body.body, []), function.__globals__)
    return found


def outside_of_kernels(tree: ast.Module) -> ast.Module:
    """The statements of a module without its kernels (those inside of functions too)."""

    class Drop(ast.NodeTransformer):
        def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST | None:
            names = [ast.unparse(decorator) for decorator in node.decorator_list]
            if any(name.startswith("kernel(") for name in names):
                return None
            return self.generic_visit(node)

    return Drop().visit(tree)


def test_python_calls_no_inner_kernel() -> None:
    found = {}
    for name in MODULES:
        module = importlib.import_module(name)
        tree = outside_of_kernels(ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8")))
        found[name] = inner_kernels_named(tree, vars(module))
    assert {name: kernels for name, kernels in found.items() if kernels} == {}


def test_inner_kernels_are_found() -> None:
    from gradhesion.core.scene import cosine as scene

    code = "def draw():\n    return scene._solve_smooth(0) + _solve_force(1)\n"
    found = inner_kernels_named(outside_of_kernels(ast.parse(code)), vars(scene) | {"scene": scene})
    assert found == {"scene._solve_smooth", "_solve_force"}
    assert "_solve_force" in inner_kernels_named(ast.parse("solve = scene.solve_curve.py_func"), {"scene": scene})


def test_nobody_else_calls_one() -> None:
    called = {}
    for folder in ("tests", "benchmarks", "docs", "figures", "twin"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            text = path.read_text(encoding="utf-8")
            if "gradhesion.core" in text and path != Path(__file__):
                called[path.relative_to(ROOT).as_posix()] = called_in(ast.parse(text))
    assert called
    assert {path: kernels for path, kernels in called.items() if kernels} == {}


def called_in(tree: ast.Module) -> set[str]:
    """Names of inner kernels of core/ that another module uses; its own kernels have no private names."""
    space: dict[str, Any] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("gradhesion.core"):
            home = importlib.import_module(str(node.module))
            for alias in node.names:
                submodule = f"{node.module}.{alias.name}"
                thing = importlib.import_module(submodule) if submodule in MODULES else getattr(home, alias.name)
                space[alias.asname or alias.name] = thing
    own = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name.startswith("_")]
    private = {node.name for node in own if any("kernel(" in ast.unparse(each) for each in node.decorator_list)}
    return private | inner_kernels_named(tree, space)


def test_a_kernel_that_python_does_not_call_has_no_wrapper() -> None:
    from gradhesion.core.curve import general_folds
    from gradhesion.core.scene import cosine as scene

    assert is_inner(scene._solve_force)
    assert not is_inner(scene.solve_curve)
    assert not is_inner(general_folds._extremum)  # entry=True
