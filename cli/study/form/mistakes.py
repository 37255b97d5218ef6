"""What is wrong with the form of a study, each key for itself, in sentences that say what to write instead."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.keys import FILE_KEYS, INPUTS, Path, keys_of
from gradhesion.cli.study.form.form import (
    FASTEST,
    MOST_REALISATIONS,
    MOST_RESOLUTION,
    MOST_STATES,
    MOST_WAVES,
    SLOWEST,
    Form,
)
from gradhesion.cli.study.text.places import dotted
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.terminal.wording import MEANT, did_you_mean, example, nearest
from gradhesion.core.problem.profile import MOST_HARMONICS

_OF_INPUTS: Final = ("parameters", "physical", "loading")
"""The tables whose keys are inputs."""

OF_A_FIT: Final = ("data", "fit")
"""The tables of studies of kind "fit" alone."""

_TABLES: Final = (
    "parameters",
    "physical",
    "profile",
    "loading",
    "toughness",
    "rate",
    "states",
    "optimum",
    "uncertainty",
    "method",
    *OF_A_FIT,
)
"""Every table at the top."""

REQUIRED: Final[dict[Path, Any]] = {
    ("outputs",): ["pull_off_force"],
    ("parameters",): {},
    ("parameters", "k"): 0.5,
    ("parameters", "nu"): 0.3,
}
"""The keys that a form needs, with valid values: they stand for wrong ones, so that all else can be read."""


@dataclass(frozen=True)
class Mistake:
    """What is wrong at a key, and what to do about it."""

    path: Path
    value: Any
    sentence: str


@dataclass(frozen=True, kw_only=True)
class Checked:
    """A study whose keys have been looked at one by one."""

    form: Form
    """The study, but for what is wrong."""
    data: Mapping[str, Any]
    """The study as it is written."""
    mistakes: tuple[Mistake, ...]
    wrong: frozenset[Path]
    """The keys that are wrong or missing: the key itself, where an item of its value is."""
    meant: frozenset[Path]
    """The keys that are not missing, but misspelt or in the wrong table."""


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
        form = model.model_validate(data)
    except ValidationError as error:
        details = error.errors(include_url=False, include_context=True)
    else:
        return Checked(form=form, data=data, mistakes=(), wrong=frozenset(), meant=frozenset())
    mistakes: list[Mistake] = []
    meant: set[Path] = set()
    missing: dict[Path, Mistake] = {}
    for detail in details:
        path = _path(detail)
        if detail["type"] == "extra_forbidden":
            key, sentence = _unknown_key(path)
            meant.add(key)
            mistakes.append(Mistake(path, detail["input"], sentence))
        elif detail["type"] == "missing":
            missing[path] = Mistake(path, None, _sentence(detail, path))
        else:
            mistakes.append(Mistake(path, detail["input"], _sentence(detail, path)))
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


def _path(detail: ErrorDetails) -> Path:
    """Take the tag of the form (number, list, range, name) out of pydantic's path of a parameter or solver."""
    steps = detail["loc"]
    if steps[:2] in (("optimum", "maximise"), ("optimum", "minimise")):
        return steps[:2]
    return (*steps[:2], *steps[3:]) if steps[0] in ("parameters", "physical", "loading", "method") else steps


def _unknown_key(path: Path) -> tuple[Path, str]:
    """Report which key was meant, and say so."""
    tables: dict[Path, tuple[str, ...]] = {(): keys_of(""), **{(name,): keys_of(name) for name in _TABLES}}
    table, key = path[:-1], str(path[-1])
    if table == ("uncertainty",):
        return path, f"not an input of a study; {did_you_mean(key, (*INPUTS, *keys_of('uncertainty')))}"
    files = FILE_KEYS if table == ("parameters", "points") else ()
    inner = (
        "spectrum"
        if table == ("profile", "spectrum")
        else "harmonics"
        if table[:1] in (("profile",), ("toughness",))
        else "range"
    )
    inner = "require" if table == ("optimum", "require") else inner
    known = files or tables.get(table, keys_of(inner))
    for other, keys in tables.items():
        if other != table and key in keys:
            home = f"under [{dotted(other)}]" if other else "at the top, before the first [table]"
            return (*other, key), f"this key belongs {home}; move it there"
    if inner == "range" and known == keys_of("range") and key in ("step", "by", "increment", "delta"):
        sentence = "a range has no step; give the number of its values instead, for example num = 11"
        return (*table, "num"), f'{sentence}, evenly spaced unless spacing = "log"'
    if not table and key in OF_A_FIT:
        return path, 'this table belongs to a fit; write kind = "fit" at the top, or remove it'
    near = nearest(key, known)
    meant = nearest(key, tuple(INPUTS)) if table in (("parameters",), ("physical",)) else None
    if meant and key.lower() in MEANT.get(meant, ()) and INPUTS[meant].table != table[0] and near != meant:
        home = INPUTS[meant].table
        if near is None or key.lower() not in MEANT.get(near, ()):
            return (home, meant), f'unknown key; did you mean "{meant}", under [{home}]?'
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"


