"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.names import KEYS, MACHINE, PHYSICAL, ROLES, TIED, table_of
from gradhesion.cli.study.places import Path, dotted
from gradhesion.cli.study.schema import BOUNDS, MOST_WAVES, study_model
from gradhesion.cli.study.wording import did_you_mean, example, line_of, nearest
from gradhesion.core.profile import MOST_HARMONICS

_OF_PARAMETERS: Final = ("parameters", "physical", "loading")
"""The tables whose keys are parameters."""


@dataclass(frozen=True)
class Mistake:
    """What is wrong at a key, and what to do about it."""

    path: Path
    value: Any
    sentence: str


def mistakes_of_form(data: Mapping[str, Any]) -> list[Mistake]:
    """List what is wrong with the form of a study, each key for itself."""
    try:
        study_model().model_validate(data)
    except ValidationError as error:
        details = error.errors(include_url=False, include_context=True)
    else:
        details = []
    mistakes: list[tuple[str, Mistake]] = []
    excused: set[Path] = set()
    for detail in details:
        path = _path(detail)
        if detail["type"] == "extra_forbidden":
            meant, sentence = _unknown_key(path)
            excused.add(meant)  # it is not missing, but misspelt or misplaced
        else:
            sentence = _sentence(detail, path)
        mistakes.append((detail["type"], Mistake(path, detail["input"], sentence)))
    mistakes += _mistakes_of_roles(data.get("parameters"), data.get("physical"), excused)
    return [
        replace(mistake, value=None) if kind == "missing" else mistake
        for kind, mistake in mistakes
        if not (kind == "missing" and mistake.path in excused)
    ]


def _mistakes_of_roles(parameters: object, physical: object, excused: set[Path]) -> list[tuple[str, Mistake]]:
    """Check that exactly one key gives each parameter that more than one can give."""
    if not isinstance(parameters, Mapping):
        return []
    mistakes = []
    with_units = isinstance(physical, Mapping)
    tables = {"parameters": parameters, "physical": physical if isinstance(physical, Mapping) else {}}
    for role, words in ROLES.items():
        plain: Path = ("parameters", role)
        tied: list[Path] = [("parameters", key) for key, (parameter, _) in TIED.items() if parameter == role]
        united: list[Path] = [("physical", key) for key, (parameter, *_) in PHYSICAL.items() if parameter == role]
        if with_units and role != "A":
            if role in parameters:
                sentence = (
                    "a ratio, where [physical] gives quantities with units, and the two ways do not mix; remove it "
                    f"and give {', '.join(str(path[1]) for path in united)} under [physical], or remove [physical]"
                )
                mistakes.append(("both", Mistake(plain, parameters[role], sentence)))
            paths = [*united, *tied]
        else:
            paths = [plain, *tied, *(united if with_units else [])]
        if role == "modulus" and with_units:
            absent = [path for path in united if path[1] not in tables["physical"] and path not in excused]
            sentences = [(path, f"this quantity is required; {example(path)}") for path in absent]
            mistakes += [("missing", Mistake(path, None, sentence)) for path, sentence in sentences]
            continue
        given = [path for path in paths if path[1] in tables[str(path[0])]]
        for path in given[1:]:
            sentence = f"{given[0][1]} gives {words} already; keep one of the two and remove the other"
            mistakes.append(("both", Mistake(path, tables[str(path[0])][path[1]], sentence)))
        if not given and not excused & {*paths}:
            instead = " or ".join(
                line_of(path) + (f" under [{path[0]}]" if path[0] != paths[0][0] else "") for path in paths[1:]
            )
            what = "quantity" if paths[0][0] == "physical" else "parameter"
            sentence = f"this {what} is required; {example(paths[0])}" + (f", or instead {instead}" if instead else "")
            mistakes.append(("missing", Mistake(paths[0], None, sentence)))
    return mistakes


