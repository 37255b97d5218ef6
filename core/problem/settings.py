"""Settings of a problem: the fields of a class, each with its words, an example and what it may be."""

import operator
from collections.abc import Sequence
from dataclasses import MISSING, field, fields
from typing import Any


def setting(about: str, example: str, *, default: Any = MISSING, choices: Sequence[str] = (), **bounds: float) -> Any:
    """Declare a field.

    Parameters
    ----------
    about
        What it is, for schema and manual.
    example
        A value that would do, as TOML has it.
    default
        What it is where it is left out.
    choices
        The words that it may be.
    **bounds
        Of a number, by the names of the comparisons of `operator`: gt, ge, le.
    """
    return field(
        default=default, metadata={"about": about, "example": example, "choices": tuple(choices), "bounds": bounds}
    )


def check_settings(made: Any) -> None:
    """Raise ValueError for the first setting that is none of its choices, or out of its bounds."""
    for one in fields(made):
        value, choices = getattr(made, one.name), one.metadata["choices"]
        if choices and value not in choices:
            raise ValueError(f"{one.name} = {value!r}: it is one of {', '.join(choices)}")
        for sign, limit in one.metadata["bounds"].items():
            if not getattr(operator, sign)(value, limit):
                words = {"gt": "above", "ge": "at least", "le": "at most"}[sign]
                raise ValueError(f"{one.name} = {value!r}: it is {words} {limit:,}")
