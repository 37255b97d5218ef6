"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import re
from collections.abc import Mapping
from functools import cache
from typing import Any, Final, get_args

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.keys import Table
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.study.text.toml import Key, dotted
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS

Mistake = tuple[Key, str]
"""A key, and what is wrong with it and what to do about it."""
_OF_INPUTS: Final = (("parameters",), ("physical",))


def mistakes_of(error: ValidationError, data: Mapping[str, Any]) -> tuple[dict[Key, str], set[Key]]:
    """Say what pydantic found in a study, by its keys, and which keys were meant by unknown ones."""
    found: dict[Key, str] = {}
    meant: set[Key] = set()
    for detail in error.errors(include_url=False):
        path: Key = ()
        value: Any = data
        *_, last = detail["loc"]
        for step in detail["loc"]:  # some are forms (plain, list, table), which are not in the study
            if isinstance(value, list) if isinstance(step, int) else isinstance(value, Mapping) and step in value:
                path, value = (*path, step), value[step]
        path = (*path, last) if detail["type"] == "missing" else path
        if path in found:
            continue
        if detail["type"] == "extra_forbidden":
            other, found[path] = _unknown_key(path)
            meant.add(other)
        else:
            found[path] = _sentence(detail, path)
    return found, meant


@cache
def tables_of(kind: Any, above: Key = ()) -> dict[Key, type[Table]]:
    """Find the tables in a type by their keys, that of a table itself under the empty one."""
    if not (isinstance(kind, type) and issubclass(kind, Table)):
        return {path: own for one in get_args(kind) for path, own in tables_of(one, above).items()}
    keys: Mapping[str, Any] = kind.model_fields
    inner = [tables_of(field.annotation, (*above, name)) for name, field in keys.items()]
    return {above: kind} | {path: own for tables in inner for path, own in tables.items()}


def line_of(*path: str | int) -> str:
    """Write a line that would do.

    >>> line_of("parameters", "k", 3), line_of("physical", "R", "stop")
    ('k = 0.5 or k = [0.0, 0.5]', 'stop = "1 mm"')
    """
    *table, name = (step for step in path if isinstance(step, str))
    own = tables_of(Form).get(tuple(table), Table).model_fields.get(name)
    return f"{name} = {(own.examples or ['..'])[0] if own else '..'}"


def required(*path: str | int) -> str:
    """Say that a key is missing, and show a line that would do."""
    return f"this key is required; write for example {line_of(*path)}"


def _sentence(detail: ErrorDetails, path: Key) -> str:
    """Say what pydantic found in the words of a study."""
    kind, value = detail["type"], detail["input"]
    in_a_table_of_inputs = len(path) > 1 and path[0] in ("parameters", "physical", "loading")
    own = INPUTS.get(str(path[1])) if in_a_table_of_inputs and path[-1] not in ("num", "spacing") else None
    if kind == "value_error":  # in a sentence already
        return str(detail["ctx"]["error"])
    if kind == "missing":
        return required(*path)
    if kind == "literal_error":
        known = re.findall("'([^']+)'", detail["ctx"]["expected"])
        remedy = did_you_mean(str(value), known) if known else f"write {detail['ctx']['expected']}"
        return f"this must be one of its values; {remedy}"
    text = value if kind == "float_type" and isinstance(value, str) and (own or "," in value) else ""
    if words := ratio_sentence(text, own.name if own else "A"):
        return words if own else f"this must be a number; {words}"
    if own and own.infinite and kind == "finite_number":
        return "a range must end at finite values; write a list where inf is one of the values"
    if own and kind in ("greater_than", "greater_than_equal", "less_than_equal", "finite_number"):
        unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if own.name == "load_max" else ""
        return f"out of range; choose a value with {own.allowed}{unpressed}"
    words = re.sub(r"^(Input|String|List) should (.*?)( or instance of.*| after .*)?$", r"this must \2", detail["msg"])
    limits = f", with {own.allowed}" if own else ""
    return f"{words.replace('dictionary', 'table')}{limits}; write for example {line_of(*path)}"


def _unknown_key(path: Key) -> tuple[Key, str]:
    """Report which key was meant, and say so."""
    table, key = path[:-1], str(path[-1])
    keys_of = {place: [*one.model_fields] for place, one in tables_of(Form).items()}
    known = keys_of.get(tuple(step for step in table if isinstance(step, str)), [])
    others = {place for place in keys_of if len(place) < 2} - {table, ("uncertainty",)}  # that has all inputs again
    homes = {place: keys for place, keys in keys_of.items() if place in others}
    near = nearest(key, known)
    called = [name for name, one in INPUTS.items() if key.lower() in one.called]
    found = [(other, key) for other, keys in homes.items() if key in keys]
    if not found and called and near not in called and (near or "").lower() != key.lower() and table in _OF_INPUTS:
        found = [((INPUTS[called[0]].table,), called[0])]
    if not (found or table or near):
        found = [(other, one) for other, keys in homes.items() if (one := nearest(key, keys))]
    if not found or found[0] == (table, near):
        return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"
    place, near = found[0]
    where = f"under [{dotted(place)}]" if place else "at the top, before the first [table]"
    path = (*place, near)
    if near == key:
        return path, f"this key belongs {where}; move it there, as {dotted(path)}"
    return path, f'unknown key; did you mean "{near}", {where}?'