def _path(detail: ErrorDetails) -> Path:
    """Take the tag of the form (number, list, range, name) out of pydantic's path of a parameter or solver."""
    steps = detail["loc"]
    return (*steps[:2], *steps[3:]) if steps[0] in ("parameters", "physical", "loading", "method") else steps


def _unknown_key(path: Path) -> tuple[Path, str]:
    """Tell which key was meant, and say so."""
    tables: dict[Path, tuple[str, ...]] = {
        (): ("title", "kind", "layout", "outputs", "parameters", "physical", "profile", "loading", "method"),
        ("parameters",): tuple(key for key in KEYS if table_of(key) == "parameters"),
        ("physical",): tuple(PHYSICAL),
        ("profile",): ("exponent", "harmonics"),
        ("loading",): ("control", MACHINE),
        ("method",): ("solver", "check_contact"),
    }
    table, key = path[:-1], str(path[-1])
    inner = ("n", "cos", "sin") if table[:1] == ("profile",) else ("start", "stop", "num", "spacing")
    known = tables.get(table, inner)
    for other, keys in tables.items():
        if other != table and key in keys:
            home = f"under [{dotted(other)}]" if other else "at the top, before the first [table]"
            return (*other, key), f"this key belongs {home}; move it there"
    near = nearest(key, known)
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"


def _sentence(detail: ErrorDetails, path: Path) -> str:
    """Say what pydantic found in the words of a study."""
    kind = detail["type"]
    value = detail["input"]
    last = path[-1]
    if path[0] == "profile" and len(path) > 1:
        return _profile_sentence(kind, path)
    if (
        path[:2] != ("loading", "control")
        and path[0] in _OF_PARAMETERS
        and len(path) > 1
        and last not in ("num", "spacing")
    ):
        return _parameter_sentence(kind, value, path)
    if kind == "missing":
        return f"this key is required; {example(path)}"
    if kind == "too_short":
        return f"the list is empty; {example(path)}"
    if last == "solver":
        return f"this must be a string in quotes or a list of them; {example(path)}"
    if last == "check_contact":
        return f"this must be true or false; {example(path)}"
    if last == "num":
        return "num is the number of values, an integer of 1 or more; write for example num = 50"
    if last == "spacing":
        return 'spacing is "linear" or "log"; ' + did_you_mean(str(value), ("linear", "log"))
    wanted = {"string_type": "a string in quotes", "list_type": "a list in brackets"}.get(kind, "a table")
    return f"this must be {wanted}; {example(path)}"


def _parameter_sentence(kind: str, value: object, path: Path) -> str:
    """Say what is wrong with a parameter, an item of its list or an end of its range."""
    name, last = str(path[1]), path[-1]
    if kind == "missing":
        if len(path) > 2:
            return f"a range needs this key; {example(path)}"
        return f"this parameter is required; {example(path)}"
    if kind == "too_short":
        return "an axis needs at least one value; put values into the list, or write a single number to fix it"
    allowed = BOUNDS[name][1]
    if kind == "float_type" and not (isinstance(value, int) and not isinstance(value, bool)):
        forms = "" if len(path) > 2 else ", a list of numbers or a range table"
        return f"this must be a number{forms}, with {allowed}; {example(path[:2])}"
    if last in ("start", "stop") and isinstance(value, float) and math.isinf(value):
        return "a range must end at finite values; write a list where inf is one of the values"
    return f"out of range; choose a value with {allowed}"


def _profile_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the shape of the punch."""
    last = path[-1]
    if last == "exponent":
        return f"the power of the punch is a number of 1 or more, and finite (1 is a cone); {example(path)}"
    if last == "n":
        return f"n is the number of waves a wavelength, an integer from 1 to {MOST_WAVES:,}; {example(path)}"
    if last in ("cos", "sin"):
        return f"this must be a number, and finite; {example(path)}"
    if kind == "too_long":
        return f"a series has {MOST_HARMONICS} terms at most; leave the smallest out"
    return f"this must be a list of tables, one for each wave; {example(path)}"