def _sentence(detail: ErrorDetails, path: Path) -> str:
    """Say what pydantic found in the words of a study."""
    kind = detail["type"]
    value = detail["input"]
    last = path[-1]
    if kind == "value_error":  # of a quantity, in a sentence already
        return str(detail["ctx"]["error"])
    if path[0] == "profile" and len(path) > 1:
        return _profile_sentence(kind, path)
    if path[0] in ("toughness", "rate") and len(path) > 1:
        return _edge_sentence(kind, path)
    if path[0] == "optimum" and len(path) > 1:
        return _optimum_sentence(kind, path)
    if path[0] == "states" and len(path) > 1 and kind != "too_short":
        return _states_sentence(kind, path)
    if path == ("uncertainty", "seed"):
        return f"the seed is an integer of 0 or more; {example(path)}"
    if path[:2] == ("parameters", "points"):
        return _file_sentence(kind, path)
    if (
        path[:2] != ("loading", "control")
        and path[0] in _OF_INPUTS
        and len(path) > 1
        and last not in ("num", "spacing")
    ):
        return _parameter_sentence(kind, value, path)
    if path[:2] == ("states", "contact_radius_over_R") and len(path) > 2:
        return f"a contact radius is a number above 0, over R and without a unit; {example(path)}"
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
    allowed = INPUTS[name].allowed
    if isinstance(value, str) and (sentence := ratio_sentence(value, name)):
        return sentence
    if kind == "float_type" and not (isinstance(value, int) and not isinstance(value, bool)):
        forms = "" if len(path) > 2 else ", a list of numbers or a range table"
        return f"this must be a number{forms}, with {allowed}; {example(path[:2])}"
    if last in ("start", "stop") and isinstance(value, float) and math.isinf(value):
        return "a range must end at finite values; write a list where inf is one of the values"
    unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if name == "load_max" else ""
    return f"out of range; choose a value with {allowed}{unpressed}"


def _file_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the name of a file, or its fingerprint."""
    if path[-1] == "sha256":
        return "a sha256 has 64 digits from 0 to f; write that of the file, or leave it out"
    if kind == "missing":
        return f"the name of the file is required; {example(path)}"
    return f"this must be the name of a file in quotes; {example(path)}"


def _spectrum_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with random roughness."""
    last = str(path[-1])
    allowed = {
        "hurst": "the Hurst exponent is a number from 0 to 1",
        "first": f"the longest wave is an integer from 1 to {MOST_WAVES:,}",
        "last": f"the shortest wave is an integer from 1 to {MOST_WAVES:,}",
        "realisations": f"the number of profiles is an integer from 1 to {MOST_REALISATIONS:,}",
        "seed": "the seed is an integer of 0 or more",
    }
    if kind == "missing":
        return f"a spectrum needs this key; {example(path)}"
    return f"{allowed.get(last, 'this must be a table')}; {example(path)}"


def _optimum_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with what is sought."""
    if path[-1] in ("minimum", "maximum") or (len(path) > 3 and path[2] in ("minimum", "maximum")):
        return f"this must be a table of outputs with finite numbers; {example(path[:3])}"
    allowed = {
        "maximise": "this must be the name of an output in quotes, or a list of two",
        "minimise": "this must be the name of an output in quotes, or a list of two",
        "over": "this must be a list of inputs",
        "resolution": f"the resolution is an integer from 3 to {MOST_RESOLUTION:,}",
        "one_disc": "this must be true or false",
    }
    word = str(path[2]) if path[1] == "require" and len(path) > 2 else str(path[1])
    required = "this key is required" if kind == "missing" else allowed.get(word, "this must be a table")
    return f"{required}; {example((*path[:1], word))}"


def _edge_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with a pattern of toughness, or with the law of a moving edge."""
    last = path[-1]
    if path == ("rate", "exponent"):
        missing = "this key is required" if kind == "missing" else "the power n of the speed is a number"
        return f"{missing}, from {SLOWEST:g} to {FASTEST:g}; write for example exponent = 0.6"
    if last == "n" and kind == "missing":
        return "a wave needs its number n; write for example { n = 1, cos = 0.2 }"
    if last in ("of", "closing"):
        return f"this must be a string in quotes; {example(path)}"
    if path[1] == "harmonics" and len(path) < 4:
        if kind == "too_long":
            return f"a series has {MOST_HARMONICS} terms at most; leave the smallest out"
        required = "this key is required: a" if kind == "missing" else "this must be a"
        return f"{required} list of tables, one for each wave; write for example harmonics = [{{ n = 1, cos = 0.2 }}]"
    return _profile_sentence(kind, path)


def _states_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the states whose pressure and surface are drawn."""
    if len(path) > 2:
        return f"a contact radius a/R is a number above 0, and finite; {example(path)}"
    if kind == "too_long":
        return f"a study draws {MOST_STATES:,} states at most; leave some out"
    return f"this must be a list of numbers in brackets; {example(path)}"


def _profile_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the shape of the punch."""
    last = path[-1]
    if last in ("file", "sha256"):
        return _file_sentence(kind, path)
    if path[1] == "spectrum":
        return _spectrum_sentence(kind, path)
    if last == "terms":
        return f"terms is the number of harmonics, an integer from 1 to {MOST_HARMONICS}; {example(path)}"
    if last == "exponent":
        return f"the power of the punch is a number of 1 or more, and finite (1 is a cone); {example(path)}"
    if last == "n":
        return f"n is the number of waves per wavelength, an integer from 1 to {MOST_WAVES:,}; {example(path)}"
    if last in ("cos", "sin"):
        return f"this must be a number, and finite; {example(path)}"
    if kind == "too_long":
        return f"a series has {MOST_HARMONICS} terms at most; leave the smallest out"
    return f"this must be a list of tables, one for each wave; {example(path)}"
