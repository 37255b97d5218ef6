"""The documentation of the equations: complete for `help`, and read back as it was written."""

import importlib
import inspect
import pkgutil
import re
from typing import Annotated

import gradhesion.core.equations
from gradhesion.core.equations._arguments import Gradient, Radius, documented
from gradhesion.core.equations._domain import Array

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
        if function.__name__ in ("harmonics", "pressure_unit"):  # a list of triples, and two numbers with SI units
            continue
        _, _, after = text.partition("Parameters\n----------\n")
        described = re.split(r"\n(?=[A-Z][a-z]+\n-{3,}\n)", after)[0]
        names = [name for line in re.findall(r"^\S.*$", described, re.MULTILINE) for name in line.split(", ")]
        assert names == list(inspect.signature(function).parameters), function.__qualname__
        assert re.search(r"^    \S", described, re.MULTILINE), function.__qualname__
        assert "Returns\n-------\n" in text, function.__qualname__


def test_sections_stand_in_their_order_and_what_a_docstring_says_itself_is_kept() -> None:
    @documented
    def two(k: Gradient, radius: Radius, other: Annotated[float, "Another number."] = 1.0) -> Array:
        """Return nothing.

        More about it.

        Raises
        ------
        ValueError
            Never.
        """
        raise NotImplementedError(k, radius, other)

    text = two.__doc__ or ""
    assert re.findall(r"^(\w+)\n-{3,}$", text, re.MULTILINE) == ["Parameters", "Returns", "Raises"]
    assert text.startswith("Return nothing.\n\nMore about it.\n\nParameters\n")
    assert (
        "k\n    Gradient exponent, 0 to 1.\nradius\n    a/R >= 0, the contact radius.\nother\n    Another number.\n"
        in text
    )
    assert str(inspect.signature(two)) == "(k, radius, other=1.0)"

    @documented
    def one(k: Gradient) -> tuple[float, float]:
        """Return two.

        Returns
        -------
        A pair.
        """
        raise NotImplementedError(k)

    assert (one.__doc__ or "").count("Returns") == 1
