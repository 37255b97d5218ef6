"""The documentation of the equations: complete for `help`."""

import importlib
import inspect
import pkgutil
import re

import gradhesion.core.equations

FUNCTIONS = [
    function
    for _, name, _ in pkgutil.iter_modules(gradhesion.core.equations.__path__)
    if not name.startswith("_")
    for function in vars(importlib.import_module(f"gradhesion.core.equations.{name}")).values()
    if inspect.isfunction(function) and function.__module__.endswith(name) and not function.__name__.startswith("_")
]


def test_help_describes_every_argument_and_what_is_returned() -> None:
    assert len(FUNCTIONS) > 60
    for function in FUNCTIONS:
        text = inspect.getdoc(function) or ""
        _, _, after = text.partition("Parameters\n----------\n")
        described = re.split(r"\n(?=[A-Z][a-z]+\n-{3,}\n)", after)[0]
        names = [name for line in re.findall(r"^\S.*$", described, re.MULTILINE) for name in line.split(", ")]
        assert names == list(inspect.signature(function).parameters), function.__qualname__
        assert re.search(r"^    \S", described, re.MULTILINE), function.__qualname__
        assert "Returns\n-------\n" in text or function.__name__ == "harmonics", function.__qualname__  # a list
