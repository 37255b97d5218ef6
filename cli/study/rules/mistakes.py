"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Final, get_args

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.study.rules.form import Form, Table
from gradhesion.cli.study.text.places import Path, dotted
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS, Input

_WANTED: Final = {
    "greater_than": "above {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than": "below {lt:g}",
    "less_than_equal": "{le:g} or less",
    "string_type": "a string in quotes",
    "string_too_short": "the name of a file or a column",
    "string_pattern_mismatch": "64 digits from 0 to f",
    "list_type": "a list in brackets",
    "bool_type": "true or false",
    "int_type": "an integer",
    "int_from_float": "an integer",
    "float_type": "a number",
    "finite_number": "finite",
    "dict_type": "a table",
    "model_type": "a table",
}
"""What must stand in the place of what pydantic found."""


@dataclass(frozen=True)
class Mistake:
    """What is wrong at a key, and what to do about it."""

    path: Path
    value: Any
    sentence: str
    meant: Path = ()
    """The key that was meant, where another stands in its place."""


def mistakes_of(error: ValidationError, data: Mapping[str, Any], absent: Collection[str]) -> list[Mistake]:
    """Turn what pydantic found in a study into mistakes, one a key; its kind has no keys that are `absent`."""
    found: dict[Path, Mistake] = {}
    for detail in error.errors(include_url=False):
        path = _path(detail, data)
        if detail["type"] == "extra_forbidden":
            key, sentence = _unknown_key(path, absent)
            found.setdefault(path, Mistake(path, detail["input"], sentence, key))
        else:
            value = None if detail["type"] == "missing" else detail["input"]
            found.setdefault(path, Mistake(path, value, _sentence(detail, path)))
    return [*found.values()]


def _path(detail: ErrorDetails, data: Mapping[str, Any]) -> Path:
    """Take the names of forms (plain, list, table) out of pydantic's path: what is left is in the study, or missing."""
    path: list[str | int] = []
    value: Any = data
    *_, last = steps = detail["loc"]
    for step in steps:
        if isinstance(value, list) if isinstance(step, int) else isinstance(value, Mapping) and step in value:
            path.append(step)
            value = value[step]
    return (*path, last) if detail["type"] == "missing" else tuple(path)


@cache
def tables_of(model: type[Table], above: Path = ()) -> dict[Path, type[Table]]:
    """Find the tables of a form by their keys, the whole of it under the empty one."""
    found = {above: model}
    for name, field in model.model_fields.items():
        for inner in _tables_in(field.annotation):
            found |= tables_of(inner, (*above, name))
    return found


def _tables_in(annotation: Any) -> list[type[Table]]:
    """Find the tables that a type names."""
    if isinstance(annotation, type) and issubclass(annotation, Table):
        return [annotation]
    return [table for one in get_args(annotation) for table in _tables_in(one)]


def line_of(path: Path) -> str:
    """
    Write a line that would do.

    >>> line_of(("parameters", "k", 3)), line_of(("physical", "R", "stop"))
    ('k = 0.5 or k = [0.0, 0.5]', 'stop = "1 mm"')
    """
    *table, name = (step for step in path if isinstance(step, str))
    own = tables_of(Form).get(tuple(table), Table).model_fields.get(name)
    return f"{name} = {(own.examples or ['..'])[0] if own else '..'}"


def required(*path: str) -> str:
    """Say that a key is missing, and show a line that would do."""
    return f"this key is required; write for example {line_of(path)}"


def _sentence(detail: ErrorDetails, path: Path) -> str:
    """Say what pydantic found in the words of a study."""
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    write = f"write for example {line_of(path)}"
    if kind == "value_error":  # in a sentence already
        return str(context["error"])
    if kind == "missing":
        return required(*map(str, path))
    if kind == "literal_error":
        known = str(context["expected"]).replace("'", '"')
        words = re.findall(r'"([^"]+)"', known)
        return f"this must be {known}; {did_you_mean(str(value), words) if words else write}"
    if kind == "too_short" and isinstance(value, list):
        return f"the list is empty; {write}"
    if kind == "too_long":
        return f"this has more than {context['max_length']} items; leave some out"
    own = INPUTS.get(str(path[1])) if len(path) > 1 and path[0] in ("parameters", "physical", "loading") else None
    if own and path[-1] not in ("num", "control"):
        return _input_sentence(kind, value, own, path)
    if isinstance(value, str) and kind == "float_type" and (sentence := ratio_sentence(value, "A")):
        write = sentence
    return f"this must be {_WANTED.get(kind, 'another value').format(**context)}; {write}"


def _input_sentence(kind: str, value: object, own: Input, path: Path) -> str:
    """Say what is wrong with an input, an item of its list or an end of its range."""
    if isinstance(value, str) and (sentence := ratio_sentence(value, own.name)):
        return sentence
    if kind == "float_type" and not (isinstance(value, int) and not isinstance(value, bool)):
        forms = "" if len(path) > 2 else ", a list of numbers or a range table"
        return f"this must be a number{forms}, with {own.allowed}; write for example {line_of(path)}"
    if path[-1] in ("start", "stop") and isinstance(value, float) and math.isinf(value):
        return "a range must end at finite values; write a list where inf is one of the values"
    unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if own.name == "load_max" else ""
    return f"out of range; choose a value with {own.allowed}{unpressed}"


def _unknown_key(path: Path, absent: Collection[str]) -> tuple[Path, str]:
    """Report which key was meant, and say so."""
    tables = tables_of(Form)
    table, key = path[:-1], str(path[-1])
    known = tuple(tables.get(tuple(one for one in table if isinstance(one, str)), Table).model_fields)
    if table == ("uncertainty",):
        return path, f"not an input of a study; {did_you_mean(key, known)}"
    own = ((name, [*one.model_fields]) for name, one in tables.items() if len(name) < 2)
    homes = {name: [one for one in keys if name or one not in absent] for name, keys in own if not {*name} & {*absent}}
    if ("uncertainty",) in homes:
        homes["uncertainty",] = ["samples", "seed"]
    for other, keys in homes.items():
        if other != table and key in keys:
            where = f"under [{dotted(other)}]" if other else "at the top, before the first [table]"
            return (*other, key), f"this key belongs {where}; move it there"
    if "num" in known and key in ("step", "by", "increment", "delta"):
        sentence = "a range has no step; give the number of its values instead, for example num = 11"
        return (*table, "num"), f'{sentence}, evenly spaced unless spacing = "log"'
    near, place = nearest(key, known), table
    if not near and not table:  # a key of some table at the top
        near = nearest(key, [name for keys in homes.values() for name in keys])
        place = next((other for other, keys in homes.items() if near in keys), ())
    elif table in (("parameters",), ("physical",)) and (meant := nearest(key, tuple(INPUTS))):
        called = key.lower() in INPUTS[meant].called and not (near in INPUTS and key.lower() in INPUTS[near].called)
        near, place = (meant, (INPUTS[meant].table,)) if called else (near, table)
    if place != table:
        return (*place, str(near)), f'unknown key; did you mean "{near}", under [{dotted(place)}]?'
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"
