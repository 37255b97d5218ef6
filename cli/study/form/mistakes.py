"""What is wrong with the form of a study, each key for itself, and what is right about it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from gradhesion.cli.keys import FILE_KEYS, INPUTS, Path, keys_of
from gradhesion.cli.study.form.form import Form
from gradhesion.cli.study.form.sentences import sentence_of
from gradhesion.cli.study.text.places import dotted
from gradhesion.cli.terminal.wording import MEANT, did_you_mean, nearest

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
            missing[path] = Mistake(path, None, sentence_of(detail, path))
        else:
            mistakes.append(Mistake(path, detail["input"], sentence_of(detail, path)))
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
    elsewhere = None if table or near else nearest(key, [name for names in tables.values() for name in names])
    if elsewhere:
        place = next(other for other, names in tables.items() if elsewhere in names)
        return (*place, elsewhere), f'unknown key; did you mean "{elsewhere}", under [{dotted(place)}]?'
    meant = nearest(key, tuple(INPUTS)) if table in (("parameters",), ("physical",)) else None
    if meant and key.lower() in MEANT.get(meant, ()) and INPUTS[meant].table != table[0] and near != meant:
        home = INPUTS[meant].table
        if near is None or key.lower() not in MEANT.get(near, ()):
            return (home, meant), f'unknown key; did you mean "{meant}", under [{home}]?'
    return (*table, near or ""), f"unknown key; {did_you_mean(key, known)}"
