"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Final, get_args

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.keys import Table
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.study.text.written import Path, dotted
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS, Input

_STEPS: Final = ("step", "by", "increment", "delta")
"""What a range does not have."""


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
        unknown = detail["type"] == "extra_forbidden"
        meant, sentence = _unknown_key(path, absent) if unknown else ((), _sentence(detail, path))
        value = None if detail["type"] == "missing" else detail["input"]
        found.setdefault(path, Mistake(path, value, sentence, meant))
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


def _sentence(detail: ErrorDetails, path: Path) -> str:
    """Say what pydantic found in the words of a study."""
    kind, value = detail["type"], detail["input"]
    in_a_table_of_inputs = len(path) > 1 and path[0] in ("parameters", "physical", "loading")
    own = INPUTS.get(str(path[1])) if in_a_table_of_inputs and path[-1] not in ("num", "spacing") else None
    if kind == "value_error":  # in a sentence already
        return str(detail["ctx"]["error"])
    if kind == "missing":
        return required(*path)
    if kind == "literal_error" and (known := re.findall(r"'([^']+)'", str(detail["ctx"]["expected"]))):
        return f"this must be one of its words; {did_you_mean(str(value), known)}"
    if (
        kind == "float_type"
        and isinstance(value, str)
        and (sentence := ratio_sentence(value, own.name if own else "A"))
    ):
        return sentence if own else f"this must be a number; {sentence}"
    if own and kind in ("greater_than", "greater_than_equal", "less_than_equal", "finite_number"):
        return _out_of_range(own, path, kind)
    words = re.sub(r"^(Input|String|List) should (.*?)( or instance of.*| after .*)?$", r"this must \2", detail["msg"])
    limits = f", with {own.allowed}" if own else ""
    return f"{words.replace('dictionary', 'table')}{limits}; write for example {line_of(*path)}"


def _out_of_range(own: Input, path: Path, kind: str) -> str:
    """Say which values an input may have."""
    if kind == "finite_number" and path[-1] in ("start", "stop") and own.infinite:
        return "a range must end at finite values; write a list where inf is one of the values"
    unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if own.name == "load_max" else ""
    return f"out of range; choose a value with {own.allowed}{unpressed}"


def _unknown_key(path: Path, absent: Collection[str]) -> tuple[Path, str]:
    """Report which key was meant, and say so."""
    table, key = path[:-1], str(path[-1])
    keys_of = {name: [*one.model_fields] for name, one in tables_of(Form).items()}
    known = keys_of.get(tuple(step for step in table if isinstance(step, str)), [])
    if table == ("uncertainty",):
        return path, f"not an input of a study; {did_you_mean(key, known)}"
    homes = {name: keys for name, keys in keys_of.items() if len(name) < 2 and not {*name} & {*absent}}
    homes[()] = [name for name in homes[()] if name not in absent]
    homes |= {name: ["samples", "seed"] for name in homes if name == ("uncertainty",)}  # the others are those of inputs
    for other, keys in homes.items():
        if other != table and key in keys:
            where = f"under [{dotted(other)}]" if other else "at the top, before the first [table]"
            return (*other, key), f"this key belongs {where}, as {dotted((*other, key))}; move it there"
    if "num" in known and key in _STEPS:
        sentence = "a range has no step; give the number of its values instead, for example num = 11"
        return (*table, "num"), f'{sentence}, evenly spaced unless spacing = "log"'
    near, place = nearest(key, known), table
    called = [name for name, one in INPUTS.items() if key.lower() in one.called]
    elsewhere = called and near not in called and (near or "").lower() != key.lower()
    if elsewhere and table in (("parameters",), ("physical",)):
        near, place = called[0], (INPUTS[called[0]].table,)
    elif not table and not near:
        found = ((other, nearest(key, keys)) for other, keys in homes.items())
        place, near = next(((other, one) for other, one in found if one), (table, None))
    if place != table:
        return (*place, str(near)), f'unknown key; did you mean "{near}", under [{dotted(place)}]?'
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"
