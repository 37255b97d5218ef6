"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import json
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Final, get_args

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.study.rules.form import Form, Table
from gradhesion.cli.study.text.places import Path, dotted
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS

REQUIRED: Final[dict[Path, Any]] = {
    ("outputs",): ["pull_off_force"],
    ("parameters",): {},
    ("parameters", "k"): 0.5,
    ("parameters", "nu"): 0.3,
}
"""The keys that a form needs, with valid values: they stand for wrong ones, so that all else can be read."""
OF_A_FIT: Final = ("data", "fit")
"""The tables of studies of kind "fit" alone."""


_WANTED: Final = {
    "greater_than": "above {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than": "below {lt:g}",
    "less_than_equal": "{le:g} or less",
    "string_type": "a string in quotes",
    "string_too_short": "the name of a file",
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


@dataclass(frozen=True, kw_only=True)
class Checked:
    """A study whose keys have been looked at one by one."""

    form: Any
    """The study, but for what is wrong."""
    data: Mapping[str, Any]
    """The study as it is written."""
    mistakes: tuple[Mistake, ...] = ()
    wrong: frozenset[Path] = frozenset()
    """The keys that are wrong or missing: the key itself, where an item of its value is."""
    meant: frozenset[Path] = frozenset()
    """The keys that are not missing, but misspelt or in the wrong table."""

    def has(self, table: str, key: str) -> bool:
        """Report whether a key is there, right or wrong."""
        own = self.data.get(table)
        return isinstance(own, Mapping) and key in own

    def at(self, path: Path) -> Any:
        """Give what is written at a key; None if it is not there."""
        value: Any = self.data
        for step in path:
            if isinstance(value, Mapping):
                value = value.get(step)
            else:
                inside = isinstance(value, list) and isinstance(step, int) and step < len(value)
                value = value[step] if inside else None
        return value


def checked(data: Mapping[str, Any], model: Any = Form, required: Mapping[Path, Any] = REQUIRED) -> Checked:
    """
    Check the form of a study, each key for itself.

    Parameters
    ----------
    data
        The keys.
    model
        The form of studies of its kind.
    required
        The keys that the form needs, with valid values that stand for wrong ones.
    """
    try:
        return Checked(form=model.model_validate(data), data=data)
    except ValidationError as error:
        details = error.errors(include_url=False, include_context=True)
    mistakes: list[Mistake] = []
    missing: dict[Path, Mistake] = {}
    meant: set[Path] = set()
    for detail in details:
        path = _path(detail["loc"])
        if detail["type"] == "extra_forbidden":
            key, sentence = _unknown_key(path, model)
            meant.add(key)
            mistakes.append(Mistake(path, detail["input"], sentence, key))
        elif detail["type"] == "missing":
            missing[path] = Mistake(path, None, _sentence(detail, path, model))
        else:
            mistakes.append(Mistake(path, detail["input"], _sentence(detail, path, model)))
    mistakes += [mistake for path, mistake in missing.items() if path not in meant]
    wrong = {path[: _depth(path)] for path in (*missing, *(mistake.path for mistake in mistakes))}
    form = model.model_validate(_without(data, wrong, required))
    return Checked(form=form, data=data, mistakes=tuple(mistakes), wrong=frozenset(wrong), meant=frozenset(meant))


def _depth(path: Path) -> int:
    """Report how much of a path is the key whose value is wrong; tables of what an edge meets are so as a whole."""
    return 2 if path[0] not in ("toughness", "rate") and len(path) > 1 and isinstance(path[1], str) else 1


def _without(data: Mapping[str, Any], wrong: Iterable[Path], required: Mapping[Path, Any]) -> dict[str, Any]:
    """Leave out the keys that are wrong, but for those that a form needs."""
    sound = {key: {**value} if isinstance(value, Mapping) else value for key, value in data.items()}
    for path in wrong:
        table: Any = sound if len(path) == 1 else sound.get(str(path[0]), {})
        if isinstance(table, dict):
            table.pop(path[-1], None)
    for path, value in required.items():
        table = sound if len(path) == 1 else sound[str(path[0])]
        table.setdefault(str(path[-1]), {**value} if isinstance(value, dict) else value)
    return sound


def _path(steps: tuple[str | int, ...]) -> Path:
    """Take the name of the form (plain, list, table) out of pydantic's path of a value that has several."""
    if steps[0] == "optimum" and steps[1:2] in (("maximise",), ("minimise",)):
        return steps[:2]
    several = steps[0] in ("parameters", "physical", "loading", "method") and len(steps) > 2
    return (*steps[:2], *steps[3:]) if several else steps


@cache
def tables_of(model: type[Table], above: tuple[str, ...] = ()) -> dict[tuple[str, ...], type[Table]]:
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


def example(path: Path, model: type[Table] = Form) -> str:
    """Show a line that would do."""
    return f"write for example {line_of(path, model)}"


def line_of(path: Path, model: type[Table] = Form) -> str:
    """
    Write a line that would do.

    >>> line_of(("parameters", "k", 3)), line_of(("physical", "R", "stop"))
    ('k = 0.5 or k = [0.0, 0.5]', 'stop = "1 mm"')
    """
    *table, name = (step for step in path if isinstance(step, str))
    own = tables_of(model).get(tuple(table), Table).model_fields.get(name)
    return f"{name} = {(own.examples or ['..'])[0] if own else '..'}"


def _sentence(detail: ErrorDetails, path: Path, model: type[Table]) -> str:
    """Say what pydantic found in the words of a study."""
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    write = example(path, model)
    if kind == "value_error":  # in a sentence already
        return str(context["error"])
    if kind == "literal_error":
        words = re.findall(r"'([^']+)'", str(context["expected"]))
        known = "true or false" if not words else " or ".join(map(json.dumps, words))
        return f"this must be {known}; {did_you_mean(str(value), words)}"
    if kind == "missing":
        return f"this key is required; {write}"
    if kind == "too_short" and isinstance(value, list):
        return f"the list is empty; {write}"
    if kind == "too_long":
        return f"this has more than {context['max_length']} items; leave some out"
    own = INPUTS.get(str(path[1])) if len(path) > 1 and path[0] in ("parameters", "physical", "loading") else None
    if own and path[-1] != "num":
        return _input_sentence(kind, value, path, write)
    return f"this must be {_WANTED.get(kind, 'another value').format(**context)}; {write}"


def _input_sentence(kind: str, value: object, path: Path, write: str) -> str:
    """Say what is wrong with an input, an item of its list or an end of its range."""
    name, last = str(path[1]), path[-1]
    allowed = INPUTS[name].allowed
    if isinstance(value, str) and (sentence := ratio_sentence(value, name)):
        return sentence
    if kind == "float_type" and not (isinstance(value, int) and not isinstance(value, bool)):
        forms = "" if len(path) > 2 else ", a list of numbers or a range table"
        return f"this must be a number{forms}, with {allowed}; {write}"
    if last in ("start", "stop") and isinstance(value, float) and math.isinf(value):
        return "a range must end at finite values; write a list where inf is one of the values"
    unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if name == "load_max" else ""
    return f"out of range; choose a value with {allowed}{unpressed}"


def _unknown_key(path: Path, model: type[Table]) -> tuple[Path, str]:
    """Report which key was meant, and say so."""
    tables = tables_of(model)
    table, key = path[:-1], str(path[-1])
    known = tuple(tables.get(tuple(one for one in table if isinstance(one, str)), Table).model_fields)
    if table == ("uncertainty",):
        return path, f"not an input of a study; {did_you_mean(key, known)}"
    homes = {name: [*own.model_fields] for name, own in tables.items() if len(name) < 2}
    homes[("uncertainty",)] = ["samples", "seed"]
    for other, keys in homes.items():
        if other != table and key in keys:
            home = f"under [{dotted(other)}]" if other else "at the top, before the first [table]"
            return (*other, key), f"this key belongs {home}; move it there"
    if "num" in known and key in ("step", "by", "increment", "delta"):
        sentence = "a range has no step; give the number of its values instead, for example num = 11"
        return (*table, "num"), f'{sentence}, evenly spaced unless spacing = "log"'
    if not table and key in OF_A_FIT:
        return path, 'this table belongs to a fit; write kind = "fit" at the top, or remove it'
    near = nearest(key, known)
    elsewhere = None if table or near else nearest(key, [name for keys in homes.values() for name in keys])
    meant = nearest(key, tuple(INPUTS)) if table in (("parameters",), ("physical",)) else None
    if elsewhere:
        place: Path = next(other for other, keys in homes.items() if elsewhere in keys)
    elif meant and key.lower() in INPUTS[meant].called and near != meant and INPUTS[meant].table != table[0]:
        called = INPUTS[near].called if near in INPUTS else ()
        elsewhere, place = (None if key.lower() in called else meant), (INPUTS[meant].table,)
    if elsewhere:
        return (*place, elsewhere), f'unknown key; did you mean "{elsewhere}", under [{dotted(place)}]?'
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"
