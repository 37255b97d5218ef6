"""The form of a study: which keys there are, and which values each of them takes.

pydantic checks the form of the whole study at once and gives its JSON Schema; what two keys have to do with each
other is in `gradhesion.cli.rules`. Here its findings become sentences that say what to write instead.
"""

import difflib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated, Any, Final, Literal, Union

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError, create_model
from pydantic_core import ErrorDetails

from gradhesion.cli.names import KEYS, MACHINE, OUTPUTS, PARAMETERS, PHYSICAL, RIM_KEYS, ROLES, SETTINGS, TIED, table_of
from gradhesion.cli.places import Path, dotted
from gradhesion.core.profile import MOST_HARMONICS

LAYOUTS: Final = ("grid", "points")
KINDS: Final = ("map", "curve")

BOUNDS: Final[dict[str, tuple[dict[str, float], str]]] = {
    "k": ({"ge": 0.0, "le": 1.0}, "0 <= k <= 1"),
    "nu": ({"gt": -1.0, "le": 0.5}, "-1 < nu <= 0.5"),
    "modulus": ({"gt": 0.0}, "modulus > 0, and finite"),
    "c0_over_R": ({"gt": 0.0}, "c0_over_R > 0, and finite"),
    "lambda_over_R": ({"gt": 0.0}, "lambda_over_R > 0, and finite"),
    "A": ({"ge": 0.0}, "A >= 0, and finite"),
    "a_max_over_R": ({"gt": 0.0}, "a_max_over_R > 0 (inf: an unbounded punch)"),
    "lambda_over_L": ({"gt": 0.0}, "lambda_over_L > 0, and finite"),
    "chi": ({"ge": 0.0}, "chi >= 0, and finite"),
    "a_max_over_L": ({"gt": 0.0}, "a_max_over_L > 0 (inf: an unbounded punch)"),
    "a_max_over_a2": ({"gt": 0.0}, "a_max_over_a2 > 0 (inf: an unbounded punch)"),
    MACHINE: ({"gt": 0.0}, "machine_stiffness > 0, and finite"),
    **{key: ({"gt": 0.0}, f"{key} > 0, and finite") for key in PHYSICAL},
    "amplitude": ({"ge": 0.0}, "amplitude >= 0, and finite"),
    "a_max": ({"gt": 0.0}, "a_max > 0 (inf: an unbounded punch)"),
}
"""The bounds of each key that gives parameters, for pydantic and in words."""


@dataclass(frozen=True)
class Mistake:
    """What is wrong at a key, and what to do about it."""

    path: Path
    value: Any
    sentence: str


MOST_WAVES: Final = 10_000
"""The shortest wave of a series, in waves a wavelength: beyond it hardly any scene can be followed."""

_OF_PARAMETERS: Final = ("parameters", "physical", "loading")
"""The tables whose keys are parameters."""


class _Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True)


class _Method(_Table):
    """How the scenes are solved."""

    solver: Annotated[
        Annotated[str, Tag("name")] | Annotated[list[str], Field(min_length=1), Tag("list")],
        Discriminator(lambda value: "list" if isinstance(value, list) else "name"),
        Field(description=SETTINGS["solver"]),
    ] = "exact"
    check_contact: Annotated[bool, Field(description=SETTINGS["check_contact"])] = True


class _Harmonic(_Table):
    """One wave of the series of a profile."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=SETTINGS["n"])]
    cos: Annotated[float, Field(allow_inf_nan=False, description=SETTINGS["cos"])] = 0.0
    sin: Annotated[float, Field(allow_inf_nan=False, description=SETTINGS["sin"])] = 0.0


class _Profile(_Table):
    """The shape of the punch."""

    exponent: Annotated[float, Field(ge=1.0, allow_inf_nan=False, description=SETTINGS["exponent"])] = 2.0
    harmonics: Annotated[
        Annotated[list[_Harmonic], Field(min_length=1, max_length=MOST_HARMONICS)] | None,
        Field(description=SETTINGS["harmonics"]),
    ] = None


def _form(value: object) -> str:
    """Tell which of the three forms of a parameter is meant."""
    return "range" if isinstance(value, Mapping) else "list" if isinstance(value, list) else "number"


def _parameter(name: str) -> Any:
    """Make the type of a parameter: a number, a list of them, or a range table."""
    bounds: dict[str, Any] = dict(BOUNDS[name][0])
    finite: Any = Annotated[float, Field(strict=True, allow_inf_nan=False, **bounds)]
    number: Any = Annotated[float, Field(strict=True, **bounds)] if name in RIM_KEYS else finite
    return _forms(name, number, finite)


def _quantity(name: str) -> Any:
    """Make the type of a quantity with a unit, a list of them, or a range table; quantities.py reads them."""
    return _forms(name, Any, Any)


def _forms(name: str, number: Any, end: Any) -> Any:
    """Make the type of one value, a list of values, or a range table between two ends."""
    spacing: Any = Literal["linear", "log"]
    range_table: Any = create_model(
        f"Range_{name}",
        __base__=_Table,
        start=(_told(end, "start"), ...),
        stop=(_told(end, "stop"), ...),
        num=(_told(Annotated[int, Field(ge=1)], "num"), ...),
        spacing=(_told(spacing, "spacing"), "linear"),
    )
    forms: Any = Union[  # noqa: UP007 (made at run time)
        Annotated[number, Tag("number")],
        Annotated[list[number], Field(min_length=1), Tag("list")],
        Annotated[range_table, Tag("range")],
    ]
    return Annotated[forms, Discriminator(_form), Field(description=KEYS[name])]


def _told(kind: Any, name: str) -> Any:
    """Make a type tell what its key is."""
    return Annotated[kind, Field(description=SETTINGS[name])]


@cache
def study_model() -> type[BaseModel]:
    """Make the model of a whole study."""
    parameters: dict[str, Any] = {
        name: (_parameter(name), None if name in (*ROLES, *TIED) else ...)
        for name in KEYS
        if table_of(name) == "parameters"
    }
    physical: dict[str, Any] = {name: (_quantity(name), None) for name in PHYSICAL}
    loading: dict[str, Any] = {"control": (_told(str, "control"), "displacement"), MACHINE: (_parameter(MACHINE), None)}
    return create_model(
        "Study",
        __base__=_Table,
        title=(_told(str, "title"), ""),
        kind=(_told(str, "kind"), "map"),
        layout=(_told(str, "layout"), "grid"),
        outputs=(_told(Annotated[list[str], Field(min_length=1)], "outputs"), ...),
        parameters=(_told(create_model("Parameters", __base__=_Table, **parameters), "parameters"), ...),
        physical=(_told(create_model("Physical", __base__=_Table, **physical), "physical"), None),
        profile=(_told(_Profile, "profile"), None),
        loading=(_told(create_model("Loading", __base__=_Table, **loading), "loading"), None),
        method=(_told(_Method, "method"), _Method()),
    )


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


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """
    Suggest the nearest of the known words, or list them all.

    >>> did_you_mean("pull_of_force", ["pull_off_force", "delta_max"])
    'did you mean "pull_off_force"?'
    >>> did_you_mean("speed", ["pull_off_force", "delta_max"])
    'choose from "pull_off_force", "delta_max"'
    """
    near = nearest(word, known)
    return f'did you mean "{near}"?' if near else "choose from " + ", ".join(f'"{name}"' for name in known)


def nearest(word: str, known: Sequence[str]) -> str | None:
    """Find the known word that is most like this one, if any is."""
    lower = {name.lower(): name for name in known}
    near = difflib.get_close_matches(word.lower(), lower, n=1, cutoff=0.6)
    return lower[near[0]] if near else None


def shown(value: object) -> str:
    """
    Write a value as TOML would, cut short where it is long.

    >>> shown(True), shown("a"), shown([1.0, float("inf")])
    ('true', '"a"', '[1.0, inf]')
    """
    if isinstance(value, bool):
        text = str(value).lower()
    elif isinstance(value, str):
        text = json.dumps(value[:80], ensure_ascii=False)
    elif isinstance(value, list):
        text = "[" + ", ".join(shown(item) for item in value[:8]) + (", ...]" if len(value) > 8 else "]")
    elif isinstance(value, Mapping):
        text = "{ " + ", ".join(f"{key} = {shown(item)}" for key, item in list(value.items())[:8]) + " }"
    elif isinstance(value, int):
        text = str(value) if abs(value) < 10**40 else "an integer of more than 40 digits"
    else:
        text = str(value)
    return text if len(text) <= 80 else text[:76] + " ..."


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


def example(path: Path) -> str:
    """Show a line that would do."""
    return f"write for example {line_of(path)}"


def line_of(path: Path) -> str:
    """Write a line that would do."""
    examples: dict[str, str] = {
        "title": 'title = "Pull-off force against wavelength"',
        "kind": 'kind = "map"',
        "layout": 'layout = "grid"',
        "outputs": f"outputs = {json.dumps(list(OUTPUTS)[::2][:2])}",
        "parameters": "a table [parameters] with " + ", ".join(PARAMETERS),
        "method": 'a table [method] with solver = "exact", "asymptotic" or "envelope"',
        "solver": 'solver = "exact" or solver = ["exact", "envelope"]',
        "check_contact": "check_contact = false",
        "k": "k = 0.5 or k = [0.0, 0.5]",
        "nu": "nu = 0.3",
        "modulus": "modulus = 500.0",
        "c0_over_R": "c0_over_R = 0.01",
        "lambda_over_R": 'lambda_over_R = { start = 0.02, stop = 1.0, num = 200, spacing = "log" }',
        "A": "A = 0.1",
        "a_max_over_R": "a_max_over_R = inf",
        "lambda_over_L": "lambda_over_L = 0.5",
        "chi": "chi = 0.5",
        "a_max_over_L": "a_max_over_L = 5.0",
        "a_max_over_a2": "a_max_over_a2 = 2.0",
        "physical": 'a table [physical] with R = "1 mm" and other quantities',
        "R": 'R = "1 mm"',
        "E_star": 'E_star = "50 kPa"',
        "work_of_adhesion": 'work_of_adhesion = "20 mJ/m^2"',
        "c0": 'c0 = "0.1 mm"',
        "wavelength": 'wavelength = "20 um"',
        "amplitude": 'amplitude = "0.5 um"',
        "spring_constant": 'spring_constant = "0.2 N/m"',
        "a_max": 'a_max = "0.5 mm" or a_max = inf',
        "profile": "a table [profile] with exponent or harmonics",
        "exponent": "exponent = 2.0",
        "harmonics": "harmonics = [{ n = 1, cos = 1.0 }, { n = 2, sin = 0.3 }]",
        "n": "n = 1",
        "cos": "cos = 1.0",
        "sin": "sin = 0.3",
        "loading": 'a table [loading] with control = "displacement", "load" or "machine"',
        "control": 'control = "load"',
        MACHINE: f"{MACHINE} = 10.0",
        "start": "start = 0.1",
        "stop": "stop = 1.0",
        "num": "num = 50",
    }
    named = [step for step in path if isinstance(step, str)]
    if path[0] == "physical" and named[-1] in ("start", "stop"):
        return examples[named[1]].replace(named[1], named[-1], 1)
    return examples[named[-1]]
